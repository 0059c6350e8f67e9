#include "config.h"
#include "match/global.h"

#include <math.h>

/* Area, centroid, and the symmetric second moments about it divided by area. */
typedef struct moments {
    double area, x, y, xx, xy, yy;
} moments;

/* Green's theorem, about the first vertex so that terms stay small. */
static moments moments_of(const il_outline *o)
{
    double m0 = 0, mx = 0, my = 0, mxx = 0, mxy = 0, myy = 0, ox = o->xy[0], oy = o->xy[1];
    for (size_t i = 0; i < o->n; i++) {
        const double *p = o->xy + 2 * i, *q = o->xy + 2 * o->next[i];
        double x0 = p[0] - ox, y0 = p[1] - oy, x1 = q[0] - ox, y1 = q[1] - oy, c = x0 * y1 - x1 * y0;
        m0 += c / 2;
        mx += c * (x0 + x1) / 6;
        my += c * (y0 + y1) / 6;
        mxx += c * (x0 * x0 + x0 * x1 + x1 * x1) / 12;
        myy += c * (y0 * y0 + y0 * y1 + y1 * y1) / 12;
        mxy += c * (x0 * y1 + 2 * x0 * y0 + 2 * x1 * y1 + x1 * y0) / 24;
    }
    if (!(m0 > 0))
        return (moments){ 0, 0, 0, 0, 0, 0 };
    double x = mx / m0, y = my / m0;
    return (moments){ m0, x + ox, y + oy, mxx / m0 - x * x, mxy / m0 - x * y, myy / m0 - y * y };
}

/* A symmetric 2x2 matrix (a b; b c). */
typedef struct symmetric {
    double a, b, c;
} symmetric;

/* The positive root, by Cayley and Hamilton: (M + sqrt(det) I) / sqrt(trace + 2 sqrt(det)). */
static symmetric root(symmetric m)
{
    double s = sqrt(fmax(m.a * m.c - m.b * m.b, 0)), t = sqrt(m.a + m.c + 2 * s);
    return (symmetric){ (m.a + s) / t, m.b / t, (m.c + s) / t };
}

static symmetric inverse(symmetric m)
{
    double d = m.a * m.c - m.b * m.b;
    return (symmetric){ m.c / d, -m.b / d, m.a / d };
}

/* P M P for symmetric P, which is symmetric. */
static symmetric sandwich(symmetric p, symmetric m)
{
    double t00 = p.a * m.a + p.b * m.b, t01 = p.a * m.b + p.b * m.c;
    double t10 = p.b * m.a + p.c * m.b, t11 = p.b * m.b + p.c * m.c;
    return (symmetric){ t00 * p.a + t01 * p.b, t00 * p.b + t01 * p.c, t10 * p.b + t11 * p.c };
}

/* Ratio of the eigenvalues, at least 1. */
static double eccentricity(symmetric m)
{
    double mean = (m.a + m.c) / 2, spread = hypot((m.a - m.c) / 2, m.b);
    return mean > spread ? (mean + spread) / (mean - spread) : INFINITY;
}

/* Have both regions an area, and neither 64 times as far across as the other?  Of
 * 256 cells that is four, of which no moments are worth following; and 1 / area
 * of a needle is as large as can be. */
static bool are_comparable(const moments *l, const moments *u)
{
    const double most = 64. * 64;
    return l->area > 0 && u->area > 0 && l->area <= most * u->area && u->area <= most * l->area;
}

/* G such that the centroid goes to the centroid. */
static void set(il_global *g, const double a[4], const moments *from, const moments *to)
{
    for (int k = 0; k < 4; k++)
        g->a[k] = a[k];
    g->a[4] = to->x - (a[0] * from->x + a[1] * from->y);
    g->a[5] = to->y - (a[2] * from->x + a[3] * from->y);
}

bool il_global_by_moments(const il_outline *lower, const il_outline *upper, il_global *g)
{
    moments l = moments_of(lower), u = moments_of(upper);
    if (!are_comparable(&l, &u))
        return false;
    /* A = C_u^-1/2 (C_u^1/2 C_l C_u^1/2)^1/2 C_u^-1/2 */
    symmetric cu = { u.xx, u.xy, u.yy }, cl = { l.xx, l.xy, l.yy }, half = root(cu);
    symmetric a = sandwich(inverse(half), root(sandwich(half, cl)));
    double scale = sqrt(l.area / u.area);
    if (eccentricity(a) <= 2.5)
        set(g, (double[4]){ a.a, a.b, a.b, a.c }, &u, &l);
    else
        set(g, (double[4]){ scale, 0, 0, scale }, &u, &l);
    return true;
}

/* ---- the turn ---- */

enum { BINS = 90 };

/* The greatest radius about the centroid in every direction, in roots of the area. */
static void signature(const il_outline *o, const moments *m, double s[BINS])
{
    double unit = sqrt(m->area);
    for (int k = 0; k < BINS; k++)
        s[k] = 0;
    for (size_t i = 0; i < o->n; i++) {
        const double *p = o->xy + 2 * i, *q = o->xy + 2 * o->next[i];
        double length = hypot(q[0] - p[0], q[1] - p[1]) / unit;
        int parts = length < 1 ? 1 + (int)(length * 32) : 32;
        for (int k = 0; k < parts; k++) {
            double t = (double)k / parts, x = p[0] + t * (q[0] - p[0]) - m->x, y = p[1] + t * (q[1] - p[1]) - m->y;
            int bin = (int)floor((atan2(y, x) / (2 * acos(-1.0)) + 0.5) * BINS);
            bin = bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin;
            s[bin] = fmax(s[bin], hypot(x, y) / unit);
        }
    }
    for (int pass = 0; pass < 2; pass++) /* directions that no point fell into */
        for (int k = 0; k < BINS; k++)
            if (!(s[k] > 0))
                s[k] = s[(k + BINS - 1) % BINS];
}

/* Sum of squared differences when the second is turned by K bins. */
static double difference(const double a[BINS], const double b[BINS], int k)
{
    double sum = 0;
    for (int i = 0; i < BINS; i++) {
        double d = a[(i + k + BINS) % BINS] - b[i];
        sum += d * d;
    }
    return sum;
}

bool il_global_with_turn(const il_outline *lower, const il_outline *upper, il_global *g)
{
    moments l = moments_of(lower), u = moments_of(upper);
    double a[BINS], b[BINS], best;
    int at = 0;
    if (!are_comparable(&l, &u))
        return false;
    signature(lower, &l, a);
    signature(upper, &u, b);
    double straight = best = difference(a, b, 0);
    for (int k = -BINS / 4; k <= BINS / 4; k++)
        if (difference(a, b, k) < best) {
            best = difference(a, b, k);
            at = k;
        }
    if (!(best < 0.7 * straight))
        return false;
    /* the least of the parabola through the best bin and its neighbours */
    double before = difference(a, b, at - 1), after = difference(a, b, at + 1), bend = before - 2 * best + after;
    double angle = (at + (bend > 0 ? (before - after) / (2 * bend) : 0)) * 2 * acos(-1.0) / BINS;
    double scale = sqrt(l.area / u.area), c = scale * cos(angle), s = scale * sin(angle);
    set(g, (double[4]){ c, -s, s, c }, &u, &l);
    return true;
}
