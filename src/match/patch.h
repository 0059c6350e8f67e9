/* patch.h - a part of the plane by the edges about it, in no order: areas, centres, distances. */
#ifndef IL_MATCH_PATCH_H
#define IL_MATCH_PATCH_H

#include "match/scan.h"
#include "model/ring.h"

/* edge[n]: the patch lies on the left.  Once planted: tree, over the edges; box, about them;
 * area, unit^2, > 0, and its centre. */
typedef struct il_patch {
    il_segment *edge;
    size_t n, cap;
    il_nearest tree;
    double box[4], area, centre[2];
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

/* The edges of P, planted, that can matter to S, as of figure SIDE. */
void il_patch_scan(const il_patch *p, il_scan *s, int side);

/* *AREA, unit^2, of what A and B, both planted, have in common, as il_scan_measure finds it with
 * S.  O(n log n) for their edges about where their boxes meet.  IL_E_NOMEM. */
il_status il_patch_common(const il_patch *a, const il_patch *b, il_scan *s, double *area, il_error *err);

#endif
