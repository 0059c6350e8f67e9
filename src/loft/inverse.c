#include "config.h"
#include "loft/inverse.h"
#include "base/alloc.h"
#include "bridge/predicates.h"

#include <math.h>
#include <string.h>

/* ---- points ---- */

static void add_point(il_inverse *v, double x, double y, double dx, double dy)
{
    v->xy[2 * v->n] = x, v->xy[2 * v->n + 1] = y;
    v->shift[2 * v->n] = dx, v->shift[2 * v->n + 1] = dy;
    v->n++;
}

/* The points that the upper side passes; number[p]: which of them p is. */
static void add_ring_points(il_inverse *v, const il_overlay *o, uint32_t *number)
{
    for (uint32_t p = 0; p < o->n_contour; p++) {
        number[p] = IL_NONE;
        if (o->pass[IL_UPPER][p].station == IL_NONE)
            continue;
        double at[2], real[2];
        il_snapped_point(o->snapped, p, at);
        il_overlay_upper_point(o, p, real);
        number[p] = (uint32_t)v->n;
        add_point(v, o->xy[2 * p], o->xy[2 * p + 1], real[0] - at[0], real[1] - at[1]);
    }
}

/* The box of the fit in grid units, widened where it does not hold all points. */
static void find_box(const il_overlay *o, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t i = 0; i < o->n_contour; i++)
        for (size_t k = 0; k < 2; k++) {
            box[k] = fmin(box[k], o->xy[2 * i + k]);
            box[k + 2] = fmax(box[k + 2], o->xy[2 * i + k]);
        }
    double margin = 1 + fmax(box[2] - box[0], box[3] - box[1]) / 8;
    const il_fit *fit = o->reference->fit;
    for (size_t k = 0; k < 2; k++) {
        box[k] -= margin;
        box[k + 2] += margin;
        for (size_t e = k; fit && e < 4; e += 2) {
            double q = (fit->box[e] - o->snapped->origin[k]) / o->snapped->cell;
            if (e < 2 ? q < box[k] + margin : q > box[k + 2] - margin)
                box[e] = q;
        }
    }
}

/* The inverse of the global step takes Q by this much, if it is finite and moves
 * by less than REACH. */
static bool global_shift(const double g[6], const double q[2], double reach, double out[2])
{
    double det = g[0] * g[3] - g[1] * g[2], x = q[0] - g[4], y = q[1] - g[5];
    out[0] = (g[3] * x - g[1] * y) / det - q[0];
    out[1] = (g[0] * y - g[2] * x) / det - q[1];
    return fabs(out[0]) < reach && fabs(out[1]) < reach;
}

/* The corners follow the inverse global step; without a good one, the rings on
 * average. */
static void add_corners(il_inverse *v, const il_overlay *o)
{
    double box[4], mean[2] = { 0, 0 };
    const il_fit *fit = o->reference->fit;
    find_box(o, box);
    for (size_t i = 0; i < 2 * v->n; i++)
        mean[i % 2] += v->shift[i] / (double)v->n;
    double size = fmax(box[2] - box[0], box[3] - box[1]) * o->snapped->cell;
    double reach = 1e3 * (size + fmax(fabs(mean[0]), fabs(mean[1])));
    for (int c = 0; c < 4; c++) {
        double x = box[c % 2 ? 2 : 0], y = box[c / 2 ? 3 : 1], shift[2];
        double q[2] = { o->snapped->origin[0] + o->snapped->cell * x, o->snapped->origin[1] + o->snapped->cell * y };
        bool good = fit && global_shift(fit->global, q, reach, shift);
        add_point(v, x, y, good ? shift[0] : mean[0], good ? shift[1] : mean[1]);
    }
}

/* ---- triangles ---- */

