#include "config.h"
#include "terrain/plate.h"
#include "base/alloc.h"
#include "terrain/plate-grid.h"

#include <math.h>

/* Enough to keep wide bands from swinging, and little enough not to flatten tops. */
static const double TENSION = 0.3;

/* ---- bounds ---------------------------------------------------------------------- */

/* The height of level K, of which there may be none. */
static double level_z(const il_chart *c, int32_t k, int32_t every)
{
    int32_t last = (int32_t)c->n_levels - 1, e = every > last ? (last > 0 ? last : 1) : every;
    if (k >= 0 && k <= last)
        return c->level_z[k];
    if (last == 0)
        return c->level_z[0] + (k < 0 ? -1 : 1);
    double share = (double)every / e, end = c->level_z[k < 0 ? 0 : last];
    return k < 0 ? end - share * (c->level_z[e] - end) : end + share * (end - c->level_z[last - e]);
}

void il_plate_bounds(const il_chart *c, il_band b, int32_t every, double bound[2])
{
    int32_t low = b.low < 0 ? -1 : b.low - b.low % every, high = (b.high + every - 1) / every * every;
    int32_t top = ((int32_t)c->n_levels - 1) / every * every; /* the last one that counts */
    bound[0] = level_z(c, low, every);
    bound[1] = high <= top ? level_z(c, high, every) : level_z(c, top, every) + level_z(c, (int32_t)c->n_levels, every) -
               level_z(c, (int32_t)c->n_levels - 1, every);
}

/* ---- what is to be solved ------------------------------------------------------------ */

typedef struct laying {
    il_plate_grid *g;
    const il_field *f;
    double step;        /* between nodes */
    int32_t every;
} laying;

/* An edge of a line meets the edge of the grid from NODE on along AXIS, at T of it. */
static bool hold(laying *l, size_t node, int axis, double t, double level)
{
    return il_plate_grid_hold(l->g, node, axis, t, level);
}

/* Where the edge from A to B crosses the lines of the grid across AXIS: it meets their edges along the
 * other axis. */
static bool cross(laying *l, const double a[2], const double b[2], int axis, double level)
{
    const il_plate_grid *g = l->g;
    const double *low = a[axis] < b[axis] ? a : b, *high = low == a ? b : a;
    double from = ceil((low[axis] - l->f->at[axis]) / l->step), to = ceil((high[axis] - l->f->at[axis]) / l->step);
    for (double k = fmax(from, 0); k < to && k < (double)g->n[axis]; k++) {
        double share = (l->f->at[axis] + k * l->step - low[axis]) / (high[axis] - low[axis]);
        double at = (low[!axis] + share * (high[!axis] - low[!axis]) - l->f->at[!axis]) / l->step;
        if (!(at >= 0 && at < (double)g->n[!axis] - 1))
            continue;
        size_t other = (size_t)at, node = axis == 0 ? (size_t)k + g->n[0] * other : other + g->n[0] * (size_t)k;
        if (!hold(l, node, !axis, at - (double)other, level))
            return false;
    }
    return true;
}

static bool hold_lines(laying *l, const il_chart *c)
{
    for (size_t e = 0; e < l->f->n_lines; e++) {
        const il_field_line *s = &l->f->line[e];
        if (s->level < 0 || s->level % l->every != 0)
            continue;
        const double a[2] = { s->ax, s->ay }, b[2] = { s->bx, s->by };
        double z = c->level_z[s->level];
        if (!cross(l, a, b, 0, z) || !cross(l, a, b, 1, z))
            return false;
    }
    return true;
}

/* Bounds by the faces. */
static void bound_nodes(const laying *l, const il_chart *c, const il_band *band)
{
    const il_field *f = l->f;
    il_plate_grid *g = l->g;
    for (size_t j = 0; j < g->n[1]; j++)
        for (size_t i = 0; i < g->n[0]; i++) {
            uint32_t face = f->face[i * (size_t)l->every + f->n[0] * j * (size_t)l->every];
            double *bound = g->bound + 2 * (i + g->n[0] * j);
            bound[0] = -INFINITY, bound[1] = INFINITY;
            if (face != IL_CHART_NONE)
                il_plate_bounds(c, band[face], l->every, bound);
        }
}

il_status il_plate_solve(const il_field *f, const il_chart *c, const il_band *band, int32_t every, double **z, il_error *err)
{
    il_plate_grid g = IL_PLATE_GRID_INIT;
    laying l = { &g, f, f->step * every, every };
    const size_t n[2] = { il_plate_size(f, 0, every), il_plate_size(f, 1, every) };
    *z = NULL;
    bool ok = il_plate_grid_make(&g, n);
    if (ok) {
        bound_nodes(&l, c, band);
        ok = hold_lines(&l, c) && il_plate_grid_solve(&g, sqrt(TENSION) * l.step / (f->width * every));
    }
    if (ok) {
        *z = g.z;
        g.z = NULL;
    }
    il_plate_grid_free(&g);
    return ok ? IL_OK : il_fail_nomem(err);
}

double il_plate_height(const il_field *f, const double *z, int32_t every, double x, double y)
{
    size_t n[2] = { il_plate_size(f, 0, every), il_plate_size(f, 1, every) };
    double u = (x - f->at[0]) / (f->step * every), v = (y - f->at[1]) / (f->step * every);
    if (!(u >= 0 && v >= 0 && u < (double)n[0] - 1 && v < (double)n[1] - 1))
        return NAN;
    size_t i = (size_t)u, j = (size_t)v;
    const double *p = z + i + n[0] * j, *q = p + n[0];
    double s = u - (double)i, t = v - (double)j;
    return (1 - t) * ((1 - s) * p[0] + s * p[1]) + t * ((1 - s) * q[0] + s * q[1]);
}
