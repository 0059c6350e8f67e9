#include "config.h"
#include "region/boundary.h"
#include "base/alloc.h"
#include "base/parity.h"
#include "bridge/triangulation.h"
#include "model/order.h"

#include <stdlib.h>
#include <string.h>

/* The odd edges over the nodes that they use, and the triangles between them.
 * Triangle edge k of t runs from corner[3t+k] to corner[3t+(k+1)%3]. */
typedef struct face_map {
    double *xy;                   /* [2*n_nodes] */
    unsigned char *mark;          /* [n_nodes] vertex marks */
    uint32_t *edge;               /* [2*n_edges] */
    unsigned char *edge_mark;     /* [n_edges] */
    il_keymap edge_at;            /* undirected edge -> index */
    size_t n_nodes, n_edges;
    uint32_t *corner, *across;
    uint32_t *bound;              /* [3*n_triangles] the odd edge there, or NONE */
    size_t n_triangles;
    unsigned char *inside;        /* [n_triangles] even-odd */
    unsigned char *done;          /* [n_triangles] bit k: boundary edge k is in a ring */
} face_map;

static const uint32_t NONE = UINT32_MAX;

static void face_map_free(face_map *m)
{
    il_free(m->xy);
    il_free(m->mark);
    il_free(m->edge);
    il_free(m->edge_mark);
    il_keymap_free(&m->edge_at);
    il_free(m->corner);
    il_free(m->across);
    il_free(m->bound);
    il_free(m->inside);
    il_free(m->done);
}

/* For each undirected edge of A how often it comes; the first of them leads. */
static bool count_edges(const il_arrangement *a, uint32_t *times)
{
    il_keymap first = IL_KEYMAP_INIT;
    bool ok = il_keymap_reserve(&first, a->n_edges);
    for (size_t i = 0; ok && i < a->n_edges; i++) {
        uint32_t p = a->edge[2 * i], q = a->edge[2 * i + 1];
        uint32_t *lead = il_keymap_put(&first, IL_KEYMAP_EDGE(p, q), (uint32_t)i);
        times[i] = 0;
        times[*lead]++;
    }
    il_keymap_free(&first);
    return ok;
}

