/* refine.h - points put into a triangulation one by one, and diagonals changed.
 *
 * Incremental insertion with Lawson's flips (Lawson 1977; Guibas & Stolfi 1985) on the arrays of
 * a tin: O(1) a point where points come near each other, exact predicates, no order but that
 * of the calls.  Edges of the chart are never flipped: what was a constrained Delaunay
 * triangulation stays one. */
#ifndef IL_TERRAIN_REFINE_H
#define IL_TERRAIN_REFINE_H

#include "terrain/tin.h"

/* Borrowed: t and c, which nobody else changes meanwhile.  cap_*: of T's arrays, whose n is
 * the number of what they hold.  star[n_star]: the triangles that the last change made or
 * changed; after an insertion those around the new node, each (x, y, node). */
typedef struct il_refine {
    il_tin *t;
    il_chart *c;
    size_t cap_corners, cap_across, cap_edges, cap_faces, cap_sides, cap_cliffs;
    uint32_t *star;          size_t n_star, cap_star;
} il_refine;

/* To put points into T, C's, as il_tin_build and changes of a refine have left them. */
il_refine il_refine_begin(il_tin *t, il_chart *c);
void il_refine_end(il_refine *r); /* safe twice */

/* A node without a height at P, which lies in TRIANGLE or beside it, in the same face and off
 * its lines: *NODE, or IL_CHART_NONE when P lies nowhere there (rounding may have carried it
 * across a line, or onto a node), and then nothing has changed.  False without memory. */
bool il_refine_insert(il_refine *r, size_t triangle, const double p[2], uint32_t *node);

/* How near the nearest node would be of those that P, in TRIANGLE, got edges to: of the corners
 * of all triangles whose circles P lies in, up to lines.  Infinity without memory. */
double il_refine_clearance(il_refine *r, size_t triangle, const double p[2]);

/* As il_refine_insert, on edge K of triangles, which is one of the frame where no line runs along: it becomes
 * two.  P may lie beside it by its rounding. */
bool il_refine_divide(il_refine *r, size_t k, const double p[2], uint32_t *node);

/* Edge K of triangles, no edge of the chart, becomes the other diagonal of its two triangles:
 * from the corner opposite in the far one to that in its own.  Those must form a strictly convex
 * quadrangle, as il_refine_is_convex tells.  False without memory. */
bool il_refine_flip(il_refine *r, size_t k);
bool il_refine_is_convex(const il_refine *r, size_t k);

#endif
