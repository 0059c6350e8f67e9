/* t-relief.c - maps of random terrains become the surfaces that they were made from, as far as
 * isolines tell; what contradicts the rest of a map is named. */
#include "config.h"
#include "terrain/relief.h"
#include "base/alloc.h"
#include "bridge/predicates.h"
#include "model/audit.h"
#include "region/joiner.h"
#include "stacks.h"
#include "terrains.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TERRAINS = 300, MOST_LEVELS = 16 };

/* ---- the terrains themselves --------------------------------------------------------------- */

static bool is_on_box(const double box[4], const double p[2])
{
    return p[0] == box[0] || p[0] == box[2] || p[1] == box[1] || p[1] == box[3];
}

static void lines_close_or_end_at_the_edge(void **state)
{
    (void)state;
    size_t n_open = 0, n_closed = 0;
    for (uint64_t seed = 0; seed < TERRAINS; seed++) {
        terrain t;
        il_slice slice[MOST_LEVELS];
        double box[4];
        terrain_make(&t, seed);
        terrain_contour(&t, slice);
        terrain_box(&t, box);
        for (size_t k = 0; k < t.n_levels; k++)
            for (size_t i = 0; i < slice[k].n; i++) {
                const il_ring *r = &slice[k].ring[i];
                assert_true(r->n >= (r->open ? 2 : 3));
                for (size_t v = 0; v < r->n; v++)
                    assert_int_equal(is_on_box(box, r->xy + 2 * v), r->open && (v == 0 || v == r->n - 1));
                *(r->open ? &n_open : &n_closed) += 1;
            }
        terrain_free_slices(slice, t.n_levels);
        terrain_free(&t);
    }
    assert_true(n_open > 1000 && n_closed > 1000);
}

/* Beside the middle of an edge of a line, as far as one can look. */
static void the_higher_ground_is_on_the_left_of_lines(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < TERRAINS; seed++) {
        terrain t;
        il_slice slice[MOST_LEVELS];
        terrain_make(&t, seed);
        terrain_contour(&t, slice);
        for (size_t k = 0; k < t.n_levels; k++)
            for (size_t i = 0; i < slice[k].n; i++) {
                const double *p = slice[k].ring[i].xy;
                double d[2] = { p[2] - p[0], p[3] - p[1] }, far = 1e-6 * t.step / hypot(d[0], d[1]);
                double left[2] = { (p[0] + p[2]) / 2 - far * d[1], (p[1] + p[3]) / 2 + far * d[0] };
                double right[2] = { (p[0] + p[2]) / 2 + far * d[1], (p[1] + p[3]) / 2 - far * d[0] };
                if (hypot(d[0], d[1]) < 1e-3 * t.step || is_on_box((double[4]){ left[0], left[1], right[0], right[1] }, p))
                    continue;
                assert_true(terrain_height(&t, left) > terrain_height(&t, right));
            }
        terrain_free_slices(slice, t.n_levels);
        terrain_free(&t);
    }
}

static void faces_of_terrains_get_their_bands(void **state)
{
    (void)state;
    size_t n_faces = 0;
    for (uint64_t seed = 0; seed < TERRAINS; seed++) {
        terrain t;
        il_bands b;
        terrain_make(&t, seed);
        terrain_faces f = terrain_part(&t);
        assert_int_equal(il_bands_label(&b, f.border, f.n, f.n_faces, f.n_lines, t.n_levels, IL_SIDE_UNKNOWN, NULL), IL_OK);
        assert_int_equal(b.n_discords, 0);
        assert_memory_equal(b.band, f.band, f.n_faces * sizeof *f.band);
        n_faces += f.n_faces;
        il_bands_free(&b);
        terrain_faces_free(&f);
        terrain_free(&t);
    }
    assert_true(n_faces > 10 * TERRAINS);
}

/* ---- a mesh that is looked at ----------------------------------------------------------------- */

/* The whole mesh of one stack.  is_whole: it was ended. */
typedef struct catcher {
    il_mesh_sink sink;
    il_mesh mesh;
    il_stack_head head;
    bool is_whole;
} catcher;

static il_status catch_begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    return il_stack_head_copy(&((catcher *)self)->head, head, err);
}

