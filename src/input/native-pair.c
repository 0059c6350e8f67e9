/* native-pair.c - pair and gap records of the native format (formats/loft.txt, 8). */
#include "config.h"
#include "input/native.h"
#include "base/alloc.h"

#include <string.h>

/* ---- the record ---------------------------------------------------------------- */

/* A pair or gap stands right behind the upper of its two slices, which is whole
 * then and handed on. */
static il_status begin_record(il_native *n, const char *word)
{
    if (n->slices < 2)
        return il_native_fail(n, "a %s cannot stand behind the first slice of its stack", word);
    if (n->pair_done)
        return il_native_fail(n, "a %s cannot stand here: these two slices have a pair or gap already", word);
    il_status st = il_native_flush_slice(n);
    il_pair_free(&n->pair);
    n->pair_done = true;
    n->extra = &n->pair.extra;
    n->pair.line = n->at.line;
    return st;
}

/* Indices mean something only where both slices are as the canonical form has
 * them: see the format, section 8. */
static il_status check_slices(il_native *n)
{
    if (!n->lower.all_rings || !n->upper.all_rings)
        return il_native_fail(n, "a pair cannot stand by a slice with open lines or rings of less than 3 vertices");
    if (!n->lower.in_order || !n->upper.in_order)
        return il_native_fail(n, "a pair cannot stand by a slice whose rings are not in canonical order");
    return IL_OK;
}

static void forget_groups(il_native_shape *s)
{
    if (s->n > 0)
        memset(s->group, 0, s->n * sizeof *s->group);
}

static il_status take_pair(il_native *n)
{
    il_status st = begin_record(n, "pair");
    if (st == IL_OK)
        st = check_slices(n);
    if (st != IL_OK)
        return st;
    forget_groups(&n->lower);
    forget_groups(&n->upper);
    n->in = IL_IN_PAIR;
    n->has_matcher = false;
    n->rows = 0;
    n->phi_rings = 0;
    return IL_OK;
}

static il_status take_matcher(il_native *n)
{
    static const char *const matchers[] = { "none", "ffd", NULL };
    int matcher = 0;
    if (n->has_matcher)
        return il_native_fail(n, "'matcher' stands twice in this pair");
    n->has_matcher = true;
    il_status st = il_scan_choice(&n->at, matchers, "a matcher: none or ffd", &matcher, n->err);
    n->pair.matcher = (il_matcher)matcher;
    return st;
}

il_status il_native_close_pair(il_native *n)
{
    il_status st = IL_OK;
    if (!n->has_matcher)
        st = il_native_fail_at(n, n->pair.line, "this pair has no 'matcher'");
    else if (n->pair.matcher == IL_MATCHER_FFD && n->phi_rings != n->upper.n)
        st = il_native_fail_at(n, n->pair.line, "phi is given for %lu of the %zu rings of the upper slice",
                               (unsigned long)n->phi_rings, n->upper.n);
    else
        st = n->sink->pair(n->sink, &n->pair, n->err);
    il_pair_free(&n->pair);
    return st;
}

static il_status take_gap(il_native *n)
{
    il_status st = begin_record(n, "gap");
    n->pair.gap = true;
    n->in = IL_IN_GAP;
    return st;
}

il_status il_native_close_gap(il_native *n)
{
    il_status st = n->sink->pair(n->sink, &n->pair, n->err);
    il_pair_free(&n->pair);
    return st;
}

/* ---- what lines have in common ------------------------------------------------ */

il_status il_native_need_matcher(il_native *n)
{
    return n->has_matcher ? IL_OK : il_native_fail(n, "the first line of a pair is its 'matcher'");
}

il_status il_native_need_ffd(il_native *n, const char *word)
{
    il_status st = il_native_need_matcher(n);
    if (st == IL_OK && n->pair.matcher != IL_MATCHER_FFD)
        st = il_native_fail(n, "'%s' has no meaning where the matcher is 'none'", word);
    return st;
}

il_status il_native_count_row(il_native *n)
{
    if (n->rows >= n->options->max_points)
        return il_native_fail(n, "more than %zu rows in one pair", n->rows);
    n->rows++;
    return IL_OK;
}

il_status il_native_ring_exists(il_native *n, const il_native_shape *s, uint32_t ring)
{
    if (ring < s->n)
        return IL_OK;
    return il_native_fail(n, "the %s slice has no ring %lu", s == &n->lower ? "lower" : "upper", (unsigned long)ring);
}

il_status il_native_take_distance(il_native *n, double *v)
{
    il_status st = il_scan_number(&n->at, v, n->err);
    if (st != IL_OK)
        return st;
    return *v >= 0 ? IL_OK : il_native_fail(n, "distances and distortions are not negative");
}

/* ---- phi ------------------------------------------------------------------------- */

