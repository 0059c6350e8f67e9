/* t-refine.c - points put into a triangulation leave it a constrained Delaunay one. */
#include "config.h"
#include "terrain/refine.h"
#include "bridge/predicates.h"
#include "stacks.h"
#include "test.h"

#include <math.h>

enum { RINGS = 4, CORNERS = 24, SEEDS = 12, POINTS = 400 };

/* A box about star-shaped rings, one in the other; ring k keeps between radius k + 0.1 and
 * k + 0.9.  level_z is not asked for. */
typedef struct scene {
    il_chart c;
    il_tin t;
    double z[RINGS];
    size_t n_edges;      /* of the chart when it was drawn */
} scene;

static uint32_t add_node(il_chart *c, double x, double y)
{
    uint32_t v = il_chart_node_at(c, x, y);
    assert_true(v != IL_CHART_NONE);
    return v;
}

static void draw_ring(scene *s, int32_t level, uint64_t *seed)
{
    uint32_t first = 0, last = 0;
    for (int k = 0; k < CORNERS; k++) {
        double angle = 2 * 3.141592653589793 * (k + 0.8 * stack_uniform(seed)) / CORNERS, r = level + 0.3 + 0.6 * stack_uniform(seed);
        uint32_t v = add_node(&s->c, r * cos(angle), r * sin(angle));
        il_chart_put_on(&s->c, v, level);
        if (k > 0)
            assert_true(il_chart_add_edge(&s->c, last, v, (uint32_t)level, level));
        first = k == 0 ? v : first;
        last = v;
    }
    assert_true(il_chart_add_edge(&s->c, last, first, (uint32_t)level, level));
}

static void draw_box(scene *s)
{
    static const double corner[4][2] = { { -5, -5 }, { 5, -5 }, { 5, 5 }, { -5, 5 } };
    for (int k = 0; k < 4; k++) {
        const double *p = corner[k], *q = corner[(k + 1) % 4];
        assert_true(il_chart_add_edge(&s->c, add_node(&s->c, p[0], p[1]), add_node(&s->c, q[0], q[1]), IL_CHART_NONE, -1));
    }
}

static void scene_make(scene *s, uint64_t seed)
{
    bool crosses = true;
    *s = (scene){ .c = IL_CHART_INIT, .t = IL_TIN_INIT };
    s->c.level_z = s->z;
    s->c.n_levels = RINGS;
    for (int32_t k = 0; k < RINGS; k++)
        draw_ring(s, k, &seed);
    draw_box(s);
    assert_int_equal(il_tin_build(&s->t, &s->c, &crosses, NULL), IL_OK);
    assert_false(crosses);
    assert_int_equal(s->t.n_faces, RINGS + 1);
    s->n_edges = s->c.n_edges;
}

static void scene_free(scene *s)
{
    il_chart_free(&s->c);
    il_tin_free(&s->t);
}

static const double *place(const scene *s, size_t k)
{
    return s->c.xy + 2 * (size_t)s->t.corner[k];
}

static size_t before(size_t k)
{
    return il_tin_after(il_tin_after(k));
}

/* ---- what must hold --------------------------------------------------------------- */

/* All turn counter-clockwise and fill the box; those across see each other over the same edge. */
static void assert_is_triangulation(const scene *s)
{
    const il_tin *t = &s->t;
    double area = 0;
    for (size_t k = 0; k < 3 * t->n; k++) {
        if (k % 3 == 0) {
            assert_true(il_orientation(place(s, k), place(s, k + 1), place(s, k + 2)) > 0);
            area += il_tin_area2(t, &s->c, k / 3) / 2;
        }
        if (t->across[k] == IL_CHART_NONE)
            continue;
        size_t j = il_tin_twin(t, k);
        assert_true(j < 3 * ((size_t)t->across[k] + 1));
        assert_int_equal(t->corner[j], t->corner[il_tin_after(k)]);
        assert_int_equal(t->corner[il_tin_after(j)], t->corner[k]);
        assert_int_equal(t->edge[j], t->edge[k]);
    }
    assert_true(fabs(area - 100) < 1e-9);
}

