#include "config.h"
#include "base/alloc.h"
#include "base/number.h"
#include "loft/lofter.h"
#include "lofting.h"
#include "region/clean.h"
#include "stacks.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- lofting slices ---- */

/* Clean copies of SLICE[N] through the lofter into K. */
static il_status loft(keeper *k, const il_slice *slice, size_t n, const il_loft_options *o, il_error *err)
{
    il_sink *lofter = NULL, *cleaner = NULL;
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_clean_options c = { .round_float = o->round_float };
    assert_int_equal(il_lofter_new(&lofter, o, &k->sink, err), IL_OK);
    assert_int_equal(il_cleaner_new(&cleaner, &c, lofter, NULL, err), IL_OK);
    il_status st = cleaner->stack_begin(cleaner, &head, err);
    for (size_t i = 0; st == IL_OK && i < n; i++) {
        il_slice copy = IL_SLICE_INIT;
        assert_int_equal(il_slice_copy(&copy, &slice[i], err), IL_OK);
        st = cleaner->slice(cleaner, &copy, err);
        il_slice_free(&copy);
    }
    if (st == IL_OK)
        st = cleaner->stack_end(cleaner, err);
    if (st == IL_OK)
        st = cleaner->end(cleaner, err);
    il_cleaner_free(cleaner);
    il_lofter_free(lofter);
    return st;
}

static void add_box(il_slice *s, double x0, double y0, double x1, double y1)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    assert_true(il_ring_add(r, x0, y0, 0) && il_ring_add(r, x1, y0, 0) && il_ring_add(r, x1, y1, 0) && il_ring_add(r, x0, y1, 0));
}

/* ---- what every mesh must be ---- */

/* Vertex (RING, VERTEX) of clean slice K stands in the mesh, bit for bit. */
static void assert_contours_kept(const keeper *k, const il_slice *slice, size_t n, bool round_float)
{
    size_t total = 0, kept = 0;
    for (size_t i = 0; i < n; i++) {
        il_slice clean = IL_SLICE_INIT;
        il_clean_options c = { .round_float = round_float };
        assert_int_equal(il_slice_copy(&clean, &slice[i], NULL), IL_OK);
        assert_int_equal(il_slice_clean(&clean, &c, NULL, NULL, NULL), IL_OK);
        double z = round_float ? il_number_round_float(clean.z) : clean.z;
        total += il_slice_points(&clean);
        for (size_t v = 0; v < k->mesh.n_vertices; v++) {
            il_origin o = k->mesh.origin[v];
            if (o.slice != (int32_t)i || o.ring < 0)
                continue;
            double at[3] = { clean.ring[o.ring].xy[2 * o.vertex], clean.ring[o.ring].xy[2 * o.vertex + 1], z };
            assert_memory_equal(at, k->mesh.xyz + 3 * v, sizeof at);
            kept++;
        }
        il_slice_free(&clean);
    }
    /* vertices that rings share have one origin, and one vertex for each fan */
    assert_true(kept <= total + k->facts.pinches && kept + k->facts.pinches + 2 * total / 3 >= total);
}

static void loft_kind(stack_kind kind, uint64_t seeds, il_cap cap, bool round_float)
{
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        il_slice slice[6];
        size_t n = stack_make(kind, seed, slice);
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        il_error err = IL_ERROR_INIT;
        keeper k = new_keeper();
        o.cap = cap;
        o.round_float = round_float;
        if (loft(&k, slice, n, &o, &err) != IL_OK)
            fail_msg("kind %d seed %llu: %s", (int)kind, (unsigned long long)seed, err.text);
        assert_sound(&k, "seed", seed);
        assert_contours_kept(&k, slice, n, round_float);
        il_mesh_free(&k.mesh);
        free_slices(slice, n);
    }
}

/* ---- degenerate stacks ---- */

static uint64_t n_seeds(void)
{
    return getenv("ISOLOFT_LONG") ? 500 : 50;
}

#define KIND_TEST(name, kind) \
    static void name(void **state) \
    { \
        (void)state; \
        loft_kind(kind, n_seeds(), IL_CAP_FLAT, false); \
        loft_kind(kind, n_seeds() / 5, IL_CAP_DOME, false); \
        loft_kind(kind, n_seeds() / 5, IL_CAP_FLAT, true); \
    }

