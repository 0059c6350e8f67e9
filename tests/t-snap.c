#include "config.h"
#include "base/alloc.h"
#include "contours.h"
#include "loft/snap.h"
#include "region/clean.h"

__extension__ typedef __int128 wide;

/* ---- two slices in the reference plane ---- */

typedef struct scene {
    il_section section[2];
    il_reference r;
} scene;

/* Of clean copies of LOWER and UPPER, which it frees. */
static scene *scene_of(il_slice *lower, il_slice *upper)
{
    scene *s = calloc(1, sizeof *s);
    il_slice *slice[2] = { lower, upper };
    il_clean_options o = { .round_float = false };
    for (int k = 0; k < 2; k++) {
        assert_int_equal(il_slice_clean(slice[k], &o, NULL, NULL, NULL), IL_OK);
        slice[k]->z = k;
        assert_int_equal(il_section_from_slice(&s->section[k], slice[k], NULL), IL_OK);
        il_slice_free(slice[k]);
    }
    assert_int_equal(il_reference_build(&s->r, &s->section[0], &s->section[1], NULL), IL_OK);
    return s;
}

static void scene_free(scene *s)
{
    il_reference_free(&s->r);
    il_section_free(&s->section[0]);
    il_section_free(&s->section[1]);
    free(s);
}

static scene *scene_from(const char *lower, const char *upper)
{
    il_slice l = slice_of(lower), u = slice_of(upper);
    return scene_of(&l, &u);
}

/* ---- what must hold, by brute force in whole numbers ---- */

typedef struct segment { uint32_t a, b; int side; } segment;

static uint32_t first_of_next(const il_snapped *s, const il_reference *r, int side, size_t i)
{
    return s->point[side][s->run[side][r->side[side].next[i]]];
}

/* The pieces of all edges; *N of them; free them. */
static segment *pieces_of(const il_snapped *s, const il_reference *r, size_t *n)
{
    segment *list = malloc((s->n_points[0] + s->n_points[1] + 1) * sizeof *list);
    *n = 0;
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < r->side[k].n; i++)
            for (uint32_t j = s->run[k][i]; j < s->run[k][i + 1]; j++)
                list[(*n)++] = (segment){ s->point[k][j],
                    j + 1 < s->run[k][i + 1] ? s->point[k][j + 1] : first_of_next(s, r, k, i), k };
    return list;
}

static wide cross(const il_snapped *s, uint32_t a, uint32_t b, uint32_t c)
{
    return (wide)(s->x[b] - s->x[a]) * (s->y[c] - s->y[a]) - (wide)(s->y[b] - s->y[a]) * (s->x[c] - s->x[a]);
}

static wide dot(const il_snapped *s, uint32_t a, uint32_t b, uint32_t c)
{
    return (wide)(s->x[b] - s->x[a]) * (s->x[c] - s->x[a]) + (wide)(s->y[b] - s->y[a]) * (s->y[c] - s->y[a]);
}

static bool is_too_near(const il_snapped *s, segment e, uint32_t v)
{
    wide along = dot(s, e.a, e.b, v), length2 = dot(s, e.a, e.b, e.b), area = cross(s, e.a, e.b, v);
    if (v == e.a || v == e.b || along <= 0 || along >= length2)
        return false;
    long double distance2 = (long double)area / (long double)length2 * (long double)area;
    return distance2 < (long double)IL_SNAP_REACH * IL_SNAP_REACH * (1 - 1e-12L);
}

static int sign(wide v)
{
    return (v > 0) - (v < 0);
}

static bool do_cross(const il_snapped *s, segment e, segment f)
{
    return sign(cross(s, e.a, e.b, f.a)) * sign(cross(s, e.a, e.b, f.b)) < 0 &&
           sign(cross(s, f.a, f.b, e.a)) * sign(cross(s, f.a, f.b, e.b)) < 0;
}

/* Is everything apart that is not together? */
static bool is_settled(const il_snapped *s, const il_reference *r)
{
    size_t n;
    segment *e = pieces_of(s, r, &n);
    bool settled = true;
    for (size_t i = 0; i < n && settled; i++)
        for (size_t j = 0; j < n && settled; j++)
            settled = !is_too_near(s, e[i], e[j].a) && (e[i].a == e[j].a || e[i].a == e[j].b ||
                      e[i].b == e[j].a || e[i].b == e[j].b || !do_cross(s, e[i], e[j]));
    free(e);
    return settled;
}

