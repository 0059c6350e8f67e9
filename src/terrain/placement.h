/* placement.h - where the mesh of a map is put: near the origin, at a size that prints.
 *
 * A point p of the map goes to v = (p - offset) / scale, each coordinate by itself, so that
 * v * scale + offset is its place on the map.  Heights are divided by the scale of x and y
 * and multiplied by z_scale, which spares them the rounding of scale[2]: 10 m exaggerated
 * three times are 30, not 30.000000000000004. */
#ifndef IL_TERRAIN_PLACEMENT_H
#define IL_TERRAIN_PLACEMENT_H

#include "model/stack.h"

/* fit: the longer side of the map becomes this many mm, 0 for no scaling.  z_scale: heights
 * are exaggerated so many times, above 0.  recentre: the middle of the map goes to x = y = 0,
 * nearly, and a solid stands on z = 0, exactly.  has_base, base: the height of a solid's
 * floor, in the unit of the heights, as on the map.  round_float: positions become 32-bit
 * floats. */
typedef struct il_placement_options {
    double fit, z_scale;
    bool recentre, solid, has_base, round_float;
    double base;
} il_placement_options;

#define IL_PLACEMENT_OPTIONS_INIT { 0, 1, false, false, false, false, 0 }

/* Choose head->placement's x and y for the frame's BOX (least x and y, greatest x and y), and
 * head->unit, which is mm after a fit.  has_placement only where it changes anything: without
 * fit, z_scale and recentre points stay as they are, bit for bit, but for round_float.
 * Offsets are whole multiples of a power of ten between 1/10000 and 1/1000 of the longer
 * side, so that they can be typed, and the middle is no farther than half of that from 0.
 * IL_E_INPUT for a fit of degrees, for a head with a frame, which says itself where
 * things are, and for a map that would be beyond 1e15 or have no extent left. */
il_status il_placement_choose(il_stack_head *head, const il_placement_options *o, const double box[4], il_error *err);

/* VALUE brought to a whole multiple of the greatest power of ten that is not above SIZE, by
 * WAY (round, floor).  Below 1 it is divided by that power's inverse, a whole number, so
 * that the result is the double nearest to its few decimals.  VALUE itself where multiples
 * are too many to be counted exactly: it is huge then, and its own digits are all it has. */
double il_placement_shorten(double value, double size, double (*way)(double));

/* A coordinate of the mesh as the output holds it. */
double il_placement_round(const il_placement_options *o, double v);

/* A point of the map (x, y) to where it goes in the mesh, rounded as O says. */
void il_placement_apply(const il_stack_head *head, const il_placement_options *o, const double from[2], double to[2]);

/* Choose the floor and the rest of the placement, now that the surface's heights are known
 * to lie from LOWEST to HIGHEST (on the map): *BOTTOM, on the map, LOWEST where O wants no
 * solid.  Without has_base it lies lower than LOWEST by 0.02 of the map's longer side (as z
 * is scaled; of a map in degrees, by a tenth of its heights' range, or 1), or a tenth of
 * that more, which makes it a short number.  IL_E_INPUT for a base that is not below LOWEST,
 * also as rounded, and for heights beyond 1e15. */
il_status il_placement_settle(il_stack_head *head, const il_placement_options *o, const double box[4],
                              double lowest, double highest, double *bottom, il_error *err);

/* A height of the map to that of the mesh, rounded as O says. */
double il_placement_height(const il_stack_head *head, const il_placement_options *o, double z);

#endif
