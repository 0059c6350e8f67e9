#include "config.h"
#include "base/alloc.h"
#include "match/distance-private.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>

/* ---- shapes ---- */

/* Rings in a raster, built up by add_..., freed by free_shape. */
typedef struct shape {
    double *xy;
    uint32_t *next;
    size_t n;
} shape;

static void free_shape(shape *s)
{
    free(s->xy);
    free(s->next);
    *s = (shape){ 0 };
}

/* A ring of N vertices more; where they lie is the caller's. */
static double *add_ring(shape *s, size_t n)
{
    s->xy = realloc(s->xy, (s->n + n) * 2 * sizeof *s->xy);
    s->next = realloc(s->next, (s->n + n) * sizeof *s->next);
    for (size_t i = 0; i < n; i++)
        s->next[s->n + i] = (uint32_t)(s->n + (i + 1) % n);
    s->n += n;
    return s->xy + 2 * (s->n - n);
}

/* Radius r (1 + depth cos(waves a)); N negative: the other way round. */
static void add_star(shape *s, int n, double x, double y, double r, double depth, double waves)
{
    double *xy = add_ring(s, (size_t)abs(n));
    for (int i = 0; i < abs(n); i++) {
        double a = 2 * acos(-1) * i / n, at = r * (1 + depth * cos(waves * a));
        xy[2 * i] = x + at * cos(a);
        xy[2 * i + 1] = y + at * sin(a);
    }
}

static double random_in(uint64_t *seed, double from, double to)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return from + (to - from) * (double)(*seed >> 40) / 0x1p24;
}

/* Any vertices: edges as long as the raster, crossing each other. */
static void add_tangle(shape *s, size_t n, uint64_t *seed, double cells_x, double cells_y)
{
    double *xy = add_ring(s, n);
    for (size_t i = 0; i < n; i++) {
        xy[2 * i] = random_in(seed, 0, cells_x);
        xy[2 * i + 1] = random_in(seed, 0, cells_y);
    }
}

/* Each of N vertices twice: every other edge has no length. */
static void add_doubled(shape *s, size_t n, double x, double y, double r)
{
    double *xy = add_ring(s, 2 * n);
    for (size_t i = 0; i < 2 * n; i++) {
        double a = 2 * acos(-1) * (double)(i / 2) / (double)n;
        xy[2 * i] = x + r * cos(a);
        xy[2 * i + 1] = y + r * sin(a);
    }
}

static shape rectangle(double x0, double y0, double x1, double y1)
{
    shape s = { 0 };
    double *xy = add_ring(&s, 4);
    const double corner[8] = { x0, y0, x1, y0, x1, y1, x0, y1 };
    for (int i = 0; i < 8; i++)
        xy[i] = corner[i];
    return s;
}

/* ---- the same by brute force ---- */

static double distance_to(const shape *s, size_t i, double x, double y, double *t)
{
    const double *a = s->xy + 2 * i, *b = s->xy + 2 * (size_t)s->next[i];
    double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    double at = length2 > 0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / length2 : 0;
    at = fmin(fmax(at, 0), 1);
    if (t)
        *t = at;
    return hypot(a[0] + at * dx - x, a[1] + at * dy - y);
}

static bool is_inside(const shape *s, double x, double y)
{
    bool inside = false;
    for (size_t i = 0; i < s->n; i++) {
        const double *a = s->xy + 2 * i, *b = s->xy + 2 * (size_t)s->next[i];
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]))
            inside = !inside;
    }
    return inside;
}

static double brute(const shape *s, double x, double y)
{
    double least = INFINITY;
    for (size_t i = 0; i < s->n; i++)
        least = fmin(least, distance_to(s, i, x, y, NULL));
    return is_inside(s, x, y) ? least : -least;
}

/* ---- what the map says ---- */

static float phi_at(il_distance *d, float x, float y)
{
    float phi, gx, gy;
    il_distance_sample(d, &x, &y, 1, &phi, &gx, &gy);
    return phi;
}

static void begin(il_distance *d, const shape *s, uint32_t cells_x, uint32_t cells_y)
{
    assert_int_equal(il_distance_begin(d, s->xy, s->next, s->n, cells_x, cells_y, NULL), IL_OK);
}

