/* t-refit.c - pair records that follow their slices through rounding. */
#include "config.h"
#include "base/alloc.h"
#include "base/number.h"
#include "contours.h"
#include "match/ffd.h"
#include "match/link.h"
#include "match/refit.h"
#include "matching.h"
#include "model/order.h"
#include "region/clean.h"

#include <stdio.h>

/* Keeps the last two slices and the last pair; counts. */
typedef struct keeper {
    il_sink sink;
    il_slice slice[2];
    il_pair pair;
    size_t n_slices, n_pairs, n_stacks, n_ends;
} keeper;

static il_status on_stack_begin(il_sink *s, const il_stack_head *h, il_error *err)
{
    (void)h;
    (void)err;
    ((keeper *)s)->n_stacks++;
    return IL_OK;
}

static il_status on_slice(il_sink *s, il_slice *slice, il_error *err)
{
    keeper *k = (keeper *)s;
    (void)err;
    il_slice_free(&k->slice[0]);
    k->slice[0] = k->slice[1];
    k->slice[1] = *slice;
    *slice = (il_slice)IL_SLICE_INIT;
    k->n_slices++;
    return IL_OK;
}

static il_status on_pair(il_sink *s, il_pair *p, il_error *err)
{
    keeper *k = (keeper *)s;
    (void)err;
    il_pair_free(&k->pair);
    k->pair = *p;
    *p = (il_pair)IL_PAIR_INIT;
    k->n_pairs++;
    return IL_OK;
}

static il_status on_stack_end(il_sink *s, il_error *err)
{
    (void)s;
    (void)err;
    return IL_OK;
}

static il_status on_end(il_sink *s, il_error *err)
{
    (void)err;
    ((keeper *)s)->n_ends++;
    return IL_OK;
}

static keeper new_keeper(void)
{
    keeper k = { { on_stack_begin, on_slice, on_pair, on_stack_end, on_end },
                 { IL_SLICE_INIT, IL_SLICE_INIT }, IL_PAIR_INIT, 0, 0, 0, 0 };
    return k;
}

static void free_keeper(keeper *k)
{
    il_slice_free(&k->slice[0]);
    il_slice_free(&k->slice[1]);
    il_pair_free(&k->pair);
}

