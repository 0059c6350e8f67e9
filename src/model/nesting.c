#include "config.h"
#include "model/nesting.h"
#include "base/alloc.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Down is along -(1, A, B): oblique, so that no edge of a built thing lies in
 * that direction.  Heights and plan positions: u = x + A y + B z, s = y - A x,
 * t = z - B x; s and t do not change along the ray, and (u, s, t) is
 * right-handed, since its determinant is 1 + A^2 + B^2. */
static const double A = 0.013729, B = 0.0071833;

typedef struct place { double u, s, t; } place;

static place place_of(const double *p)
{
    return (place){ p[0] + A * p[1] + B * p[2], p[1] - A * p[0], p[2] - B * p[0] };
}

enum { LEAF = 4 };

/* triangle[n]: sorted so that neighbours are close; leaf i of n_leaves, a power
 * of two, holds [i n / n_leaves, (i + 1) n / n_leaves); node k has children
 * 2 k + 1 and 2 k + 2. */
typedef struct box { place lo, hi; } box;
typedef struct tree {
    const il_mesh *mesh;
    uint32_t *triangle;
    size_t n, n_leaves;
    box *node;
} tree;

/* ---- building --------------------------------------------------------------- */

static const box empty = { { DBL_MAX, DBL_MAX, DBL_MAX }, { -DBL_MAX, -DBL_MAX, -DBL_MAX } };

static void add_box(box *b, const box *c)
{
    b->lo = (place){ fmin(b->lo.u, c->lo.u), fmin(b->lo.s, c->lo.s), fmin(b->lo.t, c->lo.t) };
    b->hi = (place){ fmax(b->hi.u, c->hi.u), fmax(b->hi.s, c->hi.s), fmax(b->hi.t, c->hi.t) };
}

static box box_of_triangle(const il_mesh *m, size_t t)
{
    box b = empty;
    for (size_t k = 0; k < 3; k++) {
        place p = place_of(m->xyz + 3 * (size_t)m->tri[3 * t + k]);
        add_box(&b, &(box){ p, p });
    }
    return b;
}

/* The lower 16 bits of X with zeros between. */
static uint64_t spread(uint64_t x)
{
    x = (x | x << 16) & UINT64_C(0x0000FF0000FF);
    x = (x | x << 8) & UINT64_C(0x00F00F00F00F);
    x = (x | x << 4) & UINT64_C(0x0C30C30C30C3);
    return (x | x << 2) & UINT64_C(0x249249249249);
}

typedef struct key { uint64_t code; uint32_t triangle; } key;

