#include "config.h"
#include "base/alloc.h"
#include "model/audit.h"
#include "test.h"

#include <math.h>
#include <string.h>

/* ---- solids ------------------------------------------------------------------------ */

static uint32_t vertex(il_mesh *m, double x, double y, double z)
{
    const double p[3] = { x, y, z };
    assert_true(il_mesh_add_vertex(m, p, (il_origin){ -1, -1, -1, -1 }));
    return (uint32_t)m->n_vertices - 1;
}

static void triangle(il_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    assert_true(il_mesh_add_triangle(m, a, b, c));
}

static void quad(il_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    triangle(m, a, b, c);
    triangle(m, a, c, d);
}

/* The box from (X, Y, Z) with sides S; its corners count up in x, then y, then z. */
static void add_cube_on(il_mesh *m, const uint32_t v[8])
{
    quad(m, v[0], v[2], v[3], v[1]);
    quad(m, v[4], v[5], v[7], v[6]);
    quad(m, v[0], v[1], v[5], v[4]);
    quad(m, v[2], v[6], v[7], v[3]);
    quad(m, v[0], v[4], v[6], v[2]);
    quad(m, v[1], v[3], v[7], v[5]);
}

static void add_cube(il_mesh *m, double x, double y, double z, double s)
{
    uint32_t v[8];
    for (uint32_t i = 0; i < 8; i++)
        v[i] = vertex(m, x + s * (i & 1), y + s * (i >> 1 & 1), z + s * (i >> 2 & 1));
    add_cube_on(m, v);
}

static void turn_one(il_mesh *m, size_t t)
{
    uint32_t a = m->tri[3 * t];
    m->tri[3 * t] = m->tri[3 * t + 1];
    m->tri[3 * t + 1] = a;
}

/* Turn the triangles from number FROM on inside out. */
static void turn_over(il_mesh *m, size_t from)
{
    for (size_t t = from; t < m->n_triangles; t++)
        turn_one(m, t);
}

static void add_cavity(il_mesh *m, double x, double y, double z, double s)
{
    size_t from = m->n_triangles;
    add_cube(m, x, y, z, s);
    turn_over(m, from);
}

/* N x N quads around a ring of radius 3 and tube radius 1. */
static void add_torus(il_mesh *m, uint32_t n)
{
    uint32_t first = (uint32_t)m->n_vertices;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            double a = 2 * acos(-1) * i / n, b = 2 * acos(-1) * j / n, r = 3 + cos(b);
            vertex(m, r * cos(a), r * sin(a), sin(b));
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            uint32_t i1 = (i + 1) % n, j1 = (j + 1) % n;
            quad(m, first + i * n + j, first + i1 * n + j, first + i1 * n + j1, first + i * n + j1);
        }
}

static il_audit audit(il_mesh *m)
{
    il_audit a;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(il_mesh_audit(m, &a, &err), IL_OK);
    il_mesh_free(m);
    return a;
}

static void assert_near(double a, double b)
{
    assert_true(fabs(a - b) <= 1e-12 * (1 + fabs(b)));
}

/* ---- what is sound -------------------------------------------------------------------- */

static void a_cube_is_sound(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 1e6, -2, 3, 2);
    il_audit a = audit(&m);
    assert_true(il_audit_is_sound(&a));
    assert_true(a.closed && a.manifold && a.oriented && a.outward && a.has_genus);
    assert_int_equal(a.vertices, 8);
    assert_int_equal(a.edges, 18);
    assert_int_equal(a.triangles, 12);
    assert_int_equal(a.components, 1);
    assert_int_equal(a.genus, 0);
    assert_near(a.volume, 8);
    assert_near(a.area, 24);
    const double lo[3] = { 1e6, -2, 3 }, hi[3] = { 1e6 + 2, 0, 5 };
    assert_memory_equal(a.lo, lo, sizeof lo);
    assert_memory_equal(a.hi, hi, sizeof hi);
    assert_int_equal(a.first_intersection[0], UINT32_MAX);
}

