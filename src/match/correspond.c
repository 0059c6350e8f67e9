#include "config.h"
#include "match/correspond.h"
#include "base/alloc.h"
#include "base/zipper.h"

#include <math.h>
#include <string.h>

/* An upper point belongs to its foot when it is no further away than this, in
 * cells (deformed, or as it lies), and their outward normals make less than a
 * right angle, by a margin. */
static const double NEAR = 0.5, NEAR_AS_THEY_LIE = 2, NORMALS_AGREE = 0.2;

/* From one point to the next the foot may fall back or run ahead by this much,
 * in cells; points are 1.5 apart, more only on contours without end. */
static const double BACK = 0.75, AHEAD = 8;

void il_correspondence_free(il_correspondence *c)
{
    il_free(c->match);
    il_free(c->unmatched);
    *c = (il_correspondence)IL_CORRESPONDENCE_INIT;
}

/* Where an upper point falls: `at` cells along a lower ring. */
typedef struct foot {
    double at;
    uint32_t ring;
    bool good;
} foot;

typedef struct corresponder {
    const il_course *lower, *upper;
    bool as_they_lie;
    il_ffd *solver;
    size_t *vertex_point;     /* the lower course's point at each vertex of the outline */
    size_t *ring_begin;       /* [lower rings + 1] first vertex of each ring in the outline */
    foot *foot;               /* [upper->n] */
    bool *taken[2];           /* the way from this point to the next is in a matched arc */
    il_zip_vertex *list[2];   size_t n_list[2], cap_list[2];
    il_correspondence *out;
} corresponder;

/* ---- feet ---- */

static bool index_vertices(corresponder *c)
{
    const il_course *l = c->lower;
    size_t n = 0;
    c->ring_begin = il_alloc(l->n_rings + 1, sizeof *c->ring_begin);
    c->vertex_point = il_alloc(l->n, sizeof *c->vertex_point);
    if (!c->ring_begin || !c->vertex_point)
        return false;
    for (size_t r = 0; r < l->n_rings; r++) {
        c->ring_begin[r] = n;
        for (size_t k = l->first[r]; k < l->first[r + 1]; k++)
            if (l->point[k].t == 0)
                c->vertex_point[n++] = k;
    }
    c->ring_begin[l->n_rings] = n;
    return true;
}

/* The lower course's point at the vertex behind vertex V of the outline, and in
 * *END how far along the ring that is, its whole length at its first vertex. */
static size_t next_vertex(const corresponder *c, size_t v, double *end)
{
    const il_course *l = c->lower;
    uint32_t ring = l->point[c->vertex_point[v]].ring;
    bool is_last = v + 1 == c->ring_begin[ring + 1];
    size_t w = is_last ? l->first[ring] : c->vertex_point[v + 1];
    *end = is_last ? l->length[ring] : l->point[w].at;
    return w;
}

static void find_foot(corresponder *c, size_t k)
{
    const il_course_point *p = &c->upper->point[k];
    double near = c->as_they_lie ? NEAR_AS_THEY_LIE : NEAR;
    il_foot f = il_ffd_foot(c->solver, p->x, p->y);
    const il_course_point *v = &c->lower->point[c->vertex_point[f.segment]];
    double end;
    const il_course_point *w = &c->lower->point[next_vertex(c, f.segment, &end)];
    double length = end - v->at;
    double dx = w->x - v->x, dy = w->y - v->y, cosine = length > 0 ? (p->nx * dy - p->ny * dx) / length : 0;
    c->foot[k] = (foot){ v->at + f.t * length, v->ring, f.distance <= near && cosine > NORMALS_AGREE };
}

/* How far the foot runs on from upper point K to point P, the shorter way. */
static double advance_to(const corresponder *c, size_t k, size_t p)
{
    double length = c->lower->length[c->foot[k].ring], d = c->foot[p].at - c->foot[k].at;
    return d - length * round(d / length);
}

/* The same to the point after K. */
static double advance(const corresponder *c, size_t k)
{
    return advance_to(c, k, il_course_after(c->upper, k));
}

/* So many points in a row that fit badly, at a spike say, do not end an arc. */
enum { GAP = 3 };

