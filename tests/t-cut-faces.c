/* t-cut-faces.c - the pieces into which cuts part the regions of a slice. */
#include "config.h"
#include "base/alloc.h"
#include "output/cut-faces.h"
#include "stacks.h"
#include "test.h"

#include <math.h>

static void add_box(il_slice *s, double x0, double y0, double x1, double y1)
{
    const double corner[4][2] = { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } };
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    for (int k = 0; k < 4; k++)
        assert_true(il_ring_add(r, corner[k][0], corner[k][1], 0));
}

static il_cut cut_of(bool upper, double *xy, size_t n)
{
    return (il_cut){ .upper = upper, .ring = 0, .xy = xy, .n = n };
}

/* The area of face K of F: its loops run with it on their left. */
static double area_of(const il_cut_faces *f, uint32_t face)
{
    double area2 = 0;
    for (size_t i = 0; i < f->n_loops; i++) {
        il_ring r = { .xy = f->xy + 2 * f->first[i], .n = f->first[i + 1] - f->first[i] };
        area2 += f->face[i] == face ? il_ring_area2(&r) : 0;
    }
    return area2 / 2;
}

static il_cut_faces faces_of(const il_slice *s, const il_cut *cut, size_t n)
{
    il_cut_faces f;
    il_error err = IL_ERROR_INIT;
    if (il_cut_faces_find(&f, s, cut, n, false, &err) != IL_OK)
        fail_msg("%s", err.text);
    return f;
}

static void assert_areas(const il_slice *s, const il_cut *cut, size_t n, const double *area, size_t n_faces)
{
    il_cut_faces f = faces_of(s, cut, n);
    assert_int_equal(f.n_faces, n_faces);
    double least = -INFINITY;
    for (size_t k = 0; k < n_faces; k++) { /* AREA rises; faces are in any order */
        double next = INFINITY;
        size_t same = 0;
        for (uint32_t i = 0; i < n_faces; i++) {
            double a = area_of(&f, i);
            next = a > least + 1e-9 && a < next ? a : next;
        }
        for (uint32_t i = 0; i < n_faces; i++)
            same += fabs(area_of(&f, i) - next) < 1e-9;
        assert_true(fabs(next - area[k]) < 1e-6);
        assert_int_equal(same, 1);
        least = next;
    }
    il_cut_faces_free(&f);
    il_cut_faces_free(&f);
}

static void a_region_falls_into_as_many_pieces_as_its_cuts_make(void **state)
{
    (void)state;
    il_slice s = IL_SLICE_INIT;
    add_box(&s, 0, 0, 10, 4);
    add_box(&s, 2, 3, 1, 2); /* a hole */
    add_box(&s, 20, 0, 24, 4);
    double a[] = { 3, 0, 3.5, 2, 3, 4 }, b[] = { 8, 0, 8, 4 }, other[] = { 5, 0, 5, 4 };
    il_cut cut[] = { cut_of(false, a, 3), cut_of(false, b, 2), cut_of(true, other, 2) };
    assert_areas(&s, cut, 3, (double[]){ 8, 12, 19 }, 3);
    assert_areas(&s, cut, 1, (double[]){ 12, 27 }, 2);
    assert_areas(&s, cut + 2, 1, NULL, 0); /* in the other slice */
    il_slice_free(&s);
}

static void cuts_may_end_on_a_hole_and_on_each_other(void **state)
{
    (void)state;
    il_slice s = IL_SLICE_INIT;
    add_box(&s, 0, 0, 9, 9);
    add_box(&s, 6, 8, 3, 7);
    double to_hole[] = { 4, 9, 4, 8 }, from_hole[] = { 4, 7, 4, 0 }, fork[] = { 4, 5, 9, 5 };
    il_cut cut[] = { cut_of(false, to_hole, 2), cut_of(false, from_hole, 2), cut_of(false, fork, 2) };
    assert_areas(&s, cut, 2, (double[]){ 35, 43 }, 2);
    assert_areas(&s, cut, 3, (double[]){ 18, 25, 35 }, 3);
    assert_areas(&s, cut, 1, NULL, 0); /* what goes round the hole still holds together */
    il_slice_free(&s);
}

static void a_cut_that_rounding_shortened_still_cuts(void **state)
{
    (void)state;
    il_slice s = IL_SLICE_INIT;
    add_box(&s, 0, 0, 10, 4);
    double a[] = { 3, 1e-5, 3, 4 - 1e-5 }, half[] = { 6, 0, 6, 3 };
    il_cut cut[] = { cut_of(false, a, 2), cut_of(false, half, 2) };
    assert_areas(&s, cut, 1, (double[]){ 12, 28 }, 2);
    assert_areas(&s, cut + 1, 1, NULL, 0);
    il_slice_free(&s);
}

static void nonsense_makes_no_pieces_and_no_failure(void **state)
{
    (void)state;
    il_slice s = IL_SLICE_INIT, none = IL_SLICE_INIT;
    add_box(&s, 0, 0, 0, 0);
    add_box(&s, 0, 0, 1e-300, 1e-300);
    double a[] = { 0, 0, 0, 0 }, b[] = { -9e14, 9e14, 9e14, -9e14 };
    il_cut cut[] = { cut_of(false, a, 2), cut_of(false, b, 2), cut_of(false, NULL, 0) };
    assert_areas(&none, cut, 3, NULL, 0);
    il_cut_faces f = faces_of(&s, cut, 3);
    il_cut_faces_free(&f);
    il_slice_free(&s);
}

/* Rings of every kind of trouble, with cuts at random through all of it: the pieces cover each
 * other nowhere, so that together they are no larger than what bounds them. */
static void pieces_of_any_slice_have_their_regions_areas(void **state)
{
    (void)state;
    int cut_up = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        il_slice slice[6];
        size_t n = stack_make((stack_kind)(seed % STACK_N_KINDS), seed, slice);
        uint64_t random = seed;
        double xy[5][4];
        il_cut cut[5];
        for (int i = 0; i < 5; i++) {
            for (int k = 0; k < 4; k++)
                xy[i][k] = 60 * stack_uniform(&random) - 30;
            cut[i] = cut_of(false, xy[i], 2);
        }
        il_cut_faces f = faces_of(&slice[0], cut, 5);
        for (uint32_t k = 0; k < f.n_faces; k++)
            assert_true(area_of(&f, k) > 0);
        cut_up += f.n_faces > 0;
        il_cut_faces_free(&f);
        for (size_t k = 0; k < n; k++)
            il_slice_free(&slice[k]);
    }
    assert_true(cut_up > 10);
}

static void without_memory_there_are_no_pieces(void **state)
{
    (void)state;
    il_slice s = IL_SLICE_INIT;
    add_box(&s, 0, 0, 10, 4);
    double a[] = { 3, 0, 3, 4 };
    il_cut cut = cut_of(false, a, 2);
    il_status st = IL_E_NOMEM;
    for (long k = 0; k < 200 && st != IL_OK; k++) {
        il_cut_faces f;
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        st = il_cut_faces_find(&f, &s, &cut, 1, false, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == st));
        il_cut_faces_free(&f);
    }
    assert_int_equal(st, IL_OK);
    il_slice_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_region_falls_into_as_many_pieces_as_its_cuts_make),
        cmocka_unit_test(cuts_may_end_on_a_hole_and_on_each_other),
        cmocka_unit_test(a_cut_that_rounding_shortened_still_cuts),
        cmocka_unit_test(nonsense_makes_no_pieces_and_no_failure),
        cmocka_unit_test(pieces_of_any_slice_have_their_regions_areas),
        cmocka_unit_test(without_memory_there_are_no_pieces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
