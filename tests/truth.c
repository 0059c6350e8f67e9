/* truth.c - which contours of a solid belong together, by the solid itself.
 *
 *     truth MESH STREAM
 *
 * MESH is a closed, oriented manifold of triangles (OFF), STREAM the native stream of the
 * contours that horizontal planes cut out of it: plane by plane, each ring begun where the
 * plane enters the first triangle, in order of the mesh's, that it goes through.  The part of
 * the surface between two planes falls into connected pieces.  For each that has rings a line
 * is printed,
 *
 *     SLAB ; LOWER RINGS ; UPPER RINGS ; EULER NUMBER
 *
 * slab k between planes k - 1 and k, 0 below all, rings counted through the whole stream from
 * 0; pieces by slab, and then by the first triangle.  Rings too small for the stream, which it
 * left out, are left out. */
#include "config.h"
#include "gathered.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "base/keymap.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* slab_of[v]: how many planes vertex v is above.  A triangle has a part in each slab from the
 * least to the greatest of its corners': parts are numbered from first[t].  beyond[3 t + k]: the
 * triangle behind its edge k.  of[part]: forest, the connected pieces. */
typedef struct solid {
    double *xyz;             size_t n_vertices;
    uint32_t *tri;           size_t n_triangles;
    const double *z;         size_t n_planes;
    uint32_t *slab_of, *first, *beyond, *of;
    size_t n_parts;
    double size;
} solid;

/* Of a piece, at its leader. */
typedef struct piece {
    uint32_t slab;
    long euler;
    uint32_t *ring[2];       /* below, above */
    size_t n[2], cap[2];
} piece;

static void *must(void *p)
{
    if (!p)
        abort();
    return p;
}

static bool fault(const char *what)
{
    fprintf(stderr, "truth: %s\n", what);
    return false;
}

/* ---- the mesh ------------------------------------------------------------------- */

