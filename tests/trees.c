#include "config.h"
#include "trees.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "model/order.h"
#include "stacks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TURN = 6.283185307179586;

static void *room(size_t n, size_t size)
{
    void *p = il_calloc(n > 0 ? n : 1, size);
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

/* ---- growing ----------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void minus(const double a[3], const double b[3], double d[3])
{
    for (int i = 0; i < 3; i++)
        d[i] = a[i] - b[i];
}

static double clamp(double v)
{
    return fmin(fmax(v, 0), 1);
}

/* Distance of P from segment AB. */
static double from_segment(const double p[3], const double a[3], const double b[3])
{
    double ab[3], ap[3], d[3];
    minus(b, a, ab);
    minus(p, a, ap);
    double s = clamp(dot(ap, ab) / dot(ab, ab));
    for (int i = 0; i < 3; i++)
        d[i] = ap[i] - s * ab[i];
    return sqrt(dot(d, d));
}

/* Distance of two segments: where their lines come nearest if that is on both, else an end of one. */
static double axes_apart(const tree_tube *s, const tree_tube *t)
{
    double u[3], v[3], w[3], least = INFINITY;
    minus(s->end[1], s->end[0], u);
    minus(t->end[1], t->end[0], v);
    minus(s->end[0], t->end[0], w);
    for (int i = 0; i < 2; i++) {
        least = fmin(least, from_segment(s->end[i], t->end[0], t->end[1]));
        least = fmin(least, from_segment(t->end[i], s->end[0], s->end[1]));
    }
    double a = dot(u, u), b = dot(u, v), c = dot(v, v), d = dot(u, w), e = dot(v, w), det = a * c - b * b;
    double p = (b * e - c * d) / det, q = (a * e - b * d) / det;
    if (!(det > 1e-9 * a * c) || p < 0 || p > 1 || q < 0 || q > 1)
        return least;
    for (int i = 0; i < 3; i++)
        w[i] += p * u[i] - q * v[i];
    return fmin(least, sqrt(dot(w, w)));
}

static bool share_node(const tree_tube *s, const tree_tube *t)
{
    return s->node[0] == t->node[0] || s->node[0] == t->node[1] || s->node[1] == t->node[0] || s->node[1] == t->node[1];
}

static double angle_between(const tree_tube *s, const tree_tube *t)
{
    double u[3], v[3];
    minus(s->end[1], s->end[0], u);
    minus(t->end[1], t->end[0], v);
    return acos(fmin(fmax(dot(u, v) / sqrt(dot(u, u) * dot(v, v)), -1), 1));
}

/* Tubes that share a node with C: may it go where it goes?  A vessel neither turns back, nor
 * do its branches run side by side. */
static bool turns_well(const tree_tube *c, const tree_tube *t)
{
    double angle = angle_between(c, t);
    return t->node[1] == c->node[0] ? angle < TURN / 4.4 : angle > TURN / 18;
}

static bool fits(const tree *t, const tree_tube *c)
{
    for (size_t i = 0; i < t->n; i++) {
        const tree_tube *o = &t->tube[i];
        if (share_node(c, o) ? !turns_well(c, o) : axes_apart(c, o) < fmax(c->r[0], c->r[1]) + fmax(o->r[0], o->r[1]) + TREE_MARGIN)
            return false;
    }
    return true;
}

static void direct(tree_kind kind, uint64_t *seed, double d[3])
{
    int low = kind == TREE_MIXED ? 0 : 20 * (int)kind;
    double lean = between(seed, low, kind == TREE_MIXED ? 80 : low + 20) * TURN / 360, azimuth = between(seed, 0, TURN);
    d[0] = sin(lean) * cos(azimuth);
    d[1] = sin(lean) * sin(azimuth);
    d[2] = kind == TREE_MIXED && stack_random(seed) % 6 == 0 ? -cos(lean) : cos(lean);
}

/* A tube from node FROM at P, of radius R there; false where there is no room. */
static bool grow_tube(tree *t, tree_kind kind, uint64_t *seed, size_t from, const double p[3], double r)
{
    for (int attempt = 0; attempt < 40; attempt++) {
        tree_tube c = { .r = { r, fmax(1, r * between(seed, .75, 1)) }, .node = { from, t->n + 1 } };
        double d[3], length = r * between(seed, 6, 14);
        direct(kind, seed, d);
        for (int i = 0; i < 3; i++) {
            c.end[0][i] = p[i];
            c.end[1][i] = p[i] + length * d[i];
        }
        if (!fits(t, &c))
            continue;
        t->z[c.node[1]] = c.end[1][2];
        t->tube[t->n++] = c;
        return true;
    }
    return false;
}

/* One, two or three tubes from the end of tube I; of several some are thinner. */
static void branch(tree *t, tree_kind kind, uint64_t *seed, size_t i)
{
    const tree_tube from = t->tube[i];
    size_t way = stack_random(seed) % 10, n = way < 3 ? 1 : way < 8 ? 2 : 3;
    for (size_t k = 0; k < n && t->n < TREE_MOST_TUBES; k++)
        (void)grow_tube(t, kind, seed, from.node[1], from.end[1], fmax(1, from.r[1] * (n == 1 ? 1 : between(seed, .6, .95))));
}

static void measure_width(tree *t)
{
    double area = 0, length = 0;
    for (size_t i = 0; i < t->n; i++) {
        double d[3];
        minus(t->tube[i].end[1], t->tube[i].end[0], d);
        area += sqrt(dot(d, d)) * (t->tube[i].r[0] + t->tube[i].r[1]);
        length += sqrt(dot(d, d));
    }
    t->width = area / length;
}

void tree_make(tree *t, tree_kind kind, uint64_t seed)
{
    do {
        static const double origin[3] = { 0, 0, 0 };
        *t = (tree){ .n = 0 };
        (void)grow_tube(t, kind, &seed, 0, origin, between(&seed, 1.5, 2.5));
        for (size_t i = 0; i < t->n; i++)
            branch(t, kind, &seed, i);
    } while (t->n < 4);
    measure_width(t);
}

/* Twice the area of abc, seen along z. */
static double side(const double a[3], const double b[3], const double c[3])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

size_t tree_crossings(const tree *t)
{
    size_t n = 0;
    for (size_t i = 0; i < t->n; i++)
        for (size_t j = 0; j < i; j++) {
            const tree_tube *s = &t->tube[i], *o = &t->tube[j];
            n += !share_node(s, o) && side(s->end[0], s->end[1], o->end[0]) * side(s->end[0], s->end[1], o->end[1]) < 0 &&
                 side(o->end[0], o->end[1], s->end[0]) * side(o->end[0], o->end[1], s->end[1]) < 0;
        }
    return n;
}

/* ---- one plane ----------------------------------------------------------------------- */

/* How far P is outside of tube T, < 0 inside; inside less than to the outline.  The ball that is nearest lies
 * beyond the foot of P by its distance from the axis times tan, where sin is how fast radii grow. */
static double depth(const tree_tube *t, const double p[3])
{
    double d[3], v[3];
    minus(t->end[1], t->end[0], d);
    minus(p, t->end[0], v);
    double length = sqrt(dot(d, d)), along = dot(v, d) / length, grows = (t->r[1] - t->r[0]) / length;
    double off = sqrt(fmax(dot(v, v) - along * along, 0));
    double at = fmin(fmax(along + off * grows / sqrt(1 - grows * grows), 0), length);
    return hypot(off, along - at) - t->r[0] - at * grows;
}

/* A plane and the tubes that it cuts: those in[n], each deepest inside at place[]; a grid of nodes 0, 0 at (x, y). */
typedef struct plane {
    const tree *t;
    double z;
    size_t in[TREE_MOST_TUBES], n;
    double place[TREE_MOST_TUBES][2], box[TREE_MOST_TUBES][4];
    double x, y;
    size_t nx, ny;
    double *depth;
} plane;

/* Much finer than the margin, so that no cell holds two tubes that have no node in common. */
static const double PITCH = .25;

/* Of the balls about (1 - s) end[0] + s end[1], which goes deepest through the plane, and by how much? */
static double deepest(const tree_tube *t, double z, double *at)
{
    double a = t->end[0][2], b = t->end[1][2], best = -INFINITY, level = b != a ? clamp((z - a) / (b - a)) : 0;
    const double s[3] = { 0, 1, level };
    for (int i = 0; i < 3; i++) {
        double by = (1 - s[i]) * t->r[0] + s[i] * t->r[1] - fabs((1 - s[i]) * a + s[i] * b - z);
        if (by > best) {
            best = by;
            *at = s[i];
        }
    }
    return best;
}

/* The box of the balls that meet the plane, or more. */
static void bound(const tree_tube *t, double z, double box[4])
{
    double r = fmax(t->r[0], t->r[1]), a = t->end[0][2], b = t->end[1][2];
    double s[2] = { clamp((z - r - a) / (b - a)), clamp((z + r - a) / (b - a)) };
    for (int i = 0; i < 2; i++) {
        double p = (1 - s[0]) * t->end[0][i] + s[0] * t->end[1][i], q = (1 - s[1]) * t->end[0][i] + s[1] * t->end[1][i];
        box[i] = fmin(p, q) - r;
        box[2 + i] = fmax(p, q) + r;
    }
}

static void find_tubes(plane *p)
{
    double lo[2] = { INFINITY, INFINITY }, hi[2] = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < p->t->n; i++) {
        const tree_tube *t = &p->t->tube[i];
        double s = 0, *box = p->box[p->n];
        if (deepest(t, p->z, &s) <= 0)
            continue;
        bound(t, p->z, box);
        for (int k = 0; k < 2; k++) {
            p->place[p->n][k] = (1 - s) * t->end[0][k] + s * t->end[1][k];
            lo[k] = fmin(lo[k], box[k]);
            hi[k] = fmax(hi[k], box[2 + k]);
        }
        p->in[p->n++] = i;
    }
    p->x = lo[0] - 2 * PITCH;
    p->y = lo[1] - 2 * PITCH;
    p->nx = p->n > 0 ? (size_t)((hi[0] - lo[0]) / PITCH) + 6 : 0;
    p->ny = p->n > 0 ? (size_t)((hi[1] - lo[1]) / PITCH) + 6 : 0;
}

