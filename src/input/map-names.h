/* map-names.h - what the name of an attribute says of the heights in it. */
#ifndef IL_INPUT_MAP_NAMES_H
#define IL_INPUT_MAP_NAMES_H

#include "model/stack.h"

/* LOW, HIGH: one of the two heights of a band ("elev_min"). */
typedef enum il_map_end { IL_MAP_END_NONE, IL_MAP_END_LOW, IL_MAP_END_HIGH } il_map_end;

/* rank: its place among the usual names, from 0; the lowest is asked first.  unit: of
 * a suffix such as _ft or (m).  is_depth: the name is one of depths. */
typedef struct il_map_name {
    int rank;
    bool has_unit, is_depth;
    il_unit unit;
    il_map_end end;
} il_map_name;

/* Read NAME[0..N), without regard to case: words joined by _ - . or blanks, a usual
 * name of heights among them, and besides only units and words for the ends of a
 * band.  False when it is no usual name. */
bool il_map_name_read(const char *name, size_t n, il_map_name *out);

#endif
