/* cut.c - does a mesh cut at the planes of its contours give the contours back?
 *
 *     cut MESH STREAM
 *
 * MESH is a mesh file of one stack that holds doubles (PLY), STREAM the native
 * stream that `isoloft read` makes of the same stack.  In the plane of each slice
 * the mesh has edges between a triangle that lies above and one below; a flat cap,
 * whose triangles lie in the plane, counts as below what is above it and as above
 * what is below.  With the direction of their upper triangle these edges have to be
 * the contours' edges: from vertex to vertex of the contour, bit for bit, or
 * through inserted points that lie on that edge.  A flat cap has to have the area
 * of the slice, and no other edge between triangles may lie in the plane.
 *
 * Prints "slices points components genus volume trapezoid inserted off", where
 * trapezoid is the sum of the slices' mean areas times their distances, and off the
 * farthest that an inserted point lies from its edge.  Exit 1 when the cut is
 * not the contour, with a line on standard error that says where. */
#include "config.h"
#include "gathered.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "input/mesh-file.h"
#include "model/audit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static il_status read_mesh(il_mesh *m, const char *path, il_error *err)
{
    il_source *source = NULL;
    il_mesh_file_facts facts = IL_MESH_FILE_FACTS_INIT;
    il_status st = il_source_open(&source, path, err);
    if (st == IL_OK)
        st = il_mesh_file_read(source, m, &facts, err);
    il_source_close(source);
    return st;
}

/* ---- the plane --------------------------------------------------------------------- */

/* The stack's directions in the mesh.  exact: the planes lie across an axis, so
 * that no coordinate is rounded.  slack: how far rounding may take a point off
 * its plane, and an inserted one off its edge. */
typedef struct view {
    double o[3], axis[3][3];
    bool exact, mirrored;
    double plane_slack, edge_slack;
} view;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static view view_of(const il_stack_head *h, const il_mesh *m)
{
    view v = { { 0, 0, 0 }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, true, false, 0, 0 };
    double most = 0;
    if (h->has_frame) {
        memcpy(v.o, h->frame, sizeof v.o);
        memcpy(v.axis, h->frame + 3, sizeof v.axis);
    }
    for (int k = 0; k < 9; k++)
        v.exact = v.exact && (v.axis[k / 3][k % 3] == 0 || fabs(v.axis[k / 3][k % 3]) == 1);
    for (int k = 0; k < 3; k++)
        v.exact = v.exact && v.o[k] == 0;
    const double *a = v.axis[0], *b = v.axis[1];
    double across[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
    v.mirrored = dot(across, v.axis[2]) < 0;
    for (size_t i = 0; i < 3 * m->n_vertices; i++)
        most = fmax(most, fabs(m->xyz[i]));
    v.edge_slack = 1e-12 * most;
    v.plane_slack = v.exact ? 0 : 1e-12 * most;
    return v;
}

/* A point of the stack where the writers put it (output/mesh-spool.c). */
static void place(const view *v, bool has_frame, double x, double y, double z, double to[3])
{
    for (int k = 0; k < 3; k++)
        to[k] = has_frame ? v->o[k] + x * v->axis[0][k] + y * v->axis[1][k] + z * v->axis[2][k] : k == 0 ? x : k == 1 ? y : z;
}

/* -1 below the plane at height Z, 0 in it, 1 above. */
static int side_of(const view *v, const double *p, double z)
{
    double h = dot(v->axis[2], p) - dot(v->axis[2], v->o) - z;
    return h > v->plane_slack ? 1 : h < -v->plane_slack ? -1 : 0;
}

/* ---- the mesh's edges in the plane --------------------------------------------------- */

/* Edges from vertex FROM to vertex TO; next: another one from the same position. */
typedef struct cut_edge {
    uint32_t from, to, next;
    bool used;
} cut_edge;

/* Of the slice at hand: edges in the plane, flat_area of the triangles in it.
 * inserted, off: of all slices so far. */
typedef struct cut {
    const il_mesh *mesh;
    view v;
    const char *name;
    il_keymap third;            /* directed edge -> triangle */
    cut_edge *edge;             size_t n_edges, cap_edges;
    il_keymap first;            /* position -> edge */
    double flat_area;
    double z;
    size_t inserted;
    double off;
} cut;

static const uint32_t NONE = UINT32_MAX;

static const double *point(const cut *c, uint32_t i)
{
    return c->mesh->xyz + 3 * (size_t)i;
}

/* Three coordinates as a key, of 128 bits. */
static uint64_t mix(uint64_t a, uint64_t b)
{
    a ^= b + 0x9e3779b97f4a7c15u + (a << 6) + (a >> 2);
    return a * 0xbf58476d1ce4e5b9u;
}

static uint64_t key_xy(const double *p)
{
    return mix(il_keymap_double(p[0]), il_keymap_double(p[1]));
}

static uint64_t key_yzx(const double *p)
{
    return mix(mix(il_keymap_double(p[1]), il_keymap_double(p[2])), il_keymap_double(p[0]));
}

#define POSITION(p) key_xy(p), key_yzx(p)

/* Where a triangle lies: -1 below, 0 in the plane, 1 above, 2 on both sides. */
static int triangle_side(const cut *c, size_t t)
{
    int low = 1, high = -1;
    for (int k = 0; k < 3; k++) {
        int s = side_of(&c->v, point(c, c->mesh->tri[3 * t + (size_t)k]), c->z);
        low = s < low ? s : low;
        high = s > high ? s : high;
    }
    return low < 0 && high > 0 ? 2 : low < 0 ? -1 : high;
}

static void add_flat_area(cut *c, size_t t)
{
    const uint32_t *q = c->mesh->tri + 3 * t;
    const double *a = point(c, q[0]), *b = point(c, q[1]), *d = point(c, q[2]);
    double u[3], w[3];
    for (int k = 0; k < 3; k++)
        u[k] = b[k] - a[k], w[k] = d[k] - a[k];
    double n[3] = { u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0] };
    c->flat_area += sqrt(dot(n, n)) / 2;
}

