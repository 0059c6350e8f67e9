#include "config.h"
#include "loft/attempt.h"
#include "base/alloc.h"
#include "loft/build.h"
#include "loft/handles.h"

#include <math.h>
#include <string.h>

void il_outcome_free(il_outcome *o)
{
    il_surface_free(&o->surface);
    *o = (il_outcome)IL_OUTCOME_INIT;
}

/* Judge the surface between copies of the sections, which are given its insertions.
 * Where phi is the identity the surface has no folds: it is a graph over the
 * plane but for its walls. */
static il_status judge(il_outcome *out, const il_task *task, bool deformed, il_error *err)
{
    static const double LEAST_ANGLE = 1e-7, LEAST_ANGLE_FLOAT = 1e-3;
    il_section below = IL_SECTION_INIT, above = IL_SECTION_INIT;
    const il_surface *s = &out->surface;
    il_status st = il_section_copy_inserted(&below, task->lower, s->insertion[0], s->n_insertions[0], err);
    if (st == IL_OK)
        st = il_section_copy_inserted(&above, task->upper, s->insertion[1], s->n_insertions[1], err);
    if (st == IL_OK)
        st = il_certify(s, &below, &above, &out->verdict, err);
    if (st == IL_OK && deformed && out->verdict.flaw == IL_FLAW_NONE)
        st = il_certify_unfolded(s, &below, &above, task->round_float ? LEAST_ANGLE_FLOAT : LEAST_ANGLE, &out->verdict, err);
    il_section_free(&below);
    il_section_free(&above);
    return st;
}

/* Build over the snapped reference and judge. */
static il_status build_and_judge(il_outcome *out, const il_task *task, const il_reference *r,
                                 const il_snapped *snapped, double rise, bool stars, il_error *err)
{
    il_overlay o;
    il_build_options options = { rise, stars, task->round_float };
    bool sound = true;
    il_surface_free(&out->surface);
    out->verdict = (il_verdict){ IL_FLAW_REFERENCE, { 0, 0, 0 }, 0 };
    il_status st = il_overlay_build(&o, r, snapped, &sound, err);
    if (st == IL_OK && sound) {
        st = il_build_surface(&out->surface, &o, &options, err);
        if (st == IL_OK)
            st = judge(out, task, r->deformed, err);
    }
    il_overlay_free(&o);
    return st;
}

/* Over R as snapped, lower caps until they cross nothing; other flaws do not
 * depend on them. */
static il_status try_snapped(il_outcome *out, const il_task *task, const il_reference *r, const il_snapped *snapped,
                             bool injective, il_error *err)
{
    il_status st = IL_OK;
    out->verdict = (il_verdict){ IL_FLAW_REFERENCE, { 0, 0, 0 }, 0 };
    for (double rise = 0.5; injective && st == IL_OK && rise > 0.05; rise /= 2) {
        st = build_and_judge(out, task, r, snapped, rise, false, err);
        if (out->verdict.flaw != IL_FLAW_CROSSING || out->surface.n_inner == 0)
            break; /* without inner points there is no cap */
    }
    if (st == IL_OK && task->apart && r->deformed && out->verdict.flaw == IL_FLAW_CROSSING)
        st = build_and_judge(out, task, r, snapped, 0.5, true, err);
    return st;
}

static il_status try_grid(il_outcome *out, const il_task *task, const il_reference *r, int exponent, il_error *err)
{
    il_snapped snapped;
    bool injective;
    il_status st = il_snap(&snapped, r, exponent, &injective, err);
    if (st != IL_OK)
        return st;
    st = try_snapped(out, task, r, &snapped, injective, err);
    il_snapped_free(&snapped);
    return st;
}

/* The grid to try after EXPONENT: a coarser one once, when triangles crossed on
 * the first (what nearly coincides is one thing there), else ever finer ones,
 * since two vertices of one slice fell on one point. */
static int next_exponent(int exponent, int first, int last, il_flaw flaw)
{
    if (exponent == first && flaw == IL_FLAW_CROSSING)
        return first + 4;
    int finer = (exponent > first ? first : exponent) - 4;
    return finer > last ? finer : last;
}

