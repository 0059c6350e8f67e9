#include "config.h"
#include "terrain/skin.h"
#include "base/alloc.h"

#include <math.h>

void il_skin_free(il_skin *s)
{
    il_free(s->xyz);
    il_free(s->node);
    il_free(s->tri);
    il_free(s->slab);
    *s = (il_skin)IL_SKIN_INIT;
}

static bool add_vertex(il_skin *s, const il_chart *c, uint32_t node, double z)
{
    if (!il_grow(&s->xyz, &s->cap_vertices, s->n_vertices + 1, 3 * sizeof *s->xyz) ||
        !il_grow(&s->node, &s->cap_nodes, s->n_vertices + 1, sizeof *s->node))
        return false;
    double *p = s->xyz + 3 * s->n_vertices;
    p[0] = c->xy[2 * (size_t)node];
    p[1] = c->xy[2 * (size_t)node + 1];
    p[2] = z;
    s->node[s->n_vertices++] = node;
    return true;
}

static bool add_triangle(il_skin *s, uint32_t a, uint32_t b, uint32_t c, int32_t slab)
{
    if (!il_grow(&s->tri, &s->cap_triangles, s->n_triangles + 1, 3 * sizeof *s->tri) ||
        !il_grow(&s->slab, &s->cap_slabs, s->n_triangles + 1, sizeof *s->slab))
        return false;
    uint32_t *t = s->tri + 3 * s->n_triangles;
    t[0] = a, t[1] = b, t[2] = c;
    s->slab[s->n_triangles++] = slab;
    return true;
}

/* ---- the surface ---------------------------------------------------------------- */

/* Vertices in the order of their nodes, so that those of the lines come first. */
static bool lay_vertices(il_skin *s, const il_tin *t, const il_chart *c, const il_stack_head *head,
                         const il_placement_options *o, uint32_t *vertex)
{
    for (size_t v = 0; v < c->n_nodes; v++)
        vertex[v] = IL_CHART_NONE;
    for (size_t k = 0; k < 3 * t->n; k++)
        if (t->face[k / 3] != IL_CHART_NONE)
            vertex[t->corner[k]] = 0;
    for (size_t v = 0; v < c->n_nodes; v++) {
        if (vertex[v] == IL_CHART_NONE)
            continue;
        vertex[v] = (uint32_t)s->n_vertices;
        if (!add_vertex(s, c, (uint32_t)v, il_placement_height(head, o, c->node[v].z)))
            return false;
    }
    return true;
}

il_status il_skin_lay(il_skin *s, const il_tin *t, const il_chart *c, const il_band *band,
                      const il_stack_head *head, const il_placement_options *o, il_error *err)
{
    uint32_t *vertex = il_alloc(c->n_nodes, sizeof *vertex);
    bool ok = vertex && lay_vertices(s, t, c, head, o, vertex);
    for (size_t k = 0; k < t->n && ok; k++) {
        const uint32_t *v = t->corner + 3 * k;
        if (t->face[k] != IL_CHART_NONE)
            ok = add_triangle(s, vertex[v[0]], vertex[v[1]], vertex[v[2]], band[t->face[k]].low);
    }
    il_free(vertex);
    s->n_surface = s->n_triangles;
    return ok ? IL_OK : il_fail_nomem(err);
}

/* ---- walls and floor -------------------------------------------------------------- */

/* Edges of the surface that nothing lies beyond, as pairs of its vertices, the map on the
 * left; top[node], bottom[node]: the vertices that stand there. */
typedef struct closing {
    il_skin *s;
    const il_tin *t;
    const il_chart *c;
    uint32_t *top, *bottom;
    double floor;
} closing;

static bool is_rim(const il_tin *t, size_t k)
{
    return t->face[k / 3] != IL_CHART_NONE && (t->across[k] == IL_CHART_NONE || t->face[t->across[k]] == IL_CHART_NONE);
}

static size_t after(size_t k)
{
    return k % 3 == 2 ? k - 2 : k + 1;
}

