/* gapper.h - the stage that says where a stack is broken off, and thickens slices
 * that stand alone. */
#ifndef IL_REGION_GAPPER_H
#define IL_REGION_GAPPER_H

#include "model/report.h"
#include "model/sink.h"

/* What becomes of two neighbouring slices more than IL_GAP_SPACINGS usual
 * spacings apart.  AS_GIVEN: nothing; the stream says where a gap is.  BRIDGE:
 * they are joined, and so is what the stream calls a gap.  CAP: they become a gap
 * (model/pair.h), whatever the stream has to say of the two.  FAIL: the stack has
 * a fault, as it has where the stream says that there is a gap. */
typedef enum il_gap_mode { IL_GAPS_AS_GIVEN, IL_GAPS_BRIDGE, IL_GAPS_CAP, IL_GAPS_FAIL } il_gap_mode;

/* thickness: of a slice that nothing is joined to, in the unit that the input
 * was read in; 0 takes the stack's usual spacing, or, where it has none, that of
 * the set that it came from, or 1 mm, which is told.  drop_empty: slices without
 * rings are no information, and dropped; else they bound the solid. */
typedef struct il_gap_options {
    il_gap_mode mode;
    double thickness;
    bool drop_empty;
} il_gap_options;

#define IL_GAP_OPTIONS_INIT { IL_GAPS_AS_GIVEN, 0, false }

/* A sink that marks the gaps of every stack of kind solid, and puts a copy of a
 * slice without neighbours half the thickness below and above it (counted in
 * REPORT, vertices marked as inserted; never farther than 0.45 of a gap).  Pairs of
 * joined slices pass.  It holds a stack until its end; what is wrong with it is
 * told as the fault of its head.  Slices come clean and in rising z.
 * NEXT is borrowed.  Memory: the stack. */
il_status il_gapper_new(il_sink **out, const il_gap_options *o, il_sink *next, il_report *report, il_error *err);
void il_gapper_free(il_sink *s); /* null is fine */

#endif
