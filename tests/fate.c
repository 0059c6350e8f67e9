#include "config.h"
#include "fate.h"
#include "base/alloc.h"
#include "base/forest.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

static uint32_t end_of_edge(const solid *s, size_t e)
{
    return s->tri[e % 3 == 2 ? e - 2 : e + 1];
}

static double height(const solid *s, uint32_t v)
{
    return s->xyz[3 * (size_t)v + 2];
}

static void join_levels(fates *f)
{
    const solid *s = f->s;
    il_forest_plant(f->level, s->n_vertices);
    for (size_t e = 0; e < 3 * s->n_triangles; e++)
        if (!(height(s, s->tri[e]) < height(s, end_of_edge(s, e))) && !(height(s, s->tri[e]) > height(s, end_of_edge(s, e))))
            il_forest_join(f->level, s->tri[e], end_of_edge(s, e));
    for (size_t v = 0; v < s->n_vertices; v++)
        f->level[v] = il_forest_leader(f->level, (uint32_t)v);
}

static double slope(const solid *s, const double from[3], uint32_t to)
{
    const double *b = s->xyz + 3 * (size_t)to;
    return (b[2] - from[2]) / hypot(hypot(b[0] - from[0], b[1] - from[1]), b[2] - from[2]);
}

void fates_find(fates *f, const solid *s)
{
    size_t n = s->n_vertices;
    double *best[2];
    f->s = s;
    f->level = solid_must(il_alloc(n, sizeof *f->level));
    join_levels(f);
    for (int up = 0; up < 2; up++) {
        f->next[up] = solid_must(il_alloc(n, sizeof *f->next[up]));
        best[up] = solid_must(il_calloc(n, sizeof *best[up]));
        memset(f->next[up], 0xff, n * sizeof *f->next[up]);
    }
    for (size_t e = 0; e < 3 * s->n_triangles; e++) { /* each edge comes both ways */
        uint32_t a = f->level[s->tri[e]], b = end_of_edge(s, e);
        double rise = a == f->level[b] ? 0 : slope(s, s->xyz + 3 * (size_t)s->tri[e], b);
        int up = rise > 0;
        if (fabs(rise) > best[up][a]) {
            best[up][a] = fabs(rise);
            f->next[up][a] = b;
        }
    }
    il_free(best[0]);
    il_free(best[1]);
}

void fates_free(fates *f)
{
    il_free(f->level);
    il_free(f->next[0]);
    il_free(f->next[1]);
}

/* Is vertex V at, or beyond, plane PLANE, as one comes from below (UP) or above? */
static bool is_beyond(const solid *s, uint32_t v, uint32_t plane, bool up)
{
    return (s->slab_of[v] > plane) == up;
}

bool fates_goes_on(const fates *f, size_t t, const double xy[2], uint32_t plane, bool up)
{
    const solid *s = f->s;
    double from[3] = { xy[0], xy[1], s->z[plane] }, most = -1;
    uint32_t v = NONE, next = up ? plane + 1 : plane - 1;
    for (size_t k = 0; k < 3; k++) {
        uint32_t corner = s->tri[3 * t + k];
        if (!is_beyond(s, corner, plane, up))
            continue;
        double rise = height(s, corner) > from[2] || height(s, corner) < from[2] ? fabs(slope(s, from, corner)) : 0;
        if (rise > most) {
            most = rise;
            v = corner;
        }
    }
    while (v != NONE && !is_beyond(s, v, next, up))
        v = f->next[up][f->level[v]];
    return v != NONE;
}
