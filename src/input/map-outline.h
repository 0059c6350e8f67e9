/* map-outline.h - polygons and closed lines that are no map, but the edge of one. */
#ifndef IL_INPUT_MAP_OUTLINE_H
#define IL_INPUT_MAP_OUTLINE_H

#include "input/map-data.h"

/* All closed lines of M, whatever their heights, are one level, 0; others, and points by
 * themselves, are left out and counted.  Degrees stay.  IL_E_INPUT when none is closed. */
il_status il_map_take_outline(il_map *m, il_error *err);

#endif
