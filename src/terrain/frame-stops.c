/* frame-stops.c - every vertex is shown to the sides whose boxes it lies in: few are. */
#include "config.h"
#include "terrain/frame-stops.h"
#include "base/alloc.h"
#include "bridge/predicates.h"
#include "terrain/frame-curves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void il_stops_free(il_stops *o)
{
    il_free(o->stop);
    il_free(o->loose);
    *o = (il_stops)IL_STOPS_INIT;
}

bool il_stops_add(il_stops *o, const il_stop *stop)
{
    if (!il_grow(&o->stop, &o->cap, o->n + 1, sizeof *o->stop))
        return false;
    o->stop[o->n++] = *stop;
    return true;
}

bool il_frame_add_end(il_frame *f, const il_frame_end *e)
{
    if (!il_grow(&f->end, &f->cap_ends, f->n_ends + 1, sizeof *f->end))
        return false;
    f->end[f->n_ends++] = *e;
    return true;
}

bool il_frame_add_inside(il_frame *f, const il_frame_end *e)
{
    if (!il_grow(&f->inside, &f->cap_inside, f->n_inside + 1, sizeof *f->inside))
        return false;
    f->inside[f->n_inside] = *e;
    memset(f->inside[f->n_inside++].foot, 0, sizeof e->foot);
    return true;
}

il_stop il_stop_at(const il_frame_sides *s, size_t k, double t, const double p[2], uint32_t level, il_stop_kind kind)
{
    if (t >= 1) {
        k = s->side[k].next;
        t = 0;
    }
    const il_frame_side *side = &s->side[k];
    bool is_backward = side->b[0] < side->a[0] || (side->b[0] == side->a[0] && side->b[1] < side->a[1]);
    return (il_stop){ { p[0], p[1] }, t, (uint32_t)k, level, (unsigned char)kind, is_backward };
}

int il_stop_compare(const void *a, const void *b)
{
    const il_stop *p = a, *q = b;
    if (p->side != q->side)
        return p->side < q->side ? -1 : 1;
    if (p->t != q->t)
        return p->t < q->t ? -1 : 1;
    int forward = p->at[0] != q->at[0] ? (p->at[0] < q->at[0] ? -1 : 1) : (p->at[1] > q->at[1]) - (p->at[1] < q->at[1]);
    return p->is_backward ? -forward : forward;
}

/* ---- one vertex ------------------------------------------------------------- */

typedef struct search {
    const double *p;
    size_t side;
    double slack;
} search;

/* Of a segment in whose box p lies. */
static bool lies_on(void *context, const il_segment *s)
{
    search *q = context;
    const double a[2] = { s->ax, s->ay }, b[2] = { s->bx, s->by };
    q->side = s->id;
    return il_orientation(a, b, q->p) == 0;
}

/* The side that P lies on exactly. */
static bool find_exactly(const il_frame_sides *s, const double *p, size_t *side)
{
    search q = { p, 0, 0 };
    const double box[4] = { p[0], p[1], p[0], p[1] };
    bool is_found = il_nearest_visit(&s->tree, 0, box, lies_on, &q);
    *side = q.side;
    return is_found;
}

/* How far along side K the place P lies, from 0 to 1.  Of a side along an axis exactly. */
static double share_of(const il_frame_sides *s, size_t k, const double *p)
{
    const il_frame_side *side = &s->side[k];
    double ux = side->b[0] - side->a[0], uy = side->b[1] - side->a[1], t;
    if (ux == 0 || uy == 0)
        t = ux == 0 ? (p[1] - side->a[1]) / uy : (p[0] - side->a[0]) / ux;
    else
        t = (ux * (p[0] - side->a[0]) + uy * (p[1] - side->a[1])) / (ux * ux + uy * uy);
    return fmin(fmax(t, 0), 1);
}

/* The place of side K at T, on it to the last bit where it runs along an axis. */
static void place_on(const il_frame_sides *s, size_t k, double t, const double *from, double at[2])
{
    const il_frame_side *side = &s->side[k];
    for (int c = 0; c < 2; c++) {
        double least = fmin(side->a[c], side->b[c]), most = fmax(side->a[c], side->b[c]);
        bool is_along = side->a[1 - c] == side->b[1 - c];
        at[c] = is_along ? from[c] : t >= 1 ? side->b[c] : side->a[c] + t * (side->b[c] - side->a[c]);
        at[c] = fmin(fmax(at[c], least), most);
    }
}

/* Is P, whose nearest place is at T of side K, on the map's side of it?  Nearest to a
 * corner are places outside of it, or inside where the frame bends away from them. */
static bool is_inside(const il_frame_sides *s, size_t k, double t, const double *p)
{
    if (t >= 1) {
        k = s->side[k].next;
        t = 0;
    }
    const il_frame_side *side = &s->side[k], *before = &s->side[side->before];
    int turn = t > 0 ? 0 : il_orientation(before->a, side->a, side->b);
    return turn != 0 ? turn < 0 : il_orientation(side->a, side->b, p) > 0;
}

