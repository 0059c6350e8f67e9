/* frame-feet.c - ways to the frame.
 *
 * Ways to the nearest places cross one another nowhere (each would be shorter by way of
 * the crossing), but they may end at one place, and lines may lie across.  Only lines
 * near a way are looked at. */
#include "config.h"
#include "terrain/frame-feet.h"
#include "base/alloc.h"
#include "bridge/predicates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places tried beside the nearest one.  A way that comes near more edges or ways than LOOKS
 * leads nowhere: this bounds the time where somebody makes thousands of them meet. */
enum { TRIES = 8, LOOKS = 256 };

/* An edge of a line, by the segment's number in the tree: of level `level`. */
typedef struct edge { double a[2], b[2]; uint32_t level; } edge;

/* order[n]: the loose ends along the frame, of one place the nearest first. */
typedef struct feet {
    il_stops *stops;
    const il_frame_sides *sides;
    edge *edge;             size_t n_edges, cap_edges;
    il_nearest near_ways, near_edges, ways;
    uint32_t *order;
    bool *is_led;
} feet;

/* ---- what lies across ---------------------------------------------------------- */

static bool is_same(const double *p, const double *q)
{
    return p[0] == q[0] && p[1] == q[1];
}

/* Is P, on one line with A and B, between them or at one of them? */
static bool is_between(const double *a, const double *b, const double *p)
{
    return fmin(a[0], b[0]) <= p[0] && p[0] <= fmax(a[0], b[0]) && fmin(a[1], b[1]) <= p[1] && p[1] <= fmax(a[1], b[1]);
}

/* Do A-B and C-D have a point in common? */
static bool do_meet(const double *a, const double *b, const double *c, const double *d)
{
    int abc = il_orientation(a, b, c), abd = il_orientation(a, b, d), cda = il_orientation(c, d, a), cdb = il_orientation(c, d, b);
    return (abc * abd < 0 && cda * cdb < 0) || (abc == 0 && is_between(a, b, c)) || (abd == 0 && is_between(a, b, d)) ||
           (cda == 0 && is_between(c, d, a)) || (cdb == 0 && is_between(c, d, b));
}

/* Do Q and R lie in the same direction from P? */
static bool run_together(const double *p, const double *q, const double *r)
{
    return il_orientation(p, q, r) == 0 && (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]) > 0;
}

/* A way from `from` to `to`, of level `level`; number: of the loose end.  is_shared: lines
 * of its own level may end where it does.  is_moved: not to the nearest place. */
typedef struct way {
    const feet *feet;
    const double *from, *to;
    uint32_t level, number, side;
    bool is_shared, is_moved;
    int looks;
} way;

static bool blocks(void *context, const il_segment *s)
{
    way *w = context;
    const edge *e = &w->feet->edge[s->id];
    if (++w->looks > LOOKS)
        return true;
    for (int k = 0; k < 2; k++) {
        const double *here = k ? e->b : e->a, *there = k ? e->a : e->b;
        if (is_same(here, w->from))
            return run_together(here, w->to, there);
        if (is_same(here, w->to) && w->is_shared && e->level == w->level)
            return run_together(here, w->from, there);
    }
    return do_meet(w->from, w->to, e->a, e->b);
}

/* Does S, a side of the frame, lie across, and not only its place there? */
static bool fences(void *context, const il_segment *s)
{
    const way *w = context;
    const double a[2] = { s->ax, s->ay }, b[2] = { s->bx, s->by };
    return s->id != w->side && do_meet(w->from, w->to, a, b);
}

static bool is_free(way *w)
{
    w->looks = 0;
    return !il_nearest_visit_along(&w->feet->near_edges, 0, w->from, w->to, blocks, w) &&
           !(w->is_moved && il_nearest_visit_along(&w->feet->sides->tree, 0, w->from, w->to, fences, w));
}

/* ---- lines near the ways -------------------------------------------------------- */

/* All that may be tried for a loose end lies no farther from it than twice its way. */
static il_status find_ways(feet *f, il_error *err)
{
    const il_stops *o = f->stops;
    il_segment *segment = il_alloc(o->n_loose, sizeof *segment);
    if (!segment)
        return il_fail_nomem(err);
    for (size_t k = 0; k < o->n_loose; k++) {
        const il_loose_end *l = &o->loose[k];
        double reach = 2 * l->distance;
        segment[k] = (il_segment){ l->from[0] - reach, l->from[1] - reach, l->from[0] + reach, l->from[1] + reach, 0, k };
    }
    return il_nearest_build(&f->near_ways, segment, o->n_loose, 1, err);
}

static bool say_true(void *context, const il_segment *s)
{
    (void)context;
    (void)s;
    return true;
}

