/* split.h - triangles divided at points on their edges, nothing else changed. */
#ifndef IL_TERRAIN_SPLIT_H
#define IL_TERRAIN_SPLIT_H

#include "terrain/tin.h"

/* middle[3*n]: a node of C on each edge of T's triangles, or IL_CHART_NONE; the same from
 * both sides; none on edges of the chart.  Each triangle with middles becomes two to
 * four, which stand in its place one after the other and have its face.  Of two ways to divide, the one with the shorter
 * diagonal is taken.  False without memory; T is as it was then. */
bool il_tin_split(il_tin *t, const il_chart *c, const uint32_t *middle);

/* Would all of a triangle's parts turn counter-clockwise?  corner[3], middle[3] as above. */
bool il_split_is_sound(const il_chart *c, const uint32_t corner[3], const uint32_t middle[3]);

#endif
