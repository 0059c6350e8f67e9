/* t-partner.c - contours as samples, and the nearest sample that faces the same way. */
#include "config.h"
#include "base/alloc.h"
#include "base/simd.h"
#include "match/partner.h"
#include "matching.h"

static il_samples taken(const outline *o, double spacing)
{
    il_samples s = IL_SAMPLES_INIT;
    assert_int_equal(il_samples_take(&s, &o->o, spacing, NULL), IL_OK);
    return s;
}

/* ---- samples ---- */

/* Samples FIRST .. END make one ring, each the neighbour of the next. */
static void assert_one_ring(const il_samples *s, size_t first, size_t end)
{
    for (size_t k = first; k < end; k++) {
        assert_int_equal(s->after[k], k + 1 < end ? k + 1 : first);
        assert_int_equal(s->before[k], k > first ? k - 1 : end - 1);
    }
}

static void assert_padded(const il_samples *s)
{
    for (size_t k = s->n; k < s->n + IL_LANES; k++)
        assert_true(s->x[k] > 1e5f && s->y[k] > 1e5f && s->nx[k] == 0 && s->ny[k] == 0);
}

static double distance_to_outline(const outline *o, double x, double y)
{
    double least = INFINITY;
    for (size_t i = 0; i < o->n; i++) {
        const double *a = o->xy + 2 * i, *b = o->xy + 2 * o->next[i];
        double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
        double t = l2 > 0 ? fmin(fmax(((x - a[0]) * dx + (y - a[1]) * dy) / l2, 0), 1) : 0;
        least = fmin(least, hypot(a[0] + t * dx - x, a[1] + t * dy - y));
    }
    return least;
}

static void samples_lie_on_their_rings_at_even_spacing(void **state)
{
    (void)state;
    outline o = { 0 };
    outline_ellipse(&o, 100, 100, 50, 50, 720);
    outline_ellipse(&o, 100, 100, -20, 20, 500);
    outline_star(&o, 200, 60, .5, .3, 90);
    static const double spacing[] = { .75, 1.5, 6.3 }, length[] = { 100 * 3.14159, 40 * 3.14159 };
    for (size_t i = 0; i < sizeof spacing / sizeof *spacing; i++) {
        il_samples s = taken(&o, spacing[i]);
        size_t first = 0;
        for (int ring = 0; ring < 3; ring++) {
            size_t end = (size_t)s.before[first] + 1, v = ring == 0 ? 0 : ring == 1 ? 720 : 1220;
            assert_one_ring(&s, first, end);
            assert_true(s.x[first] == (float)o.xy[2 * v] && s.y[first] == (float)o.xy[2 * v + 1]);
            for (size_t k = first; k < end; k++) {
                double step = hypot(s.x[s.after[k]] - (double)s.x[k], s.y[s.after[k]] - (double)s.y[k]);
                assert_true(distance_to_outline(&o, s.x[k], s.y[k]) < 2e-5);
                assert_true(step < spacing[i] + 1e-4);
                if (ring < 2) /* chords of a circle are alike */
                    assert_near(step, length[ring] / (double)(end - first), .01 * spacing[i]);
            }
            first = end;
        }
        assert_int_equal(first, s.n);
        assert_padded(&s);
        il_samples_free(&s);
    }
    outline_free(&o);
}

static void normals_are_unit_and_point_out_of_the_region(void **state)
{
    (void)state;
    outline o = { 0 };
    outline_ellipse(&o, 100, 100, 50, 50, 720);
    outline_ellipse(&o, 100, 100, -20, 20, 500);
    il_samples s = taken(&o, 1.5);
    for (size_t k = 0; k < s.n; k++) {
        double x = s.x[k] - 100., y = s.y[k] - 100., r = hypot(x, y), way = r > 35 ? 1 : -1;
        assert_near(s.nx[k], way * x / r, .01);
        assert_near(s.ny[k], way * y / r, .01);
        assert_near(hypot(s.nx[k], s.ny[k]), 1, 1e-6);
    }
    il_samples_free(&s);
    outline_free(&o);
}

/* Rings that are small, flat, or nothing but a point. */
static void every_ring_has_its_least_samples(void **state)
{
    (void)state;
    outline o = { 0 };
    outline_ellipse(&o, 10, 10, .001, .001, 3);
    outline_ellipse(&o, 20, 20, 0, 0, 4);
    outline_add(&o, 30, 30);
    outline_close(&o);
    outline_add(&o, 40, 40);
    outline_add(&o, 41, 40);
    outline_close(&o);
    il_samples s = taken(&o, 1.5);
    assert_int_equal(s.n, 4 * IL_SAMPLES_LEAST);
    for (size_t k = 0; k < s.n; k++) {
        assert_true(isfinite(s.x[k]) && isfinite(s.y[k]) && isfinite(s.nx[k]) && isfinite(s.ny[k]));
        assert_true(distance_to_outline(&o, s.x[k], s.y[k]) < 1e-5);
        assert_int_equal(s.after[k] / IL_SAMPLES_LEAST, k / IL_SAMPLES_LEAST);
    }
    assert_padded(&s);
    il_samples_free(&s);
    outline_free(&o);
}

