/* lofter.c - the stage of lofter.h: slices in, certified pieces of mesh out. */
#include "config.h"
#include "loft/lofter.h"
#include "base/alloc.h"
#include "base/number.h"
#include "loft/emit.h"
#include "loft/window.h"

#include <stdio.h>
#include <string.h>

typedef struct lofter {
    il_sink sink;
    il_loft_options options;
    il_mesh_sink *next;
    il_window window;
    il_emitter emitter;
    il_stack_head head;       /* of the stack at hand, for messages */
    int32_t stack, n_slices;
    double z, spacing;        /* of the last slice, and from the one before it */
    il_section held;          /* the first slice, until the spacing is known (domes) */
    bool open;                /* next was told to begin and not yet to end */
    size_t n_slabs;
} lofter;

/* ---- the window, filled and emptied ---- */

static void place_name(const lofter *l, int32_t slice, const il_section *s, char to[64])
{
    char z[IL_NUMBER_MAX];
    il_number_format(z, s->z);
    if (slice < 0 || slice >= l->n_slices)
        snprintf(to, 64, "the end");
    else
        snprintf(to, 64, "slice %d (z = %s)", (int)slice, z);
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
    place_name(l, low->slice, &low->section, below);
    place_name(l, high->slice, &high->section, above);
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

static il_status push(lofter *l, il_section *section, int32_t slice, il_error *err)
{
    il_window *w = &l->window;
    pthread_mutex_lock(&w->crew.mutex);
    il_window_pair(w, NULL); /* none came */
    il_status st = emit_ready(l, err);
    while (st == IL_OK && w->n == IL_LOFT_WINDOW) {
        il_crew_help(&w->crew);
        st = emit_ready(l, err);
    }
    if (st == IL_OK)
        il_window_push(w, section, slice);
    pthread_mutex_unlock(&w->crew.mutex);
    return st;
}

/* No more sections: emit the rest; one section is left then. */
static il_status drain(lofter *l, il_error *err)
{
    il_window *w = &l->window;
    pthread_mutex_lock(&w->crew.mutex);
    il_window_pair(w, NULL);
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
    il_section_free(&l->held);
    if (l->open)
        l->next->abandon(l->next);
    l->open = false;
}

/* ---- the sink ---- */

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    lofter *l = (lofter *)self;
    clear(l);
    il_stack_head_free(&l->head);
    l->stack++;
    l->n_slices = 0;
    l->n_slabs = 0;
    il_emitter_begin(&l->emitter, l->next, l->stack, l->options.cap == IL_CAP_FLAT);
    il_status st = il_stack_head_refuse_fault(head, err);
    if (st == IL_OK)
        st = il_stack_head_copy(&l->head, head, err);
    if (st == IL_OK && head->kind == IL_KIND_TERRAIN)
        st = il_fail(err, IL_E_INPUT, head->line, "stack \"%.60s\": this version makes no surface of terrain", il_stack_head_name(head));
    if (st == IL_OK)
        st = l->next->begin(l->next, head, err);
    l->open = st == IL_OK;
    return st;
}

/* An empty section half a dome beyond: caps rise to half of the slab. */
static il_status push_beyond(lofter *l, double z, int32_t slice, il_error *err)
{
    il_slice empty = IL_SLICE_INIT;
    il_section section = IL_SECTION_INIT;
    empty.z = l->options.round_float ? il_number_round_float(z) : z;
    il_status st = il_section_from_slice(&section, &empty, err);
    if (st == IL_OK)
        st = push(l, &section, slice, err);
    il_section_free(&section);
    return st;
}

/* With domes the first section waits for the second, whose distance tells how
 * far the dome reaches. */
static il_status push_held(lofter *l, il_error *err)
{
    il_status st = push_beyond(l, l->held.z - l->spacing, -1, err);
    return st == IL_OK ? push(l, &l->held, 0, err) : st;
}

static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    lofter *l = (lofter *)self;
    il_section section = IL_SECTION_INIT;
    il_status st = il_section_from_slice(&section, s, err);
    l->emitter.facts.slices++;
    l->emitter.facts.rings += s->n;
    l->emitter.facts.points += il_slice_points(s);
    l->spacing = s->z - l->z;
    l->z = s->z;
    int32_t index = l->n_slices++;
    bool dome = l->options.cap == IL_CAP_DOME;
    if (st == IL_OK && dome && index == 0) {
        l->held = section;
        return IL_OK;
    }
    if (st == IL_OK && dome && index == 1)
        st = push_held(l, err);
    if (st == IL_OK)
        st = push(l, &section, index, err);
    il_section_free(&section);
    return st;
}

static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    lofter *l = (lofter *)self;
    (void)err;
    pthread_mutex_lock(&l->window.crew.mutex);
    il_window_pair(&l->window, p);
    pthread_mutex_unlock(&l->window.crew.mutex);
    return IL_OK;
}

static il_status stack_end(il_sink *self, il_error *err)
{
    lofter *l = (lofter *)self;
    il_status st = IL_OK;
    const char *name = il_stack_head_name(&l->head);
    if (l->emitter.facts.points == 0)
        st = il_fail(err, IL_E_INPUT, l->head.line, "stack \"%.60s\" has no contours", name);
    else if (l->n_slices < 2)
        st = il_fail(err, IL_E_INPUT, l->head.line, "stack \"%.60s\" has a single slice; a solid needs two", name);
    else if (l->options.cap == IL_CAP_DOME)
        st = push_beyond(l, l->z + l->spacing, l->n_slices, err);
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
    il_status st = il_window_start(&l->window, o->threads, o->round_float, err);
    if (st != IL_OK) {
        il_free(l);
        return st;
    }
    *out = &l->sink;
    return IL_OK;
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
