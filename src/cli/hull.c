/* hull.c - points are gathered until there are many, then reduced to their hull; most
 * are not gathered at all, as they lie in a box that lies in the hull. */
#include "config.h"
#include "cli/hull.h"
#include "base/alloc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of a hull with more points than CROWD some are left out, or there would soon be no room
 * for others. */
enum { CROWD = IL_HULL_ROOM / 4 };

static int compare(const void *a, const void *b)
{
    const double *p = a, *q = b;
    if (p[0] != q[0])
        return p[0] < q[0] ? -1 : 1;
    return (p[1] > q[1]) - (p[1] < q[1]);
}

/* Twice the area of the triangle P, Q, R, above 0 where it turns left. */
static double turn(const double *p, const double *q, const double *r)
{
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/* Append P to the chain HULL[from..n), without the points that it makes hollow; the new n. */
static size_t append(double *hull, size_t from, size_t n, const double *p)
{
    while (n >= from + 2 && turn(hull + 2 * (n - 2), hull + 2 * (n - 1), p) <= 0)
        n--;
    memcpy(hull + 2 * n, p, 2 * sizeof *p);
    return n + 1;
}

/* Leave out every other point, but those that stand out, until there are MOST: no more
 * than an eighth does so by 8 times the mean. */
static void thin(il_hull *o, size_t most)
{
    while (o->n_hull > most) {
        const size_t h = o->n_hull;
        const double first[2] = { o->xy[0], o->xy[1] };
        double sum = 0;
        size_t n = 1;
        for (size_t k = 0; k < h; k++)
            sum += turn(o->xy + 2 * k, o->xy + 2 * ((k + 1) % h), o->xy + 2 * ((k + 2) % h));
        for (size_t k = 1; k < h; k++) {
            const double *p = o->xy + 2 * k, *next = k + 1 < h ? p + 2 : first;
            if (k % 2 == 0 || turn(o->xy + 2 * (n - 1), p, next) > 8 * sum / (double)h)
                memmove(o->xy + 2 * n++, p, 2 * sizeof *p);
        }
        o->n = o->n_hull = n;
    }
}

static bool holds(const il_hull *o, double x, double y)
{
    const double p[2] = { x, y };
    for (size_t k = 0; k < o->n_hull; k++)
        if (turn(o->xy + 2 * k, o->xy + 2 * ((k + 1) % o->n_hull), p) <= 0)
            return false;
    return o->n_hull > 2;
}

/* The largest box in the hull, of those that are the box around it made smaller. */
static void find_inner(il_hull *o)
{
    double box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    for (size_t k = 0; k < o->n_hull; k++) {
        const double *p = o->xy + 2 * k;
        box[0] = fmin(box[0], p[0]);
        box[1] = fmin(box[1], p[1]);
        box[2] = fmax(box[2], p[0]);
        box[3] = fmax(box[3], p[1]);
    }
    for (double part = 0.49; part > 0; part -= 0.03) {
        double x = (box[0] + box[2]) / 2, y = (box[1] + box[3]) / 2, dx = part * (box[2] - box[0]), dy = part * (box[3] - box[1]);
        if (holds(o, x - dx, y - dy) && holds(o, x + dx, y - dy) && holds(o, x - dx, y + dy) && holds(o, x + dx, y + dy)) {
            memcpy(o->inner, (const double[]){ x - dx, y - dy, x + dx, y + dy }, sizeof o->inner);
            return;
        }
    }
}

/* Make the hull of all points (Andrew's monotone chain). */
static bool reduce(il_hull *o)
{
    double *hull = il_alloc(o->n + 1, 2 * sizeof *hull);
    size_t n = 0;
    if (!hull)
        return false;
    qsort(o->xy, o->n, 2 * sizeof *o->xy, compare);
    for (size_t k = 0; k < o->n; k++)
        n = append(hull, 0, n, o->xy + 2 * k);
    size_t from = n > 0 ? n - 1 : 0;
    for (size_t k = o->n; k-- > 1;)
        n = append(hull, from, n, o->xy + 2 * (k - 1));
    o->n = o->n_hull = n > 1 ? n - 1 : n; /* the last is the first */
    memcpy(o->xy, hull, 2 * o->n * sizeof *hull);
    il_free(hull);
    thin(o, CROWD);
    find_inner(o);
    return true;
}

bool il_hull_add(il_hull *o, const double *xy, size_t n)
{
    if (!o->xy && !(o->xy = il_alloc(IL_HULL_ROOM, 2 * sizeof *o->xy)))
        return false;
    for (size_t k = 0; k < n; k++) {
        const double *p = xy + 2 * k;
        if (p[0] > o->inner[0] && p[0] < o->inner[2] && p[1] > o->inner[1] && p[1] < o->inner[3])
            continue;
        if (o->n == IL_HULL_ROOM && !reduce(o))
            return false;
        memcpy(o->xy + 2 * o->n++, p, 2 * sizeof *p);
    }
    return true;
}

bool il_hull_settle(il_hull *o)
{
    if (o->n > 0 && !reduce(o))
        return false;
    thin(o, IL_HULL_SIDES);
    for (size_t k = 0; k < o->n_hull; k++)
        for (size_t i = 0; i < o->n_hull; i++)
            o->across[k] = fmax(o->across[k], turn(o->xy + 2 * k, o->xy + 2 * ((k + 1) % o->n_hull), o->xy + 2 * i));
    return true;
}

bool il_hull_is_inside(const il_hull *o, const double *p, double share)
{
    for (size_t k = 0; k < o->n_hull; k++)
        if (turn(o->xy + 2 * k, o->xy + 2 * ((k + 1) % o->n_hull), p) <= share * o->across[k])
            return false;
    return o->n_hull > 2;
}

void il_hull_free(il_hull *o)
{
    il_free(o->xy);
    *o = (il_hull)IL_HULL_INIT;
}
