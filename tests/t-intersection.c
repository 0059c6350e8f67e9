#include "config.h"
#include "bridge/intersection.h"
#include "test.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static uint64_t next_random(uint64_t *s) /* splitmix64 (Steele, Lea & Flood 2014) */
{
    uint64_t z = (*s += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

/* ---- the oracle: corners of the common part, in whole numbers ------------------
 *
 * Two triangles share a convex set.  Its corners are among the corners of each
 * and the points where an edge of one meets the plane or an edge of the other.
 * The triangles meet wrongly if one of these points lies in both triangles and
 * not in the hull of the vertices they share.  All in integers, points as
 * (x, y, z) / w; nothing here is what the bridge does. */

typedef struct { int64_t x, y, z; } vec;
typedef struct { vec p; int64_t w; } spot;

static vec sub(vec a, vec b) { return (vec){ a.x - b.x, a.y - b.y, a.z - b.z }; }
static vec mul(vec a, int64_t k) { return (vec){ a.x * k, a.y * k, a.z * k }; }
static vec add(vec a, vec b) { return (vec){ a.x + b.x, a.y + b.y, a.z + b.z }; }
static int64_t dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static bool is_zero(vec a) { return a.x == 0 && a.y == 0 && a.z == 0; }
static vec cross(vec a, vec b)
{
    return (vec){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static vec normal(const vec t[3]) { return cross(sub(t[1], t[0]), sub(t[2], t[0])); }

static spot spot_at(vec p) { return (spot){ p, 1 }; }

static bool in_triangle(spot s, const vec t[3])
{
    vec n = normal(t);
    if (dot(n, sub(s.p, mul(t[0], s.w))) != 0)
        return false;
    for (int i = 0; i < 3; i++)
        if (dot(n, cross(sub(t[(i + 1) % 3], t[i]), sub(s.p, mul(t[i], s.w)))) < 0)
            return false;
    return true;
}

static bool on_segment(spot s, vec a, vec b)
{
    vec from_a = sub(s.p, mul(a, s.w)), from_b = sub(s.p, mul(b, s.w));
    return is_zero(cross(from_a, sub(b, a))) && dot(from_a, from_b) <= 0;
}

static bool in_shared(spot s, const vec *shared, int n)
{
    return n == 3 || (n == 2 && on_segment(s, shared[0], shared[1]))
        || (n == 1 && is_zero(sub(s.p, mul(shared[0], s.w))));
}

static int edge_and_plane(vec a, vec b, const vec t[3], spot *out)
{
    int64_t sa = dot(normal(t), sub(a, t[0])), sb = dot(normal(t), sub(b, t[0]));
    if (sa == sb)
        return 0;
    int64_t sign = sa > sb ? 1 : -1;
    *out = (spot){ mul(sub(mul(b, sa), mul(a, sb)), sign), sign * (sa - sb) };
    return 1;
}

static int edge_and_edge(vec a, vec b, vec c, vec d, spot *out)
{
    vec m = cross(sub(b, a), sub(d, c));
    if (is_zero(m) || dot(m, sub(c, a)) != 0)
        return 0;
    int64_t t = dot(cross(sub(c, a), sub(d, c)), m);
    *out = (spot){ add(mul(a, dot(m, m)), mul(sub(b, a), t)), dot(m, m) };
    return 1;
}

static int candidates(const vec s[3], const vec t[3], spot *out)
{
    int n = 0;
    for (int i = 0; i < 3; i++) {
        out[n++] = spot_at(s[i]);
        n += edge_and_plane(s[i], s[(i + 1) % 3], t, out + n);
        for (int j = 0; j < 3; j++)
            n += edge_and_edge(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3], out + n);
    }
    return n;
}

static bool oracle(const vec s[3], const vec t[3])
{
    vec shared[9];
    int n_shared = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (is_zero(sub(s[i], t[j])))
                shared[n_shared++] = s[i];
    if (n_shared == 3)
        return true;
    spot c[64];
    int n = candidates(s, t, c);
    n += candidates(t, s, c + n);
    for (int i = 0; i < n; i++)
        if (in_triangle(c[i], s) && in_triangle(c[i], t) && !in_shared(c[i], shared, n_shared))
            return true;
    return false;
}

static bool is_flat(const vec t[3]) { return is_zero(normal(t)); }

/* Pairs with at least one touched triangle, flat ones with themselves alone. */
static size_t count_by_oracle(const vec (*t)[3], size_t n, const unsigned char *touched, uint32_t first[2])
{
    size_t found = 0;
    first[0] = first[1] = UINT32_MAX;
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) {
            bool bad = i == j ? is_flat(t[i]) : !is_flat(t[i]) && !is_flat(t[j]) && oracle(t[i], t[j]);
            if (bad && (!touched || touched[i] || touched[j])) {
                if (found++ == 0) {
                    first[0] = (uint32_t)i;
                    first[1] = (uint32_t)j;
                }
            }
        }
    return found;
}

/* ---- calling the bridge ------------------------------------------------------- */

/* Corner k of the triangles is vertex k: equal places have different indices. */
static size_t count(const vec (*t)[3], size_t n, const unsigned char *touched, size_t limit, uint32_t first[2])
{
    double *xyz = malloc((9 * n + 1) * sizeof *xyz);
    uint32_t *tri = malloc((3 * n + 1) * sizeof *tri);
    for (size_t k = 0; k < 3 * n; k++) {
        vec p = t[k / 3][k % 3];
        xyz[3 * k] = (double)p.x;
        xyz[3 * k + 1] = (double)p.y;
        xyz[3 * k + 2] = (double)p.z;
        tri[k] = (uint32_t)k;
    }
    size_t found = 99;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_intersections(xyz, 3 * n, tri, n, touched, limit, &found, first, &err), IL_OK);
    free(xyz);
    free(tri);
    return found;
}

static bool pair_meets(vec a, vec b, vec c, vec d, vec e, vec f)
{
    const vec t[2][3] = { { a, b, c }, { d, e, f } };
    uint32_t first[2];
    return count(t, 2, NULL, 10, first) == 1 && first[0] == 0 && first[1] == 1;
}

#define V(x, y, z) ((vec){ x, y, z })

/* ---- closed forms: one triangle, and each way another can lie to it ------------- */

static const vec A = { 0, 0, 0 }, B = { 4, 0, 0 }, C = { 0, 4, 0 };

static void triangles_that_share_nothing(void **state)
{
    (void)state;
    assert_true(pair_meets(A, B, C, V(1, 1, -1), V(1, 1, 1), V(9, 9, 0)));   /* pierced inside */
    assert_true(pair_meets(A, B, C, V(2, 0, -1), V(2, 0, 1), V(2, -5, 0)));  /* edge across an edge */
    assert_true(pair_meets(A, B, C, V(1, 1, 0), V(1, 1, 5), V(2, 2, 5)));    /* corner on the face */
    assert_true(pair_meets(A, B, C, V(2, 0, 0), V(1, 0, 5), V(3, 0, 5)));    /* corner on an edge */
    assert_true(pair_meets(A, B, C, V(-1, -1, 0), V(1, 1, 0), V(0, 0, 5)));  /* edge through a corner */
    assert_true(pair_meets(A, B, C, V(1, 0, 0), V(2, 0, 0), V(1, 0, 5)));    /* edge along an edge */
    assert_true(pair_meets(A, B, C, V(1, 1, 0), V(2, 1, 0), V(1, 1, 5)));    /* edge in the face */
    assert_false(pair_meets(A, B, C, V(3, 3, -1), V(3, 3, 1), V(9, 9, 0)));  /* past the long edge */
    assert_false(pair_meets(A, B, C, V(0, 0, 1), V(4, 0, 1), V(0, 4, 1)));   /* parallel */
    assert_false(pair_meets(A, B, C, V(5, 0, 0), V(6, 0, 0), V(5, 0, 5)));   /* on the line, beyond */
    assert_true(pair_meets(A, B, C, V(-1, 5, -1), V(5, -1, 2), V(9, 9, 0))); /* edge through the long edge */
    assert_false(pair_meets(A, B, C, V(0, 5, -1), V(6, -1, 2), V(9, 9, 0)));
}

static void triangles_in_one_plane(void **state)
{
    (void)state;
    assert_true(pair_meets(A, B, C, V(1, 1, 0), V(2, 1, 0), V(1, 2, 0)));    /* inside */
    assert_true(pair_meets(A, B, C, V(-1, -1, 0), V(9, -1, 0), V(-1, 9, 0))); /* around */
    assert_true(pair_meets(A, B, C, V(2, 2, 0), V(5, 5, 0), V(2, 5, 0)));    /* corner on an edge */
    assert_true(pair_meets(A, B, C, V(1, 0, 0), V(3, 0, 0), V(2, -3, 0)));   /* edges overlap */
    assert_true(pair_meets(A, B, C, V(-1, 1, 0), V(5, 1, 0), V(5, 2, 0)));   /* across */
    assert_false(pair_meets(A, B, C, V(3, 2, 0), V(2, 3, 0), V(9, 9, 0)));   /* beside */
    assert_false(pair_meets(A, B, C, V(5, 0, 0), V(7, 0, 0), V(6, 1, 0)));   /* edges on one line */
}

static void triangles_that_share_a_vertex(void **state)
{
    (void)state;
    assert_false(pair_meets(A, B, C, A, V(1, 1, 3), V(2, 1, 3)));            /* above */
    assert_false(pair_meets(A, B, C, A, V(-1, -1, 3), V(-1, -1, -3)));       /* through the plane, behind */
    assert_false(pair_meets(A, B, C, V(-1, -1, 0), A, V(0, -1, 3)));
    assert_true(pair_meets(A, B, C, A, V(1, 1, 3), V(1, 1, -3)));            /* cuts the face */
    assert_true(pair_meets(A, B, C, V(9, 9, 3), A, V(9, 9, -3)));            /* cuts the far edge */
    assert_true(pair_meets(A, B, C, A, V(1, 1, 0), V(0, 0, 3)));             /* edge in the face */
    assert_true(pair_meets(A, B, C, A, V(2, 0, 0), V(0, 0, 3)));             /* edge along an edge */
    assert_true(pair_meets(A, B, C, A, V(9, 0, 0), V(0, 0, 3)));             /* longer */
    assert_true(pair_meets(A, B, C, A, V(1, 2, 0), V(2, 1, 0)));             /* one plane, inside */
    assert_true(pair_meets(A, B, C, A, V(9, -1, 0), V(-1, 9, 0)));           /* one plane, around */
    assert_true(pair_meets(A, B, C, A, V(3, 0, 0), V(0, -3, 0)));            /* one plane, edges overlap */
    assert_false(pair_meets(A, B, C, A, V(-3, 0, 0), V(0, -3, 0)));          /* one plane, opposite */
    assert_false(pair_meets(A, B, C, B, V(5, 0, 0), V(5, 3, 0)));
}

static void triangles_that_share_an_edge(void **state)
{
    (void)state;
    assert_false(pair_meets(A, B, C, B, A, V(0, -4, 0)));                    /* flat, apart */
    assert_false(pair_meets(A, B, C, B, A, V(1, 1, 1)));                     /* steep */
    assert_true(pair_meets(A, B, C, B, A, V(1, 1, 0)));                      /* folded back */
    assert_true(pair_meets(A, B, C, A, B, V(9, 9, 0)));
    assert_true(pair_meets(A, B, C, C, V(-1, 3, 0), B));
}

static void equal_triangles_meet_whatever_their_turn(void **state)
{
    (void)state;
    assert_true(pair_meets(A, B, C, A, B, C));
    assert_true(pair_meets(A, B, C, C, A, B));
    assert_true(pair_meets(A, B, C, B, A, C));
}

static void a_triangle_without_area_is_found_as_itself(void **state)
{
    (void)state;
    const vec t[4][3] = { { A, B, C }, { A, B, V(9, 0, 0) }, { A, A, B }, { V(3, 3, 3), V(3, 3, 3), V(3, 3, 3) } };
    const unsigned char touched[4] = { 1, 0, 0, 1 };
    uint32_t first[2];
    assert_int_equal(count(t, 4, NULL, 10, first), 3);
    assert_int_equal(first[0], 1);
    assert_int_equal(first[1], 1);
    assert_int_equal(count(t, 4, touched, 10, first), 1);
    assert_int_equal(first[0], 3);
}

static void minus_zero_is_the_same_place_as_zero(void **state)
{
    (void)state;
    double xyz[] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, -0.0, -0.0, -0.0, 0, -1, 0, -1, 0, 0 };
    uint32_t tri[] = { 0, 1, 2, 3, 4, 5 }, first[2];
    size_t found;
    assert_int_equal(il_intersections(xyz, 6, tri, 2, NULL, 9, &found, first, NULL), IL_OK);
    assert_int_equal(found, 0);
}

