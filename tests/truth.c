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
#include "solid.h"
#include "base/alloc.h"
#include "base/forest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* A triangle has a part in each slab from the least to the greatest of its corners': parts are
 * numbered from first[t].  of[part]: forest, the connected pieces. */
typedef struct cutting {
    solid s;
    uint32_t *first, *of;
    size_t n_parts;
} cutting;

/* Of a piece, at its leader. */
typedef struct piece {
    uint32_t slab;
    long euler;
    uint32_t *ring[2];       /* below, above */
    size_t n[2], cap[2];
} piece;

/* ---- pieces --------------------------------------------------------------------- */

static uint32_t part(const cutting *c, size_t t, uint32_t slab)
{
    return c->first[t] + slab - solid_least_slab(&c->s, t);
}

static bool number_parts(cutting *c)
{
    c->first = solid_must(il_alloc(c->s.n_triangles, sizeof *c->first));
    for (size_t t = 0; t < c->s.n_triangles; t++) {
        c->first[t] = (uint32_t)c->n_parts;
        c->n_parts += solid_greatest_slab(&c->s, t) - solid_least_slab(&c->s, t) + 1;
    }
    return c->n_parts < NONE || solid_fault("too many parts");
}

/* The slabs that edge E, of triangle E / 3, goes through. */
static void slabs_of_edge(const solid *s, size_t e, uint32_t *from, uint32_t *to)
{
    uint32_t a = s->slab_of[s->tri[e]], b = s->slab_of[s->tri[e % 3 == 2 ? e - 2 : e + 1]];
    *from = a < b ? a : b;
    *to = a < b ? b : a;
}

static void join_parts(cutting *c)
{
    uint32_t from, to;
    c->of = solid_must(il_alloc(c->n_parts, sizeof *c->of));
    il_forest_plant(c->of, c->n_parts);
    for (size_t e = 0; e < 3 * c->s.n_triangles; e++) {
        slabs_of_edge(&c->s, e, &from, &to);
        for (uint32_t k = from; k <= to; k++)
            il_forest_join(c->of, part(c, e / 3, k), part(c, c->s.beyond[e], k));
    }
}

static piece *piece_of(cutting *c, piece *p, size_t t, uint32_t slab)
{
    return &p[il_forest_leader(c->of, part(c, t, slab))];
}

/* Vertices less edges plus faces; along its rings a piece has as many edges as vertices. */
static void count(cutting *c, piece *p)
{
    bool *seen = solid_must(il_calloc(c->s.n_vertices, sizeof *seen));
    uint32_t from, to;
    for (size_t e = 0; e < 3 * c->s.n_triangles; e++) {
        size_t t = e / 3;
        slabs_of_edge(&c->s, e, &from, &to);
        for (uint32_t k = from; k <= to && t < c->s.beyond[e]; k++)
            piece_of(c, p, t, k)->euler--;
        if (!seen[c->s.tri[e]])
            piece_of(c, p, t, c->s.slab_of[c->s.tri[e]])->euler++;
        seen[c->s.tri[e]] = true;
    }
    for (size_t t = 0; t < c->s.n_triangles; t++)
        for (uint32_t k = solid_least_slab(&c->s, t); k <= solid_greatest_slab(&c->s, t); k++) {
            piece_of(c, p, t, k)->euler++;
            piece_of(c, p, t, k)->slab = k;
        }
    il_free(seen);
}

/* ---- rings ---------------------------------------------------------------------- */

/* Is ring R begun where the plane enters triangle T?  Numbers of the stream are rounded, and
 * flat triangles make more of that. */
static bool begins_in(const solid *s, const il_ring *r, size_t t, uint32_t plane)
{
    double at[2];
    solid_cross(s, t, plane, -1, at);
    return hypot(at[0] - r->xy[0], at[1] - r->xy[1]) < 1e-5 * s->size;
}

static void mark_loop(const solid *s, uint32_t t, uint32_t plane, uint32_t *seen)
{
    while (seen[t] != plane) {
        seen[t] = plane;
        t = s->beyond[3 * t + (uint32_t)solid_edge_through(s, t, plane, 1)];
    }
}

static void add_ring(piece *p, int side, uint32_t ring)
{
    if (!il_grow(&p->ring[side], &p->cap[side], p->n[side] + 1, sizeof *p->ring[side]))
        abort();
    p->ring[side][p->n[side]++] = ring;
}

/* seen[t]: the last plane that was walked through triangle t. */
static bool take_rings(cutting *c, const il_slice *slice, uint32_t plane, uint32_t first_ring, uint32_t *seen, piece *p)
{
    uint32_t ring = 0;
    for (size_t t = 0; t < c->s.n_triangles; t++) {
        if (seen[t] == plane || solid_least_slab(&c->s, t) > plane || solid_greatest_slab(&c->s, t) <= plane)
            continue;
        mark_loop(&c->s, (uint32_t)t, plane, seen);
        if (ring == slice->n || !begins_in(&c->s, &slice->ring[ring], t, plane))
            continue;
        add_ring(piece_of(c, p, t, plane), 1, first_ring + ring);
        add_ring(piece_of(c, p, t, plane + 1), 0, first_ring + ring);
        ring++;
    }
    return ring == slice->n || solid_fault("a ring of the stream is not where a plane enters the mesh");
}

/* ---- the whole -------------------------------------------------------------------- */

static int compare_pieces(const void *pa, const void *pb)
{
    const piece *a = *(const piece *const *)pa, *b = *(const piece *const *)pb;
    if (a->slab != b->slab)
        return a->slab < b->slab ? -1 : 1;
    return (a > b) - (a < b);
}

static void print_pieces(const cutting *c, piece *p)
{
    const piece **order = solid_must(il_alloc(c->n_parts, sizeof *order));
    size_t n = 0;
    for (size_t i = 0; i < c->n_parts; i++)
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

static bool tell(cutting *c, const gathered *g)
{
    double *z = solid_must(il_alloc(g->n, sizeof *z));
    for (size_t k = 0; k < g->n; k++)
        z[k] = g->slice[k].z;
    solid_cut(&c->s, z, g->n);
    bool ok = number_parts(c) && solid_find_neighbours(&c->s);
    piece *p = solid_must(il_calloc(c->n_parts, sizeof *p));
    uint32_t *seen = solid_must(il_alloc(c->s.n_triangles, sizeof *seen)), ring = 0;
    memset(seen, 0xff, c->s.n_triangles * sizeof *seen);
    if (ok) {
        join_parts(c);
        count(c, p);
    }
    for (size_t k = 0; k < g->n && ok; k++) {
        ok = take_rings(c, &g->slice[k], (uint32_t)k, ring, seen, p);
        ring += (uint32_t)g->slice[k].n;
    }
    if (ok)
        print_pieces(c, p);
    for (size_t i = 0; i < c->n_parts; i++) {
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
    cutting c = { .s = SOLID_INIT };
    il_error err = IL_ERROR_INIT;
    if (argc != 3) {
        fputs("usage: truth MESH STREAM\n", stderr);
        return IL_E_USAGE;
    }
    il_status st = gathered_read(&g, argv[2], &err);
    if (st != IL_OK)
        fprintf(stderr, "truth: %s\n", err.text);
    else if (!solid_read(&c.s, argv[1]) || !tell(&c, &g))
        st = IL_E_INPUT;
    gathered_free(&g);
    solid_free(&c.s);
    il_free(c.first);
    il_free(c.of);
    return (int)st;
}
