#include "config.h"
#include "contours.h"
#include "pairs.h"

enum { SEEDS = 200 };

static uint32_t seeds_of(int family)
{
    return family == PAIRS_NAMED ? PAIRS_N_NAMED : SEEDS;
}

typedef void look(const pairs_pair *p, const char *which);

/* Show LOOK every pair that the benchmarks take. */
static void at_all_pairs(look *l)
{
    for (int f = 0; f < PAIRS_N_FAMILIES; f++)
        for (uint32_t seed = 0; seed < seeds_of(f); seed++) {
            char which[80];
            pairs_pair p;
            pairs_make((pairs_family)f, seed, &p);
            snprintf(which, sizeof which, "%s %u", pairs_family_word((pairs_family)f), (unsigned)seed);
            l(&p, which);
        }
}

static void edge_of(const pairs_outline *o, size_t i, double e[4])
{
    memcpy(e, o->xy + 2 * i, 2 * sizeof *e);
    memcpy(e + 2, o->xy + 2 * o->next[i], 2 * sizeof *e);
}

/* Do the boxes round two edges meet?  Most do not, and the exact question is dear. */
static bool boxes_meet(const double *e, const double *f)
{
    for (int c = 0; c < 2; c++)
        if (fmax(e[c], e[2 + c]) < fmin(f[c], f[2 + c]) || fmax(f[c], f[2 + c]) < fmin(e[c], e[2 + c]))
            return false;
    return true;
}

/* Edges meet in the ends that they share, and no vertex is there twice. */
static void assert_simple(const pairs_outline *o, const char *which)
{
    for (size_t i = 0; i < o->n; i++)
        for (size_t j = 0; j < i; j++) {
            double e[4], f[4];
            edge_of(o, i, e);
            edge_of(o, j, f);
            if (boxes_meet(e, f) && (edges_meet(e, f) || same_place(e, f)))
                fail_msg("%s: edges %zu and %zu meet", which, j, i);
        }
}

static void look_simple(const pairs_pair *p, const char *which)
{
    assert_simple(&p->lower, which);
    assert_simple(&p->upper, which);
}

static void outlines_are_simple(void **state)
{
    (void)state;
    at_all_pairs(look_simple);
}

/* Each ring comes back to where it began, once round its own vertices and
 * counter-clockwise. */
static void assert_rings(const pairs_outline *o, const char *which)
{
    assert_in_range(o->n_rings, 1, 2);
    assert_int_equal(o->first[0], 0);
    assert_int_equal(o->first[o->n_rings], o->n);
    for (size_t k = 0; k < o->n_rings; k++) {
        uint32_t i = (uint32_t)o->first[k];
        double area2 = 0;
        for (size_t left = o->first[k + 1] - o->first[k]; left > 0; left--) {
            const double *a = o->xy + 2 * i, *b = o->xy + 2 * o->next[i];
            area2 += a[0] * b[1] - b[0] * a[1];
            i = o->next[i];
        }
        assert_int_equal(i, o->first[k]);
        if (!(area2 > 2 * 1000))
            fail_msg("%s: ring %zu has area %g", which, k, area2 / 2);
    }
}

static void look_rings(const pairs_pair *p, const char *which)
{
    assert_rings(&p->lower, which);
    assert_rings(&p->upper, which);
    if (p->has_truth)
        assert_int_equal(p->lower.n, p->upper.n);
}

static void rings_are_closed_and_counter_clockwise(void **state)
{
    (void)state;
    at_all_pairs(look_rings);
}

static void look_size(const pairs_pair *p, const char *which)
{
    for (size_t i = 0; i < 2 * p->upper.n; i++)
        if (!(p->upper.xy[i] > 0 && p->upper.xy[i] < PAIRS_FRAME))
            fail_msg("%s: %g", which, p->upper.xy[i]);
    for (size_t i = 0; i < 2 * p->lower.n; i++)
        if (!(fabs(p->lower.xy[i] - PAIRS_FRAME / 2) < PAIRS_FRAME * .75))
            fail_msg("%s: %g", which, p->lower.xy[i]);
}

static void upper_outlines_lie_in_the_frame_and_lower_ones_near(void **state)
{
    (void)state;
    at_all_pairs(look_size);
}