static void thinned_samples_are_some_of_the_others_in_order(void **state)
{
    (void)state;
    outline o = { 0 };
    outline_star(&o, 100, 100, 1, 0, 50);
    outline_ellipse(&o, 100, 100, -6, 6, 30);
    il_samples s = taken(&o, 1.5), few = IL_SAMPLES_INIT;
    uint32_t *at = NULL;
    size_t cap = 0;
    for (uint32_t stride = 1; stride <= 64; stride *= 2) {
        assert_int_equal(il_samples_thin(&few, &at, &cap, &s, stride, NULL), IL_OK);
        size_t end = (size_t)few.before[0] + 1, ring = (size_t)s.before[0] + 1;
        assert_one_ring(&few, 0, end);
        assert_one_ring(&few, end, few.n);
        assert_true(end == IL_SAMPLES_LEAST || end == (ring + stride - 1) / stride);
        assert_true(end >= IL_SAMPLES_LEAST && few.n - end >= IL_SAMPLES_LEAST);
        assert_true(at[0] == 0 && at[end] == ring);
        for (size_t k = 0; k < few.n; k++) {
            assert_true(k == 0 || at[k] > at[k - 1]);
            assert_true((k < end) == (at[k] < ring));
            assert_true(few.x[k] == s.x[at[k]] && few.y[k] == s.y[at[k]]);
            s.x[at[k]] += 3;
        }
        il_samples_follow(&few, at, &s);
        for (size_t k = 0; k < few.n; k++)
            assert_true(few.x[k] == s.x[at[k]] && few.y[k] == s.y[at[k]]);
        assert_padded(&few);
    }
    il_samples_free(&s);
    il_samples_free(&few);
    il_free(at);
    outline_free(&o);
}

static void samples_keep_their_memory(void **state)
{
    (void)state;
    outline big = { 0 }, small = { 0 };
    outline_star(&big, 100, 100, 1, 0, 50);
    outline_ellipse(&small, 100, 100, 6, 6, 30);
    il_samples s = taken(&big, 1.5);
    const float *x = s.x;
    assert_int_equal(il_samples_take(&s, &small.o, 1.5, NULL), IL_OK);
    assert_ptr_equal(s.x, x);
    il_samples fresh = taken(&small, 1.5);
    assert_int_equal(s.n, fresh.n);
    assert_memory_equal(s.x, fresh.x, s.n * sizeof *s.x);
    assert_padded(&s);
    il_samples_free(&s);
    il_samples_free(&s); /* safe twice */
    il_samples_free(&fresh);
    outline_free(&big);
    outline_free(&small);
}

/* ---- partners ---- */

static bool agree(const il_samples *m, size_t p, const il_samples *t, size_t q)
{
    return m->nx[p] * t->nx[q] + m->ny[p] * t->ny[q] > IL_NORMALS_AGREE;
}

static float distance2(const il_samples *m, size_t p, const il_samples *t, size_t q)
{
    float dx = m->x[p] - t->x[q], dy = m->y[p] - t->y[q];
    return dx * dx + dy * dy;
}

/* By the header's words: the nearest that agrees, the first of several. */
static uint32_t partner_of(const il_samples *m, const il_samples *t, size_t q)
{
    uint32_t found = IL_NO_PARTNER;
    for (size_t p = 0; p < m->n; p++)
        if (agree(m, p, t, q) && (found == IL_NO_PARTNER || distance2(m, p, t, q) < distance2(m, found, t, q)))
            found = (uint32_t)p;
    return found;
}

static void assert_partners(const il_samples *m, const il_samples *t, const uint32_t *partner)
{
    for (size_t q = 0; q < t->n; q++)
        if (partner[q] != partner_of(m, t, q))
            fail_msg("target %zu has partner %u, not %u", q, (unsigned)partner[q], (unsigned)partner_of(m, t, q));
}

static outline random_rings(uint64_t *seed)
{
    outline o = { 0 };
    for (uint64_t rings = 1 + stack_random(seed) % 3; rings > 0; rings--) {
        double x = random_between(seed, 80, 170), y = random_between(seed, 80, 170), way = stack_random(seed) % 3 ? 1 : -1;
        outline_ellipse(&o, x, y, way * random_between(seed, 2, 60), random_between(seed, 2, 60), 5 + (int)(stack_random(seed) % 60));
    }
    return o;
}

