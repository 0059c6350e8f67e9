/* t-match.c - what matching two slices must give, whatever the slices. */
#include "config.h"
#include "base/alloc.h"
#include "couple.h"
#include "pairs.h"

static void add_outline(il_slice *s, const pairs_outline *o)
{
    for (size_t r = 0; r < o->n_rings; r++) {
        il_ring *ring = il_slice_add_ring(s);
        assert_non_null(ring);
        for (size_t k = o->first[r]; k < o->first[r + 1]; k++)
            assert_true(il_ring_add(ring, o->xy[2 * k], o->xy[2 * k + 1], 0));
    }
}

static couple of_family(pairs_family f, uint32_t seed)
{
    static pairs_pair p;
    couple c = { { IL_SLICE_INIT, IL_SLICE_INIT }, IL_PAIR_INIT };
    pairs_make(f, seed, &p);
    add_outline(&c.slice[0], &p.lower);
    add_outline(&c.slice[1], &p.upper);
    c.slice[1].z = 1;
    for (int k = 0; k < 2; k++)
        clean(&c.slice[k]);
    return c;
}

/* ---- cases ---- */

/* All rings whole, vertex by vertex, nowhere off. */
static void assert_identity(const couple *c)
{
    const il_pair *p = &c->pair;
    size_t k = 0;
    assert_int_equal(p->n_unmatched, 0);
    assert_int_equal(p->n_matches, c->slice[0].n);
    for (size_t i = 0; i < p->n_matches; i++) {
        const il_match *m = &p->match[i];
        assert_true(m->lower.from.vertex == m->lower.to.vertex && m->upper.from.vertex == m->upper.to.vertex);
        assert_true(m->lower.from.ring == m->upper.from.ring && m->lower.from.vertex == m->upper.from.vertex);
        assert_true(m->residual_mean == 0 && m->residual_max == 0);
    }
    for (size_t i = 0; i < p->n_groups; i++) {
        const double *g = p->group[i].fit.global;
        assert_int_equal(p->group[i].fit.steps, 0);
        assert_true(g[0] == 1 && g[1] == 0 && g[2] == 0 && g[3] == 1 && g[4] == 0 && g[5] == 0);
        assert_true(p->group[i].fit.least_jacobian == 1 && p->group[i].fit.distortion == 0);
    }
    for (uint32_t r = 0; r < c->slice[1].n; r++)
        for (uint32_t v = 0; v < c->slice[1].ring[r].n; v++, k++) {
            const double *xy = c->slice[1].ring[r].xy + 2 * (size_t)v;
            assert_true(p->phi[k].at.ring == r && p->phi[k].at.vertex == v && p->phi[k].at.t == 0);
            assert_true(p->phi[k].x == xy[0] && p->phi[k].y == xy[1]);
        }
    assert_int_equal(k, p->n_phi);
}

static void slices_that_are_equal_stay_as_they_are(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 40; seed++) {
        couple c = of_family(seed < PAIRS_N_NAMED ? PAIRS_NAMED : PAIRS_WILD, seed);
        il_slice_free(&c.slice[0]);
        assert_int_equal(il_slice_copy(&c.slice[0], &c.slice[1], NULL), IL_OK);
        c.slice[0].z = 0;
        match(&c);
        assert_identity(&c);
        assert_record(&c);
        free_couple(&c);
    }
    couple c = of_text("0 0, 90 0, 90 90, 0 90; 20 20, 20 70, 70 70, 70 20; 30 30, 60 31, 33 60",
                       "0 0, 90 0, 90 90, 0 90; 20 20, 20 70, 70 70, 70 20; 30 30, 60 31, 33 60");
    match(&c);
    assert_identity(&c);
    free_couple(&c);
}

