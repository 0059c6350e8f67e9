#include "config.h"
#include "match/dissect.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "base/parity.h"
#include "bridge/triangulation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* So many points of the grid across a region as broad as long, but none nearer to each other
 * than this, in cells: of what is thin, as many as of it would be billions. */
static const double ACROSS = 20, LEAST_STEP = 0.5;

/* No piece has less than this part of an equal share, for it has to hold a ring. */
static const double LEAST_SHARE = 0.2;

void il_dissection_free(il_dissection *d)
{
    il_free(d->site);
    il_free(d->weight);
    il_free(d->xy);
    il_free(d->corner);
    il_free(d->across);
    il_free(d->inside);
    il_free(d->side);
    *d = (il_dissection){ .n = 0 };
}

/* ---- the cells ---- */

/* How much less the power of site K at P is than that of site I, over twice the distance of the
 * two: how far P is beyond the cut between them. */
static double beyond(const il_dissection *d, size_t i, size_t k, const double p[2])
{
    const double *a = d->site + 2 * i, *b = d->site + 2 * k;
    double dx = b[0] - a[0], dy = b[1] - a[1], along = dx * (2 * p[0] - a[0] - b[0]) + dy * (2 * p[1] - a[1] - b[1]);
    return (along + d->weight[k] - d->weight[i]) / (2 * hypot(dx, dy));
}

static double side_at(const il_dissection *d, size_t i, const double cell[2], size_t *rival)
{
    double most = -INFINITY;
    for (size_t k = 0; k < d->n; k++) {
        double out = k == i ? -INFINITY : beyond(d, i, k, cell);
        if (out > most) {
            most = out;
            if (rival)
                *rival = k;
        }
    }
    return -most;
}

double il_dissection_side(const il_dissection *d, size_t i, const double p[2], size_t *rival)
{
    double cell[2];
    il_frame_to_cells(&d->frame, p, cell);
    return side_at(d, i, cell, rival);
}

static double power(const il_dissection *d, size_t i, const double p[2])
{
    double dx = p[0] - d->site[2 * i], dy = p[1] - d->site[2 * i + 1];
    return dx * dx + dy * dy - d->weight[i];
}

size_t il_dissection_cell(const il_dissection *d, const double p[2])
{
    double cell[2], least = INFINITY;
    size_t best = 0;
    il_frame_to_cells(&d->frame, p, cell);
    for (size_t i = 0; i < d->n; i++) {
        double own = power(d, i, cell);
        if (own < least) {
            least = own;
            best = i;
        }
    }
    return best;
}

static double *in_cells(const il_frame *f, const double *from, size_t n)
{
    double *xy = il_alloc(n, 2 * sizeof *xy);
    for (size_t k = 0; xy && k < n; k++)
        il_frame_to_cells(f, from + 2 * k, xy + 2 * k);
    return xy;
}

/* No two sites at one place, as the cells see it. */
static bool sites_differ(const il_dissection *d)
{
    for (size_t i = 0; i < d->n; i++)
        for (size_t k = 0; k < i; k++)
            if (!(hypot(d->site[2 * i] - d->site[2 * k], d->site[2 * i + 1] - d->site[2 * k + 1]) > 1e-3))
                return false;
    return true;
}

/* ---- the grid ---- */

static double area_of(const double *xy, const uint32_t *next, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        const double *a = xy + 2 * i, *b = xy + 2 * next[i];
        sum += (a[0] - xy[0]) * (b[1] - xy[1]) - (b[0] - xy[0]) * (a[1] - xy[1]);
    }
    return sum / 2;
}

/* Point (X, Y), unless there is one there already: false without memory. */
static bool add_point(il_dissection *d, il_keymap *at, double x, double y, bool *is_new)
{
    uint32_t *known = il_keymap_put(at, il_keymap_double(x), il_keymap_double(y), (uint32_t)d->n_points);
    if (!known || !il_grow(&d->xy, &d->cap_points, 2 * (d->n_points + 1), sizeof *d->xy))
        return false;
    *is_new = *known == d->n_points;
    d->xy[2 * d->n_points] = x;
    d->xy[2 * d->n_points + 1] = y;
    d->n_points += *is_new;
    return true;
}

