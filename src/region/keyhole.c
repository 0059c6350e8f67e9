#include "config.h"
#include "region/keyhole.h"
#include "base/alloc.h"
#include "region/channel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What keyhole.h says of these. */
static const double LENGTH_WIDTHS = 20, LENGTH_TOLERANCES = 4, BEHIND = 5, APART = 2.5,
                    AREA_RATIO = 10, LOOP_TOLERANCES = 4;

/* A channel as vertices:  loop a0 - a1 loop b1 - b0  round the ring, of which a1
 * follows b1 when it is cut, and b0 follows a0.  What lies between a0 and a1 and
 * between b1 and b0 is dropped.  loop: the perimeter of the shorter side of it;
 * area2: twice the channel's area, at most. */
typedef struct cut {
    size_t a0, a1, b0, b1;
    double loop, area2;
} cut;

/* ---- is it a keyhole? ----------------------------------------------------------- */

static double length_between(const il_outline *o, const il_place *from, const il_place *to)
{
    double l = il_place_length(o, to) - il_place_length(o, from);
    return l < 0 ? l + il_outline_length(o) : l;
}

/* Do the sides part behind end K of C? */
static bool parts(const il_outline *o, const il_channel *c, int k, double tolerance)
{
    double ahead = k ? BEHIND * tolerance : -BEHIND * tolerance, p[2], q[2];
    il_outline_at(o, il_place_length(o, &c->a[k]) + ahead, p);
    il_outline_at(o, il_place_length(o, &c->b[k]) - ahead, q);
    return hypot(p[0] - q[0], p[1] - q[1]) >= APART * tolerance;
}

static double perimeter_of(const il_outline *o, size_t from, size_t to)
{
    double l = o->length[to] - o->length[from] + (to < from ? il_outline_length(o) : 0);
    return l + hypot(o->xy[2 * to] - o->xy[2 * from], o->xy[2 * to + 1] - o->xy[2 * from + 1]);
}

/* What can be told of a channel without the others.  What is not to be a slit
 * goes a good way round: a circle 8 t wide is the least. */
static bool judge(const il_outline *o, const il_channel *c, double tolerance, cut *to)
{
    double length = fmin(length_between(o, &c->a[0], &c->a[1]), length_between(o, &c->b[1], &c->b[0]));
    /* what rounding does to widths that are the tolerance */
    if (length < LENGTH_WIDTHS * c->width * (1 - 1e-9) || length < LENGTH_TOLERANCES * tolerance)
        return false;
    if (!parts(o, c, 0, tolerance) || !parts(o, c, 1, tolerance))
        return false;
    to->a0 = il_place_vertex(o, &c->a[0], false);
    to->a1 = il_place_vertex(o, &c->a[1], true);
    to->b0 = il_place_vertex(o, &c->b[0], true);
    to->b1 = il_place_vertex(o, &c->b[1], false);
    to->loop = fmin(perimeter_of(o, to->a1, to->b1), perimeter_of(o, to->b0, to->a0));
    to->area2 = 2 * c->width * length;
    return to->loop >= 4 * LOOP_TOLERANCES * tolerance;
}

/* ---- which of them together ---------------------------------------------------- */

/* Small loops first: where several channels use one way, each goes to its own. */
static int compare_cuts(const void *p, const void *q)
{
    const cut *a = p, *b = q;
    if (a->loop != b->loop)
        return a->loop < b->loop ? -1 : 1;
    if (a->a0 != b->a0)
        return a->a0 < b->a0 ? -1 : 1;
    return a->b0 < b->b0 ? -1 : a->b0 > b->b0;
}

/* Are the edges from vertex FROM to vertex TO free? */
static bool edges_free(const bool *taken, size_t n, size_t from, size_t to)
{
    for (size_t i = from; i != to; i = i + 1 < n ? i + 1 : 0)
        if (taken[i])
            return false;
    return true;
}

static void take_edges(bool *taken, size_t n, size_t from, size_t to)
{
    for (size_t i = from; i != to; i = i + 1 < n ? i + 1 : 0)
        taken[i] = true;
}

/* C[0..N) without those that use an edge of one before: how many are left. */
static size_t keep_apart(cut *c, size_t n, bool *taken, size_t n_vertices)
{
    size_t kept = 0;
    qsort(c, n, sizeof *c, compare_cuts);
    for (size_t i = 0; i < n; i++) {
        if (!edges_free(taken, n_vertices, c[i].a0, c[i].a1) || !edges_free(taken, n_vertices, c[i].b1, c[i].b0))
            continue;
        take_edges(taken, n_vertices, c[i].a0, c[i].a1);
        take_edges(taken, n_vertices, c[i].b1, c[i].b0);
        c[kept++] = c[i];
    }
    return kept;
}

