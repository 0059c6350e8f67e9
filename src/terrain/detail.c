#include "config.h"
#include "terrain/detail.h"
#include "base/alloc.h"
#include "terrain/cliff.h"
#include "terrain/refine.h"

#include <math.h>

/* Of a face's grain: how near to others a node may be put.  Of the whole map's mean edge: no face's
 * grain is finer, and no shorter chord is broken, where lines all but meet. */
static const double NEAREST = 0.25, FINEST = 0.4, CHORD = 0.001;

/* A triangle is looked at in so many steps along its edges, each about a grain long, and no finer
 * than LOOKS for each node of the chart would be on the whole map: looking is linear in those. */
static const double LOOKS = 8;
enum { STEPS_LEAST = 2, STEPS_MOST = 8 };

/* grain[face], mean: of all edges, and step: the least of a look, the mesh's unit.
 * queue[n_queue]: triangles to be looked at; is_queued[triangle].  tolerance: of what is done at
 * the time, in intervals. */
typedef struct detail {
    il_refine r;
    const il_law *law;
    const il_placement_options *o;
    double tolerance;
    double *grain, mean, step;
    uint32_t *queue;         size_t n_queue, cap_queue;
    unsigned char *is_queued; size_t n_flags, cap_flags;
} detail;

static const double *place(const detail *d, size_t k)
{
    return d->r.c->xy + 2 * (size_t)d->r.t->corner[k];
}

static double height(const detail *d, size_t k)
{
    return il_cliff_z(d->r.t, d->r.c, d->law->band, k);
}

static uint32_t face_of(const detail *d, size_t triangle)
{
    return d->r.t->face[triangle];
}

/* ---- heights for what has none ------------------------------------------------ */

/* Nodes that lie on no line: those of the frame, and what the frame cuts off. */
static void raise_rest(const detail *d)
{
    il_chart *c = d->r.c;
    for (size_t k = 0; k < 3 * d->r.t->n; k++) {
        uint32_t v = d->r.t->corner[k], f = face_of(d, k / 3);
        if (f != IL_CHART_NONE && isnan(c->node[v].z))
            c->node[v].z = il_law_height(d->law, f, c->xy[2 * (size_t)v], c->xy[2 * (size_t)v + 1]);
    }
}

/* ---- grain ---------------------------------------------------------------------- */

/* Twice the area of each face, and of all of them; the length of its lines, and how many edges. */
static void measure(const detail *d, double *area2, double *length, size_t *edges, double *whole2)
{
    const il_tin *t = d->r.t;
    const il_chart *c = d->r.c;
    for (size_t k = 0; k < t->n; k++) {
        if (t->face[k] == IL_CHART_NONE)
            continue;
        double a = il_tin_area2(t, c, k);
        *whole2 += a;
        area2[t->face[k]] += a;
    }
    for (size_t k = 0; k < 2 * t->n_sides; k++) {
        uint32_t f = t->side[k];
        if (f == IL_CHART_NONE || il_chart_is_frame(c, k / 2))
            continue;
        length[f] += il_chart_length(c, k / 2);
        edges[f]++;
    }
}

/* Of each face: the mean length of its lines' edges, or its area over half their length, which
 * is how far apart they lie, whichever is less. */
static bool find_grain(detail *d)
{
    size_t n = d->r.t->n_faces, *edges = il_calloc(n, sizeof *edges);
    double *area2 = il_calloc(n, sizeof *area2), *length = il_calloc(n, sizeof *length), whole2 = 0, sum = 0, count = 0;
    d->grain = il_calloc(n, sizeof *d->grain);
    bool ok = edges && area2 && length && d->grain;
    if (ok)
        measure(d, area2, length, edges, &whole2);
    for (size_t f = 0; f < n && ok; f++)
        sum += length[f], count += (double)edges[f];
    d->mean = count > 0 ? sum / count : 0;
    d->step = whole2 > 0 ? sqrt(whole2 / 2 / (LOOKS * (double)d->r.c->n_nodes)) : 0;
    for (size_t f = 0; f < n && ok; f++)
        d->grain[f] = fmax(edges[f] > 0 ? fmin(length[f] / (double)edges[f], area2[f] / length[f]) : 0, FINEST * d->mean);
    il_free(area2);
    il_free(length);
    il_free(edges);
    return ok;
}

