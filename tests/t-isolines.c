/* t-isolines.c - isolines between those of a map lie on its surface, and can be read as a map. */
#include "config.h"
#include "terrain/isolines.h"
#include "base/alloc.h"
#include "region/joiner.h"
#include "terrain/cutter.h"
#include "terrains.h"
#include "test.h"

#include <math.h>
#include <string.h>

enum { TERRAINS = 40, MOST_LEVELS = 16, BETWEEN = 3, MOST_SLICES = MOST_LEVELS * (BETWEEN + 1) };

/* ---- what comes out ---------------------------------------------------------------------- */

typedef struct lines {
    il_sink sink;
    il_slice slice[MOST_SLICES];
    size_t n;
    bool is_whole;
} lines;

static il_status lines_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)err;
    ((lines *)self)->n = 0;
    assert_int_equal(head->kind, IL_KIND_TERRAIN);
    assert_false(head->has_placement);
    return IL_OK;
}

static il_status lines_slice(il_sink *self, il_slice *s, il_error *err)
{
    lines *l = (lines *)self;
    (void)err;
    assert_true(l->n < MOST_SLICES);
    l->slice[l->n++] = *s;
    *s = (il_slice)IL_SLICE_INIT;
    return IL_OK;
}

static il_status lines_end(il_sink *self, il_error *err)
{
    (void)err;
    ((lines *)self)->is_whole = true;
    return IL_OK;
}

typedef struct catcher {
    il_mesh_sink sink;
    il_mesh mesh;
} catcher;

static il_status catch_begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self;
    (void)head;
    (void)err;
    return IL_OK;
}

static il_status catch_piece(il_mesh_sink *self, const il_mesh *m, il_error *err)
{
    il_mesh *to = &((catcher *)self)->mesh;
    (void)err;
    for (size_t v = 0; v < m->n_vertices; v++)
        assert_true(il_mesh_add_vertex(to, m->xyz + 3 * v, m->origin[v]));
    for (size_t t = 0; t < m->n_triangles; t++)
        assert_true(il_mesh_add_triangle(to, m->tri[3 * t], m->tri[3 * t + 1], m->tri[3 * t + 2]));
    return IL_OK;
}

static il_status catch_end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    (void)self;
    (void)facts;
    (void)err;
    return IL_OK;
}

static void catch_abandon(il_mesh_sink *self)
{
    (void)self;
    fail();
}

