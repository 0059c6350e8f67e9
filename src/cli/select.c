#include "config.h"
#include "cli/select.h"
#include "base/alloc.h"
#include "base/pattern.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>

/* Names shown when nothing matches, and bytes of each. */
enum { NAMES_SHOWN = 5, NAME_SHOWN = 40 };

/* matched[n_patterns]: whether any name did; shown: the first names that were
 * dropped, printable. */
typedef struct select_stage {
    il_sink sink;
    il_sink *next;
    const char *const *pattern;
    size_t n_patterns;
    bool *matched;
    il_report *report;
    il_voice *voice;
    bool passing;
    size_t n_passed, n_dropped;
    char shown[NAMES_SHOWN][NAME_SHOWN];
} select_stage;

/* ---- names ------------------------------------------------------------------ */

static void remember(select_stage *s, const char *name)
{
    if (s->n_dropped < NAMES_SHOWN)
        il_text_printable(s->shown[s->n_dropped], NAME_SHOWN, name, strlen(name));
    s->n_dropped++;
}

static il_status fail_none(const select_stage *s, il_error *err)
{
    char list[NAMES_SHOWN * (NAME_SHOWN + 4) + 40] = "";
    size_t n = 0, shown = s->n_dropped < NAMES_SHOWN ? s->n_dropped : NAMES_SHOWN;
    if (s->n_dropped == 0)
        return il_fail(err, IL_E_INPUT, 0, "there are no stacks to choose from");
    for (size_t k = 0; k < shown; k++)
        n += (size_t)snprintf(list + n, sizeof list - n, "%s'%s'", k > 0 ? ", " : "", s->shown[k]);
    if (s->n_dropped > shown)
        snprintf(list + n, sizeof list - n, " and %zu more", s->n_dropped - shown);
    return il_fail(err, IL_E_INPUT, 0, "no name matches '%.60s'%s; there are %s", s->pattern[0],
                   s->n_patterns > 1 ? " and the other patterns" : "", list);
}

/* ---- the stage ---------------------------------------------------------------- */

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    select_stage *s = (select_stage *)self;
    const char *name = il_stack_head_name(head);
    s->passing = il_pattern_choose(s->pattern, s->n_patterns, name, s->matched);
    if (s->passing)
        s->n_passed++;
    else
        remember(s, name);
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

/* One pattern of several may be misspelt, and what it was for be missed late. */
static il_status on_end(il_sink *self, il_error *err)
{
    select_stage *s = (select_stage *)self;
    if (s->n_passed == 0)
        return fail_none(s, err);
    for (size_t k = 0; k < s->n_patterns; k++)
        if (!s->matched[k])
            il_message_note(s->voice, "no name matches '%.60s'", s->pattern[k] + (s->pattern[k][0] == '!'));
    return s->next->end(s->next, err);
}

il_status il_select_new(il_sink **out, const char *const *pattern, size_t n, il_sink *next,
                        il_report *report, il_voice *voice, il_error *err)
{
    *out = NULL;
    select_stage *s = il_calloc(1, sizeof *s);
    bool *matched = il_calloc(n, sizeof *matched);
    if (!s || !matched) {
        il_free(s);
        il_free(matched);
        return il_fail_nomem(err);
    }
    s->sink = (il_sink){ on_stack_begin, on_slice, on_pair, on_stack_end, on_end };
    s->next = next;
    s->pattern = pattern;
    s->n_patterns = n;
    s->matched = matched;
    s->report = report;
    s->voice = voice;
    *out = &s->sink;
    return IL_OK;
}

void il_select_free(il_sink *sink)
{
    select_stage *s = (select_stage *)sink;
    if (s)
        il_free(s->matched);
    il_free(s);
}
