/* joiner.h - the pieces of isolines put together, as a stage.
 *
 * Maps come cut: at the edges of sheets, at lakes, by length, by whoever drew them.
 * Level by level, lines whose ends coincide become one line, and a line that comes
 * back to its beginning becomes a ring. */
#ifndef IL_REGION_JOINER_H
#define IL_REGION_JOINER_H

#include "model/report.h"
#include "model/sink.h"

/* distance: ends no farther apart than this are joined as well, by a straight
 * edge, in the unit of the stack; 0: only those that coincide. */
typedef struct il_join_options { double distance; } il_join_options;

/* A sink that joins the lines of each slice of terrain and passes all on to NEXT
 * (borrowed); solids pass untouched.  Counts into REPORT (may be null). */
il_status il_joiner_new(il_sink **out, const il_join_options *o, il_sink *next, il_report *report, il_error *err);
void il_joiner_free(il_sink *s); /* null is fine */

#endif
