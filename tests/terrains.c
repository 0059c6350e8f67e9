#include "config.h"
#include "terrains.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "stacks.h"

#include <math.h>
#include <stdlib.h>

static void *room(size_t n, size_t size)
{
    void *p = il_calloc(n, size);
    if (!p)
        abort();
    return p;
}

static void need(bool ok)
{
    if (!ok)
        abort();
}

static double between(uint64_t *seed, double a, double b)
{
    return a + (b - a) * stack_uniform(seed);
}

static size_t any_of(uint64_t *seed, size_t n)
{
    return stack_random(seed) % n;
}

/* ---- heights ---------------------------------------------------------------------- */

/* A bump about the segment from a to b (a point: round), high at the middle and falling off
 * over reach; flat where it would be above cap. */
typedef struct bump { double a[2], b[2], reach, high, cap; } bump;

static bump random_bump(uint64_t *seed, const double size[2])
{
    bump u = { .high = between(seed, 0.3, 1) * (any_of(seed, 3) ? 1 : -1), .cap = 1 };
    double longest = fmax(size[0], size[1]);
    for (int i = 0; i < 2; i++) {
        u.a[i] = between(seed, -0.05, 1.05) * size[i];
        u.b[i] = u.a[i];
    }
    u.reach = between(seed, 0.05, 0.2) * longest;
    if (any_of(seed, 3) == 0) /* a ridge or valley */
        for (int i = 0; i < 2; i++)
            u.b[i] += between(seed, -0.5, 0.5) * longest;
    if (any_of(seed, 3) == 0) /* a plateau or a flat hollow */
        u.cap = between(seed, 0.4, 0.8);
    return u;
}

static double bump_at(const bump *u, double x, double y)
{
    double dx = u->b[0] - u->a[0], dy = u->b[1] - u->a[1], l2 = dx * dx + dy * dy;
    double s = l2 > 0 ? ((x - u->a[0]) * dx + (y - u->a[1]) * dy) / l2 : 0;
    s = fmin(fmax(s, 0), 1);
    double rx = x - u->a[0] - s * dx, ry = y - u->a[1] - s * dy;
    return u->high * fmin(exp(-(rx * rx + ry * ry) / (u->reach * u->reach)), u->cap);
}

static void heap_up(terrain *t, uint64_t *seed)
{
    const double size[2] = { t->step * (double)(t->n[0] - 1), t->step * (double)(t->n[1] - 1) };
    double scale = pow(10, between(seed, 0, 4)), base = between(seed, -2, 2) * scale;
    double slope[2] = { between(seed, -0.4, 0.4) / size[0], between(seed, -0.4, 0.4) / size[1] };
    bump u[24];
    size_t n = 2 + any_of(seed, 22);
    for (size_t i = 0; i < n; i++)
        u[i] = random_bump(seed, size);
    for (size_t k = 0; k < t->n[0] * t->n[1]; k++) {
        double x = t->step * (double)(k % t->n[0]), y = t->step * (double)(k / t->n[0]);
        double z = slope[0] * x + slope[1] * y;
        for (size_t i = 0; i < n; i++)
            z += bump_at(&u[i], x, y);
        t->z[k] = base + scale * z;
    }
}

/* Between the least and the greatest height, 0.3 to 1.7 of the even step apart where uneven. */
static void choose_levels(terrain *t, bool uneven, uint64_t *seed)
{
    double least = t->z[0], most = t->z[0], at = 0;
    for (size_t k = 0; k < t->n[0] * t->n[1]; k++) {
        least = fmin(least, t->z[k]);
        most = fmax(most, t->z[k]);
    }
    t->n_levels = 3 + any_of(seed, 7);
    for (size_t i = 0; i < t->n_levels; i++)
        t->level[i] = at += uneven ? between(seed, 0.3, 1.7) : 1;
    at += 0.5;
    for (size_t i = 0; i < t->n_levels; i++)
        t->level[i] = least + (most - least) * (t->level[i] - 0.2) / at;
}

