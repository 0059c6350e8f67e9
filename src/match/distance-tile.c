/* One tile of the map: which segments can be nearest in it, then the distances.
 *
 * Culling in three steps, each exact: a segment B whose distance from the middle
 * of a square of half diagonal r exceeds that of another by more than 2r is
 * nearest nowhere in the square.  Runs of eight segments by their boxes; the
 * segments of the runs that are left; and these again in each quarter of the
 * tile, where what is still left is tried at all 64 nodes.  There is no division
 * and no root but one a node at the end.  What is kept is what is not known to be
 * too far, so that one is left whatever the numbers are. */
#include "config.h"
#include "match/distance-private.h"
#include "base/alloc.h"

#include <math.h>

enum {
    NODES = IL_TILE_NODES * IL_TILE_NODES,
    QUARTER_NODES = IL_TILE_NODES / 2,
};

/* Half diagonals of the squares of nodes: sqrt(2) * 7.5 and 3.5, rounded up. */
static const float TILE_RADIUS = 10.60661f, QUARTER_RADIUS = 4.94975f;

/* From here on distances are told by how far they differ from that of the
 * middle: a float near 100 has a place in 1e-5 left. */
#define FAR 32

/* ---- culling ---- */

/* bound[run]: squares of lower bounds on the distance from (X, Y); an upper bound
 * on the least distance to anything. */
IL_CLONES static float bound_runs(const il_distance_box *box, size_t n_runs, float x, float y, float *bound)
{
    il_f8 least = il_f8_all(INFINITY), none = il_f8_all(0);
    for (size_t i = 0; i < n_runs; i += IL_LANES, box++) {
        il_f8 dx = il_f8_max(il_f8_abs(il_f8_load(box->x) - x) - il_f8_load(box->half_x), none);
        il_f8 dy = il_f8_max(il_f8_abs(il_f8_load(box->y) - y) - il_f8_load(box->half_y), none);
        il_f8 on_x = il_f8_load(box->on_x) - x, on_y = il_f8_load(box->on_y) - y;
        il_f8_store(bound + i, dx * dx + dy * dy);
        least = il_f8_min(on_x * on_x + on_y * on_y, least);
    }
    return sqrtf(il_f8_least(least));
}

/* As bound_runs, of the segments in N runs: squares of their distances. */
IL_CLONES static float measure_runs(const il_distance_run *run, const uint32_t *kept, size_t n,
                                    float x, float y, float *distance2)
{
    il_f8 least = il_f8_all(INFINITY), none = il_f8_all(0);
    for (size_t i = 0; i < n; i++) {
        const il_distance_run *r = &run[kept[i]];
        il_f8 ux = il_f8_load(r->ux), uy = il_f8_load(r->uy);
        il_f8 px = x - il_f8_load(r->ax), py = y - il_f8_load(r->ay);
        il_f8 along = il_f8_min(il_f8_max(px * ux + py * uy, none), il_f8_load(r->length));
        il_f8 ex = px - along * ux, ey = py - along * uy, q = ex * ex + ey * ey;
        il_f8_store(distance2 + i * IL_LANES, q);
        least = il_f8_min(q, least);
    }
    return sqrtf(il_f8_least(least));
}

static float square(float v)
{
    return v * v;
}

/* The segments that can be nearest somewhere in the square around (X, Y), as
 * candidates of the next tile; false without memory. */
static bool cull_all(il_distance *d, float x, float y)
{
    float *of_runs = d->bound, *of_segments = d->bound + (d->n_runs + IL_LANES - 1) / IL_LANES * IL_LANES;
    float most = square(bound_runs(d->box, d->n_runs, x, y, of_runs) + 2 * TILE_RADIUS + d->slack);
    size_t n_kept = 0;
    for (size_t r = 0; r < d->n_runs; r++) {
        d->kept[n_kept] = (uint32_t)r;
        n_kept += !(of_runs[r] > most);
    }
    if (!il_grow(&d->candidate, &d->cap_candidate, d->n_candidates + n_kept * IL_LANES, sizeof *d->candidate))
        return false;
    most = square(measure_runs(d->run, d->kept, n_kept, x, y, of_segments) + 2 * TILE_RADIUS + d->slack);
    for (size_t i = 0; i < n_kept; i++)
        for (uint32_t k = 0; k < IL_LANES; k++) {
            uint32_t s = d->kept[i] * IL_LANES + k;
            d->candidate[d->n_candidates] = s;
            d->n_candidates += s < d->n && !(of_segments[i * IL_LANES + k] > most);
        }
    return true;
}

/* ---- the segments as the tile sees them ---- */

typedef struct view {
    const il_distance_near *near;
    const uint32_t *candidate;
    size_t n;
    double distance; /* of the tile's middle */
    bool is_far;
} view;

/* Foot of (X, Y) on S, less (X, Y); how far S goes on behind it and before. */
typedef struct sight { double fx, fy, k, low, high; } sight;

