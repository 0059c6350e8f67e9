#include "config.h"
#include "model/order.h"

#include <stdlib.h>

static size_t wrapped(size_t i, size_t n)
{
    return i < n ? i : i - n;
}

/* Two candidates I and J run against each other; K vertices of theirs agree.
 * The loser of a comparison loses all starts up to there, so that every vertex
 * is passed at most twice, whatever repeats. */
size_t il_ring_first(const il_ring *r)
{
    size_t n = r->open ? 0 : r->n, i = 0, j = 1, k = 0;
    while (i < n && j < n && k < n) {
        int c = il_vertex_compare(&r->xy[2 * wrapped(i + k, n)], &r->xy[2 * wrapped(j + k, n)]);
        if (c == 0) {
            k++;
            continue;
        }
        if (c > 0)
            i += k + 1;
        else
            j += k + 1;
        if (i == j)
            j++;
        k = 0;
    }
    return i < j ? i : j;
}

static int compare_sequences(const il_ring_order *a, const il_ring_order *b)
{
    size_t na = a->ring->n, nb = b->ring->n, n = na < nb ? na : nb;
    for (size_t k = 0; k < n; k++) {
        int c = il_vertex_compare(&a->ring->xy[2 * wrapped(a->first + k, na)],
                                  &b->ring->xy[2 * wrapped(b->first + k, nb)]);
        if (c != 0)
            return c;
    }
    return na == nb ? 0 : na < nb ? -1 : 1;
}

int il_ring_order_compare(const void *va, const void *vb)
{
    const il_ring_order *a = va, *b = vb;
    if (a->ring->open != b->ring->open)
        return a->ring->open ? 1 : -1;
    int c = compare_sequences(a, b);
    if (c == 0)
        c = a->index < b->index ? -1 : a->index > b->index;
    return c;
}

bool il_slice_in_order(const il_slice *s)
{
    for (size_t i = 0; i < s->n; i++) {
        if (il_ring_first(&s->ring[i]) != 0)
            return false;
        il_ring_order here = { &s->ring[i], 0, i }, before = { &s->ring[i > 0 ? i - 1 : 0], 0, i > 0 ? i - 1 : 0 };
        if (i > 0 && il_ring_order_compare(&before, &here) > 0)
            return false;
    }
    return true;
}

static int compare_turned(const void *a, const void *b)
{
    il_ring_order p = { a, 0, 0 }, q = { b, 0, 0 };
    return il_ring_order_compare(&p, &q);
}

void il_slice_put_in_order(il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        il_ring_rotate(&s->ring[i], il_ring_first(&s->ring[i]));
    if (s->n > 1)
        qsort(s->ring, s->n, sizeof *s->ring, compare_turned);
}
