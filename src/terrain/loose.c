#include "config.h"
#include "terrain/loose.h"
#include "base/alloc.h"
#include "model/order.h"

#include <stdlib.h>

/* An end inside the map: of line LINE, so long, at (x, y); place: which of all places of ends it
 * is. */
typedef struct end {
    uint32_t line, place;
    int32_t level;
    double length, at[2];
} end;

/* end[n]: by level, then position, then length, then line.  count[place]: how many lines still
 * end there, of which next[place] or one behind it is the first, and so the shortest.  of[2*l],
 * of[2*l + 1]: the ends of line l, UINT32_MAX for none.  due: places to look at. */
typedef struct ends {
    il_chart_line *line;
    const il_slice *slice;
    const il_complaint *complaint;
    end *end;
    size_t n, n_places, n_due;
    uint32_t *next, *count, *of, *due;
} ends;

static int compare_ends(const void *pa, const void *pb)
{
    const end *a = pa, *b = pb;
    if (a->level != b->level)
        return a->level < b->level ? -1 : 1;
    int c = il_vertex_compare(a->at, b->at);
    if (c == 0)
        c = (a->length > b->length) - (a->length < b->length);
    return c != 0 ? c : (a->line > b->line) - (a->line < b->line);
}

/* Lines and the frame's ends are both by level and ring. */
static void list_ends(ends *e, size_t n_lines, const il_frame *frame)
{
    uint32_t l = 0;
    for (size_t k = 0; k < frame->n_inside; k++) {
        const il_frame_end *in = &frame->inside[k];
        while (l < n_lines && (e->line[l].level != (int32_t)in->level || e->line[l].ring != (int32_t)in->ring))
            l++;
        const il_ring *r = il_chart_ring(e->slice, e->line, l);
        const double *p = r->xy + (in->last ? 2 * (r->n - 1) : 0);
        e->end[e->n++] = (end){ l, 0, (int32_t)in->level, il_ring_length(r), { p[0], p[1] } };
    }
    qsort(e->end, e->n, sizeof *e->end, compare_ends);
}

static void number_places(ends *e, size_t n_lines)
{
    for (size_t k = 0; k < 2 * n_lines; k++)
        e->of[k] = UINT32_MAX;
    for (uint32_t k = 0; k < e->n; k++) {
        end *at = &e->end[k];
        if (k == 0 || at->level != at[-1].level || il_vertex_compare(at->at, at[-1].at) != 0)
            e->next[e->n_places++] = k;
        at->place = (uint32_t)(e->n_places - 1);
        e->count[at->place]++;
        e->of[2 * (size_t)at->line + (e->of[2 * (size_t)at->line] != UINT32_MAX)] = k;
    }
}

/* A line goes: where its ends were, an odd number may be left. */
static void leave_out(ends *e, uint32_t l, const double at[2])
{
    e->line[l].left_out = true;
    il_complaint_left_out(e->complaint, l, at, "it ends inside the map");
    for (size_t k = 2 * (size_t)l; k < 2 * (size_t)l + 2; k++) {
        if (e->of[k] == UINT32_MAX)
            continue;
        uint32_t place = e->end[e->of[k]].place;
        e->count[place]--;
        e->due[e->n_due++] = place;
    }
}

static void settle(ends *e)
{
    for (uint32_t p = (uint32_t)e->n_places; p-- > 0;)
        e->due[e->n_due++] = p;
    while (e->n_due > 0) {
        uint32_t p = e->due[--e->n_due];
        if (e->count[p] % 2 == 0)
            continue;
        while (e->line[e->end[e->next[p]].line].left_out)
            e->next[p]++;
        leave_out(e, e->end[e->next[p]].line, e->end[e->next[p]].at);
    }
}

il_status il_loose_leave_out(il_chart_line *line, size_t n_lines, const il_slice *slice, const il_frame *frame,
                             const il_complaint *complaint, il_error *err)
{
    ends e = { .line = line, .slice = slice, .complaint = complaint };
    size_t n = frame->n_inside;
    if (n == 0)
        return IL_OK;
    e.end = il_alloc(n, sizeof *e.end);
    e.next = il_alloc(n, sizeof *e.next);
    e.count = il_calloc(n, sizeof *e.count);
    e.of = il_alloc(2 * n_lines, sizeof *e.of);
    e.due = il_alloc(3 * n, sizeof *e.due);
    bool ok = e.end && e.next && e.count && e.of && e.due;
    if (ok) {
        list_ends(&e, n_lines, frame);
        number_places(&e, n_lines);
        settle(&e);
    }
    il_free(e.end);
    il_free(e.next);
    il_free(e.count);
    il_free(e.of);
    il_free(e.due);
    return ok ? IL_OK : il_fail_nomem(err);
}