/* Take heights away from levels, by a thousandth of the least interval. */
static void clear_levels(terrain *t)
{
    double interval = INFINITY;
    for (size_t i = 1; i < t->n_levels; i++)
        interval = fmin(interval, t->level[i] - t->level[i - 1]);
    for (size_t k = 0; k < t->n[0] * t->n[1]; k++)
        for (size_t i = 0; i < t->n_levels; i++)
            if (fabs(t->z[k] - t->level[i]) < 1e-3 * interval)
                t->z[k] = t->level[i] + (t->z[k] < t->level[i] ? -1e-3 : 1e-3) * interval;
}

void terrain_make(terrain *t, uint64_t seed)
{
    bool uneven = seed % 3 == 0;
    *t = (terrain){ .n = { 12 + any_of(&seed, 30), 12 + any_of(&seed, 30) }, .step = pow(2, between(&seed, -3, 6)) };
    for (int i = 0; i < 2; i++)
        t->origin[i] = any_of(&seed, 2) ? between(&seed, -1e6, 1e6) : 0;
    t->z = room(t->n[0] * t->n[1], sizeof *t->z);
    t->falls = room((t->n[0] - 1) * (t->n[1] - 1), 1);
    for (size_t c = 0; c < (t->n[0] - 1) * (t->n[1] - 1); c++)
        t->falls[c] = any_of(&seed, 2) == 0;
    heap_up(t, &seed);
    choose_levels(t, uneven, &seed);
    clear_levels(t);
}

void terrain_free(terrain *t)
{
    il_free(t->z);
    il_free(t->falls);
    *t = (terrain){ .z = NULL };
}

/* ---- places ------------------------------------------------------------------------- */

static void place_node(const terrain *t, size_t k, double p[2])
{
    p[0] = t->origin[0] + t->step * (double)(k % t->n[0]);
    p[1] = t->origin[1] + t->step * (double)(k / t->n[0]);
}

void terrain_box(const terrain *t, double box[4])
{
    place_node(t, 0, box);
    place_node(t, t->n[0] * t->n[1] - 1, box + 2);
}

/* The nodes of triangle T, two a cell, counter-clockwise. */
static size_t n_triangles(const terrain *t)
{
    return 2 * (t->n[0] - 1) * (t->n[1] - 1);
}

static void corners_of(const terrain *t, size_t triangle, size_t node[3])
{
    size_t cell = triangle / 2, columns = t->n[0] - 1;
    size_t ll = cell / columns * t->n[0] + cell % columns, lr = ll + 1, ul = ll + t->n[0], ur = ul + 1;
    const size_t rising[2][3] = { { ll, lr, ur }, { ll, ur, ul } }, falling[2][3] = { { ll, lr, ul }, { lr, ur, ul } };
    for (int i = 0; i < 3; i++)
        node[i] = t->falls[cell] ? falling[triangle % 2][i] : rising[triangle % 2][i];
}

double terrain_height(const terrain *t, const double p[2])
{
    size_t cell[2];
    double f[2];
    for (int i = 0; i < 2; i++) {
        double at = (p[i] - t->origin[i]) / t->step;
        cell[i] = (size_t)fmin(fmax(floor(at), 0), (double)(t->n[i] - 2));
        f[i] = at - (double)cell[i];
    }
    const double *z = t->z + cell[1] * t->n[0] + cell[0];
    double ll = z[0], lr = z[1], ul = z[t->n[0]], ur = z[t->n[0] + 1];
    if (t->falls[cell[1] * (t->n[0] - 1) + cell[0]])
        return f[0] + f[1] < 1 ? ll + f[0] * (lr - ll) + f[1] * (ul - ll) : ur + (1 - f[0]) * (ul - ur) + (1 - f[1]) * (lr - ur);
    return f[0] > f[1] ? ll + f[0] * (lr - ll) + f[1] * (ur - lr) : ll + f[0] * (ur - ul) + f[1] * (ul - ll);
}

int32_t terrain_low(const terrain *t, double z)
{
    int32_t low = -1;
    while (low + 1 < (int32_t)t->n_levels && t->level[low + 1] < z)
        low++;
    return low;
}

/* ---- isolines -------------------------------------------------------------------------- */

/* The number of the edge between nodes A and B: of the lesser one, four directions. */
static size_t edge_between(const terrain *t, size_t a, size_t b)
{
    size_t low = a < b ? a : b, step = a < b ? b - a : a - b;
    return 4 * low + (step == 1 ? 0 : step == t->n[0] ? 1 : step == t->n[0] + 1 ? 2 : 3);
}