static bool fault(const cut *c, const char *what, const double *p)
{
    fprintf(stderr, "cut: %s: slice %.9g: %s at %.9g %.9g %.9g\n", c->name, c->z, what, p[0], p[1], p[2]);
    return false;
}

static bool add_edge(cut *c, uint32_t from, uint32_t to)
{
    if (!il_grow(&c->edge, &c->cap_edges, c->n_edges + 1, sizeof *c->edge))
        abort();
    c->edge[c->n_edges] = (cut_edge){ from, to, NONE, false };
    const double *p = point(c, from);
    uint32_t *head = il_keymap_put(&c->first, POSITION(p), NONE);
    if (!head)
        abort();
    c->edge[c->n_edges].next = *head;
    *head = (uint32_t)c->n_edges++;
    return true;
}

/* Edge K of triangle T, when it lies in the plane: nothing for the lower of its
 * two triangles. */
static bool take_edge(cut *c, size_t t, int k)
{
    uint32_t a = c->mesh->tri[3 * t + (size_t)k], b = c->mesh->tri[3 * t + (size_t)((k + 1) % 3)];
    if (side_of(&c->v, point(c, a), c->z) != 0 || side_of(&c->v, point(c, b), c->z) != 0)
        return true;
    uint32_t other = il_keymap_get(&c->third, b, a, NONE);
    if (other == NONE)
        return fault(c, "an open edge", point(c, a));
    int here = triangle_side(c, t), there = triangle_side(c, other);
    if (here == there)
        return here == 0 || fault(c, "an edge that is no contour's", point(c, a));
    bool is_upper = here > there;
    return is_upper != c->v.mirrored ? add_edge(c, a, b) : true;
}

