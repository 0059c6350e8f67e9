#include "config.h"
#include "output/picture-arcs.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

void il_trace_free(il_trace *t)
{
    il_free(t->xy);
    il_free(t->phi);
    *t = (il_trace)IL_TRACE_INIT;
}

void il_arcs_free(il_arcs *a)
{
    il_free(a->row);
    il_free(a->sample);
    il_free(a->cost);
    il_free(a->back);
    il_trace_free(&a->from);
    il_trace_free(&a->to);
    *a = (il_arcs)IL_ARCS_INIT;
}

il_status il_arcs_open(il_arcs *a, const il_slice *lower, const il_slice *upper, const il_pair *pair, il_error *err)
{
    *a = (il_arcs){ .lower = lower, .upper = upper, .pair = pair };
    size_t arcs = pair->n_matches + pair->n_unmatched;
    /* Matched arcs are traced twice on either side, the others once. */
    a->budget = 4 * (il_slice_points(lower) + il_slice_points(upper) + pair->n_phi + 4 * arcs) + 64;
    if (pair->n_phi == 0)
        return IL_OK;
    a->row = il_calloc(upper->n + 1, sizeof *a->row);
    if (!a->row)
        return il_fail_nomem(err);
    for (size_t k = 0; k < pair->n_phi; k++)
        if (pair->phi[k].at.ring < upper->n)
            a->row[pair->phi[k].at.ring + 1]++;
    for (size_t i = 0; i < upper->n; i++)
        a->row[i + 1] += a->row[i];
    return IL_OK;
}

/* ---- along a ring -------------------------------------------------------- */

/* The places of a ring between which all is straight: its vertices, or the rows
 * of phi, of which there is one for every vertex. */
typedef struct nodes {
    const il_ring *ring;
    const il_phi_point *row;
    size_t n;
} nodes;

static nodes nodes_of(const il_arcs *a, bool upper, uint32_t ring)
{
    const il_ring *r = &(upper ? a->upper : a->lower)->ring[ring];
    size_t rows = upper && a->row ? a->row[ring + 1] - a->row[ring] : 0;
    if (rows == 0)
        return (nodes){ r, NULL, r->n };
    return (nodes){ r, a->pair->phi + a->row[ring], rows };
}

static bool is_behind(const il_place *a, const il_place *b)
{
    return a->vertex > b->vertex || (a->vertex == b->vertex && a->t > b->t);
}

/* The last node that is not behind AT. */
static size_t find_node(const nodes *s, const il_place *at)
{
    size_t low = 0, high = s->n; /* low is not behind AT, high is */
    if (!s->row)
        return at->vertex;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        *(is_behind(&s->row[middle].at, at) ? &high : &low) = middle;
    }
    return low;
}

static void between(const double *p, const double *q, double t, double at[2])
{
    at[0] = (1 - t) * p[0] + t * q[0];
    at[1] = (1 - t) * p[1] + t * q[1];
}

static void point_at(const nodes *s, const il_place *at, double xy[2])
{
    size_t v = at->vertex, w = v + 1 < s->ring->n ? v + 1 : 0;
    between(s->ring->xy + 2 * v, s->ring->xy + 2 * w, at->t, xy);
}

static bool add(il_trace *t, const double xy[2], const double phi[2])
{
    if (!il_grow(&t->xy, &t->cap_xy, 2 * t->n + 2, sizeof *t->xy) ||
        !il_grow(&t->phi, &t->cap_phi, 2 * t->n + 2, sizeof *t->phi))
        return false;
    memcpy(t->xy + 2 * t->n, xy, 2 * sizeof *xy);
    memcpy(t->phi + 2 * t->n++, phi, 2 * sizeof *phi);
    return true;
}

static bool add_node(il_trace *t, const nodes *s, size_t k)
{
    if (!s->row)
        return add(t, s->ring->xy + 2 * k, s->ring->xy + 2 * k);
    double xy[2], phi[2] = { s->row[k].x, s->row[k].y };
    point_at(s, &s->row[k].at, xy);
    return add(t, xy, phi);
}

/* The place AT, which is at node K or between it and the next. */
static bool add_place(il_trace *t, const nodes *s, size_t k, const il_place *at)
{
    double xy[2], phi[2];
    point_at(s, at, xy);
    if (!s->row)
        return add(t, xy, xy);
    const il_phi_point *p = &s->row[k], *q = &s->row[k + 1 < s->n ? k + 1 : 0];
    double end = q->at.vertex == p->at.vertex && q != p && q->at.t > p->at.t ? q->at.t : 1;
    between((double[2]){ p->x, p->y }, (double[2]){ q->x, q->y }, (at->t - p->at.t) / (end - p->at.t), phi);
    return add(t, xy, phi);
}

