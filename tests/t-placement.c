#include "config.h"
#include "terrain/placement.h"
#include "base/number.h"
#include "test.h"

#include <math.h>
#include <string.h>

static const double box[4] = { 171250.37, 433000.25, 179250.37, 437000.75 }; /* 8000 by 4000.5 */

static il_stack_head head_in(il_unit unit)
{
    il_stack_head head = IL_STACK_HEAD_INIT;
    head.kind = IL_KIND_TERRAIN;
    head.unit = unit;
    return head;
}

/* Through both steps, for heights from LOWEST to HIGHEST. */
static il_status place(il_stack_head *head, const il_placement_options *o, const double b[4], double lowest, double highest,
                       double *bottom, il_error *err)
{
    il_status st = il_placement_choose(head, o, b, err);
    return st == IL_OK ? il_placement_settle(head, o, b, lowest, highest, bottom, err) : st;
}

static void nothing_asked_for_changes_no_bit(void **state)
{
    (void)state;
    il_placement_options o = IL_PLACEMENT_OPTIONS_INIT;
    il_stack_head head = head_in(IL_UNIT_M);
    double bottom = 1, p[2] = { 0.1, 433000.3 }, q[2];
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 12.5, 90, &bottom, &err), IL_OK);
    assert_false(head.has_placement);
    assert_int_equal(head.unit, IL_UNIT_M);
    il_placement_apply(&head, &o, p, q);
    assert_memory_equal(p, q, sizeof p);
    assert_true(il_placement_height(&head, &o, 0.1) == 0.1 && bottom == 12.5);
}

static void rounding_alone_is_no_placement(void **state)
{
    (void)state;
    il_placement_options o = IL_PLACEMENT_OPTIONS_INIT;
    o.round_float = true;
    il_stack_head head = head_in(IL_UNIT_M);
    double bottom, p[2] = { 171250.37, 433000.25 }, q[2];
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 0.1, 90, &bottom, &err), IL_OK);
    assert_false(head.has_placement);
    il_placement_apply(&head, &o, p, q);
    assert_true(q[0] == (double)171250.37f && q[1] == (double)433000.25f);
    assert_true(il_placement_height(&head, &o, 0.1) == (double)0.1f);
}

static void the_longer_side_becomes_as_many_millimetres(void **state)
{
    (void)state;
    static const il_unit units[] = { IL_UNIT_M, IL_UNIT_FT, IL_UNIT_KM, IL_UNIT_MM };
    for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
        il_placement_options o = IL_PLACEMENT_OPTIONS_INIT;
        o.fit = 150;
        o.recentre = true;
        il_stack_head head = head_in(units[k]);
        double bottom, least[2], most[2];
        il_error err = IL_ERROR_INIT;
        assert_int_equal(place(&head, &o, box, 0, 90, &bottom, &err), IL_OK);
        assert_true(head.unit == IL_UNIT_MM && head.placement.unit == units[k]);
        il_placement_apply(&head, &o, box, least);
        il_placement_apply(&head, &o, box + 2, most);
        assert_true(fabs(most[0] - least[0] - 150) < 1e-12);
        assert_true(fabs(most[1] - least[1] - 4000.5 * 150 / 8000) < 1e-12);
        assert_true(fabs(il_placement_height(&head, &o, 80) - 1.5) < 1e-14);
    }
}

static void numbers_that_stay_may_mean_other_lengths(void **state)
{
    (void)state;
    il_placement_options o = IL_PLACEMENT_OPTIONS_INIT;
    o.fit = 8000;
    il_stack_head head = head_in(IL_UNIT_M);
    double bottom;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 0, 90, &bottom, &err), IL_OK);
    assert_true(head.has_placement && head.placement.scale[0] == 1 && head.unit == IL_UNIT_MM);
    head = head_in(IL_UNIT_MM);
    assert_int_equal(place(&head, &o, box, 0, 90, &bottom, &err), IL_OK);
    assert_false(head.has_placement);
}

static void degrees_are_not_fitted(void **state)
{
    (void)state;
    il_placement_options o = IL_PLACEMENT_OPTIONS_INIT;
    o.fit = 150;
    il_stack_head head = head_in(IL_UNIT_DEG);
    double bottom;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 0, 90, &bottom, &err), IL_E_INPUT);
    assert_non_null(strstr(err.text, "--project"));
}

