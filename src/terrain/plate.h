/* plate.h - a bending plate over a field, held by the lines and kept inside their bands. */
#ifndef IL_TERRAIN_PLATE_H
#define IL_TERRAIN_PLATE_H

#include "terrain/field.h"

/* The plate z over the nodes of a field, spaced `every` apart, that minimises
 *
 *     Int z_xx^2 + 2 z_xy^2 + z_yy^2 + 0.3 (grad z)^2 / width^2   (Briggs 1974, with the tension of
 *                                                                 Smith and Wessel 1990)
 *
 * where z is the level on each line (a heavy weight on z between the two nodes of each edge of the
 * grid that a line crosses) and stays in the band of each node's face, beyond the last level within
 * an interval.  The frame is free: nodes up to two beyond it take part without bounds.
 * From a coarse grid to finer ones, by projected over-relaxation in rows (Cryer 1971): a fixed
 * number of sweeps over each, so time is linear in the nodes and the bytes are always the same.
 *
 * Only every EVERY'th level counts (1: all); the bands are then those between such.  *Z is the
 * caller's, heights of the map, NAN away from the frame; size n[] of il_plate_size.  IL_E_NOMEM. */
il_status il_plate_solve(const il_field *f, const il_chart *c, const il_band *band, int32_t every, double **z, il_error *err);

/* How many nodes a plate over each EVERY'th of F's has. */
static inline size_t il_plate_size(const il_field *f, int axis, int32_t every)
{
    return (f->n[axis] - 1) / (size_t)every + 1;
}

/* Its height at (x, y) of F's plane, between the four nodes about it; NAN beside its edge. */
double il_plate_height(const il_field *f, const double *z, int32_t every, double x, double y);

/* The levels, as heights, of a band of every EVERY'th level that holds band B; beyond the last
 * one an interval. */
void il_plate_bounds(const il_chart *c, il_band b, int32_t every, double bound[2]);

#endif
