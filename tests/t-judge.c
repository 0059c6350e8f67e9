/* The measure that the matcher is measured with, on deformations that are known. */
#include "config.h"
#include "bench/judge.h"
#include "pairs.h"
#include "test.h"

#include <math.h>
#include <string.h>

static const double PI = 3.141592653589793;

static void assert_close(double value, double wanted, double within)
{
    if (!(fabs(value - wanted) <= within))
        fail_msg("%.9g is not %.9g", value, wanted);
}

/* A fit that is the global step alone. */
static il_fit global_step(double a, double b, double c, double d, double x, double y)
{
    return (il_fit){ .global = { a, b, c, d, x, y } };
}

static pairs_pair named(uint32_t seed)
{
    pairs_pair p;
    pairs_make(PAIRS_NAMED, seed, &p);
    return p;
}

/* The upper outline on both sides. */
static pairs_pair twins(uint32_t seed)
{
    pairs_pair p = named(seed);
    p.lower = p.upper;
    return p;
}

static void the_identity_takes_an_outline_to_itself(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < PAIRS_N_NAMED; seed++) {
        pairs_pair p = twins(seed);
        il_fit fit = global_step(1, 0, 0, 1, 0, 0);
        judged j = judge(&p, &fit);
        assert_true(j.up_max < 1e-9 && j.down_max < 1e-9 && j.distortion < 1e-9);
        assert_close(j.least_jacobian, 1, 0);
        assert_true(judged_solved(&j));
    }
}

/* A circle shifted by D is |D cos a| away from itself, to first order: 2 D / pi on average. */
static void a_shift_is_seen_both_ways(void **state)
{
    (void)state;
    pairs_pair p = twins(0);
    il_fit fit = global_step(1, 0, 0, 1, .3, 0);
    judged j = judge(&p, &fit);
    assert_close(j.up_mean, .6 / PI, .002);
    assert_close(j.down_mean, .6 / PI, .002);
    assert_close(j.up_max, .3, .002);
    assert_close(j.down_max, .3, .002);
    assert_close(j.off_truth, .3, 1e-9);
    assert_true(judged_solved(&j));
    fit = global_step(1, 0, 0, 1, .5, 0);
    j = judge(&p, &fit);
    assert_false(judged_solved(&j));
}

static void a_turn_that_is_the_truth_is_exact(void **state)
{
    (void)state;
    pairs_pair p = named(1);
    double c = cos(PI / 9), s = sin(PI / 9);
    il_fit fit = global_step(c, -s, s, c, 128 - c * 128 + s * 128, 128 - s * 128 - c * 128);
    judged j = judge(&p, &fit);
    assert_true(j.off_truth < 1e-9 && j.up_max < 1e-9 && j.down_max < 1e-9);
    assert_close(j.least_jacobian, 1, 1e-9);
}

static void what_the_upper_outline_lacks_is_seen_from_the_lower(void **state)
{
    (void)state;
    pairs_pair p = named(9); /* the disc lies on its like but for the finger's root */
    il_fit fit = global_step(1, 0, 0, 1, 0, 0);
    judged j = judge(&p, &fit);
    assert_true(j.up_mean < .5 && j.down_mean > 10);
    assert_close(j.down_max, 219 + 9.9 - 160, .1);
    assert_true(isnan(j.off_truth));
}

static void a_mirror_is_a_fold(void **state)
{
    (void)state;
    pairs_pair p = twins(0);
    il_fit fit = global_step(-1, 0, 0, 1, 256, 0);
    judged j = judge(&p, &fit);
    assert_true(j.up_max < 1e-9);
    assert_close(j.least_jacobian, -1, 0);
    assert_false(judged_solved(&j));
}

static void stretch_is_distortion(void **state)
{
    (void)state;
    pairs_pair p = twins(0);
    il_fit fit = global_step(2, 0, 0, 2, -128, -128);
    judged j = judge(&p, &fit);
    assert_close(j.distortion, log(2), 1e-9);
    assert_close(j.least_jacobian, 4, 1e-12);
}

/* One step on a lattice of 5 by 5 nodes, 16 apart, whose middle node, (100, 128)
 * inside the circle of named pair 0, moves by D to the right. */
typedef struct bump { il_lattice lattice; double d[50]; il_fit fit; } bump;

static void make_bump(bump *b, double d)
{
    memset(b, 0, sizeof *b);
    b->d[2 * 12] = d;
    b->lattice = (il_lattice){ .nx = 5, .ny = 5, .x = 68, .y = 96, .spacing = 16, .d = b->d, .n = 25, .cap = 25 };
    b->fit = global_step(1, 0, 0, 1, 0, 0);
    b->fit.lattice = &b->lattice;
    b->fit.n_lattices = 1;
}

/* The least slope of the cubic B-spline is -2/3; across, on the node, its value is
 * 2/3: so 1 - D/16 * 4/9 is the least determinant, and it is far from the outline. */
static void a_fold_off_the_outline_is_found(void **state)
{
    (void)state;
    pairs_pair p = twins(0);
    static bump b;
    make_bump(&b, 24);
    judged j = judge(&p, &b.fit);
    assert_close(j.least_jacobian, 1 - 24 / 16. * 4 / 9, .02);
    make_bump(&b, 40);
    j = judge(&p, &b.fit);
    assert_true(j.least_jacobian < -.05);
    assert_false(judged_solved(&j));
}

/* Steps that make up for each other, each far from the identity: the product along
 * the way is that of the whole. */
static void steps_multiply(void **state)
{
    (void)state;
    pairs_pair p = twins(0);
    static bump b, c;
    make_bump(&b, 10);
    make_bump(&c, 10);
    il_lattice both[2] = { b.lattice, c.lattice };
    il_fit fit = b.fit;
    judged once = judge(&p, &fit);
    fit.lattice = both;
    fit.n_lattices = 2;
    judged twice = judge(&p, &fit);
    assert_true(once.least_jacobian > 0);
    assert_true(twice.least_jacobian < once.least_jacobian);
    assert_true(twice.least_jacobian >= once.least_jacobian * once.least_jacobian - .02);
    assert_true(twice.up_max > once.up_max);
}

static void distances_are_to_edges_and_signs_by_the_even_odd_rule(void **state)
{
    (void)state;
    pairs_pair p = named(7); /* two ellipses about (90, 128) and (166, 128), 32 and 36 in radius */
    assert_close(judge_distance(&p.upper, 128, 128), 6, .01);
    assert_close(judge_distance(&p.upper, 90, 128), 32, .02);
    assert_true(judge_inside(&p.upper, 90, 128) && judge_inside(&p.upper, 166, 128));
    assert_false(judge_inside(&p.upper, 128, 128) || judge_inside(&p.upper, 10, 128));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_identity_takes_an_outline_to_itself),
        cmocka_unit_test(a_shift_is_seen_both_ways),
        cmocka_unit_test(a_turn_that_is_the_truth_is_exact),
        cmocka_unit_test(what_the_upper_outline_lacks_is_seen_from_the_lower),
        cmocka_unit_test(a_mirror_is_a_fold),
        cmocka_unit_test(stretch_is_distortion),
        cmocka_unit_test(a_fold_off_the_outline_is_found),
        cmocka_unit_test(steps_multiply),
        cmocka_unit_test(distances_are_to_edges_and_signs_by_the_even_odd_rule),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
