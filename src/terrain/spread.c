#include "config.h"
#include "terrain/spread.h"
#include "base/alloc.h"
#include "terrain/plate.h"

#include <math.h>

static const double SPREAD_LEAST = 0.2, SPREAD_MOST = 1.4, SPREAD_UNKNOWN = 0.5;

/* How far Z misses level K at (x, y), in distances of the levels about that; NAN beside the field. */
static double miss(const il_field *f, const il_chart *c, const double *z, int32_t k, double x, double y)
{
    double bound[2], at = il_plate_height(f, z, 2, x, y);
    il_plate_bounds(c, (il_band){ k, k + 1 }, 2, bound);
    return (fmin(fmax(at, bound[0]), bound[1]) - c->level_z[k]) / (bound[1] - bound[0]);
}

il_status il_spread_measure(const il_field *f, const il_chart *c, const il_band *band, double *spread, il_error *err)
{
    double *z = NULL, sum = 0, length = 0;
    *spread = SPREAD_UNKNOWN;
    if (c->n_levels < 3)
        return IL_OK;
    il_status st = il_plate_solve(f, c, band, 2, &z, err);
    for (size_t e = 0; st == IL_OK && e < f->n_lines; e++) {
        const il_field_line *l = &f->line[e];
        if (l->level % 2 != 1)
            continue;
        double d = hypot(l->bx - l->ax, l->by - l->ay), m = miss(f, c, z, l->level, l->ax, l->ay);
        if (isnan(m))
            continue;
        sum += d * m * m;
        length += d;
    }
    il_free(z);
    if (length > 0)
        *spread = fmin(fmax(4 * sqrt(sum / length), SPREAD_LEAST), SPREAD_MOST);
    return st;
}