/* Each edge of the chart lies between the two faces that it parts, and no other edge parts any. */
static void assert_has_lines(const scene *s)
{
    const il_tin *t = &s->t;
    size_t n = 0;
    for (size_t k = 0; k < 3 * t->n; k++) {
        uint32_t e = t->edge[k], across = t->across[k], f = t->face[k / 3];
        if (e == IL_CHART_NONE) {
            assert_true(across != IL_CHART_NONE);
            assert_int_equal(f, t->face[across]);
            continue;
        }
        bool forward = s->c.edge[2 * e] == t->corner[k];
        assert_int_equal(s->c.edge[2 * e + !forward], t->corner[k]);
        assert_int_equal(s->c.edge[2 * e + forward], t->corner[il_tin_after(k)]);
        assert_int_equal(t->side[2 * e + !forward], f);
        n += across == IL_CHART_NONE || across > k / 3;
    }
    assert_int_equal(n, s->c.n_edges);
    assert_int_equal(n, t->n_sides);
}

/* No corner across an edge that may be flipped lies in the circle of its triangle: then none that
 * it sees does (Lee & Lin 1986). */
static void assert_is_delaunay(const scene *s)
{
    for (size_t k = 0; k < 3 * s->t.n; k++) {
        if (s->t.edge[k] != IL_CHART_NONE || s->t.across[k] == IL_CHART_NONE)
            continue;
        const double *far = place(s, before(il_tin_twin(&s->t, k)));
        assert_true(il_in_circle(place(s, k), place(s, il_tin_after(k)), place(s, before(k)), far) <= 0);
    }
}

/* ---- points ------------------------------------------------------------------------- */

static size_t triangle_at(const scene *s, const double p[2])
{
    for (size_t t = 0; t < s->t.n; t++) {
        bool in = true;
        for (size_t k = 3 * t; k < 3 * t + 3; k++)
            in = in && il_orientation(place(s, k), place(s, il_tin_after(k)), p) >= 0;
        if (in)
            return t;
    }
    fail_msg("no triangle there");
    return 0;
}

static double least_distance(const scene *s, const double p[2], size_t triangle, uint32_t but)
{
    double least = INFINITY;
    for (size_t k = 3 * triangle; k < 3 * triangle + 3; k++)
        least = s->t.corner[k] == but ? least : fmin(least, hypot(place(s, k)[0] - p[0], place(s, k)[1] - p[1]));
    return least;
}

/* The triangles about NODE, as the star tells, and how near their corners are. */
static void assert_star(const scene *s, const il_refine *r, uint32_t node, double clearance)
{
    double least = INFINITY;
    size_t n = 0;
    for (size_t k = 0; k < 3 * s->t.n; k++)
        n += s->t.corner[k] == node;
    assert_int_equal(n, r->n_star);
    for (size_t i = 0; i < r->n_star; i++) {
        assert_int_equal(s->t.corner[3 * r->star[i] + 2], node);
        least = fmin(least, least_distance(s, s->c.xy + 2 * (size_t)node, r->star[i], node));
    }
    assert_true(fabs(least - clearance) <= 1e-12 * least);
}

static void put(scene *s, il_refine *r, const double p[2], size_t *n)
{
    uint32_t node;
    size_t triangle = triangle_at(s, p), nodes = s->c.n_nodes;
    uint32_t face = s->t.face[triangle];
    double clearance = il_refine_clearance(r, triangle, p);
    assert_true(il_refine_insert(r, triangle, p, &node));
    if (node == IL_CHART_NONE) {
        assert_int_equal(s->c.n_nodes, nodes);
        return;
    }
    assert_int_equal(node, nodes);
    assert_int_equal(s->t.face[r->star[0]], face);
    assert_star(s, r, node, clearance);
    ++*n;
}

