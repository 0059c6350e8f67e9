#include "config.h"
#include "terrain/rim.h"
#include "base/alloc.h"

#include <math.h>

static double distance(const il_chart *c, uint32_t a, uint32_t b)
{
    return hypot(c->xy[2 * (size_t)b] - c->xy[2 * (size_t)a], c->xy[2 * (size_t)b + 1] - c->xy[2 * (size_t)a + 1]);
}

/* next[node]: the one after it on the frame, IL_CHART_NONE off it. */
static bool find_next(const il_chart *c, uint32_t *next)
{
    if (!next)
        return false;
    for (size_t v = 0; v < c->n_nodes; v++)
        next[v] = IL_CHART_NONE;
    for (size_t e = 0; e < c->n_edges; e++)
        if (c->owner[e] == IL_CHART_NONE)
            next[c->edge[2 * e]] = c->edge[2 * e + 1];
    return true;
}

/* From node A, which has a height, to the next one that has. */
static void raise_from(il_chart *c, const uint32_t *next, uint32_t a)
{
    uint32_t b = a, before = a;
    double length = 0, at = 0;
    do {
        before = b;
        b = next[b];
        length += b == IL_CHART_NONE ? 0 : distance(c, before, b);
    } while (b != IL_CHART_NONE && b != a && isnan(c->node[b].z));
    if (b == IL_CHART_NONE || c->node[a].z == c->node[b].z)
        return;
    for (uint32_t v = a; next[v] != b; v = next[v]) {
        at += distance(c, v, next[v]);
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