static void what_has_a_frame_of_its_own_is_not_placed(void **state)
{
    (void)state;
    il_placement_options o = IL_PLACEMENT_OPTIONS_INIT;
    il_stack_head head = head_in(IL_UNIT_M);
    head.has_frame = true;
    double bottom;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 0, 90, &bottom, &err), IL_OK);
    o.recentre = true;
    assert_int_equal(place(&head, &o, box, 0, 90, &bottom, &err), IL_E_INPUT);
    assert_non_null(strstr(err.text, "--no-recentre"));
}

static void offsets_are_short_and_small_beside_the_map(void **state)
{
    (void)state;
    static const struct { double box[4], x, y; } c[] = {
        { { 171250.37, 433000.25, 179250.37, 437000.75 }, 175250, 435001 },
        { { -0.31, 51.27, 0.29, 51.69 }, -0.01, 51.48 },
        { { -0.300001, -1, 0.3, -0.5 }, 0, -0.75 },
        { { 0.001234, 0.002, 0.001534, 0.00203 }, 0.001384, 0.002015 },
        { { -2500000, -7900000, 1500000, -6400000 }, -500000, -7150000 },
        { { 1e14, 1e14, 1e14 + 2e6, 1e14 + 1e6 }, 1e14 + 1e6, 1e14 + 5e5 } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        il_placement_options o = IL_PLACEMENT_OPTIONS_INIT;
        o.recentre = true;
        il_stack_head head = head_in(IL_UNIT_M);
        il_error err = IL_ERROR_INIT;
        assert_int_equal(il_placement_choose(&head, &o, c[k].box, &err), IL_OK);
        assert_true(head.placement.offset[0] == c[k].x && head.placement.offset[1] == c[k].y);
        assert_false(c[k].x == 0 && signbit(head.placement.offset[0]));
    }
}

static void a_vertex_times_scale_plus_offset_is_on_the_map(void **state)
{
    (void)state;
    il_placement_options o = { .fit = 99, .z_scale = 2.5, .recentre = true, .solid = true };
    il_stack_head head = head_in(IL_UNIT_M);
    double bottom;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 120, 345, &bottom, &err), IL_OK);
    const il_placement *p = &head.placement;
    for (double t = 0; t <= 1; t += 0.125) {
        double from[2] = { box[0] + t * 8000, box[1] + t * 4000.5 }, z = 120 + t * 225, v[2];
        il_placement_apply(&head, &o, from, v);
        for (int k = 0; k < 2; k++)
            assert_true(fabs(v[k] * p->scale[k] + p->offset[k] - from[k]) < 1e-9);
        assert_true(fabs(il_placement_height(&head, &o, z) * p->scale[2] + p->offset[2] - z) < 1e-11);
    }
}

static void exaggerated_heights_are_whole_multiples(void **state)
{
    (void)state;
    il_placement_options o = IL_PLACEMENT_OPTIONS_INIT;
    o.z_scale = 3;
    il_stack_head head = head_in(IL_UNIT_M);
    double bottom;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 10, 345, &bottom, &err), IL_OK);
    assert_true(head.has_placement && head.unit == IL_UNIT_M);
    for (int z = -1000; z <= 1000; z++)
        assert_true(il_placement_height(&head, &o, z) == 3.0 * z);
}

static void a_recentred_solid_stands_on_0(void **state)
{
    (void)state;
    for (int float_too = 0; float_too < 2; float_too++) {
        il_placement_options o = { .fit = 99, .z_scale = 1.7, .recentre = true, .solid = true, .round_float = float_too };
        il_stack_head head = head_in(IL_UNIT_M);
        double bottom;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(place(&head, &o, box, 123.456, 345, &bottom, &err), IL_OK);
        assert_true(il_placement_height(&head, &o, bottom) == 0);
        o.has_base = true;
        o.base = 100.1;
        assert_int_equal(place(&head, &o, box, 123.456, 345, &bottom, &err), IL_OK);
        assert_true(bottom == 100.1 && il_placement_height(&head, &o, bottom) == 0);
        o.recentre = false;
        assert_int_equal(place(&head, &o, box, 123.456, 345, &bottom, &err), IL_OK);
        assert_true(head.placement.offset[2] == 0 && il_placement_height(&head, &o, bottom) > 0);
    }
}

