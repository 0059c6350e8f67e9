/* nurbs.c - Bezier pieces by blossoms (Ramshaw 1989), halved by de Casteljau. */
#include "config.h"
#include "input/nurbs.h"
#include "input/curve.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* A piece is halved at most so often: 4096 chords, where the relative flatness asks
 * for some 1000 of a cubic. */
enum { ORDER_MOST = IL_NURBS_DEGREE_MOST + 1, DEEPEST = 12 };

/* p: w x, w y, w z, w of each point. */
typedef struct bezier { double p[ORDER_MOST][4]; } bezier;

static void weigh(const il_nurbs *c, size_t i, double *to)
{
    double w = c->weight ? c->weight[i] : 1;
    for (int k = 0; k < 3; k++)
        to[k] = w * c->point[3 * i + (size_t)k];
    to[3] = w;
}

static void mix(double *to, const double *a, const double *b, double t)
{
    for (int k = 0; k < 4; k++)
        to[k] = (1 - t) * a[k] + t * b[k];
}

/* The blossom of the span K at p - J times its lower knot and J times its upper one,
 * which is the Bezier point J of it. */
static void blossom(const il_nurbs *c, size_t k, int j, double *to)
{
    const int p = c->degree;
    const double *t = c->knot + (k - (size_t)p);
    bezier b;
    for (int i = 0; i <= p; i++)
        weigh(c, k - (size_t)p + (size_t)i, b.p[i]);
    for (int r = 1; r <= p; r++) {
        double u = r <= j ? t[p + 1] : t[p];
        for (int i = p; i >= r; i--)
            mix(b.p[i], b.p[i - 1], b.p[i], (u - t[i]) / (t[i + p - r + 1] - t[i]));
    }
    memcpy(to, b.p[p], sizeof b.p[p]);
}

/* Distance of B from the segment P to Q. */
static double distance(const double *b, const double *p, const double *q)
{
    double dx = q[0] / q[3] - p[0] / p[3], dy = q[1] / q[3] - p[1] / p[3];
    double x = b[0] / b[3] - p[0] / p[3], y = b[1] / b[3] - p[1] / p[3];
    double n = dx * dx + dy * dy, t = n > 0 ? fmin(fmax((x * dx + y * dy) / n, 0), 1) : 0;
    return hypot(x - t * dx, y - t * dy);
}

/* A curve lies in the hull of its points, so no farther from the chord than they do;
 * its size is that of their way. */
static bool is_flat(const bezier *b, int degree, double flatness)
{
    double farthest = 0, way = 0;
    for (int i = 1; i <= degree; i++) {
        farthest = fmax(farthest, distance(b->p[i], b->p[0], b->p[degree]));
        way += hypot(b->p[i][0] / b->p[i][3] - b->p[i - 1][0] / b->p[i - 1][3],
                     b->p[i][1] / b->p[i][3] - b->p[i - 1][1] / b->p[i - 1][3]);
    }
    return !(farthest > il_curve_tolerance(flatness, way));
}

/* B becomes its first half, and RIGHT the other. */
static void halve(bezier *b, bezier *right, int degree)
{
    for (int r = 0; r <= degree; r++) {
        memcpy(right->p[degree - r], b->p[degree], sizeof *b->p);
        for (int i = degree; i > r; i--)
            mix(b->p[i], b->p[i - 1], b->p[i], 0.5);
    }
}

/* What goes with every point.  z: of all control points, when it is one: rounding
 * would turn an isoline into a line whose height varies. */
typedef struct drawing {
    il_nurbs_put *put;
    void *self;
    double flatness, z;
    bool has_z;
} drawing;

static il_status put_point(const drawing *d, const double *p, il_error *err)
{
    return d->put(d->self, p[0] / p[3], p[1] / p[3], d->has_z ? d->z : p[2] / p[3], err);
}

/* The points of B behind its first.  A stack of right halves takes the place of
 * recursion. */
static il_status draw_piece(const drawing *d, bezier *b, int degree, il_error *err)
{
    bezier right[DEEPEST];
    int depth[DEEPEST], top = 0, deep = 0;
    for (;;) {
        while (deep < DEEPEST && !is_flat(b, degree, d->flatness)) {
            halve(b, &right[top], degree);
            depth[top++] = ++deep;
        }
        il_status st = put_point(d, b->p[degree], err);
        if (st != IL_OK || top == 0)
            return st;
        *b = right[--top];
        deep = depth[top];
    }
}

static bool find_height(const il_nurbs *c, double *z)
{
    *z = c->point[2];
    for (size_t i = 1; i < c->n; i++)
        if (c->point[3 * i + 2] != *z)
            return false;
    return true;
}

il_status il_nurbs_draw(const il_nurbs *c, double flatness, il_nurbs_put *put, void *self, il_error *err)
{
    drawing d = { put, self, flatness, 0, false };
    d.has_z = find_height(c, &d.z);
    bool is_begun = false;
    il_status st = IL_OK;
    for (size_t k = (size_t)c->degree; k < c->n && st == IL_OK; k++) {
        bezier b;
        if (!(c->knot[k] < c->knot[k + 1]))
            continue;
        for (int j = 0; j <= c->degree; j++)
            blossom(c, k, j, b.p[j]);
        if (!is_begun)
            st = put_point(&d, b.p[0], err);
        is_begun = true;
        if (st == IL_OK)
            st = draw_piece(&d, &b, c->degree, err);
    }
    return st;
}