static void a_tetrahedron_is_sound(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    vertex(&m, 0, 0, 0), vertex(&m, 1, 0, 0), vertex(&m, 0, 1, 0), vertex(&m, 0, 0, 1);
    triangle(&m, 0, 2, 1), triangle(&m, 0, 1, 3), triangle(&m, 1, 2, 3), triangle(&m, 2, 0, 3);
    il_audit a = audit(&m);
    assert_true(il_audit_is_sound(&a));
    assert_near(a.volume, 1.0 / 6);
    assert_near(a.area, 1.5 + sqrt(3) / 2);
    assert_int_equal(a.edges, 6);
}

static void a_torus_has_genus_one(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_torus(&m, 96);
    il_audit a = audit(&m);
    assert_true(il_audit_is_sound(&a));
    assert_int_equal(a.genus, 1);
    assert_true(fabs(a.volume / (2 * 3 * acos(-1) * acos(-1)) - 1) < 3e-3);
    assert_true(fabs(a.area / (4 * 3 * acos(-1) * acos(-1)) - 1) < 2e-3);
}

static void genus_and_volume_add_up_over_components(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_torus(&m, 12);
    add_cube(&m, 10, 0, 0, 1);
    add_cube(&m, 12, 0, 0, 2);
    il_audit a = audit(&m);
    assert_true(il_audit_is_sound(&a));
    assert_int_equal(a.components, 3);
    assert_int_equal(a.genus, 1);
    assert_true(a.volume > 9 + 50 && a.volume < 9 + 60);
}

static void a_cavity_and_an_island_in_it_are_sound(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cavity(&m, 1, 1, 1, 8);
    add_cube(&m, 0, 0, 0, 10);
    add_cube(&m, 3, 3, 3, 2);
    il_audit a = audit(&m);
    assert_true(il_audit_is_sound(&a));
    assert_int_equal(a.components, 3);
    assert_near(a.volume, 1000 - 512 + 8);
    assert_near(a.area, 600 + 384 + 24);
}

static void a_thousand_shells_nest(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    for (int i = 0; i < 1000; i++) {
        if (i % 2 == 0)
            add_cube(&m, i, i, i, 3000 - 2 * i);
        else
            add_cavity(&m, i, i, i, 3000 - 2 * i);
    }
    il_audit a = audit(&m);
    assert_true(il_audit_is_sound(&a));
    assert_int_equal(a.components, 1000);
}

static void loose_vertices_are_counted_and_harmless(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    vertex(&m, 99, 99, 99);
    add_cube(&m, 0, 0, 0, 1);
    il_audit a = audit(&m);
    assert_true(il_audit_is_sound(&a));
    assert_int_equal(a.loose_vertices, 1);
    assert_int_equal(a.genus, 0);
    assert_true(a.hi[0] == 1);
}

/* Boxes in boxes, up to eight side by side, touching in edges and corners. */
static void add_boxes(il_mesh *m, uint64_t *seed, double x, double y, double z, double s, int depth)
{
    for (unsigned i = 0; i < 8; i++) {
        *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        bool wanted = *seed >> 62 > 0 && (i == 0 || i == 3 || i == 5 || i == 6); /* no two share a face */
        double h = s / 2, at[3] = { x + h * (i & 1), y + h * (i >> 1 & 1), z + h * (i >> 2 & 1) };
        if (!wanted || depth == 0)
            continue;
        size_t from = m->n_triangles;
        add_cube(m, at[0], at[1], at[2], h);
        if (depth % 2 == 0)
            turn_over(m, from);
        add_boxes(m, seed, at[0] + h / 8, at[1] + h / 8, at[2] + h / 8, h * 3 / 4, depth - 1);
    }
}

static void any_part_turned_over_is_noticed(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int k = 0; k < 20; k++) {
        il_mesh m = IL_MESH_INIT;
        il_audit a;
        add_boxes(&m, &seed, 1, 2, 3, 16, 3);
        add_cube(&m, -5, -5, -5, 1);
        assert_int_equal(il_mesh_audit(&m, &a, NULL), IL_OK);
        assert_true(a.outward);
        assert_int_equal(a.components, m.n_triangles / 12);
        for (size_t i = 0; i < 5; i++) {
            size_t part = (size_t)(seed >> 33) * (i + 1) % a.components;
            il_audit b;
            for (size_t t = 12 * part; t < 12 * part + 12; t++)
                turn_one(&m, t);
            assert_int_equal(il_mesh_audit(&m, &b, NULL), IL_OK);
            assert_false(b.outward);
            for (size_t t = 12 * part; t < 12 * part + 12; t++)
                turn_one(&m, t);
        }
        il_mesh_free(&m);
    }
}