static void nothing_in_nothing_out(void **state)
{
    (void)state;
    size_t found = 9;
    uint32_t first[2] = { 0, 0 };
    assert_int_equal(il_intersections(NULL, 0, NULL, 0, NULL, 9, &found, first, NULL), IL_OK);
    assert_int_equal(found, 0);
    assert_int_equal(first[0], UINT32_MAX);
}

static void a_vertex_that_is_not_there_is_refused(void **state)
{
    (void)state;
    double xyz[9] = { 0 };
    uint32_t tri[3] = { 0, 1, 3 }, first[2];
    size_t found;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_intersections(xyz, 3, tri, 1, NULL, 9, &found, first, &err), IL_E_INTERNAL);
    assert_int_equal(found, 0);
}

/* One unit in the last place decides, far from the origin and close to it. */
static void the_last_bit_counts(void **state)
{
    (void)state;
    static const double scale[] = { 1, 1e-100, 0x1p-300, 1e15, 0x1p40 };
    for (size_t k = 0; k < sizeof scale / sizeof *scale; k++) {
        double s = scale[k], third = s / 3, up = nextafter(third, s);
        /* apexes on the plane x = y, and one bit beside it */
        double xyz[] = { 0, 0, 0, s, s, 0, 0, 0, s, third, third, s / 8, third, s, s / 8, up, s, s / 4 };
        uint32_t tri[] = { 0, 1, 2, 3, 4, 5 }, first[2];
        size_t found;
        assert_int_equal(il_intersections(xyz, 6, tri, 2, NULL, 9, &found, first, NULL), IL_OK);
        assert_int_equal(found, 1);
        xyz[10] = nextafter(third, s); /* y of the apex */
        assert_int_equal(il_intersections(xyz, 6, tri, 2, NULL, 9, &found, first, NULL), IL_OK);
        assert_int_equal(found, 0);
    }
}