/* Attempt B, phi the identity: the last that there is, so every grid is tried. */
static il_status attempt_identity(il_outcome *out, const il_task *task, il_error *err)
{
    il_reference r;
    il_status st = il_reference_build(&r, task->lower, task->upper, err);
    if (st != IL_OK)
        return st;
    r.outside = task->outside;
    int first = il_snap_first_exponent(&r, task->round_float), last = il_snap_last_exponent(&r);
    for (int exponent = first;;) {
        st = try_grid(out, task, &r, exponent, err);
        if (st != IL_OK || out->verdict.flaw == IL_FLAW_NONE || exponent <= last)
            break;
        exponent = next_exponent(exponent, first, last, out->verdict.flaw);
    }
    il_reference_free(&r);
    out->attempt = IL_ATTEMPT_B;
    return st;
}

/* A reference on its first grid, where it is known already. */
typedef struct first_grid {
    il_snapped snapped;
    bool known, injective;
} first_grid;

/* Attempts S and P, over reference R.  Finer grids help where vertices fell on
 * one point, a coarser one where triangles cross by a hair; what is wrong with
 * phi, no grid puts right. */
static il_status try_grids(il_outcome *out, const il_task *task, const il_reference *r, int first, const first_grid *on,
                           il_error *err)
{
    enum { FINER = 2, STEP = 4 };
    int last = il_snap_last_exponent(r);
    il_status st = on->known ? try_snapped(out, task, r, &on->snapped, on->injective, err)
                             : try_grid(out, task, r, first, err);
    if (st == IL_OK && out->verdict.flaw == IL_FLAW_CROSSING)
        st = try_grid(out, task, r, first + STEP, err);
    for (int k = 1; st == IL_OK && k <= FINER && out->verdict.flaw == IL_FLAW_REFERENCE && first - k * STEP >= last; k++)
        st = try_grid(out, task, r, first - k * STEP, err);
    if (st != IL_E_INPUT)
        return st;
    /* too many crossings: no map that takes one slice to the other makes them */
    out->verdict = (il_verdict){ IL_FLAW_REFERENCE, { 0, 0, 0 }, 0 };
    *err = (il_error)IL_ERROR_INIT;
    return IL_OK;
}

/* Cut the seams at the folds of the reference as snapped: an arc laid on the other
 * may be in the way of what is next to it.  Was there anything to cut? */
static bool cut_folds(const il_reference *r, const il_snapped *snapped, il_seam *seam, size_t n)
{
    const il_ref_side *side = &r->side[IL_UPPER];
    bool cut = false;
    for (size_t i = 0; i < 2 * snapped->n_folds; i++) {
        const il_ref_vertex *v = &side->vertex[snapped->fold[i]], *end = &side->vertex[side->next[snapped->fold[i]]];
        if (v->matched)
            cut |= il_seams_cut(seam, n, v->station, v->t);
        else if (il_seams_cut_end(seam, n, v->station, v->t) || il_seams_cut_end(seam, n, end->station, end->t))
            cut = true;
    }
    return cut;
}

/* R with the seams SEAM[N], cut until they are in nothing's way, and in ON as it
 * is on its first grid then. */
static il_status lay_seams(il_reference *r, const il_task *task, il_seam *seam, size_t n, double near, int exponent,
                           first_grid *on, il_error *err)
{
    enum { ROUNDS = 16 };
    il_status st = il_reference_deform(r, task->lower, task->upper, task->phi, seam, n, near, err);
    for (int round = 0; st == IL_OK && n > 0 && round < ROUNDS; round++) {
        st = il_snap(&on->snapped, r, exponent, &on->injective, err);
        if (st == IL_E_INPUT) { /* too many crossings to tell */
            *err = (il_error)IL_ERROR_INIT;
            return IL_OK;
        }
        on->known = st == IL_OK;
        if (st != IL_OK || on->injective || !cut_folds(r, &on->snapped, seam, n))
            break;
        il_snapped_free(&on->snapped);
        on->known = false;
        il_reference_free(r);
        st = il_reference_deform(r, task->lower, task->upper, task->phi, seam, n, near, err);
    }
    return st;
}

