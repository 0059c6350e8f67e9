/* patch.h - a part of the plane by the edges about it, in no order: areas, centres, distances. */
#ifndef IL_MATCH_PATCH_H
#define IL_MATCH_PATCH_H

#include "base/nearest.h"
#include "model/ring.h"

/* edge[n]: the patch lies on the left.  Once planted: tree, over the edges; low, the least y;
 * area, unit^2, > 0, and its centre. */
typedef struct il_patch {
    il_segment *edge;
    size_t n, cap;
    il_nearest tree;
    double low, area, centre[2];
} il_patch;

#define IL_PATCH_INIT { 0 }
void il_patch_free(il_patch *p); /* safe twice */

/* Append the edges of R, TURNED the other way round; false without memory. */
bool il_patch_add(il_patch *p, const il_ring *r, bool turned);
void il_patch_move(il_patch *p, const double by[2]);
/* When all is added and moved, once.  O(n log^2 n); IL_E_NOMEM. */
il_status il_patch_plant(il_patch *p, il_error *err);

/* Where P, planted, is nearest to AT: there, when AT is in P.  O(log n). */
void il_patch_nearest(const il_patch *p, const double at[2], double nearest[2]);

/* The area, unit^2, of what A and B, both planted, have in common.  Whatever edges do (meet,
 * coincide, end on each other) it is right up to rounding: the sum, over the pairs of an edge
 * of A and one of B, of what lies below both, with the signs of their directions.  O(log n)
 * an edge of the one that has fewer, and the other's edges above and below it. */
double il_patch_common(const il_patch *a, const il_patch *b);

#endif