/* Anywhere, on the middles of edges, and in rows. */
static void points_leave_a_delaunay_triangulation(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        scene s;
        uint64_t at = seed;
        size_t n = 0;
        scene_make(&s, seed);
        il_refine r = il_refine_begin(&s.t, &s.c);
        for (int i = 0; i < POINTS; i++) {
            double p[2] = { 10 * stack_uniform(&at) - 5, 10 * stack_uniform(&at) - 5 };
            size_t k = (size_t)(3 * (double)s.t.n * stack_uniform(&at));
            for (int x = 0; x < 2 && i % 3 > 0; x++)
                p[x] = i % 3 == 1 ? (place(&s, k)[x] + place(&s, il_tin_after(k))[x]) / 2 : round(8 * p[x]) / 8;
            put(&s, &r, p, &n);
        }
        assert_true(n > POINTS / 2);
        assert_int_equal(s.c.n_edges, s.n_edges);
        assert_is_triangulation(&s);
        assert_has_lines(&s);
        assert_is_delaunay(&s);
        il_refine_end(&r);
        scene_free(&s);
    }
}

static void sides_of_the_frame_are_divided(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        scene s;
        uint64_t at = seed;
        size_t n = 0;
        scene_make(&s, seed);
        il_refine r = il_refine_begin(&s.t, &s.c);
        for (int i = 0; i < 10 * POINTS; i++) {
            size_t k = (size_t)(3 * (double)s.t.n * stack_uniform(&at)), b = il_tin_after(k);
            if (s.t.edge[k] == IL_CHART_NONE || !il_chart_is_frame(&s.c, s.t.edge[k]))
                continue;
            double u = stack_uniform(&at), p[2];
            uint32_t node;
            for (int x = 0; x < 2; x++)
                p[x] = place(&s, k)[x] + u * (place(&s, b)[x] - place(&s, k)[x]);
            assert_true(il_refine_divide(&r, k, p, &node));
            n += node != IL_CHART_NONE;
            assert_true(node == IL_CHART_NONE || s.c.node[node].is_frame);
        }
        assert_true(n > 3);
        assert_int_equal(s.c.n_edges, s.n_edges + n);
        assert_is_triangulation(&s);
        assert_has_lines(&s);
        assert_is_delaunay(&s);
        il_refine_end(&r);
        scene_free(&s);
    }
}

/* ---- what is refused ------------------------------------------------------------------ */

static void points_on_nodes_lines_and_beyond_them_are_refused(void **state)
{
    (void)state;
    scene s;
    scene_make(&s, 5);
    il_refine r = il_refine_begin(&s.t, &s.c);
    for (size_t k = 0; k < 3 * s.t.n; k++) {
        uint32_t node = 0;
        const double *a = place(&s, k), *b = place(&s, il_tin_after(k)), *c = place(&s, before(k));
        const double beyond[2] = { 0.55 * (a[0] + b[0]) - 0.1 * c[0], 0.55 * (a[1] + b[1]) - 0.1 * c[1] };
        assert_true(il_refine_insert(&r, k / 3, a, &node));
        assert_int_equal(node, IL_CHART_NONE);
        if (s.t.edge[k] == IL_CHART_NONE)
            continue;
        assert_true(il_refine_insert(&r, k / 3, beyond, &node));
        assert_int_equal(node, IL_CHART_NONE);
    }
    assert_is_triangulation(&s);
    assert_int_equal(s.t.n, 2 * s.c.n_nodes - 2 - 4);
    il_refine_end(&r);
    scene_free(&s);
}

/* ---- flips -------------------------------------------------------------------------------- */

static void flips_keep_the_triangulation(void **state)
{
    (void)state;
    scene s;
    uint64_t at = 3;
    size_t n = 0;
    scene_make(&s, 3);
    il_refine r = il_refine_begin(&s.t, &s.c);
    for (int i = 0; i < POINTS; i++) {
        size_t k = (size_t)(3 * (double)s.t.n * stack_uniform(&at));
        if (s.t.edge[k] != IL_CHART_NONE || s.t.across[k] == IL_CHART_NONE || !il_refine_is_convex(&r, k))
            continue;
        assert_true(il_refine_flip(&r, k));
        n++;
    }
    assert_true(n > POINTS / 10);
    assert_is_triangulation(&s);
    assert_has_lines(&s);
    il_refine_end(&r);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_leave_a_delaunay_triangulation),
        cmocka_unit_test(sides_of_the_frame_are_divided),
        cmocka_unit_test(points_on_nodes_lines_and_beyond_them_are_refused),
        cmocka_unit_test(flips_keep_the_triangulation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
