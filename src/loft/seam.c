/* seam.c - arcs laid on each other.
 *
 * The arc of the upper slice, deformed, lies along that of the lower but for the
 * residual of phi.  Each of its vertices is given a parameter on the lower arc:
 * the arc length of the nearest point, made monotone by isotonic regression
 * (pool adjacent violators; Ayer et al. 1955), and with a little of the vertex's
 * own share of the arc's length, which parts what is pooled in one point. */
#include "config.h"
#include "loft/seam.h"
#include "base/alloc.h"
#include "base/nearest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double OWN_SHARE = 0.15;

/* On edge STATION at t in [0, 1). */
typedef struct spot {
    uint32_t station;
    double t;
} spot;

/* A point of an arc.  soft: a bend of phi only, no vertex of the slice.  length:
 * along the arc so far; s: the parameter on the lower arc. */
typedef struct knot {
    spot at;
    double x, y, length, s;
    bool soft;
} knot;

typedef struct arc {
    knot *k; size_t n, cap;
} arc;

typedef struct layer {
    const il_section *section[2];
    const il_phi *phi;
    double near;
    arc arc[2];
    il_nearest tree;          /* of the lower arc's segments */
    double *mean; size_t *weight, cap_mean, cap_weight;
} layer;

/* ---- places ---- */

static bool is_same(spot a, spot b)
{
    return a.station == b.station && a.t == b.t;
}

/* The spot of a place: edges may have been split since. */
static bool find_spot(const il_section *s, il_place at, spot *out)
{
    if (at.ring >= s->n_rings)
        return false;
    uint32_t low = il_section_first_station(s, at.ring), high = il_section_first_station(s, at.ring + (size_t)1), end = high;
    if (low == high)
        return false; /* not of this group */
    uint32_t first = low;
    while (high - low > 1) { /* the last station that is not behind the place */
        uint32_t middle = low + (high - low) / 2;
        bool behind = s->vertex_at[middle] > at.vertex || (s->vertex_at[middle] == at.vertex && s->t_at[middle] > at.t);
        *(behind ? &high : &low) = middle;
    }
    if (s->vertex_at[low] != at.vertex || s->vertex_at[end - 1] < at.vertex)
        return false;
    double from = s->t_at[low], to = il_section_end_t(s, low);
    *out = (spot){ low, (at.t - from) / (to - from) };
    if (!(out->t < 1))
        *out = (spot){ low + 1 < end ? low + 1 : first, 0 };
    return true;
}

/* The place of a spot on the slice as it came. */
static il_place place_of(const il_section *s, spot p)
{
    double from = s->t_at[p.station], to = il_section_end_t(s, p.station);
    return (il_place){ s->ring_at[p.station], s->vertex_at[p.station], from + p.t * (to - from) };
}

/* ---- knots ---- */

static bool add_knot(layer *l, int side, spot at, double x, double y, bool soft)
{
    arc *a = &l->arc[side];
    if (!il_grow(&a->k, &a->cap, a->n + 1, sizeof *a->k))
        return false;
    a->k[a->n++] = (knot){ at, x, y, 0, 0, soft };
    return true;
}

static bool add_spot(layer *l, int side, spot at)
{
    const il_section *s = l->section[side];
    double xy[2];
    if (side == IL_UPPER) {
        il_phi_at(l->phi, place_of(s, at), xy);
    } else {
        const double *a = s->xy + 2 * s->node_at[at.station], *b = s->xy + 2 * s->node_at[s->next[at.station]];
        xy[0] = a[0] + at.t * (b[0] - a[0]);
        xy[1] = a[1] + at.t * (b[1] - a[1]);
    }
    return add_knot(l, side, at, xy[0], xy[1], false);
}

/* The bends of phi on edge STATION of the upper section, between FROM and TO. */
static bool add_bends(layer *l, uint32_t station, double from, double to)
{
    const il_section *s = l->section[IL_UPPER];
    il_place at = place_of(s, (spot){ station, from });
    double t0 = s->t_at[station], t1 = il_section_end_t(s, station);
    const il_phi_point *row = l->phi->pair->phi;
    for (size_t i = il_phi_row_after(l->phi, at); i < l->phi->first[at.ring + 1] && row[i].at.vertex == at.vertex; i++) {
        double t = (row[i].at.t - t0) / (t1 - t0);
        if (!(t < to))
            break;
        if (t > from && !add_knot(l, IL_UPPER, (spot){ station, t }, row[i].x, row[i].y, true))
            return false;
    }
    return true;
}

