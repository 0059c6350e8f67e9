#include "config.h"
#include "base/alloc.h"
#include "contours.h"
#include "match/frame.h"
#include "matching.h"
#include "model/lattice.h"

enum { SIDE_RINGS = 3 };

/* One group of some rings of two slices; the others are to be ignored. */
typedef struct scene {
    il_slice slice[2];
    uint32_t ring[2][SIDE_RINGS];
    il_group group;
} scene;

static void place_group(scene *s, size_t n_lower, size_t n_upper)
{
    s->group = (il_group){ .lower = s->ring[0], .upper = s->ring[1], .n_lower = n_lower, .n_upper = n_upper };
}

/* Coordinates are multiples of 1/1024 below 8 + 1: they can be moved and scaled exactly.
 * The last ring of each slice is far out and in no group;
 * place_group comes next. */
static scene random_scene(uint64_t *seed)
{
    scene s = { .slice = { IL_SLICE_INIT, IL_SLICE_INIT } };
    double wide = random_between(seed, .01, 8), high = random_between(seed, .01, 8);
    for (int side = 0; side < 2; side++)
        for (uint32_t r = 0; r < SIDE_RINGS; r++) {
            il_ring *ring = il_slice_add_ring(&s.slice[side]);
            assert_non_null(ring);
            s.ring[side][r] = r;
            for (uint64_t n = 3 + stack_random(seed) % 9; n > 0; n--) {
                double x = floor(1024 * wide * stack_uniform(seed)) / 1024, y = floor(1024 * high * stack_uniform(seed)) / 1024;
                assert_true(il_ring_add(ring, r + 1 < SIDE_RINGS ? x + 1 / 1024. * (double)n : -100, y, 0));
            }
        }
    return s;
}

static void free_scene(scene *s)
{
    il_slice_free(&s->slice[0]);
    il_slice_free(&s->slice[1]);
}

static il_frame frame_of(const scene *s)
{
    return il_frame_about(&s->group, &s->slice[0], &s->slice[1]);
}

/* Every coordinate v to scale * v + (dx, dy). */
static void transform(scene *s, double scale, double dx, double dy)
{
    for (int side = 0; side < 2; side++)
        for (size_t r = 0; r < s->slice[side].n; r++)
            for (size_t k = 0; k < 2 * s->slice[side].ring[r].n; k++) {
                double *v = &s->slice[side].ring[r].xy[k];
                *v = scale * *v + (k % 2 ? dy : dx);
            }
}

typedef struct cells {
    double *xy;
    uint32_t *next;
    size_t n;
} cells;

static cells outline_of(const scene *s, const il_frame *f, int side)
{
    cells c = { NULL, NULL, 0 };
    const il_group *g = &s->group;
    assert_int_equal(il_frame_outline(f, &s->slice[side], side ? g->upper : g->lower, side ? g->n_upper : g->n_lower,
                                      &c.xy, &c.next, &c.n, NULL), IL_OK);
    return c;
}

static void free_cells(cells *c)
{
    il_free(c->xy);
    il_free(c->next);
}

/* A power of two a cell, at most 256 of them, and all points with 15 % of the
 * longer side around them. */
static void assert_frame(const scene *s, const il_frame *f)
{
    int exponent;
    double least[2] = { INFINITY, INFINITY }, most[2] = { -INFINITY, -INFINITY };
    assert_true(frexp(f->cell, &exponent) == .5 && isfinite(f->x) && isfinite(f->y));
    assert_true(f->cells_x >= 1 && f->cells_y >= 1 && f->cells_x <= 256 && f->cells_y <= 256);
    assert_true(f->cells_x >= 127 || f->cells_y >= 127); /* no coarser than it must be */
    for (int side = 0; side < 2; side++) {
        cells c = outline_of(s, f, side);
        for (size_t k = 0; k < 2 * c.n; k++) {
            least[k % 2] = fmin(least[k % 2], c.xy[k]);
            most[k % 2] = fmax(most[k % 2], c.xy[k]);
        }
        free_cells(&c);
    }
    double longer = fmax(most[0] - least[0], most[1] - least[1]), margin = .15 * longer - 1e-9;
    assert_true(least[0] >= margin && least[1] >= margin);
    assert_true(most[0] <= f->cells_x - margin && most[1] <= f->cells_y - margin);
}

static void a_frame_is_fine_and_leaves_its_margin(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int round = 0; round < 3000; round++) {
        scene s = random_scene(&seed);
        place_group(&s, 1 + stack_random(&seed) % 2, 1 + stack_random(&seed) % 2);
        transform(&s, random_between(&seed, .001, 1000), 0, 0);
        il_frame f = frame_of(&s);
        assert_frame(&s, &f);
        free_scene(&s);
    }
}

static void rings_are_laid_one_behind_the_other(void **state)
{
    (void)state;
    scene s = { .slice = { slice_of("0 0, 8 0, 8 8; 1 1, 5 1, 5 5, 1 5"), slice_of("0 0, 4 0, 0 4; 2 2, 3 2, 3 3") } };
    s.ring[0][0] = 1, s.ring[0][1] = 0, s.ring[1][0] = 1;
    place_group(&s, 2, 1);
    il_frame f = frame_of(&s);
    cells lower = outline_of(&s, &f, 0), upper = outline_of(&s, &f, 1);
    static const uint32_t next[] = { 1, 2, 3, 0, 5, 6, 4 };
    static const double at[] = { 1, 1, 5, 1, 5, 5, 1, 5, 0, 0, 8, 0, 8, 8 };
    assert_int_equal(lower.n, 7);
    assert_int_equal(upper.n, 3);
    assert_memory_equal(lower.next, next, sizeof next);
    assert_true(f.cell == .0625 && f.x == 0 && f.y == 0); /* 10.4 / 254 = 0.041 */
    for (int k = 0; k < 14; k++)
        assert_true(lower.xy[k] == at[k] / f.cell + f.margin);
    free_cells(&lower);
    free_cells(&upper);
    free_scene(&s);
}

