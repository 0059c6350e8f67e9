#include "config.h"
#include "terrain/field-near.h"
#include "base/alloc.h"

#include <math.h>

/* Of the sweeps: what lies round two corners of its band is rare, and near enough then. */
enum { ROUNDS = 2 };

uint32_t il_field_slide(const il_field *f, uint32_t e, double x, double y, double *distance2)
{
    double t, best = il_field_distance2(f, e, x, y, &t);
    for (int way = 0; way < 2; way++) {
        uint32_t at = e;
        while (way == 0 ? f->line[at].after : f->line[at].before) {
            at += way == 0 ? 1 : UINT32_MAX; /* one less, modulo 2^32 */
            double d = il_field_distance2(f, at, x, y, &t);
            if (!(d < best))
                break;
            best = d;
            e = at;
        }
    }
    *distance2 = best;
    return e;
}

/* distance2[2 * node + side]: to the nearest so far. */
typedef struct search {
    il_field *f;
    double *distance2;
} search;

/* Edge E, if it is nearer to node (i, j) than what that has, and with SLIDE those that adjoin it. */
static void consider(search *s, size_t i, size_t j, size_t side, uint32_t e, bool slide)
{
    il_field *f = s->f;
    size_t k = 2 * (i + f->n[0] * j) + side;
    if (e == IL_CHART_NONE || f->near[k] == e || (slide && il_field_adjoins(f, f->near[k], e)))
        return; /* those that adjoin what it has were looked at */
    double d, t, x = f->at[0] + (double)i * f->step, y = f->at[1] + (double)j * f->step;
    if (slide)
        e = il_field_slide(f, e, x, y, &d);
    else
        d = il_field_distance2(f, e, x, y, &t);
    if (d < s->distance2[k]) {
        s->distance2[k] = d;
        f->near[k] = e;
    }
}

/* ---- beside the lines -------------------------------------------------------------- */

static size_t cell_of(const il_field *f, int axis, double v)
{
    double k = floor((v - f->at[axis]) / f->step), most = (double)f->n[axis] - 1;
    return k > 0 ? (size_t)(k < most ? k : most) : 0;
}

/* What is done with each cell (i, j) that edge E passes through. */
typedef void visitor(search *s, size_t i, size_t j, uint32_t e);

/* Row by row. */
static void visit_edge(search *s, uint32_t e, visitor *visit)
{
    const il_field *f = s->f;
    const il_field_line *l = &f->line[e];
    double low[2] = { l->ax, l->ay }, high[2] = { l->bx, l->by };
    if (l->ay > l->by)
        low[0] = l->bx, low[1] = l->by, high[0] = l->ax, high[1] = l->ay;
    for (size_t j = cell_of(f, 1, low[1]); j <= cell_of(f, 1, high[1]); j++) {
        double from = f->at[1] + (double)j * f->step, to = from + f->step;
        double slope = high[1] > low[1] ? (high[0] - low[0]) / (high[1] - low[1]) : 0;
        double x = from > low[1] ? low[0] + slope * (from - low[1]) : low[0];
        double y = to < high[1] ? low[0] + slope * (to - low[1]) : high[0];
        for (size_t i = cell_of(f, 0, x < y ? x : y); i <= cell_of(f, 0, x < y ? y : x); i++)
            visit(s, i, j, e);
    }
}

static void visit_edges(search *s, visitor *visit)
{
    for (size_t e = 0; e < s->f->n_lines; e++)
        if (s->f->line[e].level >= 0)
            visit_edge(s, (uint32_t)e, visit);
}

/* The nodes of the cell, on whichever side of the edge they are. */
static void seed_cell(search *s, size_t i, size_t j, uint32_t e)
{
    const il_field_line *l = &s->f->line[e];
    for (size_t k = 0; k < 4; k++) {
        size_t x = i + k % 2, y = j + k / 2;
        if (x >= s->f->n[0] || y >= s->f->n[1])
            continue;
        for (int side = 0; side < 2; side++)
            if (l->face[side] != IL_CHART_NONE && s->f->face[x + s->f->n[0] * y] == l->face[side])
                consider(s, x, y, !l->above[side], e, false);
    }
}

static void count_cell(search *s, size_t i, size_t j, uint32_t e)
{
    (void)e;
    s->f->first[i + s->f->n[0] * j + 2]++;
}

static void list_cell(search *s, size_t i, size_t j, uint32_t e)
{
    s->f->through[s->f->first[i + s->f->n[0] * j + 1]++] = e;
}

