#include "config.h"
#include "output/links.h"
#include "base/alloc.h"
#include "output/native.h"

#include <stdlib.h>

/* z, rings: of the last two slices of this stack.  n_begun: stacks so far.  n_mute: slabs of this
 * one whose records do not tell. */
typedef struct writer {
    il_sink sink;
    il_output *to;
    il_report *report;
    bool begun;
    double z[2];
    size_t rings[2];
    size_t n_begun, n_mute;
    il_link *link;          size_t n, cap;
} writer;

/* A link without a word of why has the reason GIVEN, and a reach below 0. */
static bool add_link(writer *w, il_link l)
{
    if (!il_grow(&w->link, &w->cap, w->n + 1, sizeof *w->link))
        return false;
    w->link[w->n++] = l;
    return true;
}

static bool tie(writer *w, uint32_t lower, uint32_t upper)
{
    return add_link(w, (il_link){ lower, upper, IL_LINK_GIVEN, -1 });
}

/* The links of G; when it has none, the fewest that make it one. */
static bool add_group(writer *w, const il_group *g)
{
    bool ok = true;
    for (size_t i = 0; i < g->n_links && ok; i++)
        ok = add_link(w, g->link[i]);
    if (g->n_links > 0 || g->n_lower == 0 || g->n_upper == 0)
        return ok;
    for (size_t i = 0; i < g->n_lower && ok; i++)
        ok = tie(w, g->lower[i], g->upper[0]);
    for (size_t i = 1; i < g->n_upper && ok; i++)
        ok = tie(w, g->lower[0], g->upper[i]);
    return ok;
}

/* All rings are one group. */
static bool add_all(writer *w)
{
    bool ok = true;
    for (uint32_t i = 0; i < w->rings[0] && w->rings[1] > 0 && ok; i++)
        ok = tie(w, i, 0);
    for (uint32_t i = 1; i < w->rings[1] && w->rings[0] > 0 && ok; i++)
        ok = tie(w, 0, i);
    return ok;
}

static int compare_links(const void *pa, const void *pb)
{
    const il_link *a = pa, *b = pb;
    if (a->lower != b->lower)
        return a->lower < b->lower ? -1 : 1;
    return (a->upper > b->upper) - (a->upper < b->upper);
}

static void write_slab(writer *w)
{
    il_output_string(w->to, "slab");
    il_native_put_number(w->to, w->z[0]);
    il_native_put_number(w->to, w->z[1]);
    il_output_char(w->to, '\n');
    if (w->n > 1)
        qsort(w->link, w->n, sizeof *w->link, compare_links);
    for (size_t i = 0; i < w->n; i++) {
        il_output_string(w->to, "link");
        il_native_put_index(w->to, w->link[i].lower);
        il_native_put_index(w->to, w->link[i].upper);
        if (w->link[i].reach >= 0) {
            il_output_char(w->to, ' ');
            il_output_string(w->to, il_link_reason_word(w->link[i].reason));
            il_native_put_number(w->to, w->link[i].reach);
        }
        il_output_char(w->to, '\n');
    }
}

static void begin(writer *w)
{
    if (!w->begun)
        il_output_string(w->to, "isoloft-links 1\n");
    w->begun = true;
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    writer *w = (writer *)self;
    begin(w);
    w->n_begun++;
    w->n_mute = 0;
    if (head->kind == IL_KIND_TERRAIN)
        return IL_OK;
    il_output_string(w->to, "stack ");
    il_output_integer(w->to, head->has_number ? head->number : (long)w->n_begun);
    il_native_put_string(w->to, il_stack_head_name(head));
    il_output_char(w->to, '\n');
    return il_output_status(w->to, err);
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    writer *w = (writer *)self;
    (void)err;
    w->z[0] = w->z[1];
    w->rings[0] = w->rings[1];
    w->z[1] = s->z;
    w->rings[1] = s->n;
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *p, il_error *err)
{
    writer *w = (writer *)self;
    bool mute = p->n_groups == 0 && p->matcher == IL_MATCHER_NONE, ok = true;
    w->n = 0;
    w->n_mute += mute && !p->gap;
    if (mute || p->gap)
        return IL_OK;
    for (size_t i = 0; i < p->n_groups && ok; i++)
        ok = add_group(w, &p->group[i]);
    if (p->n_groups == 0)
        ok = add_all(w);
    if (!ok)
        return il_fail_nomem(err);
    write_slab(w);
    return il_output_status(w->to, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    writer *w = (writer *)self;
    if (w->n_mute > 0)
        il_report_note(w->report, "the records of %zu pair%s of slices do not tell which rings belong together: "
                       "--links-out leaves them out", w->n_mute, w->n_mute == 1 ? "" : "s");
    return il_output_status(w->to, err);
}

static il_status on_end(il_sink *self, il_error *err)
{
    writer *w = (writer *)self;
    begin(w);
    return il_output_status(w->to, err);
}

il_status il_links_writer_new(il_sink **out, il_output *to, il_report *report, il_error *err)
{
    writer *w = il_calloc(1, sizeof *w);
    *out = w ? &w->sink : NULL;
    if (!w)
        return il_fail_nomem(err);
    *w = (writer){ .sink = { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, .to = to, .report = report };
    return IL_OK;
}

void il_links_writer_free(il_sink *s)
{
    writer *w = (writer *)s;
    if (w)
        il_free(w->link);
    il_free(w);
}
