#include "config.h"
#include "model/pair.h"
#include "base/alloc.h"

void il_pair_free(il_pair *p)
{
    for (size_t i = 0; i < p->n_groups; i++) {
        il_free(p->group[i].lower);
        il_free(p->group[i].upper);
    }
    il_free(p->group);
    il_free(p->phi);
    il_free(p->match);
    il_free(p->unmatched);
    il_extra_free(&p->extra);
    *p = (il_pair)IL_PAIR_INIT;
}
