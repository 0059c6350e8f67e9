/* order.h - the one order of vertices and rings that equal slices share.
 *
 * Vertices are compared by x, then y; sequences of vertices by the first that
 * differ, a sequence before its continuations (formats/loft.txt, section 9). */
#ifndef IL_MODEL_ORDER_H
#define IL_MODEL_ORDER_H

#include "model/stack.h"

/* Of the vertices A and B, two numbers each: < 0 when A is the lesser, 0 when they
 * are equal. */
static inline int il_vertex_compare(const double *a, const double *b)
{
    if (a[0] != b[0])
        return a[0] < b[0] ? -1 : 1;
    return a[1] == b[1] ? 0 : a[1] < b[1] ? -1 : 1;
}

/* The vertex R begins with in canonical order: the one whose sequence is least,
 * the first of several.  0 for an open line, which can begin at one end only,
 * and for a ring without vertices.  O(n). */
size_t il_ring_first(const il_ring *r);

/* A ring, read from its vertex FIRST on. */
typedef struct il_ring_order {
    const il_ring *ring;
    size_t first;
    size_t index;           /* among the slice's rings */
} il_ring_order;

/* Closed before open, then by sequence, then by index: a total order, for qsort. */
int il_ring_order_compare(const void *a, const void *b);

/* Does every ring of S begin where it should, and follow the one before? */
bool il_slice_in_order(const il_slice *s);

/* Turn the rings of S so that each begins where it should, and sort them. */
void il_slice_put_in_order(il_slice *s);

#endif