static double depth_at(const plane *p, double x, double y)
{
    double least = INFINITY;
    for (size_t i = 0; i < p->n; i++)
        if (p->box[i][0] <= x + PITCH && x - PITCH <= p->box[i][2] && p->box[i][1] <= y + PITCH && y - PITCH <= p->box[i][3])
            least = fmin(least, depth(&p->t->tube[p->in[i]], (double[3]){ x, y, p->z }));
    return least;
}

static void place_node(const plane *p, size_t node, double at[2])
{
    at[0] = p->x + PITCH * (double)(node % p->nx);
    at[1] = p->y + PITCH * (double)(node / p->nx);
}

static void fill_grid(plane *p)
{
    p->depth = room(p->nx * p->ny, sizeof *p->depth);
    for (size_t k = 0; k < p->nx * p->ny; k++)
        p->depth[k] = INFINITY;
    for (size_t i = 0; i < p->n; i++) {
        size_t from[2], to[2];
        for (int k = 0; k < 2; k++) {
            from[k] = (size_t)((p->box[i][k] - (k ? p->y : p->x)) / PITCH) - 1;
            to[k] = (size_t)((p->box[i][2 + k] - (k ? p->y : p->x)) / PITCH) + 2;
        }
        for (size_t y = from[1]; y <= to[1]; y++)
            for (size_t x = from[0]; x <= to[0]; x++) {
                double at[2], *d = &p->depth[y * p->nx + x];
                place_node(p, y * p->nx + x, at);
                *d = fmin(*d, depth(&p->t->tube[p->in[i]], (double[3]){ at[0], at[1], p->z }));
            }
    }
}