KIND_TEST(equal_slices_are_lofted, STACK_EQUAL)
KIND_TEST(shared_collinear_and_opposite_edges_are_lofted, STACK_CELLS)
KIND_TEST(cells_one_ulp_off_are_lofted, STACK_CELLS_ULP)
KIND_TEST(cells_a_billionth_off_are_lofted, STACK_CELLS_NANO)
KIND_TEST(unrelated_slices_are_lofted, STACK_UNRELATED)
KIND_TEST(common_frames_are_lofted, STACK_FRAME)
KIND_TEST(rings_sliding_along_their_edges_are_lofted, STACK_SLIDING)
KIND_TEST(halves_by_turns_are_lofted, STACK_HALVES)
KIND_TEST(copies_one_ulp_off_are_lofted, STACK_ULP_COPIES)
KIND_TEST(tangles_are_lofted, STACK_TANGLED)

/* 32-bit floats have 2^-13 for an ulp there: stacks of some ten units are some
 * 10^5 ulps across, and rounding may carry inserted points past one another.
 * Without tangles: not all of them can be lofted so, and end with exit 6. */
static void stacks_far_from_the_origin_are_lofted_in_floats(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= n_seeds(); seed++) {
        il_slice slice[6];
        stack_kind kind = (stack_kind)(seed % STACK_TANGLED);
        size_t n = stack_make(kind, seed, slice);
        for (size_t i = 0; i < n; i++)
            for (size_t r = 0; r < slice[i].n; r++)
                for (size_t k = 0; k < 2 * slice[i].ring[r].n; k++)
                    slice[i].ring[r].xy[k] += 1024;
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        il_error err = IL_ERROR_INIT;
        keeper k = new_keeper();
        o.round_float = true;
        if (loft(&k, slice, n, &o, &err) != IL_OK)
            fail_msg("kind %d seed %llu: %s", (int)kind, (unsigned long long)seed, err.text);
        assert_sound(&k, "far seed", seed);
        il_mesh_free(&k.mesh);
        free_slices(slice, n);
    }
}

/* ---- closed forms ---- */

static keeper loft_boxes(const double (*box)[5], size_t n_boxes, const il_loft_options *o)
{
    il_slice slice[8];
    size_t n = 0;
    for (size_t i = 0; i < n_boxes; i++) {
        if (n == 0 || slice[n - 1].z != box[i][0]) {
            slice[n] = (il_slice)IL_SLICE_INIT;
            slice[n++].z = box[i][0];
        }
        add_box(&slice[n - 1], box[i][1], box[i][2], box[i][3], box[i][4]);
    }
    keeper k = new_keeper();
    il_error err = IL_ERROR_INIT;
    assert_int_equal(loft(&k, slice, n, o, &err), IL_OK);
    assert_sound(&k, "boxes", 0);
    free_slices(slice, n);
    return k;
}

static void a_prism_has_its_volume_area_and_twelve_triangles(void **state)
{
    (void)state;
    static const double box[][5] = { { 0, 0, 0, 2, 3 }, { 5, 0, 0, 2, 3 } };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    keeper k = loft_boxes(box, 2, &o);
    assert_true(fabs(k.facts.volume - 30) < 1e-12);
    assert_true(fabs(k.facts.area - 62) < 1e-12);
    assert_int_equal(k.facts.triangles, 12);
    assert_int_equal(k.facts.components, 1);
    assert_int_equal(k.facts.genus, 0);
    il_mesh_free(&k.mesh);
}

static void a_tube_has_genus_one(void **state)
{
    (void)state;
    static const double box[][5] = { { 0, 0, 0, 9, 9 }, { 0, 3, 3, 6, 6 }, { 1, 0, 0, 9, 9 }, { 1, 3, 3, 6, 6 } };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    keeper k = loft_boxes(box, 4, &o);
    assert_int_equal(k.facts.genus, 1);
    assert_true(fabs(k.facts.volume - 72) < 1e-12);
    il_mesh_free(&k.mesh);
}