/* The edges and the flat area of the N triangles that touch the plane. */
static bool collect(cut *c, const size_t *touching, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        size_t t = touching[i];
        int side = triangle_side(c, t);
        if (side == 2)
            return fault(c, "a triangle through the plane", point(c, c->mesh->tri[3 * t]));
        if (side == 0)
            add_flat_area(c, t);
        for (int k = 0; k < 3; k++)
            if (!take_edge(c, t, k))
                return false;
    }
    return true;
}

/* ---- along a contour's edge ------------------------------------------------------------- */

static bool same(const double *p, const double *q)
{
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/* How far P lies from the line A B; *T is where along it, 0 to 1. */
static double distance_from(const double *a, const double *b, const double *p, double *t)
{
    double u[3], w[3], d[3];
    for (int k = 0; k < 3; k++)
        u[k] = b[k] - a[k], w[k] = p[k] - a[k];
    *t = dot(u, w) / dot(u, u);
    for (int k = 0; k < 3; k++)
        d[k] = w[k] - *t * u[k];
    return sqrt(dot(d, d));
}

/* The mesh's edge from AT that goes on along A B, from parameter *T; NONE. */
static uint32_t next_along(cut *c, const double *at, const double *a, const double *b, double *t)
{
    uint32_t best = NONE;
    double best_t = 2;
    for (uint32_t e = il_keymap_get(&c->first, POSITION(at), NONE); e != NONE; e = c->edge[e].next) {
        const double *p = point(c, c->edge[e].to);
        double where, off = distance_from(a, b, p, &where);
        if (c->edge[e].used)
            continue;
        if (same(p, b))
            where = 1, off = 0;
        if (off > c->v.edge_slack || where <= *t || where > 1 || (where == 1 && !same(p, b)) || where >= best_t)
            continue;
        best = e;
        best_t = where;
    }
    *t = best_t;
    return best;
}

static bool walk_edge(cut *c, const double *a, const double *b)
{
    const double *at = a;
    double t = 0, unused;
    while (!same(at, b)) {
        uint32_t e = next_along(c, at, a, b, &t);
        if (e == NONE)
            return fault(c, "the contour goes on and the mesh does not", at);
        c->edge[e].used = true;
        at = point(c, c->edge[e].to);
        if (!same(at, b)) {
            c->inserted++;
            c->off = fmax(c->off, distance_from(a, b, at, &unused));
        }
    }
    return true;
}

static bool walk_ring(cut *c, const gathered *all, const il_ring *r)
{
    bool ok = true;
    for (size_t i = 0; i < r->n && ok; i++) {
        const double *p = r->xy + 2 * i, *q = r->xy + 2 * (i + 1 < r->n ? i + 1 : 0);
        double a[3], b[3];
        place(&c->v, all->head.has_frame, p[0], p[1], c->z, a);
        place(&c->v, all->head.has_frame, q[0], q[1], c->z, b);
        ok = walk_edge(c, a, b);
    }
    return ok;
}

static bool check_slice(cut *c, const gathered *all, const il_slice *s, const size_t *touching, size_t n)
{
    il_keymap_free(&c->first);
    c->n_edges = 0;
    c->flat_area = 0;
    c->z = s->z;
    bool ok = collect(c, touching, n);
    for (size_t i = 0; i < s->n && ok; i++)
        ok = walk_ring(c, all, &s->ring[i]);
    for (size_t e = 0; e < c->n_edges && ok; e++)
        if (!c->edge[e].used)
            ok = fault(c, "the mesh has an edge that no contour has", point(c, c->edge[e].from));
    double area = il_slice_area(s);
    if (ok && c->flat_area > 0 && !(fabs(c->flat_area - area) <= 1e-9 * area)) {
        fprintf(stderr, "cut: %s: slice %.9g: a flat part of %.9g, not all of the slice's %.9g\n", c->name, c->z, c->flat_area, area);
        ok = false;
    }
    return ok;
}

/* ---- the whole --------------------------------------------------------------------------- */

static bool index_edges(cut *c)
{
    bool ok = true;
    for (size_t e = 0; e < 3 * c->mesh->n_triangles && ok; e++) {
        uint32_t a = c->mesh->tri[e], b = c->mesh->tri[e % 3 == 2 ? e - 2 : e + 1];
        ok = il_keymap_put(&c->third, a, b, (uint32_t)(e / 3));
    }
    return ok;
}

/* Lists of triangles by the slices that they touch: of slice k
 * list[begin[k] .. begin[k + 1]). */
static bool touch(const cut *c, const gathered *all, size_t **begin, size_t **list)
{
    size_t n = c->mesh->n_triangles;
    *begin = il_calloc(all->n + 2, sizeof **begin);
    *list = NULL;
    if (!*begin)
        return false;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t t = 0; t < n; t++) {
            double low = INFINITY, high = -INFINITY;
            for (int k = 0; k < 3; k++) {
                double h = dot(c->v.axis[2], point(c, c->mesh->tri[3 * t + (size_t)k])) - dot(c->v.axis[2], c->v.o);
                low = fmin(low, h - c->v.plane_slack), high = fmax(high, h + c->v.plane_slack);
            }
            size_t lo = 0, hi = all->n; /* the first slice not below low */
            while (lo < hi) {
                size_t half = (lo + hi) / 2;
                if (all->slice[half].z < low)
                    lo = half + 1;
                else
                    hi = half;
            }
            for (; lo < all->n && all->slice[lo].z <= high; lo++) {
                if (pass)
                    (*list)[(*begin)[lo + 1]] = t;
                (*begin)[pass ? lo + 1 : lo + 2]++;
            }
        }
        if (pass == 0) {
            for (size_t k = 1; k < all->n + 2; k++)
                (*begin)[k] += (*begin)[k - 1];
            *list = il_alloc((*begin)[all->n + 1], sizeof **list);
            if (!*list)
                return false;
        }
    }
    return true;
}