static il_status take_phi(il_native *n)
{
    uint32_t ring = 0;
    il_status st = il_native_need_ffd(n, "phi");
    if (st == IL_OK)
        st = il_scan_index(&n->at, &ring, n->err);
    if (st == IL_OK)
        st = il_native_ring_exists(n, &n->upper, ring);
    if (st == IL_OK && ring != n->phi_rings)
        st = il_native_fail(n, "phi of ring %lu is due, not of ring %lu", (unsigned long)n->phi_rings,
                            (unsigned long)ring);
    n->phi_rings += st == IL_OK;
    n->in = IL_IN_PHI;
    n->rows_line = n->at.line;
    return st;
}

/* The last point of the open phi, or null before its first. */
static const il_phi_point *last_point(const il_native *n)
{
    const il_phi_point *p = n->pair.n_phi > 0 ? &n->pair.phi[n->pair.n_phi - 1] : NULL;
    return p && p->at.ring + 1 == n->phi_rings ? p : NULL;
}

/* Places rise and leave no vertex out: so what comes is a point further along
 * the same edge, or the next vertex itself. */
static il_status check_order(il_native *n, il_place at)
{
    const il_phi_point *last = last_point(n);
    uint32_t due = last ? last->at.vertex + 1 : 0;
    if (last && at.vertex == last->at.vertex && at.t > last->at.t)
        return IL_OK;
    if (last && at.vertex <= last->at.vertex)
        return il_native_fail(n, "this place does not lie behind the one above it");
    if (at.vertex != due || at.t != 0)
        return il_native_fail(n, "phi of vertex %lu is due", (unsigned long)due);
    return IL_OK;
}

static il_status take_vertex_and_t(il_native *n, const il_native_shape *s, il_place *at)
{
    il_status st = il_scan_index(&n->at, &at->vertex, n->err);
    if (st == IL_OK)
        st = il_scan_number(&n->at, &at->t, n->err);
    if (st == IL_OK && at->vertex >= s->vertices[at->ring])
        st = il_native_fail(n, "ring %lu of the %s slice has no vertex %lu", (unsigned long)at->ring,
                            s == &n->lower ? "lower" : "upper", (unsigned long)at->vertex);
    if (st == IL_OK && !(at->t >= 0 && at->t < 1))
        st = il_native_fail(n, "a place on an edge is given by a number from 0 to below 1");
    return st;
}

il_status il_native_take_phi_row(il_native *n)
{
    il_pair *p = &n->pair;
    il_phi_point point = { .at.ring = n->phi_rings - 1 };
    il_status st = take_vertex_and_t(n, &n->upper, &point.at);
    if (st == IL_OK)
        st = check_order(n, point.at);
    if (st == IL_OK)
        st = il_scan_number(&n->at, &point.x, n->err);
    if (st == IL_OK)
        st = il_scan_number(&n->at, &point.y, n->err);
    if (st == IL_OK)
        st = il_native_count_row(n);
    if (st != IL_OK)
        return st;
    if (!il_grow(&p->phi, &p->cap_phi, p->n_phi + 1, sizeof *p->phi))
        return il_native_nomem(n);
    p->phi[p->n_phi++] = point;
    return IL_OK;
}

il_status il_native_close_phi(il_native *n)
{
    const il_phi_point *last = last_point(n);
    uint32_t given = last ? last->at.vertex + 1 : 0, ring = n->phi_rings - 1;
    if (given != n->upper.vertices[ring])
        return il_native_fail_at(n, n->rows_line, "phi of ring %lu is given for %lu of its %lu vertices", (unsigned long)ring,
                                 (unsigned long)given, (unsigned long)n->upper.vertices[ring]);
    return IL_OK;
}

/* ---- arcs and points -------------------------------------------------------------- */

static il_status take_ring_index(il_native *n, const il_native_shape *s, uint32_t *ring)
{
    il_status st = il_scan_index(&n->at, ring, n->err);
    return st != IL_OK ? st : il_native_ring_exists(n, s, *ring);
}

static il_status take_arc(il_native *n, const il_native_shape *s, il_arc *a)
{
    il_status st = take_ring_index(n, s, &a->from.ring);
    if (st == IL_OK)
        st = take_vertex_and_t(n, s, &a->from);
    a->to.ring = a->from.ring;
    return st != IL_OK ? st : take_vertex_and_t(n, s, &a->to);
}

static il_status take_arcs(il_native *n, bool as_they_lie)
{
    il_pair *p = &n->pair;
    il_match m = { .as_they_lie = as_they_lie };
    il_status st = il_native_need_matcher(n);
    if (st == IL_OK)
        st = take_arc(n, &n->lower, &m.lower);
    if (st == IL_OK)
        st = take_arc(n, &n->upper, &m.upper);
    if (st == IL_OK)
        st = il_native_take_distance(n, &m.residual_mean);
    if (st == IL_OK)
        st = il_native_take_distance(n, &m.residual_max);
    if (st == IL_OK)
        st = il_native_count_row(n);
    if (st != IL_OK)
        return st;
    if (!il_grow(&p->match, &p->cap_matches, p->n_matches + 1, sizeof *p->match))
        return il_native_nomem(n);
    p->match[p->n_matches++] = m;
    return IL_OK;
}

