/* svg-join.h - open lines of one slice put together into rings. */
#ifndef IL_INPUT_SVG_JOIN_H
#define IL_INPUT_SVG_JOIN_H

#include "model/stack.h"

/* What became of the open lines: n_joined of them make up rings with others,
 * n_closed were closed by a straight edge, n_dropped (single segments that
 * bound nothing, the first of them in line DROPPED_LINE) are gone. */
typedef struct il_svg_joined {
    size_t n_joined, n_closed, n_dropped;
    long dropped_line;
} il_svg_joined;

/* Join open lines of S whose ends are equal, where a chain of them comes back to
 * its beginning; close the others by themselves.  Counts are added to *COUNT.
 * Ends that meet are paired in document order; where an odd number meets, the
 * last is left.
 * O(n log n) in the open lines. */
il_status il_svg_join(il_slice *s, il_svg_joined *count, il_error *err);

#endif
