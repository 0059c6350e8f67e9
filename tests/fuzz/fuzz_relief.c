/* fuzz_relief.c - the bytes are a map of isolines.  Whatever it is, it is refused with a
 * sentence, or a mesh comes out that keeps the contract, which is looked at here without
 * what src/terrain proves it by:
 *     the surface's triangles stand upright or turn counter-clockwise in plan, their plans
 *     add up to what the frame encloses, and no edge is there twice
 *     an open surface ends on the frame only; a solid is sound (model/audit.h)
 *     every point of every line that was not named as left out is there, at its height
 *     what says that it comes from a point of a line lies there
 *
 * The first three bytes: what the user says, how the grid of the map lies, and the floor.
 * A vertex is two bytes: x and y, four bits each, on the grid; and
 *   bit 7      the line ends here;
 *   bit 6      it is a ring then;
 *   bit 5      no vertex, but a spot height;
 *   bits 0..3  the line's level, by its first vertex; 15: of the frame. */
#include "config.h"
#include "base/alloc.h"
#include "bridge/predicates.h"
#include "model/audit.h"
#include "model/spots.h"
#include "must.h"
#include "region/clean.h"
#include "region/joiner.h"
#include "terrain/map-edge.h"
#include "terrain/relief.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { LINE_ENDS = 0x80, IS_RING = 0x40, IS_SPOT = 0x20, N_LEVELS = 15, MOST_VERTICES = 150, OPTION_BYTES = 3 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

/* One map on its way: as drawn, as it came to the terrain, and the mesh made of it.
 * grid: where the grid lies. */
typedef struct world {
    il_sink sink;           /* between joiner and terrain */
    il_mesh_sink meshes;    /* behind it */
    il_sink *relief;
    il_relief_options options;
    unsigned grid;
    il_stack_head drawn_head, head;
    il_slice drawn[N_LEVELS], outline, slice[N_LEVELS];
    size_t n_slices;
    il_frame frame;         /* where the mesh is, but for tolerance */
    double tolerance;
    il_mesh mesh;
    il_report report;
    bool has_begun, has_mesh;
} world;

/* ---- bytes to a map --------------------------------------------------------------- */

/* Whole numbers; a map of sheets; tenths; a place turned by what doubles do not hold. */
static void place_on_grid(unsigned grid, unsigned char byte, double xy[2])
{
    double x = byte & 15, y = byte >> 4;
    xy[0] = grid == 0 ? x : grid == 1 ? 4512000 + 25 * x : grid == 2 ? 0.1 * x : 1e5 / 3 + x * 0.8 - y * 0.6;
    xy[1] = grid == 0 ? y : grid == 1 ? -5403000 + 25 * y : grid == 2 ? 0.1 * y : 1e3 / 7 + x * 0.6 + y * 0.8;
}

static double height_of_level(unsigned grid, unsigned level)
{
    return grid == 2 ? 0.1 * level : grid == 3 ? level * level : 10.0 * level - 40;
}

static void add_spot(world *w, const double xy[2], uint8_t level)
{
    il_stack_head *h = &w->drawn_head;
    must(il_grow(&h->spot, &h->cap_spots, h->n_spots + 1, sizeof *h->spot), "no memory");
    h->spot[h->n_spots] = (il_spot){ .x = xy[0], .y = xy[1], .z = height_of_level(w->grid, level) + 5, .feature = 1000 + (long)h->n_spots };
    h->n_spots++;
}

