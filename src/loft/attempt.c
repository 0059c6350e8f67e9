#include "config.h"
#include "loft/attempt.h"
#include "base/alloc.h"
#include "loft/build.h"

#include <string.h>

void il_outcome_free(il_outcome *o)
{
    il_surface_free(&o->surface);
    *o = (il_outcome)IL_OUTCOME_INIT;
}

/* Judge the surface between copies of the sections, which are given its insertions. */
static il_status judge(il_outcome *out, const il_task *task, il_error *err)
{
    il_section below = IL_SECTION_INIT, above = IL_SECTION_INIT;
    const il_surface *s = &out->surface;
    il_status st = il_section_copy(&below, task->lower, err);
    if (st == IL_OK)
        st = il_section_copy(&above, task->upper, err);
    if (st == IL_OK)
        st = il_section_insert(&below, s->insertion[0], s->n_insertions[0], err);
    if (st == IL_OK)
        st = il_section_insert(&above, s->insertion[1], s->n_insertions[1], err);
    if (st == IL_OK)
        st = il_certify(s, &below, &above, &out->verdict, err);
    il_section_free(&below);
    il_section_free(&above);
    return st;
}

/* Build over the snapped reference and judge. */
static il_status build_and_judge(il_outcome *out, const il_task *task, const il_reference *r,
                                 const il_snapped *snapped, double rise, il_error *err)
{
    il_overlay o;
    il_build_options options = { rise, task->round_float };
    bool sound = true;
    il_surface_free(&out->surface);
    out->verdict = (il_verdict){ IL_FLAW_REFERENCE, { 0, 0, 0 }, 0 };
    il_status st = il_overlay_build(&o, r, snapped, &sound, err);
    if (st == IL_OK && sound) {
        st = il_build_surface(&out->surface, &o, &options, err);
        if (st == IL_OK)
            st = judge(out, task, err);
    }
    il_overlay_free(&o);
    return st;
}

/* Lower caps until they cross nothing; other flaws do not depend on them. */
static il_status try_grid(il_outcome *out, const il_task *task, const il_reference *r, int exponent, il_error *err)
{
    il_snapped snapped;
    bool injective;
    il_status st = il_snap(&snapped, r, exponent, &injective, err);
    if (st != IL_OK)
        return st;
    out->verdict = (il_verdict){ IL_FLAW_REFERENCE, { 0, 0, 0 }, 0 };
    if (injective) {
        for (double rise = 0.5; st == IL_OK && rise > 0.05; rise /= 2) {
            st = build_and_judge(out, task, r, &snapped, rise, err);
            if (out->verdict.flaw != IL_FLAW_CROSSING)
                break;
        }
    }
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

/* Attempt B: phi is the identity. */
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

il_status il_attempt_group(il_outcome *out, const il_task *task, il_error *err)
{
    return attempt_identity(out, task, err);
}
