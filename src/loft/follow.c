#include "config.h"
#include "loft/follow.h"
#include "base/alloc.h"

static bool follows(const il_follow *f, uint32_t g, uint32_t ring)
{
    return g >= f->pair->n_groups || (f->group[g] && !f->rests[ring]);
}

/* The vertices of RING where they lie, behind the rows that are there. */
static void put_at_rest(il_follow *f, uint32_t ring)
{
    const il_section *s = f->upper;
    uint32_t end = il_section_first_station(s, ring + (size_t)1);
    for (uint32_t i = il_section_first_station(s, ring); i < end; i++) {
        const double *xy = s->xy + 2 * s->node_at[i];
        if (s->t_at[i] == 0) /* no point that a neighbour inserted */
            f->rows.phi[f->rows.n_phi++] = (il_phi_point){ { ring, s->vertex_at[i], 0 }, xy[0], xy[1] };
    }
}

static il_status lay_rows(il_follow *f, il_error *err)
{
    f->rows.n_phi = 0;
    for (size_t i = 0; i < f->pair->n_phi;) {
        uint32_t ring = f->pair->phi[i].at.ring;
        bool moved = follows(f, f->group_of[ring], ring);
        for (; i < f->pair->n_phi && f->pair->phi[i].at.ring == ring; i++)
            if (moved)
                f->rows.phi[f->rows.n_phi++] = f->pair->phi[i];
        if (!moved)
            put_at_rest(f, ring);
    }
    il_phi_free(&f->phi);
    return il_phi_index(&f->phi, &f->rows, f->upper, err);
}

il_status il_follow_begin(il_follow *f, const il_pair *pair, const il_section *upper, const uint32_t *group_of, il_error *err)
{
    *f = (il_follow){ .pair = pair, .upper = upper, .group_of = group_of };
    il_status st = il_phi_index(&f->phi, pair, upper, err);
    if (st != IL_OK || !f->phi.pair)
        return st;
    f->rows = *pair;
    f->rows.phi = il_alloc(pair->n_phi, sizeof *f->rows.phi);
    f->group = il_alloc(pair->n_groups, sizeof *f->group);
    f->rests = il_calloc(upper->n_rings, sizeof *f->rests);
    if (!f->rows.phi || !f->group || !f->rests)
        return il_fail_nomem(err);
    for (size_t g = 0; g < pair->n_groups; g++)
        f->group[g] = !pair->group[g].fitted || il_group_is_trusted(&pair->group[g]);
    return lay_rows(f, err);
}

void il_follow_free(il_follow *f)
{
    il_phi_free(&f->phi);
    il_free(f->rows.phi);
    il_free(f->group);
    il_free(f->rests);
    *f = (il_follow){ .pair = NULL };
}

il_status il_follow_rest(il_follow *f, uint32_t r, bool rests, il_error *err)
{
    f->rests[r] = rests;
    return lay_rows(f, err);
}

bool il_follow_holds(const il_follow *f, size_t i, uint32_t g)
{
    uint32_t ring = f->pair->match[i].upper.from.ring;
    return f->pair->match[i].as_they_lie != follows(f, g, ring) && !f->rests[ring];
}