/* Does a side come to one point twice, other than by one node of its section? */
static bool is_injective(const il_snapped *s, const il_reference *r)
{
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < r->side[k].n; i++)
            for (uint32_t p = s->run[k][i]; p < s->run[k][i + 1]; p++)
                for (size_t j = 0; j < r->side[k].n; j++)
                    for (uint32_t q = s->run[k][j]; q < s->run[k][j + 1]; q++) {
                        bool one_node = p == s->run[k][i] && q == s->run[k][j] &&
                                        r->section[k]->node_at[i] == r->section[k]->node_at[j];
                        if (p != q && s->point[k][p] == s->point[k][q] && !one_node)
                            return false;
                    }
    return true;
}

/* Lower vertices on the nearest grid points, upper ones perhaps on a lower one's
 * that is near; what edges pass lies near them. */
static void assert_in_place(const il_snapped *s, const il_reference *r)
{
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < r->side[k].n; i++) {
            const il_ref_vertex *a = &r->side[k].vertex[i], *b = &r->side[k].vertex[r->side[k].next[i]];
            uint32_t p = s->point[k][s->run[k][i]];
            assert_true(fabs(((a->x - s->origin[0]) / s->cell) - (double)s->x[p]) <= (k ? 1 : .5));
            assert_true(fabs(((a->y - s->origin[1]) / s->cell) - (double)s->y[p]) <= (k ? 1 : .5));
            long double ax = ((long double)a->x - s->origin[0]) / s->cell, ay = ((long double)a->y - s->origin[1]) / s->cell;
            long double ux = ((long double)b->x - a->x) / s->cell, uy = ((long double)b->y - a->y) / s->cell;
            for (uint32_t j = s->run[k][i]; j < s->run[k][i + 1]; j++) {
                uint32_t q = s->point[k][j];
                long double off = ux * ((long double)s->y[q] - ay) - uy * ((long double)s->x[q] - ax), length = hypotl(ux, uy);
                if (length > 10)
                    assert_true(fabsl(off) < 4 * length);
            }
        }
}

/* At exponent E: everything apart or together, and the flag tells the truth. */
static bool check_grid(const scene *s, int e, const char *what, uint64_t seed)
{
    il_snapped out;
    bool injective = false;
    assert_int_equal(il_snap(&out, &s->r, e, &injective, NULL), IL_OK);
    bool settled = is_settled(&out, &s->r);
    if (!settled || injective != is_injective(&out, &s->r))
        fail_msg("%s %llu at 2^%d: %ssettled, said to be %sinjective", what, (unsigned long long)seed, e,
                 settled ? "" : "not ", injective ? "" : "not ");
    assert_in_place(&out, &s->r);
    il_snapped_free(&out);
    return injective;
}

/* At every fourth exponent, all of them in turn as SEED rises, and at the last;
 * is any injective? */
static bool check_grids(const scene *s, const char *what, uint64_t seed)
{
    int last = il_snap_last_exponent(&s->r);
    bool good = check_grid(s, last, what, seed);
    for (int e = il_snap_first_exponent(&s->r, false) - (int)(seed % 4); e > last; e -= 4)
        good |= check_grid(s, e, what, seed);
    return good;
}

/* ---- scenes ---- */

static void tangles_settle_at_every_exponent(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 150; seed++) {
        uint64_t rng = seed;
        il_slice a = random_tangle(&rng, 4 + (unsigned)(seed % 5)), b = random_tangle(&rng, 4 + (unsigned)(seed % 5));
        scene *s = scene_of(&a, &b);
        assert_true(check_grids(s, "tangle", seed));
        scene_free(s);
    }
}

/* A copy with every coordinate off by up to N ulps. */
static il_slice twin(const il_slice *s, uint64_t *rng, unsigned n)
{
    il_slice t;
    assert_int_equal(il_slice_copy(&t, s, NULL), IL_OK);
    for (size_t i = 0; i < t.n; i++)
        for (size_t k = 0; k < 2 * t.ring[i].n; k++)
            for (uint64_t steps = stack_random(rng) % (n + 1), up = stack_random(rng) % 2; steps > 0; steps--)
                t.ring[i].xy[k] = nextafter(t.ring[i].xy[k], up ? INFINITY : -INFINITY);
    return t;
}

