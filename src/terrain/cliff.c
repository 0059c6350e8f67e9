#include "config.h"
#include "terrain/cliff.h"
#include "base/alloc.h"

int32_t il_cliff_level(const il_chart_node *n, il_band band)
{
    if (n->top <= band.low)
        return n->top;
    if (n->level >= band.high)
        return n->level;
    /* lines of both of the band's levels meet here, or, of a band that lacks lines, one between them */
    return band.low > n->level ? band.low : n->level;
}

double il_cliff_z(const il_tin *t, const il_chart *c, const il_band *band, size_t k)
{
    const il_chart_node *n = &c->node[t->corner[k]];
    return n->level == n->top ? n->z : c->level_z[il_cliff_level(n, band[t->face[k / 3]])];
}

il_status il_cliff_label(const il_tin *t, const il_chart *c, il_band *band, il_error *err)
{
    unsigned char *known = il_calloc(t->n_faces, 1);
    bool more = known != NULL;
    for (size_t k = 0; known && k < 2 * t->n_sides; k++)
        if (t->side[k] != IL_CHART_NONE && c->height[k / 2] >= 0 && t->cliff[k / 2 * 2] < 0)
            known[t->side[k]] = 1;
    while (more && t->n_cliffs > 0) {
        more = false;
        for (size_t k = 0; k < 2 * t->n_sides; k++) {
            uint32_t f = t->side[k], g = t->side[k ^ 1];
            if (t->cliff[k / 2 * 2] < 0 || f == IL_CHART_NONE || g == IL_CHART_NONE || known[f] || !known[g])
                continue;
            int32_t low = t->cliff[k / 2 * 2], high = t->cliff[k / 2 * 2 + 1];
            bool above = (band[g].low >= high) == (low == high);
            band[f] = above ? (il_band){ high, high + 1 } : (il_band){ low - 1, low };
            known[f] = more = true;
        }
    }
    il_free(known);
    return known ? IL_OK : il_fail_nomem(err);
}
