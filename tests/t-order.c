#include "config.h"
#include "model/order.h"
#include "test.h"

#include <stdlib.h>

/* The vertex at place I of R read from FIRST on. */
static const double *vertex(const il_ring *r, size_t first, size_t i)
{
    return &r->xy[2 * ((first + i) % r->n)];
}

/* Is R read from A on at most R read from B on? */
static bool at_most(const il_ring *r, size_t a, size_t b)
{
    for (size_t i = 0; i < r->n; i++) {
        const double *p = vertex(r, a, i), *q = vertex(r, b, i);
        if (p[0] != q[0] || p[1] != q[1])
            return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
    }
    return true;
}

static uint32_t next_random(uint32_t *s) /* linear congruential (Numerical Recipes) */
{
    *s = *s * 1664525u + 1013904223u;
    return *s >> 16;
}

/* Few different vertices, so that many repeat. */
static il_ring random_ring(uint32_t *seed)
{
    il_ring r = IL_RING_INIT;
    size_t n = next_random(seed) % 12;
    for (size_t i = 0; i < n; i++)
        assert_true(il_ring_add(&r, next_random(seed) % 2, next_random(seed) % 2, 0));
    return r;
}

static void the_first_vertex_makes_the_least_sequence(void **state)
{
    (void)state;
    uint32_t seed = 1;
    for (int round = 0; round < 5000; round++) {
        il_ring r = random_ring(&seed);
        size_t first = il_ring_first(&r);
        assert_true(first < r.n || (r.n == 0 && first == 0));
        for (size_t i = 0; i < r.n; i++)
            assert_true(at_most(&r, first, i) && (i >= first || !at_most(&r, i, first)));
        il_ring_free(&r);
    }
}

/* A start for every vertex that looks like a better one only at the very end
 * of the ring: hours, if each were read to there. */
static void repeats_do_not_make_it_slow(void **state)
{
    (void)state;
    enum { MANY = 400000 };
    for (int last = -1; last <= 1; last++) {
        il_ring r = IL_RING_INIT;
        for (int i = 0; i < MANY; i++)
            assert_true(il_ring_add(&r, i + 1 < MANY ? 0 : last, 0, 0));
        assert_int_equal(il_ring_first(&r), last < 0 ? MANY - 1 : 0);
        il_ring_free(&r);
    }
}

static void an_open_line_begins_where_it_begins(void **state)
{
    (void)state;
    il_ring r = IL_RING_INIT;
    r.open = true;
    assert_true(il_ring_add(&r, 5, 5, 0) && il_ring_add(&r, 1, 1, 0));
    assert_int_equal(il_ring_first(&r), 0);
    il_ring_free(&r);
}

static void add_ring(il_slice *s, const double *xy, size_t n, bool open)
{
    il_ring *r = il_slice_add_ring(s);
    assert_non_null(r);
    r->open = open;
    for (size_t i = 0; i < n; i++)
        assert_true(il_ring_add(r, xy[2 * i], xy[2 * i + 1], 0));
}

static void rings_stand_by_sequence_then_lines_then_index(void **state)
{
    (void)state;
    static const double a[] = { 0, 0, 1, 0 }, b[] = { 0, 0, 1, 0, 1, 1 }, c[] = { 0, 1, 0, 0 };
    il_slice s = IL_SLICE_INIT;
    add_ring(&s, a, 2, true);
    add_ring(&s, b, 3, false);
    add_ring(&s, c, 2, false); /* from its vertex 1: 0 0, 0 1 */
    add_ring(&s, a, 2, false);
    add_ring(&s, b, 3, false);
    il_ring_order o[5];
    for (size_t i = 0; i < 5; i++)
        o[i] = (il_ring_order){ &s.ring[i], il_ring_first(&s.ring[i]), i };
    qsort(o, 5, sizeof *o, il_ring_order_compare);
    static const size_t expected[] = { 2, 3, 1, 4, 0 };
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(o[i].index, expected[i]);
    il_slice_free(&s);
}

static void order_is_recognised(void **state)
{
    (void)state;
    static const double low[] = { 0, 0, 1, 0, 1, 1 }, turned[] = { 1, 0, 1, 1, 0, 0 }, high[] = { 2, 0, 3, 0, 3, 1 };
    il_slice s = IL_SLICE_INIT;
    assert_true(il_slice_in_order(&s));
    add_ring(&s, low, 3, false);
    assert_true(il_slice_in_order(&s));
    add_ring(&s, high, 3, false);
    assert_true(il_slice_in_order(&s));
    add_ring(&s, low, 3, false);
    assert_false(il_slice_in_order(&s));
    il_slice_free(&s);
    add_ring(&s, turned, 3, false);
    assert_false(il_slice_in_order(&s));
    il_slice_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_vertex_makes_the_least_sequence),
        cmocka_unit_test(repeats_do_not_make_it_slow),
        cmocka_unit_test(an_open_line_begins_where_it_begins),
        cmocka_unit_test(rings_stand_by_sequence_then_lines_then_index),
        cmocka_unit_test(order_is_recognised),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
