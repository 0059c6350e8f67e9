#include "config.h"
#include "model/audit.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "bridge/intersection.h"
#include "bridge/predicates.h"
#include "model/nesting.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A corner is numbered 3 t + k; it begins the half-edge to corner k + 1 of its
 * triangle.  The half-edges of an edge stand together:
 *     half[begin[v] .. begin[v + 1])  those whose lesser vertex is v, by the
 *                                     greater one, then by corner.
 * fan and part join corners and triangles (union-find; the root is the least). */
typedef struct half { uint32_t other, corner; } half;
typedef struct work {
    const il_mesh *mesh;
    il_audit *audit;
    size_t *begin;
    half *half;
    uint32_t *fan, *part;
    double *volume;             /* per part */
    long *winding;
} work;

static const uint32_t *corners_of(const work *w, size_t t)
{
    return w->mesh->tri + 3 * t;
}

static const double *position(const work *w, uint32_t vertex)
{
    return w->mesh->xyz + 3 * (size_t)vertex;
}

/* It names a vertex twice. */
static bool is_collapsed(const uint32_t *t)
{
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

static bool has_no_area(const work *w, const uint32_t *t)
{
    return !il_triangle_has_area(position(w, t[0]), position(w, t[1]), position(w, t[2]));
}

/* ---- half-edges, sorted by their edge -------------------------------------------- */

static int by_other(const void *pa, const void *pb)
{
    const half *a = pa, *b = pb;
    return a->other != b->other ? (a->other < b->other ? -1 : 1) : (a->corner > b->corner) - (a->corner < b->corner);
}

static void sort_halves(half *h, size_t n)
{
    enum { FEW = 24 };
    if (n > FEW) {
        qsort(h, n, sizeof *h, by_other);
        return;
    }
    for (size_t i = 1; i < n; i++) {
        half x = h[i];
        size_t j = i;
        for (; j > 0 && by_other(&h[j - 1], &x) > 0; j--)
            h[j] = h[j - 1];
        h[j] = x;
    }
}

static uint32_t next_corner(uint32_t c)
{
    return c % 3 == 2 ? c - 2 : c + 1;
}

/* A counting sort by the lesser vertex, then each vertex's few by the other. */
static il_status gather_halves(work *w, il_error *err)
{
    const uint32_t *tri = w->mesh->tri;
    size_t nv = w->mesh->n_vertices, nc = 3 * w->mesh->n_triangles;
    w->begin = il_calloc(nv + 2, sizeof *w->begin);
    w->half = il_alloc(nc, sizeof *w->half);
    if (!w->begin || !w->half)
        return il_fail_nomem(err);
    size_t *fill = w->begin + 1; /* becomes begin once all are placed */
    for (int pass = 0; pass < 2; pass++) {
        for (size_t c = 0; c < nc; c++) {
            uint32_t a = tri[c], b = tri[next_corner((uint32_t)c)];
            if (is_collapsed(tri + c - c % 3))
                continue;
            uint32_t lesser = a < b ? a : b;
            if (pass == 0)
                fill[lesser + 1]++;
            else
                w->half[fill[lesser]++] = (half){ a < b ? b : a, (uint32_t)c };
        }
        for (size_t v = 0; pass == 0 && v < nv; v++)
            fill[v + 1] += fill[v];
    }
    for (size_t v = 0; v < nv; v++)
        sort_halves(w->half + w->begin[v], w->begin[v + 1] - w->begin[v]);
    return IL_OK;
}

/* ---- edges --------------------------------------------------------------------------- */

/* The corner of C's triangle that is at VERTEX, one end of its half-edge. */
static uint32_t corner_at(const work *w, uint32_t c, uint32_t vertex)
{
    return w->mesh->tri[c] == vertex ? c : next_corner(c);
}

/* The N half-edges at H make the edge between VERTEX and another. */
static void account_edge(work *w, uint32_t vertex, const half *h, size_t n)
{
    size_t from_vertex = 0;
    for (size_t i = 0; i < n; i++) {
        from_vertex += w->mesh->tri[h[i].corner] == vertex;
        il_forest_join(w->part, h[0].corner / 3, h[i].corner / 3);
        il_forest_join(w->fan, corner_at(w, h[0].corner, vertex), corner_at(w, h[i].corner, vertex));
        il_forest_join(w->fan, corner_at(w, h[0].corner, h[0].other), corner_at(w, h[i].corner, h[0].other));
    }
    w->audit->edges++;
    w->audit->boundary_edges += n == 1;
    w->audit->nonmanifold_edges += n > 2;
    w->audit->inconsistent_edges += n > 1 && 2 * from_vertex != n;
}

static il_status account_edges(work *w, il_error *err)
{
    size_t nt = w->mesh->n_triangles;
    w->fan = il_alloc(3 * nt, sizeof *w->fan);
    w->part = il_alloc(nt, sizeof *w->part);
    if (!w->fan || !w->part)
        return il_fail_nomem(err);
    for (size_t i = 0; i < 3 * nt; i++)
        w->fan[i] = (uint32_t)i;
    for (size_t i = 0; i < nt; i++)
        w->part[i] = (uint32_t)i;
    for (size_t v = 0; v < w->mesh->n_vertices; v++) {
        size_t j;
        for (size_t i = w->begin[v]; i < w->begin[v + 1]; i = j) {
            for (j = i; j < w->begin[v + 1] && w->half[j].other == w->half[i].other; j++)
                ;
            account_edge(w, (uint32_t)v, w->half + i, j - i);
        }
    }
    return IL_OK;
}

/* ---- vertices, triangles, parts ---------------------------------------------------------- */

static il_status account_vertices(work *w, il_error *err)
{
    const il_mesh *m = w->mesh;
    unsigned char *fans = il_calloc(m->n_vertices, 1); /* 0, 1, or 2 for several */
    if (!fans)
        return il_fail_nomem(err);
    for (size_t c = 0; c < 3 * m->n_triangles; c++) {
        unsigned char *f = &fans[m->tri[c]];
        if (w->fan[c] == c && !is_collapsed(m->tri + c - c % 3) && *f < 2)
            ++*f;
    }
    for (size_t v = 0; v < m->n_vertices; v++) {
        w->audit->loose_vertices += fans[v] == 0;
        w->audit->nonmanifold_vertices += fans[v] > 1;
    }
    il_free(fans);
    return IL_OK;
}

static size_t middle_and_greatest(const uint32_t *t, uint32_t to[2])
{
    uint32_t least = t[0] < t[1] ? (t[0] < t[2] ? t[0] : t[2]) : (t[1] < t[2] ? t[1] : t[2]);
    uint32_t most = t[0] > t[1] ? (t[0] > t[2] ? t[0] : t[2]) : (t[1] > t[2] ? t[1] : t[2]);
    to[0] = t[0] ^ t[1] ^ t[2] ^ least ^ most;
    to[1] = most;
    return least;
}

static int by_vertices(const void *pa, const void *pb)
{
    const uint32_t *a = pa, *b = pb;
    for (int k = 0; k < 3; k++)
        if (a[k] != b[k])
            return a[k] < b[k] ? -1 : 1;
    return 0;
}

/* Triangles with equal sorted vertices stand together once sorted. */
static il_status account_duplicates(work *w, il_error *err)
{
    size_t n = w->mesh->n_triangles;
    uint32_t(*sorted)[3] = il_alloc(n, sizeof *sorted);
    if (!sorted)
        return il_fail_nomem(err);
    for (size_t t = 0; t < n; t++)
        sorted[t][0] = (uint32_t)middle_and_greatest(corners_of(w, t), &sorted[t][1]);
    qsort(sorted, n, sizeof *sorted, by_vertices);
    for (size_t t = 1; t < n; t++)
        w->audit->duplicate_triangles += by_vertices(sorted[t - 1], sorted[t]) == 0;
    il_free(sorted);
    return IL_OK;
}

/* part[t] becomes the number of its part, in order of their first triangles;
 * collapsed triangles, which touch nothing, get part 0 and make none. */
static void number_parts(work *w)
{
    size_t n = 0;
    for (size_t t = 0; t < w->mesh->n_triangles; t++)
        w->part[t] = il_forest_leader(w->part, (uint32_t)t);
    for (size_t t = 0; t < w->mesh->n_triangles; t++) {
        if (is_collapsed(corners_of(w, t)))
            w->part[t] = 0;
        else
            w->part[t] = w->part[t] == t ? (uint32_t)n++ : w->part[w->part[t]];
    }
    w->audit->components = n;
}

/* ---- measures ------------------------------------------------------------------------------- */

static void find_bounds(work *w)
{
    il_audit *a = w->audit;
    for (int k = 0; k < 3; k++) {
        a->lo[k] = w->mesh->n_triangles ? DBL_MAX : 0;
        a->hi[k] = w->mesh->n_triangles ? -DBL_MAX : 0;
    }
    for (size_t c = 0; c < 3 * w->mesh->n_triangles; c++)
        for (int k = 0; k < 3; k++) {
            double x = position(w, w->mesh->tri[c])[k];
            a->lo[k] = x < a->lo[k] ? x : a->lo[k];
            a->hi[k] = x > a->hi[k] ? x : a->hi[k];
        }
}

/* Six times the signed volume of the tetrahedron from the middle of the bounds,
 * which keeps the terms small, and twice the area. */
static void measure_triangle(const work *w, const uint32_t *t, double *volume6, double *area2)
{
    double p[3][3], n[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            p[i][k] = position(w, t[i])[k] - (w->audit->lo[k] / 2 + w->audit->hi[k] / 2);
    for (int k = 0; k < 3; k++) {
        int x = (k + 1) % 3, y = (k + 2) % 3;
        n[k] = (p[1][x] - p[0][x]) * (p[2][y] - p[0][y]) - (p[1][y] - p[0][y]) * (p[2][x] - p[0][x]);
    }
    *volume6 = p[0][0] * n[0] + p[0][1] * n[1] + p[0][2] * n[2];
    *area2 = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static il_status measure(work *w, il_error *err)
{
    il_audit *a = w->audit;
    find_bounds(w);
    w->volume = il_calloc(a->components, sizeof *w->volume);
    if (!w->volume)
        return il_fail_nomem(err);
    for (size_t t = 0; t < w->mesh->n_triangles; t++) {
        double volume6, area2;
        if (is_collapsed(corners_of(w, t)))
            continue;
        measure_triangle(w, corners_of(w, t), &volume6, &area2);
        w->volume[w->part[t]] += volume6 / 6;
        a->area += area2 / 2;
    }
    for (size_t k = 0; k < a->components; k++)
        a->volume += w->volume[k];
    return IL_OK;
}

/* Every part in the open is positive, every part in a solid is a cavity of it. */
static il_status find_outward(work *w, il_error *err)
{
    il_audit *a = w->audit;
    if (!a->closed || !a->oriented || a->components == 0)
        return IL_OK;
    if (a->components == 1) {
        a->outward = w->volume[0] > 0;
        return IL_OK;
    }
    w->winding = il_alloc(a->components, sizeof *w->winding);
    if (!w->winding)
        return il_fail_nomem(err);
    il_status st = il_mesh_windings(w->mesh, w->part, a->components, w->volume, w->winding, err);
    a->outward = st == IL_OK;
    for (size_t k = 0; k < a->components && st == IL_OK; k++)
        a->outward = a->outward && w->winding[k] == (w->volume[k] > 0 ? 0 : 1);
    return st;
}

/* ---- crossings --------------------------------------------------------------------------------- */

/* Degenerate triangles are counted and left out: they would each be a pair. */
static il_status find_crossings(work *w, il_error *err)
{
    const il_mesh *m = w->mesh;
    il_audit *a = w->audit;
    uint32_t *tri = il_alloc(m->n_triangles, 3 * sizeof *tri), *old = il_alloc(m->n_triangles, sizeof *old);
    il_status st = tri && old ? IL_OK : il_fail_nomem(err);
    size_t n = 0;
    for (size_t t = 0; st == IL_OK && t < m->n_triangles; t++) {
        if (has_no_area(w, corners_of(w, t)))
            continue;
        memcpy(tri + 3 * n, corners_of(w, t), 3 * sizeof *tri);
        old[n++] = (uint32_t)t;
    }
    if (st == IL_OK) {
        a->degenerate_triangles = m->n_triangles - n;
        st = il_intersections(m->xyz, m->n_vertices, tri, n, NULL, IL_AUDIT_INTERSECTIONS,
                              &a->self_intersections, a->first_intersection, err);
    }
    if (st == IL_OK && a->self_intersections > 0) {
        a->more_intersections = a->self_intersections == IL_AUDIT_INTERSECTIONS;
        for (int k = 0; k < 2; k++)
            a->first_intersection[k] = old[a->first_intersection[k]];
    }
    il_free(tri);
    il_free(old);
    return st;
}

/* ---- all of it ------------------------------------------------------------------------------------ */

/* The sum over the components of 2 - 2 g is V - E + F. */
static void conclude(il_audit *a)
{
    a->closed = a->triangles > 0 && a->boundary_edges == 0;
    a->manifold = a->nonmanifold_edges == 0 && a->nonmanifold_vertices == 0;
    a->oriented = a->inconsistent_edges == 0;
    a->has_genus = a->closed && a->manifold && a->oriented;
}

static void find_genus(work *w)
{
    il_audit *a = w->audit;
    long collapsed = 0;
    for (size_t t = 0; t < w->mesh->n_triangles; t++)
        collapsed += is_collapsed(corners_of(w, t));
    long euler = (long)(a->vertices - a->loose_vertices) - (long)a->edges + (long)a->triangles - collapsed;
    if (a->has_genus)
        a->genus = (long)a->components - euler / 2;
}

il_status il_mesh_audit(const il_mesh *m, il_audit *out, il_error *err)
{
    *out = (il_audit){ .vertices = m->n_vertices, .triangles = m->n_triangles,
                       .first_intersection = { UINT32_MAX, UINT32_MAX } };
    work w = { .mesh = m, .audit = out };
    il_status st = gather_halves(&w, err);
    if (st == IL_OK)
        st = account_edges(&w, err);
    if (st == IL_OK)
        st = account_vertices(&w, err);
    if (st == IL_OK)
        st = account_duplicates(&w, err);
    if (st == IL_OK) {
        number_parts(&w);
        conclude(out);
        find_genus(&w);
        st = measure(&w, err);
    }
    if (st == IL_OK)
        st = find_outward(&w, err);
    if (st == IL_OK)
        st = find_crossings(&w, err);
    il_free(w.begin);
    il_free(w.half);
    il_free(w.fan);
    il_free(w.part);
    il_free(w.volume);
    il_free(w.winding);
    return st;
}

bool il_audit_is_sound(const il_audit *a)
{
    return a->closed && a->manifold && a->oriented && a->outward && a->degenerate_triangles == 0
        && a->duplicate_triangles == 0 && a->self_intersections == 0;
}