/* next[i] follows vertex i when C[0..N) are cut, and done[i] says what is dropped. */
static void link_vertices(const cut *c, size_t n, size_t n_vertices, size_t *next, bool *done)
{
    for (size_t i = 0; i < n_vertices; i++)
        next[i] = i + 1 < n_vertices ? i + 1 : 0;
    for (size_t k = 0; k < n; k++) {
        for (size_t i = next[c[k].a0]; c[k].a0 != c[k].a1 && i != c[k].a1; i = next[i])
            done[i] = true;
        for (size_t i = next[c[k].b1]; c[k].b1 != c[k].b0 && i != c[k].b0; i = next[i])
            done[i] = true;
    }
    for (size_t k = 0; k < n; k++) {
        next[c[k].a0] = c[k].b0;
        next[c[k].b1] = c[k].a1;
    }
}

/* ---- the loops that would come of it --------------------------------------------- */

/* area2: twice the signed area; n_cuts: how many channels end at it. */
typedef struct loop {
    double area2, perimeter;
    size_t n_cuts;
} loop;

/* Of the outline cut at some channels: next[] as above, loop_of[i] the loop of
 * vertex i. */
typedef struct pieces {
    size_t *next, *loop_of;
    bool *done;
    loop *loop;             size_t n;
} pieces;

static void pieces_free(pieces *p)
{
    il_free(p->next);
    il_free(p->loop_of);
    il_free(p->done);
    il_free(p->loop);
}

static bool pieces_init(pieces *p, size_t n_vertices)
{
    *p = (pieces){ il_alloc(n_vertices, sizeof *p->next), il_alloc(n_vertices, sizeof *p->loop_of),
                   il_alloc(n_vertices, sizeof *p->done), il_alloc(n_vertices, sizeof *p->loop), 0 };
    return p->next && p->loop_of && p->done && p->loop;
}

static void measure_loop(pieces *p, const il_outline *o, size_t i)
{
    loop *l = &p->loop[p->n];
    const double *origin = o->xy + 2 * i;
    *l = (loop){ 0, 0, 0 };
    for (; !p->done[i]; i = p->next[i]) {
        const double *a = o->xy + 2 * i, *b = o->xy + 2 * p->next[i];
        p->done[i] = true;
        p->loop_of[i] = p->n;
        l->area2 += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
        l->perimeter += hypot(b[0] - a[0], b[1] - a[1]);
    }
    p->n++;
}

static void measure_loops(pieces *p, const il_outline *o, const cut *c, size_t n)
{
    memset(p->done, 0, o->n * sizeof *p->done);
    link_vertices(c, n, o->n, p->next, p->done);
    p->n = 0;
    for (size_t i = 0; i < o->n; i++)
        if (!p->done[i])
            measure_loop(p, o, i);
    for (size_t k = 0; k < n; k++) {
        p->loop[p->loop_of[c[k].a0]].n_cuts++;
        p->loop[p->loop_of[c[k].a1]].n_cuts++;
    }
}

/* Is the loop at one end of C a last one, and too little to be what was drawn? */
static bool is_dead_end(const loop *l, const cut *c, double tolerance)
{
    double area2 = fabs(l->area2);
    return l->n_cuts == 1 && (area2 < LOOP_TOLERANCES * tolerance * l->perimeter || area2 < AREA_RATIO * c->area2);
}

/* C[0..N) without those that lead to dead ends: how many are left.  What hangs on
 * a dead end may be one then: so this is repeated, up to ROUNDS times.  No drawing
 * has so many loops in a row that are all too small; then nothing is cut. */
static size_t drop_dead_ends(pieces *p, const il_outline *o, cut *c, size_t n, double tolerance)
{
    enum { ROUNDS = 20 };
    for (int round = 0; n > 0; round++) {
        size_t kept = 0;
        measure_loops(p, o, c, n);
        for (size_t k = 0; k < n; k++) {
            const loop *a = &p->loop[p->loop_of[c[k].a0]], *b = &p->loop[p->loop_of[c[k].a1]];
            if (a != b && !is_dead_end(a, &c[k], tolerance) && !is_dead_end(b, &c[k], tolerance))
                c[kept++] = c[k];
        }
        if (kept == n)
            break;
        n = round < ROUNDS ? kept : 0;
    }
    return n;
}

/* ---- cutting ---------------------------------------------------------------------- */