static void nodes_of(const terrain *t, size_t edge, size_t node[2])
{
    const size_t step[4] = { 1, t->n[0], t->n[0] + 1, t->n[0] - 1 };
    node[0] = edge / 4;
    node[1] = node[0] + step[edge % 4];
}

static void cross(const terrain *t, size_t edge, double level, double p[2])
{
    size_t node[2];
    double a[2], b[2];
    nodes_of(t, edge, node);
    place_node(t, node[0], a);
    place_node(t, node[1], b);
    double s = (level - t->z[node[0]]) / (t->z[node[1]] - t->z[node[0]]);
    for (int i = 0; i < 2; i++)
        p[i] = a[i] + s * (b[i] - a[i]);
}

/* Does LEVEL cross the triangle?  Then from edge[0] to edge[1], the higher ground on the left:
 * around a triangle, what is high comes after the edge where it rises and before the one where
 * it falls, and the isoline leads back from this one to that. */
static bool cross_triangle(const terrain *t, size_t triangle, double level, size_t edge[2])
{
    size_t node[3], n = 0;
    corners_of(t, triangle, node);
    for (size_t i = 0; i < 3; i++) {
        size_t a = node[i], b = node[(i + 1) % 3];
        if ((t->z[a] > level) == (t->z[b] > level))
            continue;
        edge[t->z[a] > level ? 0 : 1] = edge_between(t, a, b);
        n++;
    }
    return n == 2;
}

enum { NOTHING = UINT32_MAX };

/* next[e]: where the isoline goes that enters a triangle over edge e; line_at[e]. */
typedef struct tracing {
    const terrain *t;
    double level;
    uint32_t *next;
    bool *is_entered;
    uint32_t *line_at;
    size_t n_edges;
} tracing;

static void trace_line(tracing *g, uint32_t from, il_slice *s, long *feature)
{
    il_ring *r = il_slice_add_ring(s);
    uint32_t e = from;
    need(r);
    r->feature = ++*feature;
    do {
        double p[2];
        cross(g->t, e, g->level, p);
        need(il_ring_add(r, p[0], p[1], 0));
        g->line_at[e] = (uint32_t)*feature - 1;
        e = g->next[e];
    } while (e != (uint32_t)NOTHING && e != from);
    r->open = e != from;
}

/* The isolines of level K to S; line_at of 4 * nodes numbers. */
static void contour_level(const terrain *t, size_t k, il_slice *s, long *feature, uint32_t *line_at)
{
    tracing g = { t, t->level[k], NULL, NULL, line_at, 4 * t->n[0] * t->n[1] };
    g.next = room(g.n_edges, sizeof *g.next);
    g.is_entered = room(g.n_edges, sizeof *g.is_entered);
    for (size_t e = 0; e < g.n_edges; e++)
        g.next[e] = line_at[e] = (uint32_t)NOTHING;
    for (size_t i = 0; i < n_triangles(t); i++) {
        size_t edge[2];
        if (cross_triangle(t, i, g.level, edge)) {
            g.next[edge[0]] = (uint32_t)edge[1];
            g.is_entered[edge[1]] = true;
        }
    }
    *s = (il_slice)IL_SLICE_INIT;
    s->z = g.level;
    for (int closed = 0; closed < 2; closed++)
        for (uint32_t e = 0; e < g.n_edges; e++)
            if (g.next[e] != (uint32_t)NOTHING && line_at[e] == (uint32_t)NOTHING && (closed || !g.is_entered[e]))
                trace_line(&g, e, s, feature);
    il_free(g.next);
    il_free(g.is_entered);
}

void terrain_contour(const terrain *t, il_slice *slice)
{
    long feature = 0;
    uint32_t *line_at = room(4 * t->n[0] * t->n[1], sizeof *line_at);
    for (size_t k = 0; k < t->n_levels; k++)
        contour_level(t, k, &slice[k], &feature, line_at);
    il_free(line_at);
}

void terrain_free_slices(il_slice *slice, size_t n)
{
    for (size_t k = 0; k < n; k++)
        il_slice_free(&slice[k]);
}

