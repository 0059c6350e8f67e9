/* loose.h - lines that end inside the map. */
#ifndef IL_TERRAIN_LOOSE_H
#define IL_TERRAIN_LOOSE_H

#include "terrain/complaint.h"

/* Leave out of line[n_lines] those that part nothing: open ones with an end of FRAME's inside at
 * which not an even number of them, of one level, meets.  Where an odd number does, the
 * shortest goes, and what ended at its other end is looked at again; each is told.
 * O(n log n) for n ends.  IL_E_NOMEM. */
il_status il_loose_leave_out(il_chart_line *line, size_t n_lines, const il_slice *slice, const il_frame *frame,
                             const il_complaint *complaint, il_error *err);

#endif
