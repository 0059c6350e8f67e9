#include "config.h"
#include "loft/phi.h"
#include "base/alloc.h"

#include <math.h>

static const double LARGEST = 1e100;

void il_phi_free(il_phi *phi)
{
    il_free(phi->first);
    *phi = (il_phi)IL_PHI_INIT;
}

/* Does row B follow row A on one ring, without a vertex left out? */
static bool follows(const il_place *a, const il_place *b)
{
    if (b->vertex == a->vertex)
        return b->t > a->t && b->t < 1;
    return b->vertex == a->vertex + 1 && b->t == 0;
}

/* The rows of ring R from row I on, as they must be; *I: behind them. */
static bool take_ring(const il_pair *p, const il_section *upper, uint32_t r, size_t *i)
{
    size_t first = *i;
    uint32_t end = il_section_first_station(upper, r + (size_t)1);
    for (; *i < p->n_phi && p->phi[*i].at.ring == r; ++*i) {
        const il_phi_point *row = &p->phi[*i];
        if (*i == first ? row->at.vertex > 0 || row->at.t != 0 : !follows(&row[-1].at, &row->at))
            return false;
        if (!(fabs(row->x) < LARGEST && fabs(row->y) < LARGEST))
            return false;
    }
    return *i > first && end > 0 && p->phi[*i - 1].at.vertex == upper->vertex_at[end - 1];
}

il_status il_phi_index(il_phi *phi, const il_pair *pair, const il_section *upper, il_error *err)
{
    *phi = (il_phi)IL_PHI_INIT;
    if (!pair || pair->matcher == IL_MATCHER_NONE)
        return IL_OK;
    phi->first = il_alloc(upper->n_rings + 1, sizeof *phi->first);
    if (!phi->first)
        return il_fail_nomem(err);
    size_t i = 0;
    bool usable = true;
    for (uint32_t r = 0; usable && r < upper->n_rings; r++) {
        phi->first[r] = i;
        usable = take_ring(pair, upper, r, &i);
    }
    if (usable) {
        phi->first[upper->n_rings] = i;
        phi->pair = pair;
    }
    return IL_OK;
}

size_t il_phi_row_after(const il_phi *phi, il_place at)
{
    size_t low = phi->first[at.ring], high = phi->first[at.ring + 1];
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (il_place_compare(&phi->pair->phi[middle].at, &at) > 0)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

void il_phi_at(const il_phi *phi, il_place at, double out[2])
{
    size_t after = il_phi_row_after(phi, at);
    const il_phi_point *a = &phi->pair->phi[after - 1];
    const il_phi_point *b = &phi->pair->phi[after < phi->first[at.ring + 1] ? after : phi->first[at.ring]];
    double end = b->at.t > 0 ? b->at.t : 1, part = (at.t - a->at.t) / (end - a->at.t);
    out[0] = a->x + part * (b->x - a->x);
    out[1] = a->y + part * (b->y - a->y);
}