/* ---- what is not -------------------------------------------------------------------------- */

static void an_inverted_solid_does_not_face_outward(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cavity(&m, 0, 0, 0, 1);
    il_audit a = audit(&m);
    assert_true(a.closed && a.manifold && a.oriented && !a.outward);
    assert_false(il_audit_is_sound(&a));
    assert_near(a.volume, -1);
    add_cube(&m, 0, 0, 0, 9);
    add_cavity(&m, 20, 4, 4, 1); /* beside it, though the sum is positive */
    a = audit(&m);
    assert_true(a.oriented && !a.outward && a.volume > 0);
    add_cube(&m, 0, 0, 0, 9);
    add_cube(&m, 4, 4, 4, 1); /* a solid in a solid */
    a = audit(&m);
    assert_true(a.oriented && !a.outward);
}

static void a_flipped_triangle_is_inconsistent_along_three_edges(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 1);
    turn_over(&m, 11);
    il_audit a = audit(&m);
    assert_true(a.closed && a.manifold && !a.oriented && !a.outward && !a.has_genus);
    assert_int_equal(a.inconsistent_edges, 3);
    assert_int_equal(a.components, 1);
}

static void a_missing_triangle_leaves_three_boundary_edges(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 1);
    m.n_triangles--;
    il_audit a = audit(&m);
    assert_true(!a.closed && a.manifold && a.oriented && !a.outward && !a.has_genus);
    assert_int_equal(a.boundary_edges, 3);
    assert_int_equal(a.self_intersections, 0);
}

static void solids_that_share_an_edge_are_not_manifold(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 1);
    uint32_t v[8] = { 3, 0, 0, 0, 7, 0, 0, 0 }; /* the upright edge at (1, 1) */
    for (uint32_t i = 1; i < 8; i++)
        if (i != 4)
            v[i] = vertex(&m, 1 + (i & 1), 1 + (i >> 1 & 1), i >> 2 & 1);
    add_cube_on(&m, v);
    il_audit a = audit(&m);
    assert_true(a.closed && !a.manifold && a.oriented && !a.has_genus);
    assert_int_equal(a.nonmanifold_edges, 1);
    assert_int_equal(a.nonmanifold_vertices, 0); /* joined across that edge */
    assert_int_equal(a.self_intersections, 0);
    assert_int_equal(a.components, 1);
    assert_near(a.volume, 2);
}

static void solids_that_share_a_vertex_are_not_manifold(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 1);
    uint32_t v[8] = { 7, 0, 0, 0, 0, 0, 0, 0 };
    for (uint32_t i = 1; i < 8; i++)
        v[i] = vertex(&m, 1 + (i & 1), 1 + (i >> 1 & 1), 1 + (i >> 2 & 1));
    add_cube_on(&m, v);
    il_audit a = audit(&m);
    assert_true(a.closed && !a.manifold && a.oriented && a.outward);
    assert_int_equal(a.nonmanifold_edges, 0);
    assert_int_equal(a.nonmanifold_vertices, 1);
    assert_int_equal(a.components, 2);
}

/* The same touching with vertices of their own is what splitting a pinch gives. */
static void solids_that_touch_with_vertices_of_their_own_are_manifold(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 1);
    add_cube(&m, 1, 1, 1, 1);
    add_cube(&m, 1, 1, -5, 1);
    il_audit a = audit(&m);
    assert_true(il_audit_is_sound(&a));
}

static void crossing_solids_are_found_with_the_first_pair(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 4);
    vertex(&m, 1, 1, 1), vertex(&m, 2, 1, 1), vertex(&m, 1, 2, 1), vertex(&m, 1, 1, 9);
    triangle(&m, 8, 10, 9), triangle(&m, 8, 9, 11), triangle(&m, 9, 10, 11), triangle(&m, 10, 8, 11);
    il_audit a = audit(&m);
    assert_true(a.closed && a.manifold && a.oriented);
    assert_true(a.self_intersections >= 3 && !a.more_intersections);
    assert_true(a.first_intersection[0] == 2 || a.first_intersection[0] == 3); /* the lid */
    assert_true(a.first_intersection[1] >= 12);
    assert_false(il_audit_is_sound(&a));
}

