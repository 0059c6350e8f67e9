/* t-dissect.c - what the pieces of a region must be, by closed forms and by what holds of all. */
#include "config.h"
#include "base/alloc.h"
#include "match/dissect.h"
#include "matching.h"

/* ---- what is cut ---- */

static outline square(double side)
{
    outline o = { 0 };
    outline_add(&o, 0, 0), outline_add(&o, side, 0), outline_add(&o, side, side), outline_add(&o, 0, side);
    outline_close(&o);
    return o;
}

/* A shape with arms and a hole. */
static outline star_with_hole(double x, double y)
{
    outline o = { 0 };
    outline_star(&o, x, y, 1, .3, 90);
    outline_ellipse(&o, x + 8, y - 3, -9, 6, 30);
    return o;
}

static double area_of(const double *xy, const uint32_t *next, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += (xy[2 * i] - xy[0]) * (xy[2 * next[i] + 1] - xy[1]) - (xy[2 * next[i]] - xy[0]) * (xy[2 * i + 1] - xy[1]);
    return sum / 2;
}

static double piece_area(const il_piece *p)
{
    return p->n > 0 ? area_of(p->xy, p->next, p->n) : 0;
}

static bool try_cut(il_dissection *d, const outline *o, const double *site, const double *share, size_t n)
{
    bool sound;
    assert_int_equal(il_dissection_begin(d, &o->o, site, share, n, &sound, NULL), IL_OK);
    return sound;
}

static il_dissection cut(const outline *o, const double *site, const double *share, size_t n)
{
    il_dissection d;
    assert_true(try_cut(&d, o, site, share, n));
    return d;
}

static il_piece piece(il_dissection *d, size_t i, double seam)
{
    il_piece p;
    assert_int_equal(il_dissection_piece(d, i, seam, &p, NULL), IL_OK);
    return p;
}

static il_piece cuts(il_dissection *d, size_t i)
{
    il_piece p;
    assert_int_equal(il_dissection_cuts(d, i, &p, NULL), IL_OK);
    return p;
}

/* ---- closed forms ---- */

/* The areas of the pieces are as SHARE to within what its points tell. */
static void assert_shares(il_dissection *d, const double *share, double whole)
{
    double sum = 0, all = 0;
    for (size_t i = 0; i < d->n; i++)
        all += share[i];
    for (size_t i = 0; i < d->n; i++) {
        il_piece p = piece(d, i, 0);
        assert_near(piece_area(&p), whole * share[i] / all, .02 * whole);
        sum += piece_area(&p);
        il_piece_free(&p);
    }
    assert_between(sum / whole, .99, 1); /* where three meet, triangles are cut thrice */
}

static void a_square_between_two_is_cut_straight_where_the_areas_say(void **state)
{
    (void)state;
    static const double site[][4] = { { 1, 4, 7, 4 }, { 4, -9, 4, 30 }, { 0, 0, 8, 8 }, { 5, 4.5, 3, 3.5 } };
    static const double share[][2] = { { 1, 3 }, { 1, 1 }, { 1, 1 }, { 2, 3 } };
    for (int k = 0; k < 4; k++) {
        outline o = square(8);
        il_dissection d = cut(&o, site[k], share[k], 2);
        assert_shares(&d, share[k], 64);
        il_piece line = cuts(&d, 0);
        double dx = site[k][2] - site[k][0], dy = site[k][3] - site[k][1], l = hypot(dx, dy);
        double wanted = 8 * share[k][0] / (share[k][0] + share[k][1]); /* along the axis that the centres are on */
        assert_true(line.n >= 2);
        for (size_t i = 0; i < line.n; i++) {
            const double *p = line.xy + 2 * i;
            assert_near(il_dissection_side(&d, 0, p, NULL), 0, 1e-9);
            assert_near(((p[0] - line.xy[0]) * dx + (p[1] - line.xy[1]) * dy) / l, 0, 1e-9); /* perpendicular */
            if (k < 2)
                assert_near(p[k], wanted, .02 * 8);
            if (k == 2)
                assert_near(p[0] + p[1], 8, .2);
        }
        il_piece_free(&line);
        il_dissection_free(&d);
        outline_free(&o);
    }
}