static il_status catch_finish(il_mesh_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

/* Copies of slice[n] through the joiner into TO. */
static void send(const il_slice *slice, size_t n, il_sink *to, il_report *report)
{
    il_join_options join = { 0 };
    il_stack_head head = { .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M };
    il_sink *joiner;
    assert_int_equal(il_joiner_new(&joiner, &join, to, report, NULL), IL_OK);
    assert_int_equal(joiner->stack_begin(joiner, &head, NULL), IL_OK);
    for (size_t k = 0; k < n; k++) {
        il_slice copy;
        assert_int_equal(il_slice_copy(&copy, &slice[k], NULL), IL_OK);
        assert_int_equal(joiner->slice(joiner, &copy, NULL), IL_OK);
        il_slice_free(&copy);
    }
    assert_int_equal(joiner->stack_end(joiner, NULL), IL_OK);
    assert_int_equal(joiner->end(joiner, NULL), IL_OK);
    il_joiner_free(joiner);
}

static void make_lines(const il_relief_options *o, size_t between, const il_slice *slice, size_t n, lines *l)
{
    il_report report = IL_REPORT_INIT;
    il_sink *stage;
    *l = (lines){ .sink = { .stack_begin = lines_begin, .slice = lines_slice, .stack_end = lines_end, .end = lines_end } };
    assert_int_equal(il_isolines_new(&stage, o, between, &l->sink, &report, NULL), IL_OK);
    send(slice, n, stage, &report);
    il_isolines_free(stage);
    il_report_free(&report);
    assert_true(l->is_whole);
}

static void make_mesh(const il_relief_options *o, const il_slice *slice, size_t n, il_mesh *m, il_report *report)
{
    catcher c = { .sink = { catch_begin, catch_piece, catch_end, catch_abandon, catch_finish } };
    il_sink *relief;
    assert_int_equal(il_relief_new(&relief, o, &c.sink, NULL, report, NULL), IL_OK);
    send(slice, n, relief, report);
    il_relief_free(relief);
    *m = c.mesh;
}

/* ---- on the mesh -------------------------------------------------------------------------- */

static double area2(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* By how much the mesh is off the height Z at P, of the triangles over P the nearest; INFINITY without
 * one. */
static double miss(const il_mesh *m, const double *p, double z)
{
    double least = INFINITY;
    for (size_t t = 0; t < m->n_triangles; t++) {
        const double *v[3];
        double share[3], whole, height = 0;
        for (size_t k = 0; k < 3; k++)
            v[k] = m->xyz + 3 * (size_t)m->tri[3 * t + k];
        whole = area2(v[0], v[1], v[2]);
        bool over = whole > 0;
        for (size_t k = 0; k < 3 && over; k++) {
            share[k] = area2(p, v[(k + 1) % 3], v[(k + 2) % 3]) / whole;
            over = share[k] > -1e-6;
            height += share[k] * v[k][2];
        }
        if (over)
            least = fmin(least, fabs(height - z));
    }
    return least;
}

/* The frame, which is the box of the lines. */
static void find_box(const il_slice *slice, size_t n, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t k = 0; k < n; k++)
        for (size_t r = 0; r < slice[k].n; r++)
            for (size_t i = 0; i < 2 * slice[k].ring[r].n; i++) {
                double x = slice[k].ring[r].xy[i];
                box[i % 2] = fmin(box[i % 2], x);
                box[2 + i % 2] = fmax(box[2 + i % 2], x);
            }
}

static bool is_on_box(const double box[4], const double *p)
{
    return p[0] == box[0] || p[0] == box[2] || p[1] == box[1] || p[1] == box[3];
}

/* Its points and the middles of its edges; at its ends. */
static void assert_lies(const il_mesh *m, const il_ring *r, double z, double nothing, const double box[4])
{
    assert_true(r->n >= (r->open ? 2 : 3));
    for (size_t v = 0; v < r->n; v++) {
        const double *p = r->xy + 2 * v, *q = r->xy + 2 * ((v + 1) % r->n);
        const double middle[2] = { (p[0] + q[0]) / 2, (p[1] + q[1]) / 2 };
        assert_int_equal(r->mark[v], IL_VERTEX_INSERTED);
        assert_true(miss(m, p, z) <= nothing);
        if (v + 1 < r->n || !r->open)
            assert_true(miss(m, middle, z) <= nothing);
    }
    if (r->open)
        assert_true(is_on_box(box, r->xy) && is_on_box(box, r->xy + 2 * (r->n - 1)));
}

/* Slices of L against slice[n], the map's own. */
static void assert_between(const lines *l, const il_slice *slice, size_t n, size_t between, const il_mesh *m, const double box[4])
{
    size_t k = 0;
    for (size_t i = 0; i < l->n; i++) {
        const il_slice *s = &l->slice[i];
        if (k < n && s->z == slice[k].z) {
            assert_true(il_slice_equal_rings(s, &slice[k]));
            k++;
            continue;
        }
        assert_true(k > 0 && k < n && s->z > slice[k - 1].z && s->z < slice[k].z && s->n > 0);
        double gap = slice[k].z - slice[k - 1].z, part = (s->z - slice[k - 1].z) / gap * (double)(between + 1);
        assert_true(fabs(part - round(part)) < 1e-6);
        for (size_t r = 0; r < s->n; r++)
            assert_lies(m, &s->ring[r], s->z, 3e-6 * gap, box);
    }
    assert_int_equal(k, n);
}

static size_t joined(const terrain *t, il_slice *slice)
{
    lines l = { .sink = { .stack_begin = lines_begin, .slice = lines_slice, .stack_end = lines_end, .end = lines_end } };
    il_slice drawn[MOST_LEVELS];
    terrain_contour(t, drawn);
    send(drawn, t->n_levels, &l.sink, NULL);
    terrain_free_slices(drawn, t->n_levels);
    memcpy(slice, l.slice, l.n * sizeof *slice);
    return l.n;
}

static void free_slices(il_slice *slice, size_t n)
{
    for (size_t k = 0; k < n; k++)
        il_slice_free(&slice[k]);
}

static const il_law_kind kinds[] = { IL_LAW_STRAIGHT, IL_LAW_MEAN };

static void they_lie_on_the_surface_and_the_maps_own_stay(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < TERRAINS; seed++) {
        il_relief_options o = { .placement = IL_PLACEMENT_OPTIONS_INIT, .law.kind = kinds[seed % 2] };
        size_t between = seed % 4 < 2 ? 1 : BETWEEN;
        terrain t;
        il_slice slice[MOST_LEVELS];
        lines l;
        il_mesh m;
        double box[4];
        terrain_make(&t, seed);
        size_t n = joined(&t, slice);
        find_box(slice, n, box);
        make_lines(&o, between, slice, n, &l);
        make_mesh(&o, slice, n, &m, NULL);
        assert_between(&l, slice, n, between, &m, box);
        il_mesh_free(&m);
        free_slices(l.slice, l.n);
        free_slices(slice, n);
        terrain_free(&t);
    }
}

static void they_are_isolines_of_a_map_that_nothing_is_wrong_with(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < TERRAINS; seed++) {
        il_relief_options o = { .placement = IL_PLACEMENT_OPTIONS_INIT, .law.kind = kinds[seed / 2 % 2] };
        terrain t;
        il_slice slice[MOST_LEVELS];
        il_report report = IL_REPORT_INIT;
        lines l;
        il_mesh m;
        terrain_make(&t, seed);
        size_t n = joined(&t, slice);
        make_lines(&o, 1 + seed % BETWEEN, slice, n, &l);
        o.law.kind = IL_LAW_STRAIGHT;
        make_mesh(&o, l.slice, l.n, &m, &report);
        assert_false(il_report_any(&report));
        assert_int_equal(report.n_notes, 0);
        il_report_free(&report);
        il_mesh_free(&m);
        free_slices(l.slice, l.n);
        free_slices(slice, n);
        terrain_free(&t);
    }
}