static void partners_are_the_nearest_that_agree(void **state)
{
    (void)state;
    uint64_t seed = 1;
    static uint32_t partner[2000];
    for (int round = 0; round < 60; round++) {
        outline a = random_rings(&seed), b = random_rings(&seed);
        il_samples m = taken(&a, 1.5), t = taken(&b, 2.3);
        assert_true(t.n <= 2000);
        il_partners_find(&m, &t, true, partner);
        assert_partners(&m, &t, partner);
        il_samples_free(&m);
        il_samples_free(&t);
        outline_free(&a);
        outline_free(&b);
    }
}

/* Long contours are not searched sample by sample. */
static void long_contours_have_the_same_partners(void **state)
{
    (void)state;
    static uint32_t partner[9000];
    uint64_t seed = 7;
    for (int shape = 0; shape < 3; shape++) {
        outline a = { 0 }, b = { 0 };
        for (int k = 0; k < 30; k++) { /* teeth, rings, or anything */
            double x = 8 * k + 5;
            if (shape == 0) {
                outline_add(&a, x, 30);
                outline_add(&a, x + 4, 220);
                outline_add(&b, 30, x);
                outline_add(&b, 220, x + 4);
            } else if (shape == 1) {
                outline_ellipse(&a, x, 40 + 30 * (k % 7), 40, 30, 50);
                outline_ellipse(&b, x, 50 + 30 * (k % 6), k % 2 ? -30 : 30, 40, 50);
            } else {
                outline_add(&a, random_between(&seed, 0, 256), random_between(&seed, 0, 256));
                outline_add(&b, random_between(&seed, 0, 256), random_between(&seed, 0, 256));
            }
        }
        if (shape != 1) {
            outline_close(&a);
            outline_close(&b);
        }
        il_samples m = taken(&a, 1), t = taken(&b, 2);
        assert_true(m.n > 2500 && t.n <= 9000);
        for (size_t k = 0; shape == 2 && k < m.n; k++) /* ties */
            m.x[k] = floorf(m.x[k] / 8), m.y[k] = floorf(m.y[k] / 8);
        il_partners_find(&m, &t, true, partner);
        assert_partners(&m, &t, partner);
        il_samples_free(&m);
        il_samples_free(&t);
        outline_free(&a);
        outline_free(&b);
    }
}