static void assert_same_cells(const scene *a, const scene *b, double scale, double dx, double dy)
{
    il_frame f = frame_of(a), g = frame_of(b);
    assert_true(g.cell == scale * f.cell && g.margin == f.margin && g.cells_x == f.cells_x && g.cells_y == f.cells_y);
    assert_true(g.x == scale * f.x + dx && g.y == scale * f.y + dy);
    for (int side = 0; side < 2; side++) {
        cells p = outline_of(a, &f, side), q = outline_of(b, &g, side);
        assert_int_equal(p.n, q.n);
        assert_memory_equal(p.xy, q.xy, 2 * p.n * sizeof *p.xy);
        free_cells(&p);
        free_cells(&q);
    }
}

static void moving_and_scaling_exactly_keeps_every_bit(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int round = 0; round < 300; round++) {
        scene s = random_scene(&seed), t = { .slice = { IL_SLICE_INIT, IL_SLICE_INIT } };
        double scale = ldexp(1, (int)(stack_random(&seed) % 181) - 90);
        double dx = floor(random_between(&seed, -1e9, 1e9)) * scale, dy = floor(random_between(&seed, -1e9, 1e9)) * scale;
        for (int side = 0; side < 2; side++) {
            assert_int_equal(il_slice_copy(&t.slice[side], &s.slice[side], NULL), IL_OK);
            memcpy(t.ring[side], s.ring[side], sizeof s.ring[side]);
        }
        place_group(&s, 2, 2);
        place_group(&t, 2, 2);
        transform(&t, scale, dx, dy);
        assert_same_cells(&s, &t, scale, dx, dy);
        free_scene(&s);
        free_scene(&t);
    }
}

static void extreme_slices_have_frames(void **state)
{
    (void)state;
    static const char *const text[] = {
        "0 0, 1e-30 0, 1e-30 1e-30", "0 0, 1e-40 0, 0 1e-40", "-9e14 -9e14, 9e14 -9e14, 9e14 9e14",
        "999999999999999 0, 999999999999999.125 0, 999999999999999.125 1", "0 0, 1e14 1e-30, 1e14 2e-30",
        "5 0, 5 1, 5 2", "0 7, 3 7, 9 7", "1e-300 0, 1 0, 1 1e-300" };
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        scene s = { .slice = { slice_of(text[k]), slice_of(text[k]) } };
        place_group(&s, 1, 1);
        il_frame f = frame_of(&s);
        assert_frame(&s, &f);
        il_fit fit = { .global = { 1, 0, 0, 1, 0, 0 } };
        il_frame_scale_fit(&f, &fit);
        assert_true(fit.global[0] == 1 && fit.global[3] == 1 && fit.global[4] == 0 && fit.global[5] == 0);
        assert_true(fit.box[0] < fit.box[2] && fit.box[1] < fit.box[3]); /* as the format wants it */
        free_scene(&s);
    }
}

/* The fit in the stack's unit does to a point what the one in cells does to its cells. */
static void a_scaled_fit_moves_as_it_did_in_cells(void **state)
{
    (void)state;
    uint64_t seed = 3;
    il_frame f = { -37.5, 1200.25, .125, 30, 250, 180 };
    double in_cells[2 * 20 * 15], scaled[2 * 20 * 15];
    for (size_t k = 0; k < sizeof in_cells / sizeof *in_cells; k++)
        in_cells[k] = scaled[k] = random_between(&seed, -6, 6);
    il_lattice a = { 20, 15, -16, -16, 16, in_cells, 300, 0 }, b = { 20, 15, -16, -16, 16, scaled, 300, 0 };
    il_fit was = { 1, 2, 3, 4, .5, .25, 1, { 1.25, .25, -.125, .75, 12, -9 }, { 0, 0, 250, 180 }, &a, 1, 1 }, is = was;
    is.lattice = &b;
    il_frame_scale_fit(&f, &is);
    for (int k = 0; k < 200; k++) {
        double p[2] = { random_between(&seed, -40, -10), random_between(&seed, 1198, 1215) }, q[2], at[2];
        il_frame_to_cells(&f, p, q);
        il_fit_apply(&was, q, 1);
        il_fit_apply(&is, p, 1);
        il_frame_to_cells(&f, p, at);
        assert_near(at[0], q[0], 1e-9);
        assert_near(at[1], q[1], 1e-9);
    }
    assert_true(is.residual_up_mean == .125 && is.residual_up_max == .25 && is.residual_down_mean == .375 && is.residual_down_max == .5);
    assert_true(is.least_jacobian == .5 && is.distortion == .25); /* these have no unit */
    double corner[2] = { is.box[0], is.box[1] }, other[2] = { is.box[2], is.box[3] }, at[2];
    il_frame_to_cells(&f, corner, at);
    assert_true(at[0] == 0 && at[1] == 0);
    il_frame_to_cells(&f, other, at);
    assert_true(at[0] == 250 && at[1] == 180);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_is_fine_and_leaves_its_margin),
        cmocka_unit_test(rings_are_laid_one_behind_the_other),
        cmocka_unit_test(moving_and_scaling_exactly_keeps_every_bit),
        cmocka_unit_test(extreme_slices_have_frames),
        cmocka_unit_test(a_scaled_fit_moves_as_it_did_in_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
