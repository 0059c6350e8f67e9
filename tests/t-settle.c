/* t-settle.c - meshes that a frame has turned: sound after rounding, or refused. */
#include "config.h"
#include "output/mesh-settle.h"
#include "base/number.h"
#include "bridge/intersection.h"
#include "test.h"

#include <math.h>
#include <string.h>

enum { N = 8 };
static const uint32_t tri[] = { 0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0, 4, 5, 6, 4, 7, 5, 5, 7, 6, 6, 7, 4 };
enum { N_TRIANGLES = sizeof tri / sizeof *tri / 3 };

/* A tetrahedron, and another on top of it whose lowest vertex hovers GAP above
 * the middle of a face, SCALE times as large, at X. */
static void two_tetrahedra(double xyz[3 * N], double gap, double scale, double x)
{
    const double p[N][3] = { { 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, { 2, 2, -5 },
                             { 2, 3, 7 }, { 6, 1, 7 }, { 1, 7, 6 }, { 3, 3, gap } };
    for (size_t v = 0; v < N; v++)
        for (size_t i = 0; i < 3; i++)
            xyz[3 * v + i] = scale * p[v][i] + (i == 0 ? x : 0);
}

/* TO: XYZ turned by ANGLE about an axis that is none of the three. */
static void turn(const double *xyz, double *to, double angle)
{
    const double u[3] = { 2 / 7., 3 / 7., 6 / 7. }, c = cos(angle), s = sin(angle);
    for (size_t v = 0; v < N; v++) {
        const double *p = xyz + 3 * v;
        double along = (1 - c) * (u[0] * p[0] + u[1] * p[1] + u[2] * p[2]);
        for (size_t i = 0; i < 3; i++) {
            size_t j = (i + 1) % 3, k = (i + 2) % 3;
            to[3 * v + i] = c * p[i] + s * (u[j] * p[k] - u[k] * p[j]) + along * u[i];
        }
    }
}

static size_t crossings(const double *to, bool floats)
{
    double rounded[3 * N];
    uint32_t first[2];
    size_t n;
    for (size_t i = 0; i < 3 * N; i++)
        rounded[i] = floats ? il_number_round_float(to[i]) : to[i];
    assert_int_equal(il_intersections(rounded, N, tri, N_TRIANGLES, NULL, 100, &n, first, NULL), IL_OK);
    return n;
}

static void a_frame_along_the_axes_is_exact(void **state)
{
    (void)state;
    static const struct { double frame[12]; bool exact; } c[] = {
        { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, true }, { { 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1 }, true },
        { { 0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0 }, true }, { { 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, false },
        { { 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1 }, false }, { { 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1 }, false },
        { { 0, 0, 0, 0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1 }, false }, { { 0, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1 }, false } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++)
        assert_int_equal(il_frame_is_exact(c[k].frame), c[k].exact);
}

static void what_is_sound_is_only_rounded(void **state)
{
    (void)state;
    double xyz[3 * N], to[3 * N], expected[3 * N];
    size_t place;
    two_tetrahedra(xyz, 1, 1, 100);
    turn(xyz, expected, 0.7);
    for (int floats = 0; floats < 2; floats++) {
        memcpy(to, expected, sizeof to);
        assert_int_equal(il_mesh_settle(xyz, to, N, tri, N_TRIANGLES, floats, &place, NULL), IL_OK);
        for (size_t i = 0; i < 3 * N; i++)
            assert_true(to[i] == (floats ? il_number_round_float(expected[i]) : expected[i]));
    }
}

/* The gap is far below a float's last digit, and near a double's. */
static void what_rounding_makes_cross_is_put_right(void **state)
{
    (void)state;
    for (int floats = 0; floats < 2; floats++) {
        size_t crossed = 0;
        for (int k = 0; k < 50; k++) {
            double xyz[3 * N], to[3 * N], before[3 * N], digit = 128 * (floats ? 0x1p-23 : 0x1p-52);
            size_t place;
            two_tetrahedra(xyz, floats ? 1e-9 : 1e-15, 1, 100);
            turn(xyz, before, 0.1 * k + 0.05);
            crossed += crossings(before, floats) > 0;
            memcpy(to, before, sizeof to);
            assert_int_equal(il_mesh_settle(xyz, to, N, tri, N_TRIANGLES, floats, &place, NULL), IL_OK);
            assert_int_equal(crossings(to, false), 0);
            for (size_t i = 0; i < 3 * N; i++)
                assert_true(fabs(to[i] - before[i]) <= (IL_SETTLE_STEPS + 1) * digit);
        }
        assert_true(crossed >= 10);
    }
}

static void vertices_of_one_place_stay_together(void **state)
{
    (void)state;
    for (int k = 0; k < 50; k++) {
        double xyz[3 * N], to[3 * N];
        size_t place;
        two_tetrahedra(xyz, 1e-9, 1, 100);
        memcpy(xyz + 3 * 4, xyz + 3 * 2, 3 * sizeof *xyz); /* they touch in a vertex as well */
        turn(xyz, to, 0.1 * k + 0.05);
        assert_int_equal(il_mesh_settle(xyz, to, N, tri, N_TRIANGLES, true, &place, NULL), IL_OK);
        assert_memory_equal(to + 3 * 4, to + 3 * 2, 3 * sizeof *to);
    }
}

/* A double pyramid over a polygon of M corners, all of it within a digit. */
static void what_finds_no_place_is_refused(void **state)
{
    (void)state;
    enum { M = 200 };
    double xyz[3 * (M + 2)], to[3 * (M + 2)];
    uint32_t t[6 * M];
    size_t place = M + 2;
    il_error err = IL_ERROR_INIT;
    for (uint32_t k = 0; k < M; k++) {
        const uint32_t next = (k + 1) % M, pair[6] = { k, next, M, next, k, M + 1 };
        const double angle = 6.283185307179586 * k / M, p[3] = { 100 + 1e-6 * cos(angle), 1e-6 * sin(angle), 0 };
        memcpy(xyz + 3 * k, p, sizeof p);
        memcpy(t + 6 * k, pair, sizeof pair);
    }
    const double tips[6] = { 100, 0, 1e-6, 100, 0, -1e-6 };
    memcpy(xyz + 3 * M, tips, sizeof tips);
    memcpy(to, xyz, sizeof to);
    assert_int_equal(il_mesh_settle(xyz, to, M + 2, t, 2 * M, false, &place, &err), IL_OK);
    assert_int_equal(il_mesh_settle(xyz, to, M + 2, t, 2 * M, true, &place, &err), IL_E_SURFACE);
    assert_true(place < M + 2);
}

static void what_is_too_large_is_refused(void **state)
{
    (void)state;
    double xyz[3 * N], to[3 * N];
    size_t place;
    il_error err = IL_ERROR_INIT;
    two_tetrahedra(xyz, 1, 1, 100);
    memcpy(to, xyz, sizeof to);
    to[5] = 1e39;
    assert_int_equal(il_mesh_settle(xyz, to, N, tri, N_TRIANGLES, true, &place, &err), IL_E_INPUT);
    assert_int_equal(place, 1);
    err = (il_error)IL_ERROR_INIT;
    to[5] = 1e101;
    assert_int_equal(il_mesh_settle(xyz, to, N, tri, N_TRIANGLES, false, &place, &err), IL_E_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_along_the_axes_is_exact),
        cmocka_unit_test(what_is_sound_is_only_rounded),
        cmocka_unit_test(what_rounding_makes_cross_is_put_right),
        cmocka_unit_test(vertices_of_one_place_stay_together),
        cmocka_unit_test(what_finds_no_place_is_refused),
        cmocka_unit_test(what_is_too_large_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