static void records_of_all_families_are_sound(void **state)
{
    (void)state;
    for (int f = 0; f < PAIRS_N_FAMILIES; f++)
        for (uint32_t seed = 0; seed < (f == PAIRS_NAMED ? (uint32_t)PAIRS_N_NAMED : 5); seed++) {
            couple c = of_family((pairs_family)f, seed);
            match(&c);
            assert_record(&c);
            for (size_t i = 0; i < c.pair.n_matches && c.pair.n_groups == 1; i++)
                if (!c.pair.match[i].as_they_lie)
                    assert_residual(&c, &c.pair.match[i]);
            free_couple(&c);
        }
}

/* Slices that are alike match over most of their length. */
static void slices_that_are_alike_match_whole(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 20; seed++) {
        couple c = of_family(PAIRS_SLICE_LIKE, seed);
        match(&c);
        assert_int_equal(c.pair.n_matches, 1);
        assert_int_equal(c.pair.n_unmatched, 0);
        free_couple(&c);
    }
}

static void records_of_hard_stacks_are_sound(void **state)
{
    (void)state;
    il_ffd *solver = new_solver();
    for (int kind = 0; kind < STACK_N_KINDS; kind++)
        for (uint64_t seed = 0; seed < 2; seed++) {
            il_slice slice[6];
            size_t n = stack_make((stack_kind)kind, seed, slice);
            for (size_t k = 0; k < n; k++)
                clean(&slice[k]);
            for (size_t k = 0; k + 1 < n; k++) {
                couple c = { { slice[k], slice[k + 1] }, IL_PAIR_INIT };
                match_with(&c, solver);
                assert_record(&c);
                il_pair_free(&c.pair);
            }
            for (size_t k = 0; k < n; k++)
                il_slice_free(&slice[k]);
        }
    il_ffd_free(solver);
}

/* Edges much shorter than a cell, on shapes that match in part. */
static void short_edges_are_in_one_arc_each(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int n = 300; n <= 1000; n *= 3)
        for (int shape = 0; shape < 12; shape++) {
            couple c = { { IL_SLICE_INIT, IL_SLICE_INIT }, IL_PAIR_INIT };
            for (int side = 0; side < 2; side++) {
                il_ring *r = il_slice_add_ring(&c.slice[side]);
                assert_non_null(r);
                for (int k = 0; k < n; k++) {
                    double t = 2 * acos(-1.0) * k / n, size = 50 + (side ? 12 * cos(shape * t) : 0);
                    size += shape >= 6 ? random_between(&seed, -.02, .02) * shape : 0; /* rough */
                    size += side && shape % 2 && t < .5 ? 40 * sin(2 * acos(-1.0) * t) : 0;
                    assert_true(il_ring_add(r, size * cos(t), size * sin(t), 0));
                }
                c.slice[side].z = side;
                clean(&c.slice[side]);
            }
            match(&c);
            assert_record(&c);
            free_couple(&c);
        }
}

/* A comb whose teeth are hundreds of times as long as it is wide: points at the usual
 * spacing would be more than the rest of the tests together has. */
static void long_contours_are_taken_more_coarsely(void **state)
{
    (void)state;
    enum { TEETH = 300 };
    couple c = { { IL_SLICE_INIT, IL_SLICE_INIT }, IL_PAIR_INIT };
    for (int side = 0; side < 2; side++) {
        il_ring *r = il_slice_add_ring(&c.slice[side]);
        assert_non_null(r);
        assert_true(il_ring_add(r, 0, 0, 0) && il_ring_add(r, TEETH + .5, 0, 0));
        for (int k = TEETH; k >= 0; k--)
            assert_true(il_ring_add(r, k + .5, TEETH - .01 * side * k, 0) && il_ring_add(r, k + .25 + .1 * side, 1, 0));
        c.slice[side].z = side;
        clean(&c.slice[side]);
    }
    match(&c);
    assert_true(c.pair.n_phi < 20 * TEETH);
    assert_record(&c);
    free_couple(&c);
}

