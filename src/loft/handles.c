#include "config.h"
#include "loft/handles.h"
#include "base/alloc.h"
#include "base/forest.h"

static size_t count_rings(const il_section *s)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n_stations; i++)
        n += s->next[i] != i + 1;
    return n;
}

/* Of a surface with c parts, b borders and the genus g in all,
 * V - E + F = 2 c - 2 g - b, and 3 F = 2 E - (edges on borders). */
il_status il_surface_handles(const il_surface *s, const il_section *lower, const il_section *upper,
                             long *handles, il_error *err)
{
    const il_section *section[2] = { lower, upper };
    size_t first[3] = { 0, lower->n_nodes + s->n_insertions[0], 0 }, border = 0, rings = 0;
    first[2] = first[1] + upper->n_nodes + s->n_insertions[1];
    size_t n = first[2] + s->n_inner;
    *handles = 0;
    for (int k = 0; k < 2; k++) {
        if (section[k]->n_stations != section[k]->n_nodes)
            return IL_OK;
        border += section[k]->n_stations + s->n_insertions[k];
        rings += count_rings(section[k]);
    }
    uint32_t *up = il_alloc(n, sizeof *up);
    if (!up)
        return il_fail_nomem(err);
    il_forest_plant(up, n);
    for (size_t i = 0; i < 3 * s->n_triangles; i++) {
        uint32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1];
        il_forest_join(up, (uint32_t)first[IL_CODE_WHERE(a)] + IL_CODE_INDEX(a), (uint32_t)first[IL_CODE_WHERE(b)] + IL_CODE_INDEX(b));
    }
    long parts = 0;
    for (size_t i = 0; i < n; i++)
        parts += up[i] == i;
    il_free(up);
    long euler = (long)n - (long)(3 * s->n_triangles + border) / 2 + (long)s->n_triangles;
    *handles = (2 * parts - (long)rings - euler) / 2;
    return IL_OK;
}
