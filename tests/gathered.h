/* gathered.h - a native stream of one stack, read whole: for programs of the checks. */
#ifndef IL_TESTS_GATHERED_H
#define IL_TESTS_GATHERED_H

#include "model/pair.h"
#include "model/sink.h"

/* slice[n] as they stand in the stream, and in pair[k] what it says of slices k - 1 and k. */
typedef struct gathered {
    il_sink sink;
    il_stack_head head;
    il_slice *slice;         size_t n, cap;
    il_pair *pair;           size_t cap_pairs;
} gathered;

/* Whatever the outcome, to be freed. */
il_status gathered_read(gathered *g, const char *path, il_error *err);
void gathered_free(gathered *g);

#endif
