#include "config.h"
#include "region/channel.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "bridge/boxes.h"

#include <math.h>
#include <string.h>

/* ---- outlines --------------------------------------------------------------- */

void il_outline_free(il_outline *o)
{
    il_free(o->xy);
    il_free(o->length);
    il_free(o->vertex);
    *o = (il_outline)IL_OUTLINE_INIT;
}

static double distance(const double *p, const double *q)
{
    return hypot(p[0] - q[0], p[1] - q[1]);
}

/* The distinct vertices of R. */
static void copy_vertices(il_outline *o, const il_ring *r)
{
    for (size_t i = 0; i < r->n; i++) {
        if (o->n > 0 && memcmp(o->xy + 2 * (o->n - 1), r->xy + 2 * i, 2 * sizeof *r->xy) == 0)
            continue;
        memcpy(o->xy + 2 * o->n, r->xy + 2 * i, 2 * sizeof *r->xy);
        o->vertex[o->n++] = i;
    }
    while (o->n > 1 && memcmp(o->xy, o->xy + 2 * (o->n - 1), 2 * sizeof *r->xy) == 0)
        o->n--;
}

il_status il_outline_init(il_outline *o, const il_ring *r, il_error *err)
{
    *o = (il_outline)IL_OUTLINE_INIT;
    o->xy = il_alloc(r->n, 2 * sizeof *o->xy);
    o->vertex = il_alloc(r->n, sizeof *o->vertex);
    o->length = il_alloc(r->n + 1, sizeof *o->length);
    if (!o->xy || !o->vertex || !o->length) {
        il_outline_free(o);
        return il_fail_nomem(err);
    }
    copy_vertices(o, r);
    o->length[0] = 0;
    for (size_t i = 0; i < o->n; i++) {
        const double *p = o->xy + 2 * i, *q = o->xy + 2 * (i + 1 < o->n ? i + 1 : 0);
        o->length[i + 1] = o->length[i] + distance(p, q);
    }
    return IL_OK;
}

double il_outline_length(const il_outline *o)
{
    return o->length[o->n];
}

void il_outline_at(const il_outline *o, double s, double p[2])
{
    double whole = il_outline_length(o);
    s -= whole * floor(s / whole);
    size_t low = 0, high = o->n; /* length[low] <= s < length[high], but for rounding */
    while (high - low > 1) {
        size_t half = low + (high - low) / 2;
        if (o->length[half] <= s)
            low = half;
        else
            high = half;
    }
    const double *from = o->xy + 2 * low, *to = o->xy + 2 * (high < o->n ? high : 0);
    double t = (s - o->length[low]) / (o->length[high] - o->length[low]);
    t = t >= 0 && t <= 1 ? t : t > 1;
    for (int k = 0; k < 2; k++)
        p[k] = from[k] + t * (to[k] - from[k]);
}

/* ---- places ------------------------------------------------------------------ */

static size_t after(const il_outline *o, size_t i)
{
    return i + 1 < o->n ? i + 1 : 0;
}

static size_t before(const il_outline *o, size_t i)
{
    return i > 0 ? i - 1 : o->n - 1;
}

double il_place_length(const il_outline *o, const il_place *q)
{
    return o->length[q->edge] + distance(o->xy + 2 * q->edge, q->p);
}

size_t il_place_vertex(const il_outline *o, const il_place *q, bool onwards)
{
    return q->at_vertex || !onwards ? q->edge : after(o, q->edge);
}

static il_place place_at_vertex(const il_outline *o, size_t i)
{
    return (il_place){ { o->xy[2 * i], o->xy[2 * i + 1] }, i, true };
}

/* The vertex that Q comes to when it moves on. */
static size_t next_vertex(const il_outline *o, const il_place *q, bool onwards)
{
    return onwards ? after(o, q->edge) : q->at_vertex ? before(o, q->edge) : q->edge;
}

/* From Q the nearest place to P on the way to the next vertex, that one included. */
static il_place nearest_ahead(const il_outline *o, const il_place *q, bool onwards, const double *p)
{
    size_t next = next_vertex(o, q, onwards);
    const double *from = q->p, *to = o->xy + 2 * next;
    double dx = to[0] - from[0], dy = to[1] - from[1];
    double t = ((p[0] - from[0]) * dx + (p[1] - from[1]) * dy) / (dx * dx + dy * dy);
    if (!(t > 0))
        return *q;
    if (t >= 1)
        return place_at_vertex(o, next);
    return (il_place){ { from[0] + t * dx, from[1] + t * dy }, onwards ? q->edge : next, false };
}

/* ---- walking along both sides ---------------------------------------------------- */

/* between: vertices ahead of A that come before B. */
typedef struct state {
    il_place a, b;
    double gap;
    size_t between;
} state;

