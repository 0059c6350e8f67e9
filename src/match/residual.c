#include "config.h"
#include "match/residual.h"
#include "base/alloc.h"

#include <math.h>

/* Length of the contour that point K of C stands for: half way to either side. */
static double share(const il_course *c, size_t k)
{
    size_t before = il_course_before(c, k), after = il_course_after(c, k);
    double length = c->length[c->point[k].ring], d = c->point[after].at - c->point[before].at;
    return (d > 0 ? d : d + length) / 2;
}

static void measure(const il_course *c, il_distance *map, double *mean, double *max)
{
    double sum = 0, weight = 0;
    *max = 0;
    for (size_t k = 0; k < c->n; k++) {
        double d = il_distance_foot(map, (float)c->point[k].x, (float)c->point[k].y).distance, w = share(c, k);
        sum += w * d;
        weight += w;
        *max = fmax(*max, d);
    }
    *mean = weight > 0 ? sum / weight : 0;
}

/* The map of the deformed contours, which a fit may have pushed beyond the frame:
 * what is there is far from anything, and told so by the way up. */
static il_status begin_map(il_distance *map, const il_course *upper, const il_distance *frame, il_error *err)
{
    double *xy = il_alloc(upper->n, 2 * sizeof *xy);
    uint32_t *next = il_alloc(upper->n, sizeof *next);
    il_status st = xy && next ? IL_OK : il_fail_nomem(err);
    for (size_t k = 0; st == IL_OK && k < upper->n; k++) {
        xy[2 * k] = upper->point[k].x;
        xy[2 * k + 1] = upper->point[k].y;
        next[k] = (uint32_t)il_course_after(upper, k);
    }
    if (st == IL_OK)
        st = il_distance_begin(map, xy, next, upper->n, frame->cells_x, frame->cells_y, err);
    il_free(xy);
    il_free(next);
    return st;
}

il_status il_residuals_measure(il_fit *fit, const il_course *lower, const il_course *upper, il_ffd *solver, il_error *err)
{
    il_distance *down = NULL, *up = il_ffd_maps(solver, &down);
    il_status st = begin_map(down, upper, up, err);
    if (st != IL_OK)
        return st;
    measure(upper, up, &fit->residual_up_mean, &fit->residual_up_max);
    measure(lower, down, &fit->residual_down_mean, &fit->residual_down_max);
    return up->failed || down->failed ? il_fail_nomem(err) : IL_OK;
}