static void a_seed_makes_the_same_pair_again_and_another_another(void **state)
{
    (void)state;
    for (int f = 0; f < PAIRS_N_FAMILIES; f++)
        for (uint32_t seed = 0; seed < PAIRS_N_NAMED; seed++) {
            pairs_pair p, q;
            pairs_make((pairs_family)f, seed, &p);
            pairs_make((pairs_family)f, seed, &q);
            assert_memory_equal(&p.lower, &q.lower, sizeof p.lower);
            assert_memory_equal(&p.upper, &q.upper, sizeof p.upper);
            pairs_make((pairs_family)f, (seed + 1) % PAIRS_N_NAMED, &q);
            assert_memory_not_equal(&p, &q, sizeof p);
        }
}

/* Figures measured on these pairs are comparable only while the pairs stay what they are. */
static void pairs_stay_what_they_are(void **state)
{
    (void)state;
    static const struct known {
        pairs_family family;
        uint32_t seed;
        size_t n;
        double last[2]; /* vertex n - 1 of the lower outline */
    } known[] = {
        { PAIRS_SLICE_LIKE, 0, 256, { 185.233282, 128.195709 } },
        { PAIRS_DIFFERENT, 7, 256, { 196.982423, 132.478625 } },
        { PAIRS_WILD, 199, 256, { 192.364552, 123.232963 } },
        { PAIRS_MOVED, 42, 256, { 232.173626, 94.9927704 } },
        { PAIRS_NAMED, 3, 240, { 52.8102831, 91.8533923 } },
        { PAIRS_NAMED, 5, 252, { 51.7692989, 125.051153 } },
        { PAIRS_NAMED, 6, 462, { 57.836474, 215.022297 } },
        { PAIRS_NAMED, 9, 263, { 161.4, 137.9 } },
    };
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        pairs_pair p;
        pairs_make(known[k].family, known[k].seed, &p);
        assert_int_equal(p.lower.n, known[k].n);
        for (size_t c = 0; c < 2; c++)
            assert_true(fabs(p.lower.xy[2 * p.lower.n - 2 + c] - known[k].last[c]) < 1e-6);
    }
}

/* Of a pair whose lower outline is the upper one turned, or scaled and shifted,
 * truth must be that very motion. */
static void truth_is_the_motion_that_made_the_pair(void **state)
{
    (void)state;
    pairs_pair star, kidney;
    pairs_make(PAIRS_NAMED, 1, &star);
    pairs_make(PAIRS_NAMED, 4, &kidney);
    assert_true(star.has_truth && kidney.has_truth);
    double c = cos(acos(-1) / 9), s = sin(acos(-1) / 9);
    for (size_t i = 0; i < star.upper.n; i++) {
        const double *l = star.lower.xy + 2 * i, *u = star.upper.xy + 2 * i;
        double x = u[0] - 128, y = u[1] - 128;
        assert_true(hypot(128 + c * x - s * y - l[0], 128 + s * x + c * y - l[1]) < 1e-9);
    }
    for (size_t i = 0; i < kidney.upper.n; i++) {
        const double *l = kidney.lower.xy + 2 * i, *u = kidney.upper.xy + 2 * i;
        assert_true(hypot(105 + 1.3 * (u[0] - 105) + 36 - l[0], 105 + 1.3 * (u[1] - 105) + 20 - l[1]) < 1e-9);
    }
}

static void where_topology_differs_there_is_no_truth(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < PAIRS_N_NAMED; seed++) {
        pairs_pair p;
        pairs_make(PAIRS_NAMED, seed, &p);
        if (p.lower.n_rings != p.upper.n_rings)
            assert_false(p.has_truth);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outlines_are_simple),
        cmocka_unit_test(rings_are_closed_and_counter_clockwise),
        cmocka_unit_test(upper_outlines_lie_in_the_frame_and_lower_ones_near),
        cmocka_unit_test(a_seed_makes_the_same_pair_again_and_another_another),
        cmocka_unit_test(pairs_stay_what_they_are),
        cmocka_unit_test(truth_is_the_motion_that_made_the_pair),
        cmocka_unit_test(where_topology_differs_there_is_no_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