static il_status send(il_sink *to, const il_slice slice[2], il_pair *pair, il_error *err)
{
    const il_stack_head head = IL_STACK_HEAD_INIT;
    il_slice copy[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    il_status st = to->stack_begin(to, &head, err);
    for (int k = 0; st == IL_OK && k < 2; k++) {
        st = il_slice_copy(&copy[k], &slice[k], err);
        if (st == IL_OK)
            st = to->slice(to, &copy[k], err);
    }
    if (st == IL_OK)
        st = to->pair(to, pair, err);
    if (st == IL_OK)
        st = to->stack_end(to, err);
    if (st == IL_OK)
        st = to->end(to, err);
    il_slice_free(&copy[0]);
    il_slice_free(&copy[1]);
    return st;
}

/* Two slices and their pair (given up) through rounding into K. */
static il_status through(const il_slice slice[2], il_pair *pair, keeper *k, il_error *err)
{
    const il_clean_options o = { .round_float = true };
    il_refit *r = NULL;
    il_sink *cleaner = NULL;
    il_status st = il_refit_new(&r, &k->sink, err);
    if (st == IL_OK)
        st = il_cleaner_new(&cleaner, &o, il_refit_behind(r), NULL, err);
    if (st == IL_OK)
        st = send(il_refit_before(r, cleaner), slice, pair, err);
    il_cleaner_free(cleaner);
    il_refit_free(r);
    il_pair_free(pair);
    return st;
}

static il_pair matched(const il_slice slice[2])
{
    const il_match_options o = { IL_MATCHER_FFD, false, 1 };
    il_ffd *solver = NULL;
    il_pair p = IL_PAIR_INIT;
    assert_int_equal(il_ffd_new(&solver, NULL), IL_OK);
    assert_int_equal(il_match_slices(&slice[0], &slice[1], &o, solver, &p, NULL), IL_OK);
    il_ffd_free(solver);
    return p;
}

static void make_clean(il_slice *s)
{
    assert_int_equal(il_slice_clean(s, &(il_clean_options){ false }, NULL, NULL, NULL), IL_OK);
}

static void free_both(il_slice slice[2])
{
    il_slice_free(&slice[0]);
    il_slice_free(&slice[1]);
}

/* ---- comparing ---- */

static double rounded(double v)
{
    return il_number_round_float(v);
}

/* The same point of the slice, in places of WAS and of IS, which is rounded. */
static bool same_point(const il_slice *was, const il_place *p, const il_slice *is, const il_place *q)
{
    if (p->ring >= was->n || q->ring >= is->n || p->t != q->t)
        return false;
    const il_ring *a = &was->ring[p->ring], *b = &is->ring[q->ring];
    for (size_t k = 0; k < 2; k++) { /* the vertex, and the next */
        const double *v = a->xy + 2 * ((p->vertex + k) % a->n), *w = b->xy + 2 * ((q->vertex + k) % b->n);
        if (rounded(v[0]) != w[0] || rounded(v[1]) != w[1])
            return false;
    }
    return true;
}

static void assert_same_arc(const il_slice *was, const il_arc *a, const il_slice *is, const il_arc *b)
{
    assert_true(same_point(was, &a->from, is, &b->from));
    assert_true(same_point(was, &a->to, is, &b->to));
}

/* Ring P of WAS is ring Q of IS. */
static bool same_ring(const il_slice *was, uint32_t p, const il_slice *is, uint32_t q)
{
    const il_place at = { p, 0, 0 };
    for (uint32_t v = 0; v < is->ring[q].n; v++)
        if (same_point(was, &at, is, &(il_place){ q, v, 0 }))
            return true;
    return false;
}

static void assert_same_rings(const il_slice *was, const uint32_t *p, size_t n, const il_slice *is, const uint32_t *q, size_t m)
{
    assert_int_equal(n, m);
    for (size_t i = 0; i < n; i++) {
        bool found = false;
        for (size_t k = 0; k < n; k++)
            found |= same_ring(was, p[i], is, q[k]);
        assert_true(found && (i == 0 || q[i] > q[i - 1]));
    }
}

static void assert_phi_in_order(const il_pair *p)
{
    for (size_t k = 1; k < p->n_phi; k++) {
        const il_place *a = &p->phi[k - 1].at, *b = &p->phi[k].at;
        assert_true(a->ring < b->ring || (a->ring == b->ring && (a->vertex < b->vertex || (a->vertex == b->vertex && a->t < b->t))));
    }
}

/* The record IS of the rounded slices says what WAS says of WAS_SLICE. */
static void assert_carried(const il_slice was_slice[2], const il_pair *was, const keeper *is)
{
    const il_pair *p = &is->pair;
    assert_int_equal(was->n_groups, p->n_groups);
    assert_int_equal(was->n_phi, p->n_phi);
    assert_int_equal(was->n_matches, p->n_matches);
    assert_int_equal(was->n_unmatched, p->n_unmatched);
    assert_int_equal(was->n_insertions, p->n_insertions);
    for (size_t i = 0; i < was->n_groups; i++) {
        const il_group *a = &was->group[i], *b = &p->group[i];
        assert_same_rings(&was_slice[0], a->lower, a->n_lower, &is->slice[0], b->lower, b->n_lower);
        assert_same_rings(&was_slice[1], a->upper, a->n_upper, &is->slice[1], b->upper, b->n_upper);
        assert_int_equal(a->n_links, b->n_links);
        for (size_t k = 0; k < a->n_links; k++) {
            assert_true(same_ring(&was_slice[0], a->link[k].lower, &is->slice[0], b->link[k].lower));
            assert_true(same_ring(&was_slice[1], a->link[k].upper, &is->slice[1], b->link[k].upper));
        }
        assert_memory_equal(a->fit.global, b->fit.global, sizeof a->fit.global);
        assert_true(a->fitted == b->fitted && a->fit.residual_up_mean == b->fit.residual_up_mean);
    }
    for (size_t i = 0; i < was->n_matches; i++) {
        assert_same_arc(&was_slice[0], &was->match[i].lower, &is->slice[0], &p->match[i].lower);
        assert_same_arc(&was_slice[1], &was->match[i].upper, &is->slice[1], &p->match[i].upper);
        assert_true(was->match[i].residual_mean == p->match[i].residual_mean);
    }
    for (size_t i = 0; i < was->n_unmatched; i++) {
        bool up = was->unmatched[i].upper;
        assert_true(up == p->unmatched[i].upper);
        assert_same_arc(&was_slice[up], &was->unmatched[i].arc, &is->slice[up], &p->unmatched[i].arc);
    }
    for (size_t i = 0; i < was->n_insertions; i++) {
        bool up = was->insertion[i].upper;
        assert_true(up == p->insertion[i].upper && was->insertion[i].x == p->insertion[i].x);
        assert_true(same_point(&was_slice[up], &was->insertion[i].at, &is->slice[up], &p->insertion[i].at));
    }
    assert_int_equal(was->n_cuts, p->n_cuts);
    for (size_t i = 0; i < was->n_cuts; i++) {
        bool up = was->cut[i].upper;
        assert_true(up == p->cut[i].upper && same_ring(&was_slice[up], was->cut[i].ring, &is->slice[up], p->cut[i].ring));
        assert_int_equal(p->cut[i].n, 2);
        assert_memory_equal(was->cut[i].xy, p->cut[i].xy, 4 * sizeof(double));
    }
    assert_phi_in_order(p);
    for (size_t i = 0; i < was->n_phi; i++) {
        size_t found = 0;
        for (size_t k = 0; k < p->n_phi; k++)
            found += was->phi[i].x == p->phi[k].x && was->phi[i].y == p->phi[k].y &&
                     same_point(&was_slice[1], &was->phi[i].at, &is->slice[1], &p->phi[k].at);
        assert_int_equal(found, 1);
    }
}

/* A record made anew of the slices that K got. */
static void assert_matched_anew(const keeper *k)
{
    il_pair p = matched(k->slice);
    assert_int_equal(p.n_phi, k->pair.n_phi);
    assert_int_equal(p.n_matches, k->pair.n_matches);
    for (size_t i = 0; i < p.n_phi; i++) {
        assert_true(p.phi[i].x == k->pair.phi[i].x && p.phi[i].y == k->pair.phi[i].y && p.phi[i].at.t == k->pair.phi[i].at.t);
        assert_true(p.phi[i].at.ring == k->pair.phi[i].at.ring && p.phi[i].at.vertex == k->pair.phi[i].at.vertex);
    }
    il_pair_free(&p);
}

/* ---- cases ---- */

/* A column of boxes on whole numbers, their vertices off by less than a float tells:
 * in what order the rings stand, and where they begin, rounding decides. */
static il_slice noisy_boxes(int n, double size, double noise, uint64_t *seed)
{
    il_slice s = IL_SLICE_INIT;
    for (int i = 0; i < n; i++) {
        static const double corner[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
        il_ring *r = il_slice_add_ring(&s);
        assert_non_null(r);
        for (int k = 0; k < 4; k++)
            assert_true(il_ring_add(r, 100 + size * corner[k][0] + random_between(seed, -noise, noise),
                                    100 + 16 * i + size * corner[k][1] + random_between(seed, -noise, noise), 0));
    }
    make_clean(&s);
    return s;
}

static void add_cut(il_pair *p, bool upper, uint32_t ring)
{
    assert_true(il_grow(&p->cut, &p->cap_cuts, p->n_cuts + 1, sizeof *p->cut));
    il_cut *c = &p->cut[p->n_cuts++];
    *c = (il_cut){ .upper = upper, .ring = ring, .n = 2 };
    assert_true(il_grow(&c->xy, &c->cap, 2, 2 * sizeof *c->xy));
    memcpy(c->xy, (double[]){ 1, ring, 3, upper }, 4 * sizeof(double));
}

static il_pair copy_of_match(const il_slice slice[2], bool insert)
{
    il_pair p = matched(slice);
    for (uint32_t r = 0; insert && r < 2 && r < slice[0].n && r < slice[1].n; r++)
        add_cut(&p, r == 0, r);
    for (uint32_t r = 0; insert && r < 2 && r < slice[1].n; r++) {
        assert_true(il_grow(&p.insertion, &p.cap_insertions, p.n_insertions + 1, sizeof *p.insertion));
        p.insertion[p.n_insertions++] = (il_insertion){ r == 1, { r, 2, .25 }, 7, 8 };
    }
    return p;
}

static void places_are_carried_over_where_rings_are_renumbered(void **state)
{
    (void)state;
    uint64_t seed = 1;
    int moved = 0;
    for (int round = 0; round < 30; round++) {
        il_slice s[2] = { noisy_boxes(2 + round % 4, 8, 1e-7, &seed), noisy_boxes(2 + round % 4, 9, 1e-7, &seed) };
        s[1].z = 1;
        il_pair was = copy_of_match(s, true), p = copy_of_match(s, true);
        keeper k = new_keeper();
        assert_int_equal(through(s, &p, &k, NULL), IL_OK);
        assert_int_equal(k.n_slices, 2);
        assert_int_equal(k.n_pairs, 1);
        assert_carried(s, &was, &k);
        for (size_t i = 0; i < was.n_phi; i++)
            moved += was.phi[i].at.ring != k.pair.phi[i].at.ring || was.phi[i].x != k.pair.phi[i].x;
        il_pair_free(&was);
        free_keeper(&k);
        free_both(s);
    }
    assert_true(moved > 0); /* there was something to carry */
}

static void a_record_of_slices_that_floats_can_hold_stays(void **state)
{
    (void)state;
    uint64_t seed = 2;
    il_slice s[2] = { noisy_boxes(3, 8, 0, &seed), noisy_boxes(3, 9, 0, &seed) };
    s[1].z = 1;
    il_pair was = copy_of_match(s, true), p = copy_of_match(s, true);
    keeper k = new_keeper();
    assert_int_equal(through(s, &p, &k, NULL), IL_OK);
    assert_same_bits(&s[0], &k.slice[0]);
    assert_same_bits(&s[1], &k.slice[1]);
    assert_carried(s, &was, &k);
    assert_memory_equal(was.phi, k.pair.phi, was.n_phi * sizeof *was.phi);
    il_pair_free(&was);
    free_keeper(&k);
    free_both(s);
}

/* Vertices, edges or rings that rounding makes one: nothing to carry over to. */
static void what_rounding_joins_is_matched_anew(void **state)
{
    (void)state;
    static const char *const text[][2] = {
        { "0 0, 8 0, 8 8, 0 8", "0 0, 9 0, 9 5, 9.000000000001 5.000000000001, 9 9, 0 9" },
        { "0 0, 8 0, 8 8, 0 8", "0 0, 4.000000001 0, 4.000000001 9, 0 9; 4.000000002 0, 9 0, 9 9, 4.000000002 9" },
        { "0 0, 8 0, 8.000000000001 4, 8 4.000000000001, 8 8, 0 8", "0 0, 9 0, 9 9, 0 9" },
        { "0 0, 8 0, 8 8, 0 8; 100 0, 100.0000001 0, 100.0000001 1", "0 0, 9 0, 9 9, 0 9" } };
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        il_slice s[2] = { slice_of(text[i][0]), slice_of(text[i][1]) };
        s[1].z = 1;
        make_clean(&s[0]);
        make_clean(&s[1]);
        size_t before = il_slice_points(&s[0]) + il_slice_points(&s[1]);
        il_pair p = matched(s);
        keeper k = new_keeper();
        assert_int_equal(through(s, &p, &k, NULL), IL_OK);
        assert_true(il_slice_points(&k.slice[0]) + il_slice_points(&k.slice[1]) < before);
        assert_matched_anew(&k);
        free_keeper(&k);
        free_both(s);
    }
}

/* "0 0 join 4": the links of P, by groups; TO[200]. */
static char *links_text(const il_pair *p, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (size_t i = 0; i < p->n_groups; i++)
        for (size_t k = 0; k < p->group[i].n_links; k++) {
            const il_link *l = &p->group[i].link[k];
            n += (size_t)snprintf(to + n, 200 - n, "%s%u %u %s %g", n > 0 ? ", " : "", (unsigned)l->lower, (unsigned)l->upper,
                                  il_link_reason_word(l->reason), l->reach);
        }
    return to;
}

/* Slices that overlap nowhere or everywhere, but for what their links say. */
static void links_stay_with_what_rounding_makes_of_their_rings(void **state)
{
    (void)state;
#define BENT "0 0, 8 0, 8.000000001 4, 8 4.000000001, 8 8, 0 8"
#define NECK "0 0, 8 0, 8 4, 12 4, 12 0, 20 0, 20 8, 12 8, 12 4.000000000001, 8 4.000000000001, 8 8, 0 8"
#define SLIT "0 0, 4 0, 4 8, 0 8; 4.000000000001 0, 8 0, 8 8, 4.000000000001 8"
    static const struct { const char *lower, *upper; il_link link[3]; size_t n; const char *is; } c[] = {
        { BENT, "12 0, 20 0, 20 8, 12 8", { { 0, 0, IL_LINK_JOIN, 4 } }, 1, "0 0 join 4" },
        { BENT "; 30 0, 38 0, 38 8, 30 8", "12 0, 20 0, 20 8, 12 8", { { 1, 0, IL_LINK_GIVEN, 10 } }, 1, "1 0 given 10" },
        { BENT, "0 0, 9 0, 9 9, 0 9", { { 0 } }, 0, "" }, /* they overlap, and somebody says that they are apart */
        { NECK, "30 0, 38 0, 38 8, 30 8", { { 0, 0, IL_LINK_JOIN, 10 } }, 1, "0 0 join 10, 1 0 join 10" },
        { "30 0, 38 0, 38 8, 30 8", SLIT, { { 0, 0, IL_LINK_JOIN, 26 }, { 0, 1, IL_LINK_NEAR, 22 } }, 2, "0 0 near 22" },
        { BENT "; 50 0, 50.0000000001 0, 50 1e-10", "12 0, 20 0, 20 8, 12 8",
          { { 0, 0, IL_LINK_JOIN, 4 }, { 1, 0, IL_LINK_JOIN, 30 } }, 2, "0 0 join 4" }, /* a ring vanishes */
        { "0 0, 12 0, 12 12, 0 12; 4 4, 4 8, 8 8.000000000001, 8.000000000001 8, 8 4", "2 2, 20 2, 20 20, 2 20; 6 6, 6 10, 10 10, 10 6",
          { { 0, 0, IL_LINK_OVERLAP, 0 }, { 1, 1, IL_LINK_OVERLAP, 0 } }, 2, "0 0 overlap 0, 1 1 overlap 0" } };
    const il_match_options o = { IL_MATCHER_FFD, false, 1 };
    il_ffd *solver = NULL;
    assert_int_equal(il_ffd_new(&solver, NULL), IL_OK);
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char text[200];
        il_slice s[2] = { slice_of(c[i].lower), slice_of(c[i].upper) };
        s[1].z = 1;
        make_clean(&s[0]);
        make_clean(&s[1]);
        il_pair p = { .matcher = IL_MATCHER_FFD, .linked = true };
        assert_int_equal(il_link_group(&p, &s[0], &s[1], c[i].link, c[i].n, NULL), IL_OK);
        assert_int_equal(il_match_slices(&s[0], &s[1], &o, solver, &p, NULL), IL_OK);
        size_t before = il_slice_points(&s[0]) + il_slice_points(&s[1]);
        keeper k = new_keeper();
        assert_int_equal(through(s, &p, &k, NULL), IL_OK);
        assert_true(il_slice_points(&k.slice[0]) + il_slice_points(&k.slice[1]) < before);
        assert_string_equal(links_text(&k.pair, text), c[i].is);
        assert_int_equal(k.pair.n_phi > 0, 1);
        free_keeper(&k);
        free_both(s);
    }
    il_ffd_free(solver);
}

