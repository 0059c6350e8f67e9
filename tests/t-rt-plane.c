#include "config.h"
#include "base/alloc.h"
#include "input/rt-levels.h"
#include "input/rt-plane.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- planes ---------------------------------------------------------------------- */

enum { POINTS = 24 };

/* A ring of POINTS on the plane C + span(A, B), its third harmonic making it no
 * circle, rounded to STEP (0: not at all). */
static il_rt_contour ring(const double c[3], const double a[3], const double b[3], double radius, double step)
{
    double *xyz = il_alloc(3 * POINTS, sizeof *xyz);
    il_rt_contour to = { 0 };
    assert_non_null(xyz);
    for (size_t i = 0; i < POINTS; i++) {
        double t = 2 * 3.14159265358979 * (double)i / POINTS, r = radius * (1 + 0.2 * cos(3 * t));
        for (size_t k = 0; k < 3; k++) {
            double v = c[k] + r * (cos(t) * a[k] + sin(t) * b[k]);
            xyz[3 * i + k] = step > 0 ? step * round(v / step) : v;
        }
    }
    il_rt_contour_take_points(&to, &xyz, POINTS);
    return to;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void assert_right_handed(const il_rt_plane *p)
{
    for (size_t k = 0; k < 3; k++) {
        size_t i = (k + 1) % 3, j = (k + 2) % 3;
        assert_true(fabs(p->a[i] * p->b[j] - p->a[j] * p->b[i] - p->c[k]) < 1e-14);
    }
    assert_true(fabs(dot(p->a, p->a) - 1) < 1e-14 && fabs(dot(p->b, p->b) - 1) < 1e-14);
}

static void axis_aligned_contours_keep_their_coordinates(void **state)
{
    (void)state;
    for (size_t axis = 0; axis < 3; axis++) {
        double c[3] = { 0.1, -7.3, 11.7 }, a[3] = { 0 }, b[3] = { 0 };
        a[(axis + 1) % 3] = b[(axis + 2) % 3] = 1;
        il_rt_contour r = ring(c, a, b, 10, 0), copy = ring(c, a, b, 10, 0);
        il_rt_plane p = il_rt_plane_fit(&r, 1, 0.4);
        assert_int_equal(p.layout, axis);
        assert_int_equal(r.layout, axis);
        assert_right_handed(&p);
        double spread = 1, level = il_rt_plane_level(&p, &r, &spread);
        assert_true(level == c[axis] && spread == 0);
        size_t n = r.n;
        double *xy = il_rt_plane_flatten(&p, &r);
        for (size_t i = 0; i < n; i++) {
            double at[3], back[3];
            il_rt_contour_point(&copy, i, at);
            for (size_t k = 0; k < 3; k++)
                back[k] = xy[2 * i] * p.a[k] + xy[2 * i + 1] * p.b[k] + level * p.c[k];
            assert_memory_equal(at, back, sizeof at);
        }
        il_free(xy);
        il_rt_contour_free(&r);
        il_rt_contour_free(&copy);
    }
}

static void tilted_contours_are_fitted_and_taken_back(void **state)
{
    (void)state;
    const double a[3] = { 0.36, 0.48, -0.8 }, b[3] = { -0.8, 0.6, 0 }; /* across (0.48, 0.64, 0.6) */
    for (int turned = 0; turned < 2; turned++) {
        il_rt_contour r[5];
        for (size_t k = 0; k < 5; k++) {
            double c[3] = { 3 * (double)k * 0.48, 3 * (double)k * 0.64, 3 * (double)k * 0.6 };
            r[k] = turned ? ring(c, b, a, 20, 0) : ring(c, a, b, 20, 0);
        }
        il_rt_plane p = il_rt_plane_fit(r, 5, 0.4);
        assert_int_equal(p.layout, IL_RT_OBLIQUE);
        assert_right_handed(&p);
        assert_true(fabs(p.c[0] - 0.48) < 1e-14 && fabs(p.c[1] - 0.64) < 1e-14 && fabs(p.c[2] - 0.6) < 1e-14);
        for (size_t k = 0; k < 5; k++) {
            double spread, level = il_rt_plane_level(&p, &r[k], &spread), first[3];
            assert_true(fabs(level - 3 * (double)k) < 1e-12 && spread < 1e-12);
            il_rt_contour_point(&r[k], 0, first);
            double *xy = il_rt_plane_flatten(&p, &r[k]);
            for (size_t i = 0; i < 3; i++)
                assert_true(fabs(xy[0] * p.a[i] + xy[1] * p.b[i] + level * p.c[i] - first[i]) < 1e-12);
            il_free(xy);
        }
    }
}

static void rounded_points_lie_in_one_plane_within_their_rounding(void **state)
{
    (void)state;
    const double a[3] = { 1, 0, 0 }, b[3] = { 0, cos(0.3), sin(0.3) };
    il_rt_contour r[9];
    for (size_t k = 0; k < 9; k++) {
        double c[3] = { 0, -2 * (double)k * sin(0.3), 2 * (double)k * cos(0.3) };
        r[k] = ring(c, a, b, 30, 0.01);
    }
    il_rt_plane p = il_rt_plane_fit(r, 9, 0.4);
    assert_int_equal(p.layout, IL_RT_OBLIQUE);
    for (size_t k = 0; k < 9; k++) {
        double spread, level = il_rt_plane_level(&p, &r[k], &spread);
        assert_true(fabs(level - 2 * (double)k) < 0.01 && spread < 0.02);
        il_rt_contour_free(&r[k]);
    }
}

static void a_tilt_below_a_thousandth_is_none(void **state)
{
    (void)state;
    const double a[3] = { 1, 0, 0 }, b[3] = { 0, cos(0.0005), sin(0.0005) }, c[3] = { 0, 0, 5 };
    il_rt_contour r = ring(c, a, b, 10, 0);
    il_rt_plane p = il_rt_plane_fit(&r, 1, 0.4);
    assert_int_equal(r.layout, IL_RT_OBLIQUE);
    assert_int_equal(p.layout, IL_RT_ACROSS_Z);
    il_rt_contour_free(&r);
}

static void one_bent_contour_does_not_tilt_the_others(void **state)
{
    (void)state;
    const double a[3] = { 0.8, 0, 0.6 }, b[3] = { 0, 1, 0 };
    il_rt_contour r[4];
    for (size_t k = 0; k < 4; k++) {
        double c[3] = { -0.6 * (double)k, 0, 0.8 * (double)k };
        r[k] = ring(c, a, b, 10, 0);
    }
    r[3].p[0] += 30; /* one point far off */
    il_rt_plane p = il_rt_plane_fit(r, 4, 0.4);
    assert_true(fabs(p.c[0] + 0.6) < 1e-12 && fabs(p.c[2] - 0.8) < 1e-12);
    for (size_t k = 0; k < 4; k++)
        il_rt_contour_free(&r[k]);
}

static void contours_without_area_are_axial(void **state)
{
    (void)state;
    const double line[9] = { 0, 0, 0, 1, 2, 3, 2, 4, 6 };
    double *xyz = il_alloc(9, sizeof *xyz);
    il_rt_contour c = { 0 };
    assert_non_null(xyz);
    memcpy(xyz, line, sizeof line);
    il_rt_contour_take_points(&c, &xyz, 3);
    assert_int_equal(il_rt_plane_fit(&c, 1, 0.4).layout, IL_RT_ACROSS_Z);
    assert_int_equal(il_rt_plane_fit(&c, 0, 0.4).layout, IL_RT_ACROSS_Z);
    il_rt_contour_free(&c);
}

/* ---- levels ------------------------------------------------------------------------ */

enum { LEVELS = 64 };

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double spacing_of(const double *level, size_t n)
{
    double sorted[LEVELS], scratch[LEVELS];
    memcpy(sorted, level, n * sizeof *level);
    qsort(sorted, n, sizeof *sorted, compare);
    return il_rt_levels_spacing(sorted, n, scratch);
}

static void spacing_is_the_median_distance(void **state)
{
    (void)state;
    const double even[] = { 0, 3, 6, 9 }, twice[] = { 0, 0, 3, 3, 3, 6 }, mixed[] = { 0, 2, 4, 6, 16 }, one[] = { 5, 5, 5 };
    assert_true(spacing_of(even, 4) == 3);
    assert_true(spacing_of(twice, 6) == 3);
    assert_true(spacing_of(mixed, 5) == 2);
    assert_true(spacing_of(one, 3) == 0);
    assert_true(spacing_of(one, 0) == 0);
}

static void jitter_is_no_spacing_even_where_it_is_the_rule(void **state)
{
    (void)state;
    double level[60];
    for (size_t k = 0; k < 60; k++)
        level[k] = 3 * (double)(k / 6) + 0.004 * (double)(k % 6);
    assert_true(fabs(spacing_of(level, 60) - 3) < 0.05);
    const double rounding[] = { 0, 1e-14, 2e-14, 2.5, 2.5 + 4e-15, 5 };
    assert_true(fabs(spacing_of(rounding, 6) - 2.5) < 1e-9);
    const double plane[] = { 10, 10 + 1e-9, 10.05 };
    assert_true(spacing_of(plane, 3) == 0);
}

static void two_contours_a_slice_may_lie_a_tenth_of_the_spacing_apart(void **state)
{
    (void)state;
    const double twos[] = { 0, 0.2, 2.5, 2.62, 5, 5.05, 7.4, 7.6 }, wide[] = { 0, 0.3, 2.5, 2.8, 5, 5.3 };
    assert_true(fabs(spacing_of(twos, 8) - 2.35) < 1e-9);
    assert_true(fabs(spacing_of(wide, 6) - 0.3) < 1e-9);
}

static void slices_that_are_mostly_missing_are_not_merged(void **state)
{
    (void)state;
    const double level[] = { 0, 30, 60, 63, 66, 69, 99, 129 };
    assert_true(spacing_of(level, 8) == 30);
    assert_int_equal(il_rt_levels_slice(level, 8, 2, 30), 3);
}

static void fine_slices_and_gaps_are_no_jitter(void **state)
{
    (void)state;
    const double fine[] = { 0, 0.1, 0.2, 0.3, 0.4, 0.5, 8, 8.1, 8.2 };
    assert_true(fabs(spacing_of(fine, 9) - 0.1) < 1e-9);
    const double gap[] = { 0, 3, 6, 106, 109, 112 };
    assert_true(spacing_of(gap, 6) == 3);
}

static void a_slice_is_a_tenth_of_the_spacing_high(void **state)
{
    (void)state;
    const double level[] = { 0, 0.2, 0.29, 0.31, 3 };
    assert_int_equal(il_rt_levels_slice(level, 5, 0, 3), 3);
    assert_int_equal(il_rt_levels_slice(level, 5, 3, 3), 4);
    assert_int_equal(il_rt_levels_slice(level, 5, 4, 3), 5);
}

static void the_height_is_the_commonest(void **state)
{
    (void)state;
    const double one[] = { 2 }, most[] = { 1, 2, 2, 3 }, last[] = { 1, 2, 3, 3 }, ties[] = { 1, 1, 2, 3, 3, 4, 4 };
    assert_true(il_rt_levels_height(one, 1) == 2);
    assert_true(il_rt_levels_height(most, 4) == 2);
    assert_true(il_rt_levels_height(last, 4) == 3);
    assert_true(il_rt_levels_height(ties, 7) == 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axis_aligned_contours_keep_their_coordinates),
        cmocka_unit_test(tilted_contours_are_fitted_and_taken_back),
        cmocka_unit_test(rounded_points_lie_in_one_plane_within_their_rounding),
        cmocka_unit_test(a_tilt_below_a_thousandth_is_none),
        cmocka_unit_test(one_bent_contour_does_not_tilt_the_others),
        cmocka_unit_test(contours_without_area_are_axial),
        cmocka_unit_test(spacing_is_the_median_distance),
        cmocka_unit_test(jitter_is_no_spacing_even_where_it_is_the_rule),
        cmocka_unit_test(two_contours_a_slice_may_lie_a_tenth_of_the_spacing_apart),
        cmocka_unit_test(slices_that_are_mostly_missing_are_not_merged),
        cmocka_unit_test(fine_slices_and_gaps_are_no_jitter),
        cmocka_unit_test(a_slice_is_a_tenth_of_the_spacing_high),
        cmocka_unit_test(the_height_is_the_commonest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
