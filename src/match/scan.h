/* scan.h - the area that two parts of the plane have in common, by lengths along lines. */
#ifndef IL_MATCH_SCAN_H
#define IL_MATCH_SCAN_H

#include "base/nearest.h"

#include <stdint.h>

/* Lines through a box, evenly, the first half a step above its low side.  Of figures with
 * horizontal edges the area is found to within a 256th of the box's height along them, of
 * others much better. */
enum { IL_SCAN_LINES = 256 };

typedef struct il_crossing { double x; uint16_t line; unsigned char side; signed char enters; } il_crossing;

/* Where edges cross the lines.  no_memory: not all of them are here. */
typedef struct il_scan {
    double box[4], step;
    il_crossing *crossing;   size_t n, cap;
    bool no_memory;
} il_scan;

#define IL_SCAN_INIT { .n = 0 }
void il_scan_free(il_scan *s); /* safe twice */

/* Nothing crosses yet; BOX: least x and y, greatest x and y. */
void il_scan_begin(il_scan *s, const double box[4]);

/* An edge of figure SIDE, 0 or 1, which lies on its left.  Edges that lie above, below or to the
 * right of the box need not be told. */
void il_scan_add(il_scan *s, int side, const il_segment *e);

/* Within the box, unit^2: of figure 0, and of what it has in common with figure 1, all of whose
 * edges were added.  Whatever edges do (meet, coincide, end on each other) only rounds.
 * O(n log n) for n crossings; IL_E_NOMEM. */
il_status il_scan_measure(il_scan *s, double *own, double *common, il_error *err);

#endif