/* From A to B along the ring; once round it when they are the same. */
static bool walk(layer *l, int side, spot a, spot b)
{
    const il_section *s = l->section[side];
    l->arc[side].n = 0;
    bool ok = add_spot(l, side, a), ahead = b.t > a.t;
    for (spot at = a; ok;) {
        bool last = at.station == b.station && ahead;
        if (side == IL_UPPER)
            ok = add_bends(l, at.station, at.t, last ? b.t : 1);
        at = last ? b : (spot){ s->next[at.station], 0 };
        ok = ok && add_spot(l, side, at);
        if (last || is_same(at, b))
            break;
        ahead = true;
    }
    return ok;
}

/* Lengths along the arc; false when it has none, or is not finite. */
static bool measure(arc *a)
{
    a->k[0].length = 0;
    for (size_t i = 1; i < a->n; i++)
        a->k[i].length = a->k[i - 1].length + hypot(a->k[i].x - a->k[i - 1].x, a->k[i].y - a->k[i - 1].y);
    double length = a->k[a->n - 1].length;
    return length > 0 && isfinite(length);
}

/* ---- parameters ---- */

static il_status build_tree(layer *l, il_error *err)
{
    const arc *a = &l->arc[IL_LOWER];
    il_segment *segment = il_alloc(a->n - 1, sizeof *segment);
    if (!segment)
        return il_fail_nomem(err);
    for (size_t i = 0; i + 1 < a->n; i++)
        segment[i] = (il_segment){ a->k[i].x, a->k[i].y, a->k[i + 1].x, a->k[i + 1].y, 0, i };
    il_nearest_free(&l->tree);
    return il_nearest_build(&l->tree, segment, a->n - 1, 1, err);
}

/* The place on the lower arc nearest to upper knot I, on what runs the same way. */
static bool find_foot(const layer *l, size_t i, il_nearest_place *foot)
{
    const arc *a = &l->arc[IL_UPPER];
    const knot *before = &a->k[i > 0 ? i - 1 : a->n - 2], *after = &a->k[i + 1 < a->n ? i + 1 : 1];
    return il_nearest_find(&l->tree, 0, a->k[i].x, a->k[i].y, after->x - before->x, after->y - before->y, foot);
}

/* Arcs that are whole rings: of all vertices and the lower vertices at their
 * feet, the nearest pair begins both. */
static bool best_start(const layer *l, spot start[2])
{
    const arc *low = &l->arc[IL_LOWER], *up = &l->arc[IL_UPPER];
    double least = INFINITY;
    for (size_t i = 0; i + 1 < up->n; i++) {
        il_nearest_place foot;
        if (up->k[i].soft || up->k[i].at.t > 0 || !find_foot(l, i, &foot))
            continue;
        for (size_t j = foot.id; j <= foot.id + 1; j++) {
            double far = hypot(up->k[i].x - low->k[j].x, up->k[i].y - low->k[j].y);
            if (low->k[j].at.t == 0 && far < least) {
                least = far;
                start[IL_LOWER] = low->k[j].at;
                start[IL_UPPER] = up->k[i].at;
            }
        }
    }
    return isfinite(least);
}

/* The nearest places as arc lengths; of a ring's, the turn nearest to what the
 * knot's own share of the length lets expect. */
static void project(layer *l, bool closed)
{
    const arc *low = &l->arc[IL_LOWER];
    arc *up = &l->arc[IL_UPPER];
    double length = low->k[low->n - 1].length, own = up->k[up->n - 1].length;
    for (size_t i = 1; i + 1 < up->n; i++) {
        double expected = up->k[i].length / own * length, s = expected;
        il_nearest_place foot;
        if (find_foot(l, i, &foot))
            s = low->k[foot.id].length + foot.t * (low->k[foot.id + 1].length - low->k[foot.id].length);
        if (closed)
            s += rint((expected - s) / length) * length;
        up->k[i].s = fmin(fmax(s, 0), length);
    }
    up->k[0].s = 0;
    up->k[up->n - 1].s = length;
}

/* Isotonic regression of s by pooling neighbours that fall.  O(n). */
static bool make_monotone(layer *l)
{
    arc *up = &l->arc[IL_UPPER];
    if (!il_grow(&l->mean, &l->cap_mean, up->n, sizeof *l->mean) ||
        !il_grow(&l->weight, &l->cap_weight, up->n, sizeof *l->weight))
        return false;
    size_t n = 0;
    for (size_t i = 0; i < up->n; i++) {
        l->mean[n] = up->k[i].s;
        l->weight[n++] = 1;
        for (; n > 1 && l->mean[n - 1] <= l->mean[n - 2]; n--) {
            double a = (double)l->weight[n - 2], b = (double)l->weight[n - 1];
            l->mean[n - 2] = (a * l->mean[n - 2] + b * l->mean[n - 1]) / (a + b);
            l->weight[n - 2] += l->weight[n - 1];
        }
    }
    for (size_t i = 0, k = 0; k < n; k++)
        for (size_t j = 0; j < l->weight[k]; j++)
            up->k[i++].s = l->mean[k];
    return true;
}

