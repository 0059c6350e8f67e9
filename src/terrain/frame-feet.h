/* frame-feet.h - which of the ends near a frame are led there, and to where. */
#ifndef IL_TERRAIN_FRAME_FEET_H
#define IL_TERRAIN_FRAME_FEET_H

#include "terrain/frame-stops.h"

/* Lead the loose ends of O straight to the frame, where the way crosses and touches no
 * line and no other such way: to the nearest place or, where something is in the way or a
 * line of another level meets the frame there, a little beside it.  They become stops and
 * go to OUT's ends; the others lie inside.  O(n log n) for n vertices, as ways that come
 * near hundreds of edges are none.  IL_E_NOMEM. */
il_status il_feet_settle(il_stops *o, il_frame *out, const il_frame_sides *s,
                         const il_slice *level, size_t n_levels, il_error *err);

#endif