/* Every STEP-th node of the map against brute force; signs where they are not in doubt. */
static void check_nodes(il_distance *d, const shape *s, uint32_t cells_x, uint32_t cells_y, uint32_t step)
{
    for (uint32_t j = 0; j <= cells_y; j += step)
        for (uint32_t i = 0; i <= cells_x; i += step) {
            double is = phi_at(d, (float)i, (float)j), must = brute(s, i, j);
            if (fabs(must) < 1e-9)
                must = 0, is = fabs(is);
            if (!(fabs(is - must) < (fabs(must) < 256 ? 1e-5 : 2e-5))) /* then a float has no more places */
                fail_msg("(%u, %u) of %zu segments: %.9g instead of %.9g", i, j, s->n, is, must);
        }
}

/* Phi, labels and feet of SHAPE, which it frees. */
static void check(shape s, uint32_t cells_x, uint32_t cells_y, uint32_t step)
{
    il_distance d = IL_DISTANCE_INIT;
    begin(&d, &s, cells_x, cells_y);
    check_nodes(&d, &s, cells_x, cells_y, step);
    uint64_t seed = s.n;
    for (int k = 0; k < 500; k++) {
        float x = (float)random_in(&seed, 0, cells_x), y = (float)random_in(&seed, 0, cells_y);
        il_foot f = il_distance_foot(&d, x, y);
        double t, own = distance_to(&s, f.segment, x, y, &t), must = fabs(brute(&s, x, y));
        assert_true(fabs(own - must) < 1e-5 && fabs(f.distance - must) < 2e-5);
        const double *a = s.xy + 2 * (size_t)f.segment, *b = s.xy + 2 * (size_t)s.next[f.segment];
        assert_true(fabs(f.t - t) * hypot(b[0] - a[0], b[1] - a[1]) < 1e-4);
    }
    il_distance_free(&d);
    free_shape(&s);
}

static void it_is_the_distance_to_the_nearest_segment(void **state)
{
    (void)state;
    uint64_t seed = 1;
    shape s = { 0 };
    add_star(&s, 256, 128.3, 127.9, 80, 0, 0);
    check(s, 256, 256, 3);
    s = (shape){ 0 };
    add_star(&s, 200, 100, 120, 70, 0.4, 5);
    check(s, 256, 200, 3);
    for (size_t n = 3; n < 200; n *= 3) {
        s = (shape){ 0 };
        add_tangle(&s, n, &seed, 256, 256);
        check(s, 256, 256, 3);
    }
    s = (shape){ 0 };
    add_star(&s, 64, 12, 10, 5, 0.2, 3);
    check(s, 256, 256, 3); /* the rest is far away */
}

static void nested_rings_change_sides_each(void **state)
{
    (void)state;
    shape s = { 0 };
    for (int k = 0; k < 6; k++)
        add_star(&s, k % 2 ? -90 : 90, 64, 64, 60 - 9 * k, 0.05, k);
    add_star(&s, -40, 120, 120, 6, 0, 0); /* against the rule: still even-odd */
    check(s, 128, 128, 1);
}

static void thousands_of_segments_are_fine(void **state)
{
    (void)state;
    shape s = { 0 };
    add_star(&s, 1024, 128, 128, 90, 0.3, 9);
    check(s, 256, 256, 5);
    s = (shape){ 0 };
    add_star(&s, 4096, 128, 128, 100, 0, 0); /* all are as near to the middle */
    check(s, 256, 256, 9);
    s = (shape){ 0 };
    add_star(&s, 20000, 128, 128, 70, 0.4, 40);
    check(s, 256, 256, 17);
}

/* The vertices of S in another order: neighbours along a ring are none in memory. */
static shape shuffled(shape s, uint64_t *seed)
{
    shape t = { 0 };
    double *xy = add_ring(&t, s.n);
    uint32_t *to = malloc(s.n * sizeof *to);
    for (size_t i = 0; i < s.n; i++)
        to[i] = (uint32_t)i;
    for (size_t i = s.n - 1; i > 0; i--) {
        size_t k = (size_t)random_in(seed, 0, (double)i + 1);
        uint32_t keep = to[i];
        to[i] = to[k], to[k] = keep;
    }
    for (size_t i = 0; i < s.n; i++) {
        xy[2 * to[i]] = s.xy[2 * i], xy[2 * to[i] + 1] = s.xy[2 * i + 1];
        t.next[to[i]] = to[s.next[i]];
    }
    free(to);
    free_shape(&s);
    return t;
}