/* On few grid points with few normals: equal distances everywhere. */
static void of_equal_distances_the_first_counts(void **state)
{
    (void)state;
    uint64_t seed = 2;
    static uint32_t partner[200];
    for (int round = 0; round < 200; round++) {
        outline a = { 0 }, b = { 0 };
        outline_ellipse(&a, 50, 50, 30, 30, 100);
        outline_ellipse(&b, 50, 50, 20, 20, 100);
        il_samples m = taken(&a, 1.5 + stack_uniform(&seed)), t = taken(&b, 3);
        il_samples *both[2] = { &m, &t };
        for (int s = 0; s < 2; s++)
            for (size_t k = 0; k < both[s]->n; k++) {
                static const float way[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
                uint64_t w = stack_random(&seed) % 4;
                both[s]->x[k] = (float)(stack_random(&seed) % 4);
                both[s]->y[k] = (float)(stack_random(&seed) % 4);
                both[s]->nx[k] = way[w][0];
                both[s]->ny[k] = way[w][1];
            }
        il_partners_find(&m, &t, true, partner);
        assert_partners(&m, &t, partner);
        il_samples_free(&m);
        il_samples_free(&t);
        outline_free(&a);
        outline_free(&b);
    }
}

static void who_faces_nobody_has_no_partner(void **state)
{
    (void)state;
    outline a = { 0 }, b = { 0 };
    outline_ellipse(&a, 50, 50, 30, 30, 100);
    outline_ellipse(&b, 50, 50, 1, 1, 3);
    il_samples m = taken(&a, 1.5), t = taken(&b, 1.5);
    uint32_t partner[IL_SAMPLES_LEAST];
    assert_int_equal(t.n, IL_SAMPLES_LEAST);
    for (size_t k = 0; k < m.n; k++)
        m.nx[k] = 1, m.ny[k] = 0;
    for (size_t q = 0; q < t.n; q++)
        t.nx[q] = q % 2 ? -1 : q % 4 ? 0 : 1, t.ny[q] = q % 2 || q % 4 == 0 ? 0 : 1;
    il_partners_find(&m, &t, true, partner);
    for (size_t q = 0; q < t.n; q++)
        assert_true((partner[q] == IL_NO_PARTNER) == (q % 4 != 0));
    /* and is looked for among all the next time */
    for (size_t q = 0; q < t.n; q++)
        t.nx[q] = 1, t.ny[q] = 0;
    for (size_t q = 0; q < t.n; q++)
        partner[q] = IL_NO_PARTNER;
    il_partners_find(&m, &t, false, partner);
    assert_partners(&m, &t, partner);
    il_samples_free(&m);
    il_samples_free(&t);
    outline_free(&a);
    outline_free(&b);
}

/* After a small move the search about the old partner finds what the whole one does,
 * but near the ring's seam, where the numbers jump. */
static void a_small_move_is_followed_from_the_partner_before(void **state)
{
    (void)state;
    static uint32_t partner[2000];
    outline a = { 0 }, b = { 0 };
    outline_ellipse(&a, 128, 128, 60, 50, 300);
    outline_ellipse(&b, 130, 127, 55, 55, 300);
    il_samples m = taken(&a, 1.5), t = taken(&b, 1.5);
    il_partners_find(&m, &t, true, partner);
    for (size_t k = 0; k < m.n; k++)
        m.x[k] += 1.2f, m.y[k] -= .9f;
    il_partners_find(&m, &t, false, partner);
    for (size_t q = 0; q < t.n; q++) {
        uint32_t p = partner_of(&m, &t, q);
        assert_true(partner[q] < m.n && agree(&m, partner[q], &t, q));
        assert_true(partner[q] == p || p < 12 || p + 12 > m.n);
    }
    il_samples_free(&m);
    il_samples_free(&t);
    outline_free(&a);
    outline_free(&b);
}

/* From the polyline through all samples, by brute force. */
static double distance_to_samples(const il_samples *m, double x, double y)
{
    double least = INFINITY;
    for (size_t k = 0; k < m->n; k++) {
        double ax = m->x[k], ay = m->y[k], dx = m->x[m->after[k]] - ax, dy = m->y[m->after[k]] - ay, l2 = dx * dx + dy * dy;
        double t = l2 > 0 ? fmin(fmax(((x - ax) * dx + (y - ay) * dy) / l2, 0), 1) : 0;
        least = fmin(least, hypot(ax + t * dx - x, ay + t * dy - y));
    }
    return least;
}

static void distances_are_to_the_polyline(void **state)
{
    (void)state;
    uint64_t seed = 3;
    static uint32_t partner[2000];
    for (int round = 0; round < 20; round++) {
        outline a = random_rings(&seed), b = random_rings(&seed);
        il_samples m = taken(&a, 1.5), t = taken(&b, 2.3);
        il_partners_find(&m, &t, true, partner);
        for (uint32_t q = 0; q < t.n; q++) {
            double least = distance_to_samples(&m, t.x[q], t.y[q]);
            assert_near(il_partner_distance(&m, IL_NO_PARTNER, &t, q), least, 2e-5);
            if (partner[q] != IL_NO_PARTNER) /* never less; and no more than to the partner itself */
                assert_between(il_partner_distance(&m, partner[q], &t, q), least, sqrt((double)distance2(&m, partner[q], &t, q)));
        }
        il_samples_free(&m);
        il_samples_free(&t);
        outline_free(&a);
        outline_free(&b);
    }
}

/* A contour on itself, every sample with itself as partner, the seam too. */
static void a_contour_is_no_distance_from_itself(void **state)
{
    (void)state;
    outline a = { 0 };
    outline_star(&a, 128, 128, 1, 0, 100);
    outline_ellipse(&a, 128, 128, -9, 9, 20);
    il_samples m = taken(&a, 1.5), t = taken(&a, 1.1);
    static uint32_t partner[2000];
    il_partners_find(&m, &m, true, partner);
    for (uint32_t q = 0; q < m.n; q++) {
        assert_int_equal(partner[q], q);
        assert_true(il_partner_distance(&m, q, &m, q) == 0);
    }
    il_partners_find(&m, &t, true, partner); /* between samples, on chords */
    for (uint32_t q = 0; q < t.n; q++)
        assert_true(il_partner_distance(&m, partner[q], &t, q) < .5f);
    il_samples_free(&m);
    il_samples_free(&t);
    outline_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_lie_on_their_rings_at_even_spacing),
        cmocka_unit_test(normals_are_unit_and_point_out_of_the_region),
        cmocka_unit_test(every_ring_has_its_least_samples),
        cmocka_unit_test(thinned_samples_are_some_of_the_others_in_order),
        cmocka_unit_test(samples_keep_their_memory),
        cmocka_unit_test(partners_are_the_nearest_that_agree),
        cmocka_unit_test(long_contours_have_the_same_partners),
        cmocka_unit_test(of_equal_distances_the_first_counts),
        cmocka_unit_test(who_faces_nobody_has_no_partner),
        cmocka_unit_test(a_small_move_is_followed_from_the_partner_before),
        cmocka_unit_test(distances_are_to_the_polyline),
        cmocka_unit_test(a_contour_is_no_distance_from_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
