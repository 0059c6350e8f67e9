#include "config.h"
#include "terrain/law.h"
#include "base/alloc.h"
#include "terrain/mean.h"

#include <math.h>

/* ---- widths ------------------------------------------------------------------- */

/* area[f], twice; length[f] of its lines. */
static void measure(const il_tin *t, const il_chart *c, double *area, double *length)
{
    for (size_t k = 0; k < t->n; k++)
        if (t->face[k] != IL_CHART_NONE)
            area[t->face[k]] += il_tin_area2(t, c, k);
    for (size_t e = 0; e < c->n_edges; e++) {
        double d = il_chart_is_frame(c, e) ? 0 : il_chart_length(c, e);
        for (int s = 0; s < 2; s++)
            if (t->side[2 * e + (size_t)s] != IL_CHART_NONE)
                length[t->side[2 * e + (size_t)s]] += d;
    }
}

bool il_law_is_above(const il_tin *t, const il_chart *c, const il_band *band, size_t k)
{
    uint32_t f = t->side[k], g = t->side[k ^ 1];
    int32_t level = c->height[k / 2];
    if (level <= band[f].low || level >= band[f].high)
        return level <= band[f].low;
    return g == IL_CHART_NONE || band[g].high <= level;
}

/* Do lines both below and above it bound each face? */
static void find_caps(const il_tin *t, const il_chart *c, const il_band *band, unsigned char *sides)
{
    for (size_t k = 0; k < 2 * t->n_sides; k++) {
        uint32_t f = t->side[k];
        if (f != IL_CHART_NONE && !il_chart_is_frame(c, k / 2))
            sides[f] |= il_law_is_above(t, c, band, k) ? 1 : 2;
    }
}

/* Of a band: area over half the length of its two lines.  Of a cap: the mean of the bands
 * across its line, by length. */
static bool find_widths(il_law *l, const il_tin *t)
{
    const il_chart *c = l->chart;
    size_t n = t->n_faces;
    double *area = il_calloc(n, sizeof *area), *length = il_calloc(n, sizeof *length), *weight = il_calloc(n, sizeof *weight);
    unsigned char *sides = il_calloc(n, 1);
    l->width = il_calloc(n, sizeof *l->width);
    bool ok = area && length && weight && sides && l->width;
    if (ok) {
        measure(t, c, area, length);
        find_caps(t, c, l->band, sides);
        for (size_t f = 0; f < n; f++)
            l->width[f] = sides[f] == 3 && length[f] > 0 ? area[f] / length[f] : 0;
        for (size_t k = 0; k < 2 * t->n_sides; k++) {
            uint32_t f = t->side[k], g = t->side[k ^ 1];
            if (f == IL_CHART_NONE || g == IL_CHART_NONE || il_chart_is_frame(c, k / 2) || sides[f] == 3 || sides[g] != 3)
                continue;
            double d = il_chart_length(c, k / 2);
            l->width[f] += d * l->width[g];
            weight[f] += d;
        }
        for (size_t f = 0; f < n; f++)
            l->width[f] = weight[f] > 0 ? l->width[f] / weight[f] : l->width[f];
    }
    il_free(area);
    il_free(length);
    il_free(weight);
    il_free(sides);
    return ok;
}

/* ---- heights ---------------------------------------------------------------------- */

/* The interval above level LOW, which may be -1 or the last: then that of its neighbour. */
static double interval_above(const il_chart *c, int32_t low)
{
    size_t k = low < 0 ? 0 : (size_t)low;
    if (c->n_levels < 2)
        return 1;
    k = k + 1 < c->n_levels ? k : c->n_levels - 2;
    return c->level_z[k + 1] - c->level_z[k];
}

double il_law_interval(const il_law *l, uint32_t face)
{
    return interval_above(l->chart, l->band[face].low);
}

/* How far a dome has risen, in intervals, at T widths of its neighbour band from its line: it
 * begins with that band's slope, and ends halfway, for nothing tells where between the
 * levels the top is. */
