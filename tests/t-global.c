#include "config.h"
#include "match/global.h"
#include "matching.h"

static const double PI = 3.141592653589793;

static void assert_global(const il_global *g, const double wanted[6], double within)
{
    for (int k = 0; k < 6; k++)
        assert_near(g->a[k], wanted[k], within);
}

/* O moved by x -> A x + b. */
static outline moved(const outline *o, const double a[6])
{
    outline m = { 0 };
    for (size_t i = 0; i < o->n; i++) {
        outline_add(&m, a[0] * o->xy[2 * i] + a[1] * o->xy[2 * i + 1] + a[4], a[2] * o->xy[2 * i] + a[3] * o->xy[2 * i + 1] + a[5]);
        if (o->next[i] <= i)
            outline_close(&m);
    }
    return m;
}

/* The star with a hole and an ellipse beside it. */
static outline some_rings(void)
{
    outline o = { 0 };
    outline_star(&o, 100, 90, 1, 0, 70);
    outline_ellipse(&o, 105, 92, -12, 9, 20);
    outline_ellipse(&o, 200, 120, 20, 30, 30);
    return o;
}

static void an_outline_on_itself_stays(void **state)
{
    (void)state;
    outline o = some_rings();
    il_global g;
    assert_true(il_global_by_moments(&o.o, &o.o, &g));
    assert_global(&g, (double[6]){ 1, 0, 0, 1, 0, 0 }, 1e-10);
    assert_false(il_global_with_turn(&o.o, &o.o, &g));
    outline_free(&o);
}

static void scale_and_shift_are_exact(void **state)
{
    (void)state;
    static const double a[][6] = { { 1, 0, 0, 1, 17, -3 }, { 2, 0, 0, 2, 0, 0 }, { .3, 0, 0, .3, 40, 90 }, { 1.25, 0, 0, 1.25, -60, 8 } };
    outline upper = some_rings();
    for (size_t k = 0; k < sizeof a / sizeof *a; k++) {
        outline lower = moved(&upper, a[k]);
        il_global g;
        assert_true(il_global_by_moments(&lower.o, &upper.o, &g));
        assert_global(&g, a[k], 1e-9);
        outline_free(&lower);
    }
    outline_free(&upper);
}

/* A stretch without rotation is found whatever the shape: of all maps between the
 * moments it is the symmetric, positive one. */
static void stretch_is_exact(void **state)
{
    (void)state;
    static const double a[][6] = {
        { 1.2, 0, 0, .9, 5, 5 }, { 1, .15, .15, 1.1, -20, 30 }, { .8, -.1, -.1, .75, 0, 0 }, { 1.9, 0, 0, .8, 0, 9 } };
    outline upper = some_rings();
    for (size_t k = 0; k < sizeof a / sizeof *a; k++) {
        outline lower = moved(&upper, a[k]);
        il_global g;
        assert_true(il_global_by_moments(&lower.o, &upper.o, &g));
        assert_global(&g, a[k], 1e-9);
        outline_free(&lower);
    }
    outline_free(&upper);
}

/* An ellipse with half axes 60 and 50 at the angle T. */
static outline leaning_ellipse(double t)
{
    outline round = { 0 };
    outline_ellipse(&round, 0, 0, 1, 1, 720);
    double c = cos(t), s = sin(t);
    outline o = moved(&round, (double[6]){ 60 * c, -50 * s, 60 * s, 50 * c, 128, 120 });
    outline_free(&round);
    return o;
}

static void an_ellipse_goes_onto_another_without_turning(void **state)
{
    (void)state;
    for (int k = 0; k < 12; k++) {
        double t = k * PI / 12, c = cos(t), s = sin(t);
        outline lower = leaning_ellipse(t), upper = leaning_ellipse(0);
        il_global g;
        assert_true(il_global_by_moments(&lower.o, &upper.o, &g));
        assert_near(g.a[1], g.a[2], 1e-12);
        for (size_t i = 0; i < upper.n; i++) { /* on the lower ellipse's own axes */
            double x = upper.xy[2 * i], y = upper.xy[2 * i + 1];
            double p = g.a[0] * x + g.a[1] * y + g.a[4] - 128, q = g.a[2] * x + g.a[3] * y + g.a[5] - 120;
            assert_near(hypot((c * p + s * q) / 60, (c * q - s * p) / 50), 1, 1e-4);
        }
        outline_free(&lower);
        outline_free(&upper);
    }
}

