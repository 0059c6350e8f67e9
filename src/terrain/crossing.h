/* crossing.h - lines that cross or run through one another's points. */
#ifndef IL_TERRAIN_CROSSING_H
#define IL_TERRAIN_CROSSING_H

#include "terrain/chart.h"

/* Make a planar graph of C, whose edges may cross: they are divided where they do
 * (model/arrange.h), and points where lines cross, or a line and the frame, become nodes like
 * any other.  IL_E_INPUT when that does not settle; IL_E_NOMEM. */
il_status il_chart_divide(il_chart *c, bool round_float, il_error *err);

#endif