static double dome(double t)
{
    return 0.5 * (1 - il_mean_exp(-2 * t));
}

/* WIDTHS above the line of level BELOW, with no other above: a dome, or, if a line is missing
 * on the way, a slope up to the dome over that. */
static double rise_from(const il_law *l, uint32_t face, int32_t below, double widths)
{
    const il_chart *c = l->chart;
    int32_t last = l->band[face].high - 1;
    if (below >= last)
        return c->level_z[below] + dome(widths) * interval_above(c, below);
    return fmin(c->level_z[below] + widths * interval_above(c, below), c->level_z[last] + dome(widths) * interval_above(c, last));
}

/* The same downwards. */
static double sink_from(const il_law *l, uint32_t face, int32_t above, double widths)
{
    const il_chart *c = l->chart;
    int32_t last = l->band[face].low + 1;
    if (above <= last)
        return c->level_z[above] - dome(widths) * interval_above(c, above - 1);
    return fmax(c->level_z[above] - widths * interval_above(c, above - 1), c->level_z[last] - dome(widths) * interval_above(c, last - 1));
}

/* How far away the nearest line above which FACE lies is (or below which, by UPPER), and the
 * level at which the face meets it; infinity without one.  A face that lacks lines may lie above
 * lines of several levels; of a cliff's lines it meets that of its band. */
static double nearest_line(const il_law *l, uint32_t face, size_t upper, double x, double y, int32_t *level)
{
    il_band b = l->band[face];
    il_nearest_place near;
    if (!il_nearest_point(&l->borders, 2 * (size_t)face + upper, x * l->east, y, &near))
        return INFINITY;
    *level = l->chart->height[near.id];
    *level = *level < b.low ? b.low : *level > b.high ? b.high : *level;
    return near.distance;
}

/* By the straight law; *NEAREST: how far the nearest line is. */
static double straight_height(const il_law *l, uint32_t face, double x, double y, double *nearest)
{
    const il_chart *c = l->chart;
    int32_t below = 0, above = 0;
    double low = nearest_line(l, face, 0, x, y, &below), high = nearest_line(l, face, 1, x, y, &above);
    *nearest = fmin(low, high);
    if (isfinite(low) && isfinite(high) && below < above) {
        double t = low + high > 0 ? low / (low + high) : 0.5;
        return c->level_z[below] + t * (c->level_z[above] - c->level_z[below]);
    }
    double width = l->width[face] > 0 ? l->width[face] : l->smooth.field.width, widths = width > 0 ? *nearest / width : INFINITY;
    return low <= high ? rise_from(l, face, below, widths) : sink_from(l, face, above, widths);
}

/* Between the lines alone. */
static double height_of_lines(const il_law *l, uint32_t face, double x, double y, double *nearest)
{
    double z = il_smooth_height(&l->smooth, face, x, y, nearest);
    return isnan(z) ? straight_height(l, face, x, y, nearest) : z;
}

/* Keep Z inside the band of FACE, off its levels. */
static double clamp(const il_law *l, uint32_t face, double z)
{
    static const double MARGIN = 1 - IL_LAW_MOST;
    const il_chart *c = l->chart;
    il_band b = l->band[face];
    double interval = interval_above(c, b.low);
    double low = b.low >= 0 ? c->level_z[b.low] + MARGIN * interval : -INFINITY;
    double high = b.high < (int32_t)c->n_levels ? c->level_z[b.high] - MARGIN * interval : INFINITY;
    return fmin(fmax(z, low), high);
}

/* A spot lifts or lowers what is about it by its excess, all of it where it stands and nothing
 * at the lines. */