/* ---- outlines ---------------------------------------------------------------------------- */

/* Edge 2 n leads from node n along x, 2 n + 1 along y. */
static void ends_of(const plane *p, size_t edge, size_t node[2])
{
    node[0] = edge / 2;
    node[1] = node[0] + (edge % 2 ? p->nx : 1);
}

/* Where the outline crosses EDGE: regula falsi as Illinois has it, which depths, that are distances, suit. */
static void cross(const plane *p, size_t edge, double at[2])
{
    size_t node[2];
    double a[2], b[2], s[2] = { 0, 1 }, d[2], m = .5;
    ends_of(p, edge, node);
    place_node(p, node[0], a);
    place_node(p, node[1], b);
    for (int i = 0; i < 2; i++)
        d[i] = depth_at(p, i ? b[0] : a[0], i ? b[1] : a[1]);
    for (int i = 0, last = -1; i < 30 && fabs(s[1] - s[0]) > 1e-9; i++) {
        m = (s[0] * d[1] - s[1] * d[0]) / (d[1] - d[0]);
        double v = depth_at(p, a[0] + m * (b[0] - a[0]), a[1] + m * (b[1] - a[1]));
        int replaced = (v < 0) == (d[0] < 0) ? 0 : 1;
        if (fabs(v) < 1e-12)
            break;
        s[replaced] = m;
        d[replaced] = v;
        if (replaced == last)
            d[1 - replaced] /= 2;
        last = replaced;
    }
    for (int i = 0; i < 2; i++)
        at[i] = a[i] + m * (b[i] - a[i]);
}

