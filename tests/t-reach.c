/* t-reach.c - links over a whole stack stay cheap where all is within reach of all.  Of how right they are see
 * t-trees.c. */
#include "config.h"
#include "match/linkage.h"
#include "base/alloc.h"
#include "model/order.h"
#include "test.h"

#include <math.h>

static void add_square(il_slice *s, double x, double y, double side)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    assert_true(il_ring_add(r, x, y, 0) && il_ring_add(r, x + side, y, 0) && il_ring_add(r, x + side, y + side, 0) &&
                il_ring_add(r, x, y + side, 0));
}

static il_linkage linked(const il_slice *two, il_pieces_mode pieces)
{
    const il_pair *known[2] = { NULL, NULL };
    il_linkage_options o = il_linkage_options_for(pieces);
    il_linkage l = IL_LINKAGE_INIT;
    assert_int_equal(il_linkage_find(&l, two, 2, known, &o, NULL), IL_OK);
    return l;
}

/* N by N squares 4 apart in each of two slices, the upper ones over the gaps. */
static void make_grids(il_slice two[2], int n, double height)
{
    for (int k = 0; k < 2; k++) {
        two[k] = (il_slice)IL_SLICE_INIT;
        two[k].z = k * height;
        for (int i = 0; i < n * n; i++)
            add_square(&two[k], i / n * 4 + k * 2, i % n * 4 + k * 2, 1);
        il_slice_put_in_order(&two[k]);
    }
}

/* All pairs of them would be 10^8. */
static void many_rings_within_reach_are_linked_to_the_nearest(void **state)
{
    (void)state;
    enum { N = 100 };
    il_slice two[2];
    make_grids(two, N, 300);
    il_linkage l = linked(two, IL_PIECES_USUAL);
    assert_int_equal(l.first[1], 2 * N * N - 1);
    for (size_t i = 0; i < l.first[1]; i++) {
        assert_int_equal(l.link[i].reason, IL_LINK_NEAR);
        assert_true(fabs(l.link[i].reach - sqrt(2)) < 1e-9);
    }
    il_linkage_free(&l);
    il_slice_free(&two[0]);
    il_slice_free(&two[1]);
}

static size_t count_links(int n, double height, il_pieces_mode pieces)
{
    il_slice two[2];
    make_grids(two, n, height);
    il_linkage l = linked(two, pieces);
    size_t count = l.first[1];
    il_linkage_free(&l);
    il_slice_free(&two[0]);
    il_slice_free(&two[1]);
    return count;
}

/* The gap of 1.4 is near for the height of 15, and to be joined over by what dominates for 2; no square does. */
static void what_lies_near_is_linked_and_closes_no_loop(void **state)
{
    (void)state;
    assert_int_equal(count_links(5, 15, IL_PIECES_USUAL), 2 * 5 * 5 - 1);
    assert_int_equal(count_links(5, 2, IL_PIECES_USUAL), 0);
    assert_int_equal(count_links(5, 15, IL_PIECES_OVERLAP), 0);
}

/* A tenth of the volume may be joined onto, by what is as large. */
static void few_pieces_need_none_that_dominates(void **state)
{
    (void)state;
    assert_int_equal(count_links(2, 2, IL_PIECES_FEW), 2 * 2 * 2 - 1);
    assert_int_equal(count_links(3, 2, IL_PIECES_FEW), 0);
}

/* An outline of many vertices beside many rings: each looks at what is near it. */
static void a_long_outline_beside_many_rings_is_near_to_all(void **state)
{
    (void)state;
    enum { VERTICES = 200000, RINGS = 2000 };
    il_slice two[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
    il_ring *r = il_slice_add_ring(&two[0]);
    assert_non_null(r);
    for (int i = 0; i < VERTICES; i++)
        assert_true(il_ring_add(r, i * .1, i % 2 * .01, 0));
    assert_true(il_ring_add(r, VERTICES * .1, 50, 0) && il_ring_add(r, 0, 50, 0));
    for (int i = 0; i < RINGS; i++)
        add_square(&two[1], 5 + i * 8, -1.5, 1);
    two[1].z = 100;
    il_slice_put_in_order(&two[0]);
    il_slice_put_in_order(&two[1]);
    il_linkage l = linked(two, IL_PIECES_USUAL);
    assert_int_equal(l.first[1], RINGS);
    for (size_t i = 0; i < RINGS; i++)
        assert_true(l.link[i].reach >= .5 && l.link[i].reach < .511);
    il_linkage_free(&l);
    il_slice_free(&two[0]);
    il_slice_free(&two[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_rings_within_reach_are_linked_to_the_nearest),
        cmocka_unit_test(what_lies_near_is_linked_and_closes_no_loop),
        cmocka_unit_test(few_pieces_need_none_that_dominates),
        cmocka_unit_test(a_long_outline_beside_many_rings_is_near_to_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
