#include "config.h"
#include "input/map-project.h"
#include "input/map-refuse.h"
#include "input/map-spots.h"
#include "base/alloc.h"
#include "base/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PIECES_MOST = 10000 };

static const double pi = 3.14159265358979323846, metres_a_degree = 111195;

/* How far edges may stray, m, and what they stray at most by their length; the map's new
 * points. */
typedef struct densify {
    il_map *map;
    const il_projection *projection;
    double tolerance, bend;
    double *xy;
    unsigned char *mark;
    size_t n, cap, cap_mark, n_inserted;
} densify;

/* ---- long edges ------------------------------------------------------------- */

/* A line of length L on a parallel leaves the straight one by L^2 tan(latitude) / 8R, and
 * the scale of the projection bends it by less than L^2 / 8R.  The most that an edge may
 * stray anywhere on the map is this many metres for its length in degrees squared. */
static double bend_most(const il_map *m)
{
    double lat = fmin(fmax(fabs(m->box[1]), fabs(m->box[3])), 89.9) * pi / 180;
    return 2 * metres_a_degree * metres_a_degree * (1 + tan(lat)) / (8 * 6.37e6);
}

static double stray_most(const densify *d, const double *p, const double *q)
{
    double dx = q[0] - p[0], dy = q[1] - p[1];
    return d->bend * (dx * dx + dy * dy);
}

/* How far the middle of the edge, between longitudes and latitudes, lies from that of
 * the straight one in the plane, m. */
static il_status stray(const densify *d, const double *p, const double *q, double *distance, il_error *err)
{
    double xy[6] = { p[0], p[1], q[0], q[1], (p[0] + q[0]) / 2, (p[1] + q[1]) / 2 };
    il_status st = il_project_points(d->projection, xy, 3, err);
    *distance = hypot((xy[0] + xy[2]) / 2 - xy[4], (xy[1] + xy[3]) / 2 - xy[5]);
    return st;
}

/* Into how many pieces edge p-q is cut: the stray falls with their square. */
static il_status count_pieces(const densify *d, const double *p, const double *q, size_t *n, il_error *err)
{
    double distance;
    *n = 1;
    if (stray_most(d, p, q) <= d->tolerance)
        return IL_OK;
    il_status st = stray(d, p, q, &distance, err);
    if (st == IL_OK && distance > d->tolerance)
        *n = (size_t)fmin(ceil(sqrt(distance / d->tolerance)), PIECES_MOST);
    return st;
}

static bool add_point(densify *d, double x, double y, unsigned char mark)
{
    if (!il_grow(&d->xy, &d->cap, d->n + 1, 2 * sizeof *d->xy) || !il_grow(&d->mark, &d->cap_mark, d->n + 1, 1))
        return false;
    d->xy[2 * d->n] = x;
    d->xy[2 * d->n + 1] = y;
    d->mark[d->n++] = mark;
    d->n_inserted += mark != 0;
    return true;
}

/* The points between p and q, the same whichever way the edge runs. */
static bool add_between(densify *d, const double *p, const double *q, size_t n)
{
    bool forward = p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
    const double *a = forward ? p : q, *b = forward ? q : p;
    for (size_t k = 1; k < n; k++) {
        double t = (double)(forward ? k : n - k) / (double)n;
        if (!add_point(d, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), IL_VERTEX_INSERTED))
            return false;
    }
    return true;
}

static il_status add_line(densify *d, il_map_line *l, il_error *err)
{
    size_t begin = d->n;
    for (size_t k = 0; k < l->n; k++) {
        const double *p = d->map->xy + 2 * (l->begin + k), *q = d->map->xy + 2 * (l->begin + (k + 1) % l->n);
        size_t n = 1;
        il_status st = k + 1 < l->n || l->closed ? count_pieces(d, p, q, &n, err) : IL_OK;
        if (st != IL_OK)
            return st;
        if (d->n + n > d->map->options->max_points)
            return il_fail(err, IL_E_INPUT, l->line, "more than %zu points with those put into long edges (--max-points)",
                           d->map->options->max_points);
        if (!add_point(d, p[0], p[1], 0) || !add_between(d, p, q, n))
            return il_fail_nomem(err);
    }
    l->begin = begin;
    l->n = d->n - begin;
    return IL_OK;
}