/* The exponent with which to begin for the group's slices, the upper one at phi. */
static il_status first_exponent(const il_task *task, int *first, il_error *err)
{
    il_reference r;
    il_status st = il_reference_deform(&r, task->lower, task->upper, task->phi, NULL, 0, 0, err);
    if (st != IL_OK)
        return st;
    *first = il_snap_first_exponent(&r, task->round_float);
    il_reference_free(&r);
    return IL_OK;
}

/* Attempts S, with the group's arcs as seams, and P, without. */
static il_status attempt_deformed(il_outcome *out, const il_task *task, il_attempt attempt, il_error *err)
{
    static const double NEAR = 8; /* cells */
    il_reference r = { 0 };
    first_grid on = { .known = false };
    il_seam *seam = NULL;
    size_t n = 0;
    int first;
    il_status st = first_exponent(task, &first, err);
    if (st != IL_OK)
        return st;
    double near = ldexp(NEAR, first);
    if (attempt == IL_ATTEMPT_S)
        st = il_seams_lay(&seam, &n, task->lower, task->upper, task->phi, task->match, task->n_matches, near, err);
    double matched = il_seams_length(seam, n);
    if (st == IL_OK)
        st = lay_seams(&r, task, seam, n, near, first, &on, err);
    r.outside = task->outside;
    r.fit = task->fit;
    out->verdict = (il_verdict){ IL_FLAW_REFERENCE, { 0, 0, 0 }, 0 };
    if (st == IL_OK && (attempt == IL_ATTEMPT_P || il_seams_length(seam, n) > 0))
        st = try_grids(out, task, &r, first, &on, err);
    out->attempt = attempt;
    if (attempt == IL_ATTEMPT_S && out->surface.walled < 0.9 * matched)
        out->attempt = IL_ATTEMPT_P;
    if (on.known)
        il_snapped_free(&on.snapped);
    il_reference_free(&r);
    il_seams_free(seam, n);
    return st;
}

/* One more attempt; it becomes *BEST unless that is sound (*HANDLES is not
 * negative) and has no more handles. */
static il_status try_attempt(il_outcome *best, long *handles, const il_task *task, il_attempt attempt, il_error *err)
{
    il_outcome next = IL_OUTCOME_INIT;
    long own = 0;
    bool any = *handles >= 0;
    il_status st = attempt == IL_ATTEMPT_B ? attempt_identity(&next, task, err) : attempt_deformed(&next, task, attempt, err);
    bool sound = st == IL_OK && next.verdict.flaw == IL_FLAW_NONE;
    if (sound && (any || attempt != IL_ATTEMPT_B))
        st = il_surface_handles(&next.surface, task->lower, task->upper, &own, err);
    if (!any || (sound && own < *handles)) {
        il_outcome swap = *best;
        *best = next;
        next = swap;
        if (sound)
            *handles = own;
    }
    il_outcome_free(&next);
    return st;
}

/* In turn, until one is sound and has no handle: between two slices there is no
 * reason to make one, and phi does where it maps something that ends in between.
 * If all have some, the one with the fewest, the first of these. */
il_status il_attempt_group(il_outcome *out, const il_task *task, il_error *err)
{
    bool deformed = task->phi && task->lower->n_stations > 0 && task->upper->n_stations > 0;
    long handles = -1;
    il_status st = IL_OK;
    if (deformed && task->n_matches > 0)
        st = try_attempt(out, &handles, task, IL_ATTEMPT_S, err);
    if (st == IL_OK && deformed && !task->as_they_lie && handles != 0)
        st = try_attempt(out, &handles, task, IL_ATTEMPT_P, err);
    if (st == IL_OK && handles != 0 && !task->deformed_only)
        st = try_attempt(out, &handles, task, IL_ATTEMPT_B, err);
    return st;
}
