/* terrain.h - what is told of a terrain: its levels, its lines, where they end. */
#ifndef IL_CLI_TERRAIN_H
#define IL_CLI_TERRAIN_H

#include "cli/hull.h"
#include "model/spacing.h"
#include "model/stack.h"

/* One level: its open and closed lines, their points, their length and the sum of what
 * the closed ones enclose each. */
typedef struct il_terrain_level {
    double z;
    size_t open, closed, points;
    double length, area;
} il_terrain_level;

/* crs: null when there is none; geographic: as in il_stack_head.  level[n]: rising.
 * on_ellipsoid: lengths and areas are in m and m^2 on the ellipsoid; else in the stack's
 * unit in the plane, and unknown where that is degrees (has_measures is false).
 * n_spots: spot heights.  end[2 * n_ends]: where open lines end; hull: of all lines.
 * Known once it is settled: interval, that of the levels, 0 where there is not one
 * (of few levels, or uneven ones); n_missing: levels left out of it; n_inside: ends of
 * open lines in the middle of the map. */
typedef struct il_terrain {
    char *crs;
    bool has_geographic, on_ellipsoid, has_measures;
    double geographic[4];
    size_t n_spots;
    il_terrain_level *level;
    size_t n, cap;
    double *end;
    size_t n_ends, cap_ends;
    il_hull hull;
    double interval;
    size_t n_missing, n_inside;
} il_terrain;

/* *T is overwritten.  IL_E_NOMEM; empty then. */
il_status il_terrain_begin(il_terrain *t, const il_stack_head *head, il_error *err);
void il_terrain_free(il_terrain *t); /* safe twice */

/* A level passes.  IL_E_NOMEM. */
il_status il_terrain_slice(il_terrain *t, const il_slice *s, il_error *err);

/* All have passed; SPACING is that of the levels.  IL_E_NOMEM. */
il_status il_terrain_settle(il_terrain *t, const il_spacing *spacing, il_error *err);

/* Sums over the levels, z not among them. */
il_terrain_level il_terrain_sum(const il_terrain *t);

/* The unit of heights in a stack of UNIT: metres where that is degrees. */
il_unit il_terrain_unit_of_z(il_unit unit);

#endif
