/* tin.h - the chart triangulated, and the faces that its lines part. */
#ifndef IL_TERRAIN_TIN_H
#define IL_TERRAIN_TIN_H

#include "terrain/bands.h"
#include "terrain/chart.h"

/* Triangle t has nodes corner[3*t + k], counter-clockwise; over the edge from corner k to k + 1
 * lies triangle across[3*t + k] (IL_CHART_NONE beyond the hull) and, where the edge is one of
 * the chart's, that edge is edge[3*t + k], else IL_CHART_NONE.  face[t]: the face it belongs
 * to, IL_CHART_NONE outside the frame.
 * side[2*e], side[2*e + 1]: the faces to the left and right of edge e of the chart, on either
 * side; of several edges between the same nodes one has them, and cliff[2*e], cliff[2*e + 1] are
 * the lowest and the highest of their levels then, if those differ or an even number of lines
 * of one level part nothing; -1 for others.  n_cliffs: such edges. */
typedef struct il_tin {
    uint32_t *corner, *across, *edge, *face;
    size_t n;
    uint32_t *side;
    int32_t *cliff;
    size_t n_sides, n_faces, n_cliffs;
} il_tin;

#define IL_TIN_INIT { 0 }
void il_tin_free(il_tin *t); /* safe twice */

/* The constrained Delaunay triangulation of C (Chew 1989), and its faces, numbered in the order
 * of their first triangles.  *CROSSES: edges cross or pass through nodes; T is empty then.
 * O(n log n) for the short edges of isolines.  IL_E_NOMEM. */
il_status il_tin_build(il_tin *t, const il_chart *c, bool *crosses, il_error *err);

/* The stretches of lines between faces, as il_bands_label takes them, but for cliffs, which do
 * not tell what is on which side, and spikes, where a line goes and comes back; border[n] is
 * the caller's.  What lies beyond lines that run along the frame counts as *N_FACES - T's
 * faces more, one a stretch.  IL_E_NOMEM; nothing is left to free then. */
il_status il_tin_borders(const il_tin *t, const il_chart *c, il_border **border, size_t *n, size_t *n_faces, il_error *err);

/* Corner K is one of three: the number of the next, around its triangle. */
static inline size_t il_tin_after(size_t k)
{
    return k % 3 == 2 ? k - 2 : k + 1;
}

/* Edge K of triangles, of which one lies across: the number it has there. */
static inline size_t il_tin_twin(const il_tin *t, size_t k)
{
    size_t j = 3 * (size_t)t->across[k];
    while (t->across[j] != k / 3)
        j++;
    return j;
}

/* Twice the area of triangle T, in the mesh's unit^2; positive. */
double il_tin_area2(const il_tin *t, const il_chart *c, size_t triangle);

#endif