static void rings_without_a_partner_stay(void **state)
{
    (void)state;
    couple c = of_text("0 0, 9 0, 9 9, 0 9", "0 0, 9 0, 9 9, 0 9; 50 0, 60 0, 60 5");
    match(&c);
    assert_record(&c);
    assert_int_equal(c.pair.n_groups, 2);
    assert_true(c.pair.group[0].fitted && !c.pair.group[1].fitted);
    const il_phi_point *p = &c.pair.phi[c.pair.n_phi - 3];
    for (size_t k = 0; k < 3; k++)
        assert_true(p[k].at.ring == 1 && p[k].at.vertex == k && p[k].x == c.slice[1].ring[1].xy[2 * k]);
    free_couple(&c);
}

static void empty_slices_have_records(void **state)
{
    (void)state;
    static const char *const text[][2] = { { "", "" }, { "", "0 0, 1 0, 0 1" }, { "0 0, 1 0, 0 1", "" } };
    for (int k = 0; k < 3; k++) {
        couple c = of_text(text[k][0], text[k][1]);
        match(&c);
        assert_record(&c);
        assert_int_equal(c.pair.n_matches + c.pair.n_unmatched, 0);
        free_couple(&c);
    }
}

static void the_matcher_none_says_nothing(void **state)
{
    (void)state;
    const il_match_options o = { IL_MATCHER_NONE, false, 1 };
    couple c = of_family(PAIRS_WILD, 1);
    assert_int_equal(il_match_slices(&c.slice[0], &c.slice[1], &o, NULL, &c.pair, NULL), IL_OK);
    assert_false(il_pair_names_rings(&c.pair));
    assert_readable(&c);
    free_couple(&c);
}

static void lattices_are_kept_when_they_are_wanted(void **state)
{
    (void)state;
    const il_match_options o = { IL_MATCHER_FFD, false, 1 };
    couple c = of_family(PAIRS_DIFFERENT, 1), d = copy_of(&c);
    il_ffd *solver = new_solver();
    match(&c);
    assert_int_equal(il_match_slices(&d.slice[0], &d.slice[1], &o, solver, &d.pair, NULL), IL_OK);
    assert_true(c.pair.group[0].fit.n_lattices > 0 && d.pair.group[0].fit.n_lattices == 0);
    assert_readable(&d);
    il_fit_drop_lattices(&c.pair.group[0].fit);
    assert_same_text(&c, &d); /* and nothing else changes */
    il_ffd_free(solver);
    free_couple(&c);
    free_couple(&d);
}

/* ---- moved, scaled, turned round ---- */

/* Every coordinate v of both slices to scale * v + (dx, dy). */
static void transform(couple *c, double scale, double dx, double dy)
{
    for (int side = 0; side < 2; side++)
        for (size_t r = 0; r < c->slice[side].n; r++)
            for (size_t k = 0; k < 2 * c->slice[side].ring[r].n; k++) {
                double *v = &c->slice[side].ring[r].xy[k];
                *v = scale * *v + (k % 2 ? dy : dx);
            }
}

/* To multiples of 2^-20, so that moves are exact. */
static void round_to_grid(couple *c)
{
    for (int side = 0; side < 2; side++)
        for (size_t r = 0; r < c->slice[side].n; r++)
            for (size_t k = 0; k < 2 * c->slice[side].ring[r].n; k++)
                c->slice[side].ring[r].xy[k] = ldexp(rint(ldexp(c->slice[side].ring[r].xy[k], 20)), -20);
}

