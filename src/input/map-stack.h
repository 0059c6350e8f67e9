/* map-stack.h - a map as a stack: slices by level. */
#ifndef IL_INPUT_MAP_STACK_H
#define IL_INPUT_MAP_STACK_H

#include "input/map-data.h"

/* Hand the lines that have a height to SINK as one stack of kind terrain, levels
 * rising, the lines of a level in file order. */
il_status il_map_emit(il_map *m, il_sink *sink, il_error *err);

#endif