static void pairs_that_name_nothing_pass(void **state)
{
    (void)state;
    uint64_t seed = 3;
    il_slice s[2] = { noisy_boxes(3, 8, 1e-7, &seed), noisy_boxes(3, 9, 1e-7, &seed) };
    s[1].z = 1;
    il_pair p = IL_PAIR_INIT;
    p.matcher = IL_MATCHER_NONE;
    p.line = 17;
    assert_true(il_extra_add(&p.extra, "x-note kept", 11));
    keeper k = new_keeper();
    assert_int_equal(through(s, &p, &k, NULL), IL_OK);
    assert_int_equal(k.n_pairs, 1);
    assert_int_equal(k.pair.matcher, IL_MATCHER_NONE);
    assert_int_equal(k.pair.line, 17);
    assert_false(il_pair_names_rings(&k.pair));
    assert_string_equal(k.pair.extra->text, "x-note kept");
    free_keeper(&k);
    free_both(s);
}

/* Unmatched streams: slices pass, nothing is added. */
static void slices_without_pairs_pass(void **state)
{
    (void)state;
    const il_clean_options o = { .round_float = true };
    const il_stack_head head = IL_STACK_HEAD_INIT;
    uint64_t seed = 4;
    keeper k = new_keeper();
    il_refit *r = NULL;
    il_sink *cleaner = NULL;
    assert_int_equal(il_refit_new(&r, &k.sink, NULL), IL_OK);
    assert_int_equal(il_cleaner_new(&cleaner, &o, il_refit_behind(r), NULL, NULL), IL_OK);
    il_sink *to = il_refit_before(r, cleaner);
    for (int stack = 0; stack < 2; stack++) {
        assert_int_equal(to->stack_begin(to, &head, NULL), IL_OK);
        for (int i = 0; i < 3; i++) {
            il_slice s = noisy_boxes(2, 5, 1e-7, &seed);
            s.z = i;
            assert_int_equal(to->slice(to, &s, NULL), IL_OK);
            il_slice_free(&s);
        }
        assert_int_equal(to->stack_end(to, NULL), IL_OK);
    }
    assert_int_equal(to->end(to, NULL), IL_OK);
    assert_true(k.n_slices == 6 && k.n_pairs == 0 && k.n_stacks == 2 && k.n_ends == 1);
    il_cleaner_free(cleaner);
    il_refit_free(r);
    il_refit_free(NULL);
    free_keeper(&k);
}

