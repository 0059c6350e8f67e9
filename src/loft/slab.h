/* slab.h - the surface between two neighbouring sections, certified. */
#ifndef IL_LOFT_SLAB_H
#define IL_LOFT_SLAB_H

#include "loft/certificate.h"
#include "loft/lean.h"
#include "model/pair.h"

/* A slab and how it came about: the verdict of the attempt that passed, or why
 * the last one did not.  length_by: of the contours of both slices, by the
 * attempts that settled them; length_alone: of those that nothing corresponds
 * to in the other slice; unit.  gap: nothing joins the sections; they have
 * lids, which are laid when the neighbours have inserted their points, so that
 * il_slab_follow makes them.  lean[side]: how it leans at its sections, once it has followed. */
typedef struct il_slab {
    bool gap;
    il_surface surface;
    il_verdict verdict;
    double length_by[IL_N_ATTEMPTS], length_alone;
    size_t n_nodes[2];   /* of its sections, with its own insertions */
    il_lean lean[2];
} il_slab;

#define IL_SLAB_INIT { 0 }
void il_slab_free(il_slab *s);

/* Loft between LOWER and UPPER, which gain the slab's insertions as nodes, with
 * what PAIR says of their slices (null: nothing).  After IL_E_SURFACE the
 * verdict tells why and where. */
il_status il_slab_loft(il_slab *out, il_section *lower, il_section *upper, const il_pair *pair, bool round_float, il_error *err);

/* The last step, after the neighbour slabs put points on edges of LOWER or UPPER:
 * split each triangle on such an edge into a fan from its opposite vertex (it has
 * only one contour edge, loft.md I3), and certify what was split. */
il_status il_slab_follow(il_slab *s, const il_section *lower, const il_section *upper, il_error *err);

#endif