static void draw(world *w, const uint8_t *data, size_t n)
{
    il_ring *r = NULL;
    for (size_t i = 0; i + 2 <= n && i < 2 * MOST_VERTICES; i += 2) {
        double xy[2];
        unsigned level = data[i + 1] & 15;
        place_on_grid(w->grid, data[i], xy);
        if (data[i + 1] & IS_SPOT) {
            add_spot(w, xy, data[i + 1] & 15);
            continue;
        }
        if (!r) {
            must((r = il_slice_add_ring(level < N_LEVELS ? &w->drawn[level] : &w->outline)) != NULL, "no memory");
            r->open = level < N_LEVELS;
        }
        must(il_ring_add(r, xy[0], xy[1], 0), "no memory");
        if (data[i + 1] & IS_RING)
            r->open = false;
        if (data[i + 1] & LINE_ENDS)
            r = NULL;
    }
}

/* An outline when none was drawn: most of the grid, with a hole.  Clean, as frames have to be. */
static void draw_outline(world *w)
{
    static const unsigned char corner[2][4] = { { 0x11, 0x1e, 0xde, 0xd1 }, { 0x77, 0xa7, 0xaa, 0x7a } };
    for (int i = 0; i < 2 && w->outline.n < 2; i++) {
        il_ring *r = il_slice_add_ring(&w->outline);
        must(r != NULL, "no memory");
        for (int k = 0; k < 4; k++) {
            double xy[2];
            place_on_grid(w->grid, corner[i][k], xy);
            must(il_ring_add(r, xy[0], xy[1], 0), "no memory");
        }
    }
    const il_clean_options clean = { 0 };
    must(il_slice_clean(&w->outline, &clean, NULL, NULL, NULL) == IL_OK, "an outline is not cleaned");
}

static void take_options(world *w, const uint8_t *data)
{
    static const il_frame_kind kind[4] = { IL_FRAME_BBOX, IL_FRAME_HULL, IL_FRAME_OUTLINE, IL_FRAME_BBOX };
    il_placement_options *p = &w->options.placement;
    *p = (il_placement_options)IL_PLACEMENT_OPTIONS_INIT;
    w->options.frame = (il_frame_options){ .kind = kind[data[0] & 3], .outline = &w->outline };
    p->solid = data[0] & 4;
    p->round_float = data[0] & 8;
    p->recentre = data[0] & 16;
    p->fit = data[0] & 32 ? 150 : 0;
    p->z_scale = data[0] & 64 ? 3 : 1;
    p->has_base = data[0] & 128;
    p->base = height_of_level(0, data[2] & 15) - 50;
    w->grid = data[1] & 3;
    w->options.high = (il_side)((data[1] >> 2 & 3) % 3);
    w->drawn_head = (il_stack_head){ .kind = IL_KIND_TERRAIN, .unit = IL_UNIT_M };
}

/* ---- what comes to the terrain: lines are known by their features from here on ------------- */

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    world *w = (world *)self;
    return w->relief->stack_begin(w->relief, head, err);
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    world *w = (world *)self;
    long feature = 1;
    for (size_t k = 0; k < w->n_slices; k++)
        feature += (long)w->slice[k].n;
    for (size_t i = 0; i < s->n; i++)
        s->ring[i].feature = feature++;
    must(w->n_slices < N_LEVELS && il_slice_copy(&w->slice[w->n_slices++], s, NULL) == IL_OK, "no memory");
    return w->relief->slice(w->relief, s, err);
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    world *w = (world *)self;
    return w->relief->stack_end(w->relief, err);
}

static il_status on_end(il_sink *self, il_error *err)
{
    world *w = (world *)self;
    return w->relief->end(w->relief, err);
}

/* ---- what comes out of it ----------------------------------------------------------- */

static world *world_of(il_mesh_sink *self)
{
    return (world *)(void *)((char *)self - offsetof(world, meshes));
}

static il_status on_begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    world *w = world_of(self);
    must(!w->has_begun, "a second mesh");
    w->has_begun = true;
    return il_stack_head_copy(&w->head, head, err);
}