double il_law_height(const il_law *l, uint32_t face, double x, double y)
{
    double to_line = 0, z = height_of_lines(l, face, x, y, &to_line);
    il_nearest_place near;
    if (!isfinite(to_line) || !il_nearest_point(&l->spots, face, x * l->east, y, &near))
        return z;
    double share = to_line + near.distance > 0 ? to_line / (to_line + near.distance) : 1;
    return clamp(l, face, z + share * l->excess[near.id]);
}

/* ---- building ------------------------------------------------------------------- */

static il_status build_borders(il_law *l, const il_tin *t, il_error *err)
{
    const il_chart *c = l->chart;
    il_segment *s = il_alloc(2 * t->n_sides, sizeof *s);
    size_t n = 0;
    if (!s)
        return il_fail_nomem(err);
    for (size_t k = 0; k < 2 * t->n_sides; k++) {
        uint32_t f = t->side[k];
        const uint32_t *v = c->edge + k / 2 * 2;
        if (f == IL_CHART_NONE || il_chart_is_frame(c, k / 2))
            continue;
        size_t upper = !il_law_is_above(t, c, l->band, k);
        const double *a = c->xy + 2 * (size_t)v[0], *b = c->xy + 2 * (size_t)v[1];
        s[n++] = (il_segment){ a[0] * l->east, a[1], b[0] * l->east, b[1], 2 * (size_t)f + upper, k / 2 };
    }
    return il_nearest_build(&l->borders, s, n, 2 * t->n_faces, err);
}

/* What each spot has beyond the lines. */
static il_status build_spots(il_law *l, const il_tin *t, il_error *err)
{
    il_nearest_free(&l->spots);
    il_free(l->excess);
    const il_chart *c = l->chart;
    size_t n = 0, cap = 0;
    il_segment *s = NULL;
    unsigned char *seen = il_calloc(c->n_nodes, 1);
    l->excess = il_alloc(c->n_nodes, sizeof *l->excess);
    bool ok = seen && l->excess;
    for (size_t k = 0; k < 3 * t->n && ok; k++) {
        uint32_t v = t->corner[k], f = t->face[k / 3];
        double x = c->xy[2 * (size_t)v], y = c->xy[2 * (size_t)v + 1], nearest;
        if (!c->node[v].is_spot || f == IL_CHART_NONE || seen[v])
            continue;
        seen[v] = 1;
        ok = il_grow(&s, &cap, n + 1, sizeof *s);
        if (!ok)
            break;
        s[n++] = (il_segment){ x * l->east, y, x * l->east, y, f, v };
        l->excess[v] = c->node[v].z - height_of_lines(l, f, x, y, &nearest);
    }
    il_free(seen);
    if (!ok) {
        il_free(s);
        return il_fail_nomem(err);
    }
    return il_nearest_build(&l->spots, s, n, t->n_faces, err);
}

il_status il_law_build(il_law *l, const il_tin *t, const il_chart *c, const il_band *band, double east, il_error *err)
{
    *l = (il_law){ .chart = c, .band = band, .east = east };
    if (!find_widths(l, t)) {
        il_law_free(l);
        return il_fail_nomem(err);
    }
    il_status st = build_borders(l, t, err);
    if (st == IL_OK)
        st = build_spots(l, t, err);
    if (st != IL_OK)
        il_law_free(l);
    return st;
}

il_status il_law_bend(il_law *l, const il_tin *t, const il_law_options *o, il_error *err)
{
    double spread = o->kind == IL_LAW_PLATE ? 0 : o->has_spread ? o->spread : NAN;
    il_smooth_free(&l->smooth);
    if (o->kind == IL_LAW_STRAIGHT)
        return IL_OK;
    il_status st = il_smooth_build(&l->smooth, t, l->chart, l->band, l->east, spread, err);
    return st == IL_OK ? build_spots(l, t, err) : st;
}

void il_law_free(il_law *l)
{
    il_smooth_free(&l->smooth);
    il_free(l->width);
    il_nearest_free(&l->borders);
    il_nearest_free(&l->spots);
    il_free(l->excess);
    *l = (il_law){ 0 };
}
