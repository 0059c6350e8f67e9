#include "config.h"
#include "loft/window.h"
#include "base/alloc.h"
#include "loft/dome.h"
#include "loft/tidy.h"
#include "loft/pinch.h"

#include <math.h>
#include <string.h>

/* ---- what the workers do, without the mutex ---- */

static void measure(const il_window *w, il_window_place *p, const il_section *upper)
{
    const il_surface *s = &p->slab.surface;
    p->volume = p->area = 0;
    for (size_t t = 0; t < s->n_triangles; t++) {
        double v[3][3], u[3], d[3];
        for (size_t k = 0; k < 3; k++) {
            il_surface_position(s, &p->section, upper, s->tri[3 * t + k], v[k]);
            for (size_t i = 0; i < 3; i++)
                v[k][i] -= w->origin[i];
        }
        for (size_t i = 0; i < 3; i++)
            u[i] = v[1][i] - v[0][i], d[i] = v[2][i] - v[0][i];
        double n[3] = { u[1] * d[2] - u[2] * d[1], u[2] * d[0] - u[0] * d[2], u[0] * d[1] - u[1] * d[0] };
        p->volume += (v[0][0] * n[0] + v[0][1] * n[1] + v[0][2] * n[2]) / 6;
        p->area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    }
}

/* Take apart what more than two triangles share, and see that it stays sound. */
static il_status split_pinches(il_window_place *p, const il_section *upper, bool round_float)
{
    unsigned char *touched = NULL;
    il_slab *slab = &p->slab;
    il_status st = il_pinch_split_edges(&slab->surface, &p->section, upper, round_float, &touched, &p->n_split, &p->error);
    if (st == IL_OK)
        st = il_certify_touched(&slab->surface, &p->section, upper, touched, &slab->verdict, &p->error);
    if (st == IL_OK && slab->verdict.flaw != IL_FLAW_NONE)
        st = IL_E_SURFACE;
    il_free(touched);
    return st;
}

/* Is there no more than a dome between P and ABOVE? */
static bool is_dome(const il_window_place *p, const il_window_place *above)
{
    return p->beyond || above->beyond;
}

/* Domes follow the solid, and not the other way round. */
static void finish(const il_window *w, il_window_place *p, const il_window_place *above)
{
    const il_section *upper = &above->section;
    p->status = il_slab_follow(&p->slab, &p->section, upper, &p->error);
    if (p->status == IL_OK && p->slab.verdict.multiple > 0)
        p->status = split_pinches(p, upper, w->round_float);
    bool is_used = w->between != 0 || w->cap == IL_CAP_AUTO;
    for (int side = 0; side < 2 && is_used && p->status == IL_OK && !p->slab.gap && !is_dome(p, above); side++)
        p->status = il_lean_measure(&p->slab.lean[side], &p->slab.surface, &p->section, upper, side, &p->error);
}

/* next[side]: the slab beside P's, null where there is none. */
static void bend(const il_window *w, il_window_place *p, const il_window_place *above, const il_window_place *const next[2])
{
    il_lean beyond[2] = { IL_LEAN_INIT, IL_LEAN_INIT };
    il_surface *s = &p->slab.surface;
    for (int side = 0; side < 2; side++)
        if (next[side])
            beyond[side] = next[side]->slab.lean[1 - side];
    if (is_dome(p, above) && w->cap == IL_CAP_AUTO && !p->slab.gap) {
        int side = p->beyond ? IL_UPPER : IL_LOWER;
        p->status = il_dome_follow(s, &p->section, &above->section, side, &beyond[side], w->round_float, &p->error);
    } else if (!is_dome(p, above) && w->between != 0 && !p->slab.gap) {
        p->status = il_curve_bend(s, &p->section, &above->section, p->slab.lean, beyond, w->between, w->round_float,
                                  &p->bending, &p->error);
    }
    if (p->status == IL_OK && !p->slab.gap)
        p->status = il_tidy(s, &p->section, &above->section, &p->error);
    if (p->status == IL_OK)
        measure(w, p, &above->section);
}

/* ---- what may be done when ---- */

static bool lofted(il_window *w, size_t p)
{
    return il_window_at(w, p)->state >= IL_SLAB_LOFTED && il_window_at(w, p)->state != IL_SLAB_LOFTING;
}

/* Is slab P lofted, or is it certain that there is none? */
static bool lofted_or_none(il_window *w, size_t p)
{
    if (p < w->first)
        return true; /* gone already */
    return il_window_has_slab(w, p) ? lofted(w, p) : w->ended;
}

static bool may_loft(il_window *w, size_t p)
{
    return p % 2 == 0 || (lofted_or_none(w, p - 1) && lofted_or_none(w, p + 1));
}

static bool may_finish(il_window *w, size_t p)
{
    return p % 2 == 1 || ((p == 0 || lofted_or_none(w, p - 1)) && lofted_or_none(w, p + 1));
}