static void assert_same_arcs(const il_pair *a, const il_pair *b, double scale)
{
    assert_int_equal(a->n_matches, b->n_matches);
    assert_int_equal(a->n_unmatched, b->n_unmatched);
    for (size_t i = 0; i < a->n_matches; i++) {
        assert_memory_equal(&a->match[i].lower, &b->match[i].lower, sizeof a->match[i].lower);
        assert_memory_equal(&a->match[i].upper, &b->match[i].upper, sizeof a->match[i].upper);
        assert_true(scale * a->match[i].residual_mean == b->match[i].residual_mean);
        assert_true(scale * a->match[i].residual_max == b->match[i].residual_max);
        assert_true(a->match[i].as_they_lie == b->match[i].as_they_lie);
    }
    for (size_t i = 0; i < a->n_unmatched; i++) {
        assert_memory_equal(&a->unmatched[i].arc, &b->unmatched[i].arc, sizeof a->unmatched[i].arc);
        assert_true(a->unmatched[i].upper == b->unmatched[i].upper && a->unmatched[i].event == b->unmatched[i].event);
    }
}

static void assert_same_fits(const il_pair *a, const il_pair *b, double scale)
{
    assert_int_equal(a->n_groups, b->n_groups);
    for (size_t i = 0; i < a->n_groups; i++) {
        const il_fit *f = &a->group[i].fit, *g = &b->group[i].fit;
        assert_true(scale * f->residual_up_mean == g->residual_up_mean && scale * f->residual_down_max == g->residual_down_max);
        assert_true(f->least_jacobian == g->least_jacobian && f->distortion == g->distortion && f->steps == g->steps);
        assert_memory_equal(f->global, g->global, 4 * sizeof *f->global);
    }
}

static void scaling_by_a_power_of_two_scales_the_record(void **state)
{
    (void)state;
    static const int power[] = { -40, -3, 1, 20 };
    for (uint32_t seed = 0; seed < 8; seed++) {
        couple c = of_family(seed % 2 ? PAIRS_WILD : PAIRS_NAMED, seed), d = copy_of(&c);
        double scale = ldexp(1, power[seed % 4]);
        transform(&d, scale, 0, 0);
        match(&c);
        match(&d);
        assert_same_arcs(&c.pair, &d.pair, scale);
        assert_same_fits(&c.pair, &d.pair, scale);
        assert_int_equal(c.pair.n_phi, d.pair.n_phi);
        for (size_t k = 0; k < c.pair.n_phi; k++) {
            const il_phi_point *p = &c.pair.phi[k], *q = &d.pair.phi[k];
            assert_true(p->at.ring == q->at.ring && p->at.vertex == q->at.vertex && p->at.t == q->at.t);
            assert_true(scale * p->x == q->x && scale * p->y == q->y);
        }
        free_couple(&c);
        free_couple(&d);
    }
}

static void moving_exactly_moves_the_record(void **state)
{
    (void)state;
    static const double by[][2] = { { 1000, -3 }, { -65536, 65536 }, { 1 / 1024., 7 }, { 1e6, 1e6 } };
    for (uint32_t seed = 0; seed < 8; seed++) {
        couple c = of_family(seed % 2 ? PAIRS_WILD : PAIRS_NAMED, seed);
        round_to_grid(&c);
        couple d = copy_of(&c);
        transform(&d, 1, by[seed % 4][0], by[seed % 4][1]);
        match(&c);
        match(&d);
        assert_same_arcs(&c.pair, &d.pair, 1);
        assert_same_fits(&c.pair, &d.pair, 1);
        assert_int_equal(c.pair.n_phi, d.pair.n_phi);
        for (size_t k = 0; k < c.pair.n_phi; k++) { /* but for the rounding of sums */
            assert_near(d.pair.phi[k].x - by[seed % 4][0], c.pair.phi[k].x, 4e-10);
            assert_near(d.pair.phi[k].y - by[seed % 4][1], c.pair.phi[k].y, 4e-10);
        }
        free_couple(&c);
        free_couple(&d);
    }
}

static void where_rings_begin_does_not_matter_in_canonical_order(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (uint32_t k = 0; k < 6; k++) {
        couple c = of_family(PAIRS_DIFFERENT, k), d = copy_of(&c);
        for (int side = 0; side < 2; side++) {
            for (size_t r = 0; r < d.slice[side].n; r++)
                il_ring_rotate(&d.slice[side].ring[r], stack_random(&seed) % d.slice[side].ring[r].n);
            il_slice_put_in_order(&d.slice[side]);
        }
        match(&c);
        match(&d);
        assert_same_text(&c, &d);
        free_couple(&c);
        free_couple(&d);
    }
}