typedef struct search {
    const il_outline *o;
    double tolerance;
    il_keymap seen;         /* vertex and edge that some walk had beside one another */
    state *way;             /* of the walk at hand */
    size_t n, cap;
    il_channel *channel;
    size_t n_channels, cap_channels;
} search;

static void consider(state *best, const state *other)
{
    if (other->gap < best->gap)
        *best = *other;
}

/* The state behind FROM, which one side or both have reached a vertex for; the
 * one that leaves them nearest to one another, so that neither runs ahead.
 * False when there is none within the tolerance, or the sides are to meet. */
static bool advance(const search *s, const state *from, bool onwards, state *to)
{
    const il_outline *o = s->o;
    if (from->between < 2)
        return false;
    state both, first = *from, second = *from;
    both.a = place_at_vertex(o, next_vertex(o, &from->a, onwards));
    both.b = place_at_vertex(o, next_vertex(o, &from->b, !onwards));
    both.gap = distance(both.a.p, both.b.p);
    both.between = from->between - 2;
    first.a = both.a;
    first.b = nearest_ahead(o, &from->b, !onwards, both.a.p);
    first.gap = distance(first.a.p, first.b.p);
    second.b = both.b;
    second.a = nearest_ahead(o, &from->a, onwards, both.b.p);
    second.gap = distance(second.a.p, second.b.p);
    first.between = second.between = from->between - 1;
    *to = both;
    consider(to, &first);
    consider(to, &second);
    return to->gap <= s->tolerance;
}

/* Is a vertex beside an edge for the first time?  *OK: false without memory. */
static bool mark(search *s, size_t vertex, size_t edge, bool *ok)
{
    uint64_t n = s->seen.n;
    *ok = *ok && il_keymap_put(&s->seen, vertex, edge, 0);
    return *ok && s->seen.n > n;
}

/* Marks Q, when it is a vertex, as beside the other place. */
static bool mark_side(search *s, const il_place *q, const il_place *other, bool *ok)
{
    bool fresh = !q->at_vertex;
    if (q->at_vertex)
        fresh = mark(s, q->edge, other->edge, ok);
    if (q->at_vertex && other->at_vertex)
        fresh |= mark(s, q->edge, before(s->o, other->edge), ok);
    return fresh;
}

/* Was no walk here before? */
static bool mark_state(search *s, const state *at, bool *ok)
{
    bool a = mark_side(s, &at->a, &at->b, ok), b = mark_side(s, &at->b, &at->a, ok);
    return a && b;
}

/* Did both sides get on, and in one direction? */
static bool is_progress(const state *from, const state *to)
{
    return (to->a.p[0] - from->a.p[0]) * (to->b.p[0] - from->b.p[0]) +
           (to->a.p[1] - from->a.p[1]) * (to->b.p[1] - from->b.p[1]) > 0;
}

/* Walk on from SEED until the sides part or meet, and append the states to the
 * way.  *FRESH: nobody has been here.  False without memory. */
static bool walk(search *s, const state *seed, bool onwards, bool *fresh)
{
    bool ok = true;
    state at = *seed, next;
    while (ok && *fresh && advance(s, &at, onwards, &next)) {
        *fresh = mark_state(s, &next, &ok);
        ok = ok && il_grow(&s->way, &s->cap, s->n + 1, sizeof *s->way);
        if (ok)
            s->way[s->n++] = at = next;
    }
    return ok;
}

static void reverse_way(search *s)
{
    for (size_t i = 0, k = s->n; i + 1 < k; i++) {
        state swap = s->way[--k];
        s->way[k] = s->way[i];
        s->way[i] = swap;
    }
}

/* The way as a channel.  What one side went alone at either end is not part of
 * it, but of the loop there. */
static bool add_channel(search *s)
{
    size_t first = 0, last = s->n - 1;
    double width = 0;
    while (first < last && !is_progress(&s->way[first], &s->way[first + 1]))
        first++;
    while (last > first && !is_progress(&s->way[last - 1], &s->way[last]))
        last--;
    if (first == last)
        return true;
    for (size_t i = first; i <= last; i++)
        width = fmax(width, s->way[i].gap);
    if (!il_grow(&s->channel, &s->cap_channels, s->n_channels + 1, sizeof *s->channel))
        return false;
    s->channel[s->n_channels++] = (il_channel){ { s->way[first].a, s->way[last].a }, { s->way[first].b, s->way[last].b }, width };
    return true;
}

/* Vertices from A onwards to B, without those at the places themselves. */
static size_t count_between(const il_outline *o, const il_place *a, const il_place *b)
{
    size_t first = next_vertex(o, a, true), last = next_vertex(o, b, false);
    return last >= first ? last - first + 1 : last + 1 == first ? 0 : last + o->n - first + 1;
}