static sight sight_of(const il_distance_segment *s, double x, double y)
{
    double px = x - s->ax, py = y - s->ay, along = px * s->ux + py * s->uy;
    double at = !(along > 0) ? 0 : along < s->length ? along : s->length;
    return (sight){ at * s->ux - px, at * s->uy - py, along - at, -at, s->length - at };
}

static double foot_distance(sight g)
{
    return sqrt(g.fx * g.fx + g.fy * g.fy);
}

static double least_distance(const view *v, const il_distance_segment *segment, double x, double y)
{
    double least = INFINITY;
    for (size_t i = 0; i < v->n; i++) {
        sight g = sight_of(&segment[v->candidate[i]], x, y);
        least = fmin(least, g.fx * g.fx + g.fy * g.fy);
    }
    return sqrt(least);
}

static view look(il_distance *d, const uint32_t *candidate, size_t n, double x, double y)
{
    view v = { d->near, candidate, n, 0, false };
    v.distance = least_distance(&v, d->segment, x, y);
    v.is_far = v.distance > FAR;
    size_t padded = (n + IL_LANES - 1) / IL_LANES * IL_LANES;
    for (size_t i = 0; i < padded; i++) {
        const il_distance_segment *s = &d->segment[candidate[i < n ? i : n - 1]];
        sight g = sight_of(s, x, y);
        double own = v.is_far ? foot_distance(g) : 0;
        il_distance_near *to = &d->near[i / IL_LANES];
        size_t k = i % IL_LANES;
        to->fx[k] = (float)g.fx, to->fy[k] = (float)g.fy;
        to->ux[k] = (float)s->ux, to->uy[k] = (float)s->uy;
        to->k[k] = (float)g.k, to->low[k] = (float)g.low, to->high[k] = (float)g.high;
        to->excess[k] = (float)((own - v.distance) * (own + v.distance));
    }
    return v;
}

/* One candidate in all lanes, or eight of them. */
typedef struct near8 { il_f8 fx, fy, ux, uy, k, low, high, excess; } near8;

IL_LANEWISE void load_all(near8 *s, const il_distance_near *n)
{
    *s = (near8){ il_f8_load(n->fx), il_f8_load(n->fy), il_f8_load(n->ux), il_f8_load(n->uy),
                  il_f8_load(n->k), il_f8_load(n->low), il_f8_load(n->high), il_f8_load(n->excess) };
}

IL_LANEWISE void load_one(near8 *s, const il_distance_near *n, size_t k)
{
    *s = (near8){ il_f8_all(n->fx[k]), il_f8_all(n->fy[k]), il_f8_all(n->ux[k]), il_f8_all(n->uy[k]),
                  il_f8_all(n->k[k]), il_f8_all(n->low[k]), il_f8_all(n->high[k]), il_f8_all(n->excess[k]) };
}

/* |f + w|^2 with w = s u - p, the way from p to its foot.  From afar, less the
 * square of the middle's distance: excess + (2f + w).w, of which nothing is large
 * but f, and a relative error of that is one of w only. */
IL_LANEWISE il_f8 distance2(const near8 *s, il_f8 x, il_f8 y, bool is_far)
{
    il_f8 along = il_f8_min(il_f8_max(x * s->ux + y * s->uy + s->k, s->low), s->high);
    il_f8 wx = along * s->ux - x, wy = along * s->uy - y;
    if (is_far)
        return s->excess + ((s->fx + s->fx + wx) * wx + (s->fy + s->fy + wy) * wy);
    il_f8 ex = s->fx + wx, ey = s->fy + wy;
    return ex * ex + ey * ey;
}

/* ---- a quarter of a tile ---- */

/* bound[i]: square of the distance of candidate i from (X, Y); the least distance. */
IL_CLONES static float measure_near(const view *v, float x, float y, float *bound)
{
    il_f8 least = il_f8_all(INFINITY);
    for (size_t i = 0; i < v->n; i += IL_LANES) {
        near8 s;
        load_all(&s, &v->near[i / IL_LANES]);
        il_f8 q = distance2(&s, il_f8_all(x), il_f8_all(y), false);
        il_f8_store(bound + i, q);
        least = il_f8_min(q, least);
    }
    return sqrtf(il_f8_least(least));
}

/* Distances and labels along a row of 8 nodes from (X, Y). */
IL_LANEWISE void measure_row(const view *v, const uint32_t *kept, size_t n, float x, float y, bool is_far,
                             float *value, uint32_t *nearest)
{
    il_f8 px = (il_f8){ 0, 1, 2, 3, 4, 5, 6, 7 } + x, py = il_f8_all(y), least = il_f8_all(INFINITY);
    il_i8 label = il_i8_all((int32_t)v->candidate[kept[0]]);
    for (size_t i = 0; i < n; i++) {
        near8 s;
        load_one(&s, &v->near[kept[i] / IL_LANES], kept[i] % IL_LANES);
        il_f8 q = distance2(&s, px, py, is_far);
        int32_t own = (int32_t)v->candidate[kept[i]];
        for (int k = 0; k < IL_LANES; k++)
            label[k] = q[k] < least[k] ? own : label[k];
        least = il_f8_min(q, least);
    }
    il_f8_store(value, least);
    il_i8_store(nearest, label);
}