static void a_square_between_four_corners_is_quartered(void **state)
{
    (void)state;
    const double site[] = { 0, 0, 8, 0, 8, 8, 0, 8 }, share[] = { 5, 5, 5, 5 };
    outline o = square(8);
    il_dissection d = cut(&o, site, share, 4);
    assert_shares(&d, share, 64);
    for (size_t i = 0; i < 4; i++) {
        il_piece line = cuts(&d, i), p = piece(&d, i, 0);
        for (size_t k = 0; k < line.n; k++)
            assert_true(fmin(fabs(line.xy[2 * k] - 4), fabs(line.xy[2 * k + 1] - 4)) < .2);
        for (size_t k = 0; k < p.n; k++)
            for (size_t c = 0; c < 2; c++)
                assert_between(p.xy[2 * k + c], site[2 * i + c] == 0 ? 0 : 3.8, site[2 * i + c] == 0 ? 4.2 : 8);
        il_piece_free(&line);
        il_piece_free(&p);
    }
    il_dissection_free(&d);
    outline_free(&o);
}

static void unequal_shares_of_many_are_met(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (size_t n = 2; n <= 9; n++) {
        double site[18], share[9];
        for (size_t i = 0; i < n; i++) {
            site[2 * i] = random_between(&seed, -20, 60);
            site[2 * i + 1] = random_between(&seed, -20, 60);
            share[i] = random_between(&seed, .4, 1);
        }
        outline o = square(40);
        il_dissection d = cut(&o, site, share, n);
        assert_shares(&d, share, 1600);
        assert_near(il_dissection_breadth(&d) * d.frame.cell, 20, 1e-9);
        il_dissection_free(&d);
        outline_free(&o);
    }
}

/* In the middle of others, which are all behind it: its cut has no end. */
static void a_cell_may_lie_wholly_inside(void **state)
{
    (void)state;
    const double site[] = { 20, 20, 0, 0, 40, 0, 40, 40, 0, 40 }, share[] = { 1, 2, 2, 2, 2 };
    outline o = square(40);
    il_dissection d = cut(&o, site, share, 5);
    assert_shares(&d, share, 1600);
    il_piece line = cuts(&d, 0);
    assert_true(line.n > 3);
    for (size_t i = 0; i < line.n; i++)
        assert_true(line.next[i] < line.n);
    il_piece_free(&line);
    il_dissection_free(&d);
    outline_free(&o);
}

static void the_least_share_leaves_a_piece(void **state)
{
    (void)state;
    const double site[] = { 1, 4, 4, 4, 7, 4 }, share[] = { 1e-12, 1, 0 };
    outline o = square(8);
    il_dissection d = cut(&o, site, share, 3);
    for (size_t i = 0; i < 3; i++) {
        il_piece p = piece(&d, i, 0);
        assert_true(piece_area(&p) > .04 * 64);
        il_piece_free(&p);
    }
    il_dissection_free(&d);
    outline_free(&o);
}

/* ---- what holds of all ---- */

/* Is P inside of O or on it, but for rounding? */
static bool is_in(const outline *o, const double p[2], double near)
{
    bool in = false;
    for (size_t i = 0; i < o->n; i++) {
        const double *a = o->xy + 2 * i, *b = o->xy + 2 * o->next[i];
        double dx = b[0] - a[0], dy = b[1] - a[1], t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy);
        t = fmin(fmax(t, 0), 1);
        if (hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1]) <= near)
            return true;
        if ((a[1] > p[1]) != (b[1] > p[1]) && a[0] + dx * ((p[1] - a[1]) / dy) > p[0])
            in = !in;
    }
    return in;
}

/* Every point has one before it and one behind it. */
static void assert_closed(const il_piece *p)
{
    bool *seen = calloc(p->n + 1, sizeof *seen);
    assert_non_null(seen);
    for (size_t i = 0; i < p->n; i++) {
        assert_true(p->next[i] < p->n && !seen[p->next[i]]);
        seen[p->next[i]] = true;
    }
    free(seen);
}

/* Its own cell, less the seam, and the region: nothing else is in the piece, and cells have
 * nothing in common. */
