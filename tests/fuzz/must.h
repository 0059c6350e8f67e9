/* must.h - what a fuzz harness asserts, with or without NDEBUG. */
#ifndef IL_FUZZ_MUST_H
#define IL_FUZZ_MUST_H

#include <stdio.h>
#include <stdlib.h>

static inline void must(int holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "%s\n", what);
    abort();
}

#endif