static void a_great_stretch_is_left_to_the_lattices(void **state)
{
    (void)state;
    outline upper = some_rings(), lower = moved(&upper, (double[6]){ 2.7, 0, 0, 1, 0, 0 });
    il_global g;
    assert_true(il_global_by_moments(&lower.o, &upper.o, &g));
    assert_near(g.a[0], sqrt(2.7), 1e-9);
    assert_near(g.a[3], sqrt(2.7), 1e-9);
    assert_true(g.a[1] == 0 && g.a[2] == 0);
    outline_free(&upper);
    outline_free(&lower);
}

static void a_turn_is_found_within_a_degree(void **state)
{
    (void)state;
    static const double degrees[] = { -80, -61, -33, -20, -9, 8, 20, 45, 66, 85 };
    for (size_t k = 0; k < sizeof degrees / sizeof *degrees; k++)
        for (int n = 24; n <= 400; n *= 4) {
            outline lower = { 0 }, upper = { 0 };
            il_global g;
            outline_star(&upper, 120, 130, 1, 0, n);
            outline_star(&lower, 128, 128, 1.2, degrees[k] * PI / 180, n);
            assert_true(il_global_with_turn(&lower.o, &upper.o, &g));
            assert_near(atan2(g.a[2], g.a[0]) * 180 / PI, degrees[k], 1);
            assert_near(hypot(g.a[0], g.a[2]), 1.2, 1e-9);
            assert_true(g.a[0] == g.a[3] && g.a[1] == -g.a[2]);
            outline_free(&lower);
            outline_free(&upper);
        }
}

static void without_area_there_is_no_start(void **state)
{
    (void)state;
    outline good = some_rings(), flat = { 0 }, point = { 0 }, clockwise = { 0 };
    outline_add(&flat, 10, 10);
    outline_add(&flat, 20, 30);
    outline_add(&flat, 30, 50);
    outline_close(&flat);
    outline_add(&point, 7, 7);
    outline_close(&point);
    outline_ellipse(&clockwise, 50, 50, -20, 20, 9);
    const outline *bad[] = { &flat, &point, &clockwise };
    for (int k = 0; k < 3; k++) {
        il_global g;
        assert_false(il_global_by_moments(&good.o, &bad[k]->o, &g));
        assert_false(il_global_by_moments(&bad[k]->o, &good.o, &g));
        assert_false(il_global_with_turn(&good.o, &bad[k]->o, &g));
        assert_false(il_global_with_turn(&bad[k]->o, &good.o, &g));
    }
    outline_free(&good);
    outline_free(&flat);
    outline_free(&point);
    outline_free(&clockwise);
}

/* Whatever the shapes: finite numbers, and the orientation is kept. */
static void a_start_never_mirrors(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int round = 0; round < 2000; round++) {
        outline o[2] = { { .n = 0 }, { .n = 0 } };
        double thin = pow(10, -random_between(&seed, 0, 9));
        for (int side = 0; side < 2; side++) {
            for (uint64_t n = 3 + stack_random(&seed) % 5; n > 0; n--)
                outline_add(&o[side], random_between(&seed, 30, 220), 100 + thin * random_between(&seed, 0, 100));
            outline_close(&o[side]);
        }
        il_global g[2] = { IL_GLOBAL_IDENTITY, IL_GLOBAL_IDENTITY };
        il_global_by_moments(&o[0].o, &o[1].o, &g[0]);
        il_global_with_turn(&o[0].o, &o[1].o, &g[1]);
        for (int k = 0; k < 2; k++) {
            assert_true(g[k].a[0] * g[k].a[3] - g[k].a[1] * g[k].a[2] > 0);
            for (int i = 0; i < 6; i++)
                assert_true(isfinite(g[k].a[i]));
        }
        outline_free(&o[0]);
        outline_free(&o[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_outline_on_itself_stays),
        cmocka_unit_test(scale_and_shift_are_exact),
        cmocka_unit_test(stretch_is_exact),
        cmocka_unit_test(an_ellipse_goes_onto_another_without_turning),
        cmocka_unit_test(a_great_stretch_is_left_to_the_lattices),
        cmocka_unit_test(a_turn_is_found_within_a_degree),
        cmocka_unit_test(without_area_there_is_no_start),
        cmocka_unit_test(a_start_never_mirrors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