static il_status on_piece(il_mesh_sink *self, const il_mesh *m, il_error *err)
{
    world *w = world_of(self);
    (void)err;
    must(m->slab >= -1 && m->slab < (int32_t)w->n_slices, "a slab that is none");
    for (size_t v = 0; v < m->n_vertices; v++)
        must(il_mesh_add_vertex(&w->mesh, m->xyz + 3 * v, m->origin[v]), "no memory");
    for (size_t t = 0; t < m->n_triangles; t++) {
        const uint32_t *v = m->tri + 3 * t;
        must(v[0] < w->mesh.n_vertices && v[1] < w->mesh.n_vertices && v[2] < w->mesh.n_vertices, "a vertex that is none");
        must(v[0] != v[1] && v[1] != v[2] && v[0] != v[2], "a triangle without a corner");
        must(il_mesh_add_triangle(&w->mesh, v[0], v[1], v[2]), "no memory");
    }
    return IL_OK;
}

static il_status on_mesh_end(il_mesh_sink *self, const il_mesh_facts *f, il_error *err)
{
    world *w = world_of(self);
    (void)err;
    w->has_mesh = true;
    must(f->vertices == w->mesh.n_vertices && f->triangles == w->mesh.n_triangles, "other counts than there are");
    must(f->is_open == !w->options.placement.solid, "open and solid");
    return IL_OK;
}

static void on_abandon(il_mesh_sink *self)
{
    (void)self;
}

static il_status on_finish(il_mesh_sink *self, il_error *err)
{
    (void)self, (void)err;
    return IL_OK;
}

/* ---- plan --------------------------------------------------------------------------- */

static const double *corner(const world *w, size_t t, int k)
{
    return w->mesh.xyz + 3 * (size_t)w->mesh.tri[3 * t + (size_t)k];
}

static double floor_of(const world *w)
{
    double least = INFINITY;
    for (size_t v = 0; v < w->mesh.n_vertices; v++)
        least = fmin(least, w->mesh.xyz[3 * v + 2]);
    return least;
}

static bool is_on_floor(const world *w, size_t t, double floor)
{
    return w->options.placement.solid && corner(w, t, 0)[2] == floor && corner(w, t, 1)[2] == floor && corner(w, t, 2)[2] == floor;
}

static long double plan_area(const double *a, const double *b, const double *c)
{
    long double x[2] = { (long double)b[0] - a[0], (long double)c[0] - a[0] };
    long double y[2] = { (long double)b[1] - a[1], (long double)c[1] - a[1] };
    return (x[0] * y[1] - x[1] * y[0]) / 2;
}

static double largest_coordinate(const il_slice *s)
{
    double most = 0;
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < 2 * s->ring[i].n; k++)
            most = fmax(most, fabs(s->ring[i].xy[k]));
    return most;
}

/* The rings of the frame, where the mesh is, and what rounding may do to places on it. */
static void place_frame(world *w)
{
    double scale = w->head.has_placement ? w->head.placement.scale[0] : 1;
    w->tolerance = largest_coordinate(&w->frame.rings) / scale * 0x1p-42;
    for (size_t i = 0; i < w->frame.rings.n; i++)
        for (size_t k = 0; k < w->frame.rings.ring[i].n; k++)
            il_placement_apply(&w->head, &w->options.placement, w->frame.rings.ring[i].xy + 2 * k, w->frame.rings.ring[i].xy + 2 * k);
    w->tolerance += largest_coordinate(&w->frame.rings) * (w->options.placement.round_float ? 0x1p-20 : 0x1p-42);
}

static bool is_told(const world *w, const char *words)
{
    for (size_t k = 0; k < w->report.n_notes; k++)
        if (strstr(w->report.note[k], words))
            return true;
    for (size_t k = 0; k < w->report.n_skips; k++)
        if (strstr(w->report.skip[k].what, words))
            return true;
    return false;
}