typedef struct grid {
    il_dissection *d;
    il_keymap at;
    uint32_t *edge;          size_t n_edges, cap_edges; /* [2*n_edges], the region on the left */
    double step;
} grid;

static bool add_edge(grid *g, uint32_t a, uint32_t b)
{
    if (!il_grow(&g->edge, &g->cap_edges, 2 * (g->n_edges + 1), sizeof *g->edge))
        return false;
    g->edge[2 * g->n_edges] = a;
    g->edge[2 * g->n_edges++ + 1] = b;
    return true;
}

/* The outline xy[2*n], no part of an edge longer than the step. */
static bool add_outline(grid *g, const double *xy, const uint32_t *next, size_t n, bool *sound)
{
    bool is_new;
    for (size_t i = 0; i < n && *sound; i++) {
        if (!add_point(g->d, &g->at, xy[2 * i], xy[2 * i + 1], &is_new))
            return false;
        *sound = is_new;
    }
    for (size_t i = 0; i < n && *sound; i++) {
        const double *a = xy + 2 * i, *b = xy + 2 * next[i];
        size_t parts = (size_t)fmin(ceil(hypot(b[0] - a[0], b[1] - a[1]) / g->step), 1000);
        uint32_t last = (uint32_t)i;
        for (size_t k = 1; k < parts && *sound; k++) {
            double t = (double)k / (double)parts;
            if (!add_point(g->d, &g->at, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), &is_new))
                return false;
            *sound = is_new;
            if (!add_edge(g, last, (uint32_t)g->d->n_points - 1))
                return false;
            last = (uint32_t)g->d->n_points - 1;
        }
        if (!add_edge(g, last, next[i]))
            return false;
    }
    return true;
}

static double phi_at(il_distance *map, double cell_x, double cell_y)
{
    float x = (float)cell_x, y = (float)cell_y, phi, gx, gy;
    il_distance_sample(map, &x, &y, 1, &phi, &gx, &gy);
    return phi;
}

/* Points inside, none too near the outline. */
static bool add_lattice(grid *g, il_distance *region, const double box[4])
{
    bool is_new;
    double s = g->step;
    for (double y = box[1] + s / 2; y < box[3]; y += s)
        for (double x = box[0] + s / 2; x < box[2]; x += s)
            if (phi_at(region, x, y) > s / 2 && !add_point(g->d, &g->at, x, y, &is_new))
                return false;
    return true;
}

/* The triangles within the outline. */
static il_status find_inside(grid *g, il_error *err)
{
    il_dissection *d = g->d;
    il_keymap outline = IL_KEYMAP_INIT;
    unsigned char *bound = il_alloc(d->n_triangles, 3);
    d->inside = il_alloc(d->n_triangles, sizeof *d->inside);
    bool ok = bound && d->inside;
    for (size_t i = 0; ok && i < g->n_edges; i++)
        ok = il_keymap_put(&outline, IL_KEYMAP_EDGE(g->edge[2 * i], g->edge[2 * i + 1]), 1) != NULL;
    for (size_t e = 0; ok && e < 3 * d->n_triangles; e++) {
        uint32_t a = d->corner[e], b = d->corner[e % 3 == 2 ? e - 2 : e + 1];
        bound[e] = (unsigned char)il_keymap_get(&outline, IL_KEYMAP_EDGE(a, b), 0);
    }
    ok = ok && il_parity_flood(d->across, bound, 1, d->n_triangles, d->inside);
    il_free(bound);
    il_keymap_free(&outline);
    return ok ? IL_OK : il_fail_nomem(err);
}

static il_status triangulate(grid *g, bool *sound, il_error *err)
{
    il_triangulation *t = NULL;
    bool crosses = false;
    il_status st = il_triangulation_try(&t, g->d->xy, g->d->n_points, g->edge, g->n_edges, &crosses, err);
    *sound = st == IL_OK && !crosses;
    if (*sound)
        st = il_triangulation_export(t, &g->d->corner, &g->d->across, &g->d->n_triangles, err);
    il_triangulation_free(t);
    return st;
}