static void a_branch_joins_two_legs_in_one_piece(void **state)
{
    (void)state;
    static const double box[][5] = { { 0, 0, 0, 2, 2 }, { 0, 6, 0, 8, 2 }, { 1, 0, 0, 2, 2 }, { 1, 6, 0, 8, 2 }, { 2, 0, 0, 8, 2 } };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    keeper k = loft_boxes(box, 5, &o);
    assert_int_equal(k.facts.components, 1);
    assert_int_equal(k.facts.genus, 0);
    /* the arch over the gap of 4 x 2 takes between none and all of the slab */
    assert_true(k.facts.volume > 16 && k.facts.volume < 24);
    il_mesh_free(&k.mesh);
}

static void rings_apart_are_pieces_of_their_own_with_domes_inside(void **state)
{
    (void)state;
    static const double box[][5] = { { 0, 0, 0, 2, 2 }, { 1, 5, 5, 7, 7 } };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    keeper k = loft_boxes(box, 2, &o);
    double top = 0;
    for (size_t v = 0; v < k.mesh.n_vertices; v++)
        if (k.mesh.xyz[3 * v] < 3)
            top = fmax(top, k.mesh.xyz[3 * v + 2]);
    assert_int_equal(k.facts.components, 2);
    assert_true(top > .4 && top <= .5);
    il_mesh_free(&k.mesh);
}

static void a_dome_reaches_half_a_spacing_beyond_the_end(void **state)
{
    (void)state;
    static const double box[][5] = { { 0, 0, 0, 6, 6 }, { 2, 0, 0, 6, 6 }, { 3, 0, 0, 6, 6 } };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    o.cap = IL_CAP_DOME;
    keeper k = loft_boxes(box, 3, &o);
    double low = 0, high = 0;
    for (size_t v = 0; v < k.mesh.n_vertices; v++)
        low = fmin(low, k.mesh.xyz[3 * v + 2]), high = fmax(high, k.mesh.xyz[3 * v + 2]);
    assert_true(low >= -1 && low < -.9);
    assert_true(high <= 3.5 && high > 3.45);
    il_mesh_free(&k.mesh);
}

static void an_empty_slice_inside_parts_the_stack(void **state)
{
    (void)state;
    il_slice slice[5];
    for (int i = 0; i < 5; i++) {
        slice[i] = (il_slice)IL_SLICE_INIT;
        slice[i].z = i;
        if (i != 2)
            add_box(&slice[i], 0, 0, 1, 1);
    }
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    keeper k = new_keeper();
    assert_int_equal(loft(&k, slice, 5, &o, &err), IL_OK);
    assert_sound(&k, "gap", 0);
    assert_int_equal(k.facts.components, 2);
    il_mesh_free(&k.mesh);
    free_slices(slice, 5);
}

/* ---- the same whatever the road ---- */

/* A stack of 30 slices, so that the window is passed several times. */
static size_t long_stack(il_slice slice[30], uint64_t seed)
{
    size_t n = 0;
    while (n < 30) {
        il_slice part[6];
        size_t m = stack_make(STACK_CELLS, seed++, part);
        for (size_t i = 0; i < m; i++) {
            if (n == 30) {
                il_slice_free(&part[i]);
                continue;
            }
            slice[n] = part[i];
            slice[n].z = (double)n;
            n++;
        }
    }
    return n;
}

static void the_mesh_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    static const int threads[] = { 2, 3, 8 };
    il_slice slice[30];
    size_t n = long_stack(slice, 77);
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    keeper one = new_keeper();
    assert_int_equal(loft(&one, slice, n, &o, &err), IL_OK);
    assert_sound(&one, "long", 77);
    for (size_t i = 0; i < 3; i++) {
        keeper k = new_keeper();
        o.threads = threads[i];
        assert_int_equal(loft(&k, slice, n, &o, &err), IL_OK);
        assert_same_mesh(&one.mesh, &k.mesh);
        il_mesh_free(&k.mesh);
    }
    il_mesh_free(&one.mesh);
    free_slices(slice, n);
}