/* Vertex I of the outline to R; the points of a mouth that are one are one point. */
static bool add_vertex(il_ring *r, const il_ring *from, size_t i, bool is_cut)
{
    const double *p = from->xy + 2 * i;
    unsigned char mark = from->mark ? from->mark[i] : 0;
    if (is_cut)
        mark &= (unsigned char)~IL_VERTEX_MAP_EDGE;
    if (r->n > 0 && memcmp(r->xy + 2 * (r->n - 1), p, 2 * sizeof *p) == 0) {
        if (r->mark)
            r->mark[r->n - 1] = (unsigned char)((r->mark[r->n - 1] & IL_VERTEX_INSERTED & mark) | (mark & IL_VERTEX_MAP_EDGE));
        return true;
    }
    return il_ring_add(r, p[0], p[1], mark);
}

/* The loop of vertex I, whose followers are NEXT, as another ring of S; what it
 * consists of is marked as done. */
static bool add_loop(il_slice *s, const il_outline *o, const il_ring *from, const size_t *next, bool *done, size_t i)
{
    il_ring *r = il_slice_add_ring(s);
    bool ok = r != NULL;
    while (ok && !done[i]) {
        done[i] = true;
        ok = add_vertex(r, from, o->vertex[i], next[i] != (i + 1 < o->n ? i + 1 : 0));
        i = next[i];
    }
    while (ok && r->n > 1 && memcmp(r->xy, r->xy + 2 * (r->n - 1), 2 * sizeof *r->xy) == 0)
        r->n--;
    if (ok)
        il_ring_take_origin(r, from);
    return ok;
}

/* The loops of FROM, cut at C[0..N), as rings at the end of S. */
static il_status add_loops(il_slice *s, const il_outline *o, const il_ring *from, const cut *c, size_t n, il_error *err)
{
    size_t *next = il_alloc(o->n, sizeof *next);
    bool *done = il_calloc(o->n, sizeof *done), ok = next && done;
    if (ok)
        link_vertices(c, n, o->n, next, done);
    for (size_t i = 0; ok && i < o->n; i++)
        if (!done[i])
            ok = add_loop(s, o, from, next, done, i);
    il_free(next);
    il_free(done);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* Those of the candidates C[0..*N) that are cut together: *N of them. */
static il_status choose_cuts(const il_outline *o, cut *c, size_t *n, double tolerance, il_error *err)
{
    bool *taken = il_calloc(o->n, sizeof *taken);
    pieces p;
    bool ok = pieces_init(&p, o->n) && taken;
    if (ok) {
        *n = keep_apart(c, *n, taken, o->n);
        *n = drop_dead_ends(&p, o, c, *n, tolerance);
    }
    pieces_free(&p);
    il_free(taken);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* The keyholes of O: *CUTS[*N], to il_free. */
static il_status find_cuts(const il_outline *o, double tolerance, cut **cuts, size_t *n, il_error *err)
{
    il_channel *channel = NULL;
    size_t n_channels = 0;
    *cuts = NULL;
    *n = 0;
    il_status st = il_channels_find(o, tolerance, &channel, &n_channels, err);
    if (st == IL_OK && n_channels > 0) {
        *cuts = il_alloc(n_channels, sizeof **cuts);
        for (size_t i = 0; *cuts && i < n_channels; i++)
            *n += judge(o, &channel[i], tolerance, &(*cuts)[*n]);
        st = !*cuts ? il_fail_nomem(err) : *n > 0 ? choose_cuts(o, *cuts, n, tolerance, err) : IL_OK;
    }
    il_free(channel);
    return st;
}

/* Cut ring I of S; its first loop takes its place. */
static il_status open_ring(il_slice *s, size_t i, double tolerance, il_report *report, il_error *err)
{
    il_outline o = IL_OUTLINE_INIT;
    cut *cuts = NULL;
    size_t n = 0, first = s->n;
    il_status st = il_outline_init(&o, &s->ring[i], err);
    if (st == IL_OK)
        st = find_cuts(&o, tolerance, &cuts, &n, err);
    if (st == IL_OK && n > 0) {
        il_ring from = s->ring[i]; /* the rings may move */
        st = add_loops(s, &o, &from, cuts, n, err);
        while (st != IL_OK && s->n > first)
            il_ring_free(&s->ring[--s->n]);
    }
    if (st == IL_OK && n > 0) {
        il_report_repair(report, IL_REPAIR_KEYHOLE, n);
        il_report_repair(report, IL_REPAIR_REPEATED_POINT, s->ring[i].n - o.n);
        s->ring[first].extra = s->ring[i].extra;
        s->ring[i].extra = NULL;
        il_ring_free(&s->ring[i]);
        s->ring[i] = s->ring[first];
        s->ring[first] = s->ring[--s->n];
    }
    il_outline_free(&o);
    il_free(cuts);
    return st;
}

il_status il_slice_open_keyholes(il_slice *s, double tolerance, il_report *report, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0, n = s->n; i < n && st == IL_OK; i++)
        if (!s->ring[i].open && tolerance > 0)
            st = open_ring(s, i, tolerance, report, err);
    return st;
}
