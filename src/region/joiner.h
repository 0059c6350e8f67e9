/* joiner.h - the pieces of isolines put together, as a stage.
 *
 * Maps come cut: at the edges of sheets, at lakes, by length, by whoever drew them;
 * sheets overlap, and some things are drawn twice.  Level by level
 *     repeated points, lines of a single point and dead ends, where a line goes and
 *     comes back over the same edges, are dropped
 *     stretches that are there several times, in either direction, are kept once
 *     ends that coincide are joined where there are two; more than two are a knot
 *     and stay apart, but for a line whose own ends come together there
 *     a line that comes back to its beginning becomes a ring; two points are none,
 *     and are dropped
 *     ends that lie apart by little are joined, if that is asked for
 * What comes out is in canonical order (model/order.h), does not depend on the order of
 * the lines that came, and comes out again when it is put in. */
#ifndef IL_REGION_JOINER_H
#define IL_REGION_JOINER_H

#include "model/report.h"
#include "model/sink.h"

/* distance: ends no farther apart than this are joined as well, by a straight
 * edge, in the unit of the stack; 0: only those that coincide. */
typedef struct il_join_options { double distance; } il_join_options;

/* Join the lines of S.  Counts into REPORT (may be null); *CHANGED (may be null) tells
 * whether anything is not as it was, be it only the order; *LARGEST grows to the
 * widest gap that was bridged.
 * Expected O(n) but for the sorting of lines.  IL_E_INPUT beyond 2^31 lines or 2^32 - 2
 * edges, IL_E_NOMEM; S can be freed then. */
il_status il_slice_join(il_slice *s, const il_join_options *o, il_report *report, bool *changed, double *largest,
                        il_error *err);

/* A sink that joins the lines of each slice of terrain and passes on to NEXT (borrowed)
 * those of which something is left; solids pass untouched.  Counts into REPORT (may be
 * null).  A pair is IL_E_INPUT when it names rings of a slice that was changed, or when
 * nothing is left of a slice. */
il_status il_joiner_new(il_sink **out, const il_join_options *o, il_sink *next, il_report *report, il_error *err);
void il_joiner_free(il_sink *s); /* null is fine */

#endif
