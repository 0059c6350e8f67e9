#include "config.h"
#include "terrain/proof.h"
#include "base/alloc.h"
#include "base/number.h"
#include "bridge/predicates.h"
#include "terrain/links.h"

#include <math.h>

typedef struct proof {
    const il_skin *s;
    const il_tin *t;
    const il_chart *c;
    const il_stack_head *head;
    const il_placement_options *o;
    double floor;
    il_error *err;
} proof;

static il_status refute(const proof *p, size_t vertex, const char *what)
{
    char text[3][IL_NUMBER_MAX];
    for (int k = 0; k < 3; k++)
        il_number_format(text[k], p->s->xyz[3 * vertex + (size_t)k]);
    return il_fail(p->err, IL_E_SURFACE, p->head->line, "stack \"%.60s\": no sound surface near (%s, %s, %s): %s%s",
                   il_stack_head_name(p->head), text[0], text[1], text[2], what,
                   p->o->round_float ? " (in the 32-bit numbers of STL; PLY and OBJ hold finer ones)" : "");
}

/* ---- plan --------------------------------------------------------------------- */

static int turn(const proof *p, size_t triangle)
{
    const uint32_t *v = p->s->tri + 3 * triangle;
    return il_orientation(p->s->xyz + 3 * (size_t)v[0], p->s->xyz + 3 * (size_t)v[1], p->s->xyz + 3 * (size_t)v[2]);
}

static il_status prove_plan(const proof *p)
{
    const il_skin *s = p->s;
    size_t floor = s->n_surface + s->n_cliff + s->n_wall;
    for (size_t k = 0; k < s->n_surface; k++)
        if (turn(p, k) <= 0)
            return refute(p, s->tri[3 * k], "a triangle is turned over in plan");
    for (size_t k = floor; k < s->n_triangles; k++)
        if (turn(p, k) >= 0)
            return refute(p, s->tri[3 * k], "a triangle of the floor is turned over");
    for (size_t v = 0; v < s->n_vertices; v++)
        if (!isfinite(s->xyz[3 * v + 2]))
            return refute(p, v, "a point has no height");
    return IL_OK;
}

static double height(const proof *p, uint32_t vertex)
{
    return p->s->xyz[3 * (size_t)vertex + 2];
}

/* Cliffs and walls stand upright; the floor is flat, and all ground lies above it. */
static il_status prove_walls(const proof *p)
{
    const il_skin *s = p->s;
    size_t wall = s->n_surface + s->n_cliff, floor = wall + s->n_wall;
    for (size_t k = s->n_surface; k < floor; k++)
        if (turn(p, k) != 0)
            return refute(p, s->tri[3 * k], "a wall does not stand upright");
    if (isnan(p->floor))
        return s->n_triangles > wall ? refute(p, 0, "there are walls without a floor") : IL_OK;
    for (size_t k = 0; k < 3 * wall; k++)
        if (!(height(p, s->tri[k]) > p->floor))
            return refute(p, s->tri[k], "the ground does not lie above the floor");
    for (size_t k = 3 * floor; k < 3 * s->n_triangles; k++)
        if (height(p, s->tri[k]) != p->floor)
            return refute(p, s->tri[k], "the floor is not flat");
    return IL_OK;
}

/* ---- half-edges ------------------------------------------------------------------ */

/* How often the edge from A to B occurs, and its reverse. */
static void count(const il_links *l, uint32_t a, uint32_t b, size_t n[2])
{
    il_links_range r = il_links_find(l, a, b);
    n[0] = n[1] = 0;
    for (uint32_t i = r.begin; i < r.end; i++)
        n[il_links_from(l, l->of[i]) == a ? 0 : 1]++;
}

/* How many edges of the frame the open surface must end in: those of the chart with the map on
 * one side only.  Where a cliff meets the frame there are upright ones as well. */
static size_t count_rim(const proof *p)
{
    size_t n = 0;
    for (size_t e = 0; e < p->c->n_edges; e++) {
        bool left = p->t->side[2 * e] != IL_CHART_NONE, right = p->t->side[2 * e + 1] != IL_CHART_NONE;
        n += il_chart_is_frame(p->c, e) && left != right;
    }
    return n;
}

static bool is_rim(const proof *p, size_t k)
{
    uint32_t a = p->s->node[p->s->tri[k]], b = p->s->node[p->s->tri[il_tin_after(k)]];
    return p->c->node[a].is_frame && p->c->node[b].is_frame;
}

static il_status prove_edges(const proof *p, const il_links *l)
{
    const il_skin *s = p->s;
    size_t n_open = 0;
    for (size_t k = 0; k < 3 * s->n_triangles; k++) {
        size_t n[2];
        count(l, s->tri[k], s->tri[il_tin_after(k)], n);
        if (n[0] != 1 || n[1] > 1)
            return refute(p, s->tri[k], "an edge belongs to several triangles on one side");
        if (n[1] == 1)
            continue;
        n_open += s->node[s->tri[k]] != s->node[s->tri[il_tin_after(k)]];
        if (!isnan(p->floor) || !is_rim(p, k))
            return refute(p, s->tri[k], "an edge lacks its other triangle");
    }
    return isnan(p->floor) && n_open != count_rim(p) ? refute(p, 0, "it does not end where the frame is") : IL_OK;
}

/* ---- what it must pass through ------------------------------------------------------ */

/* Every vertex is of some triangle, those of lines lie at their heights, and there is one for
 * each level at each node of a line inside the frame. */
static il_status prove_lines(const proof *p)
{
    const il_skin *s = p->s;
    il_status st = IL_OK;
    unsigned char *used = il_calloc(s->n_vertices, 1), *there = il_calloc(p->c->n_nodes, 1);
    if (!used || !there)
        st = il_fail_nomem(p->err);
    for (size_t k = 0; k < 3 * s->n_triangles && st == IL_OK; k++)
        used[s->tri[k]] = there[s->node[s->tri[k]]] = 1;
    for (size_t v = 0; v < s->n_vertices && st == IL_OK; v++) {
        if (!used[v])
            st = refute(p, v, "lines run together here, but the ground does not reach all of them");
        else if (s->level[v] >= 0 && height(p, (uint32_t)v) != il_placement_height(p->head, p->o, p->c->level_z[s->level[v]]))
            st = refute(p, v, "a point of a line does not lie at its height");
    }
    for (size_t e = 0; e < p->c->n_edges && st == IL_OK; e++) {
        bool inside = p->t->side[2 * e] != IL_CHART_NONE || p->t->side[2 * e + 1] != IL_CHART_NONE;
        if (inside && !(there[p->c->edge[2 * e]] && there[p->c->edge[2 * e + 1]]))
            st = refute(p, 0, "a point of a line is missing");
    }
    il_free(used);
    il_free(there);
    return st;
}

il_status il_skin_prove(const il_skin *s, const il_tin *t, const il_chart *c, const il_stack_head *head,
                        const il_placement_options *o, double floor, il_error *err)
{
    proof p = { s, t, c, head, o, floor, err };
    il_links l = IL_LINKS_INIT;
    il_status st = prove_plan(&p);
    if (st == IL_OK)
        st = prove_walls(&p);
    if (st == IL_OK && !il_links_build(&l, s->tri, 3 * s->n_triangles, true, s->n_vertices))
        st = il_fail_nomem(err);
    if (st == IL_OK)
        st = prove_edges(&p, &l);
    il_links_free(&l);
    return st == IL_OK ? prove_lines(&p) : st;
}