il_status il_arcs_trace(il_arcs *a, bool upper, const il_arc *arc, il_trace *out, il_error *err)
{
    nodes s = nodes_of(a, upper, arc->from.ring);
    out->n = 0;
    size_t first = find_node(&s, &arc->from), last = find_node(&s, &arc->to);
    size_t steps = last >= first ? last - first : last + s.n - first;
    if (steps == 0 && !is_behind(&arc->to, &arc->from))
        steps = s.n; /* all of the ring, or all but a piece of one edge */
    if (steps + 2 > a->budget)
        return il_fail(err, IL_E_INPUT, a->pair->line, "the arcs of this pair lie over one another");
    a->budget -= steps + 2;
    bool ok = add_place(out, &s, first, &arc->from);
    for (size_t k = 1; k <= steps && ok; k++)
        ok = add_node(out, &s, (first + k) % s.n);
    ok = ok && add_place(out, &s, last, &arc->to);
    return ok ? IL_OK : il_fail_nomem(err);
}

double il_trace_length(const double *xy, size_t n)
{
    double sum = 0;
    for (size_t k = 1; k < n; k++)
        sum += hypot(xy[2 * k] - xy[2 * k - 2], xy[2 * k + 1] - xy[2 * k - 1]);
    return sum;
}

/* ---- what corresponds ---------------------------------------------------- */

/* A place that moves along a trace: on the piece from point k, done is the
 * length of all before it. */
typedef struct walk {
    const il_trace *trace;
    size_t k;
    double done;
} walk;

/* Take W to LENGTH behind the beginning; lengths must not fall.  xy, and phi. */
static void walk_to(walk *w, double length, double xy[2], double phi[2])
{
    const il_trace *t = w->trace;
    double piece = 0;
    for (; w->k + 1 < t->n; w->k++) {
        const double *p = t->xy + 2 * w->k;
        piece = hypot(p[2] - p[0], p[3] - p[1]);
        if (w->done + piece >= length || w->k + 2 == t->n)
            break;
        w->done += piece;
    }
    double f = piece > 0 ? fmin(fmax((length - w->done) / piece, 0), 1) : 0;
    size_t next = w->k + 1 < t->n ? w->k + 1 : w->k;
    between(t->xy + 2 * w->k, t->xy + 2 * next, f, xy);
    between(t->phi + 2 * w->k, t->phi + 2 * next, f, phi);
}

enum { SAMPLES_MOST = 256, PLACES_MOST = 2048 };

/* cost[j]: of the best way for all samples so far whose last is at place j or
 * before it.  back[s * places + j]: that place. */
static void advance(il_arcs *a, size_t s, const double phi[2], const double *place, size_t places)
{
    uint32_t *back = a->back + s * places;
    double best = INFINITY;
    uint32_t at = 0;
    for (size_t j = 0; j < places; j++) {
        double dx = phi[0] - place[2 * j], dy = phi[1] - place[2 * j + 1], cost = a->cost[j] + dx * dx + dy * dy;
        if (cost < best) {
            best = cost;
            at = (uint32_t)j;
        }
        back[j] = at;
        a->cost[j] = best;
    }
}

static bool have_room(il_arcs *a, size_t samples, size_t places)
{
    return il_grow(&a->sample, &a->cap_sample, 4 * samples, sizeof *a->sample) &&
           il_grow(&a->cost, &a->cap_cost, 3 * places, sizeof *a->cost) &&
           il_grow(&a->back, &a->cap_back, samples * places, sizeof *a->back);
}

static size_t pieces(double length, double each, size_t most)
{
    double n = floor(length / each + 0.5);
    return n < (double)most ? (size_t)n : most;
}

il_status il_arcs_links(il_arcs *a, const il_match *m, double spacing, double fineness, size_t *n, il_error *err)
{
    double unused[2];
    *n = 0;
    il_status st = il_arcs_trace(a, true, &m->upper, &a->from, err);
    if (st == IL_OK)
        st = il_arcs_trace(a, false, &m->lower, &a->to, err);
    if (st != IL_OK)
        return st;
    double up = il_trace_length(a->from.xy, a->from.n), low = il_trace_length(a->to.xy, a->to.n);
    size_t samples = pieces(up, spacing, SAMPLES_MOST), places = pieces(low, fineness, PLACES_MOST - 2) + 2;
    if (samples == 0)
        return IL_OK;
    if (!have_room(a, samples, places))
        return il_fail_nomem(err);
    double *place = a->cost + places;
    walk w = { &a->to, 0, 0 };
    for (size_t j = 0; j < places; j++)
        walk_to(&w, low * (double)j / (double)(places - 1), place + 2 * j, unused);
    memset(a->cost, 0, places * sizeof *a->cost);
    w = (walk){ &a->from, 0, 0 };
    for (size_t s = 0; s < samples; s++) {
        double phi[2];
        walk_to(&w, up * ((double)s + 0.5) / (double)samples, a->sample + 4 * s, phi);
        advance(a, s, phi, place, places);
    }
    size_t j = places - 1;
    for (size_t s = samples; s-- > 0;) {
        j = a->back[s * places + j];
        memcpy(a->sample + 4 * s + 2, place + 2 * j, 2 * sizeof *place);
    }
    *n = samples;
    return IL_OK;
}