/* ---- faces -------------------------------------------------------------------------------- */

/* Pieces are triangles cut by levels: number triangle * (n_levels + 1) + band. */
static size_t piece_of(const terrain *t, size_t triangle, size_t band)
{
    return triangle * (t->n_levels + 1) + band;
}

/* Two triangles share in the bands that occur along their edge. */
static void join_pieces(const terrain *t, uint32_t *up)
{
    uint32_t *first = room(4 * t->n[0] * t->n[1], sizeof *first);
    for (size_t e = 0; e < 4 * t->n[0] * t->n[1]; e++)
        first[e] = (uint32_t)NOTHING;
    for (size_t i = 0; i < n_triangles(t); i++) {
        size_t node[3];
        corners_of(t, i, node);
        for (size_t k = 0; k < 3; k++) {
            double za = t->z[node[k]], zb = t->z[node[(k + 1) % 3]];
            size_t e = edge_between(t, node[k], node[(k + 1) % 3]);
            if (first[e] == (uint32_t)NOTHING) {
                first[e] = (uint32_t)i;
                continue;
            }
            for (int32_t b = terrain_low(t, fmin(za, zb)) + 1; b <= terrain_low(t, fmax(za, zb)) + 1; b++)
                il_forest_join(up, (uint32_t)piece_of(t, i, (size_t)b), (uint32_t)piece_of(t, first[e], (size_t)b));
        }
    }
    il_free(first);
}

static uint32_t face_of(terrain_faces *f, uint32_t *number, uint32_t *up, uint32_t piece, int32_t low)
{
    uint32_t leader = il_forest_leader(up, piece);
    if (number[leader] == (uint32_t)NOTHING) {
        number[leader] = (uint32_t)f->n_faces;
        f->band[f->n_faces++] = (il_band){ low, low + 1 };
    }
    return number[leader];
}

static void part_level(const terrain *t, size_t k, terrain_faces *f, uint32_t *number, uint32_t *up, const uint32_t *line_at)
{
    for (size_t i = 0; i < n_triangles(t); i++) {
        size_t edge[2];
        double p[2][2];
        if (!cross_triangle(t, i, t->level[k], edge))
            continue;
        need(il_grow(&f->border, &f->cap, f->n + 1, sizeof *f->border));
        for (int end = 0; end < 2; end++)
            cross(t, edge[end], t->level[k], p[end]);
        uint32_t above = face_of(f, number, up, (uint32_t)piece_of(t, i, k + 1), (int32_t)k);
        uint32_t below = face_of(f, number, up, (uint32_t)piece_of(t, i, k), (int32_t)k - 1);
        f->border[f->n++] = (il_border){ { above, below }, line_at[edge[0]], (int32_t)k,
                                         hypot(p[1][0] - p[0][0], p[1][1] - p[0][1]), { p[0][0], p[0][1] } };
    }
}

terrain_faces terrain_part(const terrain *t)
{
    terrain_faces f = { .n = 0 };
    size_t n_pieces = n_triangles(t) * (t->n_levels + 1);
    uint32_t *up = room(n_pieces, sizeof *up), *number = room(n_pieces, sizeof *number);
    uint32_t *line_at = room(4 * t->n[0] * t->n[1], sizeof *line_at);
    long feature = 0;
    f.band = room(n_pieces, sizeof *f.band);
    il_forest_plant(up, n_pieces);
    join_pieces(t, up);
    for (size_t i = 0; i < n_pieces; i++)
        number[i] = (uint32_t)NOTHING;
    for (size_t k = 0; k < t->n_levels; k++) {
        il_slice s;
        contour_level(t, k, &s, &feature, line_at);
        part_level(t, k, &f, number, up, line_at);
        il_slice_free(&s);
    }
    f.n_lines = (size_t)feature;
    il_free(up);
    il_free(number);
    il_free(line_at);
    return f;
}

void terrain_faces_free(terrain_faces *f)
{
    il_free(f->border);
    il_free(f->band);
    *f = (terrain_faces){ .n = 0 };
}

/* ---- as maps come --------------------------------------------------------------------------- */

