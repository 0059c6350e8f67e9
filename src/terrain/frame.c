#include "config.h"
#include "terrain/frame.h"
#include "base/alloc.h"
#include "terrain/frame-feet.h"
#include "terrain/frame-sides.h"
#include "terrain/frame-stops.h"

#include <math.h>
#include <stdlib.h>

void il_frame_free(il_frame *f)
{
    il_slice_free(&f->rings);
    il_free(f->end);
    il_free(f->inside);
    *f = (il_frame)IL_FRAME_INIT;
}

static int compare_ends(const void *a, const void *b)
{
    const il_frame_end *p = a, *q = b;
    if (p->level != q->level)
        return p->level < q->level ? -1 : 1;
    if (p->ring != q->ring)
        return p->ring < q->ring ? -1 : 1;
    return p->last - q->last;
}

/* ---- rings -------------------------------------------------------------------- */

/* The rings as they grow along the sides; stop[n] are sorted, first[k] .. first[k + 1] are
 * those of side k. */
typedef struct course {
    const il_frame_sides *sides;
    const il_stop *stop;
    size_t *first;
    il_ring *ring;
} course;

static bool is_near(const course *c, const double *p, const double *q)
{
    return fabs(p[0] - q[0]) <= c->sides->rounding && fabs(p[1] - q[1]) <= c->sides->rounding;
}

/* A corner that a vertex of a line is, within rounding: that one stands for it. */
static bool is_replaced(const course *c, size_t k)
{
    const il_frame_side *side = &c->sides->side[k];
    for (int turn = 0; turn < 2; turn++) {
        size_t s = turn ? side->before : k;
        if (c->first[s] == c->first[s + 1])
            continue;
        const il_stop *stop = &c->stop[turn ? c->first[s + 1] - 1 : c->first[s]];
        if (stop->kind != IL_STOP_BULGE && is_near(c, stop->at, side->a))
            return true;
    }
    return false;
}

static bool add_place(course *c, const double p[2])
{
    const il_ring *r = c->ring;
    if (r->n > 0 && r->xy[2 * r->n - 2] == p[0] && r->xy[2 * r->n - 1] == p[1])
        return true;
    return il_ring_add(c->ring, p[0], p[1], 0);
}

/* A bulge next to another place is none. */
static bool is_idle(const course *c, size_t i, size_t k)
{
    const il_stop *s = &c->stop[i];
    if (s->kind != IL_STOP_BULGE)
        return false;
    return (i > c->first[k] && is_near(c, s->at, s[-1].at)) || is_near(c, s->at, c->sides->side[k].a) ||
           (i + 1 < c->first[k + 1] && s[1].kind != IL_STOP_BULGE && is_near(c, s->at, s[1].at)) ||
           is_near(c, s->at, c->sides->side[k].b);
}

static bool add_side(course *c, size_t k)
{
    bool ok = is_replaced(c, k) || add_place(c, c->sides->side[k].a);
    for (size_t i = c->first[k]; i < c->first[k + 1] && ok; i++)
        ok = is_idle(c, i, k) || add_place(c, c->stop[i].at);
    return ok;
}

/* The last place is not the first. */
static void close_ring(il_ring *r)
{
    while (r->n > 1 && r->xy[0] == r->xy[2 * r->n - 2] && r->xy[1] == r->xy[2 * r->n - 1])
        r->n--;
}

static bool add_rings(course *c, il_slice *rings)
{
    bool ok = true;
    for (size_t k = 0; k < c->sides->n && ok; k++) {
        if (c->sides->side[k].before >= k) {
            c->ring = il_slice_add_ring(rings);
            ok = c->ring != NULL;
        }
        ok = ok && add_side(c, k);
        if (ok && c->sides->side[k].next <= k)
            close_ring(c->ring);
    }
    return ok;
}

static il_status make_rings(il_frame *out, const il_frame_sides *s, il_stops *o, il_error *err)
{
    course c = { .sides = s, .stop = o->stop, .first = il_alloc(s->n + 1, sizeof *c.first) };
    if (!c.first)
        return il_fail_nomem(err);
    if (o->n > 0)
        qsort(o->stop, o->n, sizeof *o->stop, il_stop_compare);
    for (size_t k = 0, i = 0; k <= s->n; k++) {
        while (i < o->n && o->stop[i].side < k)
            i++;
        c.first[k] = i;
    }
    bool ok = add_rings(&c, &out->rings);
    il_free(c.first);
    return ok ? IL_OK : il_fail_nomem(err);
}

static void measure(il_frame *f)
{
    f->box[0] = f->box[1] = INFINITY;
    f->box[2] = f->box[3] = -INFINITY;
    for (size_t r = 0; r < f->rings.n; r++)
        for (size_t k = 0; k < 2 * f->rings.ring[r].n; k++) {
            double x = f->rings.ring[r].xy[k];
            f->box[k % 2] = fmin(f->box[k % 2], x);
            f->box[2 + k % 2] = fmax(f->box[2 + k % 2], x);
        }
}

il_status il_frame_make(il_frame *out, const il_frame_options *o, const il_stack_head *head,
                        const il_slice *level, size_t n_levels, il_error *err)
{
    il_frame_sides sides = IL_FRAME_SIDES_INIT;
    il_stops stops = IL_STOPS_INIT;
    *out = (il_frame)IL_FRAME_INIT;
    il_status st = il_frame_sides_make(&sides, o, head, level, n_levels, err);
    double reach = IL_FRAME_REACH * fmin(sides.box[2] - sides.box[0], sides.box[3] - sides.box[1]);
    if (st == IL_OK)
        st = il_stops_find(&stops, out, &sides, reach, level, n_levels, err);
    if (st == IL_OK)
        st = il_feet_settle(&stops, out, &sides, level, n_levels, err);
    if (st == IL_OK)
        st = make_rings(out, &sides, &stops, err);
    out->took_degrees = sides.took_degrees;
    il_frame_sides_free(&sides);
    il_stops_free(&stops);
    if (st != IL_OK) {
        il_frame_free(out);
        return st;
    }
    if (out->n_ends > 0)
        qsort(out->end, out->n_ends, sizeof *out->end, compare_ends);
    if (out->n_inside > 0)
        qsort(out->inside, out->n_inside, sizeof *out->inside, compare_ends);
    measure(out);
    return IL_OK;
}
