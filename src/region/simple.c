#include "config.h"
#include "region/simple.h"
#include "bridge/predicates.h"
#include "model/order.h"

static const double *vertex(const il_ring *r, size_t i)
{
    return r->xy + 2 * i;
}

/* The least vertex by x, then y: its neighbours lie to one side of it, and not on
 * one ray, or the ring would touch itself. */
static size_t least_vertex(const il_ring *r)
{
    size_t least = 0;
    for (size_t i = 1; i < r->n; i++) {
        const double *p = vertex(r, i), *q = vertex(r, least);
        if (p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]))
            least = i;
    }
    return least;
}

static bool is_counter_clockwise(const il_ring *r, size_t least)
{
    size_t before = (least == 0 ? r->n : least) - 1, after = least + 1 == r->n ? 0 : least + 1;
    return il_orientation(vertex(r, before), vertex(r, least), vertex(r, after)) > 0;
}

/* Does R go round P, which is not on it?  By the edges that a ray from P to the
 * right crosses; an edge has its lower end and not its upper one. */
static bool surrounds(const il_ring *r, const double *p)
{
    bool inside = false;
    const double *a = vertex(r, r->n - 1);
    for (size_t i = 0; i < r->n; i++) {
        const double *b = vertex(r, i);
        bool rises = a[1] <= p[1] && p[1] < b[1], falls = b[1] <= p[1] && p[1] < a[1];
        if (rises || falls)
            inside ^= il_orientation(a, b, p) == (rises ? 1 : -1);
        a = b;
    }
    return inside;
}

/* Turn ring I of S if the region is on its right: a ring inside an odd number of
 * others bounds a hole. */
static bool turn(il_slice *s, size_t i)
{
    il_ring *r = &s->ring[i];
    size_t least = least_vertex(r);
    bool is_hole = false;
    for (size_t k = 0; k < s->n; k++)
        is_hole ^= k != i && surrounds(&s->ring[k], vertex(r, least));
    if (is_counter_clockwise(r, least) != is_hole)
        return false;
    il_ring_reverse(r);
    return true;
}

static bool copy_ring(il_ring *to, il_ring *from)
{
    il_ring_take_origin(to, from);
    il_extra_move(&to->extra, &from->extra);
    for (size_t i = 0; i < from->n; i++)
        if (!il_ring_add(to, vertex(from, i)[0], vertex(from, i)[1], from->mark ? from->mark[i] : 0))
            return false;
    return true;
}

il_status il_slice_take_simple(il_slice *out, il_slice *s, size_t *turned, il_error *err)
{
    *turned = 0;
    for (size_t i = 0; i < s->n; i++) {
        il_ring *from = &s->ring[i];
        il_ring *to = from->n > 0 ? il_slice_add_ring(out) : NULL;
        if (from->n == 0)
            il_extra_move(&out->extra, &from->extra);
        else if (!to || !copy_ring(to, from))
            return il_fail_nomem(err);
    }
    for (size_t i = 0; i < out->n; i++)
        *turned += turn(out, i);
    il_slice_put_in_order(out);
    return IL_OK;
}