static bool read_triangles(solid *s, FILE *f)
{
    double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (size_t i = 0; i < 3 * s->n_vertices; i++) {
        if (fscanf(f, "%lf", &s->xyz[i]) != 1)
            return fault("a vertex is missing");
        low[i % 3] = fmin(low[i % 3], s->xyz[i]);
        high[i % 3] = fmax(high[i % 3], s->xyz[i]);
    }
    for (size_t t = 0; t < s->n_triangles; t++) {
        uint32_t *q = s->tri + 3 * t;
        if (fscanf(f, " 3 %u %u %u%*[^\n]", &q[0], &q[1], &q[2]) != 3)
            return fault("a face is missing, or no triangle");
        for (int k = 0; k < 3; k++)
            if (q[k] >= s->n_vertices)
                return fault("a face names no vertex");
    }
    s->size = hypot(hypot(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    return true;
}

static bool read_solid(solid *s, const char *path)
{
    FILE *f = fopen(path, "r");
    bool ok = f && fscanf(f, "OFF %zu %zu %*u", &s->n_vertices, &s->n_triangles) == 2;
    if (ok) {
        s->xyz = must(il_alloc(s->n_vertices, 3 * sizeof *s->xyz));
        s->tri = must(il_alloc(s->n_triangles, 3 * sizeof *s->tri));
        ok = read_triangles(s, f);
    } else {
        fault("no OFF file");
    }
    if (f)
        fclose(f);
    return ok;
}

/* ---- pieces --------------------------------------------------------------------- */

static uint32_t planes_below(const solid *s, double z)
{
    size_t lo = 0, hi = s->n_planes;
    while (lo < hi) {
        size_t half = (lo + hi) / 2;
        if (s->z[half] < z)
            lo = half + 1;
        else
            hi = half;
    }
    return (uint32_t)lo;
}

static uint32_t least_slab(const solid *s, size_t t)
{
    const uint32_t *q = s->tri + 3 * t;
    uint32_t a = s->slab_of[q[0]], b = s->slab_of[q[1]], c = s->slab_of[q[2]];
    return a < b ? (a < c ? a : c) : (b < c ? b : c);
}

static uint32_t greatest_slab(const solid *s, size_t t)
{
    const uint32_t *q = s->tri + 3 * t;
    uint32_t a = s->slab_of[q[0]], b = s->slab_of[q[1]], c = s->slab_of[q[2]];
    return a > b ? (a > c ? a : c) : (b > c ? b : c);
}

static uint32_t part(const solid *s, size_t t, uint32_t slab)
{
    return s->first[t] + slab - least_slab(s, t);
}

static bool number_parts(solid *s)
{
    s->slab_of = must(il_alloc(s->n_vertices, sizeof *s->slab_of));
    s->first = must(il_alloc(s->n_triangles, sizeof *s->first));
    for (size_t v = 0; v < s->n_vertices; v++)
        s->slab_of[v] = planes_below(s, s->xyz[3 * v + 2]);
    for (size_t t = 0; t < s->n_triangles; t++) {
        s->first[t] = (uint32_t)s->n_parts;
        s->n_parts += greatest_slab(s, t) - least_slab(s, t) + 1;
    }
    return s->n_parts < NONE || fault("too many parts");
}

static bool find_neighbours(solid *s)
{
    il_keymap edge = IL_KEYMAP_INIT;
    bool ok = true;
    size_t n = 3 * s->n_triangles;
    s->beyond = must(il_alloc(n, sizeof *s->beyond));
    for (size_t e = 0; e < n && ok; e++) {
        uint32_t a = s->tri[e], b = s->tri[e % 3 == 2 ? e - 2 : e + 1];
        ok = *(uint32_t *)must(il_keymap_put(&edge, a, b, (uint32_t)(e / 3))) == e / 3 || fault("two triangles share an edge's direction");
    }
    for (size_t e = 0; e < n && ok; e++) {
        s->beyond[e] = il_keymap_get(&edge, s->tri[e % 3 == 2 ? e - 2 : e + 1], s->tri[e], NONE);
        ok = s->beyond[e] != NONE || fault("the mesh is open");
    }
    il_keymap_free(&edge);
    return ok;
}

/* The slabs that edge E, of triangle E / 3, goes through. */
static void slabs_of_edge(const solid *s, size_t e, uint32_t *from, uint32_t *to)
{
    uint32_t a = s->slab_of[s->tri[e]], b = s->slab_of[s->tri[e % 3 == 2 ? e - 2 : e + 1]];
    *from = a < b ? a : b;
    *to = a < b ? b : a;
}

static void join_parts(solid *s)
{
    uint32_t from, to;
    s->of = must(il_alloc(s->n_parts, sizeof *s->of));
    il_forest_plant(s->of, s->n_parts);
    for (size_t e = 0; e < 3 * s->n_triangles; e++) {
        slabs_of_edge(s, e, &from, &to);
        for (uint32_t k = from; k <= to; k++)
            il_forest_join(s->of, part(s, e / 3, k), part(s, s->beyond[e], k));
    }
}

static piece *piece_of(solid *s, piece *p, size_t t, uint32_t slab)
{
    return &p[il_forest_leader(s->of, part(s, t, slab))];
}

/* Vertices less edges plus faces; along its rings a piece has as many edges as vertices. */
static void count(solid *s, piece *p)
{
    bool *seen = must(il_calloc(s->n_vertices, sizeof *seen));
    uint32_t from, to;
    for (size_t e = 0; e < 3 * s->n_triangles; e++) {
        size_t t = e / 3;
        slabs_of_edge(s, e, &from, &to);
        for (uint32_t k = from; k <= to && t < s->beyond[e]; k++)
            piece_of(s, p, t, k)->euler--;
        if (!seen[s->tri[e]])
            piece_of(s, p, t, s->slab_of[s->tri[e]])->euler++;
        seen[s->tri[e]] = true;
    }
    for (size_t t = 0; t < s->n_triangles; t++)
        for (uint32_t k = least_slab(s, t); k <= greatest_slab(s, t); k++) {
            piece_of(s, p, t, k)->euler++;
            piece_of(s, p, t, k)->slab = k;
        }
    il_free(seen);
}

/* ---- rings ---------------------------------------------------------------------- */

/* Edge K of triangle T goes up (DIRECTION 1), or down (-1), through plane PLANE. */
static bool goes_through(const solid *s, size_t t, int k, uint32_t plane, int direction)
{
    uint32_t a = s->tri[3 * t + (size_t)k], b = s->tri[3 * t + (size_t)((k + 1) % 3)];
    bool from_above = s->slab_of[a] > plane, to_above = s->slab_of[b] > plane;
    return from_above != to_above && to_above == (direction > 0);
}

static int edge_through(const solid *s, size_t t, uint32_t plane, int direction)
{
    int k = 0;
    while (!goes_through(s, t, k, plane, direction))
        k++;
    return k;
}

/* Is ring R begun where the plane enters triangle T?  Numbers of the stream are rounded, and
 * flat triangles make more of that. */
static bool begins_in(const solid *s, const il_ring *r, size_t t, uint32_t plane)
{
    int k = edge_through(s, t, plane, -1);
    const double *a = s->xyz + 3 * (size_t)s->tri[3 * t + (size_t)k], *b = s->xyz + 3 * (size_t)s->tri[3 * t + (size_t)((k + 1) % 3)];
    double w = (s->z[plane] - a[2]) / (b[2] - a[2]);
    return hypot(a[0] + w * (b[0] - a[0]) - r->xy[0], a[1] + w * (b[1] - a[1]) - r->xy[1]) < 1e-5 * s->size;
}

static void mark_loop(const solid *s, uint32_t t, uint32_t plane, uint32_t *seen)
{
    while (seen[t] != plane) {
        seen[t] = plane;
        t = s->beyond[3 * t + (uint32_t)edge_through(s, t, plane, 1)];
    }
}

static void add_ring(piece *p, int side, uint32_t ring)
{
    if (!il_grow(&p->ring[side], &p->cap[side], p->n[side] + 1, sizeof *p->ring[side]))
        abort();
    p->ring[side][p->n[side]++] = ring;
}

/* seen[t]: the last plane that was walked through triangle t. */
static bool take_rings(solid *s, const il_slice *slice, uint32_t plane, uint32_t first_ring, uint32_t *seen, piece *p)
{
    uint32_t ring = 0;
    for (size_t t = 0; t < s->n_triangles; t++) {
        if (seen[t] == plane || least_slab(s, t) > plane || greatest_slab(s, t) <= plane)
            continue;
        mark_loop(s, (uint32_t)t, plane, seen);
        if (ring == slice->n || !begins_in(s, &slice->ring[ring], t, plane))
            continue;
        add_ring(piece_of(s, p, t, plane), 1, first_ring + ring);
        add_ring(piece_of(s, p, t, plane + 1), 0, first_ring + ring);
        ring++;
    }
    return ring == slice->n || fault("a ring of the stream is not where a plane enters the mesh");
}

/* ---- the whole -------------------------------------------------------------------- */

static int compare_pieces(const void *pa, const void *pb)
{
    const piece *a = *(const piece *const *)pa, *b = *(const piece *const *)pb;
    if (a->slab != b->slab)
        return a->slab < b->slab ? -1 : 1;
    return (a > b) - (a < b);
}

static void print_pieces(const solid *s, piece *p)
{
    const piece **order = must(il_alloc(s->n_parts, sizeof *order));
    size_t n = 0;
    for (size_t i = 0; i < s->n_parts; i++)
        if (p[i].n[0] + p[i].n[1] > 0)
            order[n++] = &p[i];
    if (n > 0)
        qsort(order, n, sizeof *order, compare_pieces);
    for (size_t i = 0; i < n; i++) {
        printf("%u ;", order[i]->slab);
        for (int side = 0; side < 2; side++) {
            for (size_t k = 0; k < order[i]->n[side]; k++)
                printf(" %u", order[i]->ring[side][k]);
            fputs(" ;", stdout);
        }
        printf(" %ld\n", order[i]->euler);
    }
    il_free(order);
}

static bool tell(solid *s, const gathered *g)
{
    double *z = must(il_alloc(g->n, sizeof *z));
    for (size_t k = 0; k < g->n; k++)
        z[k] = g->slice[k].z;
    s->z = z;
    s->n_planes = g->n;
    bool ok = number_parts(s) && find_neighbours(s);
    piece *p = must(il_calloc(s->n_parts, sizeof *p));
    uint32_t *seen = must(il_alloc(s->n_triangles, sizeof *seen)), ring = 0;
    memset(seen, 0xff, s->n_triangles * sizeof *seen);
    if (ok) {
        join_parts(s);
        count(s, p);
    }
    for (size_t k = 0; k < g->n && ok; k++) {
        ok = take_rings(s, &g->slice[k], (uint32_t)k, ring, seen, p);
        ring += (uint32_t)g->slice[k].n;
    }
    if (ok)
        print_pieces(s, p);
    for (size_t i = 0; i < s->n_parts; i++) {
        il_free(p[i].ring[0]);
        il_free(p[i].ring[1]);
    }
    il_free(p);
    il_free(seen);
    il_free(z);
    return ok;
}

int main(int argc, char **argv)
{
    gathered g;
    solid s = { .n_parts = 0 };
    il_error err = IL_ERROR_INIT;
    if (argc != 3) {
        fputs("usage: truth MESH STREAM\n", stderr);
        return IL_E_USAGE;
    }
    il_status st = gathered_read(&g, argv[2], &err);
    if (st != IL_OK)
        fprintf(stderr, "truth: %s\n", err.text);
    else if (!read_solid(&s, argv[1]) || !tell(&s, &g))
        st = IL_E_INPUT;
    gathered_free(&g);
    il_free(s.xyz);
    il_free(s.tri);
    il_free(s.slab_of);
    il_free(s.first);
    il_free(s.beyond);
    il_free(s.of);
    return (int)st;
}
