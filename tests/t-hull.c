/* t-hull.c - the convex hull of points that are not held, against the plain rule. */
#include "config.h"
#include "base/alloc.h"
#include "cli/hull.h"
#include "stacks.h"
#include "test.h"

#include <math.h>

enum { MANY = 100000 };

static double xy[2 * MANY];

static double unit_random(uint64_t *random)
{
    return (double)(stack_random(random) % 1000003) / 1000003;
}

static il_hull hull_of(size_t n)
{
    il_hull h = IL_HULL_INIT;
    for (size_t k = 0; k < n; k += 1000) /* as lines bring them */
        assert_true(il_hull_add(&h, xy + 2 * k, n - k < 1000 ? n - k : 1000));
    assert_true(il_hull_settle(&h));
    return h;
}

/* A sheet of 4 by 3, turned by ANGLE. */
static void turn_point(double angle, double x, double y, double *p)
{
    p[0] = 500000 + 1000 * (cos(angle) * x - sin(angle) * y);
    p[1] = 5000000 + 1000 * (sin(angle) * x + cos(angle) * y);
}

static void a_sheet_may_be_turned(void **state)
{
    (void)state;
    for (double angle = 0; angle < 7; angle += 0.37) {
        uint64_t random = 5;
        double p[2];
        for (size_t k = 0; k < MANY; k++)
            turn_point(angle, 4 * unit_random(&random), 3 * unit_random(&random), xy + 2 * k);
        for (int c = 0; c < 4; c++)
            turn_point(angle, c & 1 ? 4 : 0, c & 2 ? 3 : 0, xy + 2 * (c + 11111 * c));
        il_hull h = hull_of(MANY);
        for (size_t k = 0; k < 2000; k++) {
            double x = 4 * unit_random(&random), y = 3 * unit_random(&random), dx = fmin(x, 4 - x) / 4, dy = fmin(y, 3 - y) / 3;
            turn_point(angle, x, y, p);
            if (fabs(fmin(dx, dy) - 0.02) > 1e-3)
                assert_int_equal(il_hull_is_inside(&h, p, 0.02), fmin(dx, dy) > 0.02);
        }
        il_hull_free(&h);
    }
}

static void a_round_map_has_few_corners(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (size_t k = 0; k < MANY; k++) {
        double t = 6.283185307179586 * unit_random(&random);
        xy[2 * k] = 100 * cos(t);
        xy[2 * k + 1] = 100 * sin(t);
    }
    il_hull h = hull_of(MANY);
    assert_true(h.n_hull <= IL_HULL_SIDES && h.n_hull > 40);
    for (size_t k = 0; k < MANY; k += 17) {
        assert_false(il_hull_is_inside(&h, xy + 2 * k, 0.02));
        assert_true(il_hull_is_inside(&h, (const double[]){ 0.94 * xy[2 * k], 0.94 * xy[2 * k + 1] }, 0.02));
    }
    il_hull_free(&h);
}

static void what_encloses_nothing_has_no_inside(void **state)
{
    (void)state;
    for (size_t k = 0; k < MANY; k++)
        xy[2 * k] = xy[2 * k + 1] = (double)(k % 9000);
    for (size_t n = 0; n < MANY; n = 10 * n + 1) {
        il_hull h = hull_of(n);
        assert_false(il_hull_is_inside(&h, (const double[]){ 0, 0 }, 0.02));
        assert_false(il_hull_is_inside(&h, (const double[]){ 4500, 4500 }, 0.02));
        il_hull_free(&h);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sheet_may_be_turned),
        cmocka_unit_test(a_round_map_has_few_corners),
        cmocka_unit_test(what_encloses_nothing_has_no_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
