/* clean.h - slices made clean, as a stage: what every later stage relies on. */
#ifndef IL_REGION_CLEAN_H
#define IL_REGION_CLEAN_H

#include "model/report.h"
#include "model/sink.h"

/* round_float: coordinates are rounded to 32-bit floats first (STL holds no
 * more); that is counted as a repair, with the largest move.
 * keyhole: the sides of keyhole channels are at most this far apart, in the unit
 * of the stack, or in mm where keyhole_is_mm; 0: keyholes are not looked for.
 * For the stage only, which opens them (keyhole.h) before it cleans. */
typedef struct il_clean_options {
    bool round_float;
    double keyhole;
    bool keyhole_is_mm;
} il_clean_options;

/* Clean S in place: make one of points that only rounding tells apart; drop
 * repeated points, duplicate and degenerate rings; insert vertices where edges cross or touch;
 * take the region by even-odd parity; extract its boundary anew, region on the
 * left, every ring simple, in canonical order (each ring starts at its least
 * vertex by x, then y; rings sorted likewise).  Original vertices keep their
 * bits.  A clean slice is left as it is, bit for bit: the function is
 * idempotent.  Counts into REPORT (may be null); *CHANGED (may be null) tells
 * whether anything is not as it was, be it only the order.
 * IL_E_INPUT when crossings do not settle or a line is open; IL_E_NOMEM.  After
 * a failure S holds the input (a line was open) or nothing. */
il_status il_slice_clean(il_slice *s, const il_clean_options *o, il_report *report,
                         bool *changed, il_error *err);

/* A sink that cleans each slice of a solid and passes all on to NEXT (borrowed).  Slices
 * must come in rising z: equal heights are merged into one slice, and a falling
 * one is IL_E_INPUT, as is an equal one behind a pair, which closes the slice.  A
 * pair that names rings of a slice that needed repair or was merged is
 * IL_E_INPUT: its indices would mean other vertices. */
il_status il_cleaner_new(il_sink **out, const il_clean_options *o, il_sink *next,
                         il_report *report, il_error *err);
void il_cleaner_free(il_sink *s);

#endif
