/* image.c - the image of an upper ring of a divided group, put together from its pieces' phis. */
#include "config.h"
#include "match/division.h"
#include "base/alloc.h"
#include "bridge/predicates.h"

#include <math.h>

/* Edges are looked at every so many cells to see whose piece they are in. */
static const double LOOK = 2;

/* A point of the ring is on its piece when it is as near as this, in cells. */
static const double NEAR = 0.05;

#define LOOSE UINT32_MAX

/* A ring of an upper region: its points are looked at in order. */
typedef struct walk {
    const il_division *d;
    const il_region *region;
    const il_ring *ring;
    il_rows *rows;
    uint32_t *own;           size_t cap_own;   /* of rows: the link that maps them, LOOSE on a seam */
} walk;

static void point_on(const walk *w, size_t k, double t, double out[2])
{
    const double *a = w->ring->xy + 2 * k, *b = w->ring->xy + 2 * (k + 1 < w->ring->n ? k + 1 : 0);
    for (size_t c = 0; c < 2; c++)
        out[c] = a[c] + t * (b[c] - a[c]);
}

/* Is Q within NEAR, unit, of the outline of P? */
static bool is_on(const il_piece *p, const double q[2], double near)
{
    for (size_t i = 0; i < p->n; i++) {
        const double *a = p->xy + 2 * i, *b = p->xy + 2 * p->next[i];
        double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
        double t = l2 > 0 ? fmin(fmax(((q[0] - a[0]) * dx + (q[1] - a[1]) * dy) / l2, 0), 1) : 0;
        if (hypot(a[0] + t * dx - q[0], a[1] + t * dy - q[1]) <= near)
            return true;
    }
    return false;
}

/* The link, by its number in the region, in whose piece edge K at T is, or LOOSE. */
static uint32_t owner(const walk *w, size_t k, double t)
{
    double p[2];
    point_on(w, k, t, p);
    if (!w->region->cut)
        return w->region->n_links > 0 ? 0 : LOOSE;
    size_t i = il_dissection_cell(&w->region->cutting, p);
    const il_piece *piece = &w->d->joint[w->region->link[i]].piece[1];
    if (il_dissection_side(&w->region->cutting, i, p, NULL) > w->region->seam &&
        (!piece->crumbs || is_on(piece, p, NEAR * w->region->cutting.frame.cell)))
        return (uint32_t)i;
    return LOOSE;
}

/* Between T0, where OWN owns, and T1, where it does not (or the other way round): how far it
 * goes, on its own side. */
static double border(const walk *w, size_t k, uint32_t own, double t0, double t1)
{
    for (int i = 0; i < 30; i++) {
        double t = (t0 + t1) / 2;
        if (owner(w, k, t) == own)
            t0 = t;
        else
            t1 = t;
    }
    return t0;
}

static bool add_loose(walk *w, size_t k)
{
    double p[2];
    point_on(w, k, 0, p);
    size_t n = w->rows->n;
    if (!il_rows_add(w->rows, (uint32_t)k, 0, p) || !il_grow(&w->own, &w->cap_own, w->rows->n, sizeof *w->own))
        return false;
    w->own[n] = LOOSE;
    return true;
}

/* [T0, T1) of edge K as link I maps it; T1 itself, too, when it is no vertex. */
static bool add_mapped(walk *w, size_t k, uint32_t i, double t0, double t1)
{
    const il_joint *j = &w->d->joint[w->region->link[i]];
    double a[2], b[2], end[2];
    size_t from = w->rows->n;
    point_on(w, k, 0, a);
    point_on(w, k, 1, b);
    if (from > 0 && w->rows->row[from - 1].vertex == k && w->rows->row[from - 1].t >= t0)
        from = --w->rows->n; /* where two pieces meet in one double */
    if (t0 < t1 && !il_rows_add_part(w->rows, &j->bend, (uint32_t)k, a, b, t0, t1))
        return false;
    if (t1 < 1) {
        point_on(w, k, t1, end);
        j->bend.apply(j->bend.context, end);
        if (!il_rows_add(w->rows, (uint32_t)k, t1, end))
            return false;
    }
    if (!il_grow(&w->own, &w->cap_own, w->rows->n, sizeof *w->own))
        return false;
    for (; from < w->rows->n; from++)
        w->own[from] = i;
    return true;
}

/* Edge K: a vertex, and then as the pieces have it. */
static bool add_edge(walk *w, size_t k)
{
    double a[2], b[2];
    point_on(w, k, 0, a);
    point_on(w, k, 1, b);
    double cells = w->region->cut ? hypot(b[0] - a[0], b[1] - a[1]) / w->region->cutting.frame.cell : 0;
    size_t looks = (size_t)fmax(1, fmin(ceil(cells / LOOK), 1000));
    uint32_t own = owner(w, k, 0);
    double since = 0;
    if (own == LOOSE && !add_loose(w, k))
        return false;
    for (size_t i = 1; i <= looks; i++) {
        double t0 = (double)(i - 1) / (double)looks, t1 = (double)i / (double)looks;
        uint32_t next = owner(w, k, t1);
        if (next == own)
            continue;
        if (own != LOOSE && !add_mapped(w, k, own, since, border(w, k, own, t0, t1)))
            return false;
        since = next != LOOSE ? border(w, k, next, t1, t0) : 1;
        own = next;
    }
    return own == LOOSE || since >= 1 || add_mapped(w, k, own, since, 1);
}