static void assert_piece(il_dissection *d, const outline *o, size_t i, double seam)
{
    il_piece p = piece(d, i, seam);
    assert_closed(&p);
    for (size_t k = 0; k < p.n; k++) {
        /* exact where one cut is near; where two meet the side is taken as straight in a triangle */
        double side = il_dissection_side(d, i, p.xy + 2 * k, NULL);
        assert_true(side >= seam - 1e-6);
        assert_true(is_in(o, p.xy + 2 * k, 1e-9 * d->frame.cell * 256));
        double middle[2] = { (p.xy[2 * k] + p.xy[2 * p.next[k]]) / 2, (p.xy[2 * k + 1] + p.xy[2 * p.next[k] + 1]) / 2 };
        assert_true(is_in(o, middle, 1e-9 * d->frame.cell * 256));
    }
    assert_true(p.n == 0 || piece_area(&p) > 0);
    il_piece_free(&p);
}

static void pieces_are_closed_disjoint_and_in_the_region(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int round = 0; round < 40; round++) {
        outline o = round % 2 ? star_with_hole(5, 7) : square(50);
        size_t n = 2 + (size_t)(stack_random(&seed) % 4);
        double site[10], share[5], whole = area_of(o.xy, o.next, o.n), sum = 0;
        for (size_t i = 0; i < n; i++) {
            site[2 * i] = random_between(&seed, -60, 60);
            site[2 * i + 1] = random_between(&seed, -60, 60);
            share[i] = random_between(&seed, .3, 1);
        }
        il_dissection d = cut(&o, site, share, n);
        assert_shares(&d, share, whole);
        double seam = .2 * il_dissection_breadth(&d);
        for (size_t i = 0; i < n; i++) {
            assert_piece(&d, &o, i, 0);
            assert_piece(&d, &o, i, seam);
            il_piece p = piece(&d, i, seam);
            sum += piece_area(&p);
            il_piece_free(&p);
        }
        assert_true(sum < whole);
        il_dissection_free(&d);
        outline_free(&o);
    }
}

static void a_seam_is_as_wide_as_it_should_be(void **state)
{
    (void)state;
    const double site[] = { 1, 4, 7, 4 }, share[] = { 1, 1 };
    outline o = square(8);
    il_dissection d = cut(&o, site, share, 2);
    double seam = 3, greatest = 0, least = 8;
    il_piece a = piece(&d, 0, seam), b = piece(&d, 1, seam);
    for (size_t k = 0; k < a.n; k++)
        greatest = fmax(greatest, a.xy[2 * k]);
    for (size_t k = 0; k < b.n; k++)
        least = fmin(least, b.xy[2 * k]);
    assert_near(least - greatest, 2 * seam * d.frame.cell, 1e-9);
    il_piece_free(&a);
    il_piece_free(&b);
    a = piece(&d, 0, 1e4);
    assert_int_equal(a.n, 0); /* nothing is left */
    il_piece_free(&a);
    il_dissection_free(&d);
    outline_free(&o);
}

/* A line of points is on the cut and begins and ends on the outline, or where cuts meet. */
static void cuts_end_on_the_outline(void **state)
{
    (void)state;
    outline o = star_with_hole(0, 0);
    const double site[] = { -40, 1, 40, 2 }, share[] = { 2, 1 };
    il_dissection d = cut(&o, site, share, 2);
    il_piece line = cuts(&d, 0);
    bool *has_before = calloc(line.n, sizeof *has_before);
    assert_non_null(has_before);
    for (size_t k = 0; k < line.n; k++)
        if (line.next[k] != UINT32_MAX)
            has_before[line.next[k]] = true;
    for (size_t k = 0; k < line.n; k++)
        if (!has_before[k] || line.next[k] == UINT32_MAX) {
            double p[2] = { line.xy[2 * k], line.xy[2 * k + 1] };
            assert_true(has_before[k] || line.next[k] != UINT32_MAX);
            double off = INFINITY;
            for (size_t i = 0; i < o.n; i++) {
                const double *a = o.xy + 2 * i, *b = o.xy + 2 * o.next[i];
                double dx = b[0] - a[0], dy = b[1] - a[1];
                double t = fmin(fmax(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy), 0), 1);
                off = fmin(off, hypot(a[0] + t * dx - p[0], a[1] + t * dy - p[1]));
            }
            assert_near(off, 0, 1e-9);
        }
    free(has_before);
    il_piece_free(&line);
    line = cuts(&d, 1); /* all are the first one's */
    for (size_t k = 0; k < line.n; k++)
        assert_true(line.next[k] == UINT32_MAX);
    il_piece_free(&line);
    il_dissection_free(&d);
    outline_free(&o);
}