/* ---- random triangles on a small grid: every degeneracy there is ---------------- */

static void random_triangle(uint64_t *seed, unsigned side, vec t[3])
{
    for (int i = 0; i < 3; i++) {
        uint64_t r = next_random(seed);
        t[i] = V((int64_t)((r & 0xFFFF) % side), (int64_t)((r >> 16 & 0xFFFF) % side),
                 (int64_t)((r >> 32 & 0xFFFF) % side));
    }
}

static void two_hundred_thousand_pairs_agree_with_the_oracle(void **state)
{
    (void)state;
    uint64_t seed = 7;
    size_t n_meeting = 0;
    for (unsigned k = 0; k < 200000; k++) {
        vec t[2][3];
        uint32_t first[2], expected[2];
        unsigned side = 2 + k % 4;
        random_triangle(&seed, side, t[0]);
        random_triangle(&seed, side, t[1]);
        if (k % 3 > 0)
            t[1][k % 2] = t[0][k % 5 % 3]; /* share a vertex */
        if (k % 3 > 1)
            t[1][2] = t[0][k / 7 % 3];     /* and often an edge */
        size_t want = count_by_oracle((const vec(*)[3])t, 2, NULL, expected);
        assert_int_equal(count((const vec(*)[3])t, 2, NULL, 10, first), want);
        assert_memory_equal(first, expected, sizeof first);
        n_meeting += expected[0] == 0 && expected[1] == 1;
    }
    assert_true(n_meeting > 20000 && n_meeting < 150000);
}

