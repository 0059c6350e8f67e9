#include "config.h"
#include "base/alloc.h"
#include "base/number.h"
#include "loft/follow.h"
#include "loft/slab.h"
#include "lofting.h"
#include "region/clean.h"
#include "stacks.h"
#include "test.h"
#include "warp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TURN = 6.283185307179586;

/* ---- shapes ---- */

static il_slice new_slice(double z)
{
    il_slice s = IL_SLICE_INIT;
    s.z = z;
    return s;
}

/* A ring of N points round (CX, CY); the radius swings by SWING, WAVES times. */
static void add_star(il_slice *s, double cx, double cy, double radius, double swing, int waves, int n, bool hole)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    for (int i = 0; i < n; i++) {
        double a = (hole ? -1 : 1) * TURN * i / n, rho = radius * (1 + swing * cos(waves * a));
        assert_true(il_ring_add(r, cx + rho * cos(a), cy + rho * sin(a), 0));
    }
}

static void add_circle(il_slice *s, double cx, double cy, double radius, int n)
{
    add_star(s, cx, cy, radius, 0, 0, n, false);
}

static void clean_for(il_slice *s, bool round_float)
{
    il_clean_options o = { .round_float = round_float };
    if (round_float)
        s->z = il_number_round_float(s->z);
    assert_int_equal(il_slice_clean(s, &o, NULL, NULL, NULL), IL_OK);
}

static void clean(il_slice *s)
{
    clean_for(s, false);
}

static keeper loft_two(il_slice slice[2], il_pair *pair)
{
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    keeper k = new_keeper();
    if (loft_pairs(&k, slice, 2, pair, &o, &err) != IL_OK)
        fail_msg("%s", err.text);
    assert_sound(&k, "two", 0);
    free_slices(slice, 2);
    return k;
}

static bool settled_by(const keeper *k, il_attempt attempt)
{
    double all = k->facts.length_by[0] + k->facts.length_by[1] + k->facts.length_by[2];
    return k->facts.length_alone == 0 && k->facts.length_by[attempt] == all;
}

/* ---- one group ---- */

