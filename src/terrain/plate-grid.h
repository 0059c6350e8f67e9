/* plate-grid.h - a plate on a grid of bare numbers: bounds of nodes, and where edges of the grid
 * are held.  See plate.h for what is minimised. */
#ifndef IL_TERRAIN_PLATE_GRID_H
#define IL_TERRAIN_PLATE_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The sums over the lines that cross an edge of the grid, at t of it on level z: of 1, t, t^2,
 * z and t z.  They say all that the sum of ((1 - t) a + t b - z)^2 depends on. */
typedef struct il_plate_hold { double n, t, tt, z, tz; } il_plate_hold;

/* Node i + n[0] j.  z[]: heights.  bound[2 * node]: least and greatest, infinite outside the frame.
 * held[2 * node + axis]: of the edge along that axis, 1 + its place in hold[], or 0. */
typedef struct il_plate_grid {
    size_t n[2];
    double *z, *bound;
    uint32_t *held;
    unsigned char *kind;
    il_plate_hold *hold;     size_t n_holds, cap_holds;
} il_plate_grid;

#define IL_PLATE_GRID_INIT { 0 }
void il_plate_grid_free(il_plate_grid *g); /* safe twice */

/* A grid of n[0] by n[1] nodes, nothing of it held; false without memory, as below. */
bool il_plate_grid_make(il_plate_grid *g, const size_t n[2]);
bool il_plate_grid_hold(il_plate_grid *g, size_t node, int axis, double t, double z);

/* Find z; TENSION: a step by the width.  Nodes that are too far outside: NAN. */
bool il_plate_grid_solve(il_plate_grid *g, double tension);

#endif
