#include "config.h"
#include "terrain/ridge.h"
#include "bridge/predicates.h"
#include "terrain/cliff.h"

#include <math.h>

/* A third brings nothing but triangles. */
enum { ROUNDS = 2 };

/* The corner after number K of its triangle, and the one after that. */
static size_t after(size_t k)
{
    return k % 3 == 2 ? k - 2 : k + 1;
}

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
    bool on_lines = c->node[t->corner[k]].level >= 0 && c->node[t->corner[after(k)]].level >= 0;
    return on_lines && il_cliff_z(t, c, band, k) == il_cliff_z(t, c, band, after(k));
}

/* Which edge of triangle NEXT leads to triangle T. */
static size_t edge_to(const il_tin *t, uint32_t next, size_t from)
{
    size_t k = 3 * (size_t)next;
    while (t->across[k] != from)
        k++;
    return k;
}

/* Is P strictly inside the two triangles on edge K?  Rounding may have carried it out. */
static bool is_between(const il_tin *t, const il_chart *c, size_t k, const double p[2])
{
    size_t j = edge_to(t, t->across[k], k / 3);
    const double *a = corner(t, c, k), *b = corner(t, c, after(k)), *left = corner(t, c, after(after(k)));
    const double *right = corner(t, c, after(after(j)));
    return il_orientation(b, left, p) > 0 && il_orientation(left, a, p) > 0 &&
           il_orientation(a, right, p) > 0 && il_orientation(right, b, p) > 0;
}

static bool add_middle(const il_tin *t, il_chart *c, const il_law *law, const il_placement_options *o, size_t k)
{
    const double *a = corner(t, c, k), *b = corner(t, c, after(k));
    const double p[2] = { il_placement_round(o, a[0] + (b[0] - a[0]) / 2), il_placement_round(o, a[1] + (b[1] - a[1]) / 2) };
    double level = il_cliff_z(t, c, law->band, k);
    if (!is_between(t, c, k, p))
        return true;
    double z = il_law_height(law, t->face[k / 3], p[0], p[1]);
    if (!(fabs(z - level) > IL_RIDGE_LEAST * il_law_interval(law, t->face[k / 3])))
        return true;
    uint32_t node = il_chart_node_at(c, p[0], p[1]);
    if (node == IL_CHART_NONE)
        return false;
    c->node[node].z = z;
    return true;
}

il_status il_ridge_insert(il_tin *t, il_chart *c, const il_law *law, const il_placement_options *o, il_error *err)
{
    il_status st = IL_OK;
    for (int round = 0; round < ROUNDS && st == IL_OK; round++) {
        size_t from = c->n_nodes;
        for (size_t k = 0; k < 3 * t->n; k++)
            if (is_chord(t, c, law->band, k) && !add_middle(t, c, law, o, k))
                return il_fail_nomem(err);
        if (c->n_nodes == from)
            break;
        st = il_tin_refine(t, c, from, err);
    }
    return st;
}
