/* The map as a whole: what is laid out for all tiles, and what is read off them.
 *
 * Nothing here is proportional to the raster but the bits that tell inside from
 * outside; distances are in distance-tile.c. */
#include "config.h"
#include "match/distance-private.h"
#include "base/alloc.h"

#include <math.h>

/* Shorter ones are points: 1 / length must be finite, and nobody sees the difference. */
#define SHORTEST 1e-12

void il_distance_free(il_distance *d)
{
    il_free(d->segment);
    il_free(d->run);
    il_free(d->box);
    il_free(d->inside);
    il_free(d->slot);
    il_free(d->value);
    il_free(d->nearest);
    il_free(d->candidate);
    il_free(d->first);
    il_free(d->bound);
    il_free(d->kept);
    il_free(d->way);
    il_free(d->near);
    il_free(d->rows);
    *d = (il_distance)IL_DISTANCE_INIT;
}

/* ---- inside or outside ---- */

/* The least integer >= V within [0, MOST]. */
static uint32_t ceiling(double v, uint32_t most)
{
    if (!(v > 0))
        return 0;
    if (v > most)
        return most;
    uint32_t k = (uint32_t)v;
    return k + ((double)k < v);
}

/* Row j is crossed by a segment with one end at or below it and one above, so
 * that a vertex on the row is met once; nodes to the right of the crossing change
 * sides. */
static void toggle_segment(il_distance *d, const double *a, const double *b)
{
    const double *low = a[1] < b[1] ? a : b, *high = a[1] < b[1] ? b : a;
    uint32_t first = ceiling(low[1], d->cells_y + 1), end = ceiling(high[1], d->cells_y + 1);
    double slope = first < end ? (high[0] - low[0]) / (high[1] - low[1]) : 0;
    for (uint32_t j = first; j < end; j++) {
        double x = low[0] + (j - low[1]) * slope;
        uint32_t i = ceiling(x, d->cells_x + 1);
        d->inside[j * d->row_words + i / 64] ^= (uint64_t)1 << i % 64;
    }
}

/* Bit i of a row becomes the parity of bits 0 to i. */
static void sum_row(uint64_t *row, size_t n)
{
    uint64_t carry = 0;
    for (size_t k = 0; k < n; k++) {
        uint64_t w = row[k];
        for (int shift = 1; shift < 64; shift *= 2)
            w ^= w << shift;
        row[k] = w ^ carry;
        carry = row[k] >> 63 ? ~(uint64_t)0 : 0;
    }
}

static void mark_inside(il_distance *d, const double *xy, const uint32_t *next)
{
    size_t n_rows = d->cells_y + 1;
    memset(d->inside, 0, n_rows * d->row_words * sizeof *d->inside);
    for (size_t i = 0; i < d->n; i++)
        toggle_segment(d, xy + 2 * i, xy + 2 * (size_t)next[i]);
    for (size_t j = 0; j < n_rows; j++)
        sum_row(d->inside + j * d->row_words, d->row_words);
}

/* ---- beginning ---- */

static size_t groups(size_t n)
{
    return (n + IL_LANES - 1) / IL_LANES;
}

static bool make_room(il_distance *d)
{
    size_t n_tiles = (size_t)d->tiles_x * d->tiles_y;
    return il_grow(&d->segment, &d->cap_segment, d->n, sizeof *d->segment)
        && il_grow(&d->run, &d->cap_run, d->n_runs, sizeof *d->run)
        && il_grow(&d->box, &d->cap_box, groups(d->n_runs), sizeof *d->box)
        && il_grow(&d->inside, &d->cap_inside, (d->cells_y + 1) * d->row_words, sizeof *d->inside)
        && il_grow(&d->slot, &d->cap_slot, n_tiles, sizeof *d->slot)
        && il_grow(&d->first, &d->cap_first, 1, sizeof *d->first)
        && il_grow(&d->bound, &d->cap_bound, groups(d->n_runs) * IL_LANES, sizeof *d->bound)
        && il_grow(&d->kept, &d->cap_kept, d->n_runs * IL_LANES, sizeof *d->kept)
        && il_grow(&d->way, &d->cap_way, d->n_runs, sizeof *d->way)
        && il_grow(&d->near, &d->cap_near, d->n_runs, sizeof *d->near)
        && il_grow(&d->rows, &d->cap_rows, d->n, sizeof *d->rows);
}

static void lay_segments(il_distance *d, const double *xy, const uint32_t *next)
{
    double reach = 0;
    for (size_t i = 0; i < d->n; i++) {
        const double *a = xy + 2 * i, *b = xy + 2 * (size_t)next[i];
        double dx = b[0] - a[0], dy = b[1] - a[1], length = sqrt(dx * dx + dy * dy);
        bool point = length < SHORTEST;
        double by = point ? 0 : 1 / length;
        d->segment[i] = (il_distance_segment){ a[0], a[1], point ? 1 : by * dx, by * dy, point ? 0 : length };
        reach = fmax(reach, fmax(fabs(a[0]), fabs(a[1])));
    }
    /* Coordinates of that size are off by 2^-24 of it each, and so is every step
     * of the arithmetic with them: some ten of these, taken as 2^-19. */
    d->slack = 1e-4f + 0x1p-19f * (float)(reach + IL_DISTANCE_MOST_CELLS);
}

static void lay_runs(il_distance *d)
{
    for (size_t r = 0; r < d->n_runs; r++)
        for (size_t k = 0; k < IL_LANES; k++) {
            size_t i = r * IL_LANES + k < d->n ? r * IL_LANES + k : d->n - 1;
            const il_distance_segment *s = &d->segment[i];
            il_distance_run *to = &d->run[r];
            to->ax[k] = (float)s->ax, to->ay[k] = (float)s->ay;
            to->ux[k] = (float)s->ux, to->uy[k] = (float)s->uy;
            to->length[k] = (float)s->length;
        }
}

