/* map-heights.h - where the heights of a map stand.
 *
 * One place serves the whole set, the first of these that tells two levels or more
 * apart:
 *     --height NAME
 *     two attributes that are the lower and the upper height of polygons
 *     an attribute of a usual name (map-names.h), which half of the lines have
 *     the z coordinates, unless they are all 0
 *     the place that the format has for it (il_map_place) */
#ifndef IL_INPUT_MAP_HEIGHTS_H
#define IL_INPUT_MAP_HEIGHTS_H

#include "input/map-data.h"
#include "input/map-value.h"

/* May the attribute NAME be a height, by O and by its name? */
bool il_map_heights_wants(const il_read_options *o, const char *name, size_t n);

/* Read the height TEXT[0..N); where the user named the attribute the number may stand
 * among words. */
bool il_map_heights_value(const il_read_options *o, const char *text, size_t n, il_map_value *out);

/* Choose the place, and give every line its height, as the file has it; lines
 * without one, and lines along which it varies, are left out and counted.
 * IL_E_INPUT when this is no set of isolines. */
il_status il_map_find_heights(il_map *m, il_error *err);

#endif