/* ---- moved, scaled, turned ---- */

static void transform(outline *o, double *site, size_t n, double scale, double dx, double dy)
{
    for (size_t k = 0; k < 2 * o->n; k++)
        o->xy[k] = scale * o->xy[k] + (k % 2 ? dy : dx);
    for (size_t k = 0; k < 2 * n; k++)
        site[k] = scale * site[k] + (k % 2 ? dy : dx);
}

static void scaling_by_a_power_of_two_scales_the_pieces(void **state)
{
    (void)state;
    static const int power[] = { -30, -1, 5 };
    for (int k = 0; k < 3; k++) {
        double site[] = { -40, 1, 40, 2, 3, 50 }, again[6], share[] = { 2, 1, 3 }, scale = ldexp(1, power[k]);
        memcpy(again, site, sizeof site);
        outline o = star_with_hole(0, 0), p = star_with_hole(0, 0);
        transform(&p, again, 3, scale, 0, 0);
        il_dissection d = cut(&o, site, share, 3), e = cut(&p, again, share, 3);
        for (size_t i = 0; i < 3; i++) {
            il_piece a = piece(&d, i, 2), b = piece(&e, i, 2);
            assert_int_equal(a.n, b.n);
            assert_memory_equal(a.next, b.next, a.n * sizeof *a.next);
            for (size_t v = 0; v < 2 * a.n; v++)
                assert_true(scale * a.xy[v] == b.xy[v]);
            il_piece_free(&a);
            il_piece_free(&b);
        }
        il_dissection_free(&d);
        il_dissection_free(&e);
        outline_free(&o);
        outline_free(&p);
    }
}

/* Exact on a grid: vertices that are multiples of 1/1024. */
static void moving_exactly_moves_the_pieces(void **state)
{
    (void)state;
    double site[] = { -40, 1, 40, 2 }, again[4], share[] = { 2, 1 };
    memcpy(again, site, sizeof site);
    outline o = star_with_hole(0, 0), p = { 0 };
    for (size_t k = 0; k < 2 * o.n; k++)
        o.xy[k] = rint(1024 * o.xy[k]) / 1024;
    for (size_t k = 0; k < 120; k++) {
        outline_add(&p, o.xy[2 * k], o.xy[2 * k + 1]);
        if (o.next[k] != k + 1)
            outline_close(&p);
    }
    transform(&p, again, 2, 1, 4096, -65536);
    il_dissection d = cut(&o, site, share, 2), e = cut(&p, again, share, 2);
    il_piece a = piece(&d, 0, 2), b = piece(&e, 0, 2);
    assert_int_equal(a.n, b.n);
    for (size_t v = 0; v < 2 * a.n; v++)
        assert_near(b.xy[v] - (v % 2 ? -65536 : 4096), a.xy[v], 1e-9);
    il_piece_free(&a);
    il_piece_free(&b);
    il_dissection_free(&d);
    il_dissection_free(&e);
    outline_free(&o);
    outline_free(&p);
}

/* A quarter turn about the origin; the grid is another. */
static void a_turned_region_is_cut_alike(void **state)
{
    (void)state;
    double site[] = { -40, 1, 40, 2, 3, 50 }, again[6], share[] = { 2, 1, 3 };
    outline o = star_with_hole(0, 0), p = star_with_hole(0, 0);
    for (size_t k = 0; k < o.n; k++)
        p.xy[2 * k] = -o.xy[2 * k + 1], p.xy[2 * k + 1] = o.xy[2 * k];
    for (size_t k = 0; k < 3; k++)
        again[2 * k] = -site[2 * k + 1], again[2 * k + 1] = site[2 * k];
    il_dissection d = cut(&o, site, share, 3), e = cut(&p, again, share, 3);
    uint64_t seed = 5;
    for (int k = 0; k < 500; k++) {
        double q[2] = { random_between(&seed, -70, 70), random_between(&seed, -70, 70) }, r[2] = { -q[1], q[0] };
        for (size_t i = 0; i < 3; i++)
            assert_near(il_dissection_side(&d, i, q, NULL), il_dissection_side(&e, i, r, NULL), 1.5);
    }
    il_dissection_free(&d);
    il_dissection_free(&e);
    outline_free(&o);
    outline_free(&p);
}