static void triangles_without_area_are_degenerate_and_no_crossing(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 2);
    uint32_t middle = vertex(&m, 1, 1, 0); /* on the diagonal 0-3 of the bottom */
    triangle(&m, 0, 3, middle);
    triangle(&m, 5, 5, 6);
    il_audit a = audit(&m);
    assert_int_equal(a.degenerate_triangles, 2);
    assert_int_equal(a.self_intersections, 0);
    assert_int_equal(a.nonmanifold_edges, 1);
    assert_int_equal(a.boundary_edges, 2);
    assert_int_equal(a.components, 1);
    assert_near(a.volume, 8);
}

static void duplicate_triangles_are_counted_once_each(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 2);
    const uint32_t *t = m.tri;
    uint32_t a0 = t[0], b0 = t[1], c0 = t[2];
    triangle(&m, b0, c0, a0);
    triangle(&m, c0, b0, a0);
    il_audit a = audit(&m);
    assert_int_equal(a.duplicate_triangles, 2);
    assert_int_equal(a.nonmanifold_edges, 3);
    assert_int_equal(a.self_intersections, 3);
    assert_int_equal(a.first_intersection[0], 0);
    assert_int_equal(a.first_intersection[1], 12);
}

static void an_empty_mesh_is_not_sound(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    il_audit a = audit(&m);
    assert_false(il_audit_is_sound(&a));
    assert_false(a.closed);
}

static void crossings_are_counted_up_to_a_limit(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    for (int i = 0; i < 1500; i++) {
        uint32_t a = vertex(&m, 0, 0, 0);
        vertex(&m, 1, 0, 0), vertex(&m, 0, 1, 0);
        triangle(&m, a, a + 1, a + 2);
    }
    il_audit a = audit(&m);
    assert_int_equal(a.self_intersections, IL_AUDIT_INTERSECTIONS);
    assert_true(a.more_intersections);
}

static void running_out_of_memory_is_an_error_and_loses_nothing(void **state)
{
    (void)state;
    il_mesh m = IL_MESH_INIT;
    add_cube(&m, 0, 0, 0, 2);
    add_cube(&m, 9, 0, 0, 2);
    il_status st = IL_E_NOMEM;
    long k = 0;
    for (; st != IL_OK; k++) {
        il_audit a;
        il_alloc_test_fail_after(k);
        st = il_mesh_audit(&m, &a, NULL);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || st == IL_E_NOMEM);
    }
    assert_true(k > 10 && k < 30);
    il_mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_sound),
        cmocka_unit_test(a_tetrahedron_is_sound),
        cmocka_unit_test(a_torus_has_genus_one),
        cmocka_unit_test(genus_and_volume_add_up_over_components),
        cmocka_unit_test(a_cavity_and_an_island_in_it_are_sound),
        cmocka_unit_test(a_thousand_shells_nest),
        cmocka_unit_test(any_part_turned_over_is_noticed),
        cmocka_unit_test(loose_vertices_are_counted_and_harmless),
        cmocka_unit_test(an_inverted_solid_does_not_face_outward),
        cmocka_unit_test(a_flipped_triangle_is_inconsistent_along_three_edges),
        cmocka_unit_test(a_missing_triangle_leaves_three_boundary_edges),
        cmocka_unit_test(solids_that_share_an_edge_are_not_manifold),
        cmocka_unit_test(solids_that_share_a_vertex_are_not_manifold),
        cmocka_unit_test(solids_that_touch_with_vertices_of_their_own_are_manifold),
        cmocka_unit_test(crossing_solids_are_found_with_the_first_pair),
        cmocka_unit_test(triangles_without_area_are_degenerate_and_no_crossing),
        cmocka_unit_test(duplicate_triangles_are_counted_once_each),
        cmocka_unit_test(an_empty_mesh_is_not_sound),
        cmocka_unit_test(crossings_are_counted_up_to_a_limit),
        cmocka_unit_test(running_out_of_memory_is_an_error_and_loses_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
