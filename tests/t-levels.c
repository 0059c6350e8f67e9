/* t-levels.c - slabs cut by planes between their slices. */
#include "config.h"
#include "base/alloc.h"
#include "loft/levels.h"
#include "slabs.h"
#include "test.h"

#include <math.h>
#include <string.h>

/* Moves nothing. */
static void stay(const void *self, size_t a, size_t b, double f, double p[3])
{
    (void)self, (void)a, (void)b, (void)f, (void)p;
}

/* N levels in T, evenly. */
static size_t set_levels(const test_slab *t, size_t n, double *level)
{
    double z = t->section[0].z, height = t->section[1].z - z;
    for (size_t k = 0; k < n; k++)
        level[k] = z + height * (double)(k + 1) / (double)(n + 1);
    return n;
}

/* T cut by LEVEL[N]; parent is the caller's. */
static il_surface cut(const test_slab *t, const double *level, size_t n, il_levels_mover *move, const void *self, uint32_t **parent)
{
    il_error err = IL_ERROR_INIT;
    il_surface out = IL_SURFACE_INIT;
    double *xyz = il_surface_positions(&t->slab.surface, &t->section[0], &t->section[1]);
    il_levels l = { &t->slab.surface, { &t->section[0], &t->section[1] }, xyz, level, n, move, self };
    assert_non_null(xyz);
    assert_int_equal(il_levels_cut(&out, parent, &l, &err), IL_OK);
    il_free(xyz);
    return out;
}

static void corners(const test_slab *t, const il_surface *s, size_t k, double p[3][3])
{
    for (size_t c = 0; c < 3; c++)
        il_surface_position(s, &t->section[0], &t->section[1], s->tri[3 * k + c], p[c]);
}

/* Half of the cross product of two sides. */
static void area_of(double p[3][3], double to[3])
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++)
        u[k] = p[1][k] - p[0][k], v[k] = p[2][k] - p[0][k];
    to[0] = (u[1] * v[2] - u[2] * v[1]) / 2;
    to[1] = (u[2] * v[0] - u[0] * v[2]) / 2;
    to[2] = (u[0] * v[1] - u[1] * v[0]) / 2;
}

/* The parts of each triangle have its area together, on its side; none is without area. */
static void assert_parts(const test_slab *t, const il_surface *s, const uint32_t *parent)
{
    const il_surface *whole = &t->slab.surface;
    double *left = il_alloc(whole->n_triangles, 3 * sizeof *left), p[3][3], area[3];
    assert_non_null(left);
    for (size_t k = 0; k < whole->n_triangles; k++) {
        corners(t, whole, k, p);
        area_of(p, left + 3 * k);
    }
    for (size_t k = 0; k < s->n_triangles; k++) {
        assert_true(parent[k] < whole->n_triangles);
        corners(t, s, k, p);
        area_of(p, area);
        for (size_t i = 0; i < 3; i++)
            left[3 * parent[k] + i] -= area[i];
    }
    for (size_t i = 0; i < 3 * whole->n_triangles; i++)
        assert_true(fabs(left[i]) < 1e-9);
    il_free(left);
}

/* No triangle of S reaches through a level, and every new vertex stands on one, bit for bit. */
static void assert_between_levels(const test_slab *t, const il_surface *s, const double *level, size_t n)
{
    for (size_t k = 0; k < s->n_triangles; k++) {
        double p[3][3];
        corners(t, s, k, p);
        for (size_t i = 0; i < n; i++)
            assert_true(!(fmin(fmin(p[0][2], p[1][2]), p[2][2]) < level[i] && fmax(fmax(p[0][2], p[1][2]), p[2][2]) > level[i]));
    }
    for (size_t v = t->slab.surface.n_inner; v < s->n_inner; v++) {
        bool found = false;
        for (size_t i = 0; i < n; i++)
            found = found || s->inner[3 * v + 2] == level[i];
        assert_true(found);
    }
}

static void assert_cut(const test_slab *t, size_t n)
{
    double level[IL_LEVELS_MOST];
    uint32_t *parent = NULL;
    il_error err = IL_ERROR_INIT;
    il_verdict v;
    il_surface s = cut(t, level, set_levels(t, n, level), stay, NULL, &parent);
    assert_int_equal(il_certify_edges(&s, &t->section[0], &t->section[1], &v, &err), IL_OK);
    assert_int_equal(v.flaw, IL_FLAW_NONE);
    assert_parts(t, &s, parent);
    assert_between_levels(t, &s, level, n);
    assert_memory_equal(s.inner, t->slab.surface.inner, 3 * t->slab.surface.n_inner * sizeof *s.inner);
    if (n == 0)
        assert_int_equal(s.n_triangles, t->slab.surface.n_triangles);
    il_surface_free(&s);
    il_free(parent);
}

