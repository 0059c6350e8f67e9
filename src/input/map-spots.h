/* map-spots.h - points with a height, which go along with the lines of a map.
 *
 * They say nothing of how the map is to be read: where heights stand, what unit they are
 * in and whether coordinates are degrees is settled by the lines alone. */
#ifndef IL_INPUT_MAP_SPOTS_H
#define IL_INPUT_MAP_SPOTS_H

#include "input/map-units.h"

/* A point by itself that belongs to the feature of line L, Z NAN when it has none. */
il_status il_map_spots_add(il_map *m, const il_map_line *l, double x, double y, double z, long line, il_error *err);

/* Longitudes of the turn that the lines are in, once that is known; points that are none
 * on a globe are left out. */
void il_map_spots_turn(il_map *m);

/* The height of each in the unit of the stack: what stands at the place that gives the
 * lines theirs, by BY_PLACE, else its own z, by BY_Z, unless that is 0 in all points that
 * would need it.  Those without are left out.  IL_E_INPUT when one leaves 1e15. */
il_status il_map_spots_convert(il_map *m, const il_map_scale *by_place, const il_map_scale *by_z, il_error *err);

/* Into the plane of P; points that are too far off for it are left out. */
il_status il_map_spots_project(il_map *m, const il_projection *p, il_error *err);

#endif
