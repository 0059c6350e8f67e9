/* t-simple.c - rings that meet nowhere, against the triangulation that takes any. */
#include "config.h"
#include "model/arrange.h"
#include "region/boundary.h"
#include "region/simple.h"
#include "contours.h"

/* Rings round (X, Y) with radius below R, one in the other or side by side, of
 * either direction and any start; no two of them meet. */
static void add_rings(il_slice *s, double x, double y, double radius, int depth, uint64_t *seed)
{
    il_ring *r = il_slice_add_ring(s);
    size_t n = 3 + stack_random(seed) % 20, start = stack_random(seed) % n;
    bool reversed = stack_random(seed) % 2;
    assert_non_null(r);
    for (size_t i = 0; i < n; i++) {
        size_t k = (start + (reversed ? n - i : i)) % n;
        double t = 6.283185307179586 * (double)k / (double)n;
        double far = radius * (0.8 + 0.2 * (double)(stack_random(seed) % 1000) / 1000);
        assert_true(il_ring_add(r, x + far * cos(t), y + far * sin(t), k % 5 == 0 ? IL_VERTEX_INSERTED : 0));
    }
    for (size_t children = depth > 0 ? stack_random(seed) % 3 : 0; children > 0; children--)
        add_rings(s, x + (children == 1 ? -0.18 : 0.18) * radius, y, 0.15 * radius, depth - 1, seed);
}

static void agrees(il_slice *s)
{
    il_slice by_rays = IL_SLICE_INIT, by_triangles = IL_SLICE_INIT;
    il_arrangement a = IL_ARRANGEMENT_INIT;
    il_error err = IL_ERROR_INIT;
    size_t turned, cancelled, pinches;
    assert_int_equal(il_arrangement_from_slice(&a, s, il_slice_cell(s, false), &err), IL_OK);
    assert_int_equal(il_boundary_extract(&a, &by_triangles, &cancelled, &pinches, &err), IL_OK);
    assert_int_equal(il_slice_take_simple(&by_rays, s, &turned, &err), IL_OK);
    assert_int_equal(cancelled + pinches, 0);
    assert_true(il_slice_equal_rings(&by_rays, &by_triangles));
    il_arrangement_free(&a);
    il_slice_free(&by_rays);
    il_slice_free(&by_triangles);
}

static void nested_rings_are_turned_as_a_triangulation_says(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        uint64_t random = seed;
        il_slice s = IL_SLICE_INIT;
        add_rings(&s, 0, 0, 100, 3, &random);
        add_rings(&s, 250, 0, 100, 2, &random);
        agrees(&s);
        il_slice_free(&s);
    }
}

/* Rays pass through vertices, along edges and by spikes. */
static void vertices_of_one_height_are_counted_once(void **state)
{
    (void)state;
    static const char *const slices[] = {
        "0 0, 9 0, 9 9, 0 9; 1 1, 1 2, 2 2, 2 1; 4 1, 6 1, 6 2, 4 2",
        "0 0, 4 4, 8 0, 12 4, 16 0, 16 9, 0 9; 1 4, 3 4, 3 5; 5 4, 7 4, 6 5; 9 8, 11 8, 10 4.5",
        "-3 0, 0 -3, 3 0, 0 3; -1 0, 0 1, 1 0, 0 -1; -0.5 0, 0 -0.5, 0.5 0, 0 0.5",
        "0 0, 1 3, 0 6, 9 6, 8 3, 9 0; 2 3, 3 3, 3 3.5; 4 3, 5 3, 5 3.5",
    };
    for (size_t k = 0; k < sizeof slices / sizeof *slices; k++) {
        il_slice s = slice_of(slices[k]);
        agrees(&s);
        il_slice_free(&s);
    }
}

static void rings_without_vertices_are_left_out(void **state)
{
    (void)state;
    il_slice s = slice_of("0 0, 0 1, 1 1"), out = IL_SLICE_INIT;
    il_error err = IL_ERROR_INIT;
    size_t turned;
    assert_non_null(il_slice_add_ring(&s));
    assert_true(il_extra_add(&s.ring[0].extra, "x-a", 3) && il_extra_add(&s.ring[1].extra, "x-b", 3));
    assert_int_equal(il_slice_take_simple(&out, &s, &turned, &err), IL_OK);
    assert_int_equal(out.n, 1);
    assert_int_equal(turned, 1);
    assert_string_equal(out.ring[0].extra->text, "x-a");
    assert_string_equal(out.extra->text, "x-b");
    il_slice_free(&s);
    il_slice_free(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nested_rings_are_turned_as_a_triangulation_says),
        cmocka_unit_test(vertices_of_one_height_are_counted_once),
        cmocka_unit_test(rings_without_vertices_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
