/* frame-hull.h - the convex hull of all lines of a map. */
#ifndef IL_TERRAIN_FRAME_HULL_H
#define IL_TERRAIN_FRAME_HULL_H

#include "terrain/frame-sides.h"

/* Add the hull of the vertices of level[n_levels] to S: its corners, each of which turns.
 * Exact; O(n log n), but most vertices are only seen to lie well inside.  Nothing is added
 * where they enclose nothing.  IL_E_NOMEM. */
il_status il_frame_hull_add(il_frame_sides *s, const il_slice *level, size_t n_levels, il_error *err);

#endif
