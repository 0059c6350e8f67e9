/* t-wrap.c - one outline laid round another. */
#include "config.h"
#include "base/alloc.h"
#include "match/wrap.h"
#include "matching.h"

static const double TURN = 6.283185307179586;

static il_piece piece_of(const outline *o)
{
    il_piece p = { .n = o->n };
    p.xy = il_alloc(o->n, 2 * sizeof *p.xy);
    p.next = il_alloc(o->n, sizeof *p.next);
    assert_true(p.xy && p.next);
    memcpy(p.xy, o->xy, 2 * o->n * sizeof *p.xy);
    memcpy(p.next, o->next, o->n * sizeof *p.next);
    return p;
}

static bool try_wrap(il_wrap *w, const outline *from, const outline *to)
{
    il_piece a = piece_of(from), b = piece_of(to);
    bool simple;
    assert_int_equal(il_wrap_begin(w, &a, &b, NULL, 0, &simple, NULL), IL_OK);
    il_piece_free(&a); /* copies are kept */
    il_piece_free(&b);
    return simple;
}

static il_wrap wrap(const outline *from, const outline *to)
{
    il_wrap w;
    assert_true(try_wrap(&w, from, to));
    return w;
}

/* Rising, once round. */
static void assert_once_round(const il_wrap *w)
{
    for (int i = 0; i < IL_WRAP_STEPS; i++)
        assert_true(w->at[i + 1] > w->at[i]);
    assert_near(w->at[IL_WRAP_STEPS] - w->at[0], IL_WRAP_STEPS, 1e-9);
    assert_true(il_wrap_distortion(w) >= 0);
}

static double distance_to(const outline *o, const double p[2])
{
    double least = INFINITY;
    for (size_t i = 0; i < o->n; i++) {
        const double *a = o->xy + 2 * i, *b = o->xy + 2 * o->next[i];
        double dx = b[0] - a[0], dy = b[1] - a[1];
        double t = fmin(fmax(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy), 0), 1);
        least = fmin(least, hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1]));
    }
    return least;
}

/* Twice the area that the images of FROM's points go round. */
static double image_area(const il_wrap *w, const outline *from)
{
    double sum = 0;
    for (size_t i = 0; i < from->n; i++) {
        double p[2] = { from->xy[2 * i], from->xy[2 * i + 1] };
        double q[2] = { from->xy[2 * from->next[i]], from->xy[2 * from->next[i] + 1] };
        il_wrap_apply(w, p);
        il_wrap_apply(w, q);
        sum += p[0] * q[1] - q[0] * p[1];
    }
    return sum;
}

static void circles_go_round_circles_without_a_turn(void **state)
{
    (void)state;
    static const double to[][3] = { { 0, 0, 10 }, { 100, -7, 10 }, { 3, 4, 2 }, { -50, 0, 33 } };
    for (int k = 0; k < 4; k++) {
        outline a = { 0 }, b = { 0 };
        outline_ellipse(&a, 0, 0, 10, 10, 96);
        outline_ellipse(&b, to[k][0], to[k][1], to[k][2], to[k][2], 96);
        il_wrap w = wrap(&a, &b);
        assert_once_round(&w);
        assert_near(il_wrap_distortion(&w), 0, 1e-6);
        for (size_t i = 0; i < a.n; i++) {
            double p[2] = { a.xy[2 * i], a.xy[2 * i + 1] };
            il_wrap_apply(&w, p);
            assert_near(hypot(p[0] - b.xy[2 * i], p[1] - b.xy[2 * i + 1]), 0, 1e-6 * to[k][2]);
        }
        il_wrap_free(&w);
        outline_free(&a);
        outline_free(&b);
    }
}

/* Which vertex is the first, and how many there are, tells next to nothing. */
static void where_outlines_begin_does_not_matter(void **state)
{
    (void)state;
    enum { N = 384 };
    outline a = { 0 }, b = { 0 };
    outline_star(&a, 0, 0, 1, 0, N);
    outline_star(&b, 90, 20, .8, .4, N);
    il_wrap w = wrap(&a, &b);
    assert_once_round(&w);
    for (int turn = 1; turn < N; turn += 61) {
        outline c = { 0 }, d = { 0 };
        for (int k = 0; k < N; k++) {
            outline_add(&c, a.xy[2 * ((k + turn) % N)], a.xy[2 * ((k + turn) % N) + 1]);
            outline_add(&d, b.xy[2 * ((k + 5 * turn) % N)], b.xy[2 * ((k + 5 * turn) % N) + 1]);
        }
        outline_close(&c);
        outline_close(&d);
        il_wrap v = wrap(&c, &d);
        assert_once_round(&v);
        for (size_t i = 0; i < a.n; i++) {
            double p[2] = { a.xy[2 * i], a.xy[2 * i + 1] }, q[2] = { p[0], p[1] };
            il_wrap_apply(&w, p);
            il_wrap_apply(&v, q);
            assert_true(hypot(p[0] - q[0], p[1] - q[1]) < 8); /* two of the steps that both are seen in */
        }
        il_wrap_free(&v);
        outline_free(&c);
        outline_free(&d);
    }
    il_wrap_free(&w);
    outline_free(&a);
    outline_free(&b);
}

