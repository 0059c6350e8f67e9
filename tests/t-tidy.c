/* t-tidy.c - which triangles become better ones, and which are left. */
#include "config.h"
#include "loft/certificate.h"
#include "loft/net.h"
#include "loft/tidy.h"
#include "test.h"

#include <math.h>
#include <string.h>

/* ---- a slab of a few walls ---------------------------------------------------------- */

typedef struct wall_slab {
    il_section section[2];
    il_surface s;
} wall_slab;

static void add_ring(il_slice *s, const double (*xy)[2], size_t n)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    for (size_t i = 0; i < n; i++)
        assert_true(il_ring_add(r, xy[i][0], xy[i][1], 0));
}

static uint32_t low(uint32_t i)
{
    return IL_CODE(IL_LOWER, i);
}

static uint32_t high(uint32_t i)
{
    return IL_CODE(IL_UPPER, i);
}

static void add_triangle(wall_slab *w, uint32_t a, uint32_t b, uint32_t c)
{
    assert_true(il_surface_add_triangle(&w->s, a, b, c));
}

/* Walls between rings of N nodes from A below and B above, every diagonal from below to the next above. */
static void add_walls(wall_slab *w, uint32_t a, uint32_t b, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t j = (i + 1) % n;
        add_triangle(w, low(a + i), low(a + j), high(b + j));
        add_triangle(w, low(a + i), high(b + j), high(b + i));
    }
}

/* Over N nodes from A below. */
static void add_cone(wall_slab *w, uint32_t a, uint32_t n, const double apex[3])
{
    uint32_t code = il_surface_add_inner(&w->s, apex);
    for (uint32_t i = 0; i < n; i++)
        add_triangle(w, low(a + i), low(a + (i + 1) % n), code);
}

static void begin(wall_slab *w, il_slice slice[2])
{
    memset(w, 0, sizeof *w);
    for (int k = 0; k < 2; k++) {
        assert_int_equal(il_section_from_slice(&w->section[k], &slice[k], NULL), IL_OK);
        il_slice_free(&slice[k]);
    }
}

static void assert_certified(const wall_slab *w)
{
    il_verdict v;
    assert_int_equal(il_certify(&w->s, &w->section[0], &w->section[1], &v, NULL), IL_OK);
    assert_string_equal(il_flaw_words(v.flaw), il_flaw_words(IL_FLAW_NONE));
}

static void tidy(wall_slab *w)
{
    assert_certified(w);
    assert_int_equal(il_tidy(&w->s, &w->section[0], &w->section[1], NULL), IL_OK);
    assert_certified(w);
}

static void end(wall_slab *w)
{
    il_surface_free(&w->s);
    il_section_free(&w->section[0]);
    il_section_free(&w->section[1]);
}

static bool has_edge(const wall_slab *w, uint32_t a, uint32_t b)
{
    for (size_t i = 0; i < 3 * w->s.n_triangles; i++)
        if (w->s.tri[i] == a && w->s.tri[i % 3 == 2 ? i - 2 : i + 1] == b)
            return true;
    return false;
}

/* Two slices with a square each, at x, the upper 3 beyond the lower and its second corner at y. */
static void lay_sheared(il_slice slice[2], double x, double y)
{
    const double lower[][2] = { { x, 0 }, { x + 4, 0 }, { x + 4, 4 }, { x, 4 } };
    const double upper[][2] = { { x + 3, 0 }, { x + 7, y }, { x + 7, 4 }, { x + 3, 4 } };
    slice[1].z = 4;
    add_ring(&slice[0], lower, 4);
    add_ring(&slice[1], upper, 4);
}

/* ---- tests ------------------------------------------------------------------------------ */

static void the_shorter_diagonal_is_taken(void **state)
{
    (void)state;
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    wall_slab w;
    lay_sheared(slice, 0, 0);
    begin(&w, slice);
    add_walls(&w, 0, 0, 4);
    tidy(&w);
    assert_true(has_edge(&w, low(1), high(0)));
    assert_false(has_edge(&w, low(0), high(1)));
    assert_true(has_edge(&w, low(2), high(3))); /* was short */
    assert_true(has_edge(&w, low(1), high(2))); /* no better than the other */
    assert_int_equal(w.s.n_triangles, 8);
    end(&w);
}

/* The diagonals pass each other at about half of Y. */
static bool is_flipped_when_bent(double y)
{
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    wall_slab w;
    lay_sheared(slice, 0, y);
    begin(&w, slice);
    add_walls(&w, 0, 0, 4);
    tidy(&w);
    bool flipped = has_edge(&w, low(1), high(0));
    end(&w);
    return flipped;
}

static void what_would_move_the_surface_is_left(void **state)
{
    (void)state;
    double most = 4 * IL_NET_MOVE;
    assert_true(is_flipped_when_bent(1.8 * most) && is_flipped_when_bent(-1.8 * most));
    assert_false(is_flipped_when_bent(2.4 * most) || is_flipped_when_bent(-2.4 * most));
}

/* Seen from below the cone's triangles at its second node are flat, and much better with the other
 * diagonal, which would lie in the slice. */
static void nodes_of_one_slice_are_not_joined(void **state)
{
    (void)state;
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    const double ring[][2] = { { 40, 0 }, { 42, .5 }, { 44, 0 }, { 44, 4 }, { 40, 4 } }, apex[3] = { 42, -30, .5 };
    wall_slab w;
    lay_sheared(slice, 0, 0);
    add_ring(&slice[0], ring, 5);
    begin(&w, slice);
    add_walls(&w, 0, 0, 4);
    add_cone(&w, 4, 5, apex);
    tidy(&w);
    assert_false(has_edge(&w, low(4), low(6)) || has_edge(&w, low(6), low(4)));
    assert_true(has_edge(&w, low(1), high(0)));
    end(&w);
}