/* Points between good ones that the feet pass over get feet in between. */
static void bridge_gap(corresponder *c, size_t k)
{
    const il_course *u = c->upper;
    size_t end = il_course_after(u, k), n = 1;
    while (!c->foot[end].good && n <= GAP && end != k)
        end = il_course_after(u, end), n++;
    if (n == 1 || end == k || !c->foot[end].good || c->foot[end].ring != c->foot[k].ring)
        return;
    double length = c->lower->length[c->foot[k].ring], d = advance_to(c, k, end);
    if (d < 0 || d > AHEAD)
        return;
    for (size_t i = 1, p = il_course_after(u, k); i < n; i++, p = il_course_after(u, p)) {
        double at = c->foot[k].at + d * (double)i / (double)n;
        c->foot[p] = (foot){ at < length ? at : at - length, c->foot[k].ring, true };
    }
}

/* Do point K and the one after it belong to one arc? */
static bool runs_on(const corresponder *c, size_t k)
{
    const foot *a = &c->foot[k], *b = &c->foot[il_course_after(c->upper, k)];
    if (!a->good || !b->good || a->ring != b->ring)
        return false;
    double d = advance(c, k);
    return d >= -BACK && d <= AHEAD;
}

/* ---- matched arcs ---- */

/* The vertex of the lower course nearest along the ring to the foot of point K. */
static size_t vertex_at_foot(const corresponder *c, size_t k)
{
    const foot *f = &c->foot[k];
    const il_course *l = c->lower;
    size_t low = c->ring_begin[f->ring], high = c->ring_begin[f->ring + 1];
    while (high - low > 1) { /* the last vertex at or before the foot */
        size_t middle = (low + high) / 2;
        if (l->point[c->vertex_point[middle]].at <= f->at)
            low = middle;
        else
            high = middle;
    }
    double end;
    size_t v = c->vertex_point[low], w = next_vertex(c, low, &end);
    return f->at - l->point[v].at <= end - f->at ? v : w;
}

static il_place place_of(const il_course_point *p)
{
    return (il_place){ p->ring, p->vertex, p->t };
}

static bool list_point(corresponder *c, int side, const il_course_point *p, double place)
{
    if (!il_grow(&c->list[side], &c->cap_list[side], c->n_list[side] + 1, sizeof **c->list))
        return false;
    c->list[side][c->n_list[side]++] = (il_zip_vertex){ p->x, p->y, 0, (size_t)fmax(place * 16, 0) };
    return true;
}

/* The points of the arcs from (l0, u0) to (l1, u1), all of the rings when they
 * are equal, marked as taken. */
static bool list_arcs(corresponder *c, size_t l0, size_t l1, size_t u0, size_t u1)
{
    double length = c->lower->length[c->lower->point[l0].ring], along = 0;
    c->n_list[0] = c->n_list[1] = 0;
    for (size_t k = l0;;) {
        double at = c->lower->point[k].at - c->lower->point[l0].at;
        bool last = k == l1 && c->n_list[0] > 0;
        if (!list_point(c, 0, &c->lower->point[k], at < 0 ? at + length : last && at == 0 ? length : at))
            return false;
        if (last)
            break;
        c->taken[0][k] = true;
        k = il_course_after(c->lower, k);
    }
    for (size_t k = u0;;) {
        bool last = k == u1 && c->n_list[1] > 0;
        if (!list_point(c, 1, &c->upper->point[k], along))
            return false;
        if (last)
            break;
        c->taken[1][k] = true;
        along += fmax(advance(c, k), 0);
        k = il_course_after(c->upper, k);
    }
    return true;
}

static double to_segment(const il_zip_vertex *p, const il_zip_vertex *a, const il_zip_vertex *b)
{
    double dx = b->x - a->x, dy = b->y - a->y, length2 = dx * dx + dy * dy;
    double t = length2 > 0 ? fmin(fmax(((p->x - a->x) * dx + (p->y - a->y) * dy) / length2, 0), 1) : 0;
    return hypot(a->x + t * dx - p->x, a->y + t * dy - p->y);
}

/* Of upper point J from the lower arc next to its point I. */
static double distance_at(const corresponder *c, size_t i, size_t j)
{
    const il_zip_vertex *l = c->list[0], *u = &c->list[1][j];
    double before = i > 0 ? to_segment(u, &l[i - 1], &l[i]) : INFINITY;
    return i + 1 < c->n_list[0] ? fmin(before, to_segment(u, &l[i], &l[i + 1])) : before;
}

/* Mean and largest distance of the upper points from the lower arc where the best
 * monotone pairing has them: not from its points, which may be half their spacing
 * off along the contour. */