static void vertices_in_any_order_make_the_same_map(void **state)
{
    (void)state;
    uint64_t seed = 11;
    shape s = { 0 };
    add_star(&s, 301, 60, 50, 35, 0.2, 6);
    add_star(&s, -77, 60, 50, 12, 0.1, 3);
    check(shuffled(s, &seed), 120, 100, 1);
}

static void segments_without_length_are_points(void **state)
{
    (void)state;
    shape s = { 0 };
    add_doubled(&s, 50, 40, 30, 20);
    check(s, 80, 60, 1);
    s = (shape){ 0 };
    double *xy = add_ring(&s, 1);
    xy[0] = 3.5, xy[1] = 7.25;
    check(s, 20, 20, 1);
    s = (shape){ 0 };
    xy = add_ring(&s, 3);
    for (int i = 0; i < 6; i++)
        xy[i] = 5 + 1e-300 * i;
    check(s, 20, 20, 1);
}

static void rasters_of_any_size_do(void **state)
{
    (void)state;
    static const uint32_t size[][2] = { { 1, 1 }, { 1, 256 }, { 256, 1 }, { 14, 15 }, { 15, 16 }, { 16, 17 },
                                        { 29, 30 }, { 31, 63 }, { 63, 64 }, { 64, 65 }, { 127, 129 }, { 255, 30 } };
    for (size_t k = 0; k < sizeof size / sizeof *size; k++) {
        double x = size[k][0], y = size[k][1];
        shape s = { 0 };
        add_star(&s, 30, x / 2, y / 2, 0.4 * fmin(x, y), 0.3, 4);
        add_star(&s, 9, 0.8 * x, 0.8 * y, 0.3 * fmin(x, y), 0, 0);
        check(s, size[k][0], size[k][1], 1);
    }
}

static void vertices_on_nodes_and_edges_along_rows_keep_the_parity(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int k = 0; k < 50; k++) {
        shape s = { 0 };
        add_tangle(&s, 12, &seed, 20, 20);
        for (size_t i = 0; i < 2 * s.n; i++)
            s.xy[i] = floor(s.xy[i]);
        check(s, 20, 20, 1);
    }
    check(rectangle(0, 0, 20, 20), 20, 20, 1); /* the raster's own border */
    check(rectangle(-3, 5, 40, 9), 20, 20, 1); /* beyond it */
}

static void half_planes_corners_and_discs_are_as_computed(void **state)
{
    (void)state;
    shape s = rectangle(20.25, 20.5, 230, 235);
    il_distance d = IL_DISTANCE_INIT;
    begin(&d, &s, 256, 256);
    for (int i = 0; i <= 20; i++)
        for (int j = 100; j < 150; j++) /* on the left of a line: outside */
            assert_true(fabs(phi_at(&d, (float)i, (float)j) - (i - 20.25)) < 1e-6);
    for (int i = 0; i <= 20; i++)
        for (int j = 0; j <= 20; j++)
            assert_true(fabs(phi_at(&d, (float)i, (float)j) + hypot(20.25 - i, 20.5 - j)) < 1e-5);
    for (int i = 21; i < 60; i++)
        for (int j = 21; j < 60; j++)
            assert_true(fabs(phi_at(&d, (float)i, (float)j) - fmin(i - 20.25, j - 20.5)) < 1e-5);
    free_shape(&s);

    add_star(&s, 1000, 128, 128, 90, 0, 0);
    begin(&d, &s, 256, 256);
    double sagitta = 90 * (1 - cos(acos(-1) / 1000));
    for (int k = 0; k <= 256; k++)
        assert_true(fabs(phi_at(&d, (float)k, 77) - (90 - hypot(k - 128, 77 - 128))) < sagitta + 1e-5);
    il_distance_free(&d);
    free_shape(&s);
}

static void the_labelled_segment_is_a_nearest_one(void **state)
{
    (void)state;
    uint64_t seed = 9;
    shape s = { 0 };
    add_tangle(&s, 40, &seed, 60, 45);
    add_star(&s, 100, 30, 20, 15, 0.2, 5);
    il_distance d = IL_DISTANCE_INIT;
    begin(&d, &s, 60, 45);
    for (uint32_t j = 0; j < 45; j++)
        for (uint32_t i = 0; i < 60; i++) {
            phi_at(&d, (float)i, (float)j);
            uint32_t t = j / IL_TILE_CELLS * d.tiles_x + i / IL_TILE_CELLS;
            size_t at = (size_t)d.slot[t] * IL_TILE_NODES * IL_TILE_NODES
                      + j % IL_TILE_CELLS * IL_TILE_NODES + i % IL_TILE_CELLS;
            assert_true(d.nearest[at] < s.n);
            assert_true(fabs(distance_to(&s, d.nearest[at], i, j, NULL) - fabs(brute(&s, i, j))) < 1e-5);
        }
    assert_int_equal(d.n_tiles_done, 12);
    il_distance_free(&d);
    free_shape(&s);
}