static void a_soup_is_counted_as_the_oracle_counts_it(void **state)
{
    (void)state;
    enum { N = 60 };
    uint64_t seed = 11;
    for (unsigned k = 0; k < 300; k++) {
        vec t[N][3];
        unsigned char touched[N];
        uint32_t first[2], expected[2];
        for (size_t i = 0; i < N; i++) {
            random_triangle(&seed, 3 + k % 9, t[i]);
            touched[i] = next_random(&seed) % 4 == 0;
        }
        size_t want = count_by_oracle((const vec(*)[3])t, N, NULL, expected);
        assert_int_equal(count((const vec(*)[3])t, N, NULL, N * N, first), want);
        assert_memory_equal(first, expected, sizeof first);
        want = count_by_oracle((const vec(*)[3])t, N, touched, expected);
        assert_int_equal(count((const vec(*)[3])t, N, touched, N * N, first), want);
        assert_memory_equal(first, expected, sizeof first);
        assert_int_equal(count((const vec(*)[3])t, N, NULL, 5, first), 5);
    }
}

/* Vertices of many triangles are searched by direction: two hubs, and triangles
 * at one of them, at both or at none. */
static void triangles_round_hubs_are_counted_as_the_oracle_counts_them(void **state)
{
    (void)state;
    enum { N = 160 };
    static const vec hub[2] = { { 7, 8, 6 }, { 9, 6, 7 } };
    uint64_t seed = 11;
    for (int round = 0; round < 8; round++) {
        vec t[N][3];
        unsigned char touched[N];
        uint32_t first[2], expected[2];
        for (int i = 0; i < N; i++) {
            random_triangle(&seed, 16, t[i]);
            uint64_t r = next_random(&seed);
            if (r % 8 != 0)
                t[i][0] = hub[r / 8 % 2];
            if (r % 8 == 1)
                t[i][1] = hub[1 - r / 8 % 2];
            touched[i] = r / 16 % 4 == 0;
        }
        size_t want = count_by_oracle((const vec(*)[3])t, N, NULL, expected);
        assert_int_equal(count((const vec(*)[3])t, N, NULL, N * N, first), want);
        assert_memory_equal(first, expected, sizeof first);
        want = count_by_oracle((const vec(*)[3])t, N, touched, expected);
        assert_int_equal(count((const vec(*)[3])t, N, touched, N * N, first), want);
        assert_memory_equal(first, expected, sizeof first);
    }
}