static void a_cut_surface_is_the_same_surface_in_parts(void **state)
{
    (void)state;
    static const size_t n[] = { 0, 1, 2, 3, 7, IL_LEVELS_MOST };
    static const stack_kind kind[] = { STACK_EQUAL, STACK_UNRELATED, STACK_FRAME, STACK_SLIDING, STACK_TANGLED };
    for (size_t k = 0; k < sizeof kind / sizeof *kind; k++)
        for (uint64_t seed = 1; seed <= 6; seed++) {
            il_slice slice[6];
            size_t n_slices = stack_make(kind[k], seed, slice);
            test_slab t = new_slab(slice, seed % 2 == 0);
            for (size_t i = 0; i < sizeof n / sizeof *n && t.slab.verdict.multiple == 0; i++)
                assert_cut(&t, n[i]);
            free_slab(&t);
            free_slices(slice, n_slices);
        }
}

/* A level through an inner point cuts there and makes no second point beside it. */
static void a_level_through_inner_points_goes_through_them(void **state)
{
    (void)state;
    il_slice slice[2] = { circle(0, 0, 0, 3, 12), circle(1, 9, 0, 3, 12) }; /* apart: two domes */
    test_slab t = new_slab(slice, false);
    assert_true(t.slab.surface.n_inner > 0);
    for (size_t i = 0; i < t.slab.surface.n_inner; i++) {
        uint32_t *parent = NULL;
        double level = t.slab.surface.inner[3 * i + 2];
        il_error err = IL_ERROR_INIT;
        il_verdict v;
        il_surface s = cut(&t, &level, 1, stay, NULL, &parent);
        assert_int_equal(il_certify(&s, &t.section[0], &t.section[1], &v, &err), IL_OK);
        assert_int_equal(v.flaw, IL_FLAW_NONE);
        assert_parts(&t, &s, parent);
        assert_between_levels(&t, &s, &level, 1);
        il_surface_free(&s);
        il_free(parent);
    }
    free_slab(&t);
    free_slices(slice, 2);
}

/* Each point once, with the edge that it lies on, and the points of no contour. */
typedef struct movings { const test_slab *t; size_t *n; } movings;

static void check_moving(const void *self, size_t a, size_t b, double f, double p[3])
{
    const movings *m = self;
    const il_surface *s = &m->t->slab.surface;
    double *xyz = il_surface_positions(s, &m->t->section[0], &m->t->section[1]);
    size_t n_nodes = m->t->section[0].n_nodes + m->t->section[1].n_nodes;
    assert_non_null(xyz);
    assert_true(a < n_nodes + s->n_inner && b < n_nodes + s->n_inner && f >= 0 && f <= 1);
    for (size_t k = 0; k < 3; k++)
        assert_true(fabs(xyz[3 * a + k] + f * (xyz[3 * b + k] - xyz[3 * a + k]) - p[k]) < 1e-9);
    assert_true(a != b || a >= n_nodes);
    ++*m->n;
    p[0] += 1e-3;
    il_free(xyz);
}

static void every_point_but_the_contours_is_moved_once(void **state)
{
    (void)state;
    il_slice slice[2] = { circle(0, 0, 0, 5, 20), circle(1, 1, 0, 5, 20) };
    add_circle(&slice[1], 0, 0, 1, 8); /* a hole that begins: with inner points */
    test_slab t = new_slab(slice, false);
    double level[3];
    uint32_t *parent = NULL;
    size_t n = 0;
    movings m = { &t, &n };
    il_surface straight = cut(&t, level, set_levels(&t, 3, level), stay, NULL, &parent);
    il_free(parent);
    il_surface moved = cut(&t, level, 3, check_moving, &m, &parent);
    assert_int_equal(n, moved.n_inner);
    assert_int_equal(straight.n_inner, moved.n_inner);
    for (size_t i = 0; i < moved.n_inner; i++)
        assert_true(moved.inner[3 * i] == straight.inner[3 * i] + 1e-3);
    il_free(parent);
    il_surface_free(&straight);
    il_surface_free(&moved);
    free_slab(&t);
    free_slices(slice, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cut_surface_is_the_same_surface_in_parts),
        cmocka_unit_test(a_level_through_inner_points_goes_through_them),
        cmocka_unit_test(every_point_but_the_contours_is_moved_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
