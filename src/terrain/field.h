/* field.h - a regular grid over a map: which face each node lies in, and its nearest lines.
 *
 * What is smooth between the lines is solved on a grid and not on the triangles: those between
 * isolines are long and thin, and a discrete plate on them is badly conditioned; on a grid it is
 * a fixed stencil of thirteen numbers. */
#ifndef IL_TERRAIN_FIELD_H
#define IL_TERRAIN_FIELD_H

#include "terrain/tin.h"

/* An edge of a line in the plane of the field.  before, after: do the edges numbered one less and
 * one more adjoin it?  level: -1 for the frame's.  face[]: to its left and right; above[]: does
 * that lie above it? */
typedef struct il_field_line {
    double ax, ay, bx, by;
    int32_t level;
    uint32_t face[2];
    bool above[2], before, after;
} il_field_line;

/* Node (i, j) stands at at[] + step (i, j) of the plane in which x is the mesh's times `east`, as
 * degrees of longitude are shorter than those of latitude; its number is i + n[0] j.
 * face[node]: of the tin, IL_CHART_NONE outside.  near[2 * node]: the nearest line above which
 * that face lies, near[2 * node + 1]: below which; by the chart's edges, IL_CHART_NONE for none.
 * line[n_lines]: the chart's edges; those that pass through cell (i, j), whose lower left node that
 * is, are through[first[node]] to through[first[node + 1]].  width: the median distance between the lines of a band, by
 * area. */
typedef struct il_field {
    double at[2], step, east, width;
    size_t n[2];
    uint32_t *face, *near, *first, *through;
    il_field_line *line;
    size_t n_lines;
} il_field;

#define IL_FIELD_INIT { 0 }
void il_field_free(il_field *f); /* safe twice */

/* Lay F over T, which C's lines bound as BAND says.  The step is about the mean length of the
 * lines' edges, or a quarter of their mean distance where that is less, but no less than what makes
 * FIELD_NODES nodes a node of the chart: time is linear in those.  Without extent F stays empty.
 * IL_E_NOMEM. */
il_status il_field_build(il_field *f, const il_tin *t, const il_chart *c, const il_band *band, double east, il_error *err);

static inline size_t il_field_size(const il_field *f)
{
    return f->n[0] * f->n[1];
}

/* Square of the distance of (x, y) of the field's plane to line edge E, and the nearest place, in
 * [0, 1]. */
static inline double il_field_distance2(const il_field *f, uint32_t e, double x, double y, double *t)
{
    const il_field_line *l = &f->line[e];
    double ux = l->bx - l->ax, uy = l->by - l->ay, px = x - l->ax, py = y - l->ay, length2 = ux * ux + uy * uy;
    double at = length2 > 0 ? (px * ux + py * uy) / length2 : 0;
    *t = at < 0 ? 0 : at > 1 ? 1 : at;
    double dx = px - *t * ux, dy = py - *t * uy;
    return dx * dx + dy * dy;
}

/* Does edge OTHER adjoin edge E? */
static inline bool il_field_adjoins(const il_field *f, uint32_t e, uint32_t other)
{
    return e != IL_CHART_NONE && ((other == e + 1 && f->line[e].after) || (other + 1 == e && f->line[e].before));
}

/* Of line edge E and those that adjoin it, one after the other, the one nearest to (x, y), as far as
 * each is nearer than the one before; *DISTANCE2 to it. */
uint32_t il_field_slide(const il_field *f, uint32_t e, double x, double y, double *distance2);

#endif
