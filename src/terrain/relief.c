/* relief.c - the stage of relief.h: a map's lines in, its certified mesh out. */
#include "config.h"
#include "terrain/relief.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "terrain/ground.h"
#include "terrain/map-edge.h"

#include <math.h>

/* slice[n]: the levels of the terrain at hand; the head's placement is chosen on the way. */
typedef struct relief {
    il_sink sink;
    il_relief_options options;
    il_mesh_sink *next;
    il_sink *solids;
    il_report *report;
    bool is_terrain;
    il_stack_head head;
    il_slice *slice;         size_t n, cap;
    int32_t stack;
} relief;

/* ---- handing on --------------------------------------------------------------------- */

/* Six times the volume of the tetrahedron from the first vertex, so that coordinates far from
 * the origin cost no digits, to triangle T; *AREA grows by the triangle's. */
static double corner6(const il_skin *s, size_t t, double *area)
{
    const double *p = s->xyz + 3 * (size_t)s->tri[3 * t], *q = s->xyz + 3 * (size_t)s->tri[3 * t + 1];
    const double *r = s->xyz + 3 * (size_t)s->tri[3 * t + 2], *o = s->xyz;
    double a[3], b[3], d[3];
    for (int i = 0; i < 3; i++)
        a[i] = q[i] - p[i], b[i] = r[i] - p[i], d[i] = p[i] - o[i];
    double n[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
    *area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    return n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
}

/* Pieces of the surface hang together over edges; solids are closed (Euler). */
static il_status gather_facts(const il_ground *g, il_mesh_facts *f, il_error *err)
{
    const il_skin *s = &g->skin;
    double volume6 = 0;
    uint32_t *up = il_alloc(s->n_vertices, sizeof *up);
    if (!up)
        return il_fail_nomem(err);
    il_forest_plant(up, s->n_vertices);
    for (size_t t = 0; t < s->n_triangles; t++) {
        il_forest_join(up, s->tri[3 * t], s->tri[3 * t + 1]);
        il_forest_join(up, s->tri[3 * t], s->tri[3 * t + 2]);
        volume6 += corner6(s, t, &f->area);
    }
    for (size_t v = 0; v < s->n_vertices; v++)
        f->components += up[v] == v;
    il_free(up);
    f->vertices = s->n_vertices;
    f->triangles = s->n_triangles;
    f->is_open = isnan(g->floor);
    f->step = g->law.smooth.z ? g->law.smooth.field.step : 0;
    f->spread = g->law.smooth.z ? g->law.smooth.spread : 0;
    f->faces = g->tin.n_faces;
    f->slices = g->n_slices;
    f->rings = g->n_lines;
    f->pinches = s->n_pinches;
    for (size_t k = 0; k < g->n_slices; k++)
        f->points += il_slice_points(&g->slice[k]);
    if (!f->is_open) {
        f->volume = volume6 / 6;
        f->genus = (2 * f->components - ((long)s->n_vertices - (long)(s->n_triangles / 2))) / 2;
    }
    return IL_OK;
}

static il_origin origin_of(const relief *r, const il_ground *g, size_t v)
{
    const il_chart_node *n = &g->chart.node[g->skin.node[v]];
    int32_t level = g->skin.level[v];
    if (n->vertex < 0 || level != n->slice)
        return (il_origin){ r->stack, level, -1, -1 };
    return (il_origin){ r->stack, n->slice, n->ring, n->vertex };
}

/* order[n_triangles]: by slab, else as they are; first[slab + 1]: where each begins. */
static bool sort_slabs(const il_skin *s, size_t n_slices, uint32_t *order, size_t *first)
{
    if (!order || !first)
        return false;
    for (size_t t = 0; t < s->n_triangles; t++)
        first[s->slab[t] + 2]++;
    for (size_t k = 1; k < n_slices + 3; k++)
        first[k] += first[k - 1];
    for (size_t t = 0; t < s->n_triangles; t++)
        order[first[s->slab[t] + 1]++] = (uint32_t)t;
    for (size_t k = n_slices + 2; k > 0; k--)
        first[k] = first[k - 1];
    first[0] = 0;
    return true;
}

static il_status give_slabs(relief *r, const il_ground *g, const uint32_t *order, const size_t *first, il_error *err)
{
    const il_skin *s = &g->skin;
    il_mesh m = IL_MESH_INIT;
    il_status st = IL_OK;
    bool ok = true;
    for (size_t v = 0; v < s->n_vertices && ok; v++)
        ok = il_mesh_add_vertex(&m, s->xyz + 3 * v, origin_of(r, g, v));
    for (size_t k = 0; k < g->n_slices + 1 && st == IL_OK && ok; k++) {
        m.slab = (int32_t)k - 1;
        for (size_t i = first[k]; i < first[k + 1] && ok; i++) {
            const uint32_t *v = s->tri + 3 * (size_t)order[i];
            ok = il_mesh_add_triangle(&m, v[0], v[1], v[2]);
        }
        if (ok && (m.n_vertices > 0 || m.n_triangles > 0))
            st = r->next->piece(r->next, &m, err);
        m.n_vertices = m.n_triangles = 0;
    }
    il_mesh_free(&m);
    return ok ? st : il_fail_nomem(err);
}

/* All vertices, then the triangles slab by slab. */
static il_status hand_on(relief *r, const il_ground *g, il_error *err)
{
    il_mesh_facts facts = { 0 };
    uint32_t *order = il_alloc(g->skin.n_triangles, sizeof *order);
    size_t *first = il_calloc(g->n_slices + 3, sizeof *first);
    il_status st = sort_slabs(&g->skin, g->n_slices, order, first) ? gather_facts(g, &facts, err) : il_fail_nomem(err);
    if (st == IL_OK)
        st = r->next->begin(r->next, &r->head, err);
    bool open = st == IL_OK;
    if (st == IL_OK)
        st = give_slabs(r, g, order, first, err);
    il_free(order);
    il_free(first);
    if (open && st != IL_OK)
        r->next->abandon(r->next);
    return st == IL_OK ? r->next->end(r->next, &facts, err) : st;
}

static il_status mark_map_edges(relief *r, il_error *err)
{
    size_t n = 0;
    il_status st = il_map_edge_mark(r->slice, r->n, &r->options.frame, &r->head, &n, err);
    if (n > 0)
        il_report_note(r->report, "lines are closed along the edge of the map: %zu of their edges are no isolines", n);
    return st;
}

static il_status build(relief *r, il_error *err)
{
    il_ground g = { .options = &r->options, .head = &r->head, .slice = r->slice, .n_slices = r->n, .report = r->report };
    il_status st = mark_map_edges(r, err);
    if (st == IL_OK)
        st = il_ground_make(&g, err);
    if (st == IL_OK)
        st = hand_on(r, &g, err);
    il_ground_free(&g);
    return st;
}

/* ---- the sink -------------------------------------------------------------------------- */

static void forget_slices(relief *r)
{
    for (size_t k = 0; k < r->n; k++)
        il_slice_free(&r->slice[k]);
    r->n = 0;
}

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    relief *r = (relief *)self;
    forget_slices(r);
    r->is_terrain = head->kind == IL_KIND_TERRAIN;
    if (!r->is_terrain && !r->solids)
        return il_fail(err, IL_E_INPUT, head->line, "stack \"%.60s\" is no terrain", il_stack_head_name(head));
    r->stack++;
    if (!r->is_terrain)
        return r->solids->stack_begin(r->solids, head, err);
    il_stack_head_free(&r->head);
    il_status st = il_stack_head_refuse_fault(head, err);
    return st == IL_OK ? il_stack_head_copy(&r->head, head, err) : st;
}