static void check_plan(const world *w)
{
    double floor = floor_of(w), frame = 0, length = 0;
    long double area = 0, below = 0;
    for (size_t t = 0; t < w->mesh.n_triangles; t++) {
        int turn = il_orientation(corner(w, t, 0), corner(w, t, 1), corner(w, t, 2));
        if (is_on_floor(w, t, floor)) {
            must(turn < 0, "the floor is turned over");
            below -= plan_area(corner(w, t, 0), corner(w, t, 1), corner(w, t, 2));
        } else {
            must(turn >= 0, "a triangle is turned over");
            area += plan_area(corner(w, t, 0), corner(w, t, 1), corner(w, t, 2));
        }
    }
    for (size_t i = 0; i < w->frame.rings.n; i++) {
        frame += il_ring_area2(&w->frame.rings.ring[i]) / 2;
        length += il_ring_length(&w->frame.rings.ring[i]);
    }
    if (w->options.placement.solid)
        must(fabsl(area - below) <= length * w->tolerance, "surface and floor do not cover the same");
    must(fabsl(area - frame) <= length * w->tolerance || (area < frame && is_told(w, "a part of the frame")),
         "the surface does not cover what the frame encloses");
}

/* ---- edges --------------------------------------------------------------------------- */

static double distance2_to_edge(const double *p, const double *a, const double *b)
{
    double d[2] = { b[0] - a[0], b[1] - a[1] }, l2 = d[0] * d[0] + d[1] * d[1];
    double u = l2 > 0 ? ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / l2 : 0;
    u = fmin(1, fmax(0, u));
    double x = a[0] + u * d[0] - p[0], y = a[1] + u * d[1] - p[1];
    return x * x + y * y;
}

static bool is_on_frame(const world *w, const double *p)
{
    double least = INFINITY;
    for (size_t i = 0; i < w->frame.rings.n; i++) {
        const il_ring *r = &w->frame.rings.ring[i];
        for (size_t k = 0; k < r->n; k++)
            least = fmin(least, distance2_to_edge(p, r->xy + 2 * k, r->xy + 2 * ((k + 1) % r->n)));
    }
    return least <= w->tolerance * w->tolerance;
}

static int by_number(const void *pa, const void *pb)
{
    const uint64_t *a = pa, *b = pb;
    return (*a > *b) - (*a < *b);
}

static void check_edges(const world *w)
{
    size_t n = 3 * w->mesh.n_triangles;
    uint64_t *edge = calloc(n, sizeof *edge);
    must(edge != NULL, "no memory");
    for (size_t k = 0; k < n; k++)
        edge[k] = (uint64_t)w->mesh.tri[k] << 32 | w->mesh.tri[k % 3 == 2 ? k - 2 : k + 1];
    qsort(edge, n, sizeof *edge, by_number);
    for (size_t k = 0; k < n; k++) {
        uint64_t a = edge[k] >> 32, b = edge[k] & UINT32_MAX, reverse = b << 32 | a;
        must(k == 0 || edge[k] != edge[k - 1], "an edge is there several times");
        must(bsearch(&reverse, edge, n, sizeof *edge, by_number) ||
                 (is_on_frame(w, w->mesh.xyz + 3 * (size_t)a) && is_on_frame(w, w->mesh.xyz + 3 * (size_t)b)),
             "the surface ends inside the frame");
    }
    free(edge);
}

static void check_mesh(const world *w)
{
    il_audit a;
    for (size_t k = 0; k < 3 * w->mesh.n_vertices; k++)
        must(isfinite(w->mesh.xyz[k]), "a vertex is nowhere");
    must(w->mesh.n_triangles > 0, "no triangles");
    must(il_mesh_audit(&w->mesh, &a, NULL) == IL_OK, "no audit");
    must(!w->options.placement.solid || il_audit_is_sound(&a), "a solid is not sound");
    must(a.self_intersections == 0 && a.degenerate_triangles == 0 && a.loose_vertices == 0, "a surface is not sound");
    must(a.manifold && a.oriented, "a surface is no manifold");
}

/* ---- lines --------------------------------------------------------------------------- */

