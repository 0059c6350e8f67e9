#include "config.h"
#include "solid.h"
#include "base/alloc.h"
#include "base/keymap.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const uint32_t NONE = UINT32_MAX;

void *solid_must(void *p)
{
    if (!p)
        abort();
    return p;
}

bool solid_fault(const char *what)
{
    fprintf(stderr, "solid: %s\n", what);
    return false;
}

void solid_free(solid *s)
{
    il_free(s->xyz);
    il_free(s->tri);
    il_free(s->slab_of);
    il_free(s->beyond);
    *s = (solid)SOLID_INIT;
}

static bool read_triangles(solid *s, FILE *f)
{
    double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (size_t i = 0; i < 3 * s->n_vertices; i++) {
        if (fscanf(f, "%lf", &s->xyz[i]) != 1)
            return solid_fault("a vertex is missing");
        low[i % 3] = fmin(low[i % 3], s->xyz[i]);
        high[i % 3] = fmax(high[i % 3], s->xyz[i]);
    }
    for (size_t t = 0; t < s->n_triangles; t++) {
        uint32_t *q = s->tri + 3 * t;
        if (fscanf(f, " 3 %u %u %u%*[^\n]", &q[0], &q[1], &q[2]) != 3)
            return solid_fault("a face is missing, or no triangle");
        for (int k = 0; k < 3; k++)
            if (q[k] >= s->n_vertices)
                return solid_fault("a face names no vertex");
    }
    s->size = hypot(hypot(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    return true;
}

bool solid_read(solid *s, const char *path)
{
    FILE *f = fopen(path, "r");
    bool ok = f && fscanf(f, "OFF %zu %zu %*u", &s->n_vertices, &s->n_triangles) == 2;
    if (ok) {
        s->xyz = solid_must(il_alloc(s->n_vertices, 3 * sizeof *s->xyz));
        s->tri = solid_must(il_alloc(s->n_triangles, 3 * sizeof *s->tri));
        ok = read_triangles(s, f);
    } else {
        solid_fault("no OFF file");
    }
    if (f)
        fclose(f);
    return ok;
}

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

void solid_cut(solid *s, const double *z, size_t n)
{
    s->z = z;
    s->n_planes = n;
    s->slab_of = solid_must(il_alloc(s->n_vertices, sizeof *s->slab_of));
    for (size_t v = 0; v < s->n_vertices; v++)
        s->slab_of[v] = planes_below(s, s->xyz[3 * v + 2]);
}

uint32_t solid_least_slab(const solid *s, size_t t)
{
    const uint32_t *q = s->tri + 3 * t;
    uint32_t a = s->slab_of[q[0]], b = s->slab_of[q[1]], c = s->slab_of[q[2]];
    return a < b ? (a < c ? a : c) : (b < c ? b : c);
}

uint32_t solid_greatest_slab(const solid *s, size_t t)
{
    const uint32_t *q = s->tri + 3 * t;
    uint32_t a = s->slab_of[q[0]], b = s->slab_of[q[1]], c = s->slab_of[q[2]];
    return a > b ? (a > c ? a : c) : (b > c ? b : c);
}

bool solid_find_neighbours(solid *s)
{
    il_keymap edge = IL_KEYMAP_INIT;
    bool ok = true;
    size_t n = 3 * s->n_triangles;
    s->beyond = solid_must(il_alloc(n, sizeof *s->beyond));
    for (size_t e = 0; e < n && ok; e++) {
        uint32_t a = s->tri[e], b = s->tri[e % 3 == 2 ? e - 2 : e + 1];
        const uint32_t *whose = solid_must(il_keymap_put(&edge, a, b, (uint32_t)(e / 3)));
        ok = *whose == e / 3 || solid_fault("two triangles share an edge's direction");
    }
    for (size_t e = 0; e < n && ok; e++) {
        s->beyond[e] = il_keymap_get(&edge, s->tri[e % 3 == 2 ? e - 2 : e + 1], s->tri[e], NONE);
        ok = s->beyond[e] != NONE || solid_fault("the mesh is open");
    }
    il_keymap_free(&edge);
    return ok;
}

/* Edge K of triangle T goes up (DIRECTION 1), or down (-1), through plane PLANE. */
static bool goes_through(const solid *s, size_t t, int k, uint32_t plane, int direction)
{
    uint32_t a = s->tri[3 * t + (size_t)k], b = s->tri[3 * t + (size_t)((k + 1) % 3)];
    bool from_above = s->slab_of[a] > plane, to_above = s->slab_of[b] > plane;
    return from_above != to_above && to_above == (direction > 0);
}

int solid_edge_through(const solid *s, size_t t, uint32_t plane, int direction)
{
    int k = 0;
    while (!goes_through(s, t, k, plane, direction))
        k++;
    return k;
}

void solid_cross(const solid *s, size_t t, uint32_t plane, int direction, double at[2])
{
    int k = solid_edge_through(s, t, plane, direction);
    const double *a = s->xyz + 3 * (size_t)s->tri[3 * t + (size_t)k], *b = s->xyz + 3 * (size_t)s->tri[3 * t + (size_t)((k + 1) % 3)];
    double w = (s->z[plane] - a[2]) / (b[2] - a[2]);
    at[0] = a[0] + w * (b[0] - a[0]);
    at[1] = a[1] + w * (b[1] - a[1]);
}