static int by_code(const void *pa, const void *pb)
{
    const key *a = pa, *b = pb;
    if (a->code != b->code)
        return a->code < b->code ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static uint64_t cell(double c, double lo, double hi)
{
    return hi > lo ? (uint64_t)((c - lo) / (hi - lo) * 65535) : 0;
}

/* Along a Morton curve through the triangles' middles. */
static il_status sort_triangles(tree *tr, il_error *err)
{
    box all = empty;
    key *keys = il_alloc(tr->n, sizeof *keys);
    if (!keys)
        return il_fail_nomem(err);
    for (size_t i = 0; i < tr->n; i++) {
        box b = box_of_triangle(tr->mesh, i);
        add_box(&all, &b);
    }
    for (size_t i = 0; i < tr->n; i++) {
        box b = box_of_triangle(tr->mesh, i);
        uint64_t u = cell(b.lo.u / 2 + b.hi.u / 2, all.lo.u, all.hi.u);
        uint64_t s = cell(b.lo.s / 2 + b.hi.s / 2, all.lo.s, all.hi.s);
        uint64_t t = cell(b.lo.t / 2 + b.hi.t / 2, all.lo.t, all.hi.t);
        keys[i] = (key){ spread(u) | spread(s) << 1 | spread(t) << 2, (uint32_t)i };
    }
    qsort(keys, tr->n, sizeof *keys, by_code);
    for (size_t i = 0; i < tr->n; i++)
        tr->triangle[i] = keys[i].triangle;
    il_free(keys);
    return IL_OK;
}

static size_t leaf_begin(const tree *tr, size_t i)
{
    return i * tr->n / tr->n_leaves;
}

static void fill_nodes(tree *tr)
{
    for (size_t k = 0; k < 2 * tr->n_leaves - 1; k++)
        tr->node[k] = empty;
    for (size_t i = 0; i < tr->n_leaves; i++)
        for (size_t j = leaf_begin(tr, i); j < leaf_begin(tr, i + 1); j++) {
            box b = box_of_triangle(tr->mesh, tr->triangle[j]);
            add_box(&tr->node[tr->n_leaves - 1 + i], &b);
        }
    for (size_t k = tr->n_leaves - 1; k-- > 0;) {
        add_box(&tr->node[k], &tr->node[2 * k + 1]);
        add_box(&tr->node[k], &tr->node[2 * k + 2]);
    }
}

static il_status build_tree(tree *tr, const il_mesh *m, il_error *err)
{
    *tr = (tree){ .mesh = m, .n = m->n_triangles, .n_leaves = 1 };
    while (LEAF * tr->n_leaves < tr->n)
        tr->n_leaves *= 2;
    tr->triangle = il_alloc(tr->n, sizeof *tr->triangle);
    tr->node = il_alloc(2 * tr->n_leaves - 1, sizeof *tr->node);
    if (!tr->triangle || !tr->node)
        return il_fail_nomem(err);
    il_status st = sort_triangles(tr, err);
    if (st == IL_OK)
        fill_nodes(tr);
    return st;
}

static void free_tree(tree *tr)
{
    il_free(tr->triangle);
    il_free(tr->node);
}

/* ---- the nearest triangle below a place ---------------------------------------- */

/* Only parts that come before LIMIT in RANK count. */
typedef struct query {
    const tree *tree;
    const uint32_t *part, *rank;
    uint32_t limit;
    place from;
    bool found, faces_up;
    double u;
    uint32_t hit;               /* triangle */
} query;

static double area2(place a, place b, place c)
{
    return (b.s - a.s) * (c.t - a.t) - (b.t - a.t) * (c.s - a.s);
}

static void corners_of(const il_mesh *m, size_t t, place corner[3])
{
    for (size_t k = 0; k < 3; k++)
        corner[k] = place_of(m->xyz + 3 * (size_t)m->tri[3 * t + k]);
}

static void try_triangle(query *q, uint32_t t)
{
    place c[3];
    corners_of(q->tree->mesh, t, c);
    double w0 = area2(c[1], c[2], q->from), w1 = area2(c[2], c[0], q->from), w2 = area2(c[0], c[1], q->from);
    double w = w0 + w1 + w2;
    if (w == 0 || (w > 0 ? fmin(fmin(w0, w1), w2) < 0 : fmax(fmax(w0, w1), w2) > 0))
        return;
    double u = (w0 * c[0].u + w1 * c[1].u + w2 * c[2].u) / w;
    if (u < q->from.u && (!q->found || u > q->u)) {
        q->found = true;
        q->faces_up = w > 0;
        q->u = u;
        q->hit = t;
    }
}

/* Recursion: at most the height of the tree. */
static void find_below(query *q, size_t k)
{
    const tree *tr = q->tree;
    const box *b = &tr->node[k];
    const place p = q->from;
    if (p.s < b->lo.s || p.s > b->hi.s || p.t < b->lo.t || p.t > b->hi.t || p.u <= b->lo.u)
        return;
    if (q->found && b->hi.u <= q->u)
        return;
    if (k >= tr->n_leaves - 1) {
        size_t i = k - (tr->n_leaves - 1);
        for (size_t j = leaf_begin(tr, i); j < leaf_begin(tr, i + 1); j++)
            if (q->rank[q->part[tr->triangle[j]]] < q->limit)
                try_triangle(q, tr->triangle[j]);
        return;
    }
    size_t left = 2 * k + 1, right = 2 * k + 2;
    bool left_first = tr->node[left].hi.u >= tr->node[right].hi.u;
    find_below(q, left_first ? left : right);
    find_below(q, left_first ? right : left);
}

/* ---- parts ----------------------------------------------------------------------- */

/* The lowest vertex of a part, and the widest triangle there as seen along the ray. */
typedef struct lowest {
    double u, width;
    uint32_t part, triangle;
} lowest;

static int by_height(const void *pa, const void *pb)
{
    const lowest *a = pa, *b = pb;
    return a->u != b->u ? (a->u < b->u ? -1 : 1) : (a->part > b->part) - (a->part < b->part);
}

static bool is_collapsed(const uint32_t *t)
{
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

static double lowest_of(const place c[3])
{
    return fmin(fmin(c[0].u, c[1].u), c[2].u);
}

/* Sorted by height; rank[part] says where. */
static void find_lowest(const il_mesh *m, const uint32_t *part, size_t n_parts, lowest *low, uint32_t *rank)
{
    for (size_t k = 0; k < n_parts; k++)
        low[k] = (lowest){ DBL_MAX, -1, (uint32_t)k, 0 };
    for (size_t t = 0; t < m->n_triangles; t++) {
        place c[3];
        corners_of(m, t, c);
        if (is_collapsed(m->tri + 3 * t) || lowest_of(c) > low[part[t]].u)
            continue;
        double width = fabs(area2(c[0], c[1], c[2]));
        if (lowest_of(c) < low[part[t]].u || width > low[part[t]].width)
            low[part[t]] = (lowest){ lowest_of(c), width, part[t], (uint32_t)t };
    }
    qsort(low, n_parts, sizeof *low, by_height);
    for (size_t i = 0; i < n_parts; i++)
        rank[low[i].part] = (uint32_t)i;
}

/* On the triangle, a thousandth of the way from its lowest corner to its middle:
 * solids often touch in single vertices, where a ray would run into either. */
static place start_of(const il_mesh *m, const lowest *low)
{
    place c[3];
    corners_of(m, low->triangle, c);
    int k = c[1].u == low->u ? 1 : c[2].u == low->u ? 2 : 0;
    const double f = 1e-3 / 3;
    return (place){ c[k].u + f * (c[0].u + c[1].u + c[2].u - 3 * c[k].u),
                    c[k].s + f * (c[0].s + c[1].s + c[2].s - 3 * c[k].s),
                    c[k].t + f * (c[0].t + c[1].t + c[2].t - 3 * c[k].t) };
}

/* The ray starts outside of its own part.  It is outside of the part it hits,
 * too, when the triangle's face agrees with that part's sign; else it is inside,
 * where the part counts for one more (or, reversed, one less). */
static long winding_at(const query *q, const double *volume, const long *winding)
{
    if (!q->found)
        return 0;
    uint32_t k = q->part[q->hit];
    bool positive = volume[k] > 0;
    return winding[k] + (q->faces_up == positive ? 0 : positive ? 1 : -1);
}

il_status il_mesh_windings(const il_mesh *m, const uint32_t *part, size_t n_parts, const double *volume,
                           long *winding, il_error *err)
{
    tree tr;
    lowest *low = il_alloc(n_parts, sizeof *low);
    uint32_t *rank = il_alloc(n_parts, sizeof *rank);
    il_status st = build_tree(&tr, m, err);
    if (st == IL_OK && (!low || !rank))
        st = il_fail_nomem(err);
    if (st == IL_OK) {
        find_lowest(m, part, n_parts, low, rank);
        for (size_t i = 0; i < n_parts; i++) {
            query q = { .tree = &tr, .part = part, .rank = rank, .limit = (uint32_t)i, .from = start_of(m, &low[i]) };
            find_below(&q, 0);
            winding[low[i].part] = winding_at(&q, volume, winding);
        }
    }
    il_free(low);
    il_free(rank);
    free_tree(&tr);
    return st;
}