static il_status pair_up(corresponder *c, il_match *m, il_error *err)
{
    unsigned char *step = NULL;
    size_t n = c->n_list[0] + c->n_list[1] - 2, i = 0;
    il_status st = il_zip(c->list[0], c->n_list[0], c->list[1], c->n_list[1], &step, err);
    if (st != IL_OK)
        return st;
    double sum = 0;
    for (size_t j = 0, k = 0; j < c->n_list[1]; j++, k++) {
        double d = distance_at(c, i, j);
        for (; k < n && !step[k]; k++)
            d = fmin(d, distance_at(c, ++i, j));
        sum += d;
        m->residual_max = fmax(m->residual_max, d);
    }
    m->residual_mean = sum / (double)c->n_list[1];
    il_free(step);
    return IL_OK;
}

static il_status add_match(corresponder *c, size_t l0, size_t l1, size_t u0, size_t u1, il_error *err)
{
    il_correspondence *o = c->out;
    il_match m = { { place_of(&c->lower->point[l0]), place_of(&c->lower->point[l1]) },
                   { place_of(&c->upper->point[u0]), place_of(&c->upper->point[u1]) }, 0, 0, c->as_they_lie };
    if (!list_arcs(c, l0, l1, u0, u1) || !il_grow(&o->match, &o->cap_matches, o->n_matches + 1, sizeof *o->match))
        return il_fail_nomem(err);
    il_status st = pair_up(c, &m, err);
    if (st == IL_OK)
        o->match[o->n_matches++] = m;
    return st;
}

/* Does all of upper ring R run once round one lower ring? */
static bool runs_round(const corresponder *c, size_t r)
{
    const il_course *u = c->upper;
    double sum = 0;
    for (size_t k = u->first[r]; k < u->first[r + 1]; k++) {
        if (!runs_on(c, k))
            return false;
        sum += advance(c, k);
    }
    return sum > 0.5 * c->lower->length[c->foot[u->first[r]].ring];
}

/* The whole of upper ring R, begun at the vertex that lies nearest to one below. */
static il_status match_ring(corresponder *c, size_t r, il_error *err)
{
    const il_course *u = c->upper, *l = c->lower;
    double least = INFINITY;
    size_t u0 = u->first[r], l0 = 0;
    for (size_t k = u->first[r]; k < u->first[r + 1]; k++) {
        if (u->point[k].t != 0)
            continue;
        size_t v = vertex_at_foot(c, k);
        double d = hypot(l->point[v].x - u->point[k].x, l->point[v].y - u->point[k].y);
        if (d < least) {
            least = d;
            u0 = k;
            l0 = v;
        }
    }
    /* another ring may have come round there already */
    return c->taken[0][l0] ? IL_OK : add_match(c, l0, l0, u0, u0, err);
}

/* Is any of the way from lower point A to B taken? */
static bool is_taken(const corresponder *c, size_t a, size_t b)
{
    for (size_t k = a; k != b; k = il_course_after(c->lower, k))
        if (c->taken[0][k])
            return true;
    return false;
}

/* The run of upper points FROM .. TO: begin and end it at vertices. */
static il_status match_run(corresponder *c, size_t from, size_t to, il_error *err)
{
    const il_course *u = c->upper;
    while (from != to && u->point[from].t != 0)
        from = il_course_after(u, from);
    while (from != to && u->point[to].t != 0)
        to = il_course_before(u, to);
    if (from == to)
        return IL_OK;
    double along = 0;
    for (size_t k = from; k != to; k = il_course_after(u, k))
        along += advance(c, k);
    size_t l0 = vertex_at_foot(c, from), l1 = vertex_at_foot(c, to);
    double length = c->lower->length[c->foot[from].ring];
    if (l0 == l1 && along > length / 2) /* almost all round */
        do
            l1 = il_course_before(c->lower, l1);
        while (c->lower->point[l1].t != 0 && l1 != l0);
    double way = c->lower->point[l1].at - c->lower->point[l0].at;
    way += way < 0 ? length : 0;
    /* feet that turn round, or round the ring: no arc in the sense of a match */
    if (l0 == l1 || fabs(way - along) > 0.5 * length || is_taken(c, l0, l1))
        return IL_OK;
    return add_match(c, l0, l1, from, to, err);
}