/* From the outline xy[2*n], cells. */
static il_status make_grid(il_dissection *d, const double *xy, const uint32_t *next, size_t n, bool *sound, il_error *err)
{
    double area = area_of(xy, next, n);
    grid g = { .d = d, .step = fmax(sqrt(fabs(area)) / ACROSS, LEAST_STEP) };
    il_distance map = IL_DISTANCE_INIT;
    double box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    il_frame_extend(box, xy, n);
    *sound = area > 0;
    il_status st = il_distance_begin(&map, xy, next, n, d->frame.cells_x, d->frame.cells_y, err);
    if (st == IL_OK && *sound && !(add_outline(&g, xy, next, n, sound) && (!*sound || add_lattice(&g, &map, box))))
        st = il_fail_nomem(err);
    if (st == IL_OK && map.failed)
        st = il_fail_nomem(err);
    if (st == IL_OK && *sound)
        st = triangulate(&g, sound, err);
    if (st == IL_OK && *sound)
        st = find_inside(&g, err);
    il_distance_free(&map);
    il_keymap_free(&g.at);
    il_free(g.edge);
    return st;
}

/* ---- the weights ---- */

/* A triangle as a mass at its middle, and the weight that its power lacks to be the site's. */
typedef struct mass {
    double at[2], area, lacks;
} mass;

static int compare_masses(const void *p, const void *q)
{
    const mass *a = p, *b = q;
    return a->lacks < b->lacks ? -1 : a->lacks > b->lacks;
}

