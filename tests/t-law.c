/* t-law.c - heights between the lines of grounds that are known. */
#include "config.h"
#include "terrain/ground.h"
#include "terrain/mean.h"
#include "base/alloc.h"
#include "stacks.h"
#include "terrains.h"
#include "test.h"

#include <math.h>
#include <stdlib.h>

enum { NODES = 61, RANDOM = 60, POINTS = 3 };

typedef double shape(double x, double y);

/* Over [0, 60]^2, in intervals of 1 from 0.5 on: as many levels as there are. */
static double plane(double x, double y) { return 0.1 * x + 0.04 * y + 0.01; }
static double bowl(double x, double y) { return ((x - 31) * (x - 31) + (y - 28) * (y - 28)) / 200 + 0.26; }
static double saddle(double x, double y) { return ((x - 31) * (x - 31) - (y - 28) * (y - 28)) / 160 + 6.03; }
static double hilly(double x, double y) { return 5.013 + 2.5 * sin(x / 7) * cos(y / 9) + 1.1 * sin((x + y) / 4); }
static double rough(double x, double y) { return 5.013 + 2.5 * sin(x / 7) * cos(y / 9) + 1.1 * sin(x * 1.7) * cos(y * 1.3); }

static void terrain_of(terrain *t, shape *of, double interval)
{
    double least = INFINITY, most = -INFINITY;
    *t = (terrain){ .n = { NODES, NODES }, .step = 1 };
    t->z = malloc(NODES * NODES * sizeof *t->z);
    t->falls = calloc((NODES - 1) * (NODES - 1), 1);
    assert_true(t->z && t->falls);
    for (size_t k = 0; k < NODES * NODES; k++) {
        t->z[k] = of((double)(k % NODES), (double)(k / NODES));
        least = fmin(least, t->z[k]), most = fmax(most, t->z[k]);
    }
    for (double z = interval / 2; z < most && t->n_levels < 16; z += interval)
        if (z > least)
            t->level[t->n_levels++] = z;
}

/* A map's law and all that it needs. */
typedef struct map {
    il_slice slice[16];
    size_t n;
    il_stack_head head;
    il_relief_options options;
    il_ground ground;
} map;

/* The map of T under O, x times STRETCH, y shifted up by UP. */
static void map_of(map *m, const terrain *t, il_law_options o, il_unit unit, double stretch, double up)
{
    *m = (map){ .n = t->n_levels, .options = { .placement = IL_PLACEMENT_OPTIONS_INIT, .law = o } };
    m->head.kind = IL_KIND_TERRAIN;
    m->head.unit = unit;
    terrain_contour(t, m->slice);
    for (size_t k = 0; k < m->n; k++)
        for (size_t i = 0; i < m->slice[k].n; i++)
            for (size_t v = 0; v < m->slice[k].ring[i].n; v++) {
                m->slice[k].ring[i].xy[2 * v] *= stretch;
                m->slice[k].ring[i].xy[2 * v + 1] += up;
            }
    m->ground = (il_ground){ .options = &m->options, .head = &m->head, .slice = m->slice, .n_slices = m->n };
    il_error err = IL_ERROR_INIT;
    if (il_ground_make(&m->ground, &err) != IL_OK)
        fail_msg("%s", err.text);
}

static void map_free(map *m)
{
    il_ground_free(&m->ground);
    il_stack_head_free(&m->head);
    terrain_free_slices(m->slice, m->n);
}

/* A point of triangle K by two random numbers. */
static void point_in(const map *m, size_t k, uint64_t *seed, double p[2])
{
    const il_ground *g = &m->ground;
    double u = sqrt(stack_uniform(seed)), v = stack_uniform(seed), w[3] = { 1 - u, u * (1 - v), u * v };
    p[0] = p[1] = 0;
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 2; j++)
            p[j] += w[i] * g->chart.xy[2 * (size_t)g->tin.corner[3 * k + i] + j];
}

static bool is_between_lines(const map *m, uint32_t face)
{
    il_band b = m->ground.bands.band[face];
    return b.low >= 0 && b.high < (int32_t)m->n;
}