/* The walks from vertex V on one side and the place beside it on edge E. */
static bool grow_seed(search *s, size_t v, size_t e)
{
    const il_outline *o = s->o;
    il_place begin = place_at_vertex(o, e), a = place_at_vertex(o, v);
    state seed = { .a = a, .b = nearest_ahead(o, &begin, true, a.p) };
    seed.gap = distance(seed.a.p, seed.b.p);
    bool ok = true, fresh = true;
    if (seed.gap > s->tolerance || (seed.b.at_vertex && seed.b.edge == v))
        return true;
    if (!mark_state(s, &seed, &ok))
        return ok;
    s->n = 0;
    seed.between = count_between(o, &seed.b, &seed.a);
    ok = walk(s, &seed, false, &fresh) && il_grow(&s->way, &s->cap, s->n + 1, sizeof *s->way);
    reverse_way(s);
    if (ok)
        s->way[s->n++] = seed;
    seed.between = count_between(o, &seed.a, &seed.b);
    ok = ok && walk(s, &seed, true, &fresh);
    return ok && fresh ? add_channel(s) : ok;
}

/* ---- where to begin ---------------------------------------------------------------- */

enum { PAIRS_PER_EDGE = 64 };

/* In tolerances: what lies between the sides of a channel at least.  The area of
 * the loop there is not above perimeter^2 / (4 pi), and a keyhole's is at least two
 * tolerances times the perimeter (keyhole.h), which makes that 8 pi, less the chord.
 * Without it, a smooth outline of points much denser than the tolerance is beside
 * itself everywhere: 500 000 points took 43 s and 2.6 GB. */
static const double SHORTEST_LOOP = 20;

/* Pairs of edges whose boxes are within the tolerance; none where there are too many. */
static il_status find_near_edges(const il_outline *o, double tolerance, uint32_t **pair, size_t *n, il_error *err)
{
    double *box = il_alloc(o->n, 4 * sizeof *box);
    *pair = NULL;
    *n = 0;
    if (!box)
        return il_fail_nomem(err);
    for (size_t i = 0; i < o->n; i++) {
        const double *p = o->xy + 2 * i, *q = o->xy + 2 * after(o, i);
        for (int k = 0; k < 2; k++) {
            box[4 * i + (size_t)k] = fmin(p[k], q[k]) - tolerance / 2;
            box[4 * i + 2 + (size_t)k] = fmax(p[k], q[k]) + tolerance / 2;
        }
    }
    il_error dense = IL_ERROR_INIT;
    il_status st = il_box_pairs(box, o->n, PAIRS_PER_EDGE * o->n, pair, n, &dense);
    il_free(box);
    if (st == IL_E_INPUT)
        return IL_OK;
    if (st != IL_OK && err)
        *err = dense;
    return st;
}

static bool are_neighbours(const il_outline *o, size_t i, size_t j)
{
    return after(o, i) == j || after(o, j) == i;
}

/* Is less than SHORTEST of the outline between edges I and J?  No loop longer than
 * that lies between them then, so that they belong to no channel. */
static bool are_close_along(const il_outline *o, size_t i, size_t j, double shortest)
{
    size_t low = i < j ? i : j, high = i < j ? j : i;
    double inside = o->length[high + 1] - o->length[low];
    return fmin(inside, il_outline_length(o) + o->length[low + 1] - o->length[high]) < shortest;
}

il_status il_channels_find(const il_outline *o, double tolerance, il_channel **channel, size_t *n, il_error *err)
{
    search s = { .o = o, .tolerance = tolerance };
    uint32_t *pair = NULL;
    size_t n_pairs = 0;
    bool ok = true;
    *channel = NULL;
    *n = 0;
    il_status st = o->n < 3 ? IL_OK : find_near_edges(o, tolerance, &pair, &n_pairs, err);
    for (size_t k = 0; k < n_pairs && ok; k++) {
        size_t i = pair[2 * k], j = pair[2 * k + 1];
        if (are_neighbours(o, i, j) || are_close_along(o, i, j, SHORTEST_LOOP * tolerance))
            continue;
        ok = grow_seed(&s, i, j) && grow_seed(&s, after(o, i), j) && grow_seed(&s, j, i) && grow_seed(&s, after(o, j), i);
    }
    if (st == IL_OK && !ok)
        st = il_fail_nomem(err);
    if (st == IL_OK) {
        *channel = s.channel;
        *n = s.n_channels;
    } else {
        il_free(s.channel);
    }
    il_free(pair);
    il_free(s.way);
    il_keymap_free(&s.seen);
    return st;
}
