#include "config.h"
#include "terrain/crossing.h"
#include "base/alloc.h"
#include "model/arrange.h"

/* owner[v]: the line that gave node V its level, or IL_CHART_NONE. */
typedef struct division {
    il_chart *c;
    const il_chart_line *line;
    size_t n_lines;
    uint32_t *owner;
    il_clashes *clashes;
} division;

/* The grid of new nodes, by the extent of all. */
static double cell_of(const il_chart *c, bool round_float)
{
    il_ring all = { .xy = c->xy, .n = c->n_nodes };
    il_slice whole = { .ring = &all, .n = 1 };
    return il_slice_cell(&whole, round_float);
}

static bool to_arrangement(il_arrangement *a, const il_chart *c)
{
    for (size_t v = 0; v < c->n_nodes; v++)
        if (il_arrangement_node(a, c->xy[2 * v], c->xy[2 * v + 1], 0) == UINT32_MAX)
            return false;
    for (size_t e = 0; e < c->n_edges; e++)
        if (!il_arrangement_edge(a, c->edge[2 * e], c->edge[2 * e + 1], c->owner[e], 0))
            return false;
    return true;
}

/* Nodes keep their numbers, and new ones follow. */
static bool from_arrangement(il_chart *c, const il_arrangement *a)
{
    for (size_t v = c->n_nodes; v < a->n_nodes; v++)
        if (il_chart_node_at(c, a->xy[2 * v], a->xy[2 * v + 1]) != v)
            return false;
    c->n_edges = 0;
    for (size_t e = 0; e < a->n_edges; e++)
        if (!il_chart_add_edge(c, a->edge[2 * e], a->edge[2 * e + 1], a->owner[e]))
            return false;
    return true;
}

static int32_t level_of(const division *d, uint32_t owner)
{
    return owner < d->n_lines ? d->line[owner].level : (int32_t)(owner - d->n_lines);
}

/* A line of OWNER passes through node V. */
static bool meet(division *d, uint32_t v, uint32_t owner)
{
    il_chart_node *n = &d->c->node[v];
    if (d->owner[v] == IL_CHART_NONE) {
        d->owner[v] = owner;
        n->level = level_of(d, owner);
        n->z = d->c->level_z[n->level];
        n->slice = n->slice < 0 ? n->level : n->slice;
        return true;
    }
    if (n->level == level_of(d, owner))
        return true;
    il_clashes *k = d->clashes;
    if (!il_grow(&k->clash, &k->cap, k->n + 1, sizeof *k->clash))
        return false;
    k->clash[k->n++] = (il_clash){ { d->owner[v], owner }, { d->c->xy[2 * (size_t)v], d->c->xy[2 * (size_t)v + 1] } };
    return true;
}

static bool find_levels(division *d)
{
    il_chart *c = d->c;
    d->owner = il_alloc(c->n_nodes, sizeof *d->owner);
    if (!d->owner)
        return false;
    for (size_t v = 0; v < c->n_nodes; v++)
        d->owner[v] = IL_CHART_NONE;
    for (size_t k = 0; k < 2 * c->n_edges; k++) {
        if (c->owner[k / 2] == IL_CHART_NONE)
            c->node[c->edge[k]].is_frame = true;
        else if (!meet(d, c->edge[k], c->owner[k / 2]))
            return false;
    }
    return true;
}

il_status il_chart_divide(il_chart *c, const il_chart_line *line, size_t n_lines, bool round_float,
                          il_clashes *clashes, il_error *err)
{
    il_arrangement a = IL_ARRANGEMENT_INIT;
    division d = { .c = c, .line = line, .n_lines = n_lines, .clashes = clashes };
    size_t crossings = 0, touches = 0;
    a.cell = cell_of(c, round_float);
    il_status st = to_arrangement(&a, c) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_arrangement_settle(&a, &crossings, &touches, err);
    if (st == IL_OK && !(from_arrangement(c, &a) && find_levels(&d)))
        st = il_fail_nomem(err);
    il_arrangement_free(&a);
    il_free(d.owner);
    return st;
}
