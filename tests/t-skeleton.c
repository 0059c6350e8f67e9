/* t-skeleton.c - what holds together in a stack, and the side it is seen from. */
#include "config.h"
#include "base/alloc.h"
#include "output/oblique.h"
#include "output/skeleton.h"
#include "test.h"

#include <math.h>
#include <string.h>

/* ---- stacks by hand ------------------------------------------------------------ */

static il_figure new_figure(size_t levels, double spacing)
{
    il_figure f = { .n = levels, .n_slices = levels, .spacing = spacing, .z_greatest = spacing * (double)(levels - 1) };
    f.level = il_calloc(levels, sizeof *f.level);
    assert_non_null(f.level);
    for (size_t k = 0; k < levels; k++)
        f.level[k].slice.z = spacing * (double)k;
    return f;
}

static void free_figure(il_figure *f)
{
    for (size_t k = 0; k < f->n; k++) {
        il_slice_free(&f->level[k].slice);
        il_pair_free(&f->level[k].below);
    }
    il_free(f->level);
}

/* A box of that width and height round (X, Y); a hole where the width is below 0. */
static void add_box(il_figure *f, size_t level, double x, double y, double width, double height)
{
    static const double corner[4][2] = { { -.5, -.5 }, { .5, -.5 }, { .5, .5 }, { -.5, .5 } };
    il_ring *r = il_slice_add_ring(&f->level[level].slice);
    assert_non_null(r);
    for (int k = 0; k < 4; k++)
        assert_true(il_ring_add(r, x + width * corner[k][0], y + height * corner[k][1], 0));
}

static il_group *add_group(il_figure *f, size_t level)
{
    il_pair *p = &f->level[level].below;
    assert_true(il_grow(&p->group, &p->cap_groups, p->n_groups + 1, sizeof *p->group));
    memset(&p->group[p->n_groups], 0, sizeof *p->group);
    f->level[level].has_pair = true;
    return &p->group[p->n_groups++];
}

static void add_ring(uint32_t **list, size_t *n, size_t *cap, uint32_t ring)
{
    assert_true(il_grow(list, cap, *n + 1, sizeof **list));
    (*list)[(*n)++] = ring;
}

static void add_link(il_group *g, uint32_t lower, uint32_t upper, il_link_reason reason, double reach)
{
    assert_true(il_grow(&g->link, &g->cap_links, g->n_links + 1, sizeof *g->link));
    g->link[g->n_links++] = (il_link){ lower, upper, reason, reach };
}

static il_skeleton skeleton_of(const il_figure *f)
{
    il_skeleton s;
    assert_int_equal(il_skeleton_find(&s, f, NULL), IL_OK);
    return s;
}

/* ---- centres, links, pieces ------------------------------------------------------- */

static void centres_are_those_of_the_area(void **state)
{
    (void)state;
    il_figure f = new_figure(1, 1);
    il_ring *r = il_slice_add_ring(&f.level[0].slice);
    static const double l[6][2] = { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } }; /* areas 3 and 2 */
    for (int k = 0; k < 6; k++)
        assert_true(il_ring_add(r, 1e6 + l[k][0], l[k][1] - 1e6, 0));
    add_box(&f, 0, 0, 0, -1, 1);
    il_skeleton s = skeleton_of(&f);
    assert_int_equal(s.n_joints, 1); /* a hole has none */
    assert_true(fabs(s.joint[0].x - (1e6 + 1.1)) < 1e-8 && fabs(s.joint[0].y - (1.1 - 1e6)) < 1e-8);
    assert_int_equal(s.joint_of[1], UINT32_MAX);
    assert_int_equal(s.n_pieces, 1);
    assert_false(s.joint[0].ends);
    il_skeleton_free(&s);
    il_skeleton_free(&s);
    free_figure(&f);
}

static void links_beyond_the_height_of_the_slab_are_guesses(void **state)
{
    (void)state;
    il_figure f = new_figure(2, 2);
    for (int k = 0; k < 6; k++) {
        add_box(&f, 0, 10 * k, 0, 4, 4);
        add_box(&f, 1, 10 * k + 5, 0, 4, 4);
    }
    add_box(&f, 1, 0, 0, -1, 1);
    il_group *g = add_group(&f, 1);
    add_link(g, 0, 0, IL_LINK_JOIN, 2);
    add_link(g, 1, 1, IL_LINK_JOIN, 2.001);
    add_link(g, 2, 2, IL_LINK_NEAR, 0.1);
    add_link(g, 3, 3, IL_LINK_OVERLAP, 0);
    add_link(g, 3, 3, IL_LINK_NEAR, 0.1);  /* the same two again */
    add_link(g, 4, 4, IL_LINK_GIVEN, 9);
    add_link(g, 5, 5, IL_LINK_OPENING, 0); /* no solid goes there */
    add_link(g, 5, 6, IL_LINK_OVERLAP, 0); /* nor through a hole */
    il_skeleton s = skeleton_of(&f);
    static const size_t wanted[IL_N_BONDS] = { 1, 1, 1, 1, 1, 0 };
    assert_memory_equal(s.bonds, wanted, sizeof wanted);
    assert_int_equal(s.n_bones, 5);
    assert_int_equal(s.n_pieces, 7);
    il_skeleton_free(&s);
    free_figure(&f);
}

