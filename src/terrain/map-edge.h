/* map-edge.h - lines that were closed along the edge of the map. */
#ifndef IL_TERRAIN_MAP_EDGE_H
#define IL_TERRAIN_MAP_EDGE_H

#include "terrain/frame.h"

/* Some programs close isolines that leave the map along its edge, where the ground has any
 * height.  Mark such edges of the lines level[n_levels] of a terrain with head HEAD (IL_VERTEX_
 * MAP_EDGE): those that lie on the frame that O asks for.  The box of the lines (and, for
 * want of a better, of their hull) is taken for the map's edge where it has a corner on such a
 * line, or another line ends or runs on the same side: else a hill whose lowest line has an
 * edge that happens to be its southernmost would lose it.  Rings that lie on the frame as a
 * whole stay.  *N: how many edges were marked; none where there are no lines.  O(n log n).
 * IL_E_INPUT as of il_frame_make, IL_E_NOMEM. */
il_status il_map_edge_mark(il_slice *level, size_t n_levels, const il_frame_options *o, const il_stack_head *head,
                           size_t *n, il_error *err);

#endif
