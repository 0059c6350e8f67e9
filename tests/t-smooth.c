/* t-smooth.c - solids whose strips are bent, and ends that follow them. */
#include "config.h"
#include "base/alloc.h"
#include "loft/curve.h"
#include "match/matcher.h"
#include "slabs.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 32 };

/* ---- round solids ---------------------------------------------------------------------------- */

/* distance(self, p): of point P to the solid's surface. */
typedef struct round_solid {
    const char *name;
    double a, b, c;           /* what its functions make of it */
    void (*slice)(const struct round_solid *s, double z, il_slice *to);
    double (*distance)(const struct round_solid *s, const double p[3]);
    double low, high;
} round_solid;

static void cut_sphere(const round_solid *s, double z, il_slice *to)
{
    add_circle(to, 0, 0, sqrt(s->a * s->a - z * z), 128);
}

static double off_sphere(const round_solid *s, const double p[3])
{
    return fabs(hypot(hypot(p[0], p[1]), p[2]) - s->a);
}

/* A torus that lies on its side, above its hole: two circles bent into ovals. */
static void cut_torus(const round_solid *s, double z, il_slice *to)
{
    for (int side = -1; side <= 1; side += 2) {
        il_ring *r = il_slice_add_ring(to);
        assert_non_null(r);
        for (int i = 0; i < 128; i++) {
            double t = 6.283185307179586 * i / 128, y = s->b * sin(t), e = s->b * cos(t); /* of the tube's cross-section */
            double x = sqrt((s->a + e) * (s->a + e) - z * z);
            assert_true(il_ring_add(r, side * x, y, 0));
        }
    }
}

static double off_torus(const round_solid *s, const double p[3])
{
    return fabs(hypot(hypot(p[0], p[2]) - s->a, p[1]) - s->b);
}

/* r^2 = a (z + b) */
static void cut_paraboloid(const round_solid *s, double z, il_slice *to)
{
    add_circle(to, 3, -2, sqrt(s->a * (z + s->b)), 128);
}

static double off_paraboloid(const round_solid *s, const double p[3])
{
    double r = hypot(p[0] - 3, p[1] + 2), z = p[2] + s->b, d = r * r - s->a * z;
    return fabs(d) / hypot(2 * r, s->a); /* to first order */
}

/* An oval tube that winds: centre (a sin z/b, 0). */
static void cut_tube(const round_solid *s, double z, il_slice *to)
{
    add_ellipse(to, s->a * sin(z / s->b), 0, s->c, s->c / 2, 128);
}

static double off_tube(const round_solid *s, const double p[3])
{
    double x = p[0] - s->a * sin(p[2] / s->b), k = hypot(x / s->c, 2 * p[1] / s->c);
    return fabs(k - 1) * s->c / 2 * hypot(x / s->c, p[1] / s->c) / fmax(k, .1);
}

static const round_solid SOLIDS[] = {
    { "sphere", 10, 0, 0, cut_sphere, off_sphere, -8.5, 8.5 },
    { "torus", 20, 5, 0, cut_torus, off_torus, -11, 11 },
    { "paraboloid", 4, 1, 0, cut_paraboloid, off_paraboloid, 0, 12 },
    { "tube", 2, 5, 3, cut_tube, off_tube, 0, 30 },
};

static size_t cut_solid(const round_solid *s, size_t n, il_slice *slice)
{
    for (size_t i = 0; i < n; i++) {
        slice[i] = (il_slice)IL_SLICE_INIT;
        slice[i].z = s->low + (s->high - s->low) * (double)i / (double)(n - 1);
        s->slice(s, slice[i].z, &slice[i]);
    }
    return n;
}

static il_status send(il_sink *to, const il_slice *slice, size_t n, bool round_float, il_error *err)
{
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_status st = to->stack_begin(to, &head, err);
    for (size_t i = 0; i < n && st == IL_OK; i++) {
        il_slice clean = clean_slice(&slice[i], round_float);
        st = to->slice(to, &clean, err);
        il_slice_free(&clean);
    }
    if (st == IL_OK)
        st = to->stack_end(to, err);
    return st == IL_OK ? to->end(to, err) : st;
}

