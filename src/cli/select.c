#include "config.h"
#include "cli/select.h"
#include "base/alloc.h"

#include <fnmatch.h>

typedef struct select_stage {
    il_sink sink;
    il_sink *next;
    const char *pattern;
    il_report *report;
    bool passing;
    size_t n_passed, n_dropped;
} select_stage;

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    select_stage *s = (select_stage *)self;
    s->passing = fnmatch(s->pattern, il_stack_head_name(head), 0) == 0;
    *(s->passing ? &s->n_passed : &s->n_dropped) += 1;
    return s->passing ? s->next->stack_begin(s->next, head, err) : IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    select_stage *s = (select_stage *)self;
    return s->passing ? s->next->slice(s->next, slice, err) : IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    select_stage *s = (select_stage *)self;
    return s->passing ? s->next->pair(s->next, pair, err) : IL_OK;
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    select_stage *s = (select_stage *)self;
    if (s->passing)
        return s->next->stack_end(s->next, err);
    il_report_free(s->report); /* it would count for the next stack */
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    select_stage *s = (select_stage *)self;
    if (s->n_passed == 0)
        return il_fail(err, IL_E_INPUT, 0, "none of the %zu stacks has a name that matches '%.100s'",
                       s->n_dropped, s->pattern);
    return s->next->end(s->next, err);
}

il_status il_select_new(il_sink **out, const char *pattern, il_sink *next, il_report *report, il_error *err)
{
    *out = NULL;
    select_stage *s = il_calloc(1, sizeof *s);
    if (!s)
        return il_fail_nomem(err);
    *s = (select_stage){ { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, next, pattern, report, false, 0, 0 };
    *out = &s->sink;
    return IL_OK;
}

void il_select_free(il_sink *s)
{
    il_free(s);
}