static void scaling_by_a_power_of_two_scales_the_mesh_bit_for_bit(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        il_slice slice[6];
        size_t n = stack_make(STACK_UNRELATED, seed, slice);
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        il_error err = IL_ERROR_INIT;
        keeper a = new_keeper(), b = new_keeper();
        assert_int_equal(loft(&a, slice, n, &o, &err), IL_OK);
        for (size_t i = 0; i < n; i++) {
            slice[i].z *= 64;
            for (size_t r = 0; r < slice[i].n; r++)
                for (size_t k = 0; k < 2 * slice[i].ring[r].n; k++)
                    slice[i].ring[r].xy[k] *= 64;
        }
        assert_int_equal(loft(&b, slice, n, &o, &err), IL_OK);
        for (size_t i = 0; i < 3 * a.mesh.n_vertices; i++)
            a.mesh.xyz[i] *= 64;
        assert_same_mesh(&a.mesh, &b.mesh);
        il_mesh_free(&a.mesh);
        il_mesh_free(&b.mesh);
        free_slices(slice, n);
    }
}

static void the_start_and_direction_of_rings_do_not_matter(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        il_slice slice[6];
        size_t n = stack_make(STACK_FRAME, seed, slice);
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        il_error err = IL_ERROR_INIT;
        keeper a = new_keeper(), b = new_keeper();
        assert_int_equal(loft(&a, slice, n, &o, &err), IL_OK);
        for (size_t i = 0; i < n; i++)
            for (size_t r = 0; r < slice[i].n; r++) {
                il_ring_rotate(&slice[i].ring[r], (seed + r) % slice[i].ring[r].n);
                if ((seed + i) % 2)
                    il_ring_reverse(&slice[i].ring[r]);
            }
        assert_int_equal(loft(&b, slice, n, &o, &err), IL_OK);
        assert_same_mesh(&a.mesh, &b.mesh);
        il_mesh_free(&a.mesh);
        il_mesh_free(&b.mesh);
        free_slices(slice, n);
    }
}

/* The part whose sheets look up in one slab looks down in the other, so only
 * what does not depend on the grid is compared. */
static void turning_the_stack_upside_down_keeps_volume_and_topology(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        il_slice slice[6], turned[6];
        size_t n = stack_make(STACK_FRAME, seed, slice);
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        il_error err = IL_ERROR_INIT;
        keeper a = new_keeper(), b = new_keeper();
        for (size_t i = 0; i < n; i++) {
            assert_int_equal(il_slice_copy(&turned[n - 1 - i], &slice[i], &err), IL_OK);
            turned[n - 1 - i].z = -slice[i].z;
        }
        assert_int_equal(loft(&a, slice, n, &o, &err), IL_OK);
        assert_int_equal(loft(&b, turned, n, &o, &err), IL_OK);
        assert_int_equal(a.facts.genus, b.facts.genus);
        assert_int_equal(a.facts.components, b.facts.components);
        assert_true(fabs(a.facts.volume - b.facts.volume) < .02 * a.facts.volume);
        il_mesh_free(&a.mesh);
        il_mesh_free(&b.mesh);
        free_slices(slice, n);
        free_slices(turned, n);
    }
}

/* ---- what cannot be lofted ---- */

static void slices_too_small_for_exact_arithmetic_are_refused(void **state)
{
    (void)state;
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    keeper k = new_keeper();
    slice[1].z = 1;
    add_box(&slice[0], 0, 0, 1e-300, 1e-300);
    add_box(&slice[1], 0, 0, 1e-300, 2e-300);
    assert_int_equal(loft(&k, slice, 2, &o, &err), IL_E_INPUT);
    free_slices(slice, 2);
    il_mesh_free(&k.mesh);
}

static void a_single_slice_is_refused(void **state)
{
    (void)state;
    il_slice slice = IL_SLICE_INIT;
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    il_error err = IL_ERROR_INIT;
    keeper k = new_keeper();
    add_box(&slice, 0, 0, 1, 1);
    assert_int_equal(loft(&k, &slice, 1, &o, &err), IL_E_INPUT);
    assert_int_equal(k.abandoned, 1);
    assert_int_equal(k.ended, 0);
    il_mesh_free(&k.mesh);
    free_slices(&slice, 1);
}

static void a_stack_without_contours_is_abandoned(void **state)
{
    (void)state;
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    slice[1].z = 1;
    for (size_t n = 0; n <= 2; n += 2) {
        il_error err = IL_ERROR_INIT;
        keeper k = new_keeper();
        assert_int_equal(loft(&k, slice, n, &o, &err), IL_OK);
        assert_int_equal(k.abandoned, 1);
        assert_int_equal(k.ended, 0);
        il_mesh_free(&k.mesh);
    }
}