static bool take_edge(feet *f, const double *a, const double *b, uint32_t level)
{
    if (!il_nearest_visit_along(&f->near_ways, 0, a, b, say_true, NULL))
        return true;
    if (!il_grow(&f->edge, &f->cap_edges, f->n_edges + 1, sizeof *f->edge))
        return false;
    f->edge[f->n_edges++] = (edge){ { a[0], a[1] }, { b[0], b[1] }, level };
    return true;
}

static il_status find_edges(feet *f, const il_slice *level, size_t n_levels, il_error *err)
{
    for (size_t i = 0; i < n_levels; i++)
        for (size_t k = 0; k < level[i].n; k++) {
            const il_ring *r = &level[i].ring[k];
            for (size_t v = 0; v + 1 < r->n + !r->open; v++)
                if (!take_edge(f, r->xy + 2 * v, r->xy + 2 * ((v + 1) % r->n), (uint32_t)i))
                    return il_fail_nomem(err);
        }
    il_segment *segment = il_alloc(f->n_edges, sizeof *segment);
    if (!segment)
        return il_fail_nomem(err);
    for (size_t k = 0; k < f->n_edges; k++) {
        const edge *e = &f->edge[k];
        segment[k] = (il_segment){ e->a[0], e->a[1], e->b[0], e->b[1], 0, k };
    }
    return il_nearest_build(&f->near_edges, segment, f->n_edges, 1, err);
}

/* ---- places on the frame ---------------------------------------------------------- */

/* A stop or, with its number, a loose end. */
typedef struct item { il_stop stop; double distance; uint32_t loose; } item;

static int compare_items(const void *a, const void *b)
{
    const item *p = a, *q = b;
    int c = il_stop_compare(&p->stop, &q->stop);
    if (c != 0)
        return c;
    if (p->distance != q->distance)
        return p->distance < q->distance ? -1 : 1;
    return p->loose < q->loose ? -1 : p->loose > q->loose;
}

static item *sort_items(const il_stops *o)
{
    item *it = il_alloc(o->n + o->n_loose, sizeof *it);
    for (size_t k = 0; k < o->n && it; k++)
        it[k] = (item){ o->stop[k], 0, UINT32_MAX };
    for (size_t k = 0; k < o->n_loose && it; k++)
        it[o->n + k] = (item){ o->loose[k].foot, o->loose[k].distance, (uint32_t)k };
    if (it)
        qsort(it, o->n + o->n_loose, sizeof *it, compare_items);
    return it;
}

static double length_of(const il_frame_sides *s, size_t k)
{
    const il_frame_side *side = &s->side[k];
    return hypot(side->b[0] - side->a[0], side->b[1] - side->a[1]);
}

/* Items first .. end of one place; `level`: of whoever meets the frame there, UINT32_MAX
 * when there is none yet or they differ.  room[2]: half of how far it is to what comes
 * before and after on the same side, as shares of that. */
typedef struct place {
    size_t first, end;
    uint32_t level;
    bool is_taken;
    double room[2];
} place;

static void find_place(const feet *f, const item *it, size_t n, place *p)
{
    const il_stop *here = &it[p->first].stop;
    double most = here->t + f->sides->rounding / length_of(f->sides, here->side);
    p->is_taken = false;
    for (p->end = p->first; p->end < n && it[p->end].stop.side == here->side && it[p->end].stop.t <= most; p->end++) {
        const il_stop *s = &it[p->end].stop;
        if (s->kind != IL_STOP_VERTEX)
            continue;
        p->level = !p->is_taken || p->level == s->level ? s->level : UINT32_MAX;
        p->is_taken = true;
    }
    double before = p->first > 0 && it[p->first - 1].stop.side == here->side ? it[p->first - 1].stop.t : 0;
    double after = p->end < n && it[p->end].stop.side == here->side ? it[p->end].stop.t : 1;
    p->room[0] = (here->t - before) / 2;
    p->room[1] = (after - it[p->end - 1].stop.t) / 2;
}

/* Beside the nearest place, in steps that differ for each of those that share it. */
static bool try_beside(const feet *f, il_loose_end *l, const place *p, size_t number, way *w)
{
    const il_frame_side *side = &f->sides->side[l->foot.side];
    double length = length_of(f->sides, l->foot.side), own = (double)(number + 1 - p->first) / (double)(p->end - p->first + 1);
    double nearest = l->foot.t;
    w->is_moved = true;
    w->is_shared = false;
    for (int k = 0; k < TRIES; k++) {
        double most = fmin(p->room[k % 2], l->distance / length), step = most * ((double)(k / 2) + own) / (TRIES / 2);
        double t = k % 2 ? nearest + step : nearest - step;
        if (!(step * length > f->sides->rounding) || t <= 0 || t >= 1)
            continue;
        double at[2] = { side->a[0] + t * (side->b[0] - side->a[0]), side->a[1] + t * (side->b[1] - side->a[1]) };
        w->to = at;
        if (is_free(w)) {
            memcpy(l->foot.at, at, sizeof at);
            l->foot.t = t;
            return true;
        }
    }
    return false;
}