/* ---- the queue ------------------------------------------------------------------- */

static bool add(detail *d, size_t triangle)
{
    if (d->is_queued[triangle] || face_of(d, triangle) == IL_CHART_NONE)
        return true;
    if (!il_grow(&d->queue, &d->cap_queue, d->n_queue + 1, sizeof *d->queue))
        return false;
    d->is_queued[triangle] = 1;
    d->queue[d->n_queue++] = (uint32_t)triangle;
    return true;
}

static bool add_flags(detail *d)
{
    size_t n = d->r.t->n;
    if (!il_grow(&d->is_queued, &d->cap_flags, n, 1))
        return false;
    for (; d->n_flags < n; d->n_flags++)
        d->is_queued[d->n_flags] = 0;
    return true;
}

/* What the last change left is to be looked at. */
static bool add_star(detail *d)
{
    bool ok = add_flags(d);
    for (size_t i = 0; i < d->r.n_star && ok; i++)
        ok = add(d, d->r.star[i]);
    return ok;
}

static bool add_all(detail *d)
{
    bool ok = add_flags(d);
    for (size_t t = 0; t < d->r.t->n && ok; t++)
        ok = add(d, t);
    return ok;
}

/* Show VISIT each triangle, and those that this changes once more, until none is left.  In rounds:
 * first come, first served, so that neighbours in the list are neighbours in the plane. */
static bool visit_all(detail *d, bool (*visit)(detail *d, size_t triangle))
{
    bool ok = add_all(d);
    while (ok && d->n_queue > 0) {
        uint32_t *round = d->queue;
        size_t n = d->n_queue;
        d->queue = NULL;
        d->n_queue = d->cap_queue = 0;
        for (size_t i = 0; i < n && ok; i++) {
            d->is_queued[round[i]] = 0;
            ok = visit(d, round[i]);
        }
        il_free(round);
    }
    return ok;
}

/* ---- one more node ----------------------------------------------------------------- */

static double law_at(const detail *d, size_t triangle, const double p[2])
{
    return il_law_height(d->law, face_of(d, triangle), p[0], p[1]);
}

/* Put a node near P in TRIANGLE, or on its edge K of the frame (SIZE_MAX: none), unless others
 * are nearer than LEAST; *DONE: there is one now. */
static bool put(detail *d, size_t triangle, size_t k, const double p[2], double least, bool *done)
{
    const double to[2] = { il_placement_round(d->o, p[0]), il_placement_round(d->o, p[1]) };
    uint32_t node = IL_CHART_NONE, f = face_of(d, triangle);
    *done = false;
    if (il_refine_clearance(&d->r, triangle, to) < least)
        return true;
    bool ok = k == SIZE_MAX ? il_refine_insert(&d->r, triangle, to, &node) : il_refine_divide(&d->r, k, to, &node);
    *done = node != IL_CHART_NONE;
    if (*done)
        d->r.c->node[node].z = il_law_height(d->law, f, to[0], to[1]);
    return ok && (!*done || add_star(d));
}

/* ---- the chordal axis ----------------------------------------------------------------- */

static bool is_level(const detail *d, size_t j, size_t k)
{
    const il_chart *c = d->r.c;
    bool on_lines = c->node[d->r.t->corner[j]].level >= 0 && c->node[d->r.t->corner[k]].level >= 0;
    return on_lines && height(d, j) == height(d, k);
}

static bool is_inner(const detail *d, size_t k)
{
    return d->r.t->edge[k] == IL_CHART_NONE && d->r.t->across[k] != IL_CHART_NONE;
}

/* How far edge K and the other diagonal of its two triangles, which form a convex quadrangle, are
 * off the law where they cross, in the unit of heights. */