/* A closed fan of N triangles at a peak, as steep as STEEP says, FAR away. */
static size_t count_in_fan(double far, double steep, size_t n, size_t twisted)
{
    double *xyz = malloc(3 * (n + 1) * sizeof *xyz);
    uint32_t *tri = malloc(3 * n * sizeof *tri), first[2];
    size_t found = 0;
    assert_true(xyz && tri);
    for (size_t i = 0; i < n; i++) {
        double turn = 6.283185307179586 * (double)i / (double)n;
        xyz[3 * i] = far + cos(turn), xyz[3 * i + 1] = far + sin(turn), xyz[3 * i + 2] = 0;
        tri[3 * i] = (uint32_t)n, tri[3 * i + 1] = (uint32_t)i, tri[3 * i + 2] = (uint32_t)((i + 1) % n);
    }
    xyz[3 * n] = xyz[3 * n + 1] = far, xyz[3 * n + 2] = steep;
    if (twisted > 0) { /* vertex 0 goes out through the fan, above another */
        xyz[0] = xyz[3 * twisted], xyz[1] = xyz[3 * twisted + 1], xyz[2] = steep / 2;
    }
    assert_int_equal(il_intersections(xyz, n + 1, tri, n, NULL, n * n, &found, first, NULL), IL_OK);
    free(xyz);
    free(tri);
    return found;
}

static void a_fan_is_sound_however_steep_and_far_and_not_when_twisted(void **state)
{
    (void)state;
    static const double steep[] = { 1e-6, 1, 1e6 }, far[] = { 0, 1e6 };
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 2; j++) {
            assert_int_equal(count_in_fan(far[j], steep[i], 1000, 0), 0);
            assert_true(count_in_fan(far[j], steep[i], 1000, 300) > 0);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_that_share_nothing),
        cmocka_unit_test(triangles_in_one_plane),
        cmocka_unit_test(triangles_that_share_a_vertex),
        cmocka_unit_test(triangles_that_share_an_edge),
        cmocka_unit_test(equal_triangles_meet_whatever_their_turn),
        cmocka_unit_test(a_triangle_without_area_is_found_as_itself),
        cmocka_unit_test(minus_zero_is_the_same_place_as_zero),
        cmocka_unit_test(nothing_in_nothing_out),
        cmocka_unit_test(a_vertex_that_is_not_there_is_refused),
        cmocka_unit_test(the_last_bit_counts),
        cmocka_unit_test(two_hundred_thousand_pairs_agree_with_the_oracle),
        cmocka_unit_test(a_soup_is_counted_as_the_oracle_counts_it),
        cmocka_unit_test(triangles_round_hubs_are_counted_as_the_oracle_counts_them),
        cmocka_unit_test(a_fan_is_sound_however_steep_and_far_and_not_when_twisted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