/* The image of any shape is on any other, in order, and once round. */
static void images_lie_on_the_target_and_go_round_it(void **state)
{
    (void)state;
    for (int k = 0; k < 16; k++) {
        outline a = { 0 }, b = { 0 };
        if (k % 4 == 0)
            outline_ellipse(&a, 5, 6, 40, 7, 200);
        else if (k % 4 == 1) { /* half a disc */
            for (int i = 0; i <= 100; i++)
                outline_add(&a, 30 * cos(TURN / 200 * i), 30 * sin(TURN / 200 * i));
            for (int i = -29; i < 30; i++)
                outline_add(&a, i, 0);
            outline_close(&a);
        } else
            outline_star(&a, 7, 8, .5, .3 * k, 300);
        if (k / 4 == 0)
            outline_ellipse(&b, -90, 0, 10, 10, 250);
        else if (k / 4 == 1)
            outline_ellipse(&b, -90, 10, 6, 90, 250);
        else
            outline_star(&b, 300, 8, 1, k, 250);
        il_wrap w = wrap(&a, &b);
        assert_once_round(&w);
        for (size_t i = 0; i < a.n; i++) {
            double p[2] = { a.xy[2 * i], a.xy[2 * i + 1] };
            il_wrap_apply(&w, p);
            assert_near(distance_to(&b, p), 0, 1e-9);
        }
        double area2 = 0;
        for (size_t i = 0; i < b.n; i++)
            area2 += b.xy[2 * i] * b.xy[2 * b.next[i] + 1] - b.xy[2 * b.next[i]] * b.xy[2 * i + 1];
        assert_true(image_area(&w, &a) > .8 * area2 && image_area(&w, &a) <= 1.1 * area2);
        il_wrap_free(&w);
        outline_free(&a);
        outline_free(&b);
    }
}

/* A long outline: what is asked of each point is not to look at all. */
static void points_beside_the_outline_go_where_their_feet_go(void **state)
{
    (void)state;
    outline a = { 0 }, b = { 0 };
    outline_ellipse(&a, 0, 0, 30, 20, 100000);
    outline_ellipse(&b, 100, 0, 20, 30, 100000);
    il_wrap w = wrap(&a, &b);
    for (size_t i = 0; i < a.n; i++) {
        double p[2] = { a.xy[2 * i], a.xy[2 * i + 1] }, q[2] = { 1.001 * p[0], 1.001 * p[1] };
        il_wrap_apply(&w, p);
        il_wrap_apply(&w, q);
        assert_true(hypot(p[0] - q[0], p[1] - q[1]) < .1);
    }
    il_wrap_free(&w);
    outline_free(&a);
    outline_free(&b);
}

static void what_is_no_single_ring_is_told(void **state)
{
    (void)state;
    outline ring = { 0 }, two = { 0 }, line = { 0 }, point = { 0 };
    outline_ellipse(&ring, 0, 0, 5, 5, 20);
    outline_ellipse(&two, 0, 0, 5, 5, 20);
    outline_ellipse(&two, 0, 0, -3, 3, 20);
    outline_add(&line, 0, 0), outline_add(&line, 5, 0), outline_add(&line, 3, 0), outline_close(&line);
    outline_add(&point, 1, 1), outline_add(&point, 1, 1), outline_add(&point, 1, 1), outline_close(&point);
    const outline *bad[] = { &two, &line, &point };
    for (int k = 0; k < 3; k++) {
        il_wrap w;
        assert_false(try_wrap(&w, &ring, bad[k]));
        il_wrap_free(&w);
        assert_false(try_wrap(&w, bad[k], &ring));
        il_wrap_free(&w);
    }
    outline_free(&ring);
    outline_free(&two);
    outline_free(&line);
    outline_free(&point);
}

static void little_memory_is_told(void **state)
{
    (void)state;
    outline a = { 0 }, b = { 0 };
    outline_ellipse(&a, 0, 0, 5, 5, 20);
    outline_ellipse(&b, 9, 0, 5, 3, 20);
    il_piece p = piece_of(&a), q = piece_of(&b);
    long k = 0;
    for (il_status st = IL_E_NOMEM; st != IL_OK; k++) {
        il_wrap w;
        bool simple;
        il_alloc_test_fail_after(k);
        st = il_wrap_begin(&w, &p, &q, NULL, 0, &simple, NULL);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_E_NOMEM || (st == IL_OK && simple));
        il_wrap_free(&w);
        assert_true(k < 100);
    }
    assert_true(k > 4);
    il_piece_free(&p);
    il_piece_free(&q);
    outline_free(&a);
    outline_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(circles_go_round_circles_without_a_turn),
        cmocka_unit_test(where_outlines_begin_does_not_matter),
        cmocka_unit_test(images_lie_on_the_target_and_go_round_it),
        cmocka_unit_test(points_beside_the_outline_go_where_their_feet_go),
        cmocka_unit_test(what_is_no_single_ring_is_told),
        cmocka_unit_test(little_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