static void a_solver_that_was_used_gives_the_same_bytes(void **state)
{
    (void)state;
    il_ffd *solver = new_solver();
    for (uint32_t seed = 0; seed < PAIRS_N_NAMED; seed++) {
        couple c = of_family(PAIRS_NAMED, seed), d = copy_of(&c);
        match_with(&c, solver);
        match(&d);
        assert_same_text(&c, &d);
        free_couple(&c);
        free_couple(&d);
    }
    il_ffd_free(solver);
}

/* Every allocation failing in turn: told as such, nothing kept. */
static void little_memory_is_told(void **state)
{
    (void)state;
    const il_match_options o = { IL_MATCHER_FFD, true, 1 };
    couple c = of_text("0 0, 20 0, 20 20, 0 20; 40 0, 50 0, 50 5",
                       "1 0, 21 0, 21 20, 1 20; 40 50, 45 50, 40 55");
    long k = 0;
    for (il_status st = IL_E_NOMEM; st != IL_OK; k++) {
        il_ffd *solver = new_solver();
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        st = il_match_slices(&c.slice[0], &c.slice[1], &o, solver, &c.pair, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM));
        assert_true(st == IL_OK || (c.pair.n_groups == 0 && c.pair.phi == NULL && c.pair.match == NULL));
        il_ffd_free(solver);
        assert_true(k < 10000);
    }
    assert_true(k > 50);
    assert_record(&c);
    free_couple(&c);
}

/* What is written can be read: a needle of next to no area in the middle of a square
 * asks for no scale of 1e18, and no box reaches over the bound of coordinates. */
static void numbers_in_a_record_stay_within_bounds(void **state)
{
    (void)state;
    static const char *square[] = { "0 0, 100 0, 100 100, 0 100", "0 0, 9e14 0, 9e14 9e14, 0 9e14",
                                    "-999e12 -999e12, 999e12 -999e12, 999e12 999e12, -999e12 999e12" };
    static const char *other[] = { "50 50, 50.1 50, 50.1 50.0000000000001", "50 50, 50.0000001 50, 50 50.0000001",
                                   "50 50, 50.0000000000001 50, 50 50.0000000000001", "1e14 1e13, 9e14 2e13, 3e14 9e14",
                                   "999e12 -999e12, 999e12 999e12, -999e12 999e12" };
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k < 5; k++)
            for (int turned = 0; turned < 2; turned++) {
                couple c = turned ? of_text(other[k], square[i]) : of_text(square[i], other[k]);
                match(&c);
                assert_readable(&c);
                free_couple(&c);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slices_that_are_equal_stay_as_they_are),
        cmocka_unit_test(records_of_all_families_are_sound),
        cmocka_unit_test(slices_that_are_alike_match_whole),
        cmocka_unit_test(records_of_hard_stacks_are_sound),
        cmocka_unit_test(short_edges_are_in_one_arc_each),
        cmocka_unit_test(long_contours_are_taken_more_coarsely),
        cmocka_unit_test(rings_without_a_partner_stay),
        cmocka_unit_test(empty_slices_have_records),
        cmocka_unit_test(the_matcher_none_says_nothing),
        cmocka_unit_test(lattices_are_kept_when_they_are_wanted),
        cmocka_unit_test(scaling_by_a_power_of_two_scales_the_record),
        cmocka_unit_test(moving_exactly_moves_the_record),
        cmocka_unit_test(where_rings_begin_does_not_matter_in_canonical_order),
        cmocka_unit_test(a_solver_that_was_used_gives_the_same_bytes),
        cmocka_unit_test(little_memory_is_told),
        cmocka_unit_test(numbers_in_a_record_stay_within_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
