#include "config.h"
#include "terrain/smooth.h"
#include "base/alloc.h"
#include "terrain/mean.h"
#include "terrain/spread.h"

#include <math.h>

/* How far from a line, in steps, the plate is still moved by what it misses that by: where several
 * lines pass between two nodes, it cannot meet all. */
static const double REACH = 8;
/* The steepest start at a line, in mean slopes of the band: heights are then those of the lines at
 * the lines, whatever the plate has there.  3 keeps a cubic monotone, but is too little above cliffs. */
static const double STEEPEST = 10;
/* The least part of a band that a point half a width away from a line keeps from it, for a plate that
 * lies on its bound. */
static const double APART = 0.02;

void il_smooth_free(il_smooth *s)
{
    il_field_free(&s->field);
    il_free(s->z);
    il_free(s->law);
    *s = (il_smooth)IL_SMOOTH_INIT;
}

/* ---- the nearest lines ------------------------------------------------------------------ */

/* Below and above, the nearest place of a line and how far it is; none: infinite. */
typedef struct feet {
    double at[2][2], distance[2];
} feet;

static void place_feet(const il_field *f, const uint32_t line[2], double x, double y, feet *out)
{
    for (int side = 0; side < 2; side++) {
        double t = 0;
        out->distance[side] = INFINITY;
        if (line[side] == IL_CHART_NONE)
            continue;
        const il_field_line *l = &f->line[line[side]];
        out->distance[side] = sqrt(il_field_distance2(f, line[side], x, y, &t));
        out->at[side][0] = l->ax + t * (l->bx - l->ax);
        out->at[side][1] = l->ay + t * (l->by - l->ay);
    }
}

/* Of the lines through the cell whose first node that is. */
static void look_in_cell(const il_field *f, size_t cell, uint32_t face, double x, double y, double best[2], uint32_t line[2])
{
    for (uint32_t k = f->first[cell]; k < f->first[cell + 1]; k++) {
        const il_field_line *l = &f->line[f->through[k]];
        for (int side = 0; side < 2; side++) {
            double t, d = l->face[side] == face ? il_field_distance2(f, f->through[k], x, y, &t) : INFINITY;
            size_t way = !l->above[side];
            if (d < best[way])
                best[way] = d, line[way] = f->through[k];
        }
    }
}

/* Of those near the nodes about (x, y) that lie in FACE; false without such nodes. */
static bool find_feet(const il_field *f, size_t cell, uint32_t face, double x, double y, feet *out)
{
    double best[2] = { INFINITY, INFINITY };
    uint32_t line[2] = { IL_CHART_NONE, IL_CHART_NONE };
    bool any = false;
    for (size_t k = 0; k < 4; k++) {
        size_t node = cell + k % 2 + f->n[0] * (k / 2);
        if (f->face[node] != face)
            continue;
        any = true;
        for (size_t side = 0; side < 2; side++) {
            uint32_t e = f->near[2 * node + side];
            double d;
            if (e == IL_CHART_NONE || e == line[side] || il_field_adjoins(f, line[side], e))
                continue;
            e = il_field_slide(f, e, x, y, &d);
            if (d < best[side])
                best[side] = d, line[side] = e;
        }
    }
    look_in_cell(f, cell, face, x, y, best, line);
    place_feet(f, line, x, y, out);
    return any;
}

/* ---- the height ---------------------------------------------------------------------- */

/* How much too high the plate is at the line on SIDE, as far as that concerns a place at the feet's
 * distance: nothing at the other line, nor beyond REACH. */
static double miss(const il_smooth *s, const feet *f, int side, double bound)
{
    double d = f->distance[side], reach = fmin(REACH * s->field.step, f->distance[0] + f->distance[1]);
    if (!(d < reach))
        return 0;
    double z = il_plate_height(&s->field, s->z, 1, f->at[side][0], f->at[side][1]);
    return isnan(z) ? 0 : (1 - d / reach) * (z - bound);
}

/* Both distances are known. */
static double between(const feet *f, double u)
{
    double w = f->distance[0] + f->distance[1], t = w > 0 ? f->distance[0] / w : 0.5;
    return fmax(fmin(u, STEEPEST * t), 1 - STEEPEST * (1 - t));
}