static void a_group_without_links_holds_its_rings_together(void **state)
{
    (void)state;
    il_figure f = new_figure(2, 1);
    for (int k = 0; k < 3; k++) {
        add_box(&f, 0, 10 * k, 0, 4, 4);
        add_box(&f, 1, 10 * k, 0, 4, 4);
    }
    il_group *g = add_group(&f, 1);
    for (uint32_t k = 0; k < 2; k++) {
        add_ring(&g->lower, &g->n_lower, &g->cap_lower, k);
        add_ring(&g->upper, &g->n_upper, &g->cap_upper, k);
    }
    g = add_group(&f, 1);
    add_ring(&g->lower, &g->n_lower, &g->cap_lower, 2); /* nothing above it */
    il_skeleton s = skeleton_of(&f);
    assert_int_equal(s.bonds[IL_BOND_GROUP], 3);
    assert_int_equal(s.n_pieces, 3);
    assert_int_equal(s.branches, 2);
    assert_int_equal(s.ends, 2);
    il_skeleton_free(&s);
    free_figure(&f);
}

/* Two legs that part and meet again, beside a small pillar with a gap in it. */
static il_figure trestle(void)
{
    il_figure f = new_figure(5, 1);
    for (size_t k = 0; k < 5; k++) {
        bool whole = k == 0 || k == 3;
        if (k < 4)
            add_box(&f, k, whole ? 5 : 0, 0, whole ? 14 : 4, 4);
        if (k < 4 && !whole)
            add_box(&f, k, 10, 0, 4, 4);
        add_box(&f, k, 30, 0, 2, 2);
    }
    for (size_t k = 1; k < 5; k++) {
        uint32_t a = (uint32_t)f.level[k - 1].slice.n - 1, b = (uint32_t)f.level[k].slice.n - 1;
        f.level[k].below.gap = k == 4;
        if (k == 4)
            break;
        il_group *g = add_group(&f, k);
        for (uint32_t i = 0; i < (a > b ? a : b); i++)
            add_link(g, a == 1 ? 0 : i, b == 1 ? 0 : i, IL_LINK_OVERLAP, 0);
        add_link(add_group(&f, k), a, b, IL_LINK_OVERLAP, 0);
    }
    return f;
}

static void branches_ends_and_loops_are_counted(void **state)
{
    (void)state;
    il_figure f = trestle();
    il_skeleton s = skeleton_of(&f);
    assert_int_equal(s.n_joints, 11);
    assert_int_equal(s.n_bones, 9);
    assert_int_equal(s.branches, 2);
    assert_int_equal(s.loops, 1);
    assert_int_equal(s.ends, 0); /* both pillars end at the gap */
    assert_int_equal(s.n_pieces, 3);
    assert_true(s.piece[0].volume == 14 * 4 * 1.5 + 2 * 32 && s.piece[0].n_joints == 6);
    assert_true(s.piece[1].volume == 4 * 3.5 && s.piece[1].low == 0 && s.piece[1].high == 3);
    assert_true(s.piece[2].volume == 2 && s.piece[2].low == 4 && s.piece[2].high == 4);
    f.level[4].below.gap = false; /* now both stop where something could go on */
    il_skeleton_free(&s);
    s = skeleton_of(&f);
    assert_int_equal(s.ends, 3);
    il_skeleton_free(&s);
    free_figure(&f);
}

