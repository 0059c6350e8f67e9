#include "config.h"
#include "terrain/skin.h"
#include "base/alloc.h"

#include <math.h>

void il_skin_free(il_skin *s)
{
    il_free(s->xyz);
    il_free(s->node);
    il_free(s->level);
    il_free(s->tri);
    il_free(s->slab);
    *s = (il_skin)IL_SKIN_INIT;
}

static uint32_t add_vertex(il_skin *s, const il_chart *c, uint32_t node, int32_t level, double z)
{
    if (!il_grow(&s->xyz, &s->cap_vertices, s->n_vertices + 1, 3 * sizeof *s->xyz) ||
        !il_grow(&s->node, &s->cap_nodes, s->n_vertices + 1, sizeof *s->node) ||
        !il_grow(&s->level, &s->cap_levels, s->n_vertices + 1, sizeof *s->level))
        return IL_CHART_NONE;
    double *p = s->xyz + 3 * s->n_vertices;
    p[0] = c->xy[2 * (size_t)node];
    p[1] = c->xy[2 * (size_t)node + 1];
    p[2] = z;
    s->level[s->n_vertices] = level;
    s->node[s->n_vertices] = node;
    return (uint32_t)s->n_vertices++;
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

/* ---- fans ------------------------------------------------------------------------ */

/* Is edge K of triangles one of the surface's, with nothing beyond? */
static bool is_rim(const il_tin *t, size_t k)
{
    return t->face[k / 3] != IL_CHART_NONE && (t->across[k] == IL_CHART_NONE || t->face[t->across[k]] == IL_CHART_NONE);
}

/* The next corner around the same node, counter-clockwise, from the one at edge K's beginning;
 * SIZE_MAX beyond the surface. */
static size_t next_around(const il_tin *t, size_t k)
{
    size_t before = il_tin_after(il_tin_after(k));
    uint32_t triangle = t->across[before];
    return triangle == IL_CHART_NONE || t->face[triangle] == IL_CHART_NONE ? SIZE_MAX : il_tin_twin(t, before);
}

/* Where the frame touches itself, the triangles around a node are several fans, each of which
 * has vertices of its own.  fan[3*t->n]: which, from 0; count[node]: how many begin at the rim. */
static void find_fans(const il_tin *t, uint32_t *fan, uint32_t *count)
{
    for (size_t k = 0; k < 3 * t->n; k++) {
        if (!is_rim(t, k))
            continue;
        uint32_t number = count[t->corner[k]]++;
        for (size_t j = k; j != SIZE_MAX && number > 0; j = next_around(t, j))
            fan[j] = number;
    }
}

/* first[node]: its lowest vertex, those of higher levels following it, and then those of its
 * other fans; IL_CHART_NONE where the node is outside. */
typedef struct laying {
    il_skin *s;
    const il_tin *t;
    const il_chart *c;
    const il_band *band;
    const il_stack_head *head;
    const il_placement_options *o;
    uint32_t *first, *fan, *count;
} laying;

/* ---- the surface ---------------------------------------------------------------- */

static bool lay_fan(laying *l, uint32_t node)
{
    const il_chart_node *n = &l->c->node[node];
    for (int32_t level = n->level; level <= n->top; level++) {
        double z = level < 0 ? n->z : l->c->level_z[level];
        if (add_vertex(l->s, l->c, node, level, il_placement_height(l->head, l->o, z)) == IL_CHART_NONE)
            return false;
    }
    return true;
}

/* Vertices in the order of their nodes, so that those of the lines come first; a vertex for
 * each level where lines run together. */
static bool lay_vertices(laying *l)
{
    const il_chart *c = l->c;
    for (size_t v = 0; v < c->n_nodes; v++)
        l->first[v] = IL_CHART_NONE;
    for (size_t k = 0; k < 3 * l->t->n; k++)
        if (l->t->face[k / 3] != IL_CHART_NONE)
            l->first[l->t->corner[k]] = 0;
    for (size_t v = 0; v < c->n_nodes; v++) {
        if (l->first[v] == IL_CHART_NONE)
            continue;
        l->first[v] = (uint32_t)l->s->n_vertices;
        uint32_t fans = l->count[v] > 1 ? l->count[v] : 1;
        for (uint32_t fan = 0; fan < fans; fan++)
            if (!lay_fan(l, (uint32_t)v))
                return false;
        l->s->n_pinches += fans - 1;
    }
    return true;
}

static uint32_t vertex_of(const laying *l, size_t k)
{
    const il_chart_node *n = &l->c->node[l->t->corner[k]];
    uint32_t v = l->first[l->t->corner[k]] + l->fan[k] * (uint32_t)(n->top - n->level + 1);
    return n->level == n->top ? v : v + (uint32_t)(il_cliff_level(n, l->band[l->t->face[k / 3]]) - n->level);
}

static bool lay_surface(laying *l)
{
    for (size_t k = 0; k < l->t->n; k++)
        if (l->t->face[k] != IL_CHART_NONE &&
            !add_triangle(l->s, vertex_of(l, 3 * k), vertex_of(l, 3 * k + 1), vertex_of(l, 3 * k + 2), l->band[l->t->face[k]].low))
            return false;
    l->s->n_surface = l->s->n_triangles;
    return true;
}

/* An upright piece whose outline runs from B0 to A0, up or down A's vertices to A1, over to B1,
 * and back along B's: vertices that stand on each other have numbers that follow each other. */
static bool stand(il_skin *s, uint32_t a0, uint32_t a1, uint32_t b0, uint32_t b1, int32_t slab)
{
    bool ok = true;
    while (ok && (a0 != a1 || b0 != b1)) {
        bool by_a = a0 != a1;
        uint32_t next = by_a ? (a0 < a1 ? a0 + 1 : a0 - 1) : b0 < b1 ? b0 + 1 : b0 - 1;
        ok = add_triangle(s, b0, a0, next, slab);
        if (by_a)
            a0 = next;
        else
            b0 = next;
    }
    return ok;
}

/* Where triangles on both sides of an edge end at different levels. */
static il_status lay_cliffs(laying *l, il_error *err)
{
    const il_tin *t = l->t;
    for (size_t k = 0; k < 3 * t->n; k++) {
        uint32_t next = t->across[k];
        if (next == IL_CHART_NONE || next < k / 3 || t->face[k / 3] == IL_CHART_NONE || t->face[next] == IL_CHART_NONE)
            continue;
        const il_chart_node *a = &l->c->node[t->corner[k]], *b = &l->c->node[t->corner[il_tin_after(k)]];
        if (a->level == a->top && b->level == b->top)
            continue;
        size_t j = il_tin_twin(t, k);
        uint32_t a0 = vertex_of(l, k), a1 = vertex_of(l, il_tin_after(j)), b0 = vertex_of(l, il_tin_after(k)), b1 = vertex_of(l, j);
        if ((a1 > a0 && b1 < b0) || (a1 < a0 && b1 > b0))
            return il_fail(err, IL_E_SURFACE, l->head->line, "stack \"%.60s\": isolines run together so that the ground would cross itself",
                           il_stack_head_name(l->head));
        if (!stand(l->s, a0, a1, b0, b1, a->level < a->top ? a->level : b->level))
            return il_fail_nomem(err);
    }
    l->s->n_cliff = l->s->n_triangles - l->s->n_surface;
    return IL_OK;
}

il_status il_skin_lay(il_skin *s, const il_tin *t, const il_chart *c, const il_band *band,
                      const il_stack_head *head, const il_placement_options *o, il_error *err)
{
    laying l = { s, t, c, band, head, o, il_alloc(c->n_nodes, sizeof *l.first), il_calloc(3 * t->n, sizeof *l.fan),
                 il_calloc(c->n_nodes, sizeof *l.count) };
    bool ok = l.first && l.fan && l.count;
    if (ok)
        find_fans(t, l.fan, l.count);
    il_status st = ok && lay_vertices(&l) && lay_surface(&l) ? lay_cliffs(&l, err) : il_fail_nomem(err);
    il_free(l.first);
    il_free(l.fan);
    il_free(l.count);
    return st;
}

/* ---- walls and floor -------------------------------------------------------------- */

/* bottom[v]: the floor's vertex under vertex V of the surface, the lowest there;
 * IL_CHART_NONE off the frame.  vertex[k]: of the surface at corner K of triangles.  rim: of
 * the chart's nodes, to a half-edge K that nothing lies beyond. */
typedef struct closing {
    il_skin *s;
    const il_tin *t;
    const il_chart *c;
    uint32_t *bottom, *vertex;
    il_keymap rim;
    double floor;
} closing;

/* The lowest of the vertices that stand where V does, in the surface. */
static uint32_t foot_of(const il_skin *s, uint32_t v)
{
    while (v > 0 && s->node[v - 1] == s->node[v] && s->level[v - 1] < s->level[v])
        v--;
    return v;
}

/* The surface has the triangles inside the frame, in the same order. */
static bool find_rim(closing *w)
{
    size_t t = 0;
    for (size_t k = 0; k < 3 * w->t->n; k++) {
        if (w->t->face[k / 3] == IL_CHART_NONE)
            continue;
        w->vertex[k] = w->s->tri[3 * t + k % 3];
        if (is_rim(w->t, k) && !il_keymap_put(&w->rim, IL_KEYMAP_EDGE(w->t->corner[k], w->t->corner[il_tin_after(k)]), (uint32_t)k))
            return false;
        t += k % 3 == 2;
    }
    return true;
}

static bool add_bottoms(closing *w)
{
    for (size_t v = 0; v < w->s->n_vertices; v++)
        w->bottom[v] = IL_CHART_NONE;
    for (size_t k = 0; k < 3 * w->t->n; k++) {
        if (!is_rim(w->t, k))
            continue;
        uint32_t v = add_vertex(w->s, w->c, w->t->corner[k], -1, w->floor);
        if (v == IL_CHART_NONE)
            return false;
        w->bottom[foot_of(w->s, w->vertex[k])] = v;
    }
    return true;
}

/* Under the surface's edge from A to B; seen from outside, a stands left of b. */
static bool add_wall(closing *w, uint32_t a, uint32_t b)
{
    il_skin *s = w->s;
    uint32_t foot_a = foot_of(s, a), foot_b = foot_of(s, b), a0 = w->bottom[foot_a], b0 = w->bottom[foot_b];
    return add_triangle(s, a0, b0, foot_b, -1) && add_triangle(s, a0, foot_b, foot_a, -1) && stand(s, foot_b, b, foot_a, a, -1);
}

static bool add_walls(closing *w)
{
    for (size_t k = 0; k < 3 * w->t->n; k++)
        if (is_rim(w->t, k) && !add_wall(w, w->vertex[k], w->vertex[il_tin_after(k)]))
            return false;
    w->s->n_wall = w->s->n_triangles - w->s->n_surface - w->s->n_cliff;
    return true;
}

/* The rim alone as a chart: its own triangulation has few triangles.  to[n]: its nodes in
 * the whole. */
static bool draw_rim(closing *w, il_chart *rim, uint32_t *to)
{
    for (size_t k = 0; k < 3 * w->t->n; k++) {
        const uint32_t end[2] = { w->t->corner[k], w->t->corner[il_tin_after(k)] };
        uint32_t node[2];
        if (!is_rim(w->t, k))
            continue;
        for (int i = 0; i < 2; i++) {
            node[i] = il_chart_node_at(rim, w->c->xy[2 * (size_t)end[i]], w->c->xy[2 * (size_t)end[i] + 1]);
            if (node[i] == IL_CHART_NONE)
                return false;
            to[node[i]] = end[i];
        }
        if (!il_chart_add_edge(rim, node[0], node[1], IL_CHART_NONE, -1))
            return false;
    }
    return true;
}

/* corner[3*t->n]: of the triangles of the rim's T, in the skin.  Fan by fan, each of which begins
 * at the same edge as one of the surface's. */
static void find_corners(const closing *w, const il_tin *t, const uint32_t *to, uint32_t *corner)
{
    for (size_t k = 0; k < 3 * t->n; k++) {
        if (!is_rim(t, k))
            continue;
        uint32_t rim = il_keymap_get(&w->rim, IL_KEYMAP_EDGE(to[t->corner[k]], to[t->corner[il_tin_after(k)]]), 0);
        for (size_t j = k; j != SIZE_MAX; j = next_around(t, j))
            corner[j] = w->bottom[foot_of(w->s, w->vertex[rim])];
    }
}

static bool lay_floor(closing *w, const il_tin *t, const uint32_t *to)
{
    uint32_t *corner = il_alloc(3 * t->n, sizeof *corner);
    bool ok = corner != NULL;
    if (ok)
        find_corners(w, t, to, corner);
    for (size_t k = 0; k < t->n && ok; k++)
        ok = t->face[k] == IL_CHART_NONE || add_triangle(w->s, corner[3 * k], corner[3 * k + 2], corner[3 * k + 1], -1);
    il_free(corner);
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
    if (st == IL_OK && !lay_floor(w, &t, to))
        st = il_fail_nomem(err);
    il_free(to);
    il_tin_free(&t);
    il_chart_free(&rim);
    return st;
}

il_status il_skin_close(il_skin *s, const il_tin *t, const il_chart *c, double floor, il_error *err)
{
    closing w = { s, t, c, il_alloc(s->n_vertices, sizeof *w.bottom), il_alloc(3 * t->n, sizeof *w.vertex), IL_KEYMAP_INIT, floor };
    il_status st = w.bottom && w.vertex && find_rim(&w) && add_bottoms(&w) && add_walls(&w) ? add_floor(&w, err) : il_fail_nomem(err);
    il_free(w.bottom);
    il_free(w.vertex);
    il_keymap_free(&w.rim);
    return st;
}
