/* keyhole.h - rings that go in along a channel, round a hole and back out, cut apart. */
#ifndef IL_REGION_KEYHOLE_H
#define IL_REGION_KEYHOLE_H

#include "model/report.h"
#include "model/stack.h"

/* The tolerance where nobody has said one, in mm: planning systems write two or
 * three decimals, and some draw the sides a few hundredths apart. */
#define IL_KEYHOLE_MM 0.05

/* Where a ring of S runs back along itself within TOLERANCE (unit of S) and has a
 * loop at either end, both sides are cut out: a ring of several loops becomes
 * several rings.  Vertices of the loops keep their bits; those of the channel are
 * dropped.  Islands in holes, holes hung on holes and many keyholes on a ring come
 * apart likewise; a tongue that runs out and back, with no loop at its end, stays.
 *
 * What is cut, with w the widest gap of the channel and t the tolerance:
 *  - it is at least 20 w and 4 t long.  Two smooth bulges of radius R that come
 *    near each other stay within t for 2 sqrt(t R) only, so one that is 20 t long
 *    has R >= 100 t, and 5 t behind its end the bulges are at most 2.25 t apart;
 *  - 5 t behind either end the sides are at least 2.5 t apart: they part in a
 *    corner (of 30 degrees), as no such bulges do;
 *  - it leads to no dead end: a last loop, to which no other channel goes, has ten
 *    times the area w times length, so that it and not the channel is what was
 *    drawn, and is 4 t wide in the mean (2 area / perimeter), so that it is no
 *    slit itself.
 * So a cut moves the outline by no more than t, and no area of more than w times length.
 *
 * Counts IL_REPAIR_KEYHOLE, one a channel, and the repeated points of rings that
 * were cut.  O(n log n).  IL_E_NOMEM, and S holds the same region then. */
il_status il_slice_open_keyholes(il_slice *s, double tolerance, il_report *report, il_error *err);

#endif