IL_CLONES static void measure_quarter_near(const view *v, const uint32_t *kept, size_t n, float x, float y,
                                           float *value, uint32_t *nearest)
{
    for (int j = 0; j < QUARTER_NODES; j++) {
        measure_row(v, kept, n, x, y + (float)j, false, value, nearest);
        il_f8_store(value, il_f8_root(il_f8_load(value)));
        value += IL_TILE_NODES, nearest += IL_TILE_NODES;
    }
}

/* sqrt(D^2 + q) = D + q / (sqrt(D^2 + q) + D), with D in two floats. */
IL_CLONES static void measure_quarter_far(const view *v, const uint32_t *kept, size_t n, float x, float y,
                                          float *value, uint32_t *nearest)
{
    float high = (float)v->distance, low = (float)(v->distance - (double)high);
    for (int j = 0; j < QUARTER_NODES; j++) {
        measure_row(v, kept, n, x, y + (float)j, true, value, nearest);
        il_f8 q = il_f8_load(value);
        il_f8_store(value, high + (low + q / (il_f8_root(high * high + q) + high)));
        value += IL_TILE_NODES, nearest += IL_TILE_NODES;
    }
}

/* Nodes from (I, J) of the tile. */
static void measure_quarter(il_distance *d, const view *v, int i, int j, float *value, uint32_t *nearest)
{
    const float middle = 0.5f * IL_TILE_CELLS, half = 0.5f * (QUARTER_NODES - 1);
    float x = (float)i - middle, y = (float)j - middle;
    float least = measure_near(v, x + half, y + half, d->bound);
    float most = square(least + 2 * QUARTER_RADIUS + d->slack);
    uint32_t n_kept = 0;
    for (uint32_t s = 0; s < v->n; s++) {
        d->kept[n_kept] = s;
        n_kept += !(d->bound[s] > most);
    }
    (v->is_far ? measure_quarter_far : measure_quarter_near)(v, d->kept, n_kept, x, y, value, nearest);
}

/* ---- signs ---- */

/* Nodes with their bit unset lie outside. */
static void sign_row(float *value, uint32_t inside)
{
    for (int i = 0; i < IL_TILE_NODES; i++)
        value[i] = inside >> i & 1 ? value[i] : -value[i];
}

/* From node (I, J) of the raster; tiles at its end stick out. */
static void sign_tile(const il_distance *d, size_t i, size_t j, float *value)
{
    size_t most = d->cells_y;
    for (size_t row = 0; row < IL_TILE_NODES; row++) {
        const uint64_t *w = d->inside + (j + row < most ? j + row : most) * d->row_words + i / 64;
        uint64_t bits = w[0] >> i % 64;
        if (i % 64 > 64 - IL_TILE_NODES)
            bits |= w[1] << (64 - i % 64);
        sign_row(value + row * IL_TILE_NODES, (uint32_t)(bits & 0xffff));
    }
}

/* ---- the tile ---- */

int32_t il_distance_make_tile(il_distance *d, uint32_t t)
{
    size_t slot = d->n_tiles_done, begin = d->n_candidates;
    uint32_t i = t % d->tiles_x * IL_TILE_CELLS, j = t / d->tiles_x * IL_TILE_CELLS;
    float x = (float)i + 0.5f * IL_TILE_CELLS, y = (float)j + 0.5f * IL_TILE_CELLS;
    if (!il_grow(&d->value, &d->cap_value, (slot + 1) * NODES, sizeof *d->value)
        || !il_grow(&d->nearest, &d->cap_nearest, (slot + 1) * NODES, sizeof *d->nearest)
        || !il_grow(&d->first, &d->cap_first, slot + 2, sizeof *d->first) || !cull_all(d, x, y)) {
        d->failed = true;
        return -1;
    }
    view v = look(d, d->candidate + begin, d->n_candidates - begin, x, y);
    float *value = d->value + slot * NODES;
    uint32_t *nearest = d->nearest + slot * NODES;
    for (int q = 0; q < 4; q++) {
        int at_i = q % 2 * QUARTER_NODES, at_j = q / 2 * QUARTER_NODES;
        int at = at_j * IL_TILE_NODES + at_i;
        measure_quarter(d, &v, at_i, at_j, value + at, nearest + at);
    }
    sign_tile(d, i, j, value);
    d->first[slot + 1] = (uint32_t)d->n_candidates;
    d->slot[t] = (int32_t)slot;
    d->n_tiles_done = slot + 1;
    return (int32_t)slot;
}