/* False when two knots get the same parameter. */
static bool blend(layer *l)
{
    arc *up = &l->arc[IL_UPPER];
    double length = l->arc[IL_LOWER].k[l->arc[IL_LOWER].n - 1].length, own = up->k[up->n - 1].length;
    for (size_t i = 1; i + 1 < up->n; i++)
        up->k[i].s = (1 - OWN_SHARE) * up->k[i].s + OWN_SHARE * (up->k[i].length / own * length);
    up->k[0].s = 0;
    up->k[up->n - 1].s = length;
    for (size_t i = 1; i < up->n; i++)
        if (!(up->k[i].s > up->k[i - 1].s))
            return false;
    return true;
}

/* ---- the seam ---- */

/* The t that knot B has as the end of the edge from knot A. */
static double end_t(const knot *a, const knot *b)
{
    return b->at.station == a->at.station && b->at.t > 0 ? b->at.t : 1;
}

/* Between knots A and B, PART of the way. */
static spot between(const knot *a, const knot *b, double part, double xy[2])
{
    xy[0] = a->x + part * (b->x - a->x);
    xy[1] = a->y + part * (b->y - a->y);
    return (spot){ a->at.station, a->at.t + part * (end_t(a, b) - a->at.t) };
}

static void put(il_seam_vertex *v, int side, spot at)
{
    v->station[side] = at.station;
    v->t[side] = at.t;
}

/* Lower knot I with upper knot J. */
static il_seam_vertex vertex_of_both(const layer *l, size_t i, size_t j)
{
    const knot *low = &l->arc[IL_LOWER].k[i], *up = &l->arc[IL_UPPER].k[j];
    il_seam_vertex v = { .xy = { low->x, low->y }, .at = { { low->x, low->y }, { up->x, up->y } } };
    put(&v, IL_LOWER, low->at);
    put(&v, IL_UPPER, up->at);
    return v;
}

/* Lower knot I, between upper knots *J - 1 and *J, which go on with it. */
static il_seam_vertex vertex_of_lower(const layer *l, size_t i, size_t *j)
{
    const knot *low = &l->arc[IL_LOWER].k[i], *up = l->arc[IL_UPPER].k;
    il_seam_vertex v = { .xy = { low->x, low->y }, .at = { { low->x, low->y }, { 0, 0 } } };
    while (up[*j].s <= low->length && *j + 1 < l->arc[IL_UPPER].n)
        ++*j;
    const knot *a = &up[*j - 1], *b = &up[*j];
    put(&v, IL_LOWER, low->at);
    put(&v, IL_UPPER, between(a, b, (low->length - a->s) / (b->s - a->s), v.at[IL_UPPER]));
    return v;
}

/* Upper knot J, between lower knots I - 1 and I. */
static il_seam_vertex vertex_of_upper(const layer *l, size_t i, size_t j)
{
    const knot *a = &l->arc[IL_LOWER].k[i - 1], *b = &l->arc[IL_LOWER].k[i], *up = &l->arc[IL_UPPER].k[j];
    il_seam_vertex v = { .at = { { 0, 0 }, { up->x, up->y } } };
    put(&v, IL_LOWER, between(a, b, (up->s - a->length) / (b->length - a->length), v.xy));
    put(&v, IL_UPPER, up->at);
    memcpy(v.at[IL_LOWER], v.xy, sizeof v.xy);
    return v;
}

static size_t next_hard(const arc *a, size_t j)
{
    for (j++; j + 1 < a->n && a->k[j].soft; j++)
        continue;
    return j;
}

/* Is lower knot I put on upper knot J?  When they are near, and neither has a
 * nearer one ahead. */
static bool is_pair(const layer *l, size_t i, size_t j)
{
    const arc *low = &l->arc[IL_LOWER], *up = &l->arc[IL_UPPER];
    double far = fabs(low->k[i].length - up->k[j].s);
    size_t after = next_hard(up, j);
    if (far > l->near)
        return false;
    return !(after + 1 < up->n && fabs(low->k[i].length - up->k[after].s) < far) &&
           !(i + 2 < low->n && fabs(low->k[i + 1].length - up->k[j].s) < far);
}