static void holes_go_with_the_group_they_are_in(void **state)
{
    (void)state;
    il_figure f = new_figure(2, 1);
    add_box(&f, 0, 0, 0, 4, 4);
    add_box(&f, 0, 20, 0, 8, 8);
    add_box(&f, 0, 0, 0, -1, 1);
    add_box(&f, 0, 20, 0, -1, 1);
    add_box(&f, 1, 0, 0, 4, 4);
    il_group *g = add_group(&f, 1);
    add_ring(&g->lower, &g->n_lower, &g->cap_lower, 0);
    add_ring(&g->lower, &g->n_lower, &g->cap_lower, 2);
    add_ring(&g->upper, &g->n_upper, &g->cap_upper, 0);
    add_link(g, 0, 0, IL_LINK_OVERLAP, 0);
    il_skeleton s = skeleton_of(&f);
    static const uint32_t wanted[5] = { 1, 0, 1, UINT32_MAX, 1 };
    assert_memory_equal(s.piece_of, wanted, sizeof wanted);
    il_skeleton_free(&s);
    free_figure(&f);
}

static void without_memory_nothing_is_left(void **state)
{
    (void)state;
    il_figure f = trestle();
    il_status st = IL_E_NOMEM;
    for (long k = 0; k < 40 && st != IL_OK; k++) {
        il_skeleton s;
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        st = il_skeleton_find(&s, &f, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == st));
        il_skeleton_free(&s);
    }
    assert_int_equal(st, IL_OK);
    free_figure(&f);
}

/* ---- the view ------------------------------------------------------------------------ */

/* Where the axes point on the page: what is seen is no mirror image, and x runs right. */
static void assert_right_handed(const il_oblique *o)
{
    double at[4][2];
    for (int k = 0; k < 4; k++)
        il_oblique_point(o, o->o[0] + (k == 0), o->o[1] + (k == 1), o->o[2] + (k == 2), at[k]);
    assert_true(at[0][0] >= 0 && at[2][0] == 0 && at[2][1] > 0);
    assert_true(at[0][0] * at[1][1] - at[0][1] * at[1][0] > 0); /* from above x turns to y counter-clockwise */
}

static void the_longer_side_lies_across(void **state)
{
    (void)state;
    for (int turn = 0; turn < 24; turn++) {
        double a = turn * 0.2617993877991494, c = cos(a), s = sin(a);
        il_figure f = new_figure(2, 20);
        for (size_t k = 0; k < 2; k++)
            for (int i = -3; i <= 3; i++)
                add_box(&f, k, 50 + 5 * i * c, -20 + 5 * i * s, 2, 2);
        il_oblique o = il_oblique_view(&f);
        assert_right_handed(&o);
        assert_true(fabs(fabs(o.across[0] * c + o.across[1] * s) - 0.9659) < 1e-3); /* but for 15 degrees */
        assert_true(o.stretch == 1);
        for (size_t k = 0; k < 2; k++) {
            double uv[8];
            il_oblique_ring(&o, &f.level[k].slice.ring[0], f.level[k].slice.z, uv);
            for (int i = 0; i < 4; i++)
                assert_true(uv[2 * i] >= o.window.low[0] && uv[2 * i] <= o.window.high[0] &&
                            uv[2 * i + 1] >= o.window.low[1] && uv[2 * i + 1] <= o.window.high[1]);
        }
        free_figure(&f);
    }
}

static void flat_stacks_are_stretched_and_high_ones_pressed(void **state)
{
    (void)state;
    static const double spacing[] = { 0.001, 1, 30, 100, 1000, 1e6 };
    for (size_t k = 0; k < sizeof spacing / sizeof *spacing; k++) {
        il_figure f = new_figure(2, spacing[k]);
        add_box(&f, 0, 0, 0, 60, 60);
        add_box(&f, 1, 0, 0, 60, 60);
        il_oblique o = il_oblique_view(&f);
        double shape = o.stretch * spacing[k] / (o.window.high[0] - o.window.low[0]);
        assert_true(shape >= 0.1 && shape <= 2.6);
        assert_true((o.stretch == 1) == (spacing[k] == 30 || spacing[k] == 100));
        assert_right_handed(&o);
        free_figure(&f);
    }
}

static void without_rings_there_is_a_view_all_the_same(void **state)
{
    (void)state;
    il_figure f = new_figure(2, 1);
    il_oblique o = il_oblique_view(&f);
    assert_true(il_box_is_empty(&o.window));
    assert_right_handed(&o);
    free_figure(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(centres_are_those_of_the_area),
        cmocka_unit_test(links_beyond_the_height_of_the_slab_are_guesses),
        cmocka_unit_test(a_group_without_links_holds_its_rings_together),
        cmocka_unit_test(branches_ends_and_loops_are_counted),
        cmocka_unit_test(holes_go_with_the_group_they_are_in),
        cmocka_unit_test(without_memory_nothing_is_left),
        cmocka_unit_test(the_longer_side_lies_across),
        cmocka_unit_test(flat_stacks_are_stretched_and_high_ones_pressed),
        cmocka_unit_test(without_rings_there_is_a_view_all_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
