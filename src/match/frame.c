#include "config.h"
#include "match/frame.h"
#include "base/alloc.h"
#include "match/distance.h"

#include <math.h>

static const double MARGIN = 0.15;

void il_frame_extend(double box[4], const double *xy, size_t n)
{
    for (size_t k = 0; k < 2 * n; k++) {
        box[k % 2] = fmin(box[k % 2], xy[k]);
        box[k % 2 + 2] = fmax(box[k % 2 + 2], xy[k]);
    }
}

void il_frame_extend_rings(double box[4], const il_slice *s, const uint32_t *ring, size_t n)
{
    for (size_t i = 0; i < n; i++)
        il_frame_extend(box, s->ring[ring[i]].xy, s->ring[ring[i]].n);
}

il_frame il_frame_about(const il_group *g, const il_slice *lower, const il_slice *upper)
{
    double box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    il_frame_extend_rings(box, lower, g->lower, g->n_lower);
    il_frame_extend_rings(box, upper, g->upper, g->n_upper);
    return il_frame_over(box);
}

il_frame il_frame_over(const double box[4])
{
    double width = box[2] - box[0], height = box[3] - box[1], longer = fmax(width, height);
    il_frame f = { box[0], box[1], 1, 0, 0, 0 };
    /* the least power of two that makes (1 + 2 MARGIN) longer at most 254 cells:
     * one more each for the margin and the box, rounded up */
    int exponent;
    double share = frexp(longer * (1 + 2 * MARGIN) / 254, &exponent);
    f.cell = ldexp(1, share > 0.5 ? exponent : exponent - 1);
    f.margin = ceil(MARGIN * longer / f.cell);
    f.cells_x = (uint32_t)(ceil(width / f.cell) + 2 * f.margin);
    f.cells_y = (uint32_t)(ceil(height / f.cell) + 2 * f.margin);
    f.cells_x = f.cells_x < IL_DISTANCE_MOST_CELLS ? f.cells_x : IL_DISTANCE_MOST_CELLS;
    f.cells_y = f.cells_y < IL_DISTANCE_MOST_CELLS ? f.cells_y : IL_DISTANCE_MOST_CELLS;
    return f;
}

/* Least x and y, greatest x and y, of the raster. */
static void box_of(const il_frame *f, double box[4])
{
    box[0] = f->x - f->margin * f->cell;
    box[1] = f->y - f->margin * f->cell;
    box[2] = box[0] + f->cell * f->cells_x;
    box[3] = box[1] + f->cell * f->cells_y;
}

bool il_frame_is_far(const il_frame *f)
{
    double box[4], reach = 0;
    box_of(f, box);
    for (int k = 0; k < 4; k++)
        reach = fmax(reach, fabs(box[k]));
    return reach > IL_COORDINATE_BOUND / 1024;
}

il_status il_frame_outline(const il_frame *f, const il_slice *s, const uint32_t *ring, size_t n_rings,
                           double **xy, uint32_t **next, size_t *n, il_error *err)
{
    size_t points = 0, at = 0;
    for (size_t i = 0; i < n_rings; i++)
        points += s->ring[ring[i]].n;
    *xy = il_alloc(points, 2 * sizeof **xy);
    *next = il_alloc(points, sizeof **next);
    *n = points;
    if (!*xy || !*next)
        return il_fail_nomem(err);
    for (size_t i = 0; i < n_rings; i++) {
        const il_ring *r = &s->ring[ring[i]];
        for (size_t k = 0; k < r->n; k++) {
            il_frame_to_cells(f, r->xy + 2 * k, *xy + 2 * (at + k));
            (*next)[at + k] = (uint32_t)(at + (k + 1 < r->n ? k + 1 : 0));
        }
        at += r->n;
    }
    return IL_OK;
}

static double within_bound(double v)
{
    const double most = nextafter(IL_COORDINATE_BOUND, 0);
    return fmin(fmax(v, -most), most);
}

void il_frame_scale_found(const il_frame *f, il_fit *fit)
{
    double box[4], *residual[4] = { &fit->residual_up_mean, &fit->residual_up_max,
                                    &fit->residual_down_mean, &fit->residual_down_max };
    box_of(f, box);
    for (int k = 0; k < 4; k++) {
        *residual[k] = within_bound(*residual[k] * f->cell);
        fit->box[k] = within_bound(box[k]);
    }
}

void il_frame_scale_fit(const il_frame *f, il_fit *fit)
{
    double box[4], *g = fit->global;
    box_of(f, box);
    double x0 = box[0], y0 = box[1];
    il_frame_scale_found(f, fit);
    /* p -> o + cell (A (p - o) / cell + b) */
    g[4] = x0 - (g[0] * x0 + g[1] * y0) + f->cell * g[4];
    g[5] = y0 - (g[2] * x0 + g[3] * y0) + f->cell * g[5];
    for (size_t k = 0; k < fit->n_lattices; k++) {
        il_lattice *l = &fit->lattice[k];
        l->x = x0 + f->cell * l->x;
        l->y = y0 + f->cell * l->y;
        l->spacing *= f->cell;
        for (size_t i = 0; i < 2 * l->n; i++)
            l->d[i] *= f->cell;
    }
}
