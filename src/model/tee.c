#include "config.h"
#include "model/tee.h"
#include "base/alloc.h"

typedef struct tee {
    il_sink sink;
    il_sink *side, *next;
} tee;

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    tee *t = (tee *)self;
    il_status st = t->side->stack_begin(t->side, head, err);
    return st == IL_OK ? t->next->stack_begin(t->next, head, err) : st;
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    tee *t = (tee *)self;
    il_status st = t->side->slice(t->side, slice, err);
    return st == IL_OK ? t->next->slice(t->next, slice, err) : st;
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    tee *t = (tee *)self;
    il_status st = t->side->pair(t->side, pair, err);
    return st == IL_OK ? t->next->pair(t->next, pair, err) : st;
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    tee *t = (tee *)self;
    il_status st = t->side->stack_end(t->side, err);
    return st == IL_OK ? t->next->stack_end(t->next, err) : st;
}

static il_status on_end(il_sink *self, il_error *err)
{
    tee *t = (tee *)self;
    il_status st = t->side->end(t->side, err);
    return st == IL_OK ? t->next->end(t->next, err) : st;
}

il_status il_tee_new(il_sink **out, il_sink *side, il_sink *next, il_error *err)
{
    *out = NULL;
    tee *t = il_calloc(1, sizeof *t);
    if (!t)
        return il_fail_nomem(err);
    *t = (tee){ { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, side, next };
    *out = &t->sink;
    return IL_OK;
}

void il_tee_free(il_sink *s)
{
    il_free(s);
}