/* Of the candidates in the tile of (X, Y), on the contour, how many a foot there looks at. */
static size_t looked_at(const il_distance *d, float x, float y, size_t *of)
{
    int32_t slot = d->slot[(uint32_t)y / IL_TILE_CELLS * d->tiles_x + (uint32_t)x / IL_TILE_CELLS];
    size_t n = 0, c = d->first[slot];
    *of = d->first[slot + 1] - c;
    for (uint32_t b = d->first_block[slot]; b < d->first_block[slot + 1]; c = d->block[b++].end) {
        const il_distance_block *k = &d->block[b];
        n += x < k->x0 || x > k->x1 || y < k->y0 || y > k->y1 ? 1 : d->block[b].end - c;
    }
    assert_int_equal(c, d->first[slot + 1]);
    return n;
}

/* Half a million vertices in a ring have feet among each other in seconds. */
static void feet_look_at_the_root_of_what_is_in_the_tile(void **state)
{
    (void)state;
    shape s = { 0 };
    il_distance d = IL_DISTANCE_INIT;
    add_star(&s, 100000, 128, 128, 80, 0.2, 5);
    begin(&d, &s, 256, 256);
    for (size_t k = 0; k < s.n; k += 1000) {
        float x = (float)s.xy[2 * k], y = (float)s.xy[2 * k + 1];
        size_t of, n;
        assert_true(il_distance_foot(&d, x, y).distance < 1e-4);
        n = looked_at(&d, x, y, &of);
        assert_true((double)n <= 4 * sqrt((double)of) + 32);
    }
    il_distance_free(&d);
    free_shape(&s);
}

/* phi, d phi/dx, d phi/dy between the nodes around (X, Y), which lies within the raster. */
static void interpolate(const shape *s, double x, double y, uint32_t cells_x, uint32_t cells_y, double *out)
{
    double i = fmin(floor(x), cells_x - 1.), j = fmin(floor(y), cells_y - 1.), u = x - i, v = y - j;
    double a = brute(s, i, j), b = brute(s, i + 1, j), c = brute(s, i, j + 1), e = brute(s, i + 1, j + 1);
    out[0] = (1 - u) * (1 - v) * a + u * (1 - v) * b + (1 - u) * v * c + u * v * e;
    out[1] = (1 - v) * (b - a) + v * (e - c);
    out[2] = (1 - u) * (c - a) + u * (e - b);
}

static void between_nodes_it_is_bilinear_and_beyond_the_border_as_on_it(void **state)
{
    (void)state;
    enum { N = 2003 };
    static float x[N], y[N], phi[N], gx[N], gy[N];
    uint64_t seed = 3;
    shape s = { 0 };
    add_star(&s, 90, 50, 30, 20, 0.3, 3);
    for (int k = 0; k < N; k++)
        x[k] = (float)random_in(&seed, -9, 109), y[k] = (float)random_in(&seed, -9, 79);
    const float edge[][2] = { { 0, 0 }, { 100, 70 }, { 15, 15 }, { 30, 69.5f }, { 99.999f, 3 }, { -0.f, 70 },
                              { 1e30f, -1e30f }, { INFINITY, -INFINITY } };
    for (size_t k = 0; k < sizeof edge / sizeof *edge; k++)
        x[7 * k] = edge[k][0], y[7 * k] = edge[k][1];
    il_distance d = IL_DISTANCE_INIT;
    begin(&d, &s, 100, 70);
    il_distance_sample(&d, x, y, N, phi, gx, gy);
    for (int k = 0; k < N; k++) {
        double must[3], px = fmin(fmax(x[k], 0), 100), py = fmin(fmax(y[k], 0), 70);
        interpolate(&s, px, py, 100, 70, must);
        assert_true(fabs(phi[k] - must[0]) < 2e-5);
        assert_true(fabs(gx[k] - must[1]) < 3e-5 && fabs(gy[k] - must[2]) < 3e-5);
        float one[3]; /* however many are asked for at once */
        il_distance_sample(&d, &x[k], &y[k], 1, &one[0], &one[1], &one[2]);
        assert_true(one[0] == phi[k] && one[1] == gx[k] && one[2] == gy[k]);
        assert_true(fabs(il_distance_foot(&d, x[k], y[k]).distance - fabs(brute(&s, px, py))) < 1e-5);
    }
    float nan = NAN;
    assert_true(isfinite(phi_at(&d, nan, nan)));
    il_distance_sample(&d, NULL, NULL, 0, NULL, NULL, NULL);
    il_distance_free(&d);
    free_shape(&s);
}

