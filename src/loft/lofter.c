/* lofter.c - the stage of lofter.h: slices in, certified pieces of mesh out. */
#include "config.h"
#include "loft/lofter.h"
#include "base/alloc.h"
#include "base/number.h"
#include "loft/emit.h"
#include "loft/window.h"

#include <stdio.h>
#include <string.h>

/* What joins two slices is told behind the upper one, so the last slice waits for
 * it.  Slices that follow one another without a gap are a run: each is closed at
 * its ends as the stack is.  With domes the first of a run waits for the second,
 * whose distance tells how far the dome reaches. */
typedef struct lofter {
    il_sink sink;
    il_loft_options options;
    il_mesh_sink *next;
    il_window window;
    il_emitter emitter;
    il_stack_head head;       /* of the stack at hand, for messages */
    int32_t stack, n_slices;
    const int32_t *number;    /* null: stacks are counted */
    il_section newest;        /* the last slice, while it is due */
    bool due;
    double z, spacing;        /* of the slice before it, and from the one before that */
    size_t n_run;             /* slices of the run so far, without the newest */
    bool hollow;              /* the last of them is empty */
    il_section start;         /* domes: the first of the run, while it is alone */
    double gap;               /* below the run; 0 at the begin of the stack */
    bool open;                /* next was told to begin and not yet to end */
    size_t n_slabs;
} lofter;

/* ---- the window, filled and emptied ---- */

static void place_name(const lofter *l, const il_window_place *p, char to[64])
{
    char z[IL_NUMBER_MAX];
    il_number_format(z, p->section.z);
    if (!p->beyond)
        snprintf(to, 64, "slice %d (z = %s)", (int)p->slice, z);
    else
        snprintf(to, 64, p->slice < 0 || p->slice >= l->n_slices ? "the end" : "the gap");
}

static void name_point(const double at[3], char to[128])
{
    char text[3][IL_NUMBER_MAX];
    for (int k = 0; k < 3; k++)
        il_number_format_float(text[k], (float)at[k]);
    snprintf(to, 128, ", near (%s, %s, %s)", text[0], text[1], text[2]);
}

/* Failure of slab P in words that name stack, slices and place. */
static il_status explain(lofter *l, size_t p, il_error *err)
{
    const il_window_place *low = il_window_at(&l->window, p), *high = il_window_at(&l->window, p + 1);
    const il_verdict *v = &low->slab.verdict;
    char below[64], above[64], near[128] = "";
    if (low->status != IL_E_SURFACE) {
        *err = low->error;
        return low->status;
    }
    place_name(l, low, below);
    place_name(l, high, above);
    if (v->flaw != IL_FLAW_REFERENCE)
        name_point(v->at, near);
    return il_fail(err, IL_E_SURFACE, 0, "stack \"%.60s\": no sound surface between %s and %s%s: %s%s",
                   il_stack_head_name(&l->head), below, above, near, il_flaw_words(v->flaw),
                   l->options.round_float ? " (in the 32-bit numbers of STL; PLY and OBJ hold finer ones)" : "");
}

/* Emit what is ready; with the mutex held, given up while emitting.  The next
 * slab must be sound too: its triangles tell where rings part that touch. */
static il_status emit_ready(lofter *l, il_error *err)
{
    il_window *w = &l->window;
    il_status st = IL_OK;
    while (st == IL_OK && il_window_ready(w)) {
        for (size_t p = w->first; p < w->first + 2 && il_window_has_slab(w, p); p++)
            if (il_window_at(w, p)->status != IL_OK)
                return explain(l, p, err);
        pthread_mutex_unlock(&w->crew.mutex);
        st = il_emitter_slab(&l->emitter, w, err);
        if (st == IL_OK && l->options.progress)
            l->options.progress(l->options.progress_self, ++l->n_slabs);
        pthread_mutex_lock(&w->crew.mutex);
        if (st == IL_OK)
            il_window_pop(w);
    }
    return st;
}

/* SECTION is taken over, and so is PAIR (or null): what is known of it and the
 * section before. */