static void lay_boxes(il_distance *d)
{
    for (size_t i = 0; i < groups(d->n_runs) * IL_LANES; i++) {
        const il_distance_run *r = &d->run[i < d->n_runs ? i : d->n_runs - 1];
        float x[2] = { INFINITY, -INFINITY }, y[2] = { INFINITY, -INFINITY };
        for (size_t k = 0; k < IL_LANES; k++) {
            float bx = r->ax[k] + r->length[k] * r->ux[k], by = r->ay[k] + r->length[k] * r->uy[k];
            x[0] = fminf(x[0], fminf(r->ax[k], bx)), x[1] = fmaxf(x[1], fmaxf(r->ax[k], bx));
            y[0] = fminf(y[0], fminf(r->ay[k], by)), y[1] = fmaxf(y[1], fmaxf(r->ay[k], by));
        }
        il_distance_box *to = &d->box[i / IL_LANES];
        size_t k = i % IL_LANES;
        to->x[k] = 0.5f * (x[0] + x[1]), to->half_x[k] = 0.5f * (x[1] - x[0]);
        to->y[k] = 0.5f * (y[0] + y[1]), to->half_y[k] = 0.5f * (y[1] - y[0]);
        to->on_x[k] = r->ax[IL_LANES / 2], to->on_y[k] = r->ay[IL_LANES / 2];
    }
}

il_status il_distance_begin(il_distance *d, const double *xy, const uint32_t *next, size_t n,
                            uint32_t cells_x, uint32_t cells_y, il_error *err)
{
    d->n = n;
    d->n_runs = groups(n);
    d->cells_x = cells_x, d->cells_y = cells_y;
    d->tiles_x = (cells_x + IL_TILE_CELLS - 1) / IL_TILE_CELLS;
    d->tiles_y = (cells_y + IL_TILE_CELLS - 1) / IL_TILE_CELLS;
    d->row_words = (cells_x + 1) / 64 + 2;
    d->n_tiles_done = d->n_candidates = 0;
    d->failed = !make_room(d);
    if (d->failed)
        return il_fail_nomem(err);
    for (size_t t = 0; t < (size_t)d->tiles_x * d->tiles_y; t++)
        d->slot[t] = -1;
    d->first[0] = 0;
    lay_segments(d, xy, next);
    lay_runs(d);
    lay_boxes(d);
    mark_inside(d, xy, next);
    return IL_OK;
}

/* ---- reading ---- */

static float clamp(float v, float most)
{
    return !(v > 0) ? 0 : v < most ? v : most;
}

/* The cell of a place within [0, CELLS]: its right and upper border belong to it
 * where the raster ends. */
static uint32_t cell_of(float v, uint32_t cells)
{
    uint32_t i = (uint32_t)v;
    return i < cells ? i : cells - 1;
}

static int32_t slot_of(il_distance *d, uint32_t i, uint32_t j)
{
    uint32_t t = j / IL_TILE_CELLS * d->tiles_x + i / IL_TILE_CELLS;
    int32_t slot = d->slot[t];
    return slot >= 0 ? slot : il_distance_make_tile(d, t);
}

void il_distance_sample(il_distance *d, const float *x, const float *y, size_t n,
                        float *phi, float *gx, float *gy)
{
    for (size_t k = 0; k < n; k++) {
        float px = clamp(x[k], (float)d->cells_x), py = clamp(y[k], (float)d->cells_y);
        uint32_t i = cell_of(px, d->cells_x), j = cell_of(py, d->cells_y);
        int32_t slot = slot_of(d, i, j);
        if (slot < 0) {
            phi[k] = gx[k] = gy[k] = 0;
            continue;
        }
        const float *v = d->value + (size_t)slot * (IL_TILE_NODES * IL_TILE_NODES)
                       + j % IL_TILE_CELLS * IL_TILE_NODES + i % IL_TILE_CELLS;
        float tx = px - (float)i, ty = py - (float)j;
        float below = v[1] - v[0], above = v[IL_TILE_NODES + 1] - v[IL_TILE_NODES];
        float left = v[IL_TILE_NODES] - v[0], twist = above - below;
        gx[k] = below + ty * twist;
        gy[k] = left + tx * twist;
        phi[k] = v[0] + tx * gx[k] + ty * left;
    }
}

/* ---- feet ---- */

typedef struct place { double t, distance2; } place;

static place foot_on(const il_distance_segment *s, double x, double y)
{
    double px = x - s->ax, py = y - s->ay, along = px * s->ux + py * s->uy;
    along = !(along > 0) ? 0 : along < s->length ? along : s->length;
    double ex = px - along * s->ux, ey = py - along * s->uy;
    return (place){ along, ex * ex + ey * ey };
}

il_foot il_distance_foot(il_distance *d, float x, float y)
{
    x = clamp(x, (float)d->cells_x), y = clamp(y, (float)d->cells_y);
    int32_t slot = slot_of(d, cell_of(x, d->cells_x), cell_of(y, d->cells_y));
    if (slot < 0)
        return (il_foot){ 0, 0, 0 };
    place best = { 0, INFINITY };
    uint32_t nearest = 0;
    for (uint32_t c = d->first[slot]; c < d->first[slot + 1]; c++) {
        place p = foot_on(&d->segment[d->candidate[c]], x, y);
        if (p.distance2 < best.distance2) {
            best = p;
            nearest = d->candidate[c];
        }
    }
    double length = d->segment[nearest].length;
    return (il_foot){ nearest, length > 0 ? (float)(best.t / length) : 0, (float)sqrt(best.distance2) };
}
