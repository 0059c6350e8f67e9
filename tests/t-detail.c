/* t-detail.c - the mesh of a map follows its law, and lies flat nowhere. */
#include "config.h"
#include "terrain/detail.h"
#include "base/alloc.h"
#include "terrain/cliff.h"
#include "terrain/ground.h"
#include "stacks.h"
#include "terrains.h"
#include "test.h"

#include <math.h>

enum { TERRAINS = 25, MOST_LEVELS = 16, PLACES = 2000 };

typedef struct scene {
    terrain t;
    il_slice slice[MOST_LEVELS];
    il_stack_head head;
    il_relief_options options;
    il_report report;
    il_ground g;
} scene;

static void scene_make(scene *s, uint64_t seed, double detail)
{
    *s = (scene){ .head = IL_STACK_HEAD_INIT, .report = IL_REPORT_INIT };
    s->options = (il_relief_options){ .placement = IL_PLACEMENT_OPTIONS_INIT, .has_detail = true, .detail = detail };
    s->head.kind = IL_KIND_TERRAIN;
    s->head.unit = IL_UNIT_M;
    terrain_make(&s->t, seed);
    terrain_contour(&s->t, s->slice);
    s->g = (il_ground){ .options = &s->options, .head = &s->head, .slice = s->slice, .n_slices = s->t.n_levels, .report = &s->report };
    assert_int_equal(il_ground_make(&s->g, NULL), IL_OK);
}

static void scene_free(scene *s)
{
    il_ground_free(&s->g);
    il_report_free(&s->report);
    il_stack_head_free(&s->head);
    terrain_free_slices(s->slice, s->t.n_levels);
    terrain_free(&s->t);
}

static double height(const il_ground *g, size_t k)
{
    return il_cliff_z(&g->tin, &g->chart, g->bands.band, k);
}

/* How far triangle T is off the law at weights W of its corners, in intervals. */
static double off_at(const il_ground *g, size_t t, const double w[3])
{
    double x = 0, y = 0, z = 0;
    for (size_t i = 0; i < 3; i++) {
        size_t v = g->tin.corner[3 * t + i];
        x += w[i] * g->chart.xy[2 * v];
        y += w[i] * g->chart.xy[2 * v + 1];
        z += w[i] * height(g, 3 * t + i);
    }
    uint32_t f = g->tin.face[t];
    return fabs(il_law_height(&g->law, f, x, y) - z) / il_law_interval(&g->law, f);
}

/* By area. */
static size_t any_triangle(const il_ground *g, const double *sum, uint64_t *seed)
{
    double at = stack_uniform(seed) * sum[g->tin.n - 1];
    size_t low = 0, high = g->tin.n - 1;
    while (low < high) {
        size_t mid = low + (high - low) / 2;
        low = sum[mid] <= at ? mid + 1 : low;
        high = sum[mid] <= at ? high : mid;
    }
    return low;
}

/* At random places: *SQUARE the mean square of how far the mesh is off, *SHARE of the places that
 * are off by more than TOLERANCE. */
static void look(const il_ground *g, uint64_t seed, double tolerance, double *square, double *share)
{
    double *sum = il_alloc(g->tin.n, sizeof *sum), all = 0;
    assert_non_null(sum);
    for (size_t t = 0; t < g->tin.n; t++)
        sum[t] = all += g->tin.face[t] == IL_CHART_NONE ? 0 : il_tin_area2(&g->tin, &g->chart, t);
    *square = *share = 0;
    for (int i = 0; i < PLACES; i++) {
        double u = stack_uniform(&seed), v = stack_uniform(&seed), a = fmin(u, v), b = fmax(u, v);
        double off = off_at(g, any_triangle(g, sum, &seed), (double[3]){ a, b - a, 1 - b });
        *square += off * off / PLACES;
        *share += (off > tolerance ? 1. : 0.) / PLACES;
    }
    il_free(sum);
}

static void the_mesh_follows_its_law(void **state)
{
    (void)state;
    static const double tolerance[] = { 0.2, 0.05, 0.02 };
    for (size_t k = 0; k < sizeof tolerance / sizeof *tolerance; k++) {
        double square = 0, share = 0, q, s;
        for (uint64_t seed = 0; seed < TERRAINS; seed++) {
            scene at;
            scene_make(&at, seed, tolerance[k]);
            look(&at.g, seed, tolerance[k], &q, &s);
            square += q / TERRAINS;
            share += s / TERRAINS;
            scene_free(&at);
        }
        print_message("tolerance %g: RMS %.4f, %.2f %% beyond\n", tolerance[k], sqrt(square), 100 * share);
        assert_true(sqrt(square) < tolerance[k] / 2);
        assert_true(share < 0.02);
    }
}

/* Of the lines' own points, neither with detail nor without; the law may be flat elsewhere. */
static void next_to_nothing_lies_flat(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 2 * TERRAINS; seed++) {
        scene s;
        double flat = 0, all = 0;
        scene_make(&s, seed / 2, seed % 2 ? 0 : IL_DETAIL_USUAL);
        const il_ground *g = &s.g;
        for (size_t t = 0; t < g->tin.n; t++) {
            double area = g->tin.face[t] == IL_CHART_NONE ? 0 : il_tin_area2(&g->tin, &g->chart, t);
            bool level = area > 0 && height(g, 3 * t) == height(g, 3 * t + 1) && height(g, 3 * t) == height(g, 3 * t + 2);
            for (size_t k = 3 * t; k < 3 * t + 3; k++)
                level = level && g->chart.node[g->tin.corner[k]].level >= 0;
            all += area;
            flat += level ? area : 0;
        }
        assert_true(flat < 1e-3 * all);
        scene_free(&s);
    }
}

/* Every node has a height inside the band of every triangle that it is a corner of. */
static void heights_stay_in_their_bands(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < TERRAINS; seed++) {
        scene s;
        scene_make(&s, seed, 0.02);
        const il_ground *g = &s.g;
        for (size_t k = 0; k < 3 * g->tin.n; k++) {
            if (g->tin.face[k / 3] == IL_CHART_NONE)
                continue;
            il_band b = g->bands.band[g->tin.face[k / 3]];
            bool on_line = g->chart.node[g->tin.corner[k]].level >= 0;
            assert_true(b.low < 0 || height(g, k) > g->level_z[b.low] || (on_line && height(g, k) == g->level_z[b.low]));
            assert_true(b.high >= (int32_t)g->n_slices || height(g, k) < g->level_z[b.high] ||
                        (on_line && height(g, k) == g->level_z[b.high]));
        }
        scene_free(&s);
    }
}

/* Less of a tolerance, more vertices, and never as many as would run away. */
static void less_tolerance_is_more_vertices(void **state)
{
    (void)state;
    static const double tolerance[] = { 0, 1, 0.2, 0.05, 0.01 };
    for (uint64_t seed = 0; seed < TERRAINS; seed++) {
        size_t before = 0;
        for (size_t k = 0; k < sizeof tolerance / sizeof *tolerance; k++) {
            scene s;
            scene_make(&s, seed, tolerance[k]);
            assert_true(s.g.chart.n_nodes >= before);
            before = s.g.chart.n_nodes;
            scene_free(&s);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mesh_follows_its_law),
        cmocka_unit_test(next_to_nothing_lies_flat),
        cmocka_unit_test(heights_stay_in_their_bands),
        cmocka_unit_test(less_tolerance_is_more_vertices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
