#include "config.h"
#include "terrain/frame-curves.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

enum { PIECES_MOST = 4096 };

/* Of the length of a side, how far its chords may be off; of the size in degrees, what
 * there counts as nothing. */
static const double chord_share = 1e-6, rounding_share = 1e-9;

double il_frame_scale(const il_stack_head *head)
{
    return 1 / il_unit_metres(head->unit);
}

bool il_frame_is_curved(const il_stack_head *head)
{
    return head->has_geographic && il_unit_metres(head->unit) > 0 &&
           !(head->projection.kind == IL_PROJECTION_STEREOGRAPHIC && head->geographic[2] - head->geographic[0] >= 180);
}

il_status il_frame_project(const il_projection *p, double scale, double *xy, size_t n, il_error *err)
{
    il_status st = il_project_points(p, xy, n, err);
    for (size_t k = 0; k < 2 * n && st == IL_OK; k++)
        xy[k] *= scale;
    return st;
}

/* ---- chords -------------------------------------------------------------------- */

/* The place at U from 0 to 1 between two longitudes and latitudes. */
static void place_between(const double from[2], const double to[2], double u, double *p)
{
    for (int c = 0; c < 2; c++)
        p[c] = u >= 1 ? to[c] : from[c] + u * (to[c] - from[c]);
}

/* The stray of N chords: the most that the middle of one is off. */
static il_status measure_stray(const il_projection *p, double scale, const double from[2], const double to[2],
                               size_t n, double *stray, il_error *err)
{
    double *xy = il_alloc(2 * n + 1, 2 * sizeof *xy);
    if (!xy)
        return il_fail_nomem(err);
    for (size_t k = 0; k <= 2 * n; k++)
        place_between(from, to, (double)k / (double)(2 * n), xy + 2 * k);
    il_status st = il_frame_project(p, scale, xy, 2 * n + 1, err);
    *stray = 0;
    for (size_t k = 0; k < n && st == IL_OK; k++) {
        const double *a = xy + 4 * k, *middle = a + 2, *b = a + 4;
        *stray = fmax(*stray, hypot((a[0] + b[0]) / 2 - middle[0], (a[1] + b[1]) / 2 - middle[1]));
    }
    il_free(xy);
    return st;
}

/* The stray falls with the square of the number of chords. */
il_status il_frame_count_pieces(const il_projection *p, double scale, const double from[2], const double to[2],
                                double tolerance, size_t *n, double *stray, il_error *err)
{
    *n = 1;
    for (;;) {
        il_status st = measure_stray(p, scale, from, to, *n, stray, err);
        if (st != IL_OK || *stray <= tolerance || *n >= PIECES_MOST)
            return st;
        *n = (size_t)fmin(ceil(1.02 * (double)*n * sqrt(*stray / tolerance)), PIECES_MOST);
    }
}

/* ---- the box --------------------------------------------------------------------- */

/* Places of one curve, without its last; none of a curve that is one place, a pole. */
static il_status add_curve(il_frame_sides *s, int k, double **xy, size_t *n, size_t *cap, il_error *err)
{
    il_frame_curves *c = &s->curves;
    const double *from = c->corner[k], *to = c->corner[k + 1];
    double end[4] = { from[0], from[1], to[0], to[1] }, stray;
    size_t pieces;
    il_status st = il_frame_project(&c->projection, c->scale, end, 2, err);
    double tolerance = chord_share * hypot(end[2] - end[0], end[3] - end[1]);
    c->first[k] = (uint32_t)*n;
    if (st != IL_OK || tolerance < 1e-9 * c->scale)
        return st;
    st = il_frame_count_pieces(&c->projection, c->scale, from, to, tolerance, &pieces, &stray, err);
    if (st != IL_OK)
        return st;
    if (!il_grow(xy, cap, *n + pieces, 2 * sizeof **xy))
        return il_fail_nomem(err);
    for (size_t i = 0; i < pieces; i++)
        place_between(from, to, (double)i / (double)pieces, *xy + 2 * (*n + i));
    s->slack = fmax(s->slack, 1.1 * stray);
    *n += pieces;
    return IL_OK;
}

il_status il_frame_curves_make(il_frame_sides *s, const il_stack_head *head, il_error *err)
{
    const double *g = head->geographic;
    const double corner[5][2] = { { g[0], g[1] }, { g[2], g[1] }, { g[2], g[3] }, { g[0], g[3] }, { g[0], g[1] } };
    double *xy = NULL;
    size_t n = 0, cap = 0;
    il_status st = IL_OK;
    s->is_curved = true;
    s->curves = (il_frame_curves){ .projection = head->projection, .scale = il_frame_scale(head),
                                   .rounding = fmax(rounding_share * fmax(g[2] - g[0], g[3] - g[1]), 1e-12) };
    memcpy(s->curves.corner, corner, sizeof corner);
    for (int k = 0; k < 4 && st == IL_OK; k++)
        st = add_curve(s, k, &xy, &n, &cap, err);
    s->curves.first[4] = (uint32_t)n;
    if (st == IL_OK)
        st = il_frame_project(&s->curves.projection, s->curves.scale, xy, n, err);
    if (st == IL_OK && !il_frame_sides_add(s, xy, n))
        st = il_fail_nomem(err);
    il_free(xy);
    return st;
}

/* ---- places ----------------------------------------------------------------------- */

/* How far, in degrees, Q lies beside curve K, and at what share u along it. */
static double distance_to(const il_frame_curves *c, int k, const double q[2], double *u)
{
    int along = k % 2; /* longitude on the south and north side */
    const double *from = c->corner[k], *to = c->corner[k + 1];
    double share = (q[along] - from[along]) / (to[along] - from[along]);
    *u = fmin(fmax(share, 0), 1);
    double beyond = fabs(share - *u) * fabs(to[along] - from[along]);
    return fmax(fabs(q[1 - along] - from[1 - along]), beyond);
}

/* P as longitude, in the turn of the box, and latitude.  A pole has any longitude. */
static il_status find_degrees(const il_frame_curves *c, const double p[2], double q[2], il_error *err)
{
    double west = c->corner[0][0], east = c->corner[1][0];
    q[0] = p[0] / c->scale;
    q[1] = p[1] / c->scale;
    il_status st = il_unproject_points(&c->projection, q, 1, err);
    q[0] -= 360 * nearbyint((q[0] - (west + east) / 2) / 360);
    if (fabs(q[1]) > 90 - c->rounding)
        q[0] = fmin(fmax(q[0], west), east);
    return st;
}

il_status il_frame_curves_locate(const il_frame_sides *s, const double p[2], il_curve_place *out, il_error *err)
{
    const il_frame_curves *c = &s->curves;
    double q[2], least = INFINITY, u = 0;
    int best = 0;
    il_status st = find_degrees(c, p, q, err);
    for (int k = 0; k < 4; k++) {
        double at, distance = distance_to(c, k, q, &at);
        if (c->first[k] < c->first[k + 1] && distance < least) {
            best = k;
            least = distance;
            u = at;
        }
    }
    size_t n = c->first[best + 1] - c->first[best];
    double piece = fmin(floor(u * (double)n), (double)n - 1);
    out->side = c->first[best] + (size_t)piece;
    out->t = fmin(fmax(u * (double)n - piece, 0), 1);
    out->is_on = least <= c->rounding;
    place_between(c->corner[best], c->corner[best + 1], u, out->at);
    return st == IL_OK ? il_frame_project(&c->projection, c->scale, out->at, 1, err) : st;
}