static bool is_left_out(const world *w, long number)
{
    char feature[40];
    snprintf(feature, sizeof feature, "(feature %ld)", number);
    for (size_t k = 0; k < w->report.n_skips; k++)
        if (strstr(w->report.skip[k].what, feature))
            return true;
    return false;
}

static void place(const world *w, size_t level, const double *xy, double to[3])
{
    il_placement_apply(&w->head, &w->options.placement, xy, to);
    to[2] = il_placement_height(&w->head, &w->options.placement, w->slice[level].z);
}

static bool has_vertex(const world *w, const double at[3])
{
    for (size_t v = 0; v < w->mesh.n_vertices; v++)
        if (memcmp(w->mesh.xyz + 3 * v, at, 2 * sizeof *at) == 0 && w->mesh.xyz[3 * v + 2] == at[2])
            return true;
    return false;
}

/* Is P, where the mesh is, inside the outline, and not so near to it that rounding would tell? */
static bool is_inside(const world *w, const double *p)
{
    bool inside = false;
    for (size_t i = 0; i < w->frame.rings.n; i++) {
        const il_ring *r = &w->frame.rings.ring[i];
        for (size_t k = 0; k < r->n; k++) {
            const double *a = r->xy + 2 * k, *b = r->xy + 2 * ((k + 1) % r->n);
            if ((a[1] > p[1]) != (b[1] > p[1]))
                inside ^= p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        }
    }
    return inside && !is_on_frame(w, p);
}

/* Is the edge from vertex V no isoline, as there is none there or it is the map's edge? */
static bool is_map_edge(const il_ring *r, size_t v)
{
    return (r->open && v + 1 == r->n) || (r->mark && r->mark[v] & IL_VERTEX_MAP_EDGE);
}

/* Outside of the outline, or of what is left of it; where rounding folds the frame or puts what
 * lies on a slanted one outside of it, which is told. */
static bool may_be_missing(const world *w, const double *at)
{
    return (w->options.frame.kind == IL_FRAME_OUTLINE && (!is_inside(w, at) || is_told(w, "a part of the frame"))) ||
           ((w->options.placement.round_float || w->options.frame.kind == IL_FRAME_HULL) && is_told(w, "outside the frame"));
}

static void check_lines(const world *w)
{
    for (size_t k = 0; k < w->n_slices; k++)
        for (size_t i = 0; i < w->slice[k].n; i++) {
            const il_ring *r = &w->slice[k].ring[i];
            for (size_t v = 0; v < r->n && !is_left_out(w, r->feature); v++) {
                double at[3];
                if (is_map_edge(r, v) && is_map_edge(r, v > 0 ? v - 1 : r->n - 1))
                    continue;
                place(w, k, r->xy + 2 * v, at);
                must(has_vertex(w, at) || may_be_missing(w, at), "a point of a line is not there at its height");
            }
        }
}

/* Upright ground may pass a spot between two of its vertices. */
static bool is_on_cliff(const world *w, const double at[3])
{
    bool below = false, above = false;
    for (size_t v = 0; v < w->mesh.n_vertices; v++)
        if (memcmp(w->mesh.xyz + 3 * v, at, 2 * sizeof *at) == 0) {
            below = below || w->mesh.xyz[3 * v + 2] < at[2];
            above = above || w->mesh.xyz[3 * v + 2] > at[2];
        }
    return below && above;
}

static void check_spots(const world *w)
{
    for (size_t i = 0; i < w->drawn_head.n_spots; i++) {
        const il_spot *s = &w->drawn_head.spot[i];
        const double xy[2] = { s->x, s->y };
        double at[3];
        il_placement_apply(&w->head, &w->options.placement, xy, at);
        at[2] = il_placement_height(&w->head, &w->options.placement, s->z);
        must(is_left_out(w, s->feature) || has_vertex(w, at) || is_on_cliff(w, at), "a spot height is not there");
    }
}

