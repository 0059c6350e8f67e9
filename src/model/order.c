#include "config.h"
#include "model/order.h"
#include "base/alloc.h"

#include <math.h>
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

/* first: vertex 0, which mostly decides, so that sorting seldom looks at the rings, which lie all over
 * the memory. */
typedef struct sort_key {
    bool open;
    double first[2];
    il_ring_order order;
} sort_key;

static int compare_keys(const void *va, const void *vb)
{
    const sort_key *a = va, *b = vb;
    if (a->open != b->open)
        return a->open ? 1 : -1;
    int c = il_vertex_compare(a->first, b->first);
    return c != 0 ? c : il_ring_order_compare(&a->order, &b->order);
}

/* KEY and SORTED have room for all rings. */
static void sort_rings(il_slice *s, sort_key *key, il_ring *sorted)
{
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        key[i] = (sort_key){ r->open, { r->n > 0 ? r->xy[0] : -INFINITY, r->n > 0 ? r->xy[1] : 0 }, { r, 0, i } };
    }
    qsort(key, s->n, sizeof *key, compare_keys);
    for (size_t i = 0; i < s->n; i++)
        sorted[i] = s->ring[key[i].order.index];
    il_free(s->ring);
    s->ring = sorted;
    s->cap = s->n;
}

static int compare_turned(const void *a, const void *b)
{
    il_ring_order p = { a, 0, 0 }, q = { b, 0, 0 };
    return il_ring_order_compare(&p, &q);
}

/* Without memory it takes longer. */
void il_slice_put_in_order(il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        il_ring_rotate(&s->ring[i], il_ring_first(&s->ring[i]));
    if (s->n < 2)
        return;
    sort_key *key = il_alloc(s->n, sizeof *key);
    il_ring *sorted = il_alloc(s->n, sizeof *sorted);
    if (key && sorted) {
        sort_rings(s, key, sorted);
    } else {
        il_free(sorted);
        qsort(s->ring, s->n, sizeof *s->ring, compare_turned);
    }
    il_free(key);
}