/* Matched, and lofted. */
static keeper loft_slices(const il_slice *slice, size_t n, const il_loft_options *o, const char *what)
{
    il_match_options match = { IL_MATCHER_FFD, false, 1 };
    il_sink *lofter = NULL, *matcher = NULL;
    il_error err = IL_ERROR_INIT;
    keeper k = new_keeper();
    assert_int_equal(il_lofter_new(&lofter, o, &k.sink, &err), IL_OK);
    assert_int_equal(il_matcher_new(&matcher, &match, lofter, &err), IL_OK);
    if (send(matcher, slice, n, o->round_float, &err) != IL_OK)
        fail_msg("%s: %s", what, err.text);
    il_matcher_free(matcher);
    il_lofter_free(lofter);
    assert_sound(&k, what, n);
    return k;
}

static keeper loft_between(const il_slice *slice, size_t n, int between, const char *what)
{
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    o.between = between;
    return loft_slices(slice, n, &o, what);
}

/* The mean distance to solid S of the middles of the sides of K, weighed by area; the lids are left out. */
static double mean_distance(const round_solid *s, const il_mesh *m)
{
    double sum = 0, total = 0;
    for (size_t t = 0; t < m->n_triangles; t++) {
        const double *v[3] = { m->xyz + 3 * m->tri[3 * t], m->xyz + 3 * m->tri[3 * t + 1], m->xyz + 3 * m->tri[3 * t + 2] };
        double u[3], w[3], mid[3];
        if (v[0][2] == v[1][2] && v[1][2] == v[2][2])
            continue;
        for (int k = 0; k < 3; k++) {
            u[k] = v[1][k] - v[0][k], w[k] = v[2][k] - v[0][k];
            mid[k] = (v[0][k] + v[1][k] + v[2][k]) / 3;
        }
        double area = hypot(hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2]), u[0] * w[1] - u[1] * w[0]);
        sum += area * s->distance(s, mid);
        total += area;
    }
    return sum / total;
}

static void smooth_strips_are_nearer_to_round_solids(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SOLIDS / sizeof *SOLIDS; i++)
        for (size_t n = 6; n <= 24; n *= 2) {
            il_slice slice[MOST];
            cut_solid(&SOLIDS[i], n, slice);
            keeper straight = loft_between(slice, n, 0, SOLIDS[i].name), smooth = loft_between(slice, n, IL_BETWEEN_AUTO, SOLIDS[i].name);
            double before = mean_distance(&SOLIDS[i], &straight.mesh), after = mean_distance(&SOLIDS[i], &smooth.mesh);
            double spacing = slice[1].z - slice[0].z;
            if (!(after < 0.6 * before || (after < before && after < IL_CURVE_TOLERANCE * spacing / 4)))
                fail_msg("%s, %zu slices: %g from it, %g with straight strips", SOLIDS[i].name, n, after, before);
            il_mesh_free(&straight.mesh);
            il_mesh_free(&smooth.mesh);
            free_slices(slice, n);
        }
}

/* ---- what is straight ------------------------------------------------------------------------- */

/* Circles of radius R + GROW z about (SHIFT z, 0), at uneven heights. */
static size_t cut_cone(double r, double grow, double shift, il_slice slice[5])
{
    static const double z[5] = { 0, 1, 3, 3.5, 6 };
    for (int i = 0; i < 5; i++)
        slice[i] = circle(z[i], shift * z[i], 0, r + grow * z[i], 60);
    return 5;
}

static void cones_and_slanted_cylinders_stay_what_they_are(void **state)
{
    (void)state;
    static const double form[][3] = { { 5, 0, 0 }, { 5, -.7, 0 }, { 2, 1.5, 0 }, { 6, 0, .8 }, { 6, -.5, .6 } };
    for (size_t i = 0; i < sizeof form / sizeof *form; i++) {
        il_slice slice[5];
        size_t n = cut_cone(form[i][0], form[i][1], form[i][2], slice);
        keeper straight = loft_between(slice, n, 0, "cone"), smooth = loft_between(slice, n, IL_BETWEEN_AUTO, "cone");
        keeper three = loft_between(slice, n, 3, "cone");
        if (form[i][2] == 0) /* else matching is not exact */
            assert_same_mesh(&straight.mesh, &smooth.mesh);
        assert_true(fabs(smooth.facts.volume / straight.facts.volume - 1) < 1e-3);
        assert_true(three.facts.triangles > straight.facts.triangles);
        assert_true(fabs(three.facts.volume / straight.facts.volume - 1) < 1e-3);
        il_mesh_free(&straight.mesh);
        il_mesh_free(&smooth.mesh);
        il_mesh_free(&three.mesh);
        free_slices(slice, n);
    }
}

