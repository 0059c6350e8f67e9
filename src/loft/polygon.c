#include "config.h"
#include "loft/polygon.h"
#include "loft/sector.h"

#include <math.h>

static bool same_plane(const il_polygon_vertex *a, const il_polygon_vertex *b)
{
    return a->label == b->label && a->label != IL_FREE;
}

/* Do places A, B and C all lie on edge K of the triangle? */
static bool on_edge(int a, int b, int c, int k)
{
    int first = 2 * k, middle = 2 * k + 1, last = (2 * k + 2) % 6;
    return (a == first || a == middle || a == last) && (b == first || b == middle || b == last) &&
           (c == first || c == middle || c == last);
}

static bool triangle_allowed(const il_polygon *p, size_t i, size_t j, size_t k)
{
    const il_polygon_vertex *a = &p->v[i], *b = &p->v[j], *c = &p->v[k];
    if (same_plane(a, b) && same_plane(b, c))
        return false;
    bool two_copies = a->at == b->at || b->at == c->at || a->at == c->at;
    for (int e = 0; e < 3; e++)
        if (on_edge(a->at, b->at, c->at, e) && (!two_copies || p->opposite[e]))
            return false;
    return true;
}

static double distance(const il_polygon_vertex *a, const il_polygon_vertex *b)
{
    double x = a->xyz[0] - b->xyz[0], y = a->xyz[1] - b->xyz[1], z = a->xyz[2] - b->xyz[2];
    return sqrt(x * x + y * y + z * z);
}

/* Cost of the chord from I to J: nothing on the outline. */
static double chord(const il_polygon *p, size_t i, size_t j)
{
    if (j == i + 1 || (i == 0 && j == p->n - 1))
        return 0;
    return same_plane(&p->v[i], &p->v[j]) ? INFINITY : distance(&p->v[i], &p->v[j]);
}

bool il_polygon_triangulate(const il_polygon *p, unsigned char tri[3 * (IL_POLYGON_MAX - 2)])
{
    /* least[i][j]: the part from i to j under the chord (i, j), by its apex
     * (Klincsek 1980) */
    double least[IL_POLYGON_MAX][IL_POLYGON_MAX];
    unsigned char apex[IL_POLYGON_MAX][IL_POLYGON_MAX];
    size_t n = p->n;
    for (size_t i = 0; i + 1 < n; i++)
        least[i][i + 1] = 0;
    for (size_t span = 2; span < n; span++)
        for (size_t i = 0; i + span < n; i++) {
            size_t j = i + span;
            least[i][j] = INFINITY;
            apex[i][j] = 0;
            for (size_t k = i + 1; k < j; k++) {
                double sum = least[i][k] + least[k][j];
                if (sum < least[i][j] && triangle_allowed(p, i, k, j))
                    least[i][j] = sum, apex[i][j] = (unsigned char)k;
            }
            least[i][j] += chord(p, i, j);
        }
    if (isinf(least[0][n - 1]))
        return false;
    struct { unsigned char i, j; } todo[IL_POLYGON_MAX] = { { 0, (unsigned char)(n - 1) } };
    size_t n_todo = 1, n_tri = 0;
    while (n_todo > 0) {
        unsigned char i = todo[--n_todo].i, j = todo[n_todo].j;
        if (j - i < 2)
            continue;
        unsigned char k = apex[i][j];
        tri[n_tri++] = i, tri[n_tri++] = k, tri[n_tri++] = j;
        todo[n_todo].i = i, todo[n_todo++].j = k;
        todo[n_todo].i = k, todo[n_todo++].j = j;
    }
    return true;
}
