/* peer.h - elastix, which registers images, put to the same pairs: it gets the
 * distance maps of both outlines, as the paper's own method does. */
#ifndef IL_TESTS_BENCH_PEER_H
#define IL_TESTS_BENCH_PEER_H

#include "model/pair.h"
#include "../pairs.h"

#include <stdbool.h>

/* Can it be run? */
bool peer_is_there(void);

/* What the run took, its start and files included, and the deformation that it
 * found: one lattice; free it by peer_free. */
typedef struct peer_result {
    double processor_s, clock_s;
    il_fit phi;
    il_lattice lattice;
} peer_result;

/* One thread.  False when it fails, and then standard error says why; *OUT is empty. */
bool peer_match(const pairs_pair *p, peer_result *out);
void peer_free(peer_result *r);

#endif