static il_status catch_piece(il_mesh_sink *self, const il_mesh *m, il_error *err)
{
    il_mesh *to = &((catcher *)self)->mesh;
    bool ok = true;
    for (size_t v = 0; v < m->n_vertices && ok; v++)
        ok = il_mesh_add_vertex(to, m->xyz + 3 * v, m->origin[v]);
    for (size_t t = 0; t < m->n_triangles && ok; t++)
        ok = il_mesh_add_triangle(to, m->tri[3 * t], m->tri[3 * t + 1], m->tri[3 * t + 2]);
    return ok ? IL_OK : il_fail_nomem(err);
}

static il_status catch_end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    (void)err;
    catcher *c = (catcher *)self;
    assert_int_equal(facts->vertices, c->mesh.n_vertices);
    assert_int_equal(facts->triangles, c->mesh.n_triangles);
    c->is_whole = true;
    return IL_OK;
}

static void catch_abandon(il_mesh_sink *self)
{
    (void)self;
}

static il_status catch_finish(il_mesh_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

static void catcher_free(catcher *c)
{
    il_mesh_free(&c->mesh);
    il_stack_head_free(&c->head);
}

/* The program's way from slice[n], whose rings are taken, to C. */
static il_status make_relief(const il_relief_options *o, il_slice *slice, size_t n, catcher *c, il_report *report, il_error *err)
{
    *c = (catcher){ .sink = { catch_begin, catch_piece, catch_end, catch_abandon, catch_finish } };
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_join_options join = { 0 };
    il_sink *relief = NULL, *joiner = NULL;
    head.kind = IL_KIND_TERRAIN;
    head.unit = IL_UNIT_M;
    il_status st = il_relief_new(&relief, o, &c->sink, NULL, report, err);
    if (st == IL_OK)
        st = il_joiner_new(&joiner, &join, relief, report, err);
    if (st == IL_OK)
        st = joiner->stack_begin(joiner, &head, err);
    for (size_t k = 0; k < n && st == IL_OK; k++)
        st = slice[k].n > 0 ? joiner->slice(joiner, &slice[k], err) : IL_OK;
    if (st == IL_OK)
        st = joiner->stack_end(joiner, err);
    if (st == IL_OK)
        st = joiner->end(joiner, err);
    il_joiner_free(joiner);
    il_relief_free(relief);
    assert_int_equal(c->is_whole, st == IL_OK);
    return st;
}

static const double *vertex(const il_mesh *m, size_t t, int k)
{
    return m->xyz + 3 * (size_t)m->tri[3 * t + (size_t)k];
}

static double area2(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* ---- what an open surface must be ----------------------------------------------------------- */

static int by_ends(const void *pa, const void *pb)
{
    const uint32_t *a = pa, *b = pb;
    for (int i = 0; i < 2; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

/* Half-edges come once, and have their reverse but over the sides of BOX. */
static void assert_half_edges(const il_mesh *m, const double box[4])
{
    uint32_t (*e)[2] = malloc(3 * m->n_triangles * sizeof *e);
    assert_non_null(e);
    for (size_t k = 0; k < 3 * m->n_triangles; k++) {
        e[k][0] = m->tri[k];
        e[k][1] = m->tri[k % 3 == 2 ? k - 2 : k + 1];
    }
    qsort(e, 3 * m->n_triangles, sizeof *e, by_ends);
    for (size_t k = 0; k < 3 * m->n_triangles; k++) {
        const uint32_t back[2] = { e[k][1], e[k][0] };
        const double *a = m->xyz + 3 * (size_t)e[k][0], *b = m->xyz + 3 * (size_t)e[k][1];
        assert_true(k == 0 || by_ends(e[k - 1], e[k]) != 0);
        bool is_edge = (a[0] == box[0] && b[0] == box[0]) || (a[0] == box[2] && b[0] == box[2]) ||
                       (a[1] == box[1] && b[1] == box[1]) || (a[1] == box[3] && b[1] == box[3]);
        assert_int_equal(bsearch(back, e, 3 * m->n_triangles, sizeof *e, by_ends) == NULL, is_edge);
    }
    free(e);
}

static void assert_covers(const il_mesh *m, const double box[4])
{
    double sum = 0, whole = 2 * (box[2] - box[0]) * (box[3] - box[1]);
    for (size_t t = 0; t < m->n_triangles; t++) {
        const double *a = vertex(m, t, 0), *b = vertex(m, t, 1), *c = vertex(m, t, 2);
        assert_true(il_orientation(a, b, c) > 0);
        sum += area2(a, b, c);
    }
    assert_true(fabs(sum - whole) < 1e-9 * whole);
}

static int by_place(const void *pa, const void *pb)
{
    const double *a = pa, *b = pb;
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

/* slice[n]: the isolines as they were drawn. */
static void assert_has_lines(const il_mesh *m, const il_slice *slice, size_t n)
{
    double *xyz = malloc(3 * m->n_vertices * sizeof *xyz);
    assert_non_null(xyz);
    memcpy(xyz, m->xyz, 3 * m->n_vertices * sizeof *xyz);
    qsort(xyz, m->n_vertices, 3 * sizeof *xyz, by_place);
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < slice[k].n; i++)
            for (size_t v = 0; v < slice[k].ring[i].n; v++) {
                const double *xy = slice[k].ring[i].xy + 2 * v, p[3] = { xy[0], xy[1], slice[k].z };
                assert_non_null(bsearch(p, xyz, m->n_vertices, 3 * sizeof *xyz, by_place));
            }
    free(xyz);
}

/* The height of the surface, its triangles that turn counter-clockwise, at P; NAN beside it. */
static double height_at(const il_mesh *m, const double p[2])
{
    for (size_t t = 0; t < m->n_triangles; t++) {
        const double *a = vertex(m, t, 0), *b = vertex(m, t, 1), *c = vertex(m, t, 2);
        if (fmin(a[0], fmin(b[0], c[0])) > p[0] || fmax(a[0], fmax(b[0], c[0])) < p[0] ||
            fmin(a[1], fmin(b[1], c[1])) > p[1] || fmax(a[1], fmax(b[1], c[1])) < p[1])
            continue;
        double u = area2(b, c, p), v = area2(c, a, p), w = area2(a, b, p);
        if (u >= 0 && v >= 0 && w >= 0 && u + v + w > 0)
            return (u * a[2] + v * b[2] + w * c[2]) / (u + v + w);
    }
    return NAN;
}

/* At random places the mesh lies between the levels between which the terrain lies.  Where
 * the terrain comes near a level the mesh may touch it: it is flat in some small bends. */
static void assert_bands(const catcher *c, const terrain *t, const double box[4], uint64_t seed)
{
    const il_placement *to = &c->head.placement;
    for (int k = 0; k < 200; k++) {
        double p[2], q[2];
        for (size_t i = 0; i < 2; i++) {
            p[i] = box[i] + (box[2 + i] - box[i]) * stack_uniform(&seed);
            q[i] = c->head.has_placement ? (p[i] - to->offset[i]) / to->scale[i] : p[i];
        }
        double truth = terrain_height(t, p), z = height_at(&c->mesh, q);
        assert_true(z == z);
        z = c->head.has_placement ? z * to->scale[2] + to->offset[2] : z;
        int32_t low = terrain_low(t, truth);
        double slack = 1e-6 * (t->level[t->n_levels - 1] - t->level[0]);
        if (low >= 0 && truth > t->level[low] + slack)
            assert_true(z > t->level[low] - slack);
        if (low + 1 < (int32_t)t->n_levels && truth < t->level[low + 1] - slack)
            assert_true(z < t->level[low + 1] + slack);
    }
}

/* ---- random terrains ----------------------------------------------------------------------------- */

static void box_of(const il_slice *slice, size_t n, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < slice[k].n; i++)
            for (size_t v = 0; v < 2 * slice[k].ring[i].n; v++) {
                double x = slice[k].ring[i].xy[v];
                box[v % 2] = fmin(box[v % 2], x);
                box[2 + v % 2] = fmax(box[2 + v % 2], x);
            }
}

static void copy_slices(const il_slice *from, il_slice *to, size_t n)
{
    for (size_t k = 0; k < n; k++)
        assert_int_equal(il_slice_copy(&to[k], &from[k], NULL), IL_OK);
}

typedef struct scene {
    terrain t;
    il_slice drawn[MOST_LEVELS], given[MOST_LEVELS];
    double box[4];
    catcher c;
    il_report report;
} scene;

static void scene_free(scene *s)
{
    terrain_free_slices(s->drawn, s->t.n_levels);
    terrain_free_slices(s->given, s->t.n_levels);
    terrain_free(&s->t);
    catcher_free(&s->c);
    il_report_free(&s->report);
}

static void scene_make(scene *s, uint64_t seed, bool closed)
{
    *s = (scene){ .report = IL_REPORT_INIT };
    terrain_make(&s->t, seed);
    terrain_contour(&s->t, s->drawn);
    copy_slices(s->drawn, s->given, s->t.n_levels);
    if (closed)
        terrain_close(&s->t, s->given, seed);
    box_of(s->given, s->t.n_levels, s->box);
    terrain_scatter(s->given, s->t.n_levels, seed);
}

static void show(const il_report *r)
{
    for (size_t i = 0; i < r->n_skips; i++)
        print_message("  %s: %s\n", r->skip[i].what, r->skip[i].why);
    for (size_t i = 0; i < r->n_notes; i++)
        print_message("  %s\n", r->note[i]);
}

static void make(scene *s, const il_relief_options *o)
{
    il_error err = IL_ERROR_INIT;
    char words[800];
    il_status st = make_relief(o, s->given, s->t.n_levels, &s->c, &s->report, &err);
    il_error_message(&err, words, sizeof words);
    if (st != IL_OK)
        print_message("%s\n", words);
    assert_int_equal(st, IL_OK);
}

/* Nothing was left out, put in or wrong: only joined. */
static void assert_nothing_wrong(const il_report *r)
{
    assert_int_equal(r->n_skipped, 0);
    assert_int_equal(r->repair[IL_REPAIR_MISSING_LINE], 0);
}

/* The surface of terrain SEED, its lines closed along the map's edge or open there. */
static void assert_surface(uint64_t seed, bool closed)
{
    scene s;
    il_relief_options o = { .placement = IL_PLACEMENT_OPTIONS_INIT };
    scene_make(&s, seed, closed);
    make(&s, &o);
    assert_nothing_wrong(&s.report);
    assert_half_edges(&s.c.mesh, s.box);
    assert_covers(&s.c.mesh, s.box);
    assert_has_lines(&s.c.mesh, s.drawn, s.t.n_levels);
    assert_bands(&s.c, &s.t, s.box, seed);
    scene_free(&s);
}

static void surfaces_of_random_terrains_lie_in_their_bands(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < TERRAINS; seed++)
        assert_surface(seed, false);
}

static void lines_closed_along_the_edge_are_open_at_it(void **state)
{
    (void)state;
    for (uint64_t seed = 1000; seed < 1000 + TERRAINS / 3; seed++)
        assert_surface(seed, true);
}

/* Octagons: four edges of the lowest are the map's farthest, but no edge of the map. */
static void a_line_with_an_edge_farthest_out_keeps_it(void **state)
{
    (void)state;
    scene s = { .report = IL_REPORT_INIT };
    static const double corner[8][2] = { { 3, 1 }, { 1, 3 }, { -1, 3 }, { -3, 1 }, { -3, -1 }, { -1, -3 }, { 1, -3 }, { 3, -1 } };
    s.t.n_levels = 2;
    for (size_t k = 0; k < 2; k++) {
        il_ring *r = il_slice_add_ring(&s.given[k]);
        assert_non_null(r);
        s.given[k].z = (double)k;
        for (int v = 0; v < 8; v++)
            assert_true(il_ring_add(r, corner[v][0] * (double)(2 - k), corner[v][1] * (double)(2 - k), 0));
    }
    copy_slices(s.given, s.drawn, 2);
    box_of(s.given, 2, s.box);
    make(&s, &(il_relief_options){ .placement = IL_PLACEMENT_OPTIONS_INIT });
    assert_int_equal(s.report.n_notes, 0);
    assert_covers(&s.c.mesh, s.box);
    assert_has_lines(&s.c.mesh, s.drawn, 2);
    for (size_t k = 0; k < 8; k++) {
        const double middle[2] = { corner[k][0] + corner[(k + 1) % 8][0], corner[k][1] + corner[(k + 1) % 8][1] };
        assert_true(fabs(height_at(&s.c.mesh, middle)) < 1e-12);
    }
    scene_free(&s);
}

static void add_square(il_slice *s, double x, double half)
{
    il_ring *r = il_slice_add_ring(s);
    assert_true(r && il_ring_add(r, x - half, -half, 0) && il_ring_add(r, x + half, -half, 0) && il_ring_add(r, x + half, half, 0) &&
                il_ring_add(r, x - half, half, 0));
}

/* Four hills in a sea, or pits in a plain, one of them without its outermost line: that is
 * drawn about it, and the sea lies below it, as the lines of the others say. */
static void a_missing_line_at_the_foot_is_drawn_there(void **state)
{
    (void)state;
    for (int up = -1; up <= 1; up += 2) {
        scene s = { .report = IL_REPORT_INIT };
        s.t.n_levels = 4;
        for (int k = 0; k < 4; k++) {
            il_slice *slice = &s.given[up > 0 ? k : 3 - k];
            slice->z = up * k;
            for (int hill = 0; hill < 4; hill++)
                if (k > 0 || hill != 2)
                    add_square(slice, 20 * hill, 8 - 2 * k);
        }
        il_slice outline = IL_SLICE_INIT;
        add_square(&outline, 30, 45);
        copy_slices(s.given, s.drawn, 4);
        box_of(s.given, 4, s.box);
        make(&s, &(il_relief_options){ .frame = { .kind = IL_FRAME_OUTLINE, .outline = &outline },
                                       .placement = IL_PLACEMENT_OPTIONS_INIT });
        assert_int_equal(s.report.n_skipped, 0);
        assert_int_equal(s.report.repair[IL_REPAIR_MISSING_LINE], 1);
        assert_has_lines(&s.c.mesh, s.drawn, 4);
        for (int hill = 0; hill < 3; hill++)
            for (double y = -7.5; y < 8; y++)
                assert_true(up * height_at(&s.c.mesh, (const double[2]){ 20 * hill + 9, y }) < 0 || hill == 2);
        for (double x = 38; x < 43; x++)
            assert_true(up * height_at(&s.c.mesh, (const double[2]){ x, 6.25 }) > 0);
        assert_true(up * height_at(&s.c.mesh, (const double[2]){ 40, 42 }) < 0);
        il_slice_free(&outline);
        scene_free(&s);
    }
}

static void assert_sound(const il_mesh *m)
{
    il_audit a;
    assert_int_equal(il_mesh_audit(m, &a, NULL), IL_OK);
    assert_true(il_audit_is_sound(&a) && a.closed && a.outward);
    assert_int_equal(a.components, 1);
    assert_int_equal(a.genus, 0);
}

/* As they are, and as they are printed: 150 mm long, in 32-bit floats. */
static void solids_of_random_terrains_are_sound(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < TERRAINS; seed += 3)
        for (int printed = 0; printed < 2; printed++) {
            scene s;
            il_relief_options o = { .placement = IL_PLACEMENT_OPTIONS_INIT };
            o.placement.solid = true;
            if (printed) {
                o.placement.fit = 150;
                o.placement.recentre = o.placement.round_float = true;
            }
            scene_make(&s, seed, false);
            make(&s, &o);
            assert_nothing_wrong(&s.report);
            assert_sound(&s.c.mesh);
            assert_bands(&s.c, &s.t, s.box, seed);
            if (!printed)
                assert_has_lines(&s.c.mesh, s.drawn, s.t.n_levels);
            scene_free(&s);
        }
}

/* The grid's own edge, as an outline, when lines do not reach it all around. */
static void surfaces_fill_the_frame_that_is_given(void **state)
{
    (void)state;
    for (uint64_t seed = 2000; seed < 2000 + TERRAINS / 6; seed++) {
        scene s;
        il_slice outline = IL_SLICE_INIT;
        scene_make(&s, seed, false);
        terrain_box(&s.t, s.box);
        il_ring *r = il_slice_add_ring(&outline);
        assert_true(r && il_ring_add(r, s.box[0], s.box[1], 0) && il_ring_add(r, s.box[2], s.box[1], 0) &&
                    il_ring_add(r, s.box[2], s.box[3], 0) && il_ring_add(r, s.box[0], s.box[3], 0));
        il_relief_options o = { .frame = { .kind = IL_FRAME_OUTLINE, .outline = &outline }, .placement = IL_PLACEMENT_OPTIONS_INIT };
        make(&s, &o);
        assert_nothing_wrong(&s.report);
        assert_half_edges(&s.c.mesh, s.box);
        assert_covers(&s.c.mesh, s.box);
        assert_has_lines(&s.c.mesh, s.drawn, s.t.n_levels);
        assert_bands(&s.c, &s.t, s.box, seed);
        il_slice_free(&outline);
        scene_free(&s);
    }
}

/* ---- contradictions -------------------------------------------------------------------------------- */

/* A line, and the faces on its two sides: above it, below it. */
typedef struct place { size_t level, ring; uint32_t face[2]; } place;

static place place_of(const scene *s, const terrain_faces *f, uint32_t line)
{
    place p = { 0, 0, { 0, 0 } };
    for (size_t i = 0; i < f->n; i++)
        if (f->border[i].line == line)
            memcpy(p.face, f->border[i].face, sizeof p.face);
    for (size_t k = 0; k < s->t.n_levels; k++)
        for (size_t i = 0; i < s->drawn[k].n; i++)
            if (s->drawn[k].ring[i].feature == (long)line + 1)
                p.level = k, p.ring = i;
    return p;
}

/* The next of FACE's lines of LEVEL, LINE's not counted, from *AT on. */
static bool next_beside(const terrain_faces *f, uint32_t face, size_t level, uint32_t line, size_t *at, uint32_t *found)
{
    for (; *at < f->n; ++*at) {
        const il_border *b = &f->border[*at];
        if (b->line == line || b->level != (int32_t)level || (b->face[0] != face && b->face[1] != face))
            continue;
        *found = b->line;
        ++*at;
        return true;
    }
    return false;
}

/* There is a line of the level above on its upper side, and of the level below on its lower
 * one, and another of its own: then any other height of it is wrong, and it is missing
 * without it. */
static bool is_held(const scene *s, const terrain_faces *f, uint32_t line)
{
    place p = place_of(s, f, line);
    size_t at[2] = { 0, 0 };
    uint32_t beside;
    return s->drawn[p.level].n > 1 && p.level > 0 && next_beside(f, p.face[0], p.level + 1, line, &at[0], &beside) &&
           next_beside(f, p.face[1], p.level - 1, line, &at[1], &beside);
}

static bool is_named(const il_report *r, uint32_t line)
{
    char feature[40];
    snprintf(feature, sizeof feature, "(feature %u)", line + 1);
    for (size_t i = 0; i < r->n_skips; i++)
        if (strstr(r->skip[i].what, feature) || strstr(r->skip[i].why, feature))
            return true;
    for (size_t i = 0; i < r->n_notes; i++)
        if (strstr(r->note[i], feature))
            return true;
    return false;
}

/* Lines of slice[LEVEL] become those of slice[TO]. */
static void move_line(il_slice *slice, size_t level, size_t ring, size_t to)
{
    il_ring *r = il_slice_add_ring(&slice[to]), *from = &slice[level].ring[ring];
    assert_non_null(r);
    *r = *from;
    *from = slice[level].ring[--slice[level].n];
}

static void shift_line(il_ring *r, double x, double y)
{
    for (size_t v = 0; v < r->n; v++) {
        r->xy[2 * v] += x;
        r->xy[2 * v + 1] += y;
    }
}

static bool cross_in_plan(const double *a, const double *b, const double *c, const double *d)
{
    return il_orientation(a, b, c) * il_orientation(a, b, d) < 0 && il_orientation(c, d, a) * il_orientation(c, d, b) < 0;
}

static bool rings_cross(const il_ring *p, const il_ring *q)
{
    for (size_t i = p->open; i < p->n; i++)
        for (size_t k = q->open; k < q->n; k++)
            if (cross_in_plan(p->xy + 2 * i, p->xy + 2 * ((i + p->n - 1) % p->n), q->xy + 2 * k, q->xy + 2 * ((k + q->n - 1) % q->n)))
                return true;
    return false;
}

static bool crosses_another_level(const scene *s, size_t level, const il_ring *r)
{
    for (size_t k = 0; k < s->t.n_levels; k++)
        for (size_t i = 0; i < s->given[k].n && k != level; i++)
            if (rings_cross(r, &s->given[k].ring[i]))
                return true;
    return false;
}

static bool keeps_off(const il_ring *r, const double box[4], double distance)
{
    for (size_t v = 0; v < r->n; v++)
        for (int i = 0; i < 2; i++)
            if (r->xy[2 * v + (size_t)i] < box[i] + distance || r->xy[2 * v + (size_t)i] > box[2 + i] - distance)
                return false;
    return true;
}

/* A line that may be spoilt, any of them from FIRST on in turn; UINT32_MAX for none. */
static uint32_t find_line(const scene *s, const terrain_faces *f, uint32_t first, uint32_t but, bool closed)
{
    for (uint32_t i = 0; i < f->n_lines; i++) {
        uint32_t line = (first + i) % (uint32_t)f->n_lines;
        place p = place_of(s, f, line);
        const il_ring *r = &s->drawn[p.level].ring[p.ring];
        bool fits = !closed || (!r->open && r->n >= 12 && keeps_off(r, s->box, 2 * s->t.step));
        if (line != but && fits && is_held(s, f, line))
            return line;
    }
    return UINT32_MAX;
}

/* A scene with a line to be spoilt, its lines whole; more seeds until there is one. */
static uint32_t scene_with_line(scene *s, terrain_faces *f, uint64_t *seed, bool closed)
{
    for (;; ++*seed) {
        *s = (scene){ .report = IL_REPORT_INIT };
        terrain_make(&s->t, *seed);
        terrain_contour(&s->t, s->drawn);
        copy_slices(s->drawn, s->given, s->t.n_levels);
        box_of(s->given, s->t.n_levels, s->box);
        *f = terrain_part(&s->t);
        uint32_t line = find_line(s, f, (uint32_t)*seed % (uint32_t)f->n_lines, UINT32_MAX, closed);
        if (line != UINT32_MAX)
            return line;
        scene_free(s);
        terrain_faces_free(f);
    }
}

/* What is given now is made a surface all the same; the account holds a fault. */
static void make_faulty(scene *s, uint64_t seed)
{
    il_relief_options o = { .placement = IL_PLACEMENT_OPTIONS_INIT };
    terrain_scatter(s->given, s->t.n_levels, seed);
    make(s, &o);
    assert_covers(&s->c.mesh, s->box);
    assert_true(il_report_any(&s->report));
}

static void assert_named(const scene *s, uint32_t line)
{
    if (!is_named(&s->report, line)) {
        print_message("feature %u is not named\n", line + 1);
        show(&s->report);
    }
    assert_true(is_named(&s->report, line));
}

enum { PLANTED = 10 };

static void a_line_given_another_level_is_named(void **state)
{
    (void)state;
    uint64_t seed = 3000;
    for (int k = 0; k < PLANTED; k++, seed++) {
        scene s;
        terrain_faces f;
        uint32_t line = scene_with_line(&s, &f, &seed, false);
        place p = place_of(&s, &f, line);
        size_t to = (p.level + 1 + stack_random(&(uint64_t){ seed }) % (s.t.n_levels - 1)) % s.t.n_levels;
        move_line(s.given, p.level, p.ring, to);
        make_faulty(&s, seed);
        assert_named(&s, line);
        terrain_faces_free(&f);
        scene_free(&s);
    }
}

static void lines_that_exchanged_levels_are_named(void **state)
{
    (void)state;
    uint64_t seed = 4000;
    for (int k = 0; k < PLANTED; seed++) {
        scene s;
        terrain_faces f;
        uint32_t line = scene_with_line(&s, &f, &seed, false);
        uint32_t other = find_line(&s, &f, line + 1, line, false);
        place p = place_of(&s, &f, line), q = { p.level, 0, { 0, 0 } };
        if (other != UINT32_MAX)
            q = place_of(&s, &f, other);
        if (p.level != q.level) {
            il_ring keep = s.given[p.level].ring[p.ring];
            s.given[p.level].ring[p.ring] = s.given[q.level].ring[q.ring];
            s.given[q.level].ring[q.ring] = keep;
            make_faulty(&s, seed);
            assert_named(&s, line);
            assert_named(&s, other);
            k++;
        }
        terrain_faces_free(&f);
        scene_free(&s);
    }
}

/* A ring that is moved until it crosses a line of another level is named, as what it crosses. */
static void a_line_that_crosses_another_level_is_named(void **state)
{
    (void)state;
    uint64_t seed = 5000;
    for (int k = 0; k < PLANTED; seed++) {
        scene s;
        terrain_faces f;
        uint32_t line = scene_with_line(&s, &f, &seed, true);
        place p = place_of(&s, &f, line);
        il_ring *r = &s.given[p.level].ring[p.ring];
        double step = k % 2 ? s.t.step / 3 : -s.t.step / 3;
        bool crosses = false;
        for (int i = 0; i < 30 && !crosses && keeps_off(r, s.box, s.t.step); i++) {
            shift_line(r, step, k % 3 ? step / 5 : -2 * step);
            crosses = crosses_another_level(&s, p.level, r);
        }
        if (crosses) {
            make_faulty(&s, seed);
            assert_named(&s, line);
            k++;
        }
        terrain_faces_free(&f);
        scene_free(&s);
    }
}

static void a_line_that_ends_inside_the_map_is_named(void **state)
{
    (void)state;
    uint64_t seed = 6000;
    for (int k = 0; k < PLANTED; k++, seed++) {
        scene s;
        terrain_faces f;
        uint32_t line = scene_with_line(&s, &f, &seed, true);
        place p = place_of(&s, &f, line);
        il_ring *r = &s.given[p.level].ring[p.ring];
        r->n -= 3;
        r->open = true;
        make_faulty(&s, seed);
        assert_named(&s, line);
        terrain_faces_free(&f);
        scene_free(&s);
    }
}

static bool any_is_named(const scene *s, const terrain_faces *f, uint32_t face, size_t level, uint32_t line)
{
    uint32_t beside;
    for (size_t at = 0; next_beside(f, face, level, line, &at, &beside);)
        if (is_named(&s->report, beside))
            return true;
    return false;
}

/* By one line of its upper side and one of its lower. */
static void a_line_that_is_missing_is_told_by_those_beside_it(void **state)
{
    (void)state;
    uint64_t seed = 7000;
    for (int k = 0; k < PLANTED; k++, seed++) {
        scene s;
        terrain_faces f;
        uint32_t line = scene_with_line(&s, &f, &seed, false);
        place p = place_of(&s, &f, line);
        il_ring_free(&s.given[p.level].ring[p.ring]);
        s.given[p.level].ring[p.ring] = s.given[p.level].ring[--s.given[p.level].n];
        box_of(s.given, s.t.n_levels, s.box);
        make_faulty(&s, seed);
        assert_false(is_named(&s.report, line));
        assert_true(any_is_named(&s, &f, p.face[0], p.level + 1, line));
        assert_true(any_is_named(&s, &f, p.face[1], p.level - 1, line));
        terrain_faces_free(&f);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_close_or_end_at_the_edge),
        cmocka_unit_test(the_higher_ground_is_on_the_left_of_lines),
        cmocka_unit_test(faces_of_terrains_get_their_bands),
        cmocka_unit_test(surfaces_of_random_terrains_lie_in_their_bands),
        cmocka_unit_test(lines_closed_along_the_edge_are_open_at_it),
        cmocka_unit_test(a_line_with_an_edge_farthest_out_keeps_it),
        cmocka_unit_test(a_missing_line_at_the_foot_is_drawn_there),
        cmocka_unit_test(solids_of_random_terrains_are_sound),
        cmocka_unit_test(surfaces_fill_the_frame_that_is_given),
        cmocka_unit_test(a_line_given_another_level_is_named),
        cmocka_unit_test(lines_that_exchanged_levels_are_named),
        cmocka_unit_test(a_line_that_crosses_another_level_is_named),
        cmocka_unit_test(a_line_that_ends_inside_the_map_is_named),
        cmocka_unit_test(a_line_that_is_missing_is_told_by_those_beside_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
