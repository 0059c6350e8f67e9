/* t-terrain.c - what the account tells of terrain. */
#include "config.h"
#include "cli/terrain.h"
#include "test.h"

#include <math.h>
#include <string.h>

/* Levels at z[0..n), each with a ring of 3, 4, 5 and a line from (AX, AY) to (BX, BY); in a
 * map from (0, 0) to (100, 50). */
static il_terrain terrain_of(const double *z, size_t n, const double line[4], il_unit unit)
{
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_terrain t;
    il_spacing spacing;
    head.kind = IL_KIND_TERRAIN;
    head.unit = unit;
    assert_int_equal(il_terrain_begin(&t, &head, NULL), IL_OK);
    for (size_t k = 0; k < n; k++) {
        il_slice s = IL_SLICE_INIT;
        s.z = z[k];
        il_ring *ring = il_slice_add_ring(&s);
        assert_true(ring && il_ring_add(ring, 0, 0, 0) && il_ring_add(ring, 0, 4, 0) && il_ring_add(ring, 3, 0, 0));
        il_ring *open = il_slice_add_ring(&s);
        assert_true(open && il_ring_add(open, line[0], line[1], 0) && il_ring_add(open, line[2], line[3], 0));
        open->open = true;
        assert_int_equal(il_terrain_slice(&t, &s, NULL), IL_OK);
        il_slice_free(&s);
    }
    assert_int_equal(il_spacing_measure(&spacing, z, n, NULL), IL_OK);
    assert_true(il_hull_add(&t.hull, (const double[]){ 0, 0, 100, 0, 100, 50, 0, 50 }, 4));
    assert_int_equal(il_terrain_settle(&t, &spacing, NULL), IL_OK);
    return t;
}

#define LENGTH(a) (sizeof(a) / sizeof *(a))

static void the_interval_is_the_usual_distance_when_all_are_multiples_of_it(void **state)
{
    (void)state;
    static const struct { double z[6]; size_t n; double interval; size_t n_missing; } c[] = {
        { { 10 }, 1, 0, 0 },
        { { 10, 30 }, 2, 20, 0 },
        { { -20, -10, 0, 10 }, 4, 10, 0 },
        { { 3.048, 6.096, 9.144, 15.24 }, 4, 3.048, 1 },
        { { 0, 5, 10, 15, 40 }, 5, 5, 4 },
        { { 0, 0.999, 2, 3.004 }, 4, 1, 0 },
        { { 0, 5, 10, 20, 50, 100 }, 6, 0, 0 },
        { { 2, 5, 10, 20, 50 }, 5, 0, 0 },
        { { 0, 1, 2.5, 3.5 }, 4, 0, 0 },
    };
    for (size_t k = 0; k < LENGTH(c); k++) {
        il_terrain t = terrain_of(c[k].z, c[k].n, (const double[4]){ 0, 0, 1, 0 }, IL_UNIT_M);
        assert_true(fabs(t.interval - c[k].interval) <= 0.01 * c[k].interval);
        assert_int_equal(t.n_missing, c[k].n_missing);
        il_terrain_free(&t);
    }
}

static void ends_near_the_edge_are_not_inside(void **state)
{
    (void)state;
    static const struct { double line[4]; size_t n_inside; } c[] = {
        { { 0, 10, 50, 50 }, 0 }, { { 2, 10, 50, 49 }, 0 }, { { 2.1, 10, 50, 49 }, 1 }, { { 97, 10, 50, 48.9 }, 2 } };
    for (size_t k = 0; k < LENGTH(c); k++) {
        il_terrain t = terrain_of((const double[1]){ 7 }, 1, c[k].line, IL_UNIT_M);
        assert_int_equal(t.n_inside, c[k].n_inside);
        il_terrain_free(&t);
    }
}

static void lengths_and_areas_are_those_of_the_plane_unless_measured(void **state)
{
    (void)state;
    static const double z[] = { 1, 2 }, line[] = { 0, 0, 0, 7 };
    il_terrain t = terrain_of(z, 2, line, IL_UNIT_M);
    il_terrain_level sum = il_terrain_sum(&t);
    assert_true(t.has_measures && !t.on_ellipsoid && sum.length == 38 && sum.area == 12);
    assert_true(sum.open == 2 && sum.closed == 2 && sum.points == 10);
    il_terrain_free(&t);
    t = terrain_of(z, 2, line, IL_UNIT_DEG);
    assert_false(t.has_measures);
    il_slice s = IL_SLICE_INIT;
    s.z = 3;
    s.length = 1000;
    s.area = 50;
    assert_int_equal(il_terrain_slice(&t, &s, NULL), IL_OK);
    assert_true(t.has_measures && t.on_ellipsoid && t.level[2].length == 1000 && t.level[2].area == 50);
    il_terrain_free(&t);
    il_terrain_free(&t);
}

static void heights_above_degrees_are_metres(void **state)
{
    (void)state;
    assert_int_equal(il_terrain_unit_of_z(IL_UNIT_DEG), IL_UNIT_M);
    assert_int_equal(il_terrain_unit_of_z(IL_UNIT_FT), IL_UNIT_FT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_interval_is_the_usual_distance_when_all_are_multiples_of_it),
        cmocka_unit_test(ends_near_the_edge_are_not_inside),
        cmocka_unit_test(lengths_and_areas_are_those_of_the_plane_unless_measured),
        cmocka_unit_test(heights_above_degrees_are_metres),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
