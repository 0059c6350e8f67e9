#include "config.h"
#include "terrain/ridge.h"
#include "base/alloc.h"
#include "bridge/predicates.h"
#include "terrain/cliff.h"
#include "terrain/split.h"

#include <math.h>

/* A third brings nothing but triangles. */
enum { ROUNDS = 2 };

static const double *corner(const il_tin *t, const il_chart *c, size_t k)
{
    return c->xy + 2 * (size_t)t->corner[k];
}

/* Edge K of triangles, seen from the lesser of its two. */
static bool is_chord(const il_tin *t, const il_chart *c, const il_band *band, size_t k)
{
    uint32_t across = t->across[k];
    if (t->face[k / 3] == IL_CHART_NONE || t->edge[k] != IL_CHART_NONE || across == IL_CHART_NONE || across < k / 3)
        return false;
    bool on_lines = c->node[t->corner[k]].level >= 0 && c->node[t->corner[il_tin_after(k)]].level >= 0;
    return on_lines && il_cliff_z(t, c, band, k) == il_cliff_z(t, c, band, il_tin_after(k));
}

/* Is P strictly inside the two triangles on edge K?  Rounding may have carried it out. */
static bool is_between(const il_tin *t, const il_chart *c, size_t k, const double p[2])
{
    size_t j = il_tin_twin(t, k);
    const double *a = corner(t, c, k), *b = corner(t, c, il_tin_after(k)), *left = corner(t, c, il_tin_after(il_tin_after(k)));
    const double *right = corner(t, c, il_tin_after(il_tin_after(j)));
    return il_orientation(b, left, p) > 0 && il_orientation(left, a, p) > 0 &&
           il_orientation(a, right, p) > 0 && il_orientation(right, b, p) > 0;
}

/* The middle of edge K of triangles, or IL_CHART_NONE; false without memory. */
static bool add_middle(const il_tin *t, il_chart *c, const il_law *law, const il_placement_options *o, size_t k, uint32_t *middle)
{
    const double *a = corner(t, c, k), *b = corner(t, c, il_tin_after(k));
    const double p[2] = { il_placement_round(o, a[0] + (b[0] - a[0]) / 2), il_placement_round(o, a[1] + (b[1] - a[1]) / 2) };
    double level = il_cliff_z(t, c, law->band, k);
    *middle = IL_CHART_NONE;
    if (!is_between(t, c, k, p))
        return true;
    double z = il_law_height(law, t->face[k / 3], p[0], p[1]);
    if (!(fabs(z - level) > IL_RIDGE_LEAST * il_law_interval(law, t->face[k / 3])))
        return true;
    size_t n = c->n_nodes;
    uint32_t node = il_chart_node_at(c, p[0], p[1]);
    if (node == n) {
        c->node[node].z = z;
        *middle = node;
    }
    return node != IL_CHART_NONE;
}

/* Give up middles beside triangles whose parts would be turned over, until none is left. */
static void give_up_unsound(const il_tin *t, const il_chart *c, uint32_t *middle)
{
    bool more = true;
    while (more) {
        more = false;
        for (size_t k = 0; k < t->n; k++) {
            if (il_split_is_sound(c, t->corner + 3 * k, middle + 3 * k))
                continue;
            more = true;
            for (size_t j = 3 * k; j < 3 * k + 3; j++) {
                if (middle[j] != IL_CHART_NONE)
                    middle[il_tin_twin(t, j)] = IL_CHART_NONE;
                middle[j] = IL_CHART_NONE;
            }
        }
    }
}

static il_status add_middles(il_tin *t, il_chart *c, const il_law *law, const il_placement_options *o, size_t *n, il_error *err)
{
    uint32_t *middle = il_alloc(3 * t->n, sizeof *middle);
    bool ok = middle;
    *n = 0;
    for (size_t k = 0; ok && k < 3 * t->n; k++)
        middle[k] = IL_CHART_NONE;
    for (size_t k = 0; ok && k < 3 * t->n; k++) {
        if (!is_chord(t, c, law->band, k))
            continue;
        ok = add_middle(t, c, law, o, k, &middle[k]);
        if (ok && middle[k] != IL_CHART_NONE) {
            middle[il_tin_twin(t, k)] = middle[k];
            ++*n;
        }
    }
    if (ok) {
        give_up_unsound(t, c, middle);
        ok = il_tin_split(t, c, middle);
    }
    il_free(middle);
    return ok ? IL_OK : il_fail_nomem(err);
}

il_status il_ridge_insert(il_tin *t, il_chart *c, const il_law *law, const il_placement_options *o, il_error *err)
{
    il_status st = IL_OK;
    size_t n = 1;
    for (int round = 0; round < ROUNDS && st == IL_OK && n > 0; round++)
        st = add_middles(t, c, law, o, &n, err);
    return st;
}