static double way(const walk *w, size_t from, size_t to)
{
    double a[2], b[2];
    point_on(w, w->rows->row[from].vertex, w->rows->row[from].t, a);
    point_on(w, w->rows->row[to].vertex, w->rows->row[to].t, b);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* Loose rows lie on the straight line between the mapped ones before and behind them, in
 * proportion to the way along the ring.  False when none is mapped. */
static bool tie_loose(walk *w)
{
    size_t n = w->rows->n, first = 0;
    il_course_row *row = w->rows->row;
    while (first < n && w->own[first] == LOOSE)
        first++;
    if (first == n)
        return false;
    for (size_t i = first, step = 0; step < n;) {
        size_t end = i, count = 0;
        double whole = 0, so_far = 0;
        do {
            size_t after = (end + 1) % n;
            whole += way(w, end, after);
            end = after;
            count++;
        } while (w->own[end] == LOOSE);
        for (size_t k = 1, at = i; k < count; k++) {
            size_t after = (at + 1) % n;
            so_far += way(w, at, after);
            double part = whole > 0 ? so_far / whole : 0.5;
            row[after].x = row[i].x + part * (row[end].x - row[i].x);
            row[after].y = row[i].y + part * (row[end].y - row[i].y);
            at = after;
        }
        i = end;
        step += count;
    }
    return true;
}

static bool crosses(const il_course_row *a, const il_course_row *b, const il_course_row *c, const il_course_row *e)
{
    const double p[2] = { a->x, a->y }, q[2] = { b->x, b->y }, r[2] = { c->x, c->y }, s[2] = { e->x, e->y };
    return il_edges_meet(p, q, r, s);
}

/* The next mapped row after I, or before it. */
static size_t mapped_from(const walk *w, size_t i, bool ahead)
{
    size_t n = w->rows->n;
    do
        i = ahead ? (i + 1) % n : (i + n - 1) % n;
    while (w->own[i] == LOOSE);
    return i;
}

/* The way over the seam from row I to row K: does it cross the image of I's piece on the other
 * side of I (AHEAD: on which side that is)?  Then I is loose up to there. */
static bool trim_end(walk *w, size_t i, size_t k, bool ahead)
{
    enum { LOOKS = 40 };
    const il_course_row *row = w->rows->row;
    size_t at = mapped_from(w, i, ahead);
    for (int look = 0; look < LOOKS; look++) {
        size_t after = mapped_from(w, at, ahead);
        if (w->own[at] != w->own[i] || w->own[after] != w->own[i] || after == k || after == i)
            return false;
        if (crosses(&row[i], &row[k], &row[at], &row[after])) {
            for (size_t r = i; r != after; r = mapped_from(w, r, ahead))
                w->own[r] = LOOSE;
            return true;
        }
        at = after;
    }
    return false;
}

/* The straight ways over seams must not run into the pieces that they join: where they do, the
 * pieces end sooner. */
static void trim_ends(walk *w)
{
    enum { ROUNDS = 8 };
    size_t n = w->rows->n;
    bool trimmed = true;
    for (int round = 0; trimmed && round < ROUNDS; round++) {
        trimmed = false;
        for (size_t i = 0; i < n; i++) {
            if (w->own[i] == LOOSE)
                continue;
            size_t k = mapped_from(w, i, true);
            if (k != i && w->own[k] != w->own[i])
                trimmed = trim_end(w, i, k, false) || trim_end(w, k, i, true) || trimmed;
        }
    }
}

/* A hole that is all on a seam goes with the pieces on both sides: by the mean of their shifts. */
static void shift_hole(const walk *w)
{
    double p[2];
    size_t rival = 0;
    point_on(w, 0, 0, p);
    size_t own = il_dissection_cell(&w->region->cutting, p);
    il_dissection_side(&w->region->cutting, own, p, &rival);
    const double *a = w->d->joint[w->region->link[own]].shift, *b = w->d->joint[w->region->link[rival]].shift;
    for (size_t k = 0; k < w->rows->n; k++) {
        point_on(w, k, 0, p);
        w->rows->row[k].x = p[0] + (a[0] + b[0]) / 2;
        w->rows->row[k].y = p[1] + (a[1] + b[1]) / 2;
    }
}

il_status il_division_map_ring(il_division *d, uint32_t ring, il_rows *rows, bool *sound, il_error *err)
{
    il_region *r = &d->region[1][il_division_region(d, 1, ring)];
    walk w = { .d = d, .region = r, .ring = &d->slice[1]->ring[ring], .rows = rows };
    bool ok = true;
    rows->n = 0;
    for (size_t k = 0; ok && k < w.ring->n; k++)
        ok = add_edge(&w, k);
    if (ok && w.region->cut)
        trim_ends(&w);
    *sound = ok && tie_loose(&w);
    if (ok && !*sound && r->cut && ring != r->outer) {
        shift_hole(&w);
        *sound = true;
    }
    il_free(w.own);
    return ok ? IL_OK : il_fail_nomem(err);
}
