#include "config.h"
#include "loft/census.h"
#include "base/alloc.h"
#include "base/forest.h"

#include <stdbool.h>

il_status il_census_begin(il_census *c, size_t n, il_error *err)
{
    *c = (il_census)IL_CENSUS_INIT;
    c->label = il_alloc(n, sizeof *c->label);
    if (!c->label)
        return il_fail_nomem(err);
    il_forest_plant(c->label, n);
    c->n_front = n;
    c->vertices = n;
    return IL_OK;
}

/* Labels for the next front, the last N_NEXT of N: each component by its least
 * vertex there.  Roots that have none are closed. */
static void pass_on(il_census *c, uint32_t *parent, size_t n, uint32_t *label, size_t n_next, uint32_t *seen)
{
    size_t first = n - n_next;
    for (size_t i = 0; i < n; i++)
        seen[i] = UINT32_MAX;
    for (uint32_t i = 0; i < n_next; i++) {
        uint32_t *least = &seen[il_forest_leader(parent, (uint32_t)first + i)];
        if (*least == UINT32_MAX)
            *least = i;
        label[i] = *least;
    }
    for (uint32_t i = 0; i < n; i++)
        c->closed += parent[i] == i && seen[i] == UINT32_MAX;
}

il_status il_census_add(il_census *c, const uint32_t *tri, size_t n_triangles,
                        size_t n_inner, size_t n_next, il_error *err)
{
    size_t n = c->n_front + n_inner + n_next;
    uint32_t *parent = il_alloc(n, sizeof *parent), *seen = il_alloc(n, sizeof *seen);
    uint32_t *label = il_alloc(n_next, sizeof *label);
    bool ok = parent && seen && label;
    if (ok) {
        for (uint32_t i = 0; i < n; i++)
            parent[i] = i < c->n_front ? c->label[i] : i;
        for (size_t t = 0; t < n_triangles; t++) {
            il_forest_join(parent, tri[3 * t], tri[3 * t + 1]);
            il_forest_join(parent, tri[3 * t], tri[3 * t + 2]);
        }
        pass_on(c, parent, n, label, n_next, seen);
        il_free(c->label);
        c->label = label;
        label = NULL;
        c->n_front = n_next;
        c->vertices += n_inner + n_next;
        c->triangles += n_triangles;
    }
    il_free(label);
    il_free(parent);
    il_free(seen);
    return ok ? IL_OK : il_fail_nomem(err);
}

void il_census_result(const il_census *c, long *components, long *genus)
{
    *components = c->closed;
    for (uint32_t i = 0; i < c->n_front; i++)
        *components += c->label[i] == i;
    /* every edge has two triangles: E = 3 F / 2, so the Euler number is V - F / 2 */
    long euler = (long)c->vertices - (long)(c->triangles / 2);
    *genus = *components - euler / 2;
}

void il_census_free(il_census *c)
{
    il_free(c->label);
    *c = (il_census)IL_CENSUS_INIT;
}