static bool add_bottoms(closing *w)
{
    for (size_t v = 0; v < w->c->n_nodes; v++)
        w->top[v] = w->bottom[v] = IL_CHART_NONE;
    for (size_t v = 0; v < w->s->n_vertices; v++)
        w->top[w->s->node[v]] = (uint32_t)v;
    for (size_t k = 0; k < 3 * w->t->n; k++) {
        uint32_t v = w->t->corner[k];
        if (!is_rim(w->t, k))
            continue;
        w->bottom[v] = (uint32_t)w->s->n_vertices;
        if (!add_vertex(w->s, w->c, v, w->floor))
            return false;
    }
    return true;
}

/* Seen from outside, a stands left of b. */
static bool add_walls(closing *w)
{
    for (size_t k = 0; k < 3 * w->t->n; k++) {
        if (!is_rim(w->t, k))
            continue;
        uint32_t a = w->t->corner[k], b = w->t->corner[after(k)];
        if (!add_triangle(w->s, w->bottom[a], w->bottom[b], w->top[b], -1) ||
            !add_triangle(w->s, w->bottom[a], w->top[b], w->top[a], -1))
            return false;
    }
    w->s->n_wall = w->s->n_triangles - w->s->n_surface;
    return true;
}

/* The rim alone as a chart: its own triangulation has few triangles.  to[n]: its nodes in
 * the whole. */
static bool draw_rim(closing *w, il_chart *rim, uint32_t *to)
{
    uint32_t *from = il_alloc(w->c->n_nodes, sizeof *from);
    bool ok = from;
    for (size_t v = 0; v < w->c->n_nodes && ok; v++) {
        if (w->bottom[v] == IL_CHART_NONE)
            continue;
        from[v] = il_chart_node_at(rim, w->c->xy[2 * v], w->c->xy[2 * v + 1]);
        ok = from[v] != IL_CHART_NONE;
        if (ok)
            to[from[v]] = (uint32_t)v;
    }
    for (size_t k = 0; k < 3 * w->t->n && ok; k++)
        if (is_rim(w->t, k))
            ok = il_chart_add_edge(rim, from[w->t->corner[k]], from[w->t->corner[after(k)]], IL_CHART_NONE);
    il_free(from);
    return ok;
}

static il_status add_floor(closing *w, il_error *err)
{
    il_chart rim = IL_CHART_INIT;
    il_tin t = IL_TIN_INIT;
    bool crosses = false;
    uint32_t *to = il_alloc(w->c->n_nodes, sizeof *to);
    il_status st = to && draw_rim(w, &rim, to) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_tin_build(&t, &rim, &crosses, err);
    if (st == IL_OK && crosses)
        st = il_fail(err, IL_E_INTERNAL, 0, "the frame of a triangulation crosses itself");
    for (size_t k = 0; k < t.n && st == IL_OK; k++) {
        const uint32_t *v = t.corner + 3 * k;
        if (t.face[k] != IL_CHART_NONE && !add_triangle(w->s, w->bottom[to[v[0]]], w->bottom[to[v[2]]], w->bottom[to[v[1]]], -1))
            st = il_fail_nomem(err);
    }
    il_free(to);
    il_tin_free(&t);
    il_chart_free(&rim);
    return st;
}

/* A node that two edges of the rim leave stands where the frame touches itself. */
static il_status check_rim(const closing *w, il_error *err)
{
    unsigned char *seen = il_calloc(w->c->n_nodes, 1);
    il_status st = seen ? IL_OK : il_fail_nomem(err);
    for (size_t k = 0; k < 3 * w->t->n && st == IL_OK; k++) {
        if (!is_rim(w->t, k))
            continue;
        if (seen[w->t->corner[k]]++)
            st = il_fail(err, IL_E_SURFACE, 0, "the frame touches itself, so that a solid on it would, too");
    }
    il_free(seen);
    return st;
}

il_status il_skin_close(il_skin *s, const il_tin *t, const il_chart *c, double floor, il_error *err)
{
    closing w = { s, t, c, il_alloc(c->n_nodes, sizeof *w.top), il_alloc(c->n_nodes, sizeof *w.bottom), floor };
    il_status st = w.top && w.bottom ? check_rim(&w, err) : il_fail_nomem(err);
    if (st == IL_OK && !(add_bottoms(&w) && add_walls(&w)))
        st = il_fail_nomem(err);
    if (st == IL_OK)
        st = add_floor(&w, err);
    il_free(w.top);
    il_free(w.bottom);
    return st;
}
