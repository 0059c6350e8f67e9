#include "config.h"
#include "terrain/blank.h"
#include "base/alloc.h"

/* Lines of at least one level bound all others. */
static bool is_blank(const il_chart *c, il_band b)
{
    return b.low < 0 && b.high >= (int32_t)c->n_levels;
}

static bool is_bare(const il_tin *t, const il_chart *c, const il_band *band)
{
    for (size_t k = 0; k < 2 * t->n_sides; k++)
        if (t->side[k] != IL_CHART_NONE && c->height[k / 2] >= 0 && is_blank(c, band[t->side[k]]))
            return false;
    return true;
}

/* The middle of the face's first triangle. */
static bool add_place(const il_tin *t, const il_chart *c, size_t triangle, double **xy, size_t *n, size_t *cap)
{
    if (!il_grow(xy, cap, *n + 1, 2 * sizeof **xy))
        return false;
    double *p = *xy + 2 * (*n)++;
    for (size_t i = 0; i < 2; i++) {
        p[i] = 0;
        for (size_t k = 3 * triangle; k < 3 * triangle + 3; k++)
            p[i] += c->xy[2 * (size_t)t->corner[k] + i] / 3;
    }
    return true;
}

il_status il_blank_leave_out(il_tin *t, const il_chart *c, il_band *band, double **xy, size_t *n, il_error *err)
{
    unsigned char *known = il_calloc(t->n_faces, 1);
    size_t cap = 0;
    bool ok = known != NULL;
    *xy = NULL;
    *n = 0;
    if (ok && !is_bare(t, c, band)) {
        il_free(known);
        return il_fail(err, IL_E_SURFACE, 0, "isolines run together so that nothing tells which side of them is higher");
    }
    for (size_t k = 0; k < t->n && ok; k++) {
        uint32_t f = t->face[k];
        if (f == IL_CHART_NONE || !is_blank(c, band[f]))
            continue;
        ok = known[f] || add_place(t, c, k, xy, n, &cap);
        known[f] = 1;
        t->face[k] = IL_CHART_NONE;
    }
    for (size_t k = 0; k < 2 * t->n_sides && ok; k++)
        if (t->side[k] != IL_CHART_NONE && known[t->side[k]])
            t->side[k] = IL_CHART_NONE;
    for (size_t f = 0; f < t->n_faces && ok; f++)
        band[f] = known[f] ? (il_band){ -1, 0 } : band[f];
    il_free(known);
    return ok ? IL_OK : il_fail_nomem(err);
}
