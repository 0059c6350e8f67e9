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
    il_free(d->block);
    il_free(d->first_block);
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

/* Four words at once. */
typedef uint64_t words __attribute__((vector_size(32)));
enum { WORDS = 4 };

/* Bit i of a row becomes the parity of bits 0 to i: first in each word, then with
 * the last bit of the word before. */
IL_CLONES static void sum_rows(uint64_t *row, size_t n_rows, size_t row_words)
{
    for (size_t k = 0; k < n_rows * row_words; k += WORDS) {
        words w;
        memcpy(&w, row + k, sizeof w);
        w ^= w << 1, w ^= w << 2, w ^= w << 4, w ^= w << 8, w ^= w << 16, w ^= w << 32;
        memcpy(row + k, &w, sizeof w);
    }
    for (size_t j = 0; j < n_rows; j++, row += row_words)
        for (size_t k = 1; k < row_words; k++)
            row[k] ^= 0 - (row[k - 1] >> 63);
}

static void mark_inside(il_distance *d, const double *xy, const uint32_t *next)
{
    size_t n_rows = d->cells_y + 1;
    memset(d->inside, 0, (n_rows * d->row_words + WORDS) * sizeof *d->inside);
    for (size_t i = 0; i < d->n; i++)
        toggle_segment(d, xy + 2 * i, xy + 2 * (size_t)next[i]);
    sum_rows(d->inside, n_rows, d->row_words);
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
        && il_grow(&d->inside, &d->cap_inside, (d->cells_y + 1) * d->row_words + WORDS, sizeof *d->inside)
        && il_grow(&d->slot, &d->cap_slot, n_tiles, sizeof *d->slot)
        && il_grow(&d->first, &d->cap_first, 1, sizeof *d->first)
        && il_grow(&d->first_block, &d->cap_first_block, 1, sizeof *d->first_block)
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
        reach = fabs(a[0]) > reach ? fabs(a[0]) : reach;
        reach = fabs(a[1]) > reach ? fabs(a[1]) : reach;
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

IL_CLONES static void lay_boxes(il_distance *d)
{
    for (size_t i = 0; i < groups(d->n_runs) * IL_LANES; i++) {
        const il_distance_run *r = &d->run[i < d->n_runs ? i : d->n_runs - 1];
        il_f8 ax = il_f8_load(r->ax), ay = il_f8_load(r->ay), length = il_f8_load(r->length);
        il_f8 bx = ax + length * il_f8_load(r->ux), by = ay + length * il_f8_load(r->uy);
        float x0 = il_f8_least(il_f8_min(ax, bx)), x1 = -il_f8_least(il_f8_min(-ax, -bx));
        float y0 = il_f8_least(il_f8_min(ay, by)), y1 = -il_f8_least(il_f8_min(-ay, -by));
        il_distance_box *to = &d->box[i / IL_LANES];
        size_t k = i % IL_LANES;
        to->x[k] = 0.5f * (x0 + x1), to->half_x[k] = 0.5f * (x1 - x0);
        to->y[k] = 0.5f * (y0 + y1), to->half_y[k] = 0.5f * (y1 - y0);
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
    d->n_tiles_done = d->n_candidates = d->n_blocks = 0;
    d->failed = !make_room(d);
    if (d->failed)
        return il_fail_nomem(err);
    for (size_t t = 0; t < (size_t)d->tiles_x * d->tiles_y; t++)
        d->slot[t] = -1;
    d->first[0] = d->first_block[0] = 0;
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

/* Of node (I, J), in `value` and `nearest`. */
static size_t place_in_tile(int32_t slot, uint32_t i, uint32_t j)
{
    return ((size_t)slot * IL_TILE_NODES + j % IL_TILE_CELLS) * IL_TILE_NODES + i % IL_TILE_CELLS;
}

/* Phi at the corners of eight cells. */
typedef struct corners { float v[4][IL_LANES]; } corners;

/* Of cells with their first corner AT so far in TILE; zeros without memory. */
IL_LANEWISE void fetch(il_distance *d, il_i8 tile, il_i8 at, corners *c)
{
    static const float none[IL_TILE_NODES + 2];
    for (int k = 0; k < IL_LANES; k++) {
        int32_t slot = d->slot[tile[k]];
        if (slot < 0)
            slot = il_distance_make_tile(d, (uint32_t)tile[k]);
        const float *v = slot < 0 ? none : d->value + slot * (IL_TILE_NODES * IL_TILE_NODES) + at[k];
        c->v[0][k] = v[0], c->v[1][k] = v[1];
        c->v[2][k] = v[IL_TILE_NODES], c->v[3][k] = v[IL_TILE_NODES + 1];
    }
}

/* The whole part of V >= 0. */
IL_LANEWISE il_f8 whole(il_f8 v)
{
    return __builtin_convertvector(__builtin_convertvector(v, il_i8), il_f8);
}

/* Eight points.  Cells and tiles are counted in floats, which hold such numbers
 * exactly and multiply on every processor; (i + 1/2) / 15 is never near a whole number. */
IL_CLONES static void sample_lanes(il_distance *d, const float *x, const float *y, float *phi, float *gx, float *gy)
{
    const float per_cell = 1.0f / IL_TILE_CELLS;
    il_f8 none = il_f8_all(0), cells_x = il_f8_all((float)d->cells_x), cells_y = il_f8_all((float)d->cells_y);
    il_f8 px = il_f8_min(il_f8_max(il_f8_load(x), none), cells_x), i = il_f8_min(whole(px), cells_x - 1);
    il_f8 py = il_f8_min(il_f8_max(il_f8_load(y), none), cells_y), j = il_f8_min(whole(py), cells_y - 1);
    il_f8 tile_i = whole((i + 0.5f) * per_cell), tile_j = whole((j + 0.5f) * per_cell);
    il_f8 at = (j - tile_j * IL_TILE_CELLS) * IL_TILE_NODES + (i - tile_i * IL_TILE_CELLS);
    corners c;
    fetch(d, __builtin_convertvector(tile_j * (float)d->tiles_x + tile_i, il_i8), __builtin_convertvector(at, il_i8), &c);
    il_f8 v = il_f8_load(c.v[0]), below = il_f8_load(c.v[1]) - v, left = il_f8_load(c.v[2]) - v;
    il_f8 twist = il_f8_load(c.v[3]) - il_f8_load(c.v[2]) - below;
    il_f8 tx = px - i, ty = py - j, slope = below + ty * twist;
    il_f8_store(gx, slope);
    il_f8_store(gy, left + tx * twist);
    il_f8_store(phi, v + tx * slope + ty * left);
}

void il_distance_sample(il_distance *d, const float *x, const float *y, size_t n,
                        float *phi, float *gx, float *gy)
{
    size_t k = 0;
    for (; k + IL_LANES <= n; k += IL_LANES)
        sample_lanes(d, x + k, y + k, phi + k, gx + k, gy + k);
    if (k == n)
        return;
    float in[2][IL_LANES], out[3][IL_LANES];
    for (size_t m = 0; m < IL_LANES; m++) {
        in[0][m] = x[k + m < n ? k + m : k];
        in[1][m] = y[k + m < n ? k + m : k];
    }
    sample_lanes(d, in[0], in[1], out[0], out[1], out[2]);
    for (size_t m = 0; k + m < n; m++)
        phi[k + m] = out[0][m], gx[k + m] = out[1][m], gy[k + m] = out[2][m];
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

/* Is all of B further from (X, Y) than the root of DISTANCE2, whatever the rounding? */
static bool is_beyond(const il_distance_block *b, double x, double y, double distance2)
{
    double dx = fmax(fmax(b->x0 - x, x - b->x1), 0), dy = fmax(fmax(b->y0 - y, y - b->y1), 0);
    return (dx * dx + dy * dy) * (1 - 1e-9) > distance2;
}

il_foot il_distance_foot(il_distance *d, float x, float y)
{
    x = clamp(x, (float)d->cells_x), y = clamp(y, (float)d->cells_y);
    uint32_t i = cell_of(x, d->cells_x), j = cell_of(y, d->cells_y);
    int32_t slot = slot_of(d, i, j);
    if (slot < 0)
        return (il_foot){ 0, 0, 0 };
    /* That of the cell's corner is most often the one: hardly another will be nearer. */
    uint32_t nearest = d->nearest[place_in_tile(slot, i, j)];
    place best = foot_on(&d->segment[nearest], x, y);
    uint32_t c = d->first[slot];
    for (uint32_t b = d->first_block[slot]; b < d->first_block[slot + 1]; b++) {
        if (is_beyond(&d->block[b], x, y, best.distance2))
            c = d->block[b].end;
        for (; c < d->block[b].end; c++) {
            place p = foot_on(&d->segment[d->candidate[c]], x, y);
            if (p.distance2 < best.distance2) {
                best = p;
                nearest = d->candidate[c];
            }
        }
    }
    double length = d->segment[nearest].length;
    return (il_foot){ nearest, length > 0 ? (float)(best.t / length) : 0, (float)sqrt(best.distance2) };
}
