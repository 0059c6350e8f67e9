#include "config.h"
#include "loft/group.h"
#include "base/alloc.h"
#include "base/forest.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

void il_groups_free(il_groups *g)
{
    il_free(g->of[0]);
    il_free(g->of[1]);
    il_free(g->up);
    *g = (il_groups)IL_GROUPS_INIT;
}

static void take_rings(il_groups *g, int side, const uint32_t *ring, size_t n, uint32_t group)
{
    for (size_t i = 0; i < n; i++)
        if (ring[i] < g->n_rings[side])
            g->of[side][ring[i]] = group;
}

il_status il_groups_find(il_groups *g, const il_pair *pair, const size_t n_rings[2], il_error *err)
{
    *g = (il_groups)IL_GROUPS_INIT;
    bool one = !pair || pair->matcher == IL_MATCHER_NONE || pair->n_groups == 0;
    size_t most = one ? 1 : pair->n_groups + n_rings[0] + n_rings[1];
    for (int side = 0; side < 2; side++) {
        g->n_rings[side] = n_rings[side];
        g->of[side] = il_alloc(n_rings[side], sizeof *g->of[side]);
    }
    g->up = il_alloc(most, sizeof *g->up);
    if (!g->of[0] || !g->of[1] || !g->up) {
        il_groups_free(g);
        return il_fail_nomem(err);
    }
    for (int side = 0; side < 2; side++)
        memset(g->of[side], one ? 0 : 0xFF, n_rings[side] * sizeof *g->of[side]);
    for (uint32_t i = 0; !one && i < pair->n_groups; i++) {
        take_rings(g, 0, pair->group[i].lower, pair->group[i].n_lower, i);
        take_rings(g, 1, pair->group[i].upper, pair->group[i].n_upper, i);
    }
    g->n = one ? 1 : pair->n_groups;
    for (int side = 0; side < 2; side++)
        for (size_t r = 0; r < n_rings[side]; r++)
            if (g->of[side][r] == NONE)
                g->of[side][r] = (uint32_t)g->n++;
    il_forest_plant(g->up, g->n);
    return IL_OK;
}

void il_group_rings_free(il_group_rings *l)
{
    il_free(l->first);
    il_free(l->ring);
    *l = (il_group_rings){ NULL, NULL };
}

/* A counting sort, stable: rings rise within a group. */
il_status il_group_rings_list(il_group_rings *l, il_groups *g, int side, il_error *err)
{
    size_t n = g->n_rings[side];
    l->first = il_calloc(g->n + 2, sizeof *l->first);
    l->ring = il_alloc(n, sizeof *l->ring);
    if (!l->first || !l->ring) {
        il_group_rings_free(l);
        return il_fail_nomem(err);
    }
    for (size_t r = 0; r < n; r++)
        l->first[il_forest_leader(g->up, g->of[side][r]) + 2]++;
    for (size_t i = 2; i < g->n + 2; i++)
        l->first[i] += l->first[i - 1];
    for (uint32_t r = 0; r < n; r++)
        l->ring[l->first[il_forest_leader(g->up, g->of[side][r]) + 1]++] = r;
    return IL_OK;
}