/* It is rounded where its surface is made, when it has its place. */
static void terrain_passes_as_it_is(void **state)
{
    (void)state;
    const il_clean_options o = { .round_float = true };
    il_stack_head head = IL_STACK_HEAD_INIT;
    head.kind = IL_KIND_TERRAIN;
    uint64_t seed = 6;
    il_slice s[2] = { noisy_boxes(2, 5, 1e-7, &seed), noisy_boxes(2, 5, 1e-7, &seed) }, copy[2];
    s[0].z = 0.1;
    s[1].z = nextafter(0.1, 1); /* the same as a float */
    s[0].ring[0].open = true;
    il_pair p = IL_PAIR_INIT;
    keeper k = new_keeper();
    il_refit *r = NULL;
    il_sink *cleaner = NULL;
    assert_int_equal(il_refit_new(&r, &k.sink, NULL), IL_OK);
    assert_int_equal(il_cleaner_new(&cleaner, &o, il_refit_behind(r), NULL, NULL), IL_OK);
    il_sink *to = il_refit_before(r, cleaner);
    assert_int_equal(to->stack_begin(to, &head, NULL), IL_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(il_slice_copy(&copy[i], &s[i], NULL), IL_OK);
        assert_int_equal(to->slice(to, &copy[i], NULL), IL_OK);
        il_slice_free(&copy[i]);
    }
    assert_int_equal(to->pair(to, &p, NULL), IL_OK);
    assert_int_equal(to->stack_end(to, NULL), IL_OK);
    assert_true(k.n_slices == 2 && k.n_pairs == 1);
    for (int i = 0; i < 2; i++)
        assert_true(k.slice[i].z == s[i].z && il_slice_equal_rings(&k.slice[i], &s[i]));
    il_cleaner_free(cleaner);
    il_refit_free(r);
    free_keeper(&k);
    free_both(s);
}