static void the_floor_lies_a_fiftieth_of_the_map_below_it(void **state)
{
    (void)state;
    static const double z_scales[] = { 1, 4 };
    for (int k = 0; k < 2; k++) {
        il_placement_options o = { .fit = 150, .z_scale = z_scales[k], .recentre = true, .solid = true };
        il_stack_head head = head_in(IL_UNIT_M);
        double bottom;
        char text[IL_NUMBER_MAX];
        il_error err = IL_ERROR_INIT;
        assert_int_equal(place(&head, &o, box, 123.456, 345, &bottom, &err), IL_OK);
        double depth = il_placement_height(&head, &o, 123.456) - il_placement_height(&head, &o, bottom);
        assert_true(depth >= 3 && depth <= 3.3); /* 0.02 of 150, and a tenth of that */
        assert_true(il_number_format(text, bottom) <= 4);
    }
    il_placement_options o = { .z_scale = 1, .solid = true };
    il_stack_head head = head_in(IL_UNIT_DEG);
    double bottom, degrees[4] = { 5, 51, 5.25, 51.25 };
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, degrees, 100, 200, &bottom, &err), IL_OK);
    assert_true(bottom == 90);
    assert_int_equal(place(&head, &o, degrees, 100, 100, &bottom, &err), IL_OK);
    assert_true(bottom == 99);
}

static void a_floor_above_the_surface_is_refused(void **state)
{
    (void)state;
    il_placement_options o = { .z_scale = 1, .solid = true, .has_base = true, .base = 50 };
    il_stack_head head = head_in(IL_UNIT_M);
    double bottom;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 50, 90, &bottom, &err), IL_E_INPUT);
    assert_non_null(strstr(err.text, "50 is not below the lowest point of the surface, 50"));
    o.base = 50 - 1e-9;
    assert_int_equal(place(&head, &o, box, 50, 90, &bottom, &err), IL_OK);
    o.round_float = true;
    err = (il_error)IL_ERROR_INIT;
    assert_int_equal(place(&head, &o, box, 50, 90, &bottom, &err), IL_E_INPUT);
    assert_non_null(strstr(err.text, "one height"));
}

static void sizes_beyond_all_bounds_are_refused(void **state)
{
    (void)state;
    static const struct { double fit, z_scale; bool round_float; double box[4], highest; } c[] = {
        { 1e300, 1, false, { 0, 0, 1, 1 }, 1 },               /* huge */
        { 1e-320, 1, false, { 0, 0, 1e14, 1 }, 1 },           /* nothing left */
        { 1e-60, 1, true, { 0, 0, 1, 1 }, 1 },
        { 0, 1, true, { 1e9, 1e9, 1e9 + 8, 1e9 + 8 }, 1 },    /* of float's 64 */
        { 0, 1e300, false, { 0, 0, 1, 1 }, 1 },
        { 0, 1e5, false, { 0, 0, 1, 1 }, 1e12 } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        il_placement_options o = { .fit = c[k].fit, .z_scale = c[k].z_scale, .round_float = c[k].round_float };
        il_stack_head head = head_in(IL_UNIT_M);
        double bottom;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(place(&head, &o, c[k].box, 0, c[k].highest, &bottom, &err), IL_E_INPUT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_asked_for_changes_no_bit),
        cmocka_unit_test(rounding_alone_is_no_placement),
        cmocka_unit_test(the_longer_side_becomes_as_many_millimetres),
        cmocka_unit_test(numbers_that_stay_may_mean_other_lengths),
        cmocka_unit_test(degrees_are_not_fitted),
        cmocka_unit_test(what_has_a_frame_of_its_own_is_not_placed),
        cmocka_unit_test(offsets_are_short_and_small_beside_the_map),
        cmocka_unit_test(a_vertex_times_scale_plus_offset_is_on_the_map),
        cmocka_unit_test(exaggerated_heights_are_whole_multiples),
        cmocka_unit_test(a_recentred_solid_stands_on_0),
        cmocka_unit_test(the_floor_lies_a_fiftieth_of_the_map_below_it),
        cmocka_unit_test(a_floor_above_the_surface_is_refused),
        cmocka_unit_test(sizes_beyond_all_bounds_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
