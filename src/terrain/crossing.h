/* crossing.h - lines that cross or run through one another's points. */
#ifndef IL_TERRAIN_CROSSING_H
#define IL_TERRAIN_CROSSING_H

#include "terrain/chart.h"

/* Make a planar graph of C, whose edges may cross: they are divided where they do (model/arrange.h).
 * A point where lines of one level cross, or a line and the frame, becomes a node like any
 * other; where two levels meet, CLASHES is told of the lines.  line[n_lines]: as for
 * il_chart_build; owners beyond are interpolated lines.  IL_E_INPUT when that does not
 * settle; IL_E_NOMEM. */
il_status il_chart_divide(il_chart *c, const il_chart_line *line, size_t n_lines, bool round_float,
                          il_clashes *clashes, il_error *err);

#endif
