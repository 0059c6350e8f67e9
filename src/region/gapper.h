/* gapper.h - the stage that says where a stack is broken off, and thickens slices
 * that stand alone. */
#ifndef IL_REGION_GAPPER_H
#define IL_REGION_GAPPER_H

#include "isoloft.h"
#include "model/report.h"
#include "model/sink.h"

/* mode: AS_GIVEN says nothing; BRIDGE joins what the stream calls a gap, too; CAP
 * makes a gap record (model/pair.h) of whatever the stream has to say of two slices
 * with a gap (model/spacing.h); FAIL takes that, and a gap record, for a fault.
 * thickness: of a slice that nothing is joined to, in the unit that the input
 * was read in; 0 takes the stack's usual spacing, or, where it has none, that of
 * the set that it came from, or 1 mm, which is told.  drop_empty: slices without
 * rings are no information, and dropped; else they bound the solid. */
typedef struct il_gap_options {
    il_gap_mode mode;
    double thickness;
    bool drop_empty;
} il_gap_options;

#define IL_GAP_OPTIONS_INIT { IL_GAPS_AS_GIVEN, 0, false }

/* Complete O for input that is a structure set, or not: such sets lack slices as a
 * matter of course, so that gaps are closed where nothing else is said; what
 * streams one slice at a time goes on doing so unless it is asked for.  Is the
 * stage needed? */
bool il_gap_options_settle(il_gap_options *o, bool is_set);

/* A sink that marks the gaps of every stack of kind solid, and puts a copy of a
 * slice without neighbours half the thickness below and above it (counted in
 * REPORT, vertices marked as inserted; never farther than 0.45 of a gap).  Pairs of
 * joined slices pass.  It holds a stack until its end; what is wrong with it is
 * told as the fault of its head.  Slices come clean and in rising z.
 * NEXT is borrowed.  Memory: the stack. */
il_status il_gapper_new(il_sink **out, const il_gap_options *o, il_sink *next, il_report *report, il_error *err);
void il_gapper_free(il_sink *s); /* null is fine */

#endif