static il_status triangulate(il_inverse *v, const il_overlay *o, const uint32_t *number, il_error *err)
{
    const uint32_t *run = o->snapped->run[IL_UPPER], *point = o->snapped->point[IL_UPPER];
    const il_ref_side *side = &o->reference->side[IL_UPPER];
    uint32_t *edge = il_alloc(o->snapped->n_points[IL_UPPER], 2 * sizeof *edge);
    if (!edge)
        return il_fail_nomem(err);
    size_t n = 0;
    for (size_t i = 0; i < side->n; i++)
        for (uint32_t j = run[i]; j < run[i + 1]; j++) {
            edge[2 * n] = number[point[j]];
            edge[2 * n + 1] = number[j + 1 < run[i + 1] ? point[j + 1] : point[run[side->next[i]]]];
            n += edge[2 * n] != edge[2 * n + 1];
        }
    il_triangulation *t = NULL;
    il_status st = il_triangulation_new(&t, v->xy, v->n, edge, n, err);
    if (st == IL_OK)
        st = il_triangulation_export(t, &v->corner, &v->across, &v->n_triangles, err);
    il_triangulation_free(t);
    il_free(edge);
    return st;
}

il_status il_inverse_build(il_inverse *v, const il_overlay *o, il_error *err)
{
    *v = (il_inverse){ 0 };
    uint32_t *number = il_alloc(o->n_contour, sizeof *number);
    v->xy = il_alloc(o->n_contour + 4, 2 * sizeof *v->xy);
    v->shift = il_alloc(o->n_contour + 4, 2 * sizeof *v->shift);
    il_status st = number && v->xy && v->shift ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK) {
        add_ring_points(v, o, number);
        add_corners(v, o);
        st = triangulate(v, o, number, err);
    }
    il_free(number);
    if (st != IL_OK)
        il_inverse_free(v);
    return st;
}

void il_inverse_free(il_inverse *v)
{
    il_free(v->xy);
    il_free(v->shift);
    il_free(v->corner);
    il_free(v->across);
    *v = (il_inverse){ 0 };
}

/* ---- queries ---- */

static const double *corner_xy(const il_inverse *v, uint32_t t, uint32_t k)
{
    return v->xy + 2 * (size_t)v->corner[3 * t + k % 3];
}

/* The edge of triangle T that P is beyond, none of FROM's; 3 when P is inside. */
static uint32_t edge_towards(const il_inverse *v, uint32_t t, uint32_t from, const double p[2])
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t u = v->across[3 * t + k];
        if (u != from && u != UINT32_MAX && il_orientation(corner_xy(v, t, k), corner_xy(v, t, k + 1), p) < 0)
            return k;
    }
    return 3;
}

static bool holds(const il_inverse *v, uint32_t t, const double p[2])
{
    for (uint32_t k = 0; k < 3; k++)
        if (il_orientation(corner_xy(v, t, k), corner_xy(v, t, k + 1), p) < 0)
            return false;
    return true;
}

/* Walk from the last triangle found.  The walk may go in circles, since not all
 * triangles are Delaunay's: then all are tried. */
static uint32_t locate(il_inverse *v, const double p[2])
{
    uint32_t t = v->last, from = UINT32_MAX;
    for (size_t steps = 0; steps < v->n_triangles; steps++) {
        uint32_t k = edge_towards(v, t, from, p);
        if (k == 3)
            break;
        from = t;
        t = v->across[3 * t + k];
    }
    for (uint32_t u = 0; !holds(v, t, p) && u < v->n_triangles; u++)
        if (holds(v, u, p))
            t = u;
    v->last = t;
    return t;
}

void il_inverse_shift(il_inverse *v, const double grid[2], double out[2])
{
    uint32_t t = locate(v, grid);
    double weight[3], sum = 0;
    for (uint32_t k = 0; k < 3; k++) {
        const double *a = corner_xy(v, t, k + 1), *b = corner_xy(v, t, k + 2);
        weight[k] = fmax(0, (a[0] - grid[0]) * (b[1] - grid[1]) - (b[0] - grid[0]) * (a[1] - grid[1]));
        sum += weight[k];
    }
    out[0] = out[1] = 0;
    for (uint32_t k = 0; k < 3; k++) {
        const double *shift = v->shift + 2 * (size_t)v->corner[3 * t + k];
        double part = sum > 0 ? weight[k] / sum : 1.0 / 3;
        out[0] += part * shift[0];
        out[1] += part * shift[1];
    }
}
