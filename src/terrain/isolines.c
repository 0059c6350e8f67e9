#include "config.h"
#include "terrain/isolines.h"
#include "base/alloc.h"
#include "model/order.h"
#include "terrain/cutter.h"
#include "terrain/ground.h"
#include "terrain/map-edge.h"

#include <math.h>

/* slice[n_slices]: the levels of the terrain at hand, as they came.  n_lines, n_levels: put in. */
typedef struct isolines {
    il_sink sink;
    il_relief_options options;
    size_t n_between;
    il_sink *next;
    il_report *report;
    bool is_terrain;
    il_stack_head head;
    il_slice *slice;         size_t n_slices, cap;
    size_t n_lines, n_levels, n_pairs;
} isolines;

static void free_slices(il_slice *slice, size_t n)
{
    for (size_t k = 0; slice && k < n; k++)
        il_slice_free(&slice[k]);
}

/* ---- levels ---------------------------------------------------------------------- */

/* Heights this much shorter than their distance are the same; so they have few decimals. */
static const double SAME = 1e-8;

/* The height I of N between LOW and HIGH. */
static double find_height(double low, double high, size_t i, size_t n)
{
    double exact = (low * (double)(n + 1 - i) + high * (double)i) / (double)(n + 1);
    double z = il_placement_shorten(exact, (high - low) / (double)(n + 1) * SAME, round);
    return z > low && z < high ? z : exact;
}

static il_status give_level(isolines *s, il_cutter *c, size_t band, double z, il_error *err)
{
    il_slice level = IL_SLICE_INIT;
    level.z = z;
    il_status st = il_cutter_cut(c, band, z, &level, err);
    if (st == IL_OK && level.n > 0) {
        il_slice_put_in_order(&level);
        s->n_levels++;
        s->n_lines += level.n;
        st = s->next->slice(s->next, &level, err);
    }
    il_slice_free(&level);
    return st;
}

/* Levels too close for that many heights between them get fewer. */
static il_status give_band(isolines *s, il_cutter *c, const double *level, size_t band, il_error *err)
{
    il_status st = IL_OK;
    double before = level[band], high = level[band + 1];
    for (size_t i = 1; i <= s->n_between && st == IL_OK; i++) {
        double z = find_height(level[band], high, i, s->n_between);
        if (!(z > before && z < high))
            continue;
        st = give_level(s, c, band, z, err);
        before = z;
    }
    return st;
}

static il_status give_levels(isolines *s, const il_ground *g, il_error *err)
{
    il_cutter c = { 0 };
    il_status st = il_cutter_build(&c, &g->skin, g->level_z, g->n_slices, err);
    if (st == IL_OK)
        st = s->next->stack_begin(s->next, &s->head, err);
    for (size_t k = 0; k < s->n_slices && st == IL_OK; k++) {
        st = s->next->slice(s->next, &s->slice[k], err);
        if (st == IL_OK && k < c.n_bands)
            st = give_band(s, &c, g->level_z, k, err);
    }
    il_cutter_free(&c);
    return st == IL_OK ? s->next->stack_end(s->next, err) : st;
}

/* ---- the surface -------------------------------------------------------------------- */

/* *TO: copies of the slices, which the surface may mark. */
static il_status copy_slices(const isolines *s, il_slice **to, il_error *err)
{
    il_status st = IL_OK;
    *to = il_calloc(s->n_slices, sizeof **to);
    if (!*to)
        return il_fail_nomem(err);
    for (size_t k = 0; k < s->n_slices && st == IL_OK; k++)
        st = il_slice_copy(&(*to)[k], &s->slice[k], err);
    return st;
}

static il_status make_ground(isolines *s, il_ground *g, il_slice *slice, il_error *err)
{
    size_t n_marked = 0;
    il_status st = il_map_edge_mark(slice, s->n_slices, &s->options.frame, g->head, &n_marked, err);
    g->slice = slice;
    return st == IL_OK ? il_ground_make(g, err) : st;
}

