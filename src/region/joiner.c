#include "config.h"
#include "region/joiner.h"
#include "base/alloc.h"
#include "base/number.h"

/* changed, before_changed: the last slice of this stack and the one before it are not
 * as they came; gone, before_gone: not there any more.  largest: the widest gap bridged
 * in it. */
typedef struct joiner {
    il_sink sink;
    il_sink *next;
    il_join_options options;
    il_report *report;
    il_unit unit;
    bool is_terrain, changed, before_changed, gone, before_gone;
    double largest;
} joiner;

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    joiner *j = (joiner *)self;
    j->is_terrain = head->kind == IL_KIND_TERRAIN;
    j->unit = head->unit;
    j->changed = j->before_changed = j->gone = j->before_gone = false;
    j->largest = 0;
    if (!j->is_terrain && j->options.distance > 0)
        il_report_note(j->report, "--join is for terrain, which this is not");
    return j->next->stack_begin(j->next, head, err);
}

/* A level of which nothing is left is none. */
static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    joiner *j = (joiner *)self;
    size_t n_before = s->n;
    j->before_changed = j->changed;
    j->before_gone = j->gone;
    il_status st = j->is_terrain ? il_slice_join(s, &j->options, j->report, &j->changed, &j->largest, err) : IL_OK;
    j->gone = s->n == 0 && n_before > 0;
    return st == IL_OK && !j->gone ? j->next->slice(j->next, s, err) : st;
}

static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    joiner *j = (joiner *)self;
    bool names_others = (j->changed || j->before_changed) && il_pair_names_rings(p);
    if (names_others || j->gone || j->before_gone)
        return il_fail(err, IL_E_INPUT, p->line,
                       "this pair speaks of lines that are joined or in another order: run isoloft read on the contours");
    return j->next->pair(j->next, p, err);
}

static il_status stack_end(il_sink *self, il_error *err)
{
    joiner *j = (joiner *)self;
    char gap[IL_NUMBER_MAX];
    if (j->largest > 0) {
        il_number_format(gap, j->largest);
        il_report_note(j->report, "the widest gap bridged by --join is %s %s", gap, il_unit_name(j->unit));
    }
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
    *j = (joiner){ .sink = { stack_begin, slice, pair, stack_end, end }, .next = next, .options = *o, .report = report };
    return IL_OK;
}

void il_joiner_free(il_sink *s)
{
    il_free(s);
}