/* RMS of the law's error against SHAPE, weighted by area; WITHIN: only between two levels. */
static double error_of(shape *of, double interval, il_law_options o, bool within, double *spread)
{
    terrain t;
    map m;
    uint64_t seed = 1;
    double sum = 0, area = 0;
    terrain_of(&t, of, interval);
    map_of(&m, &t, o, IL_UNIT_M, 1, 0);
    const il_ground *g = &m.ground;
    for (size_t k = 0; k < g->tin.n; k++) {
        double a = il_tin_area2(&g->tin, &g->chart, k), p[2];
        if (g->tin.face[k] == IL_CHART_NONE || (within && !is_between_lines(&m, g->tin.face[k])))
            continue;
        for (int i = 0; i < POINTS; i++) {
            point_in(&m, k, &seed, p);
            double e = il_law_height(&g->law, g->tin.face[k], p[0], p[1]) - of(p[0], p[1]);
            sum += a * e * e, area += a;
        }
    }
    if (spread)
        *spread = g->law.smooth.spread;
    map_free(&m);
    terrain_free(&t);
    return sqrt(sum / area) / interval;
}

static const il_law_options MEAN = { IL_LAW_MEAN, false, 0 }, PLATE = { IL_LAW_PLATE, false, 0 }, STRAIGHT = { IL_LAW_STRAIGHT, false, 0 };

static void a_plane_comes_back(void **state)
{
    (void)state;
    assert_true(error_of(plane, 1, PLATE, true, NULL) < 0.006);
    assert_true(error_of(plane, 1, PLATE, false, NULL) < 0.01);
}

static void smooth_ground_is_nearer_than_by_straight_slopes(void **state)
{
    (void)state;
    static shape *const of[] = { bowl, saddle, hilly };
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        double straight = error_of(of[k], 1, STRAIGHT, false, NULL), plate = error_of(of[k], 1, PLATE, false, NULL);
        double mean = error_of(of[k], 1, MEAN, false, NULL);
        assert_true(plate < 0.6 * straight);
        assert_true(mean < 0.7 * straight);
    }
}

static void rough_ground_is_nearer_by_the_mean_than_by_the_plate(void **state)
{
    (void)state;
    double smooth_spread, rough_spread, mean = error_of(rough, 1, MEAN, false, &rough_spread);
    error_of(bowl, 1, MEAN, false, &smooth_spread);
    assert_true(smooth_spread < 0.5 * rough_spread && smooth_spread >= 0.2 && rough_spread <= 1.4);
    assert_true(mean < 0.97 * error_of(rough, 1, PLATE, false, NULL));
}

/* The levels about a face, of which those beyond the last are an interval away. */
static void levels_of(const map *m, uint32_t face, double z[2])
{
    const il_ground *g = &m->ground;
    il_band b = g->bands.band[face];
    double interval = il_law_interval(&g->law, face);
    z[0] = b.low >= 0 ? g->level_z[b.low] : g->level_z[0] - interval;
    z[1] = b.high < (int32_t)m->n ? g->level_z[b.high] : g->level_z[m->n - 1] + interval;
}

static void heights_stay_strictly_inside_their_bands(void **state)
{
    (void)state;
    static const il_law_options laws[] = { { IL_LAW_MEAN, false, 0 }, { IL_LAW_PLATE, false, 0 }, { IL_LAW_MEAN, true, 10 } };
    size_t n = 0;
    for (uint64_t seed = 0; seed < RANDOM; seed++) {
        terrain t;
        map m;
        uint64_t random = seed;
        terrain_make(&t, seed);
        map_of(&m, &t, laws[seed % 3], IL_UNIT_M, 1, 0);
        const il_ground *g = &m.ground;
        for (size_t k = 0; k < g->tin.n; k++) {
            double p[2], z[2];
            if (g->tin.face[k] == IL_CHART_NONE || il_tin_area2(&g->tin, &g->chart, k) < 1e-9 * t.step * t.step)
                continue;
            levels_of(&m, g->tin.face[k], z);
            point_in(&m, k, &random, p);
            double at = il_law_height(&g->law, g->tin.face[k], p[0], p[1]);
            assert_true(at > z[0] && at < z[1]);
            n++;
        }
        map_free(&m);
        terrain_free(&t);
    }
    assert_true(n > 10000);
}

