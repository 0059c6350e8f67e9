/* placement.h - where the mesh of a map is put: near the origin, at a size that prints. */
#ifndef IL_TERRAIN_PLACEMENT_H
#define IL_TERRAIN_PLACEMENT_H

#include "model/stack.h"

/* fit: the longer side of the map becomes this many mm, 0 for no scaling.  z_scale: heights
 * are exaggerated so many times, above 0.  recentre: the middle of the map goes to x = y = 0,
 * and a solid stands on z = 0.  has_base, base: the height of a solid's floor, in the unit
 * of the heights, as on the map.  round_float: positions become 32-bit floats. */
typedef struct il_placement_options {
    double fit, z_scale;
    bool recentre, solid, has_base, round_float;
    double base;
} il_placement_options;

#define IL_PLACEMENT_OPTIONS_INIT { 0, 1, false, false, false, false, 0 }

/* Choose head->placement's x and y for the frame's BOX (least x and y, greatest x and y), and
 * head->unit, which is mm after a fit.  Offsets are whole powers of ten's multiples that are
 * small beside the map, so that they can be typed.  IL_E_INPUT for a fit of degrees. */
il_status il_placement_choose(il_stack_head *head, const il_placement_options *o, const double box[4], il_error *err);

/* A point of the map (x, y) to where it goes in the mesh, rounded as O says. */
void il_placement_apply(const il_stack_head *head, const il_placement_options *o, const double from[2], double to[2]);

/* Choose the floor and the rest of the placement, now that the surface's heights are known
 * to lie from LOWEST to HIGHEST (on the map): *FLOOR, on the map.  Without has_base it lies
 * lower than LOWEST by 0.02 of the map's longer side (as z is scaled).  IL_E_INPUT for a base that is not
 * below LOWEST. */
il_status il_placement_settle(il_stack_head *head, const il_placement_options *o, const double box[4],
                              double lowest, double highest, double *floor, il_error *err);

/* A height of the map to that of the mesh. */
double il_placement_height(const il_stack_head *head, const il_placement_options *o, double z);

#endif