/* Are there long edges, or lines that were left out?  Their points go likewise: they
 * are in no box, so nobody knows whether they have a place. */
static bool needs_points(const densify *d)
{
    for (size_t i = 0; i < d->map->n_lines; i++) {
        const il_map_line *l = &d->map->line[i];
        if (!il_map_takes_part(l))
            return true;
        for (size_t k = 0; k + 1 < l->n + l->closed; k++)
            if (stray_most(d, d->map->xy + 2 * (l->begin + k), d->map->xy + 2 * (l->begin + (k + 1) % l->n)) > d->tolerance)
                return true;
    }
    return false;
}

static il_status densify_map(densify *d, il_error *err)
{
    il_map *m = d->map;
    il_status st = IL_OK;
    for (size_t i = 0; i < m->n_lines && st == IL_OK; i++)
        st = add_line(d, &m->line[i], err);
    if (st == IL_OK && d->n > 0) {
        il_free(m->xy);
        il_free(m->mark);
        m->xy = d->xy;
        m->mark = d->mark;
        m->n = d->n;
        m->cap = d->cap;
        return st;
    }
    il_free(d->xy);
    il_free(d->mark);
    return st;
}

/* ---- the map ---------------------------------------------------------------- */

static double default_tolerance(const il_map *m)
{
    double lat = (m->box[1] + m->box[3]) / 2 * pi / 180;
    double dx = (m->box[2] - m->box[0]) * cos(lat), dy = m->box[3] - m->box[1];
    return fmax(0.01, 1e-6 * metres_a_degree * hypot(dx, dy));
}

static void tell(const il_map *m, const densify *d, const char *name)
{
    char box[IL_MAP_BOX_MOST], stray[IL_NUMBER_MAX];
    il_report_note(m->report, "degrees from %s projected to metres: %s", il_map_box_words(m, box, sizeof box), name);
    if (m->crs && !m->meaning.has_ellipsoid)
        il_report_note(m->report, "the ellipsoid of '%.60s' is not known here: WGS 84 is taken", m->crs);
    if (d->n_inserted > 0)
        il_report_note(m->report, "%zu vertices put into long edges, which are straight between longitudes and latitudes: "
                       "none strays farther than %s m", d->n_inserted,
                       il_map_number_words(d->tolerance, stray, sizeof stray));
}

il_status il_map_project(il_map *m, il_error *err)
{
    char name[300];
    il_projection p;
    if (!m->degrees || m->options->map.project == IL_PROJECT_NONE)
        return IL_OK;
    il_status st = il_map_choose_projection(m, &p, name, sizeof name, err);
    double tolerance = m->options->flatness > 0 ? m->options->flatness : default_tolerance(m);
    densify d = { .map = m, .projection = &p, .tolerance = tolerance, .bend = bend_most(m) };
    if (st == IL_OK && needs_points(&d))
        st = densify_map(&d, err);
    if (st == IL_OK)
        st = il_map_project_points(&p, m->xy, m->n, m->options->threads, err);
    if (st == IL_OK)
        st = il_map_spots_project(m, &p, err);
    char *crs = st == IL_OK ? il_strndup(name, strlen(name)) : NULL;
    if (st != IL_OK || !crs)
        return st != IL_OK ? st : il_fail_nomem(err);
    tell(m, &d, name);
    il_free(m->crs);
    m->crs = crs;
    m->unit = IL_UNIT_M;
    m->is_projected = true;
    m->projection = p;
    return IL_OK;
}