/* ---- all of them ------------------------------------------------------------- */

/* Vertex V of ring R of a level; the ends of open lines alone are ends. */
typedef struct walk {
    il_stops *stops;
    il_frame *out;
    const il_frame_sides *sides;
    double reach;
    il_frame_end at;
} walk;

static il_status add_vertex(walk *w, size_t side, double t, const double *p, bool is_end, il_error *err)
{
    il_stop stop = il_stop_at(w->sides, side, t, p, w->at.level, IL_STOP_VERTEX);
    memcpy(w->at.foot, p, sizeof w->at.foot);
    if (!il_stops_add(w->stops, &stop) || (is_end && !il_frame_add_end(w->out, &w->at)))
        return il_fail_nomem(err);
    return IL_OK;
}

static il_status add_loose(walk *w, size_t side, double t, const double *at, const double *p, il_error *err)
{
    il_stops *o = w->stops;
    if (!il_grow(&o->loose, &o->cap_loose, o->n_loose + 1, sizeof *o->loose))
        return il_fail_nomem(err);
    o->loose[o->n_loose++] = (il_loose_end){ w->at, il_stop_at(w->sides, side, t, at, w->at.level, IL_STOP_FOOT),
                                             { p[0], p[1] }, hypot(p[0] - at[0], p[1] - at[1]) };
    return IL_OK;
}

static il_status take_end(walk *w, const double *p, il_error *err)
{
    const il_frame_sides *s = w->sides;
    il_nearest_place n;
    il_curve_place c;
    bool is_on = il_nearest_point(&s->tree, 0, p[0], p[1], &n) && n.distance <= s->slack;
    if (!is_on && !is_inside(s, n.id, n.t, p))
        return IL_OK;
    if (!is_on && n.distance > w->reach)
        return il_frame_add_inside(w->out, &w->at) ? IL_OK : il_fail_nomem(err);
    c = (il_curve_place){ .side = n.id, .t = share_of(s, n.id, p) };
    place_on(s, n.id, n.t, p, c.at);
    il_status st = s->is_curved ? il_frame_curves_locate(s, p, &c, err) : IL_OK;
    if (st != IL_OK)
        return st;
    return is_on ? add_vertex(w, c.side, c.t, p, true, err) : add_loose(w, c.side, c.t, c.at, p, err);
}

/* Of a segment that bends away from its chord: is p as near to it as the curve may be? */
static bool may_be_on(void *context, const il_segment *s)
{
    const search *q = context;
    double ux = s->bx - s->ax, uy = s->by - s->ay;
    return fabs(ux * (q->p[1] - s->ay) - uy * (q->p[0] - s->ax)) <= q->slack * hypot(ux, uy);
}

/* On a curve within rounding, or between that and its chord. */
static il_status take_near_curve(walk *w, const double *p, il_error *err)
{
    const il_frame_sides *s = w->sides;
    const double box[4] = { p[0] - s->slack, p[1] - s->slack, p[0] + s->slack, p[1] + s->slack };
    search q = { p, 0, s->slack };
    il_curve_place c;
    if (!il_nearest_visit(&s->tree, 0, box, may_be_on, &q))
        return IL_OK;
    il_status st = il_frame_curves_locate(s, p, &c, err);
    if (st != IL_OK)
        return st;
    if (c.is_on)
        return add_vertex(w, c.side, c.t, p, false, err);
    if (il_orientation(s->side[c.side].a, s->side[c.side].b, p) > 0)
        return IL_OK;
    il_stop bulge = il_stop_at(s, c.side, c.t, c.at, w->at.level, IL_STOP_BULGE);
    return il_stops_add(w->stops, &bulge) ? IL_OK : il_fail_nomem(err);
}

static il_status take_vertex(walk *w, const double *p, il_error *err)
{
    size_t side;
    if (w->sides->is_curved)
        return take_near_curve(w, p, err);
    return find_exactly(w->sides, p, &side) ? add_vertex(w, side, share_of(w->sides, side, p), p, false, err) : IL_OK;
}

static il_status take_line(walk *w, const il_ring *r, il_error *err)
{
    il_status st = IL_OK;
    for (size_t v = 0; v < r->n && st == IL_OK; v++) {
        bool is_end = r->open && (v == 0 || v + 1 == r->n);
        w->at.last = v > 0;
        st = is_end ? take_end(w, r->xy + 2 * v, err) : take_vertex(w, r->xy + 2 * v, err);
    }
    return st;
}

il_status il_stops_find(il_stops *o, il_frame *out, const il_frame_sides *s, double reach,
                        const il_slice *level, size_t n_levels, il_error *err)
{
    walk w = { .stops = o, .out = out, .sides = s, .reach = reach };
    il_status st = IL_OK;
    for (size_t i = 0; i < n_levels; i++)
        for (size_t r = 0; r < level[i].n && st == IL_OK; r++) {
            w.at.level = (uint32_t)i;
            w.at.ring = (uint32_t)r;
            st = take_line(&w, &level[i].ring[r], err);
        }
    return st;
}