static void a_cylinder_sheared_by_diameters_is_one_piece_of_the_prisms_volume(void **state)
{
    (void)state;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    add_circle(&slice[0], 0, 0, 1, 40);
    add_circle(&slice[1], 7, 2, 1, 40);
    clean(&slice[0]), clean(&slice[1]);
    double area = il_slice_area(&slice[0]);
    warp w = { warp_affine, { 1, 0, 0, 1, -7, -2 }, 1 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    warp_match_rings(&p, 0, 3, 0, 3);
    keeper k = loft_two(slice, &p);
    assert_int_equal(k.facts.components, 1);
    assert_true(fabs(k.facts.volume - area) < 1e-9);
    assert_true(settled_by(&k, IL_ATTEMPT_S));
    il_mesh_free(&k.mesh);
}

static void without_phi_it_is_two_caps(void **state)
{
    (void)state;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    add_circle(&slice[0], 0, 0, 1, 40);
    add_circle(&slice[1], 7, 2, 1, 40);
    clean(&slice[0]), clean(&slice[1]);
    keeper k = loft_two(slice, NULL);
    assert_int_equal(k.facts.components, 2);
    assert_true(settled_by(&k, IL_ATTEMPT_B));
    il_mesh_free(&k.mesh);
}

/* phi turns back what was turned by 50 degrees: the surface twists, and is
 * thinner in the middle than the prism, as ruled surfaces are. */
static void a_star_that_turns_keeps_its_arms(void **state)
{
    (void)state;
    double turn = 20 * TURN / 360;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    add_star(&slice[0], 0, 0, 10, .4, 5, 100, false);
    add_star(&slice[1], 0, 0, 10, .4, 5, 100, false);
    for (size_t i = 0; i < slice[1].ring[0].n; i++) {
        double *p = slice[1].ring[0].xy + 2 * i, x = p[0], y = p[1];
        p[0] = cos(turn) * x - sin(turn) * y;
        p[1] = sin(turn) * x + cos(turn) * y;
    }
    clean(&slice[0]), clean(&slice[1]);
    double area = il_slice_area(&slice[0]);
    warp w = { warp_affine, { cos(turn), sin(turn), -sin(turn), cos(turn), 0, 0 }, 0 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    warp_match_rings(&p, 0, 0, 0, 0);
    keeper k = loft_two(slice, &p);
    assert_true(settled_by(&k, IL_ATTEMPT_S));
    assert_int_equal(k.facts.triangles, 2 * 100 + 2 * 98);
    assert_true(k.facts.volume < area && k.facts.volume > .93 * area);
    il_mesh_free(&k.mesh);
}

static void a_tube_that_slants_keeps_its_bore(void **state)
{
    (void)state;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    for (int i = 0; i < 2; i++) {
        add_star(&slice[i], 9 * i, 0, 3, .1, 3, 60, false);
        add_star(&slice[i], 9 * i, 0, 2, .1, 4, 50, true);
        clean(&slice[i]);
    }
    double area = il_slice_area(&slice[0]);
    warp w = { warp_affine, { 1, 0, 0, 1, -9, 0 }, 2 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    warp_match_rings(&p, 0, 0, 0, 0);
    warp_match_rings(&p, 1, 0, 1, 0);
    keeper k = loft_two(slice, &p);
    assert_int_equal(k.facts.components, 1);
    assert_int_equal(k.facts.genus, 1);
    assert_true(settled_by(&k, IL_ATTEMPT_S));
    assert_true(fabs(k.facts.volume - area) < 5e-4 * area); /* turned diagonals move the strips a little */
    il_mesh_free(&k.mesh);
}

static void without_matched_arcs_phi_alone_does_it(void **state)
{
    (void)state;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    add_star(&slice[0], 0, 0, 10, .2, 3, 70, false);
    add_star(&slice[1], 30, 5, 9, .2, 3, 60, false);
    clean(&slice[0]), clean(&slice[1]);
    warp w = { warp_affine, { 1, 0, 0, 1, -30, -5 }, 1 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    keeper k = loft_two(slice, &p);
    assert_int_equal(k.facts.components, 1);
    assert_true(settled_by(&k, IL_ATTEMPT_P));
    il_mesh_free(&k.mesh);
}

/* ---- slices that correspond ---- */

/* LOWER is phi of a star resampled, UPPER the star; both have N and M vertices
 * and a hole; a little noise on the lower. */
static void make_corresponding(il_slice slice[2], const warp *w, size_t n, size_t m, double noise, uint64_t *s)
{
    double swing = .3 * stack_uniform(s);
    int waves = 2 + (int)(stack_random(s) % 6);
    for (int k = 0; k < 2; k++) {
        int count = (int)(k ? m : n);
        slice[k] = new_slice(k);
        add_star(&slice[k], 3, 4, 10, swing, waves, count, false);
        add_star(&slice[k], 3, 4, 4, swing, waves, 5 + count / 2, true);
    }
    for (size_t r = 0; r < 2; r++)
        for (size_t i = 0; i < slice[0].ring[r].n; i++) {
            double *p = slice[0].ring[r].xy + 2 * i, to[2];
            w->map(p, w->a, to);
            p[0] = to[0] + noise * (stack_uniform(s) - .5);
            p[1] = to[1] + noise * (stack_uniform(s) - .5);
        }
    clean(&slice[0]), clean(&slice[1]);
}

/* The outer ring's number and the hole's. */
static uint32_t ring_of(const il_slice *s, bool hole)
{
    return (il_ring_area2(&s->ring[0]) < 0) == hole ? 0 : 1;
}

static void slices_that_correspond_are_settled_by_their_arcs(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 100; seed++) {
        uint64_t s = seed;
        il_slice slice[2];
        warp w = { warp_wavy, { 40 * stack_uniform(&s), 0, 1.5 * stack_uniform(&s), .3 }, 3 };
        size_t n = 20 + stack_random(&s) % 200, m = 20 + stack_random(&s) % 200;
        make_corresponding(slice, &w, n, m, seed % 2 ? .02 : 0, &s);
        il_pair p = warp_pair(&slice[0], &slice[1], &w);
        for (int hole = 0; hole < 2; hole++)
            warp_match_rings(&p, ring_of(&slice[0], hole), 0, ring_of(&slice[1], hole), 0);
        keeper k = loft_two(slice, &p);
        if (!settled_by(&k, IL_ATTEMPT_S))
            fail_msg("seed %llu", (unsigned long long)seed);
        assert_int_equal(k.facts.components, 1);
        assert_int_equal(k.facts.genus, 1);
        /* no vertices but the contours': lids and walls */
        assert_int_equal(k.facts.vertices, k.facts.points);
        il_mesh_free(&k.mesh);
    }
}

/* A finger of the upper slice that the lower lacks: the rest of the rings is
 * matched, from place to place within edges, and the finger's tip is capped. */
static void a_finger_without_a_partner_is_left_out_of_the_wall(void **state)
{
    (void)state;
    static const double body[][2] = { { 0, 0 }, { 10, 0 }, { 10, 4 }, { 10, 5 }, { 10, 6 }, { 10, 10 }, { 0, 10 } };
    static const double finger[][2] = { { 0, 0 }, { 10, 0 }, { 10, 4 }, { 18, 4.5 }, { 18, 5.5 }, { 10, 6 }, { 10, 10 }, { 0, 10 } };
    for (int zero = 0; zero < 2; zero++) { /* the base of the finger: as wide as it is, or one place */
        il_slice slice[2] = { new_slice(0), new_slice(1) };
        il_ring *low = il_slice_add_ring(&slice[0]), *high = il_slice_add_ring(&slice[1]);
        for (size_t i = 0; i < 7; i++)
            assert_true(il_ring_add(low, body[i][0], body[i][1], 0));
        for (size_t i = 0; i < 8; i++)
            assert_true(il_ring_add(high, finger[i][0] + 30, finger[i][1], 0));
        clean(&slice[0]), clean(&slice[1]);
        double area = il_slice_area(&slice[0]), with_finger = il_slice_area(&slice[1]);
        warp w = { warp_affine, { 1, 0, 0, 1, -30, 0 }, 1 };
        il_pair p = warp_pair(&slice[0], &slice[1], &w);
        il_place both = { 0, 3, 0 }, finger_end = { 0, 1, .875 }, finger_begin = { 0, 5, .25 };
        if (zero)
            warp_match_arcs(&p, (il_arc){ both, both }, (il_arc){ { 0, 5, 0 }, { 0, 2, 0 } });
        else
            warp_match_arcs(&p, (il_arc){ { 0, 4, .25 }, { 0, 1, .875 } }, (il_arc){ finger_begin, finger_end });
        keeper k = loft_two(slice, &p);
        assert_int_equal(k.facts.components, 1);
        assert_int_equal(k.facts.genus, 0);
        assert_true(settled_by(&k, IL_ATTEMPT_S));
        assert_true(k.facts.volume > area && k.facts.volume < with_finger);
        il_mesh_free(&k.mesh);
    }
}

/* ---- several slabs ---- */

/* Five slices that wander: every other slab is left without arcs, so that it
 * puts points on the contours that its neighbours' arcs lie on. */
static void points_that_neighbours_insert_are_matched_too(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        il_slice slice[5];
        il_pair pair[4];
        uint64_t s = seed;
        double volume = 0;
        for (int i = 0; i < 5; i++) {
            slice[i] = new_slice(i);
            add_star(&slice[i], 7 * i, 3 * i, 5, .2, 3, 30 + (int)(stack_random(&s) % 30), false);
            clean(&slice[i]);
            if (i > 0) {
                warp w = { warp_affine, { 1, 0, 0, 1, -7, -3 }, 1 };
                pair[i - 1] = warp_pair(&slice[i - 1], &slice[i], &w);
                if ((seed + (uint64_t)i) % 2)
                    warp_match_rings(&pair[i - 1], 0, 0, 0, 0);
                volume += (il_slice_area(&slice[i - 1]) + il_slice_area(&slice[i])) / 2;
            }
        }
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        il_error err = IL_ERROR_INIT;
        keeper k = new_keeper();
        if (loft_pairs(&k, slice, 5, pair, &o, &err) != IL_OK)
            fail_msg("seed %llu: %s", (unsigned long long)seed, err.text);
        assert_sound(&k, "wandering", seed);
        assert_int_equal(k.facts.components, 1);
        assert_true(k.facts.vertices > k.facts.points);
        assert_true(k.facts.length_by[IL_ATTEMPT_S] > 0 && k.facts.length_by[IL_ATTEMPT_P] > 0);
        assert_true(k.facts.length_by[IL_ATTEMPT_B] == 0);
        assert_true(fabs(k.facts.volume - volume) < .02 * volume);
        il_mesh_free(&k.mesh);
        free_slices(slice, 5);
    }
}

/* ---- groups ---- */

static void two_rings_that_slant_past_each_other_are_two_pieces(void **state)
{
    (void)state;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    add_circle(&slice[0], 0, 0, 1, 24);
    add_circle(&slice[0], 5, 0, 1, 24);
    add_circle(&slice[1], 5, 4, 1, 24);
    add_circle(&slice[1], 10, 4, 1, 24);
    clean(&slice[0]), clean(&slice[1]);
    static const uint32_t of[2] = { 0, 1 };
    warp w = { warp_affine, { 1, 0, 0, 1, -5, -4 }, 0 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    warp_regroup(&p, of, 2, of, 2, 2);
    warp_match_rings(&p, 0, 0, 0, 0);
    warp_match_rings(&p, 1, 0, 1, 0);
    keeper k = loft_two(slice, &p);
    assert_int_equal(k.facts.components, 2);
    assert_true(settled_by(&k, IL_ATTEMPT_S));
    il_mesh_free(&k.mesh);
}

/* Each of two rings goes to the other's place: the prisms cross. */
static void groups_whose_surfaces_cross_are_joined(void **state)
{
    (void)state;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    for (int i = 0; i < 2; i++) {
        add_circle(&slice[i], 0, 0, 1, 24);
        add_circle(&slice[i], 5, 0, 1, 24);
        clean(&slice[i]);
    }
    static const uint32_t lower[2] = { 0, 1 }, upper[2] = { 1, 0 };
    warp w = { warp_affine, { 1, 0, 0, 1, 0, 0 }, 0 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    for (size_t i = 0; i < p.n_phi; i++)
        p.phi[i].x += p.phi[i].at.ring == 0 ? 5 : -5;
    warp_regroup(&p, lower, 2, upper, 2, 2);
    warp_match_rings(&p, 0, 0, 1, 0);
    warp_match_rings(&p, 1, 0, 0, 0);
    double area = il_slice_area(&slice[0]);
    keeper k = loft_two(slice, &p);
    assert_int_equal(k.facts.components, 2);
    assert_true(settled_by(&k, IL_ATTEMPT_B));
    assert_true(fabs(k.facts.volume - area) < 1e-9);
    il_mesh_free(&k.mesh);
}

/* Two groups: the first slants by SHIFT with a phi that is trusted, the second stays and its phi,
 * which would take it far away, is not. */
static il_pair one_of_two_trusted(il_slice slice[2], double shift)
{
    static const uint32_t of[2] = { 0, 1 };
    for (int i = 0; i < 2; i++) {
        slice[i] = new_slice(i);
        add_circle(&slice[i], shift * i, 0, 1, 24);
        add_circle(&slice[i], 3, 0, 1, 24);
        clean(&slice[i]);
    }
    const uint32_t upper[2] = { shift > 3, shift < 3 };
    warp w = { warp_affine, { 1, 0, 0, 1, -shift, 0 }, 1 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    warp_regroup(&p, of, 2, upper, 2, 2);
    p.group[1].fit.distortion = 9;
    return p;
}

static void rings_whose_phi_is_not_trusted_stay_where_they_lie(void **state)
{
    (void)state;
    il_slice slice[2];
    il_pair p = one_of_two_trusted(slice, 1);
    const uint32_t group_of[2] = { 0, 1 };
    il_section upper;
    il_follow f;
    warp_match_rings(&p, 0, 0, 0, 0);
    assert_int_equal(il_section_from_slice(&upper, &slice[1], NULL), IL_OK);
    assert_int_equal(il_follow_begin(&f, &p, &upper, group_of, NULL), IL_OK);
    assert_true(f.phi.pair && f.group[0] && !f.group[1] && f.rows.n_phi < p.n_phi);
    for (size_t k = 0; k < f.rows.n_phi; k++) {
        const il_phi_point *q = &f.rows.phi[k];
        const double *xy = slice[1].ring[q->at.ring].xy + 2 * (size_t)q->at.vertex;
        assert_true(q->at.t == 0 || q->at.ring == 0);
        if (q->at.t == 0)
            assert_true(fabs(q->x - (xy[0] - (q->at.ring == 0))) < 1e-12 && q->y == xy[1]);
    }
    assert_true(il_follow_holds(&f, 0, 0) && !il_follow_holds(&f, 0, 1));
    il_follow_free(&f);
    il_section_free(&upper);
    il_pair_free(&p);
    free_slices(slice, 2);
}

/* Through the one that stays: no surface has both. */
static void a_group_that_slants_through_one_that_stays_is_capped(void **state)
{
    (void)state;
    il_slice slice[2];
    il_pair p = one_of_two_trusted(slice, 6);
    keeper k = loft_two(slice, &p);
    assert_int_equal(k.facts.components, 3);
    il_mesh_free(&k.mesh);
}

/* A ring in no group ends under a cap, although one lies over it. */
static void rings_in_no_group_are_capped(void **state)
{
    (void)state;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    for (int i = 0; i < 2; i++) {
        add_circle(&slice[i], 0, 0, 3, 40);
        add_circle(&slice[i], 20, 0, 3, 40);
    }
    add_star(&slice[0], 0, 0, 1, 0, 0, 20, true); /* a hole that ends */
    clean(&slice[0]), clean(&slice[1]);
    warp w = { warp_affine, { 1, 0, 0, 1, 0, 0 }, 0 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    il_group *g = &p.group[0];
    for (uint32_t r = 0; r < 3; r++)
        if (il_ring_area2(&slice[0].ring[r]) > 0 && slice[0].ring[r].xy[0] < 10)
            g->lower[0] = r;
    g->n_lower = g->n_upper = 1;
    double both = il_slice_area(&slice[1]), gone = fabs(il_ring_area2(&slice[1].ring[1])) / 2;
    keeper k = loft_two(slice, &p);
    /* the prism with a dome hollowed out below, and two domes that do not meet */
    assert_int_equal(k.facts.components, 3);
    assert_int_equal(k.facts.genus, 0);
    assert_true(k.facts.length_alone > 0 && k.facts.length_by[IL_ATTEMPT_P] + k.facts.length_by[IL_ATTEMPT_S] > 0);
    assert_true(k.facts.volume > both - gone && k.facts.volume < both);
    il_mesh_free(&k.mesh);
}

/* ---- phi that is wrong ---- */

static void mirror(const double p[2], const double *a, double out[2])
{
    (void)a;
    out[0] = -p[0], out[1] = p[1];
}

static void fold(const double p[2], const double *a, double out[2])
{
    out[0] = a[0] * p[0] * p[0], out[1] = p[1];
}

static void scatter(const double p[2], const double *a, double out[2])
{
    uint64_t seed = (uint64_t)(int64_t)(1e6 * p[0]) * 7919 + (uint64_t)(int64_t)(1e6 * p[1]);
    out[0] = a[0] * (stack_uniform(&seed) - .5);
    out[1] = a[0] * (stack_uniform(&seed) - .5);
}

static void collapse(const double p[2], const double *a, double out[2])
{
    (void)p;
    out[0] = a[0], out[1] = a[1];
}

static void what_phi_has_wrong_falls_to_the_identity(void **state)
{
    (void)state;
    const warp wrong[] = {
        { mirror, { 0 }, 1 }, { fold, { 1e-2 }, 1 }, { fold, { 1e6 }, 0 }, { scatter, { 30 }, 1 }, { scatter, { 1e12 }, 0 },
        { scatter, { 1e-12 }, 0 }, { collapse, { 1, 2 }, 1 }, { collapse, { 1e14, -1e14 }, 0 },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        for (int matched = 0; matched < 2; matched++) {
            il_slice slice[2] = { new_slice(0), new_slice(1) };
            add_star(&slice[0], 1, 0, 10, .2, 3, 70, false);
            add_star(&slice[1], 0, 1, 9, .2, 3, 60, false);
            clean(&slice[0]), clean(&slice[1]);
            il_pair p = warp_pair(&slice[0], &slice[1], &wrong[i]);
            if (matched)
                warp_match_rings(&p, 0, 0, 0, 0);
            keeper k = loft_two(slice, &p);
            if (!matched)
                assert_true(settled_by(&k, IL_ATTEMPT_B));
            il_mesh_free(&k.mesh);
        }
}

/* What is nowhere near the lower slice is a map all the same, and its caps meet nothing. */
static void a_map_to_far_away_makes_two_caps(void **state)
{
    (void)state;
    il_slice slice[2] = { new_slice(0), new_slice(1) };
    add_circle(&slice[0], 0, 0, 5, 40);
    add_circle(&slice[1], 0, 0, 4, 40);
    clean(&slice[0]), clean(&slice[1]);
    warp w = { warp_affine, { 1, 0, 0, 1, 1000, 0 }, 0 };
    il_pair p = warp_pair(&slice[0], &slice[1], &w);
    keeper k = loft_two(slice, &p);
    il_mesh_free(&k.mesh);
}

/* ---- without memory ---- */

/* Every allocation fails in turn while two groups are lofted, joined and lofted again. */
static void lofting_fails_cleanly(bool trusted)
{
    il_status st = IL_E_NOMEM;
    for (long limit = 0; st != IL_OK; limit++) {
        static const uint32_t lower[2] = { 0, 1 }, upper[2] = { 1, 0 };
        il_slice slice[2] = { new_slice(0), new_slice(1) };
        for (int i = 0; i < 2; i++) {
            add_circle(&slice[i], 0, 0, 1, 5);
            add_circle(&slice[i], 3, 0, 1, 5);
            clean(&slice[i]);
        }
        warp w = { warp_affine, { 1, 0, 0, 1, 0, 0 }, 1 };
        il_pair p = warp_pair(&slice[0], &slice[1], &w);
        for (size_t i = 0; i < p.n_phi; i++)
            p.phi[i].x += p.phi[i].at.ring == 0 ? 3 : -3;
        warp_regroup(&p, lower, 2, upper, 2, 2);
        warp_match_rings(&p, 0, 0, 1, 0);
        p.group[1].fit.distortion = trusted ? 0 : 9;
        il_section section[2];
        il_error err = IL_ERROR_INIT;
        for (int i = 0; i < 2; i++)
            assert_int_equal(il_section_from_slice(&section[i], &slice[i], &err), IL_OK);
        il_slab slab;
        il_alloc_test_fail_after(limit);
        st = il_slab_loft(&slab, &section[0], &section[1], &p, false, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || st == IL_E_NOMEM);
        il_slab_free(&slab);
        for (int i = 0; i < 2; i++)
            il_section_free(&section[i]);
        free_slices(slice, 2);
        il_pair_free(&p);
    }
}

static void without_memory_it_fails_cleanly(void **state)
{
    (void)state;
    lofting_fails_cleanly(true);
    lofting_fails_cleanly(false);
}

/* ---- anything ---- */

static double between(uint64_t *s, double low, double high)
{
    return low + (high - low) * stack_uniform(s);
}

static uint32_t below(uint64_t *s, size_t n)
{
    return (uint32_t)(stack_random(s) % n);
}

static warp random_warp(uint64_t *s)
{
    static void (*const maps[])(const double *, const double *, double *) = {
        warp_affine, warp_affine, warp_wavy, warp_wavy, warp_wavy, fold, scatter, collapse, mirror };
    warp w = { maps[below(s, below(s, 8) == 0 ? 9 : 5)], { 0 }, below(s, 3) };
    if (w.map == warp_affine) {
        double turn = between(s, -.5, .5), grow = between(s, .7, 1.4), shift = below(s, 2) ? 0 : between(s, -10, 10);
        double a[6] = { grow * cos(turn), -sin(turn), grow * sin(turn), cos(turn), shift, -shift / 2 };
        memcpy(w.a, a, sizeof a);
    } else if (w.map == warp_wavy) {
        double a[4] = { between(s, -5, 5), between(s, -5, 5), between(s, 0, 1.5), between(s, 0, 1) };
        memcpy(w.a, a, sizeof a);
    } else {
        w.a[0] = between(s, 0, 20);
    }
    return w;
}

static il_place random_place(const il_slice *slice, uint32_t r, uint64_t *s)
{
    return (il_place){ r, below(s, slice->ring[r].n), below(s, 2) ? 0 : stack_uniform(s) };
}

/* Arcs without any sense, some of them ends to ends. */
static void add_random_matches(il_pair *p, const il_slice slice[2], uint64_t *s)
{
    if (slice[0].n == 0 || slice[1].n == 0)
        return;
    for (uint32_t n = below(s, 5); n > 0; n--) {
        uint32_t r = below(s, slice[0].n), u = below(s, slice[1].n);
        il_arc low = { random_place(&slice[0], r, s), random_place(&slice[0], r, s) };
        il_arc high = { random_place(&slice[1], u, s), random_place(&slice[1], u, s) };
        if (p->n_matches > 0 && below(s, 2)) { /* goes on where the last one ended, on one side or both */
            if (below(s, 3))
                low.from = p->match[p->n_matches - 1].lower.to, low.to.ring = low.from.ring;
            if (below(s, 3))
                high.from = p->match[p->n_matches - 1].upper.to, high.to.ring = high.from.ring;
        }
        if (below(s, 3) == 0)
            low.to = low.from;
        if (below(s, 3) == 0)
            high.to = high.from;
        warp_match_arcs(p, low, high);
    }
}

/* Every ring matched with one of the other slice, all of it or two halves. */
static void add_ring_matches(il_pair *p, const il_slice slice[2], uint64_t *s)
{
    for (uint32_t r = 0; r < slice[0].n && r < slice[1].n; r++) {
        size_t n = slice[0].ring[r].n, m = slice[1].ring[r].n;
        if (below(s, 2)) {
            warp_match_rings(p, r, below(s, n), r, below(s, m));
            continue;
        }
        il_place a = { r, 0, 0 }, b = { r, (uint32_t)n / 2, .25 }, c = { r, 0, 0 }, d = { r, (uint32_t)m / 2, .75 };
        warp_match_arcs(p, (il_arc){ a, b }, (il_arc){ c, d });
        if (below(s, 2))
            warp_match_arcs(p, (il_arc){ b, a }, (il_arc){ d, c });
    }
}

static void regroup_at_random(il_pair *p, const il_slice slice[2], uint64_t *s)
{
    uint32_t of[2][64];
    size_t n = 1 + below(s, 3);
    if (slice[0].n > 64 || slice[1].n > 64)
        return;
    for (size_t k = 0; k < 2; k++)
        for (size_t r = 0; r < slice[k].n; r++)
            of[k][r] = below(s, n);
    warp_regroup(p, of[0], slice[0].n, of[1], slice[1].n, n);
    if (below(s, 2)) /* some rings in none */
        p->group[0].n_lower /= 2;
}

static void random_pairs(const il_slice *slice, size_t n, il_pair *pair, uint64_t seed)
{
    for (size_t i = 0; i + 1 < n; i++) {
        uint64_t s = seed * 31 + i;
        warp w = random_warp(&s);
        pair[i] = warp_pair(&slice[i], &slice[i + 1], &w);
        if (below(&s, 3) == 0)
            regroup_at_random(&pair[i], &slice[i], &s);
        switch (below(&s, 3)) {
        case 0: add_random_matches(&pair[i], &slice[i], &s); break;
        case 1: add_ring_matches(&pair[i], &slice[i], &s); break;
        default: break;
        }
        if (below(&s, 4) == 0) { /* a phi that is not to be followed */
            pair[i].group[0].fit.distortion = 2 * IL_DISTORTION_MOST;
            for (size_t k = 0; k < pair[i].n_matches; k++)
                pair[i].match[k].as_they_lie = below(&s, 3) > 0;
        }
    }
}

static uint64_t n_seeds(void)
{
    return getenv("ISOLOFT_LONG") ? 600 : 30;
}

static void loft_at_random(stack_kind kind, uint64_t seed, il_loft_options *o)
{
    static const int threads[] = { 1, 2, 3 };
    static const char *const kinds[] = { "equal", "cells", "ulp cells", "nano cells", "unrelated", "frame", "sliding",
                                         "halves", "ulp copies", "tangled" };
    il_slice slice[6];
    il_pair pair[5];
    size_t n = stack_make(kind, seed, slice);
    keeper k[3] = { new_keeper(), new_keeper(), new_keeper() };
    for (size_t i = 0; i < n; i++)
        clean_for(&slice[i], o->round_float);
    for (size_t i = 0; i < (seed % 8 == 0 ? 3 : 1); i++) {
        il_error err = IL_ERROR_INIT;
        random_pairs(slice, n, pair, seed);
        o->threads = threads[i];
        if (loft_pairs(&k[i], slice, n, pair, o, &err) != IL_OK)
            fail_msg("kind %d seed %llu: %s", (int)kind, (unsigned long long)seed, err.text);
        assert_sound(&k[i], kinds[kind], seed);
        if (i > 0)
            assert_same_mesh(&k[0].mesh, &k[i].mesh);
    }
    for (int i = 0; i < 3; i++)
        il_mesh_free(&k[i].mesh);
    free_slices(slice, n);
}

static void whatever_the_pairs_say_the_mesh_is_sound_for_any_threads(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= n_seeds(); seed++)
        for (int kind = 0; kind < STACK_N_KINDS; kind++) {
            il_loft_options o = IL_LOFT_OPTIONS_INIT;
            o.cap = seed % 7 == 0 ? IL_CAP_DOME : IL_CAP_FLAT;
            o.round_float = seed % 5 == 0;
            loft_at_random((stack_kind)kind, seed, &o);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cylinder_sheared_by_diameters_is_one_piece_of_the_prisms_volume),
        cmocka_unit_test(without_phi_it_is_two_caps),
        cmocka_unit_test(a_star_that_turns_keeps_its_arms),
        cmocka_unit_test(a_tube_that_slants_keeps_its_bore),
        cmocka_unit_test(without_matched_arcs_phi_alone_does_it),
        cmocka_unit_test(slices_that_correspond_are_settled_by_their_arcs),
        cmocka_unit_test(a_finger_without_a_partner_is_left_out_of_the_wall),
        cmocka_unit_test(points_that_neighbours_insert_are_matched_too),
        cmocka_unit_test(two_rings_that_slant_past_each_other_are_two_pieces),
        cmocka_unit_test(groups_whose_surfaces_cross_are_joined),
        cmocka_unit_test(rings_whose_phi_is_not_trusted_stay_where_they_lie),
        cmocka_unit_test(a_group_that_slants_through_one_that_stays_is_capped),
        cmocka_unit_test(rings_in_no_group_are_capped),
        cmocka_unit_test(what_phi_has_wrong_falls_to_the_identity),
        cmocka_unit_test(a_map_to_far_away_makes_two_caps),
        cmocka_unit_test(without_memory_it_fails_cleanly),
        cmocka_unit_test(whatever_the_pairs_say_the_mesh_is_sound_for_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
