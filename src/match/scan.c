#include "config.h"
#include "match/scan.h"
#include "base/alloc.h"

#include <stdlib.h>

void il_scan_free(il_scan *s)
{
    il_free(s->crossing);
    *s = (il_scan)IL_SCAN_INIT;
}

void il_scan_begin(il_scan *s, const double box[4])
{
    for (int k = 0; k < 4; k++)
        s->box[k] = box[k];
    s->step = (box[3] - box[1]) / IL_SCAN_LINES;
    s->n = 0;
}

/* How many lines lie below Y.  Edges that meet ask for the same Y, so that between them no
 * line is lost or met twice. */
static int lines_below(const il_scan *s, double y)
{
    double at = (y - s->box[1]) / s->step + 0.5;
    return at < 0 ? 0 : at > IL_SCAN_LINES ? IL_SCAN_LINES : (int)at;
}

void il_scan_add(il_scan *s, int side, const il_segment *e)
{
    int a = lines_below(s, e->ay), b = lines_below(s, e->by), from = a < b ? a : b, to = a < b ? b : a;
    double least = e->ax < e->bx ? e->ax : e->bx;
    if (from == to || least > s->box[2])
        return;
    if (!il_grow(&s->crossing, &s->cap, s->n + (size_t)(to - from), sizeof *s->crossing)) {
        s->no_memory = true;
        return;
    }
    for (int line = from; line < to; line++) {
        double y = s->box[1] + (line + 0.5) * s->step, x = e->ax + (y - e->ay) / (e->by - e->ay) * (e->bx - e->ax);
        x = x < s->box[0] ? s->box[0] : x > s->box[2] ? s->box[2] : x;
        s->crossing[s->n++] = (il_crossing){ x, (uint16_t)line, (unsigned char)side, a < b ? -1 : 1 };
    }
}

static int compare_crossings(const void *pa, const void *pb)
{
    const il_crossing *a = pa, *b = pb;
    if (a->line != b->line)
        return a->line < b->line ? -1 : 1;
    if (a->x != b->x)
        return a->x < b->x ? -1 : 1;
    return 2 * (a->side - b->side) + (a->enters > b->enters) - (a->enters < b->enters);
}

il_status il_scan_measure(il_scan *s, double *own, double *common, il_error *err)
{
    int in[2] = { 0, 0 };
    *own = *common = 0;
    if (s->no_memory)
        return il_fail_nomem(err);
    if (s->n > 0)
        qsort(s->crossing, s->n, sizeof *s->crossing, compare_crossings);
    for (size_t i = 0; i < s->n; i++) {
        const il_crossing *c = &s->crossing[i];
        if (i == 0 || c->line != c[-1].line)
            in[0] = in[1] = 0; /* what lies to the right was not told */
        else if (in[0] > 0) {
            *own += (c->x - c[-1].x) * s->step;
            *common += in[1] > 0 ? (c->x - c[-1].x) * s->step : 0;
        }
        in[c->side] += c->enters;
        if (i + 1 == s->n || c[1].line != c->line) {
            double rest = (s->box[2] - c->x) * s->step;
            *own += in[0] > 0 ? rest : 0;
            *common += in[0] > 0 && in[1] > 0 ? rest : 0;
        }
    }
    return IL_OK;
}