/* The tip of a cone stands between the two diagonals of the first wall. */
static void what_would_meet_is_not_flipped_and_the_rest_is(void **state)
{
    (void)state;
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    const double ring[][2] = { { 3, -3 }, { 3.5, -4 }, { 4, -3 } }, apex[3] = { 3.5, .0075, 2 };
    wall_slab w;
    lay_sheared(slice, 0, .03);
    lay_sheared(slice, 20, .03);
    add_ring(&slice[0], ring, 3);
    begin(&w, slice);
    add_walls(&w, 0, 0, 4);
    add_walls(&w, 4, 4, 4);
    add_cone(&w, 8, 3, apex);
    tidy(&w);
    assert_true(has_edge(&w, low(0), high(1)));
    assert_true(has_edge(&w, low(5), high(4)));
    end(&w);
}

/* A box whose front has two inner points, at y, 2 and X from the left: how many stay? */
static size_t inner_points_left(double x, double y)
{
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    const double ring[][2] = { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 } }, p[3] = { 2, y, 2 }, q[3] = { x, y, 2 };
    wall_slab w;
    slice[1].z = 4;
    add_ring(&slice[0], ring, 4);
    add_ring(&slice[1], ring, 4);
    begin(&w, slice);
    add_walls(&w, 0, 0, 4);
    memmove(w.s.tri, w.s.tri + 6, 18 * sizeof *w.s.tri); /* no front */
    w.s.n_triangles = 6;
    uint32_t left = il_surface_add_inner(&w.s, p), right = il_surface_add_inner(&w.s, q);
    add_triangle(&w, low(0), low(1), left), add_triangle(&w, low(1), right, left);
    add_triangle(&w, low(1), high(1), right), add_triangle(&w, high(1), left, right);
    add_triangle(&w, high(1), high(0), left), add_triangle(&w, high(0), low(0), left);
    tidy(&w);
    size_t n = w.s.n_inner;
    assert_int_equal(w.s.n_triangles, 8 + 2 * n);
    end(&w);
    return n;
}

static void points_too_close_to_each_other_become_one(void **state)
{
    (void)state;
    assert_int_equal(inner_points_left(2.1, 0), 1);
    assert_int_equal(inner_points_left(2.5, 0), 1);
    assert_int_equal(inner_points_left(2.1, -.1), 1);
}

static void points_that_stand_out_stay(void **state)
{
    (void)state;
    assert_int_equal(inner_points_left(2.5, -.5), 2);
    assert_int_equal(inner_points_left(2.5, .5), 2);
}

/* It would hardly move, but the cone would lie in the slice: over N nodes. */
static void leave_tip(size_t n)
{
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    const double ring[][2] = { { 40, 0 }, { 44, 0 }, { 44, 4 }, { 40, 4 } }, apex[3] = { 40.2, .1, .01 };
    wall_slab w;
    lay_sheared(slice, 0, 0);
    add_ring(&slice[0], ring, n);
    begin(&w, slice);
    add_walls(&w, 0, 0, 4);
    add_cone(&w, 4, (uint32_t)n, apex);
    tidy(&w);
    assert_int_equal(w.s.n_inner, 1);
    assert_true(has_edge(&w, low(1), high(0)));
    end(&w);
}

static void a_tip_close_to_its_contour_stays(void **state)
{
    (void)state;
    leave_tip(3);
    leave_tip(4);
}

/* A wide box whose front has a long edge from height 2 to Z at the right: does the much shorter
 * diagonal come in its place? */
static bool is_cut_across(double z)
{
    il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    const double ring[][2] = { { 0, 0 }, { 20, 0 }, { 40, 0 }, { 40, 4 }, { 0, 4 } }, p[3] = { 5, 0, 2 }, q[3] = { 35, 0, z };
    wall_slab w;
    slice[1].z = 4;
    add_ring(&slice[0], ring, 5);
    add_ring(&slice[1], ring, 5);
    begin(&w, slice);
    add_walls(&w, 0, 0, 5);
    memmove(w.s.tri, w.s.tri + 12, 18 * sizeof *w.s.tri); /* no front */
    w.s.n_triangles = 6;
    uint32_t left = il_surface_add_inner(&w.s, p), right = il_surface_add_inner(&w.s, q);
    add_triangle(&w, low(0), low(1), left), add_triangle(&w, low(1), low(2), right);
    add_triangle(&w, low(1), right, left), add_triangle(&w, left, right, high(1));
    add_triangle(&w, high(1), high(0), left), add_triangle(&w, right, high(2), high(1));
    add_triangle(&w, high(0), low(0), left), add_triangle(&w, low(2), high(2), right);
    tidy(&w);
    bool cut = has_edge(&w, low(1), high(1));
    end(&w);
    return cut;
}

static void contours_between_the_slices_stay(void **state)
{
    (void)state;
    assert_true(is_cut_across(2.1));
    assert_false(is_cut_across(2));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shorter_diagonal_is_taken),
        cmocka_unit_test(what_would_move_the_surface_is_left),
        cmocka_unit_test(nodes_of_one_slice_are_not_joined),
        cmocka_unit_test(what_would_meet_is_not_flipped_and_the_rest_is),
        cmocka_unit_test(points_too_close_to_each_other_become_one),
        cmocka_unit_test(points_that_stand_out_stay),
        cmocka_unit_test(contours_between_the_slices_stay),
        cmocka_unit_test(a_tip_close_to_its_contour_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