static bool cross(const detail *d, size_t k, double off[2])
{
    size_t j = il_tin_twin(d->r.t, k), c = il_tin_after(il_tin_after(k)), e = il_tin_after(il_tin_after(j));
    const double *a = place(d, k), *b = place(d, j), *from = place(d, c), *to = place(d, e);
    double ab[2] = { b[0] - a[0], b[1] - a[1] }, ce[2] = { to[0] - from[0], to[1] - from[1] };
    double ac[2] = { from[0] - a[0], from[1] - a[1] }, area = ab[0] * ce[1] - ab[1] * ce[0], p[2];
    double s = (ac[0] * ce[1] - ac[1] * ce[0]) / area, t = (ac[0] * ab[1] - ac[1] * ab[0]) / area;
    if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1))
        return false; /* too thin for numbers */
    p[0] = a[0] + s * ab[0], p[1] = a[1] + s * ab[1];
    double z = law_at(d, k / 3, p);
    off[0] = fabs(height(d, k) + s * (height(d, j) - height(d, k)) - z);
    off[1] = fabs(height(d, c) + t * (height(d, e) - height(d, c)) - z);
    return true;
}

/* Is the other diagonal over edge K no chord, and nearer to the law: off by less than GAIN times
 * what K is off, which is more than LEAST intervals? */
static bool is_better_across(const detail *d, size_t k, double least, double gain)
{
    size_t j = il_tin_twin(d->r.t, k);
    double off[2];
    if (!il_refine_is_convex(&d->r, k) || is_level(d, il_tin_after(il_tin_after(k)), il_tin_after(il_tin_after(j))))
        return false;
    return cross(d, k, off) && off[0] > least * il_law_interval(d->law, face_of(d, k / 3)) && off[1] < gain * off[0];
}

static bool break_chord(detail *d, size_t k, bool *done)
{
    const double *a = place(d, k), *b = place(d, il_tin_after(k));
    const double p[2] = { a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2 };
    *done = false;
    if (is_better_across(d, k, d->tolerance, 1)) {
        *done = true;
        return il_refine_flip(&d->r, k) && add_star(d);
    }
    uint32_t f = face_of(d, k / 3);
    double least = d->tolerance * il_law_interval(d->law, f);
    if (!(fabs(law_at(d, k / 3, p) - height(d, k)) > least))
        return true;
    return put(d, k / 3, SIZE_MAX, p, CHORD * d->mean, done);
}

static bool break_chords(detail *d, size_t triangle)
{
    bool ok = true, done = false;
    for (size_t k = 3 * triangle; k < 3 * triangle + 3 && ok && !done; k++)
        if (is_inner(d, k) && is_level(d, k, il_tin_after(k)))
            ok = break_chord(d, k, &done);
    return ok;
}

/* ---- greedy insertion ---------------------------------------------------------------- */

/* edge: of the frame that it lies on, SIZE_MAX for none; off: in intervals. */
typedef struct spot {
    double p[2], off;
    size_t edge;
} spot;

/* Is edge K one to look at?  Not where the triangle across is still to come, which will; where lines
 * run along the frame, or end at both of its ends on one level, it is theirs. */
static bool is_open_edge(const detail *d, size_t k)
{
    const il_chart *c = d->r.c;
    uint32_t e = d->r.t->edge[k], across = d->r.t->across[k];
    if (e == IL_CHART_NONE)
        return across == IL_CHART_NONE || !d->is_queued[across];
    const il_chart_node *a = &c->node[d->r.t->corner[k]], *b = &c->node[d->r.t->corner[il_tin_after(k)]];
    return il_chart_is_frame(c, e) && !(a->level >= 0 && b->level >= 0 && a->level <= b->top && b->level <= a->top);
}

static bool is_near(const double a[2], const double b[2], double distance)
{
    double x = b[0] - a[0], y = b[1] - a[1];
    return x * x + y * y < distance * distance;
}

/* The point that divides the way from A to B as T does, exactly on it where that is upright or level. */
static void divide(const double a[2], const double b[2], double t, double p[2])
{
    for (int i = 0; i < 2; i++)
        p[i] = a[i] + t * (b[i] - a[i]);
}

static void weigh(const detail *d, size_t triangle, const double w[3], double interval, spot *worst)
{
    size_t k = 3 * triangle, edge = SIZE_MAX;
    for (size_t i = 0; i < 3; i++)
        edge = w[(i + 2) % 3] == 0 ? k + i : edge;
    size_t next = edge == SIZE_MAX ? 0 : il_tin_after(edge);
    double p[2], z = w[0] * height(d, k) + w[1] * height(d, k + 1) + w[2] * height(d, k + 2);
    if (edge == SIZE_MAX)
        for (int i = 0; i < 2; i++)
            p[i] = w[0] * place(d, k)[i] + w[1] * place(d, k + 1)[i] + w[2] * place(d, k + 2)[i];
    else
        divide(place(d, edge), place(d, next), w[next - k], p);
    for (size_t i = 0; i < 3; i++)
        if (is_near(place(d, k + i), p, NEAREST * d->grain[face_of(d, triangle)]))
            return;
    double off = fabs(law_at(d, triangle, p) - z) / interval;
    if (off > worst->off)
        *worst = (spot){ { p[0], p[1] }, off, edge != SIZE_MAX && d->r.t->edge[edge] != IL_CHART_NONE ? edge : SIZE_MAX };
}

