#include "config.h"
#include "input/map-stack.h"
#include "base/alloc.h"
#include "model/spots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Lines in the order of height; those of one height as they came. */
static int compare(const void *a, const void *b)
{
    const il_map_line *p = *(il_map_line *const *)a, *q = *(il_map_line *const *)b;
    if (p->height != q->height)
        return p->height < q->height ? -1 : 1;
    return p < q ? -1 : p > q;
}

/* The lines with a height, sorted; *N of them. */
static il_map_line **sort_lines(il_map *m, size_t *n)
{
    il_map_line **sorted = il_alloc(m->n_lines, sizeof *sorted);
    *n = 0;
    for (size_t i = 0; i < m->n_lines && sorted; i++)
        if (!isnan(m->line[i].height))
            sorted[(*n)++] = &m->line[i];
    if (sorted)
        qsort(sorted, *n, sizeof *sorted, compare);
    return sorted;
}

static bool add_line(const il_map *m, il_slice *s, const il_map_line *l)
{
    il_ring *r = il_slice_add_ring(s);
    if (!r)
        return false;
    r->open = !l->closed;
    r->file = l->file;
    r->line = l->line;
    r->feature = il_map_feature_of(m, l);
    for (size_t k = l->begin; k < l->begin + l->n; k++)
        if (!il_ring_add(r, m->xy[2 * k], m->xy[2 * k + 1], m->mark ? m->mark[k] : 0))
            return false;
    return true;
}

/* The lines SORTED[0..N) are one level. */
static il_status emit_level(const il_map *m, il_map_line *const *sorted, size_t n, il_sink *sink, il_error *err)
{
    il_slice s = IL_SLICE_INIT;
    il_status st = IL_OK;
    s.z = sorted[0]->height + 0.0;
    s.line = sorted[0]->line;
    for (size_t i = 0; i < n && st == IL_OK; i++)
        if (!add_line(m, &s, sorted[i]))
            st = il_fail_nomem(err);
    if (st == IL_OK)
        st = sink->slice(sink, &s, err);
    il_slice_free(&s);
    return st;
}

static il_status emit_levels(const il_map *m, il_map_line *const *sorted, size_t n, il_sink *sink, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0, j; i < n && st == IL_OK; i = j) {
        for (j = i + 1; j < n && sorted[j]->height == sorted[i]->height;)
            j++;
        st = emit_level(m, sorted + i, j - i, sink, err);
    }
    return st;
}

static bool set_crs(il_stack_head *head, const char *crs)
{
    char name[40];
    const char *text = il_crs_short(crs, name, sizeof name);
    head->crs = text ? il_strndup(text, strlen(text)) : NULL;
    return !text || head->crs;
}

/* The head has them from here on. */
static void hand_spots(il_map *m, il_stack_head *head)
{
    head->spot = m->spot;
    head->n_spots = m->n_spots;
    head->cap_spots = m->cap_spots;
    m->spot = NULL;
    m->n_spots = m->cap_spots = 0;
    il_stack_head_settle_spots(head, m->report);
    if (head->n_spots > 0)
        il_report_note(m->report, "spot heights: %zu", head->n_spots);
}

il_status il_map_emit(il_map *m, il_sink *sink, il_error *err)
{
    il_stack_head head = IL_STACK_HEAD_INIT;
    size_t n = 0;
    head.kind = IL_KIND_TERRAIN;
    head.unit = m->unit;
    head.line = 1;
    head.has_geographic = m->is_projected;
    head.projection = m->projection;
    memcpy(head.geographic, m->box, sizeof head.geographic);
    il_map_line **sorted = sort_lines(m, &n);
    bool ok = sorted && il_stack_head_set_name(&head, "", 0) && il_stack_head_set_files(&head, m->file, m->n_files) &&
              set_crs(&head, m->crs);
    il_status st = ok ? IL_OK : il_fail_nomem(err);
    if (ok)
        hand_spots(m, &head);
    if (st == IL_OK)
        st = sink->stack_begin(sink, &head, err);
    if (st == IL_OK)
        st = emit_levels(m, sorted, n, sink, err);
    if (st == IL_OK)
        st = sink->stack_end(sink, err);
    il_free(sorted);
    il_stack_head_free(&head);
    return st;
}