/* At (x, y) of the field's plane, where the plate has Z. */
static double bend(const il_smooth *s, uint32_t face, const feet *f, double z)
{
    double bound[2], nearest = f->distance[0] < f->distance[1] ? f->distance[0] : f->distance[1];
    il_plate_bounds(s->chart, s->band[face], 1, bound);
    z -= miss(s, f, 0, bound[0]) + miss(s, f, 1, bound[1]);
    double u = fmin(fmax((z - bound[0]) / (bound[1] - bound[0]), 0), 1);
    if (isfinite(f->distance[0]) && isfinite(f->distance[1]))
        u = between(f, u);
    double far = fmin(nearest / s->field.width, 0.5);
    u = fmin(fmax(u, 2 * APART * far), 1 - 2 * APART * far);
    return bound[0] + il_mean_in_band(u, s->spread * far) * (bound[1] - bound[0]);
}

/* The law at each node, and how far its nearest line is, NAN where they tell nothing. */
static bool bend_nodes(il_smooth *s)
{
    const il_field *f = &s->field;
    s->law = il_alloc(il_field_size(f), 2 * sizeof *s->law);
    for (size_t j = 0; s->law && j < f->n[1]; j++)
        for (size_t i = 0; i < f->n[0]; i++) {
            size_t k = i + f->n[0] * j;
            feet at;
            s->law[2 * k] = s->law[2 * k + 1] = NAN;
            if (f->face[k] == IL_CHART_NONE || (f->near[2 * k] == IL_CHART_NONE && f->near[2 * k + 1] == IL_CHART_NONE))
                continue;
            place_feet(f, f->near + 2 * k, f->at[0] + (double)i * f->step, f->at[1] + (double)j * f->step, &at);
            s->law[2 * k] = bend(s, f->face[k], &at, s->z[k]);
            s->law[2 * k + 1] = at.distance[0] < at.distance[1] ? at.distance[0] : at.distance[1];
        }
    return s->law != NULL;
}

/* Do all nodes of CELL lie in FACE, and no line in the cell? */
static bool is_clear(const il_field *f, size_t cell, uint32_t face)
{
    const uint32_t *at = f->face + cell;
    return f->first[cell] == f->first[cell + 1] && at[0] == face && at[1] == face && at[f->n[0]] == face && at[f->n[0] + 1] == face;
}

/* Of one of two numbers a node, at (u, v) of a cell. */
static double among(const double *p, size_t n, double u, double v)
{
    return (1 - v) * ((1 - u) * p[0] + u * p[2]) + v * ((1 - u) * p[2 * n] + u * p[2 * n + 2]);
}

double il_smooth_height(const il_smooth *s, uint32_t face, double x, double y, double *nearest)
{
    const il_field *field = &s->field;
    feet f;
    if (!s->law)
        return NAN;
    x *= field->east;
    double u = (x - field->at[0]) / field->step, v = (y - field->at[1]) / field->step;
    if (!(u >= 0 && v >= 0 && u < (double)field->n[0] - 1 && v < (double)field->n[1] - 1))
        return NAN;
    size_t i = (size_t)u, j = (size_t)v, cell = i + field->n[0] * j;
    if (is_clear(field, cell, face)) {
        *nearest = among(s->law + 2 * cell + 1, field->n[0], u - (double)i, v - (double)j);
        return among(s->law + 2 * cell, field->n[0], u - (double)i, v - (double)j);
    }
    if (!find_feet(field, cell, face, x, y, &f))
        return NAN;
    *nearest = f.distance[0] < f.distance[1] ? f.distance[0] : f.distance[1];
    double z = il_plate_height(field, s->z, 1, x, y);
    return isfinite(*nearest) ? bend(s, face, &f, z) : NAN;
}

/* ---- building --------------------------------------------------------------------- */

il_status il_smooth_build(il_smooth *s, const il_tin *t, const il_chart *c, const il_band *band, double east, double spread,
                          il_error *err)
{
    *s = (il_smooth){ .chart = c, .band = band, .spread = spread };
    il_status st = il_field_build(&s->field, t, c, band, east, err);
    if (st == IL_OK && s->field.face)
        st = il_plate_solve(&s->field, c, band, 1, &s->z, err);
    if (st == IL_OK && s->field.face && isnan(spread))
        st = il_spread_measure(&s->field, c, band, &s->spread, err);
    if (st == IL_OK && s->field.face && !bend_nodes(s))
        st = il_fail_nomem(err);
    if (st != IL_OK)
        il_smooth_free(s);
    return st;
}