static void little_memory_is_told(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int joined = 0; joined < 2; joined++) {
        il_slice s[2] = { noisy_boxes(1, 8, 1e-7, &seed), noisy_boxes(1, 8.5, 1e-7, &seed) };
        s[1].z = 1;
        if (joined) {
            il_slice_free(&s[1]);
            s[1] = slice_of("100 100, 108 100, 108 100.000000000001, 108 107.5, 100 108");
            s[1].z = 1;
        }
        il_status st = IL_E_NOMEM;
        long n = 0;
        for (; st != IL_OK; n++) {
            il_pair p = matched(s);
            keeper k = new_keeper();
            il_error err = IL_ERROR_INIT;
            il_alloc_test_fail_after(n);
            st = through(s, &p, &k, &err);
            il_alloc_test_fail_after(-1);
            assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM && k.n_pairs == 0));
            free_keeper(&k);
        }
        assert_true(n > 20);
        free_both(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_carried_over_where_rings_are_renumbered),
        cmocka_unit_test(a_record_of_slices_that_floats_can_hold_stays),
        cmocka_unit_test(what_rounding_joins_is_matched_anew),
        cmocka_unit_test(links_stay_with_what_rounding_makes_of_their_rings),
        cmocka_unit_test(pairs_that_name_nothing_pass),
        cmocka_unit_test(slices_without_pairs_pass),
        cmocka_unit_test(terrain_passes_as_it_is),
        cmocka_unit_test(little_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
