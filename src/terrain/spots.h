/* spots.h - spot heights as points of the chart. */
#ifndef IL_TERRAIN_SPOTS_H
#define IL_TERRAIN_SPOTS_H

#include "terrain/complaint.h"
#include "terrain/tin.h"

/* Put the spots of HEAD into C, but for those that out[] marks: node[i] of each, or
 * IL_CHART_NONE.  False without memory. */
bool il_spots_add(il_chart *c, const il_stack_head *head, const il_placement_options *o,
                  const unsigned char *out, uint32_t *node);

/* Which of them fit between the lines?  A spot stands inside the frame, in its face's band or at
 * an end of it, and on a line only at the line's height.  Those that do not are left out:
 * out[i] is set, their node has no height any more, and the complaint says why.  IL_E_NOMEM. */
il_status il_spots_judge(il_chart *c, const il_tin *t, const il_band *band, const il_complaint *complaint,
                         unsigned char *out, uint32_t *node, il_error *err);

#endif