/* The edges of each cell.  False without memory, or with 2^32 of them. */
static bool list_edges(search *s)
{
    il_field *f = s->f;
    size_t n = il_field_size(f), sum = 0;
    f->first = il_calloc(n + 2, sizeof *f->first);
    if (!f->first)
        return false;
    visit_edges(s, count_cell);
    for (size_t k = 2; k < n + 2; k++) {
        sum += f->first[k];
        f->first[k] = (uint32_t)sum;
    }
    f->through = sum < UINT32_MAX ? il_alloc(sum, sizeof *f->through) : NULL;
    if (f->through)
        visit_edges(s, list_cell);
    return f->through != NULL;
}

/* ---- from node to node ----------------------------------------------------------------- */

/* Take what the four nodes beside (i, j) have that a sweep by STEP has passed already. */
static void pass_on(search *s, size_t i, size_t j, int step)
{
    static const int AROUND[4][2] = { { -1, 0 }, { -1, -1 }, { 0, -1 }, { 1, -1 } };
    const il_field *f = s->f;
    size_t at = i + f->n[0] * j;
    if (f->face[at] == IL_CHART_NONE)
        return;
    for (int k = 0; k < 4; k++) {
        size_t x = i + (size_t)(step * AROUND[k][0]), y = j + (size_t)(step * AROUND[k][1]); /* -1 wraps beyond n */
        if (x >= f->n[0] || y >= f->n[1] || f->face[x + f->n[0] * y] != f->face[at])
            continue;
        for (size_t side = 0; side < 2; side++)
            consider(s, i, j, side, f->near[2 * (x + f->n[0] * y) + side], true);
    }
}

static void sweep(search *s)
{
    const il_field *f = s->f;
    for (size_t j = 0; j < f->n[1]; j++)
        for (size_t i = 0; i < f->n[0]; i++)
            pass_on(s, i, j, 1);
    for (size_t j = f->n[1]; j-- > 0;)
        for (size_t i = f->n[0]; i-- > 0;)
            pass_on(s, i, j, -1);
}

/* ---- widths ---------------------------------------------------------------------------------- */

/* 64 bins an octave, from 2^-16 to 2^16 steps. */
enum { OCTAVES = 32, BINS = 64 * OCTAVES };

static size_t bin_of(double w)
{
    int octave;
    double part = frexp(fmin(fmax(w, 0x1p-16), 0x1p15), &octave);
    return 64 * (size_t)(octave + OCTAVES / 2 - 1) + (size_t)(128 * (part - 0.5));
}

static double width_of(size_t bin)
{
    return ldexp(0.5 + ((double)(bin % 64) + 0.5) / 128, (int)(bin / 64) - OCTAVES / 2 + 1);
}

/* The median of the distances of the two lines over the nodes that lie between two; where none does,
 * four times the mean distance to the line, which is what it would be between lines. */
static void find_width(search *s)
{
    il_field *f = s->f;
    size_t count[BINS + 1] = { 0 }, n = 0, sum = 0, n_caps = 0, bin = 0;
    double caps = 0;
    for (size_t k = 0; k < il_field_size(f); k++) {
        double low = sqrt(s->distance2[2 * k]), high = sqrt(s->distance2[2 * k + 1]);
        if (isfinite(low) && isfinite(high)) {
            count[bin_of((low + high) / f->step)]++;
            n++;
        } else if (isfinite(fmin(low, high))) {
            caps += fmin(low, high);
            n_caps++;
        }
    }
    while (n > 0 && 2 * (sum + count[bin]) < n)
        sum += count[bin++];
    f->width = n > 0 ? f->step * width_of(bin) : n_caps > 0 ? 4 * caps / (double)n_caps : f->step;
}

bool il_field_find_near(il_field *f)
{
    search s = { f, il_alloc(2 * il_field_size(f), sizeof *s.distance2) };
    f->near = il_alloc(2 * il_field_size(f), sizeof *f->near);
    bool ok = s.distance2 && f->near && list_edges(&s);
    for (size_t k = 0; ok && k < 2 * il_field_size(f); k++) {
        f->near[k] = IL_CHART_NONE;
        s.distance2[k] = INFINITY;
    }
    if (ok) {
        visit_edges(&s, seed_cell);
        for (int round = 0; round < ROUNDS; round++)
            sweep(&s);
        find_width(&s);
    }
    il_free(s.distance2);
    return ok;
}
