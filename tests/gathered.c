#include "config.h"
#include "gathered.h"
#include "base/alloc.h"
#include "input/native.h"
#include "input/reader.h"

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    gathered *g = (gathered *)self;
    if (g->n > 0)
        return il_fail(err, IL_E_INPUT, head->line, "there is a second stack");
    il_stack_head_free(&g->head);
    return il_stack_head_copy(&g->head, head, err);
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    gathered *g = (gathered *)self;
    if (!il_grow(&g->slice, &g->cap, g->n + 1, sizeof *g->slice) || !il_grow(&g->pair, &g->cap_pairs, g->n + 1, sizeof *g->pair))
        return il_fail_nomem(err);
    g->pair[g->n] = (il_pair)IL_PAIR_INIT;
    g->slice[g->n++] = *s;
    *s = (il_slice)IL_SLICE_INIT;
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *p, il_error *err)
{
    gathered *g = (gathered *)self;
    (void)err;
    il_pair_free(&g->pair[g->n - 1]);
    g->pair[g->n - 1] = *p;
    *p = (il_pair)IL_PAIR_INIT;
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

il_status gathered_read(gathered *g, const char *path, il_error *err)
{
    il_read_options o = IL_READ_OPTIONS_INIT;
    il_source *source = NULL;
    *g = (gathered){ .sink = { on_stack, on_slice, on_pair, on_end, on_end } };
    il_status st = il_source_open(&source, path, err);
    if (st == IL_OK)
        st = il_reader_loft.read(&source, 1, &o, &g->sink, NULL, err);
    il_source_close(source);
    return st;
}

void gathered_free(gathered *g)
{
    for (size_t k = 0; k < g->n; k++) {
        il_slice_free(&g->slice[k]);
        il_pair_free(&g->pair[k]);
    }
    il_free(g->slice);
    il_free(g->pair);
    il_stack_head_free(&g->head);
}
