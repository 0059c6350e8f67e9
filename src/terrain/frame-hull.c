/* frame-hull.c - Andrew's monotone chain (1979) on the vertices that are outside of an
 * octagon of some of them (after Akl and Toussaint, 1978). */
#include "config.h"
#include "terrain/frame-hull.h"
#include "base/alloc.h"
#include "bridge/predicates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The vertex that is farthest in each of eight directions, and how far that is. */
typedef struct octagon {
    double corner[8][2], farthest[8];
} octagon;

typedef struct points { double *xy; size_t n, cap; } points;

static const double direction[8][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 1 }, { -1, 0 }, { -1, -1 }, { 0, -1 }, { 1, -1 } };

static void stretch(octagon *o, const double *p)
{
    for (int k = 0; k < 8; k++) {
        double far = direction[k][0] * p[0] + direction[k][1] * p[1];
        if (far > o->farthest[k]) {
            o->farthest[k] = far;
            memcpy(o->corner[k], p, sizeof o->corner[k]);
        }
    }
}

/* Is P inside beyond doubt?  Differences and products are off by 2^-53 of themselves, which
 * is far below 1e-9. */
static bool is_well_inside(const octagon *o, const double *p)
{
    for (int k = 0; k < 8; k++) {
        const double *a = o->corner[k], *b = o->corner[(k + 1) % 8];
        double ux = b[0] - a[0], uy = b[1] - a[1], vx = p[0] - a[0], vy = p[1] - a[1];
        if ((ux != 0 || uy != 0) && !(ux * vy - uy * vx > 1e-9 * (fabs(ux * vy) + fabs(uy * vx))))
            return false;
    }
    return true;
}

static int compare(const void *a, const void *b)
{
    const double *p = a, *q = b;
    if (p[0] != q[0])
        return p[0] < q[0] ? -1 : 1;
    return (p[1] > q[1]) - (p[1] < q[1]);
}

/* Append P to the chain HULL[from..n), without the places that it makes hollow; the new n. */
static size_t append(double *hull, size_t from, size_t n, const double *p)
{
    while (n >= from + 2 && il_orientation(hull + 2 * (n - 2), hull + 2 * (n - 1), p) <= 0)
        n--;
    memcpy(hull + 2 * n, p, 2 * sizeof *p);
    return n + 1;
}

static il_status add_chains(il_frame_sides *s, points *o, il_error *err)
{
    double *hull = il_alloc(2 * o->n + 1, 2 * sizeof *hull);
    if (!hull)
        return il_fail_nomem(err);
    if (o->n > 0)
        qsort(o->xy, o->n, 2 * sizeof *o->xy, compare);
    size_t n = 0;
    for (size_t k = 0; k < o->n; k++)
        n = append(hull, 0, n, o->xy + 2 * k);
    size_t from = n > 0 ? n - 1 : 0;
    for (size_t k = o->n; k-- > 1;)
        n = append(hull, from, n, o->xy + 2 * (k - 1));
    n = n > 1 ? n - 1 : n; /* the last is the first */
    bool ok = n < 3 || il_frame_sides_add(s, hull, n);
    il_free(hull);
    return ok ? IL_OK : il_fail_nomem(err);
}

il_status il_frame_hull_add(il_frame_sides *s, const il_slice *level, size_t n_levels, il_error *err)
{
    octagon o;
    points p = { NULL, 0, 0 };
    for (int k = 0; k < 8; k++)
        o.farthest[k] = -INFINITY;
    for (size_t i = 0; i < n_levels; i++)
        for (size_t r = 0; r < level[i].n; r++)
            for (size_t k = 0; k < level[i].ring[r].n; k++)
                stretch(&o, level[i].ring[r].xy + 2 * k);
    for (size_t i = 0; i < n_levels; i++)
        for (size_t r = 0; r < level[i].n; r++)
            for (size_t k = 0; k < level[i].ring[r].n; k++) {
                const double *v = level[i].ring[r].xy + 2 * k;
                if (is_well_inside(&o, v))
                    continue;
                if (!il_grow(&p.xy, &p.cap, p.n + 1, 2 * sizeof *p.xy)) {
                    il_free(p.xy);
                    return il_fail_nomem(err);
                }
                memcpy(p.xy + 2 * p.n++, v, 2 * sizeof *v);
            }
    il_status st = add_chains(s, &p, err);
    il_free(p.xy);
    return st;
}
