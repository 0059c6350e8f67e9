#include "config.h"
#include "cli/stopwatch.h"
#include "cli/progress.h"

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    il_stopwatch *w = (il_stopwatch *)self;
    *w->began = il_clock_seconds();
    return w->next->stack_begin(w->next, head, err);
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    il_stopwatch *w = (il_stopwatch *)self;
    return w->next->slice(w->next, slice, err);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    il_stopwatch *w = (il_stopwatch *)self;
    return w->next->pair(w->next, pair, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    il_stopwatch *w = (il_stopwatch *)self;
    return w->next->stack_end(w->next, err);
}

static il_status on_end(il_sink *self, il_error *err)
{
    il_stopwatch *w = (il_stopwatch *)self;
    return w->next->end(w->next, err);
}

il_sink *il_stopwatch_init(il_stopwatch *w, il_sink *next, double *began)
{
    *w = (il_stopwatch){ { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, next, began };
    return &w->sink;
}
