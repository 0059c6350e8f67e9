#include "config.h"
#include "model/pair.h"
#include "base/alloc.h"

int il_place_compare(const il_place *a, const il_place *b)
{
    if (a->ring != b->ring)
        return a->ring < b->ring ? -1 : 1;
    if (a->vertex != b->vertex)
        return a->vertex < b->vertex ? -1 : 1;
    return a->t < b->t ? -1 : a->t > b->t;
}

const char *il_link_reason_word(il_link_reason why)
{
    static const char *const words[IL_N_LINK_REASONS] = {
        [IL_LINK_OVERLAP] = "overlap", [IL_LINK_SLANT] = "slant", [IL_LINK_NEAR] = "near", [IL_LINK_JOIN] = "join",
        [IL_LINK_OPENING] = "opening", [IL_LINK_GIVEN] = "given" };
    return words[why];
}

void il_fit_drop_lattices(il_fit *f)
{
    for (size_t i = 0; i < f->n_lattices; i++)
        il_free(f->lattice[i].d);
    il_free(f->lattice);
    f->lattice = NULL;
    f->n_lattices = f->cap_lattices = 0;
}

void il_fit_free(il_fit *f)
{
    il_fit_drop_lattices(f);
    *f = (il_fit){ 0 };
}

bool il_fit_is_trusted(const il_fit *f)
{
    const double *g = f->global;
    bool moved = g[0] != 1 || g[1] != 0 || g[2] != 0 || g[3] != 1 || g[4] != 0 || g[5] != 0;
    double growth = g[0] * g[3] - g[1] * g[2];
    bool leeway = moved && growth <= IL_GROWTH_MOST && growth * IL_GROWTH_MOST >= 1;
    return f->distortion <= (leeway ? IL_DISTORTION_MOST_MOVED : IL_DISTORTION_MOST) &&
           f->least_jacobian >= IL_SQUEEZE_MOST * growth;
}

bool il_group_lies_apart(const il_group *g)
{
    bool lies_on = false, apart = false;
    for (size_t i = 0; i < g->n_links; i++) {
        il_link_reason why = g->link[i].reason;
        bool given = why == IL_LINK_GIVEN;
        if (why == IL_LINK_SLANT || (given && g->link[i].reach > 0))
            return true;
        lies_on = lies_on || why == IL_LINK_OVERLAP || given;
        apart = apart || why == IL_LINK_NEAR || why == IL_LINK_JOIN;
    }
    return apart && !lies_on;
}

bool il_group_is_trusted(const il_group *g)
{
    return il_group_lies_apart(g) || il_fit_is_trusted(&g->fit);
}

static void free_group(il_group *g)
{
    il_fit_free(&g->fit);
    il_free(g->link);
    il_free(g->lower);
    il_free(g->upper);
}

void il_pair_free(il_pair *p)
{
    for (size_t i = 0; i < p->n_groups; i++)
        free_group(&p->group[i]);
    il_free(p->group);
    il_free(p->phi);
    il_free(p->match);
    il_free(p->unmatched);
    il_free(p->insertion);
    for (size_t i = 0; i < p->n_cuts; i++)
        il_free(p->cut[i].xy);
    il_free(p->cut);
    il_extra_free(&p->extra);
    *p = (il_pair)IL_PAIR_INIT;
}

void il_pair_make_gap(il_pair *p)
{
    il_pair gap = { .gap = true, .line = p->line, .extra = p->extra };
    p->extra = NULL;
    il_pair_free(p);
    *p = gap;
}

bool il_pair_names_rings(const il_pair *p)
{
    return p->n_groups + p->n_phi + p->n_matches + p->n_unmatched + p->n_insertions + p->n_cuts > 0;
}