/* By its area: long thin triangles lie beside each other, and what one misses another sees. */
static int count_steps(const detail *d, size_t triangle)
{
    double grain = fmax(d->grain[face_of(d, triangle)], d->step), side = sqrt(il_tin_area2(d->r.t, d->r.c, triangle));
    return grain > 0 ? (int)fmin(fmax(ceil(side / grain), STEPS_LEAST), STEPS_MOST) : STEPS_LEAST;
}

/* Of the points that divide its edges into N equal steps, and those between them.  *SEEN: how many. */
static spot look_at(const detail *d, size_t triangle, int n, double interval, int *seen)
{
    spot worst = { { 0, 0 }, 0, SIZE_MAX };
    bool open[4] = { is_open_edge(d, 3 * triangle), is_open_edge(d, 3 * triangle + 1), is_open_edge(d, 3 * triangle + 2), true };
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= n - i; j++) {
            int l = n - i - j;
            if (j == n || l == n || !open[l == 0 ? 0 : i == 0 ? 1 : j == 0 ? 2 : 3])
                continue;
            weigh(d, triangle, (double[3]){ (double)i / n, (double)j / n, (double)l / n }, interval, &worst);
            ++*seen;
        }
    return worst;
}

/* Likewise, and its middle, unless it is small and nothing is wrong at its edges: that costs no
 * vertex, and saves a third of all looks. */
static spot find_worst(const detail *d, size_t triangle)
{
    int n = count_steps(d, triangle), seen = 0;
    double interval = il_law_interval(d->law, face_of(d, triangle));
    spot worst = look_at(d, triangle, n, interval, &seen);
    bool is_settled = n == STEPS_LEAST && seen > 0 && worst.off < d->tolerance / 2;
    if (n % 3 != 0 && !is_settled)
        weigh(d, triangle, (double[3]){ 1. / 3, 1. / 3, 1. / 3 }, interval, &worst);
    return worst;
}

static bool put_at_worst(detail *d, size_t triangle)
{
    bool done = false;
    spot s = find_worst(d, triangle);
    return s.off <= d->tolerance || put(d, triangle, s.edge, s.p, NEAREST * d->grain[face_of(d, triangle)], &done);
}

/* ---- diagonals ------------------------------------------------------------------------- */

/* Those that are off the law by half the tolerance or more, where the other is off by less than half
 * as much: it costs no vertex, and a degree of the median angle.  Once, for one may lead to another. */
static bool turn_diagonals(detail *d)
{
    for (size_t k = 0; k < 3 * d->r.t->n; k++) {
        if (face_of(d, k / 3) == IL_CHART_NONE || !is_inner(d, k) || d->r.t->across[k] < k / 3)
            continue;
        if (is_better_across(d, k, d->tolerance / 2, 0.5) && !il_refine_flip(&d->r, k))
            return false;
    }
    return true;
}

/* ---- all of it ------------------------------------------------------------------------ */

il_status il_detail_insert(il_tin *t, il_chart *c, const il_law *law, const il_placement_options *o, double tolerance,
                           il_error *err)
{
    detail d = { .r = il_refine_begin(t, c), .law = law, .o = o, .tolerance = IL_DETAIL_FLAT };
    bool ok = find_grain(&d);
    raise_rest(&d);
    ok = ok && visit_all(&d, break_chords);
    d.tolerance = tolerance;
    if (tolerance > 0)
        ok = ok && visit_all(&d, put_at_worst) && turn_diagonals(&d);
    il_refine_end(&d.r);
    il_free(d.grain);
    il_free(d.queue);
    il_free(d.is_queued);
    return ok ? IL_OK : il_fail_nomem(err);
}