static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    relief *r = (relief *)self;
    if (!r->is_terrain)
        return r->solids->slice(r->solids, s, err);
    if (!il_grow(&r->slice, &r->cap, r->n + 1, sizeof *r->slice))
        return il_fail_nomem(err);
    r->slice[r->n++] = *s;
    *s = (il_slice)IL_SLICE_INIT;
    return IL_OK;
}

/* Nothing that joins the levels of a map is needed here. */
static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    relief *r = (relief *)self;
    return r->is_terrain ? IL_OK : r->solids->pair(r->solids, p, err);
}

static il_status stack_end(il_sink *self, il_error *err)
{
    relief *r = (relief *)self;
    if (!r->is_terrain)
        return r->solids->stack_end(r->solids, err);
    il_status st = build(r, err);
    forget_slices(r);
    return st;
}

static il_status end(il_sink *self, il_error *err)
{
    relief *r = (relief *)self;
    return r->solids ? r->solids->end(r->solids, err) : r->next->finish(r->next, err);
}

il_status il_relief_new(il_sink **out, const il_relief_options *o, il_mesh_sink *next, il_sink *solids,
                        il_report *report, il_error *err)
{
    relief *r = il_calloc(1, sizeof *r);
    *out = r ? &r->sink : NULL;
    if (!r)
        return il_fail_nomem(err);
    *r = (relief){ .sink = { stack_begin, slice, pair, stack_end, end }, .options = *o, .next = next, .solids = solids,
                   .report = report, .stack = -1 };
    return IL_OK;
}

const int32_t *il_relief_stack(const il_sink *s)
{
    return &((const relief *)s)->stack;
}

void il_relief_free(il_sink *s)
{
    relief *r = (relief *)s;
    if (!r)
        return;
    forget_slices(r);
    il_free(r->slice);
    il_stack_head_free(&r->head);
    il_free(r);
}