static void tell(isolines *s)
{
    il_report_note(s->report, "%zu isolines at %zu heights are interpolated between those of the map", s->n_lines, s->n_levels);
    if (s->n_pairs > 0)
        il_report_note(s->report, "%zu pair records are left out: there are other levels between theirs now", s->n_pairs);
}

static il_status give_stack(isolines *s, il_error *err)
{
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_slice *slice = NULL;
    il_ground g = { .options = &s->options, .head = &head, .n_slices = s->n_slices, .report = s->report };
    s->n_lines = s->n_levels = 0;
    il_status st = il_stack_head_copy(&head, &s->head, err);
    if (st == IL_OK)
        st = copy_slices(s, &slice, err);
    if (st == IL_OK)
        st = make_ground(s, &g, slice, err);
    if (st == IL_OK)
        st = give_levels(s, &g, err);
    if (st == IL_OK)
        tell(s);
    il_ground_free(&g);
    free_slices(slice, s->n_slices);
    il_free(slice);
    il_stack_head_free(&head);
    return st;
}

/* ---- the sink ------------------------------------------------------------------------- */

static void forget(isolines *s)
{
    free_slices(s->slice, s->n_slices);
    s->n_slices = s->n_pairs = 0;
}

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    isolines *s = (isolines *)self;
    forget(s);
    s->is_terrain = head->kind == IL_KIND_TERRAIN;
    if (!s->is_terrain)
        return s->next->stack_begin(s->next, head, err);
    il_stack_head_free(&s->head);
    return il_stack_head_copy(&s->head, head, err);
}

/* Between the levels of a map that has but one there is nothing. */
static il_status give_as_is(isolines *s, il_error *err)
{
    il_status st = s->next->stack_begin(s->next, &s->head, err);
    for (size_t k = 0; k < s->n_slices && st == IL_OK; k++)
        st = s->next->slice(s->next, &s->slice[k], err);
    return st == IL_OK ? s->next->stack_end(s->next, err) : st;
}

static il_status slice(il_sink *self, il_slice *slice, il_error *err)
{
    isolines *s = (isolines *)self;
    if (!s->is_terrain)
        return s->next->slice(s->next, slice, err);
    if (!il_grow(&s->slice, &s->cap, s->n_slices + 1, sizeof *s->slice))
        return il_fail_nomem(err);
    s->slice[s->n_slices++] = *slice;
    *slice = (il_slice)IL_SLICE_INIT;
    return IL_OK;
}

static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    isolines *s = (isolines *)self;
    s->n_pairs += s->is_terrain;
    return s->is_terrain ? IL_OK : s->next->pair(s->next, p, err);
}

static il_status stack_end(il_sink *self, il_error *err)
{
    isolines *s = (isolines *)self;
    if (!s->is_terrain)
        return s->next->stack_end(s->next, err);
    il_status st = s->n_slices < 2 ? give_as_is(s, err) : give_stack(s, err);
    forget(s);
    return st;
}

static il_status end(il_sink *self, il_error *err)
{
    isolines *s = (isolines *)self;
    return s->next->end(s->next, err);
}

il_status il_isolines_new(il_sink **out, const il_relief_options *o, size_t n, il_sink *next, il_report *report, il_error *err)
{
    isolines *s = il_calloc(1, sizeof *s);
    *out = s ? &s->sink : NULL;
    if (!s)
        return il_fail_nomem(err);
    *s = (isolines){ .sink = { stack_begin, slice, pair, stack_end, end }, .options = *o, .n_between = n, .next = next,
                     .report = report };
    s->options.placement = (il_placement_options)IL_PLACEMENT_OPTIONS_INIT;
    return IL_OK;
}

void il_isolines_free(il_sink *self)
{
    isolines *s = (isolines *)self;
    if (!s)
        return;
    forget(s);
    il_free(s->slice);
    il_stack_head_free(&s->head);
    il_free(s);
}