static il_status match_runs(corresponder *c, size_t r, il_error *err)
{
    const il_course *u = c->upper;
    size_t first = u->first[r], start = first;
    while (start < u->first[r + 1] && runs_on(c, il_course_before(u, start)))
        start++;
    if (start == u->first[r + 1])
        return IL_OK; /* it runs on all round, but not once round a ring */
    il_status st = IL_OK;
    size_t k = start;
    do {
        size_t from = k;
        while (runs_on(c, k))
            k = il_course_after(u, k);
        if (from != k)
            st = match_run(c, from, k, err);
        k = il_course_after(u, k);
    } while (st == IL_OK && k != start);
    return st;
}

/* ---- what is left ---- */

/* What an arc, or the whole of a ring, was that has no partner. */
static il_event event_of(const corresponder *c, const il_course *course, size_t ring, bool whole)
{
    double area2 = 0;
    if (!whole)
        return c->lower->n_rings != c->upper->n_rings ? IL_EVENT_BRANCH : IL_EVENT_CAP;
    for (size_t k = course->first[ring]; k < course->first[ring + 1]; k++) {
        const il_course_point *p = &course->point[k], *q = &course->point[il_course_after(course, k)];
        area2 += p->x * q->y - q->x * p->y;
    }
    return area2 < 0 ? IL_EVENT_HOLE : IL_EVENT_CAP;
}

static bool add_unmatched(corresponder *c, bool upper, size_t from, size_t to, size_t ring, bool whole)
{
    const il_course *course = upper ? c->upper : c->lower;
    il_correspondence *o = c->out;
    if (!il_grow(&o->unmatched, &o->cap_unmatched, o->n_unmatched + 1, sizeof *o->unmatched))
        return false;
    o->unmatched[o->n_unmatched++] = (il_unmatched){ upper,
        { place_of(&course->point[from]), place_of(&course->point[to]) }, event_of(c, course, ring, whole) };
    return true;
}

/* What is between the matched arcs of a ring. */
static bool list_unmatched(corresponder *c, bool upper, size_t r)
{
    const il_course *course = upper ? c->upper : c->lower;
    const bool *taken = c->taken[upper];
    size_t first = course->first[r], end = course->first[r + 1], start = first;
    while (start < end && !taken[start])
        start++;
    if (start == end)
        return add_unmatched(c, upper, first, first, r, true);
    size_t k = start;
    do {
        size_t from = k = il_course_after(course, k);
        while (!taken[k])
            k = il_course_after(course, k);
        if (k != from && !add_unmatched(c, upper, from, k, r, false))
            return false;
    } while (k != start);
    return true;
}

il_status il_correspond(il_correspondence *out, const il_course *lower, const il_course *upper, bool as_they_lie,
                        il_ffd *solver, il_error *err)
{
    corresponder c = { .lower = lower, .upper = upper, .as_they_lie = as_they_lie, .solver = solver, .out = out };
    c.foot = il_alloc(upper->n, sizeof *c.foot);
    c.taken[0] = il_calloc(lower->n, sizeof **c.taken);
    c.taken[1] = il_calloc(upper->n, sizeof **c.taken);
    il_status st = c.foot && c.taken[0] && c.taken[1] && index_vertices(&c) ? IL_OK : il_fail_nomem(err);
    for (size_t k = 0; st == IL_OK && k < upper->n; k++)
        find_foot(&c, k);
    for (size_t k = 0; st == IL_OK && k < upper->n; k++)
        if (c.foot[k].good)
            bridge_gap(&c, k);
    for (size_t r = 0; st == IL_OK && r < upper->n_rings; r++)
        if (runs_round(&c, r))
            st = match_ring(&c, r, err);
    for (size_t r = 0; st == IL_OK && r < upper->n_rings; r++)
        if (!c.taken[1][upper->first[r]])
            st = match_runs(&c, r, err);
    for (size_t r = 0; st == IL_OK && r < lower->n_rings; r++)
        st = list_unmatched(&c, false, r) ? IL_OK : il_fail_nomem(err);
    for (size_t r = 0; st == IL_OK && r < upper->n_rings; r++)
        st = list_unmatched(&c, true, r) ? IL_OK : il_fail_nomem(err);
    il_free(c.vertex_point);
    il_free(c.ring_begin);
    il_free(c.foot);
    il_free(c.taken[0]);
    il_free(c.taken[1]);
    il_free(c.list[0]);
    il_free(c.list[1]);
    if (st != IL_OK)
        il_correspondence_free(out);
    return st;
}