/* Just beside the middle of each edge of a line, on both sides. */
static void heights_come_down_to_the_lines(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < RANDOM; seed++) {
        terrain t;
        map m;
        terrain_make(&t, seed);
        map_of(&m, &t, seed % 2 ? PLATE : MEAN, IL_UNIT_M, 1, 0);
        const il_ground *g = &m.ground;
        for (size_t e = 0; e < g->chart.n_edges; e++) {
            const double *a = g->chart.xy + 2 * (size_t)g->chart.edge[2 * e], *b = g->chart.xy + 2 * (size_t)g->chart.edge[2 * e + 1];
            double length = il_chart_length(&g->chart, e), off = 1e-7 * t.step;
            if (il_chart_is_frame(&g->chart, e) || length < 1e-3 * t.step)
                continue;
            for (int side = 0; side < 2; side++) {
                uint32_t face = g->tin.side[2 * e + (size_t)side];
                double s = (side ? -off : off) / length;
                double x = (a[0] + b[0]) / 2 - s * (b[1] - a[1]), y = (a[1] + b[1]) / 2 + s * (b[0] - a[0]);
                if (face == IL_CHART_NONE)
                    continue;
                double z = il_law_height(&g->law, face, x, y), interval = il_law_interval(&g->law, face);
                assert_true(fabs(z - g->level_z[g->chart.height[e]]) < 1e-3 * interval);
            }
        }
        map_free(&m);
        terrain_free(&t);
    }
}

/* At 60 degrees north a degree of longitude is half one of latitude. */
static void degrees_are_as_long_as_they_are(void **state)
{
    (void)state;
    terrain t;
    map metres, degrees;
    uint64_t seed = 5;
    terrain_of(&t, hilly, 1);
    map_of(&metres, &t, MEAN, IL_UNIT_M, 1, 0);
    map_of(&degrees, &t, MEAN, IL_UNIT_DEG, 2, 30); /* its middle at 60 */
    const il_ground *g = &metres.ground, *d = &degrees.ground;
    assert_true(fabs(d->law.east - 0.5) < 0.01);
    assert_int_equal(g->tin.n_faces, d->tin.n_faces);
    double worst = 0;
    for (size_t k = 0; k < g->tin.n; k++) {
        double p[2];
        point_in(&metres, k, &seed, p);
        double q[2] = { 2 * p[0], p[1] + 30 };
        for (size_t j = 0; j < d->tin.n; j++) { /* the face that it lies in there */
            const double *c[3];
            bool inside = d->tin.face[j] != IL_CHART_NONE;
            for (size_t i = 0; i < 3; i++)
                c[i] = d->chart.xy + 2 * (size_t)d->tin.corner[3 * j + i];
            for (size_t i = 0; i < 3; i++) {
                const double *a = c[i], *b = c[(i + 1) % 3];
                inside = inside && (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]) >= 0;
            }
            if (inside) {
                double z = il_law_height(&d->law, d->tin.face[j], q[0], q[1]);
                worst = fmax(worst, fabs(z - il_law_height(&g->law, g->tin.face[k], p[0], p[1])));
                break;
            }
        }
    }
    assert_true(worst < 0.05);
    map_free(&metres);
    map_free(&degrees);
    terrain_free(&t);
}

/* The mean by the trapezoidal rule. */
static double mean_by_sums(double u, double s)
{
    enum { STEPS = 200000 };
    double sum = 0, weight = 0;
    for (int k = 0; k <= STEPS; k++) {
        double x = (double)k / STEPS, w = exp(-(x - u) * (x - u) / (2 * s * s)) * (k == 0 || k == STEPS ? 0.5 : 1);
        sum += w * x, weight += w;
    }
    return sum / weight;
}

static void the_mean_is_that_of_a_normal_law_cut_to_the_band(void **state)
{
    (void)state;
    for (double s = 0.01; s < 6; s *= 1.7) {
        double before = 0;
        for (int k = 0; k <= 20; k++) {
            double u = k / 20.0, mean = il_mean_in_band(u, s);
            assert_true(fabs(mean - mean_by_sums(u, s)) < 2e-6);
            assert_true(mean > before && mean < 1);
            before = mean;
        }
    }
    assert_true(il_mean_in_band(0.3, 0) == 0.3 && fabs(il_mean_in_band(0.3, 1e-9) - 0.3) < 1e-9);
    for (double x = 0; x > -40; x -= 0.37)
        assert_true(fabs(il_mean_exp(x) / exp(x) - 1) < 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_comes_back),
        cmocka_unit_test(smooth_ground_is_nearer_than_by_straight_slopes),
        cmocka_unit_test(rough_ground_is_nearer_by_the_mean_than_by_the_plate),
        cmocka_unit_test(heights_stay_strictly_inside_their_bands),
        cmocka_unit_test(heights_come_down_to_the_lines),
        cmocka_unit_test(degrees_are_as_long_as_they_are),
        cmocka_unit_test(the_mean_is_that_of_a_normal_law_cut_to_the_band),
    };
    return cmocka_run_group_tests_name("tests", tests, NULL, NULL);
}
