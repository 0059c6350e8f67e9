/* terrains.h - random terrains and their isolines, to the last digit.
 *
 * A terrain is a sum of bumps, pits, ridges and plateaus on the nodes of a grid, straight in
 * the triangles between; so its isolines are polylines with a vertex on each edge that they
 * cross, and it is known of every point between which levels it lies.  No node lies on a
 * level, so lines meet nothing but the edge of the grid.  Tests only: aborts without memory. */
#ifndef IL_TESTS_TERRAINS_H
#define IL_TESTS_TERRAINS_H

#include "model/stack.h"
#include "terrain/bands.h"

/* z[n[0] * n[1]]: heights of the nodes, rows along x.  falls[]: cells that are halved from
 * upper left to lower right, the others from lower left to upper right. */
typedef struct terrain {
    size_t n[2];
    double origin[2], step;
    double *z;
    unsigned char *falls;
    double level[16];
    size_t n_levels;
} terrain;

/* A terrain of 3 to 9 levels that all occur; every third has levels that are not evenly spaced. */
void terrain_make(terrain *t, uint64_t seed);
void terrain_free(terrain *t);

void terrain_box(const terrain *t, double box[4]); /* least x and y, greatest x and y */
double terrain_height(const terrain *t, const double p[2]);
/* The level next below Z, -1 for none. */
int32_t terrain_low(const terrain *t, double z);

/* slice[n_levels]: the isolines, with the higher ground on their left, open at the edge of the
 * grid; feature: 1, 2, 3 ... */
void terrain_contour(const terrain *t, il_slice *slice);

/* What the isolines part, edge by edge of them: border[n], the lines' numbers being their
 * features less one.  band[n_faces]: of the faces.  Owned by the caller. */
typedef struct terrain_faces {
    il_border *border;
    il_band *band;
    size_t n, cap, n_faces, n_lines;
} terrain_faces;

terrain_faces terrain_part(const terrain *t);
void terrain_faces_free(terrain_faces *f);

/* As maps come: every second line cut into pieces, every second piece turned round, all of a
 * level in any order. */
void terrain_scatter(il_slice *slice, size_t n, uint64_t seed);

/* Close open lines that begin and end on the box (the grid's) along it, on their left. */
void terrain_close(const terrain *t, il_slice *slice, uint64_t seed);

void terrain_free_slices(il_slice *slice, size_t n);

#endif