/* ---- how many contours are put in -------------------------------------------------------------- */

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* How many heights there are in M strictly between LOW and HIGH. */
static size_t count_heights(const il_mesh *m, double low, double high)
{
    double *z = il_alloc(m->n_vertices, sizeof *z);
    size_t n = 0, distinct = 0;
    assert_non_null(z);
    for (size_t v = 0; v < m->n_vertices; v++)
        if (m->xyz[3 * v + 2] > low && m->xyz[3 * v + 2] < high)
            z[n++] = m->xyz[3 * v + 2];
    qsort(z, n, sizeof *z, compare);
    for (size_t i = 0; i < n; i++)
        distinct += i == 0 || z[i] != z[i - 1];
    il_free(z);
    return distinct;
}

static void as_many_contours_are_put_in_as_are_asked_for(void **state)
{
    (void)state;
    static const int between[] = { 0, 1, 3, IL_BETWEEN_MOST };
    il_slice slice[MOST];
    size_t n = cut_solid(&SOLIDS[0], 6, slice);
    for (int k = 0; k < 8; k++) {
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        o.between = between[k % 4];
        o.round_float = k >= 4;
        keeper kept = loft_slices(slice, n, &o, "sphere");
        for (size_t i = 1; i < n; i++)
            assert_int_equal(count_heights(&kept.mesh, (float)slice[i - 1].z + 1e-6, (float)slice[i].z - 1e-6), between[k % 4]);
        il_mesh_free(&kept.mesh);
    }
    free_slices(slice, n);
}

/* A quarter of the spacing takes no more contours, and what comes out is not farther from the sphere
 * than the tolerance lets it be. */
static void the_contours_put_in_follow_the_tolerance(void **state)
{
    (void)state;
    il_slice slice[MOST];
    size_t before = IL_CURVE_BETWEEN_MOST;
    for (size_t n = 6; n <= 24; n *= 2) {
        cut_solid(&SOLIDS[0], n, slice);
        double spacing = slice[1].z - slice[0].z;
        keeper k = loft_between(slice, n, IL_BETWEEN_AUTO, "sphere");
        size_t middle = count_heights(&k.mesh, slice[n / 2 - 1].z, slice[n / 2].z);
        assert_true(middle <= before);
        for (size_t i = 1; i < n; i++)
            assert_true(count_heights(&k.mesh, slice[i - 1].z, slice[i].z) <= IL_CURVE_BETWEEN_MOST);
        for (size_t v = 0; v < k.mesh.n_vertices; v++)
            if (fabs(k.mesh.xyz[3 * v + 2]) < spacing)
                assert_true(SOLIDS[0].distance(&SOLIDS[0], k.mesh.xyz + 3 * v) < 2 * IL_CURVE_TOLERANCE * spacing);
        before = middle;
        il_mesh_free(&k.mesh);
        free_slices(slice, n);
    }
}

/* ---- what would meet ----------------------------------------------------------------------------- */

/* A body turns back where another, GAP beside it, goes on leaning away: bent, it would bulge into the other. */
static size_t cut_neighbours(double gap, il_slice slice[4])
{
    static const double r[4] = { 8, 10, 8, 6 };
    for (int i = 0; i < 4; i++) {
        slice[i] = circle(i, 0, 0, r[i], 90);
        add_circle(&slice[i], 28 + gap + 2 * i, 0, 20, 180);
    }
    return 4;
}

static void neighbours_are_bent_less_but_never_into_each_other(void **state)
{
    (void)state;
    for (double gap = 2; gap > 1e-3; gap /= 4)
        for (int between = -1; between <= 3; between += 4) {
            il_slice slice[4];
            size_t n = cut_neighbours(gap, slice);
            keeper straight = loft_between(slice, n, 0, "neighbours"), k = loft_between(slice, n, between, "neighbours");
            assert_int_equal(k.facts.components, 2);
            assert_int_equal(k.facts.genus, 0);
            assert_true(k.facts.triangles > straight.facts.triangles);
            assert_true(k.facts.volume > straight.facts.volume);
            il_mesh_free(&straight.mesh);
            il_mesh_free(&k.mesh);
            free_slices(slice, n);
        }
}

/* ---- anything ------------------------------------------------------------------------------------- */

