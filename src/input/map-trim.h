/* map-trim.h - ends of lines that lie on an edge of another line. */
#ifndef IL_INPUT_MAP_TRIM_H
#define IL_INPUT_MAP_TRIM_H

#include "input/map-data.h"

/* Where sheets overlap and were clipped, a line of one ends within an edge of the other:
 * its last edge begins where that edge does and runs along it, but not as far.  Take such
 * last edges off, so that the lines meet in vertices that both have.  Lines of which
 * nothing is left are dropped.  Heights have to be settled, and x and y be those of the
 * files, in which edges are straight.  Expected O(n); IL_E_NOMEM. */
il_status il_map_trim(il_map *m, il_error *err);

#endif
