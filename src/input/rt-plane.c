#include "config.h"
#include "input/rt-plane.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double to[3])
{
    for (size_t k = 0; k < 3; k++)
        to[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void scale_to_unit(double v[3])
{
    double length = sqrt(dot(v, v));
    for (size_t k = 0; k < 3; k++)
        v[k] /= length;
}

/* Twice the area of C, whose points are pairs. */
static double flat_area2(const il_rt_contour *c)
{
    const double *p = c->p;
    double sum = 0;
    for (size_t i = 2; i < c->n; i++)
        sum += (p[2 * i - 2] - p[0]) * (p[2 * i + 1] - p[1]) - (p[2 * i] - p[0]) * (p[2 * i - 1] - p[1]);
    return sum;
}

/* Twice the area of C as a vector across it: the sum of the cross products of
 * its points, seen from the first to keep the terms small. */
static void area_vector(const il_rt_contour *c, double n[3])
{
    memset(n, 0, 3 * sizeof *n);
    if (c->layout != IL_RT_OBLIQUE) {
        n[c->layout] = flat_area2(c);
        return;
    }
    for (size_t i = 2; i < c->n; i++) {
        double u[3], v[3], part[3];
        for (size_t k = 0; k < 3; k++) {
            u[k] = c->p[3 * i - 3 + k] - c->p[k];
            v[k] = c->p[3 * i + k] - c->p[k];
        }
        cross(u, v, part);
        for (size_t k = 0; k < 3; k++)
            n[k] += part[k];
    }
}

/* The plane across axis K, or the one across C. */
static il_rt_plane plane_across_axis(size_t k)
{
    il_rt_plane p = { .layout = (il_rt_layout)k };
    p.c[k] = p.a[(k + 1) % 3] = p.b[(k + 2) % 3] = 1;
    return p;
}

/* A is the axis after the one nearest to C, made square to it. */
static il_rt_plane plane_across(const double c[3], size_t nearest)
{
    il_rt_plane p = { .layout = IL_RT_OBLIQUE };
    double sign = c[nearest] < 0 ? -1 : 1;
    for (size_t k = 0; k < 3; k++)
        p.c[k] = sign * c[k];
    size_t next = (nearest + 1) % 3;
    for (size_t k = 0; k < 3; k++)
        p.a[k] = (k == next) - p.c[next] * p.c[k];
    scale_to_unit(p.a);
    cross(p.c, p.a, p.b);
    p.b[next] = 0; /* what is left there is rounding */
    return p;
}

/* The eigenvector to M's largest eigenvalue.  M is squared again and again,
 * which leaves nothing else: after 2^10 steps of the power method the second
 * eigenvalue counts only where it equals the first within a hundredth, and such
 * contours have no plane in common. */
static size_t dominant_direction(double m[3][3], double c[3])
{
    for (int round = 0; round < 10; round++) {
        double square[3][3], trace = m[0][0] + m[1][1] + m[2][2];
        for (size_t i = 0; i < 3; i++)
            for (size_t j = 0; j < 3; j++)
                square[i][j] = (m[i][0] * m[0][j] + m[i][1] * m[1][j] + m[i][2] * m[2][j]) / (trace * trace);
        memcpy(m, square, sizeof square);
    }
    size_t column = m[0][0] > m[1][1] ? 0 : 1;
    column = m[2][2] >= m[column][column] ? 2 : column;
    for (size_t k = 0; k < 3; k++)
        c[k] = m[k][column];
    scale_to_unit(c);
    size_t nearest = fabs(c[0]) > fabs(c[1]) ? 0 : 1;
    return fabs(c[2]) >= fabs(c[nearest]) ? 2 : nearest;
}

/* How far apart the points of C are along the unit vector U. */
static double spread_along(const il_rt_contour *c, const double u[3], double *least)
{
    double most = -INFINITY;
    *least = INFINITY;
    for (size_t i = 0; i < c->n; i++) {
        double p[3];
        il_rt_contour_point(c, i, p);
        *least = fmin(*least, dot(u, p));
        most = fmax(most, dot(u, p));
    }
    return most - *least;
}

il_rt_plane il_rt_plane_fit(const il_rt_contour *contour, size_t n, double flat)
{
    double m[3][3] = { { 0 } }, straight[3] = { 0 }, all = 0, c[3], least;
    for (size_t i = 0; i < n; i++) {
        double v[3], u[3];
        area_vector(&contour[i], v);
        double length = sqrt(dot(v, v));
        all += length;
        if (contour[i].layout != IL_RT_OBLIQUE)
            straight[contour[i].layout] += length;
        for (size_t k = 0; k < 3 && length > 0; k++)
            u[k] = v[k] / length;
        if (!(length > 0) || (contour[i].layout == IL_RT_OBLIQUE && spread_along(&contour[i], u, &least) > flat))
            continue;
        for (size_t j = 0; j < 9; j++)
            m[j / 3][j % 3] += v[j / 3] * u[j % 3];
    }
    for (size_t k = 3; k-- > 0;)
        if (straight[k] >= all / 2)
            return plane_across_axis(k);
    double trace = m[0][0] + m[1][1] + m[2][2];
    if (!(trace > 0) || !isfinite(trace))
        return plane_across_axis(2);
    /* At a thousandth a contour of 200 mm is 0.2 mm thick: what is flat all the same. */
    size_t nearest = dominant_direction(m, c);
    size_t one = (nearest + 1) % 3, other = (nearest + 2) % 3;
    return hypot(c[one], c[other]) < 1e-3 ? plane_across_axis(nearest) : plane_across(c, nearest);
}

double il_rt_plane_level(const il_rt_plane *p, const il_rt_contour *c, double *spread)
{
    double least;
    *spread = 0;
    if (c->layout == p->layout && c->layout != IL_RT_OBLIQUE)
        return c->level;
    *spread = spread_along(c, p->c, &least);
    return least + *spread / 2;
}

double *il_rt_plane_flatten(const il_rt_plane *p, il_rt_contour *c)
{
    double *xy = c->p;
    for (size_t i = 0; i < c->n && (c->layout != p->layout || c->layout == IL_RT_OBLIQUE); i++) {
        double at[3];
        il_rt_contour_point(c, i, at); /* reads at or behind 2 i, where it is written */
        xy[2 * i] = p->layout == IL_RT_OBLIQUE ? dot(p->a, at) : at[((size_t)p->layout + 1) % 3];
        xy[2 * i + 1] = p->layout == IL_RT_OBLIQUE ? dot(p->b, at) : at[((size_t)p->layout + 2) % 3];
    }
    c->p = NULL;
    c->n = 0;
    return xy;
}
