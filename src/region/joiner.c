#include "config.h"
#include "region/joiner.h"
#include "base/alloc.h"

typedef struct joiner {
    il_sink sink;
    il_sink *next;
    il_join_options options;
    il_report *report;
} joiner;

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    joiner *j = (joiner *)self;
    return j->next->stack_begin(j->next, head, err);
}

static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    joiner *j = (joiner *)self;
    return j->next->slice(j->next, s, err);
}

static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    joiner *j = (joiner *)self;
    return j->next->pair(j->next, p, err);
}

static il_status stack_end(il_sink *self, il_error *err)
{
    joiner *j = (joiner *)self;
    return j->next->stack_end(j->next, err);
}

static il_status end(il_sink *self, il_error *err)
{
    joiner *j = (joiner *)self;
    return j->next->end(j->next, err);
}

il_status il_joiner_new(il_sink **out, const il_join_options *o, il_sink *next, il_report *report, il_error *err)
{
    joiner *j = il_calloc(1, sizeof *j);
    *out = j ? &j->sink : NULL;
    if (!j)
        return il_fail_nomem(err);
    *j = (joiner){ { stack_begin, slice, pair, stack_end, end }, next, *o, report };
    return IL_OK;
}

void il_joiner_free(il_sink *s)
{
    il_free(s);
}