static bool append(il_seam *s, il_seam_vertex v)
{
    if (!il_grow(&s->v, &s->cap, s->n + 1, sizeof *s->v))
        return false;
    s->v[s->n++] = v;
    return true;
}

static bool merge(const layer *l, il_seam *out)
{
    const arc *low = &l->arc[IL_LOWER], *up = &l->arc[IL_UPPER];
    size_t i = 1, j = next_hard(up, 0), last_i = low->n - 1, last_j = up->n - 1, ahead = 1;
    bool ok = append(out, vertex_of_both(l, 0, 0));
    while (ok && (i < last_i || j < last_j)) {
        if (i < last_i && j < last_j && is_pair(l, i, j)) {
            ok = append(out, vertex_of_both(l, i++, j));
            j = next_hard(up, j);
        } else if (j == last_j || (i < last_i && low->k[i].length < up->k[j].s)) {
            ok = append(out, vertex_of_lower(l, i++, &ahead));
        } else {
            ok = append(out, vertex_of_upper(l, i, j));
            j = next_hard(up, j);
        }
    }
    return ok && append(out, vertex_of_both(l, last_i, last_j));
}

/* Do both sides go on from vertex to vertex, in spite of rounding? */
static bool goes_on(const il_seam *s)
{
    for (size_t i = 0; i < s->n; i++)
        for (int k = 0; k < 2; k++) {
            if (!(s->v[i].t[k] >= 0 && s->v[i].t[k] < 1))
                return false;
            if (i > 0 && i + 1 < s->n && s->v[i].station[k] == s->v[i - 1].station[k] && !(s->v[i].t[k] > s->v[i - 1].t[k]))
                return false;
        }
    return true;
}

/* OUT stays empty when the arcs cannot be laid on each other. */
static il_status lay(layer *l, const il_match *m, il_seam *out, il_error *err)
{
    spot from[2], to[2];
    const il_arc *side[2] = { &m->lower, &m->upper };
    for (int k = 0; k < 2; k++)
        if (side[k]->from.ring != side[k]->to.ring || !find_spot(l->section[k], side[k]->from, &from[k]) ||
            !find_spot(l->section[k], side[k]->to, &to[k]))
            return IL_OK;
    bool closed = is_same(from[0], to[0]) && is_same(from[1], to[1]);
    for (int turn = 0; turn < 1 + closed; turn++) {
        if (!walk(l, IL_LOWER, from[0], to[0]) || !walk(l, IL_UPPER, from[1], to[1]))
            return il_fail_nomem(err);
        if (!measure(&l->arc[IL_LOWER]) || !measure(&l->arc[IL_UPPER]))
            return IL_OK;
        il_status st = build_tree(l, err);
        if (st != IL_OK)
            return st;
        if (turn < closed && !best_start(l, from))
            return IL_OK;
        if (closed)
            memcpy(to, from, sizeof to);
    }
    project(l, closed);
    if (!make_monotone(l))
        return il_fail_nomem(err);
    if (!blend(l))
        return IL_OK;
    if (!merge(l, out))
        return il_fail_nomem(err);
    if (!goes_on(out))
        out->n = 0;
    return IL_OK;
}

/* ---- seams beside each other ---- */

/* A seam's part of a ring, from its first vertex to its last. */
typedef struct stretch {
    uint32_t ring;
    spot from, to;
    size_t seam;
} stretch;

static int compare_spots(spot a, spot b)
{
    if (a.station != b.station)
        return a.station < b.station ? -1 : 1;
    return a.t < b.t ? -1 : a.t > b.t;
}

static int compare_stretches(const void *p, const void *q)
{
    const stretch *a = p, *b = q;
    int order = compare_spots(a->from, b->from);
    return order ? order : a->seam < b->seam ? -1 : a->seam > b->seam;
}

static spot spot_at(const il_seam *s, size_t i, int side)
{
    return (spot){ s->v[i].station[side], s->v[i].t[side] };
}

/* Does seam B begin where seam A ends, on SIDE? */
static bool joins(const il_seam *a, const il_seam *b, int side)
{
    return is_same(spot_at(a, a->n - 1, side), spot_at(b, 0, side));
}

/* Leave S out, or its last edge. */
static void shorten(il_seam *s, bool all)
{
    s->n = all || s->n <= 2 ? 0 : s->n - 1;
}

/* A before B on a ring (B may be A, or begin the ring anew: AROUND).  False when
 * they are not in each other's way. */