static bool is_finished(il_window *w, size_t p)
{
    il_slab_state s = il_window_at(w, p)->state;
    return s == IL_SLAB_FINISHED || s == IL_SLAB_BENDING || s == IL_SLAB_BENT;
}

/* The slabs beside it tell how its strips go on. */
static bool may_bend(il_window *w, size_t p)
{
    return (p == 0 || is_finished(w, p - 1)) && (il_window_has_slab(w, p + 1) ? is_finished(w, p + 1) : w->ended);
}

static int step(void *self, pthread_mutex_t *mutex)
{
    il_window *w = self;
    for (size_t p = w->first; !w->cancelled && il_window_has_slab(w, p); p++) {
        il_window_place *place = il_window_at(w, p), *above = il_window_at(w, p + 1);
        if (place->state == IL_SLAB_WAITING && may_loft(w, p)) {
            place->state = IL_SLAB_LOFTING;
            pthread_mutex_unlock(mutex);
            place->status = il_slab_loft(&place->slab, &place->section, &above->section, &place->pair, w->round_float, &place->error);
            pthread_mutex_lock(mutex);
            place->state = IL_SLAB_LOFTED;
        } else if (place->state == IL_SLAB_LOFTED && may_finish(w, p)) {
            place->state = IL_SLAB_FINISHING;
            pthread_mutex_unlock(mutex);
            if (place->status == IL_OK)
                finish(w, place, above);
            pthread_mutex_lock(mutex);
            place->state = IL_SLAB_FINISHED;
        } else if (place->state == IL_SLAB_FINISHED && may_bend(w, p)) {
            const il_window_place *const next[2] = { p > 0 ? il_window_at(w, p - 1) : NULL, il_window_has_slab(w, p + 1) ? above : NULL };
            place->state = IL_SLAB_BENDING;
            pthread_mutex_unlock(mutex);
            if (place->status == IL_OK && (!next[0] || next[0]->status == IL_OK) && (!next[1] || next[1]->status == IL_OK))
                bend(w, place, above, next);
            pthread_mutex_lock(mutex);
            place->state = IL_SLAB_BENT;
        } else {
            continue;
        }
        il_crew_wake(&w->crew);
        return 1;
    }
    return 0;
}

/* ---- the window ---- */

il_status il_window_start(il_window *w, const il_loft_options *o, il_error *err)
{
    memset(w, 0, sizeof *w);
    w->round_float = o->round_float;
    w->between = o->between;
    w->cap = o->cap;
    return il_crew_start(&w->crew, o->threads, step, w, err);
}

void il_window_stop(il_window *w)
{
    il_crew_end(&w->crew);
    for (size_t i = 0; i < IL_LOFT_WINDOW; i++) {
        il_section_free(&w->place[i].section);
        il_pair_free(&w->place[i].pair);
        il_slab_free(&w->place[i].slab);
    }
}

void il_window_push(il_window *w, il_section *section, int32_t slice, bool beyond, il_pair *pair)
{
    il_window_place *p = il_window_at(w, w->first + w->n);
    *p = (il_window_place){ .section = *section, .slice = slice, .beyond = beyond, .error = IL_ERROR_INIT };
    *section = (il_section)IL_SECTION_INIT;
    if (w->n == 0 && w->first == 0 && p->section.n_nodes > 0) {
        w->origin[0] = p->section.xy[0];
        w->origin[1] = p->section.xy[1];
        w->origin[2] = p->section.z;
    }
    if (w->n > 0 && pair) {
        il_window_at(w, w->first + w->n - 1)->pair = *pair;
        *pair = (il_pair)IL_PAIR_INIT;
    }
    w->n++;
    il_crew_wake(&w->crew);
}

void il_window_end(il_window *w)
{
    w->ended = true;
    il_crew_wake(&w->crew);
}

bool il_window_ready(il_window *w)
{
    size_t p = w->first;
    if (!il_window_has_slab(w, p) || il_window_at(w, p)->state != IL_SLAB_BENT)
        return false;
    return il_window_has_slab(w, p + 1) ? il_window_at(w, p + 1)->state == IL_SLAB_BENT : w->ended;
}

void il_window_pop(il_window *w)
{
    il_window_place *p = il_window_at(w, w->first);
    il_section_free(&p->section);
    il_pair_free(&p->pair);
    il_slab_free(&p->slab);
    w->first++;
    w->n--;
}

static bool is_busy(il_window *w)
{
    for (size_t p = w->first; p < w->first + w->n; p++)
        if (il_window_at(w, p)->state == IL_SLAB_LOFTING || il_window_at(w, p)->state == IL_SLAB_FINISHING ||
            il_window_at(w, p)->state == IL_SLAB_BENDING)
            return true;
    return false;
}

void il_window_clear(il_window *w)
{
    w->cancelled = true;
    while (is_busy(w))
        il_crew_help(&w->crew);
    while (w->n > 0)
        il_window_pop(w);
    w->first = 0;
    w->ended = w->cancelled = false;
    memset(w->origin, 0, sizeof w->origin);
}
