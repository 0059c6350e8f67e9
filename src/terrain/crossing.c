#include "config.h"
#include "terrain/crossing.h"
#include "base/alloc.h"
#include "model/arrange.h"

/* The grid of new nodes, by the extent of all. */
static double cell_of(const il_chart *c, bool round_float)
{
    il_ring all = { .xy = c->xy, .n = c->n_nodes };
    il_slice whole = { .ring = &all, .n = 1 };
    return il_slice_cell(&whole, round_float);
}

/* Nodes that no edge ends in, which an edge may pass through all the same: as edges from
 * themselves to themselves, with a number that is no edge's. */
static bool add_lone_nodes(il_arrangement *a, const il_chart *c)
{
    unsigned char *on_edge = il_calloc(c->n_nodes, 1);
    bool ok = on_edge != NULL;
    for (size_t k = 0; k < 2 * c->n_edges && ok; k++)
        on_edge[c->edge[k]] = 1;
    for (size_t v = 0; v < c->n_nodes && ok; v++)
        ok = on_edge[v] || il_arrangement_edge(a, (uint32_t)v, (uint32_t)v, (uint32_t)c->n_edges, 0);
    il_free(on_edge);
    return ok;
}

/* Edges are told apart by their number, and keep their owner and level through it. */
static bool to_arrangement(il_arrangement *a, const il_chart *c)
{
    for (size_t v = 0; v < c->n_nodes; v++)
        if (il_arrangement_node(a, c->xy[2 * v], c->xy[2 * v + 1], 0) == UINT32_MAX)
            return false;
    for (size_t e = 0; e < c->n_edges; e++)
        if (!il_arrangement_edge(a, c->edge[2 * e], c->edge[2 * e + 1], (uint32_t)e, 0))
            return false;
    return add_lone_nodes(a, c);
}

/* Nodes keep their numbers, and new ones follow. */
static bool from_arrangement(il_chart *c, const il_arrangement *a)
{
    il_chart old = { .owner = c->owner, .height = c->height, .n_edges = c->n_edges };
    c->owner = NULL, c->height = NULL;
    c->n_edges = c->cap_owners = c->cap_heights = 0;
    bool ok = true;
    for (size_t v = c->n_nodes; v < a->n_nodes && ok; v++)
        ok = il_chart_node_at(c, a->xy[2 * v], a->xy[2 * v + 1]) == v;
    for (size_t e = 0; e < a->n_edges && ok; e++)
        ok = a->owner[e] >= old.n_edges ||
             il_chart_add_edge(c, a->edge[2 * e], a->edge[2 * e + 1], old.owner[a->owner[e]], old.height[a->owner[e]]);
    il_free(old.owner);
    il_free(old.height);
    return ok;
}

static void find_levels(il_chart *c)
{
    for (size_t k = 0; k < 2 * c->n_edges; k++) {
        if (c->height[k / 2] < 0)
            c->node[c->edge[k]].is_frame = true;
        else
            il_chart_put_on(c, c->edge[k], c->height[k / 2]);
    }
}

il_status il_chart_divide(il_chart *c, bool round_float, il_error *err)
{
    il_arrangement a = IL_ARRANGEMENT_INIT;
    size_t crossings = 0, touches = 0;
    a.cell = cell_of(c, round_float);
    il_status st = to_arrangement(&a, c) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_arrangement_settle(&a, &crossings, &touches, err);
    if (st == IL_OK && !(from_arrangement(c, &a) && il_chart_unfold_frame(c)))
        st = il_fail_nomem(err);
    if (st == IL_OK)
        find_levels(c);
    il_arrangement_free(&a);
    return st;
}