static bool settle_neighbours(il_seam *seam, const stretch *a, const stretch *b, bool around, int side)
{
    if (seam[a->seam].n == 0 || seam[b->seam].n == 0)
        return false;
    bool wraps = compare_spots(a->to, a->from) <= 0;
    int order = compare_spots(a->to, b->from);
    if (around ? wraps && order > 0 : wraps || order > 0) {
        shorten(&seam[a->seam > b->seam ? a->seam : b->seam], true);
        return true;
    }
    if (order != 0 || joins(&seam[a->seam], &seam[b->seam], !side))
        return false;
    shorten(&seam[a->seam], false);
    return true;
}

/* One look at all neighbours on SIDE; *CHANGED when something was cut.  What was
 * cut is looked at again. */
static bool settle_side(layer *l, il_seam *seam, size_t n, int side, bool *changed)
{
    stretch *list = il_alloc(n, sizeof *list);
    size_t count = 0;
    for (size_t i = 0; list && i < n; i++)
        if (seam[i].n > 0)
            list[count++] = (stretch){ l->section[side]->ring_at[seam[i].v[0].station[side]], spot_at(&seam[i], 0, side),
                                       spot_at(&seam[i], seam[i].n - 1, side), i };
    if (count > 1)
        qsort(list, count, sizeof *list, compare_stretches);
    for (size_t i = 0, first = 0; i < count; i++) {
        bool last = i + 1 == count || list[i + 1].ring != list[i].ring;
        *changed |= settle_neighbours(seam, &list[i], last ? &list[first] : &list[i + 1], last, side);
        if (last)
            first = i + 1;
    }
    il_free(list);
    return list != NULL;
}

/* Until nothing is in the way of anything; what takes too long is left out. */
static bool settle(layer *l, il_seam *seam, size_t n)
{
    size_t rounds = 0;
    for (bool changed = true; changed; rounds++) {
        changed = false;
        for (int side = 0; side < 2; side++)
            if (!settle_side(l, seam, n, side, &changed))
                return false;
        for (size_t i = 0; rounds > 1000 && i < n; i++)
            seam[i].n = 0;
    }
    return true;
}

il_status il_seams_lay(il_seam **seam, size_t *n_seams, const il_section *lower, const il_section *upper,
                       const il_phi *phi, const uint32_t *match, size_t n, double near, il_error *err)
{
    layer l = { .section = { lower, upper }, .phi = phi, .near = near };
    *n_seams = n;
    *seam = il_calloc(n, sizeof **seam);
    il_status st = *seam ? IL_OK : il_fail_nomem(err);
    for (size_t i = 0; st == IL_OK && i < n; i++)
        st = lay(&l, &phi->pair->match[match[i]], &(*seam)[i], err);
    if (st == IL_OK && !settle(&l, *seam, n))
        st = il_fail_nomem(err);
    il_nearest_free(&l.tree);
    il_free(l.arc[0].k);
    il_free(l.arc[1].k);
    il_free(l.mean);
    il_free(l.weight);
    if (st != IL_OK) {
        il_seams_free(*seam, n);
        *seam = NULL;
        *n_seams = 0;
    }
    return st;
}

double il_seams_length(const il_seam *seam, size_t n)
{
    double length = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 1; k < seam[i].n; k++)
            length += hypot(seam[i].v[k].xy[0] - seam[i].v[k - 1].xy[0], seam[i].v[k].xy[1] - seam[i].v[k - 1].xy[1]);
    return length;
}

/* Keep the N vertices of S from FIRST on. */
static void keep(il_seam *s, size_t first, size_t n)
{
    memmove(s->v, s->v + first, n * sizeof *s->v);
    s->n = n < 2 ? 0 : n;
}

static bool is_at(const il_seam_vertex *v, uint32_t station, double t)
{
    return v->station[IL_UPPER] == station && v->t[IL_UPPER] == t;
}

bool il_seams_cut(il_seam *seam, size_t n, uint32_t station, double t)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k + 1 < seam[i].n; k++)
            if (is_at(&seam[i].v[k], station, t)) {
                bool front = k < seam[i].n / 2;
                keep(&seam[i], front ? k + 1 : 0, front ? seam[i].n - k - 1 : k + 1);
                return true;
            }
    return false;
}

bool il_seams_cut_end(il_seam *seam, size_t n, uint32_t station, double t)
{
    for (size_t i = 0; i < n; i++) {
        if (seam[i].n == 0)
            continue;
        bool first = is_at(&seam[i].v[0], station, t), last = is_at(&seam[i].v[seam[i].n - 1], station, t);
        if (first || last) {
            keep(&seam[i], first, seam[i].n - 1);
            return true;
        }
    }
    return false;
}

void il_seams_free(il_seam *seam, size_t n)
{
    for (size_t i = 0; seam && i < n; i++)
        il_free(seam[i].v);
    il_free(seam);
}
