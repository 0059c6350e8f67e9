#include "config.h"
#include "base/alloc.h"
#include "loft/bends.h"
#include "loft/slab.h"
#include "slabs.h"
#include "test.h"

#include <math.h>
#include <string.h>

static bool near(double a, double b, double by)
{
    return fabs(a - b) <= by;
}

/* ---- the slope between two straight pieces ----------------------------------------------- */

/* Cut at angles FROM, AT and TO (above the plane) a circle of radius R leans at AT as this tells. */
static void assert_tangent(double r, double from, double at, double to)
{
    double z[3] = { r * sin(from), r * sin(at), r * sin(to) }, n[3] = { r * cos(from), r * cos(at), r * cos(to) };
    double h0 = z[1] - z[0], h1 = z[2] - z[1], s0 = (n[1] - n[0]) / h0, s1 = (n[2] - n[1]) / h1;
    double most = 3 * fmin(fabs(s0), fabs(s1)), tangent = -tan(at);
    double expected = copysign(fmin(fabs(tangent), most), tangent);
    double is = il_lean_between(s0, h0, s1, h1);
    if (!near(is, expected, 1e-9 * (1 + fabs(expected))))
        fail_msg("r %g, %g %g %g: %.15g, not %.15g", r, from, at, to, is, expected);
}

static void a_circle_leans_as_its_tangent_however_it_is_cut(void **state)
{
    (void)state;
    static const double r[] = { 1e-3, 1, 5, 1e6 };
    for (int i = 0; i < 4; i++)
        for (double at = -1.3; at <= 1.3; at += 0.1)
            for (double below = 0.02; at - below > -1.5; below *= 1.7)
                for (double above = 0.02; at + above < 1.5; above *= 1.7)
                    assert_tangent(r[i], at - below, at, at + above);
}

static void what_is_straight_stays_straight(void **state)
{
    (void)state;
    for (double s = -1e3; s <= 1e3; s += 7.7)
        for (double h = 0.01; h < 100; h *= 3)
            assert_true(near(il_lean_between(s, 1, s, h), s, 1e-9 * fabs(s) + 1e-12));
}

/* Upside down it leans the other way, and so it does inside out. */
static void it_is_the_same_from_both_sides(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 2000; i++) {
        double s0 = tan(3.1 * (stack_uniform(&seed) - .5)), s1 = tan(3.1 * (stack_uniform(&seed) - .5));
        double h0 = 0.01 + stack_uniform(&seed), h1 = 0.01 + stack_uniform(&seed);
        double s = il_lean_between(s0, h0, s1, h1), by = 1e-12 * (1 + fabs(s));
        assert_true(near(il_lean_between(s1, h1, s0, h0), s, by));
        assert_true(near(il_lean_between(-s1, h1, -s0, h0), -s, by));
        assert_true(near(il_lean_between(s0, 1024 * h0, s1, 1024 * h1), s, by));
    }
}

/* Between the slopes of both, and so flat that a cubic with it neither overshoots nor turns back. */
static void it_lies_between_and_within_three_times_the_lesser(void **state)
{
    (void)state;
    uint64_t seed = 6;
    for (int i = 0; i < 5000; i++) {
        double s0 = tan(3.1 * (stack_uniform(&seed) - .5)), s1 = tan(3.1 * (stack_uniform(&seed) - .5));
        double s = il_lean_between(s0, 0.01 + stack_uniform(&seed), s1, 0.01 + stack_uniform(&seed));
        double by = 1e-12 * (1 + fabs(s0) + fabs(s1));
        assert_true(s >= fmin(s0, s1) - by && s <= fmax(s0, s1) + by);
        assert_true(fabs(s) <= 3 * fmin(fabs(s0), fabs(s1)) + by);
    }
    assert_true(il_lean_between(0, 1, 5, 1) == 0 && il_lean_between(-3, 1, 0, 2) == 0);
}

/* ---- on a slab ------------------------------------------------------------------------------ */

/* Every contour edge leans by the slope of the cone's frustum, but for the chords. */
static void a_cone_leans_the_same_at_both_of_its_ends(void **state)
{
    (void)state;
    il_slice slice[2] = { circle(0, 3, -4, 10, 90), circle(2, 3, -4, 7, 90) };
    test_slab t = new_slab(slice, false);
    for (int side = 0; side < 2; side++) {
        assert_true(t.slab.lean[side].height == 2);
        for (size_t i = 0; i < t.section[side].n_stations; i++)
            assert_true(near(t.slab.lean[side].slope[i], -1.5, 0.01));
    }
    free_slab(&t);
    free_slices(slice, 2);
}

