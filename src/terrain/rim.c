#include "config.h"
#include "terrain/rim.h"
#include "base/alloc.h"

#include <math.h>

/* next[node]: the one after it on the frame, IL_CHART_NONE off it and where the frame touches
 * itself: a way through such a node could go round without an end. */
static bool find_next(const il_chart *c, uint32_t *next)
{
    unsigned char *edges = il_calloc(c->n_nodes, 1);
    for (size_t v = 0; edges && next && v < c->n_nodes; v++)
        next[v] = IL_CHART_NONE;
    for (size_t k = 0; edges && next && k < 2 * c->n_edges; k++) {
        uint32_t v = c->edge[k];
        if (!il_chart_is_frame(c, k / 2))
            continue;
        edges[v] = edges[v] < 3 ? (unsigned char)(edges[v] + 1) : 3;
        if (k % 2 == 0)
            next[v] = c->edge[k + 1];
    }
    for (size_t v = 0; edges && next && v < c->n_nodes; v++)
        next[v] = edges[v] == 2 ? next[v] : IL_CHART_NONE;
    il_free(edges);
    return edges && next;
}

/* From node A, which has a height, to the next one that has. */
static void raise_from(il_chart *c, const uint32_t *next, uint32_t a)
{
    uint32_t b = a, before = a;
    double length = 0, at = 0;
    do {
        before = b;
        b = next[b];
        length += b == IL_CHART_NONE ? 0 : il_chart_distance(c, before, b);
    } while (b != IL_CHART_NONE && b != a && isnan(c->node[b].z));
    if (b == IL_CHART_NONE || c->node[a].z == c->node[b].z)
        return;
    for (uint32_t v = a; next[v] != b; v = next[v]) {
        at += il_chart_distance(c, v, next[v]);
        c->node[next[v]].z = c->node[a].z + at / length * (c->node[b].z - c->node[a].z);
    }
}

bool il_rim_raise(il_chart *c)
{
    uint32_t *next = il_alloc(c->n_nodes, sizeof *next);
    unsigned char *known = il_calloc(c->n_nodes, 1);
    bool ok = known && find_next(c, next);
    for (size_t v = 0; ok && v < c->n_nodes; v++)
        known[v] = next[v] != IL_CHART_NONE && !isnan(c->node[v].z);
    for (size_t v = 0; ok && v < c->n_nodes; v++)
        if (known[v] && isnan(c->node[next[v]].z))
            raise_from(c, next, (uint32_t)v);
    il_free(next);
    il_free(known);
    return ok;
}

void il_rim_lower(il_chart *c)
{
    for (size_t v = 0; v < c->n_nodes; v++)
        if (c->node[v].is_frame && c->node[v].level < 0 && !c->node[v].is_spot)
            c->node[v].z = NAN;
}
