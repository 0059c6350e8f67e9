/* boundary.h - from a tangle of edges to the clean boundary of its even-odd region. */
#ifndef IL_REGION_BOUNDARY_H
#define IL_REGION_BOUNDARY_H

#include "model/stack.h"
#include "model/arrange.h"

/* The even-odd region of the settled arrangement A as rings appended to OUT
 * (empty before): region on the left, every ring simple, each starting at its
 * least vertex (x, then y), rings sorted by their vertices.  Edges that come
 * an even number of times bound nothing: *CANCELLED counts them.  *PINCHES:
 * nodes that the boundary passes more than once.
 * Triangulates and floods, O(n log n). */
il_status il_boundary_extract(const il_arrangement *a, il_slice *out,
                              size_t *cancelled, size_t *pinches, il_error *err);

#endif
