#include "config.h"
#include "match/unlinked.h"
#include "base/alloc.h"

typedef struct unlinked {
    il_sink sink;
    il_sink *next;
} unlinked;

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    unlinked *u = (unlinked *)self;
    return u->next->stack_begin(u->next, head, err);
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    unlinked *u = (unlinked *)self;
    return u->next->slice(u->next, slice, err);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    unlinked *u = (unlinked *)self;
    return pair->gap || pair->n_groups > 0 ? u->next->pair(u->next, pair, err) : IL_OK;
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    unlinked *u = (unlinked *)self;
    return u->next->stack_end(u->next, err);
}

static il_status on_end(il_sink *self, il_error *err)
{
    unlinked *u = (unlinked *)self;
    return u->next->end(u->next, err);
}

il_status il_unlinked_new(il_sink **out, il_sink *next, il_error *err)
{
    unlinked *u = il_calloc(1, sizeof *u);
    *out = u ? &u->sink : NULL;
    if (!u)
        return il_fail_nomem(err);
    *u = (unlinked){ { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, next };
    return IL_OK;
}

void il_unlinked_free(il_sink *s)
{
    il_free(s);
}