static void lead_place(feet *f, const item *it, place *p)
{
    for (size_t i = p->first; i < p->end; i++) {
        if (it[i].stop.kind != IL_STOP_FOOT)
            continue;
        uint32_t k = it[i].loose;
        il_loose_end *l = &f->stops->loose[k];
        way w = { f, l->from, l->foot.at, l->end.level, k, l->foot.side, p->is_taken, false, 0 };
        if ((!p->is_taken || p->level == l->end.level) && is_free(&w)) {
            f->is_led[k] = true;
            p->is_taken = true;
            p->level = l->end.level;
        } else {
            f->is_led[k] = try_beside(f, l, p, i, &w);
        }
    }
}

static il_status lead_all(feet *f, il_error *err)
{
    size_t n = f->stops->n + f->stops->n_loose;
    item *it = sort_items(f->stops);
    if (!it)
        return il_fail_nomem(err);
    for (place p = { 0 }; p.first < n; p.first = p.end) {
        p.level = UINT32_MAX;
        find_place(f, it, n, &p);
        lead_place(f, it, &p);
    }
    il_free(it);
    return IL_OK;
}

/* ---- ways that cross after all ------------------------------------------------------ */

static bool crosses(void *context, const il_segment *s)
{
    way *w = context;
    const double a[2] = { s->ax, s->ay }, b[2] = { s->bx, s->by };
    if (++w->looks > LOOKS)
        return true;
    if (s->id >= w->number || !w->feet->is_led[s->id])
        return false;
    if (is_same(b, w->to))
        return run_together(b, a, w->from);
    return do_meet(a, b, w->from, w->to);
}

/* Of two ways that cross the later one is given up. */
static il_status drop_crossing(feet *f, il_error *err)
{
    const il_stops *o = f->stops;
    il_segment *segment = il_alloc(o->n_loose, sizeof *segment);
    if (!segment)
        return il_fail_nomem(err);
    for (size_t k = 0; k < o->n_loose; k++) {
        const il_loose_end *l = &o->loose[k];
        segment[k] = (il_segment){ l->from[0], l->from[1], l->foot.at[0], l->foot.at[1], 0, k };
    }
    il_status st = il_nearest_build(&f->ways, segment, o->n_loose, 1, err);
    for (size_t k = 0; k < o->n_loose && st == IL_OK; k++) {
        way w = { .feet = f, .from = o->loose[k].from, .to = o->loose[k].foot.at, .number = (uint32_t)k };
        if (f->is_led[k] && il_nearest_visit_along(&f->ways, 0, w.from, w.to, crosses, &w))
            f->is_led[k] = false;
    }
    return st;
}

/* ---- all ----------------------------------------------------------------------------- */

static il_status keep_led(feet *f, il_frame *out, il_error *err)
{
    for (size_t k = 0; k < f->stops->n_loose; k++) {
        il_loose_end *l = &f->stops->loose[k];
        if (!f->is_led[k]) {
            if (!il_frame_add_inside(out, &l->end))
                return il_fail_nomem(err);
            continue;
        }
        memcpy(l->end.foot, l->foot.at, sizeof l->end.foot);
        if (!il_stops_add(f->stops, &l->foot) || !il_frame_add_end(out, &l->end))
            return il_fail_nomem(err);
    }
    return IL_OK;
}

il_status il_feet_settle(il_stops *o, il_frame *out, const il_frame_sides *s,
                         const il_slice *level, size_t n_levels, il_error *err)
{
    if (o->n_loose == 0)
        return IL_OK;
    feet f = { .stops = o, .sides = s, .is_led = il_calloc(o->n_loose, sizeof *f.is_led) };
    il_status st = f.is_led ? find_ways(&f, err) : il_fail_nomem(err);
    if (st == IL_OK)
        st = find_edges(&f, level, n_levels, err);
    if (st == IL_OK)
        st = lead_all(&f, err);
    if (st == IL_OK)
        st = drop_crossing(&f, err);
    if (st == IL_OK)
        st = keep_led(&f, out, err);
    il_nearest_free(&f.near_ways);
    il_nearest_free(&f.near_edges);
    il_nearest_free(&f.ways);
    il_free(f.edge);
    il_free(f.is_led);
    return st;
}