/* ---- what cannot be cut ---- */

static bool can_cut(const outline *o, const double *site, size_t n)
{
    const double share[] = { 1, 1, 1 };
    il_dissection d;
    bool sound = try_cut(&d, o, site, share, n);
    il_dissection_free(&d);
    return sound;
}

static void what_cannot_be_cut_is_told(void **state)
{
    (void)state;
    const double apart[] = { 0, 1, 9, 2, 4, 7 }, same[] = { 0, 1, 9, 2, 9, 2 };
    outline o = square(8);
    assert_true(can_cut(&o, apart, 3) && !can_cut(&o, same, 3));
    outline_add(&o, 8, 8), outline_add(&o, 4, 6), outline_add(&o, 6, 4); /* a hole that touches a corner */
    outline_close(&o);
    assert_false(can_cut(&o, apart, 3));
    outline_free(&o);
    outline_add(&o, 0, 0), outline_add(&o, 8, 8), outline_add(&o, 8, 0), outline_add(&o, 0, 9); /* crosses itself */
    outline_close(&o);
    assert_false(can_cut(&o, apart, 3));
    outline_free(&o);
    outline_add(&o, 0, 0), outline_add(&o, 8, 0), outline_add(&o, 4, 0); /* no area */
    outline_close(&o);
    assert_false(can_cut(&o, apart, 3));
    outline_free(&o);
}

/* A ring so thin that points as near as it is thin would be billions. */
static void what_is_thin_is_cut_like_the_rest(void **state)
{
    (void)state;
    static const double width[] = { 1, 1e-3, 1e-8 };
    for (int k = 0; k < 3; k++) {
        const double site[] = { -50, 0, 50, 0 }, share[] = { 1, 1 };
        outline o = { 0 };
        outline_ellipse(&o, 0, 0, 50, 50, 64);
        outline_ellipse(&o, 0, 0, -50 + width[k], 50 - width[k], 64);
        il_dissection d;
        if (try_cut(&d, &o, site, share, 2)) {
            assert_true(d.n_points < 100 * 1000);
            assert_shares(&d, share, area_of(o.xy, o.next, o.n));
        }
        il_dissection_free(&d);
        outline_free(&o);
    }
}

static void little_memory_is_told(void **state)
{
    (void)state;
    const double site[] = { -40, 1, 40, 2, 3, 50 }, share[] = { 2, 1, 3 };
    outline o = star_with_hole(0, 0);
    long k = 0;
    for (il_status st = IL_E_NOMEM; st != IL_OK; k++) {
        il_dissection d;
        il_piece p = { 0 }, line = { 0 };
        bool sound;
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        st = il_dissection_begin(&d, &o.o, site, share, 3, &sound, &err);
        if (st == IL_OK)
            st = il_dissection_piece(&d, 1, 2, &p, &err);
        if (st == IL_OK)
            st = il_dissection_cuts(&d, 1, &line, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM));
        assert_true(st != IL_OK || sound);
        il_piece_free(&p);
        il_piece_free(&line);
        il_dissection_free(&d);
        assert_true(k < 10000);
    }
    assert_true(k > 10);
    outline_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_between_two_is_cut_straight_where_the_areas_say),
        cmocka_unit_test(a_square_between_four_corners_is_quartered),
        cmocka_unit_test(unequal_shares_of_many_are_met),
        cmocka_unit_test(a_cell_may_lie_wholly_inside),
        cmocka_unit_test(the_least_share_leaves_a_piece),
        cmocka_unit_test(pieces_are_closed_disjoint_and_in_the_region),
        cmocka_unit_test(a_seam_is_as_wide_as_it_should_be),
        cmocka_unit_test(cuts_end_on_the_outline),
        cmocka_unit_test(scaling_by_a_power_of_two_scales_the_pieces),
        cmocka_unit_test(moving_exactly_moves_the_pieces),
        cmocka_unit_test(a_turned_region_is_cut_alike),
        cmocka_unit_test(what_cannot_be_cut_is_told),
        cmocka_unit_test(what_is_thin_is_cut_like_the_rest),
        cmocka_unit_test(little_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