static size_t take_masses(il_dissection *d, mass *m)
{
    size_t n = 0;
    d->area = 0;
    for (size_t t = 0; t < d->n_triangles; t++) {
        const double *a = d->xy + 2 * d->corner[3 * t], *b = d->xy + 2 * d->corner[3 * t + 1], *c = d->xy + 2 * d->corner[3 * t + 2];
        if (!d->inside[t])
            continue;
        m[n] = (mass){ { (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3 },
                       ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2, 0 };
        d->area += m[n++].area;
    }
    return n;
}

/* The weight of site I by which its cell has the area WANTED, as the others are: what it changes by. */
static double settle_weight(il_dissection *d, size_t i, double wanted, mass *m, size_t n)
{
    for (size_t t = 0; t < n; t++) {
        double least = INFINITY;
        for (size_t k = 0; k < d->n; k++)
            least = k == i ? least : fmin(least, power(d, k, m[t].at));
        m[t].lacks = power(d, i, m[t].at) - least;
    }
    qsort(m, n, sizeof *m, compare_masses);
    double area = 0;
    size_t t = 0;
    while (t + 1 < n && area + m[t].area / 2 < wanted)
        area += m[t++].area;
    double change = t > 0 ? (m[t - 1].lacks + m[t].lacks) / 2 : m[0].lacks;
    d->weight[i] += change;
    return change;
}

/* Site by site, until none changes by more than a hair, cells^2; two settle at once. */
static il_status settle_weights(il_dissection *d, const double *share, il_error *err)
{
    static const double HAIR = 0.01;
    enum { SWEEPS = 40 };
    mass *m = il_alloc(d->n_triangles, sizeof *m);
    double least, sum = 0, excess = 0;
    if (!m)
        return il_fail_nomem(err);
    size_t n = take_masses(d, m);
    for (size_t i = 0; i < d->n; i++)
        sum += share[i];
    least = LEAST_SHARE * sum / (double)d->n;
    for (size_t i = 0; i < d->n; i++)
        excess += fmax(0, least - share[i]);
    double change = INFINITY;
    for (int sweep = 0; n > 0 && change > HAIR && sweep < (d->n > 2 ? SWEEPS : 1); sweep++) {
        change = 0;
        for (size_t i = 0; i < d->n; i++)
            change = fmax(change, fabs(settle_weight(d, i, d->area * fmax(share[i], least) / (sum + excess), m, n)));
    }
    il_free(m);
    return IL_OK;
}

/* As they stand in a row, each ends where it goes back. */
static size_t count_rings(const il_outline *o)
{
    size_t n = 0;
    for (size_t i = 0; i < o->n; i++)
        n += o->next[i] <= i;
    return n;
}

il_status il_dissection_begin(il_dissection *d, const il_outline *region, const double *site, const double *share, size_t n,
                              bool *sound, il_error *err)
{
    double box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    *d = (il_dissection){ .n = n, .rings = count_rings(region) };
    il_frame_extend(box, region->xy, region->n);
    d->frame = il_frame_over(box);
    d->site = in_cells(&d->frame, site, n);
    d->weight = il_calloc(n, sizeof *d->weight);
    double *xy = in_cells(&d->frame, region->xy, region->n);
    il_status st = d->site && d->weight && xy ? IL_OK : il_fail_nomem(err);
    *sound = st == IL_OK && sites_differ(d);
    if (st == IL_OK && *sound)
        st = make_grid(d, xy, region->next, region->n, sound, err);
    if (st == IL_OK && *sound) {
        d->side = il_alloc(d->n_points, sizeof *d->side);
        st = d->side ? settle_weights(d, share, err) : il_fail_nomem(err);
    }
    il_free(xy);
    return st;
}

double il_dissection_breadth(const il_dissection *d)
{
    return sqrt(d->area) / 2;
}

/* ---- pieces ---- */

/* The points of a piece by what they are: a point of the grid (p, p), or where its edge
 * (p, q), p < q, is cut. */
typedef struct march {
    il_dissection *d;
    il_piece *out;
    il_keymap at;
} march;

static uint32_t point_of(march *m, uint32_t p, uint32_t q)
{
    il_dissection *d = m->d;
    il_piece *o = m->out;
    uint32_t *known = il_keymap_put(&m->at, p < q ? p : q, p < q ? q : p, (uint32_t)o->n);
    if (!known || *known < o->n)
        return known ? *known : UINT32_MAX;
    if (!il_grow(&o->xy, &o->cap, 2 * (o->n + 1), sizeof *o->xy) || !il_grow(&o->next, &o->cap_next, o->n + 1, sizeof *o->next))
        return UINT32_MAX;
    if (q < p) { /* the same place from either side */
        uint32_t swap = p;
        p = q;
        q = swap;
    }
    double t = p == q ? 0 : d->side[p] / (d->side[p] - d->side[q]);
    for (size_t c = 0; c < 2; c++) {
        double cell = d->xy[2 * p + c] + t * (d->xy[2 * q + c] - d->xy[2 * p + c]);
        o->xy[2 * o->n + c] = (cell - d->frame.margin) * d->frame.cell + (c == 0 ? d->frame.x : d->frame.y);
    }
    o->next[o->n] = UINT32_MAX;
    return (uint32_t)o->n++;
}

/* The way from point (A, B) to point (C, D). */
static bool go(march *m, uint32_t a, uint32_t b, uint32_t c, uint32_t e)
{
    uint32_t from = point_of(m, a, b), to = point_of(m, c, e);
    if (from == UINT32_MAX || to == UINT32_MAX)
        return false;
    m->out->next[from] = to;
    return true;
}

static bool in(const il_dissection *d, uint32_t p)
{
    return d->side[p] > 0;
}

/* The cut through triangle T, the piece on its left. */
static bool cut_triangle(march *m, uint32_t t)
{
    const il_dissection *d = m->d;
    uint32_t from[2] = { UINT32_MAX, 0 }, to[2] = { UINT32_MAX, 0 };
    for (size_t k = 0; k < 3; k++) {
        uint32_t p = d->corner[3 * t + k], q = d->corner[3 * t + (k + 1) % 3];
        if (in(d, p) && !in(d, q))
            from[0] = p, from[1] = q;
        if (!in(d, p) && in(d, q))
            to[0] = p, to[1] = q;
    }
    return from[0] == UINT32_MAX || go(m, from[0], from[1], to[0], to[1]);
}

/* The part of edge K of triangle T, on the outline, that is in the piece. */
static bool follow_outline(march *m, uint32_t t, size_t k)
{
    const il_dissection *d = m->d;
    uint32_t p = d->corner[3 * t + k], q = d->corner[3 * t + (k + 1) % 3];
    if (in(d, p))
        return in(d, q) ? go(m, p, p, q, q) : go(m, p, p, p, q);
    return !in(d, q) || go(m, p, q, q, q);
}

static bool is_outline(const il_dissection *d, uint32_t t, size_t k)
{
    uint32_t u = d->across[3 * t + k];
    return u == UINT32_MAX || !d->inside[u];
}

static il_status march_all(il_dissection *d, bool outline, il_piece *out, il_error *err)
{
    march m = { .d = d, .out = out };
    bool ok = true;
    for (uint32_t t = 0; ok && t < d->n_triangles; t++) {
        if (!d->inside[t])
            continue;
        ok = cut_triangle(&m, t);
        for (size_t k = 0; ok && outline && k < 3; k++)
            if (is_outline(d, t, k))
                ok = follow_outline(&m, t, k);
    }
    il_keymap_free(&m.at);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* Label the rings of P by their first points: of[n].  The area about the greatest. */
static uint32_t greatest_ring(const il_piece *p, uint32_t *of)
{
    double most = -INFINITY;
    uint32_t best = 0;
    for (size_t i = 0; i < p->n; i++)
        of[i] = UINT32_MAX;
    for (uint32_t i = 0; i < p->n; i++) {
        double area = 0;
        if (of[i] != UINT32_MAX)
            continue;
        for (uint32_t k = i; of[k] == UINT32_MAX; k = p->next[k]) {
            const double *a = p->xy + 2 * (size_t)k, *b = p->xy + 2 * (size_t)p->next[k], *o = p->xy;
            area += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
            of[k] = i;
        }
        if (area > most) {
            most = area;
            best = i;
        }
    }
    return best;
}

/* All rings but the greatest are dropped. */
static bool drop_crumbs(il_piece *p)
{
    uint32_t *of = il_alloc(p->n, 2 * sizeof *of), *number = of + p->n;
    if (!of)
        return false;
    uint32_t best = p->n > 0 ? greatest_ring(p, of) : 0;
    size_t n = 0;
    for (size_t i = 0; i < p->n; i++)
        number[i] = of[i] == best ? (uint32_t)n++ : UINT32_MAX;
    p->crumbs = n < p->n;
    for (size_t i = 0; i < p->n; i++) {
        if (number[i] == UINT32_MAX)
            continue;
        memmove(p->xy + 2 * number[i], p->xy + 2 * i, 2 * sizeof *p->xy);
        p->next[number[i]] = number[p->next[i]];
    }
    p->n = n;
    il_free(of);
    return true;
}

il_status il_dissection_piece(il_dissection *d, size_t i, double seam, il_piece *out, il_error *err)
{
    *out = (il_piece){ 0 };
    for (size_t p = 0; p < d->n_points; p++)
        d->side[p] = side_at(d, i, d->xy + 2 * p, NULL) - seam;
    il_status st = march_all(d, true, out, err);
    return st == IL_OK && d->rings == 1 && !drop_crumbs(out) ? il_fail_nomem(err) : st;
}

il_status il_dissection_cuts(il_dissection *d, size_t i, il_piece *out, il_error *err)
{
    *out = (il_piece){ 0 };
    for (size_t p = 0; p < d->n_points; p++)
        d->side[p] = side_at(d, i, d->xy + 2 * p, NULL);
    il_status st = march_all(d, false, out, err);
    for (size_t k = 0; st == IL_OK && k < out->n; k++) { /* what is cut from an earlier piece is that one's */
        size_t rival = i;
        il_dissection_side(d, i, out->xy + 2 * k, &rival);
        if (rival < i)
            out->next[k] = UINT32_MAX;
    }
    return st;
}

il_status il_dissection_meet(il_dissection *d, size_t i, size_t k, bool *meet, double middle[2], il_error *err)
{
    size_t low = i < k ? i : k, high = i < k ? k : i, n = 0;
    il_piece line = { 0 };
    middle[0] = middle[1] = 0;
    il_status st = il_dissection_cuts(d, low, &line, err);
    for (size_t p = 0; st == IL_OK && p < line.n; p++) {
        size_t rival = low;
        il_dissection_side(d, low, line.xy + 2 * p, &rival);
        if (rival != high)
            continue;
        middle[0] += line.xy[2 * p];
        middle[1] += line.xy[2 * p + 1];
        n++;
    }
    il_piece_free(&line);
    for (size_t c = 0; c < 2 && n > 0; c++)
        middle[c] /= (double)n;
    *meet = n > 0;
    return st;
}
