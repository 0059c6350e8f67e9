#include "config.h"
#include "match/matcher.h"
#include "base/alloc.h"

il_status il_match_slices(const il_slice *lower, const il_slice *upper, const il_match_options *o,
                          il_pair *out, il_error *err)
{
    (void)lower;
    (void)upper;
    *out = (il_pair)IL_PAIR_INIT;
    if (o->matcher != IL_MATCHER_NONE)
        return il_fail(err, IL_E_USAGE, 0, "this version knows no other matcher than none");
    /* The identity: there is nothing to say of it. */
    out->matcher = IL_MATCHER_NONE;
    return IL_OK;
}

/* Whether the stream brings a pair is known only when the call after the upper
 * slice comes.  The next stage may take the slices it is given, hence copies.
 * n: slices of this stack so far; waiting: the pair of lower and upper is due. */
typedef struct matcher_stage {
    il_sink sink;
    il_sink *next;
    il_match_options options;
    il_slice lower, upper;
    size_t n;
    bool waiting;
} matcher_stage;

static void forget(matcher_stage *m)
{
    il_slice_free(&m->lower);
    il_slice_free(&m->upper);
    m->n = 0;
    m->waiting = false;
}

static il_status match_waiting(matcher_stage *m, il_error *err)
{
    if (!m->waiting)
        return IL_OK;
    m->waiting = false;
    il_pair pair = IL_PAIR_INIT;
    il_status st = il_match_slices(&m->lower, &m->upper, &m->options, &pair, err);
    if (st == IL_OK)
        st = m->next->pair(m->next, &pair, err);
    il_pair_free(&pair);
    return st;
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    forget(m);
    return m->next->stack_begin(m->next, head, err);
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    il_status st = match_waiting(m, err);
    if (st != IL_OK)
        return st;
    il_slice_free(&m->lower);
    m->lower = m->upper;
    m->upper = (il_slice)IL_SLICE_INIT;
    st = il_slice_copy(&m->upper, slice, err);
    if (st != IL_OK)
        return st;
    m->waiting = m->n++ > 0;
    return m->next->slice(m->next, slice, err);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    if (!m->waiting)
        return il_fail(err, IL_E_INPUT, pair->line, "a pair record must follow the upper one of its two slices, once");
    m->waiting = false;
    return m->next->pair(m->next, pair, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    il_status st = match_waiting(m, err);
    forget(m);
    return st == IL_OK ? m->next->stack_end(m->next, err) : st;
}

static il_status on_end(il_sink *self, il_error *err)
{
    matcher_stage *m = (matcher_stage *)self;
    return m->next->end(m->next, err);
}

il_status il_matcher_new(il_sink **out, const il_match_options *o, il_sink *next, il_error *err)
{
    *out = NULL;
    matcher_stage *m = il_calloc(1, sizeof *m);
    if (!m)
        return il_fail_nomem(err);
    m->sink = (il_sink){ on_stack_begin, on_slice, on_pair, on_stack_end, on_end };
    m->next = next;
    m->options = *o;
    m->lower = m->upper = (il_slice)IL_SLICE_INIT;
    *out = &m->sink;
    return IL_OK;
}

void il_matcher_free(il_sink *s)
{
    matcher_stage *m = (matcher_stage *)s;
    if (!m)
        return;
    forget(m);
    il_free(m);
}