static il_status take_match(il_native *n)
{
    return take_arcs(n, false);
}

static il_status take_near(il_native *n)
{
    il_status st = il_native_need_ffd(n, "near");
    return st == IL_OK ? take_arcs(n, true) : st;
}

static il_status take_side(il_native *n, const il_native_shape **s, bool *upper)
{
    static const char *const sides[] = { "lower", "upper", NULL };
    int side = 0;
    il_status st = il_native_need_matcher(n);
    if (st == IL_OK)
        st = il_scan_choice(&n->at, sides, "a slice: lower or upper", &side, n->err);
    *upper = side == 1;
    *s = side == 1 ? &n->upper : &n->lower;
    return st;
}

static il_status take_unmatched(il_native *n)
{
    static const char *const events[] = { "branch", "cap", "hole", NULL };
    il_pair *p = &n->pair;
    il_unmatched u = { 0 };
    const il_native_shape *s;
    int event = 0;
    il_status st = take_side(n, &s, &u.upper);
    if (st == IL_OK)
        st = take_arc(n, s, &u.arc);
    if (st == IL_OK)
        st = il_scan_choice(&n->at, events, "an event: branch, cap or hole", &event, n->err);
    if (st == IL_OK)
        st = il_native_count_row(n);
    if (st != IL_OK)
        return st;
    if (!il_grow(&p->unmatched, &p->cap_unmatched, p->n_unmatched + 1, sizeof *p->unmatched))
        return il_native_nomem(n);
    u.event = (il_event)event;
    p->unmatched[p->n_unmatched++] = u;
    return IL_OK;
}

static il_status take_insert(il_native *n)
{
    il_pair *p = &n->pair;
    il_insertion i = { 0 };
    const il_native_shape *s;
    il_status st = take_side(n, &s, &i.upper);
    if (st == IL_OK)
        st = take_ring_index(n, s, &i.at.ring);
    if (st == IL_OK)
        st = take_vertex_and_t(n, s, &i.at);
    if (st == IL_OK)
        st = il_scan_number(&n->at, &i.x, n->err);
    if (st == IL_OK)
        st = il_scan_number(&n->at, &i.y, n->err);
    if (st == IL_OK)
        st = il_native_count_row(n);
    if (st != IL_OK)
        return st;
    if (!il_grow(&p->insertion, &p->cap_insertions, p->n_insertions + 1, sizeof *p->insertion))
        return il_native_nomem(n);
    p->insertion[p->n_insertions++] = i;
    return IL_OK;
}

/* ---- cuts ------------------------------------------------------------------------- */

static il_cut *open_cut(il_native *n)
{
    return &n->pair.cut[n->pair.n_cuts - 1];
}

static il_status take_cut(il_native *n)
{
    il_pair *p = &n->pair;
    il_cut c = { 0 };
    const il_native_shape *s;
    il_status st = take_side(n, &s, &c.upper);
    if (st == IL_OK)
        st = take_ring_index(n, s, &c.ring);
    if (st == IL_OK)
        st = il_native_count_row(n);
    if (st != IL_OK)
        return st;
    if (!il_grow(&p->cut, &p->cap_cuts, p->n_cuts + 1, sizeof *p->cut))
        return il_native_nomem(n);
    p->cut[p->n_cuts++] = c;
    n->in = IL_IN_CUT;
    n->rows_line = n->at.line;
    return IL_OK;
}

il_status il_native_take_cut_row(il_native *n)
{
    il_cut *c = open_cut(n);
    double xy[2] = { 0 };
    il_status st = il_scan_numbers(&n->at, xy, 2, n->err);
    if (st == IL_OK)
        st = il_native_count_row(n);
    if (st != IL_OK)
        return st;
    if (!il_grow(&c->xy, &c->cap, c->n + 1, 2 * sizeof *c->xy))
        return il_native_nomem(n);
    memcpy(&c->xy[2 * c->n++], xy, sizeof xy);
    return IL_OK;
}

il_status il_native_close_cut(il_native *n)
{
    if (open_cut(n)->n < 2)
        return il_native_fail_at(n, n->rows_line, "this cut has %zu of the two or more points that it needs", open_cut(n)->n);
    return IL_OK;
}

const il_native_keyword il_native_pair_keywords[] = {
    { "pair", IL_IN_STACK, take_pair },
    { "gap", IL_IN_STACK, take_gap },
    { "matcher", IL_IN_PAIR, take_matcher },
    { "phi", IL_IN_PAIR, take_phi },
    { "match", IL_IN_PAIR, take_match },
    { "near", IL_IN_PAIR, take_near },
    { "unmatched", IL_IN_PAIR, take_unmatched },
    { "insert", IL_IN_PAIR, take_insert },
    { "cut", IL_IN_PAIR, take_cut },
    { NULL, IL_IN_STREAM, NULL },
};