static void twins_an_ulp_or_some_off_settle_at_every_exponent(void **state)
{
    (void)state;
    static const unsigned ulps[] = { 0, 1, 1, 3, 20, 400 };
    for (uint64_t seed = 1; seed <= 150; seed++) {
        uint64_t rng = seed;
        il_slice a = random_tangle(&rng, 4 + (unsigned)(seed % 5));
        for (size_t i = 0; i < a.n; i++)
            for (size_t k = 0; k < 2 * a.ring[i].n; k++)
                a.ring[i].xy[k] = a.ring[i].xy[k] / 3 + (seed % 4 == 0 ? 1000 : 0);
        il_slice b = twin(&a, &rng, ulps[seed % 6]);
        scene *s = scene_of(&a, &b);
        bool good = check_grids(s, "twin", seed);
        /* with more, what the noise makes of a tangle may be finer than any grid */
        assert_true(good || ulps[seed % 6] > 3);
        scene_free(s);
    }
}

/* Long edges that run nearly along one another, with vertices in between. */
static void combs_of_nearly_parallel_edges_settle_at_every_exponent(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        uint64_t rng = seed;
        il_slice slice[2] = { IL_SLICE_INIT, IL_SLICE_INIT };
        for (int k = 0; k < 2; k++)
            for (int i = 0; i < 3; i++) {
                il_ring *r = il_slice_add_ring(&slice[k]);
                for (int j = 0; j < 4; j++) {
                    double y = ldexp((double)(stack_random(&rng) % 64), -(int)(20 + seed % 28));
                    assert_true(il_ring_add(r, (j & 1 ? 90 : 0) + (double)(stack_random(&rng) % 10), i + y + (j & 2 ? .5 : 0), 0));
                }
            }
        scene *s = scene_of(&slice[0], &slice[1]);
        check_grids(s, "comb", seed);
        scene_free(s);
    }
}

static void the_size_of_a_drawing_does_not_matter(void **state)
{
    (void)state;
    static const int exponent[] = { -125, -120, -100, -80, -50, 40, 45 };
    for (uint64_t seed = 0; seed < 28; seed++) {
        uint64_t rng = seed;
        il_slice slice[2] = { random_tangle(&rng, 9), random_tangle(&rng, 9) };
        for (int k = 0; k < 2; k++)
            for (size_t i = 0; i < slice[k].n; i++)
                for (size_t v = 0; v < 2 * slice[k].ring[i].n; v++)
                    slice[k].ring[i].xy[v] = ldexp(slice[k].ring[i].xy[v], exponent[seed % 7]);
        scene *s = scene_of(&slice[0], &slice[1]);
        assert_true(il_snap_last_exponent(&s->r) <= il_snap_first_exponent(&s->r, false));
        assert_true(check_grids(s, "size", seed));
        scene_free(s);
    }
}

static void the_first_grid_is_a_ten_millionth_and_the_last_holds_all_bits(void **state)
{
    (void)state;
    scene *s = scene_from("0 0, 1 0, 1 1", "0 0, 0.5 0, 0.5 0.5");
    double first = ldexp(1, il_snap_first_exponent(&s->r, false)), last = ldexp(1, il_snap_last_exponent(&s->r));
    assert_true(first <= 1e-7 && first > .5e-7);
    assert_true(last <= 0x1p-51 && last >= 0x1p-53);
    scene_free(s);
    s = scene_from("", ""); /* nothing to measure */
    il_snapped out;
    bool injective = false;
    assert_int_equal(il_snap(&out, &s->r, il_snap_first_exponent(&s->r, false), &injective, NULL), IL_OK);
    assert_true(injective);
    assert_int_equal(out.n, 0);
    il_snapped_free(&out);
    scene_free(s);
}

/* ---- single cases ---- */

static bool snaps(const scene *s, int exponent)
{
    il_snapped out;
    bool injective = false;
    assert_int_equal(il_snap(&out, &s->r, exponent, &injective, NULL), IL_OK);
    il_snapped_free(&out);
    return injective;
}

static void two_vertices_of_one_slice_on_one_point_are_not_injective(void **state)
{
    (void)state;
    scene *s = scene_from("0 0, 16 0, 16 16, 0.1 0.1, 0 16", "");
    assert_false(snaps(s, -2));
    assert_true(snaps(s, -6));
    scene_free(s);
}

