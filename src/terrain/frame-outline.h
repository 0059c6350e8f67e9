/* frame-outline.h - a frame that the user draws. */
#ifndef IL_TERRAIN_FRAME_OUTLINE_H
#define IL_TERRAIN_FRAME_OUTLINE_H

#include "terrain/frame-sides.h"

/* Add the rings of O's outline to S, those in degrees projected like the map with head
 * HEAD, in chords that are off by at most a millionth of the outline; S's slack is how far.
 * LINES: the box of the map's.  IL_E_INPUT where nobody knows how the map was projected,
 * IL_E_NOMEM. */
il_status il_frame_outline_add(il_frame_sides *s, const il_frame_options *o, const il_stack_head *head,
                               const double lines[4], il_error *err);

#endif
