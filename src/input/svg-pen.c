/* svg-pen.c - subpaths, and Bezier curves in equal steps of their parameter.
 * Arcs are in svg-arc.c. */
#include "config.h"
#include "input/svg-pen.h"
#include "input/svg-arc.h"

#include <math.h>

static il_status check(double x, double y, il_error *err)
{
    if (fabs(x) < IL_SVG_COORDINATE_LIMIT && fabs(y) < IL_SVG_COORDINATE_LIMIT)
        return IL_OK;
    return il_fail(err, IL_E_INPUT, 0, "a coordinate is not finite or not below 1e15");
}

il_status il_svg_pen_place(const il_svg_pen *p, double *x, double *y, il_error *err)
{
    il_affine_apply(&p->matrix, x, y);
    return check(*x, *y, err);
}

static il_status add(il_svg_pen *p, double x, double y, il_error *err)
{
    il_status st = check(x, y, err);
    if (st != IL_OK)
        return st;
    if (p->n_points >= p->max_points)
        return il_fail(err, IL_E_INPUT, 0, "more than %zu vertices", p->max_points);
    if (!il_ring_add(p->ring, x + 0.0, y + 0.0, 0)) /* -0 + 0 is 0 */
        return il_fail_nomem(err);
    p->n_points++;
    return IL_OK;
}

il_status il_svg_pen_put(il_svg_pen *p, double x, double y, il_error *err)
{
    il_status st = IL_OK;
    if (!p->ring) {
        p->ring = il_slice_add_ring(p->slice);
        if (!p->ring)
            return il_fail_nomem(err);
        p->ring->line = p->line;
        st = add(p, p->start_x, p->start_y, err);
    }
    p->x = x;
    p->y = y;
    return st == IL_OK ? add(p, x, y, err) : st;
}

void il_svg_pen_end(il_svg_pen *p)
{
    il_ring *r = p->ring;
    p->ring = NULL;
    if (!r || r->n == 0) /* 0: there was no memory for its start */
        return;
    size_t last = r->n - 1;
    bool meets = last > 0 && r->xy[0] == r->xy[2 * last] && r->xy[1] == r->xy[2 * last + 1];
    if (meets)
        r->n = last;
    r->open = !meets;
}

void il_svg_pen_close(il_svg_pen *p)
{
    il_ring *r = p->ring;
    il_svg_pen_end(p);
    if (r)
        r->open = false;
    p->x = p->start_x;
    p->y = p->start_y;
}

il_status il_svg_pen_move(il_svg_pen *p, double x, double y, il_error *err)
{
    il_svg_pen_end(p);
    il_status st = il_svg_pen_place(p, &x, &y, err);
    p->start_x = p->x = x;
    p->start_y = p->y = y;
    return st;
}

il_status il_svg_pen_line(il_svg_pen *p, double x, double y, il_error *err)
{
    il_status st = il_svg_pen_place(p, &x, &y, err);
    return st == IL_OK ? il_svg_pen_put(p, x, y, err) : st;
}

/* ---- Bezier curves --------------------------------------------------------- */

static double box_diagonal(const double *q, int n)
{
    double lo_x = q[0], hi_x = q[0], lo_y = q[1], hi_y = q[1];
    for (int i = 1; i < n; i++) {
        lo_x = fmin(lo_x, q[2 * i]),     hi_x = fmax(hi_x, q[2 * i]);
        lo_y = fmin(lo_y, q[2 * i + 1]), hi_y = fmax(hi_y, q[2 * i + 1]);
    }
    return sqrt((hi_x - lo_x) * (hi_x - lo_x) + (hi_y - lo_y) * (hi_y - lo_y));
}

/* Largest second difference of the control polygon. */
static double bend(const double *q, int n)
{
    double most = 0;
    for (int i = 0; i + 2 < n; i++) {
        double x = q[2 * i] - 2 * q[2 * i + 2] + q[2 * i + 4];
        double y = q[2 * i + 1] - 2 * q[2 * i + 3] + q[2 * i + 5];
        most = fmax(most, sqrt(x * x + y * y));
    }
    return most;
}

/* Steps so that every chord lies within the tolerance of a Bezier curve of
 * degree D: d (d - 1) / 8 * bend / n^2 <= tolerance (Wang 1984).  The relative
 * part of the tolerance bounds the count: bend is at most 2 sizes, so n is at
 * most sqrt(3/4 * 2 / 1e-6) = 1225 for a cubic. */
static int bezier_steps(const il_svg_pen *p, const double *q, int degree)
{
    double size = box_diagonal(q, degree + 1);
    double n = ceil(sqrt(degree * (degree - 1) / 8.0 * bend(q, degree + 1) / il_curve_tolerance(p->flatness, size)));
    return n > 1 ? (int)fmin(n, 4096) : 1;
}

static il_status place_controls(il_svg_pen *p, double *q, const double *given, int n, il_error *err)
{
    il_status st = IL_OK;
    q[0] = p->x;
    q[1] = p->y;
    for (int i = 1; i <= n && st == IL_OK; i++) {
        q[2 * i] = given[2 * i - 2];
        q[2 * i + 1] = given[2 * i - 1];
        st = il_svg_pen_place(p, &q[2 * i], &q[2 * i + 1], err);
    }
    return st;
}

il_status il_svg_pen_quadratic(il_svg_pen *p, const double given[4], il_error *err)
{
    double q[6];
    il_status st = place_controls(p, q, given, 2, err);
    int n = st == IL_OK ? bezier_steps(p, q, 2) : 0;
    for (int i = 1; i < n && st == IL_OK; i++) {
        double t = (double)i / n, s = 1 - t, a = s * s, b = 2 * s * t, c = t * t;
        st = il_svg_pen_put(p, a * q[0] + b * q[2] + c * q[4], a * q[1] + b * q[3] + c * q[5], err);
    }
    return st == IL_OK ? il_svg_pen_put(p, q[4], q[5], err) : st;
}

il_status il_svg_pen_cubic(il_svg_pen *p, const double given[6], il_error *err)
{
    double q[8];
    il_status st = place_controls(p, q, given, 3, err);
    int n = st == IL_OK ? bezier_steps(p, q, 3) : 0;
    for (int i = 1; i < n && st == IL_OK; i++) {
        double t = (double)i / n, s = 1 - t;
        double a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
        st = il_svg_pen_put(p, a * q[0] + b * q[2] + c * q[4] + d * q[6],
                            a * q[1] + b * q[3] + c * q[5] + d * q[7], err);
    }
    return st == IL_OK ? il_svg_pen_put(p, q[6], q[7], err) : st;
}