static void any_stack_is_certified_whatever_is_put_in(void **state)
{
    (void)state;
    static const int between[] = { 1, 2, 5, IL_BETWEEN_AUTO };
    uint64_t seeds = getenv("ISOLOFT_LONG") ? 200 : 8;
    for (int kind = 0; kind < STACK_N_KINDS; kind++)
        for (uint64_t seed = 1; seed <= seeds; seed++) {
            il_slice slice[6];
            size_t n = stack_make((stack_kind)kind, 1000 + seed, slice);
            il_loft_options o = IL_LOFT_OPTIONS_INIT;
            o.between = between[seed % 4];
            o.cap = (il_cap)(seed / 4 % 3);
            o.round_float = seed % 3 == 0 && kind != STACK_TANGLED;
            keeper k = loft_slices(slice, n, &o, "seed");
            il_mesh_free(&k.mesh);
            free_slices(slice, n);
        }
}

/* Random stars bend everywhere; in floats, at gaps of the window, by any number of threads. */
static void threads_do_not_change_what_is_bent(void **state)
{
    (void)state;
    static const int threads[] = { 2, 3, 8 };
    for (int k = 0; k < 4; k++) {
        il_slice slice[MOST];
        il_loft_options o = IL_LOFT_OPTIONS_INIT;
        size_t n = 0;
        o.round_float = k % 2 == 1;
        o.between = k < 2 ? 3 : IL_BETWEEN_AUTO;
        o.cap = k < 2 ? IL_CAP_AUTO : IL_CAP_FLAT;
        for (uint64_t seed = 50; n + 6 <= MOST; seed++)
            n += stack_make(STACK_UNRELATED, seed, slice + n);
        for (size_t i = 0; i < n; i++)
            slice[i].z = (double)i;
        keeper one = loft_slices(slice, n, &o, "stars");
        for (int j = 0; j < 3; j++) {
            o.threads = threads[j];
            keeper kept = loft_slices(slice, n, &o, "stars");
            assert_same_mesh(&one.mesh, &kept.mesh);
            il_mesh_free(&kept.mesh);
        }
        il_mesh_free(&one.mesh);
        free_slices(slice, n);
    }
}

static void upside_down_a_round_solid_has_the_same_volume(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SOLIDS / sizeof *SOLIDS; i++)
        for (int cap = IL_CAP_FLAT; cap <= IL_CAP_AUTO; cap++) {
            il_slice slice[MOST], turned[MOST];
            il_loft_options o = IL_LOFT_OPTIONS_INIT;
            size_t n = cut_solid(&SOLIDS[i], 11, slice);
            o.cap = (il_cap)cap;
            for (size_t k = 0; k < n; k++) {
                assert_int_equal(il_slice_copy(&turned[n - 1 - k], &slice[k], NULL), IL_OK);
                turned[n - 1 - k].z = -slice[k].z;
            }
            keeper a = loft_slices(slice, n, &o, SOLIDS[i].name), b = loft_slices(turned, n, &o, SOLIDS[i].name);
            assert_int_equal(a.facts.genus, b.facts.genus);
            assert_true(fabs(a.facts.volume / b.facts.volume - 1) < 1e-3);
            il_mesh_free(&a.mesh);
            il_mesh_free(&b.mesh);
            free_slices(slice, n);
            free_slices(turned, n);
        }
}

/* A slice without anything ends two solids; what lies beyond it bends neither. */
static void an_empty_slice_inside_ends_what_is_bent(void **state)
{
    (void)state;
    for (int between = -1; between <= 3; between += 4) {
        il_slice slice[7];
        for (int i = 0; i < 7; i++) {
            slice[i] = i == 3 ? (il_slice)IL_SLICE_INIT : circle(i, i, 0, i < 3 ? 8 - i * i : i, 40);
            slice[i].z = i;
        }
        keeper k = loft_between(slice, 7, between, "empty");
        assert_int_equal(k.facts.components, 2);
        for (size_t v = 0; v < k.mesh.n_vertices; v++)
            assert_true(k.mesh.xyz[3 * v + 2] != 3);
        il_mesh_free(&k.mesh);
        free_slices(slice, 7);
    }
}

/* ---- ends -------------------------------------------------------------------------------------------- */

/* The least and the greatest height of SLICE[N] with ends that follow. */
static void find_ends(const il_slice *slice, size_t n, il_cap cap, double end[2])
{
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    o.cap = cap;
    keeper k = loft_slices(slice, n, &o, "ends");
    end[0] = INFINITY, end[1] = -INFINITY;
    for (size_t v = 0; v < k.mesh.n_vertices; v++)
        end[0] = fmin(end[0], k.mesh.xyz[3 * v + 2]), end[1] = fmax(end[1], k.mesh.xyz[3 * v + 2]);
    il_mesh_free(&k.mesh);
}