/* Take over the edges that come an odd number of times, with their nodes. */
static il_status take_odd_edges(face_map *m, const il_arrangement *a, size_t *cancelled, il_error *err)
{
    uint32_t *times = il_alloc(a->n_edges, sizeof *times);
    uint32_t *new_id = il_alloc(a->n_nodes, sizeof *new_id);
    m->xy = il_alloc(a->n_nodes, 2 * sizeof *m->xy);
    m->mark = il_alloc(a->n_nodes, 1);
    m->edge = il_alloc(a->n_edges, 2 * sizeof *m->edge);
    m->edge_mark = il_alloc(a->n_edges, 1);
    bool ok = times && new_id && m->xy && m->mark && m->edge && m->edge_mark && count_edges(a, times);
    if (ok)
        memset(new_id, 0xFF, a->n_nodes * sizeof *new_id);
    *cancelled = 0;
    for (size_t i = 0; ok && i < a->n_edges; i++) {
        if (times[i] % 2 == 0) {
            *cancelled += times[i];
            continue;
        }
        *cancelled += times[i] - 1;
        for (int k = 0; k < 2; k++) {
            uint32_t node = a->edge[2 * i + (size_t)k];
            if (new_id[node] == NONE) {
                memcpy(m->xy + 2 * m->n_nodes, a->xy + 2 * node, 2 * sizeof *m->xy);
                m->mark[m->n_nodes] = a->mark[node];
                new_id[node] = (uint32_t)m->n_nodes++;
            }
            m->edge[2 * m->n_edges + (size_t)k] = new_id[node];
        }
        m->edge_mark[m->n_edges] = a->edge_mark[i];
        ok = il_keymap_put(&m->edge_at, IL_KEYMAP_EDGE(m->edge[2 * m->n_edges], m->edge[2 * m->n_edges + 1]),
                           (uint32_t)m->n_edges);
        m->n_edges++;
    }
    il_free(times);
    il_free(new_id);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* Which triangle edges bound the region, and on which side of them it lies. */
static il_status find_inside(face_map *m, il_error *err)
{
    unsigned char *bound = il_alloc(m->n_triangles, 3);
    m->bound = il_alloc(m->n_triangles, 3 * sizeof *m->bound);
    m->inside = il_alloc(m->n_triangles, 1);
    m->done = il_calloc(m->n_triangles, 1);
    bool ok = bound && m->bound && m->inside && m->done;
    for (size_t e = 0; ok && e < 3 * m->n_triangles; e++) {
        uint32_t p = m->corner[e], q = m->corner[e % 3 == 2 ? e - 2 : e + 1];
        m->bound[e] = il_keymap_get(&m->edge_at, IL_KEYMAP_EDGE(p, q), NONE);
        bound[e] = m->bound[e] != NONE;
    }
    ok = ok && il_parity_flood(m->across, bound, 1, m->n_triangles, m->inside);
    il_free(bound);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* From boundary edge *K of inside triangle *T to the next one: turn round its
 * end through the region's triangles until a boundary edge leaves it. */
static void next_boundary_edge(const face_map *m, size_t *t, int *k)
{
    *k = (*k + 1) % 3;
    while (m->bound[3 * *t + (size_t)*k] == NONE) {
        uint32_t pivot = m->corner[3 * *t + (size_t)*k];
        *t = m->across[3 * *t + (size_t)*k];
        for (*k = 0; m->corner[3 * *t + (size_t)*k] != pivot; ++*k)
            continue;
    }
}

/* One walk along the boundary, not yet a simple ring. */
typedef struct walk {
    uint32_t *node;
    unsigned char *mark; /* of the edge that starts at the node */
    size_t n, cap, cap_mark;
} walk;

static bool walk_add(walk *w, uint32_t node, unsigned char mark)
{
    if (!il_grow(&w->node, &w->cap, w->n + 1, sizeof *w->node) || !il_grow(&w->mark, &w->cap_mark, w->n + 1, 1))
        return false;
    w->node[w->n] = node;
    w->mark[w->n++] = mark;
    return true;
}

static bool emit_ring(const face_map *m, const walk *w, size_t from, il_slice *out)
{
    il_ring *r = il_slice_add_ring(out);
    bool ok = r != NULL;
    for (size_t i = from; ok && i < w->n; i++)
        ok = il_ring_add(r, m->xy[2 * w->node[i]], m->xy[2 * w->node[i] + 1],
                         (unsigned char)((m->mark[w->node[i]] & IL_VERTEX_INSERTED) | w->mark[i]));
    return ok;
}

/* Walk from boundary edge K of triangle T.  Whenever the walk comes back to a
 * node that is on it, what lies between is a ring of its own: so every ring is
 * simple, and where the region touches itself rings touch. */
static bool trace(face_map *m, size_t t, int k, walk *w, uint32_t *position, il_slice *out)
{
    bool ok = true;
    w->n = 0;
    while (ok && !(m->done[t] >> k & 1)) {
        m->done[t] |= (unsigned char)(1 << k);
        uint32_t node = m->corner[3 * t + (size_t)k];
        if (position[node] != NONE) {
            size_t from = position[node];
            ok = emit_ring(m, w, from, out);
            for (size_t i = from; i < w->n; i++)
                position[w->node[i]] = NONE;
            w->n = from;
        }
        position[node] = (uint32_t)w->n;
        ok = ok && walk_add(w, node, m->edge_mark[m->bound[3 * t + (size_t)k]]);
        next_boundary_edge(m, &t, &k);
    }
    ok = ok && emit_ring(m, w, 0, out);
    for (size_t i = 0; i < w->n; i++)
        position[w->node[i]] = NONE;
    return ok;
}

static il_status trace_all(face_map *m, il_slice *out, il_error *err)
{
    walk w = { 0 };
    uint32_t *position = il_alloc(m->n_nodes, sizeof *position);
    bool ok = position != NULL;
    if (ok)
        memset(position, 0xFF, m->n_nodes * sizeof *position);
    for (size_t t = 0; ok && t < m->n_triangles; t++)
        for (int k = 0; ok && k < 3; k++)
            if (m->inside[t] && !(m->done[t] >> k & 1) && m->bound[3 * t + (size_t)k] != NONE)
                ok = trace(m, t, k, &w, position, out);
    il_free(position);
    il_free(w.node);
    il_free(w.mark);
    return ok ? IL_OK : il_fail_nomem(err);
}

static il_status count_pinches(const face_map *m, size_t *pinches, il_error *err)
{
    unsigned char *degree = il_calloc(m->n_nodes, 1);
    if (!degree)
        return il_fail_nomem(err);
    for (size_t i = 0; i < 2 * m->n_edges; i++)
        if (degree[m->edge[i]] < 4 && ++degree[m->edge[i]] == 3)
            ++*pinches;
    il_free(degree);
    return IL_OK;
}

il_status il_boundary_extract(const il_arrangement *a, il_slice *out,
                              size_t *cancelled, size_t *pinches, il_error *err)
{
    face_map m = { 0 };
    il_triangulation *t = NULL;
    il_status st = take_odd_edges(&m, a, cancelled, err);
    *pinches = 0;
    if (st == IL_OK && m.n_edges > 0) {
        st = count_pinches(&m, pinches, err);
        if (st == IL_OK)
            st = il_triangulation_new(&t, m.xy, m.n_nodes, m.edge, m.n_edges, err);
        if (st == IL_OK)
            st = il_triangulation_export(t, &m.corner, &m.across, &m.n_triangles, err);
        if (st == IL_OK)
            st = find_inside(&m, err);
        if (st == IL_OK)
            st = trace_all(&m, out, err);
        if (st == IL_OK)
            il_slice_put_in_order(out);
    }
    il_triangulation_free(t);
    face_map_free(&m);
    return st;
}
