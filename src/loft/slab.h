/* slab.h - the surface between two neighbouring sections, certified. */
#ifndef IL_LOFT_SLAB_H
#define IL_LOFT_SLAB_H

#include "loft/build.h"
#include "loft/certificate.h"
#include "model/pair.h"

/* A slab and how it came about: the attempt that passed, or why the last one
 * did not. */
typedef struct il_slab {
    il_surface surface;
    il_attempt attempt;
    il_verdict verdict;
    size_t n_nodes[2];   /* of its sections, with its own insertions */
} il_slab;

#define IL_SLAB_INIT { 0 }
void il_slab_free(il_slab *s);

/* Loft between LOWER and UPPER, which gain the slab's insertions as nodes.
 * After IL_E_SURFACE the verdict tells why and where. */
il_status il_slab_loft(il_slab *out, il_section *lower, il_section *upper, bool round_float, il_error *err);

/* After the neighbour slabs put points on edges of LOWER or UPPER: split each
 * triangle on such an edge into a fan from its opposite vertex (it has only one
 * contour edge, loft.md I3), and certify what was split. */
il_status il_slab_follow(il_slab *s, const il_section *lower, const il_section *upper, il_error *err);

#endif
