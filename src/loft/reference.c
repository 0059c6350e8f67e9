#include "config.h"
#include "loft/reference.h"
#include "base/alloc.h"

static bool build_side(il_ref_side *side, const il_section *s)
{
    side->vertex = il_alloc(s->n_stations, sizeof *side->vertex);
    side->next = il_alloc(s->n_stations, sizeof *side->next);
    if (!side->vertex || !side->next)
        return false;
    for (uint32_t i = 0; i < s->n_stations; i++) {
        const double *xy = s->xy + 2 * s->node_at[i];
        side->vertex[i] = (il_ref_vertex){ xy[0], xy[1], i, 0 };
        side->next[i] = s->next[i];
    }
    side->n = s->n_stations;
    return true;
}

il_status il_reference_build(il_reference *r, const il_section *lower, const il_section *upper, il_error *err)
{
    *r = (il_reference){ .section = { lower, upper } };
    if (build_side(&r->side[IL_LOWER], lower) && build_side(&r->side[IL_UPPER], upper))
        return IL_OK;
    il_reference_free(r);
    return il_fail_nomem(err);
}

void il_reference_free(il_reference *r)
{
    for (int k = 0; k < 2; k++) {
        il_free(r->side[k].vertex);
        il_free(r->side[k].next);
        r->side[k] = (il_ref_side){ 0 };
    }
}

/* phi is the identity, and so is every psi_z. */
void il_reference_to_real(const il_reference *r, const double p[2], double z, double out[2])
{
    (void)r;
    (void)z;
    out[0] = p[0];
    out[1] = p[1];
}
