/* map-units.h - the heights of a map in the unit of its stack.
 *
 * A stack has one unit, that of x and y; with degrees heights are metres.  The unit of
 * heights is, in this order: --z-unit, that of the attribute (depth_ft, "10 m"), the
 * vertical one of the coordinate system, metres with degrees, that of x and y. */
#ifndef IL_INPUT_MAP_UNITS_H
#define IL_INPUT_MAP_UNITS_H

#include "input/map-data.h"

/* Settle m->unit, convert the heights, turn depths over, make levels that differ by
 * decimals only one, and tell all that.  IL_E_INPUT when a height leaves 1e15, or there
 * is one level only and nothing tells which side is high; IL_E_NOMEM. */
il_status il_map_settle_units(il_map *m, il_error *err);

/* How heights at one place become those of the stack. */
typedef struct il_map_scale {
    il_unit from, to;
    bool down;
} il_map_scale;

/* *Z by S; LINE of FILE is where it stands.  IL_E_INPUT when it leaves 1e15. */
il_status il_map_scale_height(const il_map_scale *s, double *z, const char *file, long line, il_error *err);

#endif
