/* map-heights.h - where the heights of a map stand.
 *
 * One place serves the whole set, the first of these that tells two lines or more
 * apart:
 *     --height NAME
 *     an attribute of a usual name (map-names.h), which half of the features have
 *     the z coordinates, unless they are all 0
 *     the place that the format has for it (il_map_place)
 * The choice is reported. */
#ifndef IL_INPUT_MAP_HEIGHTS_H
#define IL_INPUT_MAP_HEIGHTS_H

#include "input/map-data.h"
#include "input/map-value.h"

/* May the attribute NAME be a height, by O and by its name? */
bool il_map_heights_wants(const il_read_options *o, const char *name, size_t n);

/* Give every line its height, as the file has it; lines without one, and lines along
 * which it varies, are left out and counted.  IL_E_INPUT when this is no set of
 * isolines. */
il_status il_map_find_heights(il_map *m, il_error *err);

#endif
