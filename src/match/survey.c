#include "config.h"
#include "match/survey.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "match/vessel.h"

#include <math.h>
#include <stdlib.h>

/* part[n]: of each ring which part it is of, by a number of its own among this slice's; those of
 * holes mean nothing. */
typedef struct row {
    double z;
    uint32_t *part;         size_t n, cap;
    unsigned char *is_outer; size_t cap_outer;
} row;

/* row: the last two slices.  forest: over the rings of both, lower ones first.  joined[n_joins]:
 * reaches in heights.  mute: some record does not tell what belongs together. */
typedef struct survey {
    il_sink sink;
    il_link_facts *facts;
    il_report *report;
    bool hints, is_vessel, mute;
    row row[2];
    uint32_t *forest;       size_t cap_forest;
    double *joined;         size_t n_joins, cap_joined;
} survey;

void il_link_facts_free(il_link_facts *f)
{
    il_free(f->guess);
    *f = (il_link_facts)IL_LINK_FACTS_INIT;
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    survey *s = (survey *)self;
    (void)err;
    il_link_facts_free(s->facts);
    s->row[0].n = s->row[1].n = s->n_joins = 0;
    s->mute = false;
    s->is_vessel = head->kind != IL_KIND_TERRAIN &&
                   (il_vessel_is_said(head->name) || il_vessel_is_said(il_stack_head_attribute(head, "RTROIInterpretedType")));
    return IL_OK;
}

/* Each outer ring is a part of its own at first. */
static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    survey *s = (survey *)self;
    row below = s->row[0];
    s->row[0] = s->row[1];
    s->row[1] = below;
    row *r = &s->row[1];
    if (!il_grow(&r->part, &r->cap, slice->n, sizeof *r->part) || !il_grow(&r->is_outer, &r->cap_outer, slice->n, 1))
        return il_fail_nomem(err);
    r->z = slice->z;
    r->n = slice->n;
    for (size_t i = 0; i < r->n; i++) {
        r->part[i] = (uint32_t)i;
        r->is_outer[i] = !slice->ring[i].open && il_ring_area2(&slice->ring[i]) > 0;
        s->facts->parts += r->is_outer[i];
    }
    return IL_OK;
}

/* ---- parts ---------------------------------------------------------------------------- */

static void join_parts(survey *s, uint32_t a, uint32_t b)
{
    if (il_forest_leader(s->forest, a) != il_forest_leader(s->forest, b))
        s->facts->parts--;
    il_forest_join(s->forest, a, b);
}

static void join_group(survey *s, const il_group *g)
{
    const row *lower = &s->row[0], *upper = &s->row[1];
    uint32_t none = (uint32_t)(lower->n + upper->n), one = none;
    for (size_t i = 0; i < g->n_lower + g->n_upper; i++) {
        bool is_lower = i < g->n_lower;
        uint32_t ring = is_lower ? g->lower[i] : g->upper[i - g->n_lower];
        if (!(is_lower ? lower : upper)->is_outer[ring])
            continue;
        ring += is_lower ? 0 : (uint32_t)lower->n;
        if (one == none)
            one = ring;
        join_parts(s, one, ring);
    }
}

/* Rings of a part are one set from the start; a part goes by its first ring. */
static void plant(survey *s)
{
    const row *lower = &s->row[0];
    il_forest_plant(s->forest, lower->n + s->row[1].n);
    for (uint32_t i = 0; i < lower->n; i++)
        il_forest_join(s->forest, i, lower->part[i]);
}

/* Parts of the upper slice's rings: by the first of them. */
static il_status number_parts(survey *s, il_error *err)
{
    const row *lower = &s->row[0];
    row *upper = &s->row[1];
    size_t n = lower->n + upper->n;
    uint32_t *first = il_alloc(n, sizeof *first);
    if (!first)
        return il_fail_nomem(err);
    for (size_t i = 0; i < n; i++)
        first[i] = UINT32_MAX;
    for (uint32_t i = 0; i < upper->n; i++) {
        uint32_t *f = &first[il_forest_leader(s->forest, (uint32_t)lower->n + i)];
        *f = *f == UINT32_MAX ? i : *f;
        upper->part[i] = *f;
    }
    il_free(first);
    return IL_OK;
}

