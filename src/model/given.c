#include "config.h"
#include "model/given.h"
#include "base/alloc.h"

void il_given_free(il_given *g)
{
    for (size_t i = 0; i < g->n_stacks; i++)
        il_free(g->stack[i].name);
    il_free(g->file);
    il_free(g->stack);
    il_free(g->slab);
    il_free(g->link);
    *g = (il_given)IL_GIVEN_INIT;
}