enum { NOTHING = UINT32_MAX };

/* next[]: from each edge that the outline crosses in this cell to the one that it leaves by, with what is
 * inside on its left; corners that touch but across the cell keep apart. */
static void cross_cell(const plane *p, size_t node, uint32_t *next)
{
    const size_t corner[4] = { node, node + 1, node + p->nx + 1, node + p->nx };
    const size_t edge[4] = { 2 * node, 2 * (node + 1) + 1, 2 * (node + p->nx), 2 * node + 1 };
    for (size_t i = 0; i < 4; i++) {
        size_t k = i;
        if (!(p->depth[corner[i]] < 0 && !(p->depth[corner[(i + 1) % 4]] < 0)))
            continue;
        while (p->depth[corner[k]] < 0)
            k = (k + 3) % 4;
        next[edge[i]] = (uint32_t)edge[k];
    }
}

/* Vertices half a cell apart at least. */
static void trace(const plane *p, uint32_t *next, uint32_t from, il_slice *to)
{
    il_ring *r = il_slice_add_ring(to);
    double last[2] = { INFINITY, 0 }, first[2], at[2];
    need(r);
    for (uint32_t e = from, then; next[e] != (uint32_t)NOTHING; e = then) {
        then = next[e];
        next[e] = (uint32_t)NOTHING;
        cross(p, e, at);
        if (e == from)
            memcpy(first, at, sizeof first);
        else if (hypot(at[0] - last[0], at[1] - last[1]) < PITCH / 2 || hypot(at[0] - first[0], at[1] - first[1]) < PITCH / 2)
            continue;
        need(il_ring_add(r, at[0], at[1], 0));
        memcpy(last, at, sizeof last);
    }
    if (r->n < 3)
        il_ring_free(&to->ring[--to->n]);
}

static void contour(plane *p, il_slice *to)
{
    size_t n_edges = 2 * p->nx * p->ny;
    uint32_t *next = room(n_edges, sizeof *next);
    fill_grid(p);
    for (size_t e = 0; e < n_edges; e++)
        next[e] = (uint32_t)NOTHING;
    for (size_t y = 0; y + 1 < p->ny; y++)
        for (size_t x = 0; x + 1 < p->nx; x++)
            cross_cell(p, y * p->nx + x, next);
    for (size_t e = 0; e < n_edges; e++)
        if (next[e] != (uint32_t)NOTHING)
            trace(p, next, (uint32_t)e, to);
    il_slice_put_in_order(to);
    il_free(p->depth);
    il_free(next);
}

/* ---- pieces ---------------------------------------------------------------------------------- */

static bool holds(const il_ring *r, const double at[2])
{
    bool inside = false;
    for (size_t i = 0; i < r->n; i++) {
        const double *p = r->xy + 2 * i, *q = r->xy + 2 * (i + 1 < r->n ? i + 1 : 0);
        if ((p[1] > at[1]) != (q[1] > at[1]) && at[0] < p[0] + (at[1] - p[1]) / (q[1] - p[1]) * (q[0] - p[0]))
            inside = !inside;
    }
    return inside;
}

/* ring[tube]: the ring that holds each tube's section, NOTHING for tubes that are not cut. */
static void find_rings(const plane *p, const il_slice *s, uint32_t *ring)
{
    for (size_t i = 0; i < p->t->n; i++)
        ring[i] = (uint32_t)NOTHING;
    for (size_t i = 0; i < p->n; i++)
        for (size_t k = 0; k < s->n; k++)
            if (holds(&s->ring[k], p->place[i]))
                ring[p->in[i]] = (uint32_t)k;
}

static void join_by_rings(uint32_t *up, const uint32_t *ring, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            if (ring[i] != (uint32_t)NOTHING && ring[i] == ring[j])
                il_forest_join(up, (uint32_t)i, (uint32_t)j);
}

