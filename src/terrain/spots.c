#include "config.h"
#include "terrain/spots.h"
#include "base/alloc.h"

#include <math.h>

bool il_spots_add(il_chart *c, const il_stack_head *head, const il_placement_options *o,
                  const unsigned char *out, uint32_t *node)
{
    for (size_t i = 0; i < head->n_spots; i++) {
        const double map[2] = { head->spot[i].x, head->spot[i].y };
        double p[2];
        node[i] = IL_CHART_NONE;
        if (out[i])
            continue;
        il_placement_apply(head, o, map, p);
        node[i] = il_chart_node_at(c, p[0], p[1]);
        if (node[i] == IL_CHART_NONE)
            return false;
        il_chart_node *n = &c->node[node[i]];
        if (n->level < 0) {
            n->z = head->spot[i].z;
            n->is_spot = true;
        }
    }
    return true;
}

/* Null when the spot fits.  Beyond the last level nothing bounds it. */
static const char *find_fault(const il_chart *c, uint32_t face, const il_band *band, const il_chart_node *n, double z)
{
    if (face == IL_CHART_NONE)
        return "it lies outside the frame; left out";
    if (n->level >= 0)
        return z < c->level_z[n->level] || z > c->level_z[n->top] ? "it lies on an isoline of another height; left out" : NULL;
    il_band b = band[face];
    if ((b.low >= 0 && z < c->level_z[b.low]) || (b.high < (int32_t)c->n_levels && z > c->level_z[b.high]))
        return "it does not lie between the heights of the isolines around it; left out";
    return NULL;
}

il_status il_spots_judge(il_chart *c, const il_tin *t, const il_band *band, const il_complaint *complaint,
                         unsigned char *out, uint32_t *node, il_error *err)
{
    const il_stack_head *head = complaint->head;
    uint32_t *face = head->n_spots > 0 ? il_alloc(c->n_nodes, sizeof *face) : NULL;
    if (head->n_spots > 0 && !face)
        return il_fail_nomem(err);
    for (size_t v = 0; face && v < c->n_nodes; v++)
        face[v] = IL_CHART_NONE;
    for (size_t k = 0; face && k < 3 * t->n; k++)
        if (t->face[k / 3] != IL_CHART_NONE)
            face[t->corner[k]] = t->face[k / 3];
    for (size_t i = 0; i < head->n_spots; i++) {
        if (node[i] == IL_CHART_NONE)
            continue;
        il_chart_node *n = &c->node[node[i]];
        const char *fault = find_fault(c, face[node[i]], band, n, head->spot[i].z);
        if (!fault)
            continue;
        il_complaint_spot(complaint, i, fault);
        out[i] = 1;
        node[i] = IL_CHART_NONE;
        n->is_spot = false;
        n->z = n->level < 0 ? NAN : n->z;
    }
    il_free(face);
    return IL_OK;
}