/* The vertices from A to B of R, both of them, around its end if it is closed, as a new line. */
static void add_piece(il_slice *s, const il_ring *r, size_t a, size_t b)
{
    il_ring *piece = il_slice_add_ring(s);
    need(piece);
    il_ring_take_origin(piece, r);
    piece->open = true;
    for (size_t v = a; v <= b; v++)
        need(il_ring_add(piece, r->xy[2 * (v % r->n)], r->xy[2 * (v % r->n) + 1], 0));
}

/* Into pieces of 1 to 20 edges. */
static void cut(il_slice *to, const il_ring *r, uint64_t *seed)
{
    size_t from = r->open ? 0 : any_of(seed, r->n), last = r->open ? r->n - 1 : from + r->n;
    while (from < last) {
        size_t to_vertex = from + 1 + any_of(seed, 20);
        to_vertex = to_vertex < last ? to_vertex : last;
        add_piece(to, r, from, to_vertex);
        from = to_vertex;
    }
}

static void add_whole(il_slice *to, const il_ring *r)
{
    il_ring *copy = il_slice_add_ring(to);
    need(copy);
    il_ring_take_origin(copy, r);
    copy->open = r->open;
    for (size_t v = 0; v < r->n; v++)
        need(il_ring_add(copy, r->xy[2 * v], r->xy[2 * v + 1], r->mark ? r->mark[v] : 0));
}

void terrain_scatter(il_slice *slice, size_t n, uint64_t seed)
{
    for (size_t k = 0; k < n; k++) {
        il_slice to = IL_SLICE_INIT;
        to.z = slice[k].z;
        for (size_t i = 0; i < slice[k].n; i++)
            if (any_of(&seed, 2) && !slice[k].ring[i].mark)
                cut(&to, &slice[k].ring[i], &seed);
            else
                add_whole(&to, &slice[k].ring[i]);
        for (size_t i = to.n; i > 0; i--) {
            size_t j = any_of(&seed, i);
            il_ring keep = to.ring[j];
            to.ring[j] = to.ring[i - 1];
            to.ring[i - 1] = keep;
            if (any_of(&seed, 2))
                il_ring_reverse(&to.ring[i - 1]);
        }
        il_slice_free(&slice[k]);
        slice[k] = to;
    }
}

/* How far P, on the box, lies along it from its lower left corner, counter-clockwise. */
static double along_box(const double box[4], const double p[2])
{
    double w = box[2] - box[0], h = box[3] - box[1];
    if (p[1] == box[1])
        return p[0] - box[0];
    if (p[0] == box[2])
        return w + (p[1] - box[1]);
    return p[1] == box[3] ? w + h + (box[2] - p[0]) : 2 * w + h + (box[3] - p[1]);
}

/* From the end of R on along the box to its beginning, what is higher on the left. */
static void close_line(il_ring *r, const double box[4])
{
    double w = box[2] - box[0], h = box[3] - box[1];
    const double corner[4][2] = { { box[2], box[1] }, { box[2], box[3] }, { box[0], box[3] }, { box[0], box[1] } };
    const double reach[4] = { w, w + h, 2 * w + h, 2 * w + 2 * h };
    double at = along_box(box, r->xy + 2 * (r->n - 1)), to = along_box(box, r->xy), whole = reach[3];
    size_t last = r->n - 1;
    to += to < at ? whole : 0;
    for (int turn = 0; turn < 2; turn++)
        for (int k = 0; k < 4; k++)
            if (reach[k] + turn * whole > at && reach[k] + turn * whole < to)
                need(il_ring_add(r, corner[k][0], corner[k][1], IL_VERTEX_MAP_EDGE));
    need(il_ring_add(r, r->xy[0], r->xy[1], IL_VERTEX_MAP_EDGE)); /* so that there are marks at all */
    r->n--;
    r->mark[last] |= IL_VERTEX_MAP_EDGE;
    r->open = false;
}

void terrain_close(const terrain *t, il_slice *slice, uint64_t seed)
{
    double box[4];
    terrain_box(t, box);
    for (size_t k = 0; k < t->n_levels; k++)
        for (size_t i = 0; i < slice[k].n; i++)
            if (slice[k].ring[i].open && any_of(&seed, 2))
                close_line(&slice[k].ring[i], box);
}