static void check_origins(const world *w)
{
    for (size_t v = 0; v < w->mesh.n_vertices; v++) {
        const il_origin *o = &w->mesh.origin[v];
        double at[3];
        must(o->stack == 0 && o->slice < (int32_t)w->n_slices, "an origin that is none");
        if (o->vertex < 0)
            continue;
        must(o->slice >= 0 && (size_t)o->ring < w->slice[o->slice].n, "an origin on no line");
        const il_ring *r = &w->slice[o->slice].ring[o->ring];
        must((size_t)o->vertex < r->n, "an origin of no point");
        place(w, (size_t)o->slice, r->xy + 2 * o->vertex, at);
        must(memcmp(w->mesh.xyz + 3 * v, at, sizeof at) == 0, "an origin that lies elsewhere");
    }
}

/* ---- all of it ------------------------------------------------------------------------ */

static il_status feed(world *w, il_sink *joiner, il_error *err)
{
    il_status st = joiner->stack_begin(joiner, &w->drawn_head, err);
    for (unsigned k = 0; k < N_LEVELS && st == IL_OK; k++) {
        w->drawn[k].z = height_of_level(w->grid, k);
        if (w->drawn[k].n > 0)
            st = joiner->slice(joiner, &w->drawn[k], err);
    }
    if (st == IL_OK)
        st = joiner->stack_end(joiner, err);
    return st == IL_OK ? joiner->end(joiner, err) : st;
}

static void check(world *w, il_status st, const il_error *err)
{
    if (st != IL_OK) {
        if (err->code != IL_E_INPUT)
            fprintf(stderr, "%d: %s\n", err->code, err->text);
        must(st == IL_E_INPUT && err->code == st && err->text[0], "refused as something else, or without a reason");
        must(!w->has_mesh, "a mesh and a refusal");
        return;
    }
    must(w->has_mesh, "neither a mesh nor a refusal");
    size_t n = 0;
    must(il_map_edge_mark(w->slice, w->n_slices, &w->options.frame, &w->drawn_head, &n, NULL) == IL_OK, "no marks the second time");
    must(il_frame_make(&w->frame, &w->options.frame, &w->drawn_head, w->slice, w->n_slices, NULL) == IL_OK, "no frame the second time");
    place_frame(w);
    check_mesh(w);
    check_plan(w);
    if (!w->options.placement.solid)
        check_edges(w);
    check_lines(w);
    check_spots(w);
    check_origins(w);
}

static void free_world(world *w)
{
    il_frame_free(&w->frame);
    il_mesh_free(&w->mesh);
    il_report_free(&w->report);
    il_stack_head_free(&w->drawn_head);
    il_stack_head_free(&w->head);
    il_slice_free(&w->outline);
    for (size_t k = 0; k < N_LEVELS; k++) {
        il_slice_free(&w->drawn[k]);
        il_slice_free(&w->slice[k]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
    world w = { .sink = { on_stack, on_slice, NULL, on_stack_end, on_end },
                .meshes = { on_begin, on_piece, on_mesh_end, on_abandon, on_finish } };
    const il_join_options join = { 0 };
    il_error err = IL_ERROR_INIT;
    il_sink *joiner = NULL;
    if (n < OPTION_BYTES)
        return 0;
    take_options(&w, data);
    draw(&w, data + OPTION_BYTES, n - OPTION_BYTES);
    draw_outline(&w);
    il_stack_head_settle_spots(&w.drawn_head, NULL);
    must(il_relief_new(&w.relief, &w.options, &w.meshes, NULL, &w.report, NULL) == IL_OK, "no memory");
    must(il_joiner_new(&joiner, &join, &w.sink, &w.report, NULL) == IL_OK, "no memory");
    check(&w, feed(&w, joiner, &err), &err);
    il_joiner_free(joiner);
    il_relief_free(w.relief);
    free_world(&w);
    return 0;
}