static double trapezoid(const gathered *c)
{
    double sum = 0;
    for (size_t k = 0; k + 1 < c->n; k++)
        sum += (il_slice_area(&c->slice[k]) + il_slice_area(&c->slice[k + 1])) / 2 * (c->slice[k + 1].z - c->slice[k].z);
    return sum;
}

static bool check(cut *c, const gathered *all)
{
    size_t *begin = NULL, *list = NULL;
    bool ok = index_edges(c) && touch(c, all, &begin, &list);
    for (size_t k = 0; k < all->n && ok; k++)
        ok = check_slice(c, all, &all->slice[k], list + begin[k], begin[k + 1] - begin[k]);
    il_free(begin);
    il_free(list);
    return ok;
}

static void print_facts(const cut *c, const gathered *all, const il_audit *a)
{
    size_t points = 0;
    for (size_t k = 0; k < all->n; k++)
        points += il_slice_points(&all->slice[k]);
    printf("%zu %zu %zu %ld %.12g %.12g %zu %.3g\n", all->n, points, a->components, a->has_genus ? a->genus : -1,
           a->volume, trapezoid(all), c->inserted, c->off);
}

int main(int argc, char **argv)
{
    gathered all = { .n = 0 };
    il_mesh mesh = IL_MESH_INIT;
    il_audit audit;
    il_error err = IL_ERROR_INIT;
    if (argc != 3) {
        fputs("usage: cut MESH STREAM\n", stderr);
        return IL_E_USAGE;
    }
    il_status st = gathered_read(&all, argv[2], &err);
    if (st == IL_OK)
        st = read_mesh(&mesh, argv[1], &err);
    if (st == IL_OK)
        st = il_mesh_audit(&mesh, &audit, &err);
    if (st == IL_OK) {
        cut c = { .mesh = &mesh, .v = view_of(&all.head, &mesh), .name = argv[1] };
        st = check(&c, &all) ? IL_OK : IL_E_UNSOUND;
        print_facts(&c, &all, &audit);
        il_free(c.edge);
        il_keymap_free(&c.third);
        il_keymap_free(&c.first);
    } else {
        fprintf(stderr, "cut: %s: %s\n", argv[1], err.text);
    }
    gathered_free(&all);
    il_mesh_free(&mesh);
    return (int)st;
}