static il_status follow_parts(survey *s, const il_pair *p, il_error *err)
{
    if (!il_grow(&s->forest, &s->cap_forest, s->row[0].n + s->row[1].n, sizeof *s->forest))
        return il_fail_nomem(err);
    plant(s);
    for (size_t i = 0; i < p->n_groups; i++)
        join_group(s, &p->group[i]);
    return number_parts(s, err);
}

/* ---- links ------------------------------------------------------------------------------ */

static bool count_link(survey *s, const il_link *l)
{
    il_link_facts *f = s->facts;
    double below = s->row[0].z, above = s->row[1].z;
    f->n_by[l->reason]++;
    if (l->reason != IL_LINK_JOIN)
        return true;
    if (!il_grow(&s->joined, &s->cap_joined, s->n_joins + 1, sizeof *s->joined))
        return false;
    s->joined[s->n_joins++] = l->reach / (above - below);
    if (!(l->reach > above - below))
        return true;
    if (!il_grow(&f->guess, &f->cap_guesses, f->n_guesses + 1, sizeof *f->guess))
        return false;
    f->guess[f->n_guesses++] = (il_guess){ below, above, *l };
    return true;
}

static il_status on_pair(il_sink *self, il_pair *p, il_error *err)
{
    survey *s = (survey *)self;
    bool ok = true;
    if (p->gap)
        return IL_OK;
    s->facts->pairs++;
    s->mute = s->mute || p->n_groups == 0;
    for (size_t i = 0; i < p->n_groups; i++)
        for (size_t k = 0; k < p->group[i].n_links && ok; k++)
            ok = count_link(s, &p->group[i].link[k]);
    return ok ? follow_parts(s, p, err) : il_fail_nomem(err);
}

/* ---- what is said -------------------------------------------------------------------------- */

static int compare_numbers(const void *pa, const void *pb)
{
    const double *a = pa, *b = pb;
    return (*a > *b) - (*a < *b);
}

static void measure(survey *s)
{
    il_link_facts *f = s->facts;
    size_t n = 0;
    for (int k = 0; k < IL_N_LINK_REASONS; k++)
        n += f->n_by[k];
    if (s->n_joins > 0) {
        qsort(s->joined, s->n_joins, sizeof *s->joined, compare_numbers);
        f->joined = s->joined[(s->n_joins - 1) / 2];
    }
    f->undersampled = s->n_joins >= IL_JOINS_TOLD && 3 * s->n_joins > n && f->joined > IL_JOINED_MOST;
    f->parts = s->mute ? 0 : f->parts;
}

static void say(const survey *s)
{
    const il_link_facts *f = s->facts;
    if (f->n_guesses > 0)
        il_report_note(s->report, "%zu link%s reach%s farther than the slab is high, and are guesses (-v lists them)", f->n_guesses,
                       f->n_guesses == 1 ? "" : "s", f->n_guesses == 1 ? "es" : "");
    if (f->undersampled)
        il_report_note(s->report, "there are few slices for what is in them: %zu links reach across gaps, which measure %ld %% of the "
                       "slab's height in the middle; slices nearer to each other tell better what belongs together",
                       s->n_joins, lround(100 * f->joined));
    if (s->hints && s->is_vessel && f->parts > 1)
        il_report_note(s->report, "it is a vessel by its name or type, and in %zu parts: --pieces few links farther", f->parts);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    survey *s = (survey *)self;
    (void)err;
    measure(s);
    say(s);
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

il_status il_survey_new(il_sink **out, bool hints, il_link_facts *facts, il_report *report, il_error *err)
{
    survey *s = il_calloc(1, sizeof *s);
    *out = s ? &s->sink : NULL;
    if (!s)
        return il_fail_nomem(err);
    *s = (survey){ .sink = { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, .facts = facts, .report = report, .hints = hints };
    return IL_OK;
}

void il_survey_free(il_sink *sink)
{
    survey *s = (survey *)sink;
    if (!s)
        return;
    for (int k = 0; k < 2; k++) {
        il_free(s->row[k].part);
        il_free(s->row[k].is_outer);
    }
    il_free(s->forest);
    il_free(s->joined);
    il_free(s);
}