static il_status push(lofter *l, il_section *section, int32_t slice, bool beyond, il_pair *pair, il_error *err)
{
    il_window *w = &l->window;
    pthread_mutex_lock(&w->crew.mutex);
    il_status st = emit_ready(l, err);
    while (st == IL_OK && w->n == IL_LOFT_WINDOW) {
        il_crew_help(&w->crew);
        st = emit_ready(l, err);
    }
    if (st == IL_OK)
        il_window_push(w, section, slice, beyond, pair);
    pthread_mutex_unlock(&w->crew.mutex);
    return st;
}

/* No more sections: emit the rest; one section is left then. */
static il_status drain(lofter *l, il_error *err)
{
    il_window *w = &l->window;
    pthread_mutex_lock(&w->crew.mutex);
    il_window_end(w);
    il_status st = emit_ready(l, err);
    while (st == IL_OK && w->n > 1) {
        il_crew_help(&w->crew);
        st = emit_ready(l, err);
    }
    pthread_mutex_unlock(&w->crew.mutex);
    return st;
}

static void clear(lofter *l)
{
    pthread_mutex_lock(&l->window.crew.mutex);
    il_window_clear(&l->window);
    pthread_mutex_unlock(&l->window.crew.mutex);
    il_emitter_free(&l->emitter);
    il_section_free(&l->newest);
    il_section_free(&l->start);
    l->due = l->hollow = false;
    l->n_run = 0;
    if (l->open)
        l->next->abandon(l->next);
    l->open = false;
}

/* ---- runs of slices ---- */

/* An empty section at Z: caps rise to half of the slab between it and SLICE. */
static il_status push_beyond(lofter *l, double z, int32_t slice, il_pair *pair, il_error *err)
{
    il_slice empty = IL_SLICE_INIT;
    il_section section = IL_SECTION_INIT;
    empty.z = l->options.round_float ? il_number_round_float(z) : z;
    il_status st = il_section_from_slice(&section, &empty, err);
    if (st == IL_OK)
        st = push(l, &section, slice, true, pair, err);
    il_section_free(&section);
    return st;
}

/* How far beyond a run's end the empty section lies: as far as the next slice, and
 * at most in the middle of the gap, which has a dome from either side. */
static double reach(double spacing, double gap)
{
    return gap > 0 && gap / 2 < spacing ? gap / 2 : spacing;
}

/* The run's first section, with the dome under it unless it is alone, and empty. */
static il_status push_start(lofter *l, bool dome, il_error *err)
{
    il_pair gap = { .gap = l->gap > 0 };
    int32_t slice = l->n_slices - (l->due ? 2 : 1);
    if (!dome)
        return push(l, &l->start, slice, false, &gap, err);
    il_status st = push_beyond(l, l->start.z - reach(l->spacing, l->gap), slice - 1, &gap, err);
    return st == IL_OK ? push(l, &l->start, slice, false, NULL, err) : st;
}

/* The run is over: GAP to the next slice, 0 at the end of the stack. */
static il_status end_run(lofter *l, double gap, il_error *err)
{
    bool dome = l->options.cap != IL_CAP_FLAT;
    int32_t last = l->n_slices - (l->due ? 2 : 1);
    if (l->n_run == 1 && !l->hollow) {
        char z[IL_NUMBER_MAX];
        il_number_format(z, l->z);
        return il_fail(err, IL_E_INPUT, l->head.line, "stack \"%.60s\": the slice at z = %s stands alone beside a gap; "
                       "it bounds no solid without a thickness (--thickness)", il_stack_head_name(&l->head), z);
    }
    if (l->n_run == 1)
        return dome ? push_start(l, false, err) : IL_OK;
    return dome ? push_beyond(l, l->z + reach(l->spacing, gap), gap > 0 ? last : last + 1, NULL, err) : IL_OK;
}

/* The newest slice begins a run: GAP above the last one, 0 at the begin of the stack. */
static il_status begin_run(lofter *l, double gap, il_error *err)
{
    il_pair between = { .gap = gap > 0 };
    l->gap = gap;
    l->n_run = 1;
    if (l->options.cap == IL_CAP_FLAT)
        return push(l, &l->newest, l->n_slices - 1, false, &between, err);
    l->start = l->newest;
    l->newest = (il_section)IL_SECTION_INIT;
    return IL_OK;
}