/* Two triangles of a few metres at UTM coordinates, where floats stand half a
 * metre apart.  The slab below is sound, but must not go out by itself: where
 * rings part in the slice between depends on both. */
static void a_slab_that_fails_ends_the_stack_before_its_neighbour_leaves(void **state)
{
    (void)state;
    static const double xy[3][3][2] = { { { 6, 4 }, { 7, 5 }, { 3, 8 } }, { { 6, 4 }, { 7, 5 }, { 3, 8 } },
                                        { { 2, 4 }, { 2, 1 }, { 4, 8 } } };
    il_slice slice[3] = { IL_SLICE_INIT, IL_SLICE_INIT, IL_SLICE_INIT };
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    o.round_float = true;
    for (int i = 0; i < 3; i++) {
        il_ring *r = il_slice_add_ring(&slice[i]);
        assert_non_null(r);
        slice[i].z = i;
        for (int k = 0; k < 3; k++)
            assert_true(il_ring_add(r, 5e6 + xy[i][k][0] / 2, 35e5 + xy[i][k][1] / 2, 0));
    }
    il_error err = IL_ERROR_INIT;
    keeper k = new_keeper();
    assert_int_equal(loft(&k, slice, 3, &o, &err), IL_E_SURFACE);
    assert_non_null(strstr(err.text, "between slice 1 (z = 1) and slice 2 (z = 2)"));
    assert_int_equal(k.abandoned, 1);
    assert_int_equal(k.mesh.n_triangles, 0);
    il_mesh_free(&k.mesh);
    free_slices(slice, 3);
}

/* Both slices need points between them, and only a few numbers are there. */
static void slices_a_few_ulps_apart_are_lofted(void **state)
{
    (void)state;
    for (int k = 1; k <= 64; k *= 4)
        for (int f = 0; f < 2; f++) {
            double ulp = f ? 0x1p-23 : 0x1p-52;
            const double box[3][5] = { { 1, 0, 0, 4, 4 }, { 1 + (k + 1) * ulp, 1, 1, 3, 3 }, { 2, 1, 1, 3, 3 } };
            il_loft_options o = IL_LOFT_OPTIONS_INIT;
            o.round_float = f;
            keeper kept = loft_boxes(box, 3, &o);
            il_mesh_free(&kept.mesh);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_slices_are_lofted),
        cmocka_unit_test(shared_collinear_and_opposite_edges_are_lofted),
        cmocka_unit_test(cells_one_ulp_off_are_lofted),
        cmocka_unit_test(cells_a_billionth_off_are_lofted),
        cmocka_unit_test(unrelated_slices_are_lofted),
        cmocka_unit_test(common_frames_are_lofted),
        cmocka_unit_test(rings_sliding_along_their_edges_are_lofted),
        cmocka_unit_test(halves_by_turns_are_lofted),
        cmocka_unit_test(copies_one_ulp_off_are_lofted),
        cmocka_unit_test(tangles_are_lofted),
        cmocka_unit_test(stacks_far_from_the_origin_are_lofted_in_floats),
        cmocka_unit_test(a_prism_has_its_volume_area_and_twelve_triangles),
        cmocka_unit_test(a_tube_has_genus_one),
        cmocka_unit_test(a_branch_joins_two_legs_in_one_piece),
        cmocka_unit_test(rings_apart_are_pieces_of_their_own_with_domes_inside),
        cmocka_unit_test(a_dome_reaches_half_a_spacing_beyond_the_end),
        cmocka_unit_test(an_empty_slice_inside_parts_the_stack),
        cmocka_unit_test(the_mesh_is_the_same_for_any_number_of_threads),
        cmocka_unit_test(scaling_by_a_power_of_two_scales_the_mesh_bit_for_bit),
        cmocka_unit_test(the_start_and_direction_of_rings_do_not_matter),
        cmocka_unit_test(turning_the_stack_upside_down_keeps_volume_and_topology),
        cmocka_unit_test(slices_too_small_for_exact_arithmetic_are_refused),
        cmocka_unit_test(a_single_slice_is_refused),
        cmocka_unit_test(a_stack_without_contours_is_abandoned),
        cmocka_unit_test(a_slab_that_fails_ends_the_stack_before_its_neighbour_leaves),
        cmocka_unit_test(slices_a_few_ulps_apart_are_lofted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