static void one_level_has_nothing_beside_it(void **state)
{
    (void)state;
    il_relief_options o = { .placement = IL_PLACEMENT_OPTIONS_INIT };
    il_slice s = IL_SLICE_INIT;
    il_ring *r = il_slice_add_ring(&s);
    lines l;
    assert_true(r && il_ring_add(r, 0, 0, 0) && il_ring_add(r, 9, 0, 0) && il_ring_add(r, 0, 9, 0));
    make_lines(&o, 4, &s, 1, &l);
    assert_int_equal(l.n, 1);
    assert_true(il_slice_equal_rings(&l.slice[0], &s));
    free_slices(l.slice, l.n);
    make_lines(&o, 4, &s, 0, &l);
    assert_int_equal(l.n, 0);
    il_slice_free(&s);
}

/* ---- vertices at the height of a cut ---------------------------------------------------------- */

enum { SIDE = 5 };

/* The ground of SIDE by SIDE heights, rows along x, cut at 5 of the band from 0 to 10. */
static il_slice cut(const char *rows)
{
    double xyz[3 * SIDE * SIDE];
    uint32_t tri[6 * (SIDE - 1) * (SIDE - 1)];
    size_t n = 0;
    for (uint32_t v = 0; v < SIDE * SIDE; v++)
        xyz[3 * v] = v % SIDE, xyz[3 * v + 1] = v / SIDE, xyz[3 * v + 2] = rows[v + v / SIDE] - '0';
    for (uint32_t v = 0; v + SIDE < SIDE * SIDE; v++) {
        const uint32_t corner[6] = { v, v + 1, v + 1 + SIDE, v, v + 1 + SIDE, v + SIDE };
        if (v % SIDE + 1 < SIDE)
            memcpy(tri + 6 * n++, corner, sizeof corner);
    }
    const double level[2] = { 0, 10 };
    il_skin skin = { .xyz = xyz, .n_vertices = SIDE * SIDE, .tri = tri, .n_triangles = 2 * n, .n_surface = 2 * n };
    il_cutter c;
    il_slice s = IL_SLICE_INIT;
    assert_int_equal(il_cutter_build(&c, &skin, level, 2, NULL), IL_OK);
    assert_int_equal(il_cutter_cut(&c, 0, 5, &s, NULL), IL_OK);
    il_cutter_free(&c);
    return s;
}

static void ridges_floors_and_plains_at_that_height_have_no_lines(void **state)
{
    (void)state;
    static const char *const grounds[] = {
        "22222 22222 55555 22222 22222", "77777 77777 55555 77777 77777", "22222 22222 22522 22222 22222",
        "77777 77777 77577 77777 77777", "55555 55555 55555 55555 55555", "52222 25222 22522 22252 22225",
        "22222 25552 25552 25552 22222" };
    for (size_t k = 0; k < sizeof grounds / sizeof *grounds; k++) {
        il_slice s = cut(grounds[k]);
        assert_int_equal(s.n, 0);
        il_slice_free(&s);
    }
}

static void a_line_runs_through_the_vertices_of_a_slope(void **state)
{
    (void)state;
    il_slice s = cut("33333 44444 55555 66666 77777");
    assert_int_equal(s.n, 1);
    assert_true(s.ring[0].open);
    assert_int_equal(s.ring[0].n, SIDE);
    for (size_t v = 0; v < SIDE; v++) /* the higher ground, which is at greater y, is on the left */
        assert_true(s.ring[0].xy[2 * v] == (double)v && s.ring[0].xy[2 * v + 1] == 2);
    il_slice_free(&s);
}

/* Two lines at least, none of which has a point of another's, or one of its own twice. */
static void lines_at_a_saddle_do_not_touch(void **state)
{
    (void)state;
    static const char *const grounds[] = {
        "77222 77222 22522 22277 22277", "22277 22277 22522 77222 77222", "77222 77522 25552 22577 22277" };
    for (size_t k = 0; k < sizeof grounds / sizeof *grounds; k++) {
        il_slice s = cut(grounds[k]);
        assert_true(s.n >= 1);
        for (size_t i = 0; i < s.n; i++)
            for (size_t v = 0; v < s.ring[i].n; v++)
                for (size_t j = 0; j < s.n; j++)
                    for (size_t w = 0; w < s.ring[j].n; w++)
                        if (i != j || v != w)
                            assert_memory_not_equal(s.ring[i].xy + 2 * v, s.ring[j].xy + 2 * w, 2 * sizeof(double));
        il_slice_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(they_lie_on_the_surface_and_the_maps_own_stay),
        cmocka_unit_test(they_are_isolines_of_a_map_that_nothing_is_wrong_with),
        cmocka_unit_test(one_level_has_nothing_beside_it),
        cmocka_unit_test(ridges_floors_and_plains_at_that_height_have_no_lines),
        cmocka_unit_test(a_line_runs_through_the_vertices_of_a_slope),
        cmocka_unit_test(lines_at_a_saddle_do_not_touch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