static void an_edge_through_a_vertex_of_its_own_slice_is_not_injective(void **state)
{
    (void)state;
    scene *s = scene_from("0 0, 16 0, 16 16, 8 0.1, 0 16", "");
    assert_false(snaps(s, -2));
    assert_true(snaps(s, -6));
    scene_free(s);
}

static void upper_vertices_go_where_lower_ones_are_that_differ_by_noise(void **state)
{
    (void)state;
    /* just below and just above half a cell: rounded alone they part */
    scene *s = scene_from("0 0, 16 0, 16 16.499999, 0 16", "0 0, 16 0, 16 16.500001, 0 16");
    il_snapped out;
    bool injective;
    assert_int_equal(il_snap(&out, &s->r, 0, &injective, NULL), IL_OK);
    assert_true(injective);
    assert_int_equal(out.n, 4);
    il_snapped_free(&out);
    scene_free(s);
}

static void a_pinch_of_the_slice_is_no_fault(void **state)
{
    (void)state;
    scene *s = scene_from("0 0, 2 0, 2 2, 0 2; 2 2, 4 2, 4 4, 2 4", "1 1, 3 1, 3 3, 1 3");
    assert_true(snaps(s, -3));
    scene_free(s);
}

static void edges_are_led_through_what_is_within_reach(void **state)
{
    (void)state;
    /* the upper vertex stands 0.7 cells off the lower edge; 0.75 is too far */
    static const struct { const char *upper; uint32_t passed; } c[] = {
        { "8 0, 12 8, 4 8", 1 }, { "8 1, 12 8, 4 8", 0 } };
    for (size_t i = 0; i < 2; i++) {
        scene *s = scene_from("0 0, 16 0, 16 16, 0 16", c[i].upper);
        il_snapped out;
        bool injective;
        assert_int_equal(il_snap(&out, &s->r, 0, &injective, NULL), IL_OK);
        assert_int_equal(out.run[0][1] - out.run[0][0], 1 + c[i].passed);
        il_snapped_free(&out);
        scene_free(s);
    }
    /* the edge from (0, 0) to (10, 7) passes 0.08 from (7, 5), 0.41 from (3, 2) or (4, 3), 0.74 from (2, 1) ... */
    scene *s = scene_from("0 0, 10 7, 0 7", "2 1, 7 5, 12 -8");
    il_snapped out;
    bool injective;
    double p[2];
    assert_int_equal(il_snap(&out, &s->r, 0, &injective, NULL), IL_OK);
    assert_true(injective);
    bool led = false;
    for (uint32_t j = out.run[0][0]; j < out.run[0][1]; j++) {
        il_snapped_point(&out, out.point[0][j], p);
        led = led || (p[0] == 7 && p[1] == 5);
    }
    assert_true(led);
    il_snapped_free(&out);
    scene_free(s);
}

static void without_memory_it_fails_cleanly(void **state)
{
    (void)state;
    scene *s = scene_from("0 0, 10 7, 0 7; 3 5, 4 6, 3 6", "2 1, 7 5, 12 -8; 0 0, 1 -1, 2 0");
    il_status st = IL_E_NOMEM;
    for (long k = 0; st != IL_OK; k++) {
        il_snapped out;
        bool injective;
        il_alloc_test_fail_after(k);
        st = il_snap(&out, &s->r, -20, &injective, NULL);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && !out.x && !out.run[0] && !out.point[1]));
        il_snapped_free(&out);
    }
    scene_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangles_settle_at_every_exponent),
        cmocka_unit_test(twins_an_ulp_or_some_off_settle_at_every_exponent),
        cmocka_unit_test(combs_of_nearly_parallel_edges_settle_at_every_exponent),
        cmocka_unit_test(the_size_of_a_drawing_does_not_matter),
        cmocka_unit_test(the_first_grid_is_a_ten_millionth_and_the_last_holds_all_bits),
        cmocka_unit_test(two_vertices_of_one_slice_on_one_point_are_not_injective),
        cmocka_unit_test(an_edge_through_a_vertex_of_its_own_slice_is_not_injective),
        cmocka_unit_test(upper_vertices_go_where_lower_ones_are_that_differ_by_noise),
        cmocka_unit_test(a_pinch_of_the_slice_is_no_fault),
        cmocka_unit_test(edges_are_led_through_what_is_within_reach),
        cmocka_unit_test(without_memory_it_fails_cleanly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
