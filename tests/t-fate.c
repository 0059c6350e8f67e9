/* t-fate.c - where the surface of a solid goes on to the next plane, and where it ends before. */
#include "config.h"
#include "base/alloc.h"
#include "fate.h"
#include "test.h"

#include <math.h>

enum { SIDE = 64, WAY = 2 };
static const double PARTING = 1.0 / 7;

static size_t put(solid *s, double x, double y, double z)
{
    double *p = s->xyz + 3 * s->n_vertices;
    p[0] = x, p[1] = y, p[2] = z;
    return s->n_vertices++;
}

static void put_triangle(solid *s, size_t a, size_t b, size_t c)
{
    uint32_t *q = s->tri + 3 * s->n_triangles++;
    q[0] = (uint32_t)a, q[1] = (uint32_t)b, q[2] = (uint32_t)c;
}

/* The ground under height(x, y) over [-2, 2] x [-2, 2], open at its border: contours keep off it. */
static solid make_ground(double (*height)(double, double))
{
    solid s = SOLID_INIT;
    s.xyz = il_alloc((SIDE + 1) * (SIDE + 1), 3 * sizeof *s.xyz);
    s.tri = il_alloc(2 * SIDE * SIDE, 3 * sizeof *s.tri);
    assert_non_null(s.xyz);
    assert_non_null(s.tri);
    for (int j = 0; j <= SIDE; j++)
        for (int i = 0; i <= SIDE; i++) {
            double x = 2.0 * WAY * i / SIDE - WAY, y = 2.0 * WAY * j / SIDE - WAY;
            put(&s, x, y, height(x, y));
        }
    for (size_t j = 0; j < SIDE; j++)
        for (size_t i = 0; i < SIDE; i++) {
            size_t a = j * (SIDE + 1) + i, b = a + SIDE + 1;
            put_triangle(&s, a, a + 1, b + 1);
            put_triangle(&s, a, b + 1, b);
        }
    return s;
}

/* The contour of plane 0 going up, and of plane 1 going down: lengths that go on, and that end,
 * on either side of x = PARTING. */
typedef struct lengths { double on[2], end[2]; } lengths;

static lengths follow(double (*height)(double, double), double z0, double z1, uint32_t plane)
{
    double z[] = { z0, z1 };
    solid s = make_ground(height);
    solid_cut(&s, z, 2);
    fates f;
    fates_find(&f, &s);
    lengths sum = { { 0, 0 }, { 0, 0 } };
    for (size_t t = 0; t < s.n_triangles; t++) {
        double a[2], b[2];
        if (solid_least_slab(&s, t) > plane || solid_greatest_slab(&s, t) <= plane)
            continue;
        solid_cross(&s, t, plane, 1, a);
        solid_cross(&s, t, plane, -1, b);
        double middle[2] = { (a[0] + b[0]) / 2, (a[1] + b[1]) / 2 };
        bool on = fates_goes_on(&f, t, middle, plane, plane == 0);
        (on ? sum.on : sum.end)[middle[0] > PARTING] += hypot(b[0] - a[0], b[1] - a[1]);
    }
    fates_free(&f);
    s.z = NULL;
    solid_free(&s);
    return sum;
}

static void assert_near(double is, double should, double by)
{
    if (!(fabs(is - should) <= by))
        fail_msg("%g is not within %g of %g", is, by, should);
}

static double cap(double x, double y) { return 1 - (x * x + y * y); }
/* Peaks of 1 and 0.6; what goes to the one and what to the other part at x = 1 / 7, at 0.29 where it is highest. */
static double humps(double x, double y) { return fmax(1 - (x + 0.7) * (x + 0.7), 0.6 - (x - 0.7) * (x - 0.7)) - y * y; }
static double wall(double x, double y) { return 10 * (1 - fmax(fabs(x), fabs(y))); }
static double steps(double x, double y) { return floor(6 * (1 - fmax(fabs(x), fabs(y)) / 2)) / 6; }

static void a_top_ends_and_what_leads_to_it_goes_on(void **state)
{
    (void)state;
    double circle = 6.283185307179586;
    lengths below = follow(cap, 0.19, 0.75, 0), back = follow(cap, 0.19, 0.75, 1), top = follow(cap, 0.19, 2, 0);
    assert_near(below.on[0] + below.on[1], 0.9 * circle, 0.02);
    assert_near(back.on[0] + back.on[1], 0.5 * circle, 0.02);
    assert_near(top.end[0] + top.end[1], 0.9 * circle, 0.02);
    assert_near(below.end[0] + below.end[1] + back.end[0] + back.end[1] + top.on[0] + top.on[1], 0, 0);
}

static void of_two_humps_the_lower_ends(void **state)
{
    (void)state;
    lengths up = follow(humps, 0.1, 0.8, 0), down = follow(humps, 0.1, 0.8, 1);
    double all[2] = { up.on[0] + up.end[0], up.on[1] + up.end[1] }, few = 2.0 * WAY / SIDE;
    assert_near(up.on[0] / all[0], 1, few);
    assert_near(up.end[1] / all[1], 1, few);
    assert_true(down.on[0] > 0.5);
    assert_near(down.end[0] + down.end[1] + down.on[1], 0, 0);
}

static void a_wall_goes_on_all_round(void **state)
{
    (void)state;
    lengths up = follow(wall, 1.3, 6.1, 0), down = follow(wall, 1.3, 6.1, 1);
    assert_near(up.on[0] + up.on[1], 8 * (1 - 0.13), 0.1);
    assert_near(down.on[0] + down.on[1], 8 * (1 - 0.61), 0.1);
    assert_near(up.end[0] + up.end[1] + down.end[0] + down.end[1], 0, 0);
}

static void a_level_step_ends_nothing(void **state)
{
    (void)state;
    lengths up = follow(steps, 0.1, 0.9, 0), down = follow(steps, 0.1, 0.9, 1);
    assert_true(up.on[0] + up.on[1] > 8);
    assert_near(up.end[0] + up.end[1] + down.end[0] + down.end[1], 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_top_ends_and_what_leads_to_it_goes_on),
        cmocka_unit_test(of_two_humps_the_lower_ends),
        cmocka_unit_test(a_wall_goes_on_all_round),
        cmocka_unit_test(a_level_step_ends_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