/* What of the tubes is one piece between planes z[0] and z[1], whose rings hold them as ring[0] and ring[1] say.
 * A tube is convex, so its part in the slab is in one piece, and likewise what two tubes share: if
 * that is in the slab at all, their node is, or one plane cuts it, and there a ring holds both. */
static void join_in_slab(const tree *t, const double z[2], uint32_t *const ring[2], uint32_t *up)
{
    il_forest_plant(up, t->n);
    for (size_t i = 0; i < t->n; i++)
        for (size_t j = 0; j < i; j++)
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++) {
                    size_t node = t->tube[i].node[a];
                    if (node == t->tube[j].node[b] && t->z[node] > z[0] && t->z[node] < z[1])
                        il_forest_join(up, (uint32_t)i, (uint32_t)j);
                }
    join_by_rings(up, ring[0], t->n);
    join_by_rings(up, ring[1], t->n);
}

static void name_pieces(uint32_t *up, const uint32_t *ring, size_t n, uint32_t *piece)
{
    for (size_t i = 0; i < n; i++)
        if (ring[i] != (uint32_t)NOTHING)
            piece[ring[i]] = il_forest_leader(up, (uint32_t)i);
}

/* ring[2 * t->n]: two slices' by turns. */
static void find_pieces(const tree *t, tree_slices *s, uint32_t *ring)
{
    uint32_t up[TREE_MOST_TUBES];
    for (size_t k = 0; k < s->n; k++) {
        plane p = { .t = t, .z = s->slice[k].z };
        uint32_t *const rings[2] = { ring + (k + 1) % 2 * t->n, ring + k % 2 * t->n };
        find_tubes(&p);
        find_rings(&p, &s->slice[k], rings[1]);
        if (k == 0)
            continue;
        join_in_slab(t, (double[2]){ s->slice[k - 1].z, p.z }, rings, up);
        name_pieces(up, rings[0], t->n, s->above + s->first[k - 1]);
        name_pieces(up, rings[1], t->n, s->below + s->first[k]);
    }
}

static bool has_holes(const il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        if (il_ring_area2(&s->ring[i]) < 0)
            return true;
    return false;
}

void tree_section(const tree *t, double z, il_slice *to)
{
    plane p = { .t = t, .z = z };
    *to = (il_slice)IL_SLICE_INIT;
    to->z = z;
    find_tubes(&p);
    contour(&p, to);
}

/* By planes from FROM on; false where one cuts the pit between three branches, or none cuts anything. */
static bool cut_from(const tree *t, double from, double to_z, double spacing, tree_slices *to)
{
    size_t cap = 0;
    for (double z = from; z < to_z; z += spacing) {
        il_slice s;
        need(il_grow(&to->slice, &cap, to->n + 1, sizeof *to->slice));
        tree_section(t, z, &s);
        bool bad = has_holes(&s);
        if (s.n > 0 && !bad)
            to->slice[to->n++] = s;
        else
            il_slice_free(&s);
        if (bad)
            return false;
    }
    return to->n > 0;
}

void tree_cut(const tree *t, double spacing, uint64_t seed, tree_slices *to)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < t->n; i++)
        for (int e = 0; e < 2; e++) {
            low = fmin(low, t->tube[i].end[e][2] - t->tube[i].r[e]);
            high = fmax(high, t->tube[i].end[e][2] + t->tube[i].r[e]);
        }
    *to = (tree_slices){ .n = 0 };
    while (!cut_from(t, low + between(&seed, 0, spacing), high, spacing, to))
        tree_slices_free(to);
    to->first = room(to->n + 1, sizeof *to->first);
    for (size_t k = 0; k < to->n; k++)
        to->first[k + 1] = to->first[k] + to->slice[k].n;
    to->above = room(to->first[to->n], sizeof *to->above);
    to->below = room(to->first[to->n], sizeof *to->below);
    for (size_t i = 0; i < to->first[to->n]; i++)
        to->above[i] = to->below[i] = (uint32_t)NOTHING;
    uint32_t *ring = room(2 * t->n, sizeof *ring);
    find_pieces(t, to, ring);
    il_free(ring);
}

void tree_slices_free(tree_slices *s)
{
    for (size_t k = 0; k < s->n; k++)
        il_slice_free(&s->slice[k]);
    il_free(s->slice);
    il_free(s->first);
    il_free(s->above);
    il_free(s->below);
    *s = (tree_slices){ .n = 0 };
}