static il_status continue_run(lofter *l, il_pair *pair, il_error *err)
{
    il_status st = IL_OK;
    if (l->options.cap != IL_CAP_FLAT && l->n_run == 1)
        st = push_start(l, true, err);
    l->n_run++;
    return st == IL_OK ? push(l, &l->newest, l->n_slices - 1, false, pair, err) : st;
}

/* What joins the newest slice to the one before is known: PAIR, or null for nothing. */
static il_status settle(lofter *l, il_pair *pair, il_error *err)
{
    if (!l->due)
        return IL_OK;
    double z = l->newest.z, distance = z - l->z;
    bool hollow = l->newest.n_nodes == 0;
    il_status st = IL_OK;
    if (l->n_slices == 1) {
        st = begin_run(l, 0, err);
    } else if (pair && pair->gap) {
        st = end_run(l, distance, err);
        st = st == IL_OK ? begin_run(l, distance, err) : st;
    } else {
        l->spacing = distance;
        st = continue_run(l, pair, err);
    }
    l->due = false;
    l->z = z;
    l->hollow = hollow;
    return st;
}

/* ---- the sink ---- */

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    lofter *l = (lofter *)self;
    clear(l);
    il_stack_head_free(&l->head);
    l->stack = l->number ? *l->number : l->stack + 1;
    l->n_slices = 0;
    l->n_slabs = 0;
    il_emitter_begin(&l->emitter, l->next, l->stack, l->options.cap == IL_CAP_FLAT);
    il_status st = il_stack_head_refuse_fault(head, err);
    if (st == IL_OK)
        st = il_stack_head_copy(&l->head, head, err);
    if (st == IL_OK && head->kind != IL_KIND_SOLID)
        st = il_fail(err, IL_E_INPUT, head->line, "stack '%.80s' is no solid", il_stack_head_name(head));
    if (st == IL_OK)
        st = l->next->begin(l->next, head, err);
    l->open = st == IL_OK;
    return st;
}

static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    lofter *l = (lofter *)self;
    il_status st = settle(l, NULL, err);
    if (st == IL_OK)
        st = il_section_from_slice(&l->newest, s, err);
    if (st != IL_OK)
        return st;
    l->emitter.facts.slices++;
    l->emitter.facts.rings += s->n;
    l->emitter.facts.points += il_slice_points(s);
    l->n_slices++;
    l->due = true;
    return IL_OK;
}

static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    return settle((lofter *)self, p, err);
}

static il_status stack_end(il_sink *self, il_error *err)
{
    lofter *l = (lofter *)self;
    il_status st = settle(l, NULL, err);
    if (st == IL_OK && l->emitter.facts.points == 0) {
        clear(l);
        return IL_OK;
    }
    if (st == IL_OK && l->n_slices < 2)
        st = il_fail(err, IL_E_INPUT, l->head.line, "stack \"%.60s\" has a single slice; a solid needs two",
                     il_stack_head_name(&l->head));
    else if (st == IL_OK)
        st = end_run(l, 0, err);
    if (st == IL_OK)
        st = drain(l, err);
    if (st == IL_OK) {
        il_emitter_end(&l->emitter);
        l->open = false;
        st = l->next->end(l->next, &l->emitter.facts, err);
    }
    clear(l);
    return st;
}

static il_status end(il_sink *self, il_error *err)
{
    lofter *l = (lofter *)self;
    return l->next->finish(l->next, err);
}

il_status il_lofter_new(il_sink **out, const il_loft_options *o, il_mesh_sink *next, il_error *err)
{
    *out = NULL;
    lofter *l = il_calloc(1, sizeof *l);
    if (!l)
        return il_fail_nomem(err);
    l->sink = (il_sink){ stack_begin, slice, pair, stack_end, end };
    l->options = *o;
    l->next = next;
    l->stack = -1;
    il_status st = il_window_start(&l->window, o, err);
    if (st != IL_OK) {
        il_free(l);
        return st;
    }
    *out = &l->sink;
    return IL_OK;
}

void il_lofter_number_by(il_sink *s, const int32_t *stack)
{
    ((lofter *)s)->number = stack;
}

void il_lofter_free(il_sink *s)
{
    lofter *l = (lofter *)s;
    if (!l)
        return;
    clear(l);
    il_window_stop(&l->window);
    il_stack_head_free(&l->head);
    il_free(l);
}