static void ends_of_a_sphere_are_nearer_than_flat_or_half_a_spacing(void **state)
{
    (void)state;
    for (double high = 9; high < 9.65; high += 0.2) {
        il_slice slice[MOST];
        round_solid s = SOLIDS[0];
        double follow[2], dome[2];
        s.low = -high, s.high = high;
        size_t n = cut_solid(&s, 14, slice);
        double half = (slice[1].z - slice[0].z) / 2;
        find_ends(slice, n, IL_CAP_AUTO, follow);
        find_ends(slice, n, IL_CAP_DOME, dome);
        for (int side = 0; side < 2; side++) {
            double is = fabs(follow[side]), no_end = high, half_end = fabs(dome[side]);
            assert_true(is > high && is <= high + half + 1e-9);
            assert_true(fabs(is - 10) <= fmin(fabs(no_end - 10), fabs(half_end - 10)) + 1e-6);
        }
        free_slices(slice, n);
    }
}

static void upright_walls_end_as_domes_of_half_a_spacing(void **state)
{
    (void)state;
    il_slice slice[3] = { circle(0, 0, 0, 9, 90), circle(2, 0, 0, 9, 90), circle(3, 0, 0, 9, 90) };
    double end[2];
    find_ends(slice, 3, IL_CAP_AUTO, end);
    assert_true(end[0] >= -1 && end[0] < -.97);
    assert_true(end[1] <= 3.5 && end[1] > 3.48);
    free_slices(slice, 3);
}

/* What is lower than half a spacing is not drawn out: r (sqrt(1 + s^2) + s). */
static void the_flatter_it_comes_the_lower_is_the_end(void **state)
{
    (void)state;
    double before = 1;
    for (double fall = 2; fall < 16; fall *= 1.5) {
        il_slice slice[3] = { circle(0, 0, 0, 1 + 2 * fall, 90), circle(1, 0, 0, 1 + fall, 90), circle(2, 0, 0, 1, 90) };
        double end[2];
        find_ends(slice, 3, IL_CAP_AUTO, end);
        double is = end[1] - 2, expected = sqrt(1 + fall * fall) - fall;
        assert_true(is > 0 && is < before);
        assert_true(fabs(is / expected - 1) < 0.01);
        before = is;
        free_slices(slice, 3);
    }
}

/* A ring's end is a round ridge: as high as half its width, and the hole goes on through it. */
static void a_tubes_end_is_a_ridge_about_its_hole(void **state)
{
    (void)state;
    il_slice slice[3];
    double end[2];
    for (int i = 0; i < 3; i++) {
        slice[i] = circle(10 * i, 0, 0, 9, 90);
        add_circle(&slice[i], 0, 0, 5, 60);
    }
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    o.cap = IL_CAP_AUTO;
    keeper k = loft_slices(slice, 3, &o, "tube");
    assert_int_equal(k.facts.genus, 1);
    il_mesh_free(&k.mesh);
    find_ends(slice, 3, IL_CAP_AUTO, end);
    assert_true(end[1] > 21.8 && end[1] < 22.2);
    assert_true(end[0] < -1.8 && end[0] > -2.2);
    free_slices(slice, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_strips_are_nearer_to_round_solids),
        cmocka_unit_test(cones_and_slanted_cylinders_stay_what_they_are),
        cmocka_unit_test(as_many_contours_are_put_in_as_are_asked_for),
        cmocka_unit_test(the_contours_put_in_follow_the_tolerance),
        cmocka_unit_test(neighbours_are_bent_less_but_never_into_each_other),
        cmocka_unit_test(any_stack_is_certified_whatever_is_put_in),
        cmocka_unit_test(threads_do_not_change_what_is_bent),
        cmocka_unit_test(upside_down_a_round_solid_has_the_same_volume),
        cmocka_unit_test(an_empty_slice_inside_ends_what_is_bent),
        cmocka_unit_test(ends_of_a_sphere_are_nearer_than_flat_or_half_a_spacing),
        cmocka_unit_test(upright_walls_end_as_domes_of_half_a_spacing),
        cmocka_unit_test(the_flatter_it_comes_the_lower_is_the_end),
        cmocka_unit_test(a_tubes_end_is_a_ridge_about_its_hole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