/* A hole that widens makes the solid narrower: outwards is towards the hole's middle. */
static void a_hole_leans_towards_its_middle(void **state)
{
    (void)state;
    il_slice slice[2] = { circle(0, 0, 0, 10, 90), circle(1, 0, 0, 10, 90) };
    add_circle(&slice[0], 0, 0, 3, 60);
    add_circle(&slice[1], 0, 0, 4, 60);
    test_slab t = new_slab(slice, false);
    for (size_t i = 0; i < t.section[0].n_stations; i++)
        assert_true(near(t.slab.lean[0].slope[i], hypot(t.section[0].xy[2 * t.section[0].node_at[i]], t.section[0].xy[2 * t.section[0].node_at[i] + 1]) < 5 ? -1 : 0, 0.02));
    free_slab(&t);
    free_slices(slice, 2);
}

/* The bend's vector is the difference of both slopes along the outward normal. */
static void bends_are_what_the_smooth_slope_has_beyond_the_straight(void **state)
{
    (void)state;
    il_slice slice[2] = { circle(0, 0, 0, 10, 90), circle(1, 0, 0, 9, 90) };
    test_slab t = new_slab(slice, false);
    il_error err = IL_ERROR_INIT;
    il_lean beyond = { il_calloc(t.section[0].n_stations, sizeof *beyond.slope), 2 }; /* upright, twice as high */
    double *bend = NULL, smooth = il_lean_between(0.5, 2, -1, 1);
    for (size_t i = 0; i < t.section[0].n_stations; i++)
        beyond.slope[i] = 0.5;
    assert_int_equal(il_lean_bend(&bend, &t.section[0], &t.slab.lean[0], &beyond, &err), IL_OK);
    for (size_t v = 0; v < t.section[0].n_nodes; v++) {
        const double *xy = t.section[0].xy + 2 * v;
        double out = (bend[3 * v] * xy[0] + bend[3 * v + 1] * xy[1]) / 10;
        assert_true(near(out, smooth + 1, 0.01));
        assert_true(near(hypot(bend[3 * v], bend[3 * v + 1]), fabs(out), 0.01));
        assert_true(bend[3 * v + 2] >= -1 && bend[3 * v + 2] <= IL_LEAN_RISE - 1);
    }
    il_free(bend);
    il_free(beyond.slope);
    free_slab(&t);
    free_slices(slice, 2);
}

/* A slab with nothing beyond is not bent at all; with something on one side it ends as a beam
 * whose curvature vanishes: by minus half of it. */
static void a_free_end_has_half_the_bend_the_other_way(void **state)
{
    (void)state;
    il_slice slice[2] = { circle(0, 0, 0, 10, 64), circle(1, 0, 0, 9, 64) };
    test_slab t = new_slab(slice, false);
    il_error err = IL_ERROR_INIT;
    il_lean none[2] = { IL_LEAN_INIT, IL_LEAN_INIT }, one[2] = { IL_LEAN_INIT, IL_LEAN_INIT };
    il_bends b = { NULL, 0 };
    assert_int_equal(il_bends_find(&b, &t.slab.surface, &t.section[0], &t.section[1], t.slab.lean, none, &err), IL_OK);
    for (size_t i = 0; i < 6 * b.n; i++)
        assert_true(b.of[i] == 0);
    il_bends_free(&b);
    one[0] = (il_lean){ il_calloc(t.section[0].n_stations, sizeof *one[0].slope), 1 };
    for (size_t i = 0; i < t.section[0].n_stations; i++)
        one[0].slope[i] = -0.6;
    assert_int_equal(il_bends_find(&b, &t.slab.surface, &t.section[0], &t.section[1], t.slab.lean, one, &err), IL_OK);
    assert_int_equal(b.n, t.section[0].n_nodes + t.section[1].n_nodes + t.slab.surface.n_inner);
    for (size_t v = 0; v < b.n; v++) {
        double low = hypot(b.of[6 * v], b.of[6 * v + 1]), high = hypot(b.of[6 * v + 3], b.of[6 * v + 4]);
        assert_true(near(low, il_lean_between(-0.6, 1, -1, 1) + 1, 0.01));
        assert_true(near(high, low / 2, 0.01));
        assert_true(b.of[6 * v] * b.of[6 * v + 3] + b.of[6 * v + 1] * b.of[6 * v + 4] < 0);
    }
    il_bends_free(&b);
    il_bends_free(&b);
    il_free(one[0].slope);
    free_slab(&t);
    free_slices(slice, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_circle_leans_as_its_tangent_however_it_is_cut),
        cmocka_unit_test(what_is_straight_stays_straight),
        cmocka_unit_test(it_is_the_same_from_both_sides),
        cmocka_unit_test(it_lies_between_and_within_three_times_the_lesser),
        cmocka_unit_test(a_cone_leans_the_same_at_both_of_its_ends),
        cmocka_unit_test(a_hole_leans_towards_its_middle),
        cmocka_unit_test(bends_are_what_the_smooth_slope_has_beyond_the_straight),
        cmocka_unit_test(a_free_end_has_half_the_bend_the_other_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