static void only_tiles_that_are_looked_at_are_made(void **state)
{
    (void)state;
    shape s = rectangle(50, 50, 200, 200);
    il_distance d = IL_DISTANCE_INIT;
    begin(&d, &s, 256, 256);
    assert_int_equal(d.n_tiles_done, 0);
    phi_at(&d, 14.9f, 14.9f);
    phi_at(&d, 0, 3);
    assert_int_equal(d.n_tiles_done, 1);
    phi_at(&d, 15, 14);
    assert_int_equal(d.n_tiles_done, 2);
    il_distance_foot(&d, 15, 16);
    assert_int_equal(d.n_tiles_done, 3);
    begin(&d, &s, 256, 256);
    assert_int_equal(d.n_tiles_done, 0);
    il_distance_free(&d);
    free_shape(&s);
}

static void a_map_begun_again_knows_nothing_of_the_last(void **state)
{
    (void)state;
    il_distance d = IL_DISTANCE_INIT;
    for (uint32_t k = 0; k < 12; k++) {
        shape s = { 0 };
        uint32_t cells_x = 20 + 97 * k % 200, cells_y = 20 + 61 * k % 190;
        add_star(&s, 5 + (int)(k * 331 % 400), cells_x / 2., cells_y / 3., 9, 0.3, k);
        begin(&d, &s, cells_x, cells_y);
        check_nodes(&d, &s, cells_x, cells_y, 3);
        free_shape(&s);
    }
    il_distance_free(&d);
    il_distance_free(&d);
}

static void without_memory_it_says_so_and_goes_on(void **state)
{
    (void)state;
    shape s = { 0 };
    add_star(&s, 300, 50, 50, 30, 0.3, 7);
    bool failed = true;
    long k = 0, while_sampling = 0;
    for (; failed; k++) {
        il_distance d = IL_DISTANCE_INIT;
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        il_status st = il_distance_begin(&d, s.xy, s.next, s.n, 100, 100, &err);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM && d.failed));
        if (st == IL_OK)
            for (float x = 3; x < 100; x += 15) {
                float y = 100 - x, phi = 1, gx = 1, gy = 1;
                bool before = d.failed;
                il_distance_sample(&d, &x, &y, 1, &phi, &gx, &gy);
                if (d.failed && !before) {
                    while_sampling++;
                    assert_true(phi == 0 && gx == 0 && gy == 0);
                    assert_true(il_distance_foot(&d, x, y).distance == 0);
                }
            }
        il_alloc_test_fail_after(-1);
        failed = d.failed;
        begin(&d, &s, 100, 100); /* with memory again */
        assert_true(fabs(phi_at(&d, 50, 50) - brute(&s, 50, 50)) < 1e-5 && !d.failed);
        il_distance_free(&d);
    }
    assert_true(k > 10 && k < 60 && while_sampling > 3);
    free_shape(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_the_distance_to_the_nearest_segment),
        cmocka_unit_test(nested_rings_change_sides_each),
        cmocka_unit_test(thousands_of_segments_are_fine),
        cmocka_unit_test(vertices_in_any_order_make_the_same_map),
        cmocka_unit_test(segments_without_length_are_points),
        cmocka_unit_test(rasters_of_any_size_do),
        cmocka_unit_test(vertices_on_nodes_and_edges_along_rows_keep_the_parity),
        cmocka_unit_test(half_planes_corners_and_discs_are_as_computed),
        cmocka_unit_test(the_labelled_segment_is_a_nearest_one),
        cmocka_unit_test(feet_look_at_the_root_of_what_is_in_the_tile),
        cmocka_unit_test(between_nodes_it_is_bilinear_and_beyond_the_border_as_on_it),
        cmocka_unit_test(only_tiles_that_are_looked_at_are_made),
        cmocka_unit_test(a_map_begun_again_knows_nothing_of_the_last),
        cmocka_unit_test(without_memory_it_says_so_and_goes_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
