/* One tile of the map: which segments can be nearest in it, then the distances.
 *
 * Culling in three steps, each exact.  Runs of eight segments by their boxes; the
 * segments of the runs that are left; and these again in each quarter of the tile,
 * where what is still left is tried at all 64 nodes.  There is no division, and no
 * root but one a node at the end.  What is kept is what is not known to be too far,
 * so that one is left whatever the numbers are. */
#include "config.h"
#include "match/distance-private.h"
#include "base/alloc.h"

#include <math.h>

enum {
    NODES = IL_TILE_NODES * IL_TILE_NODES,
    QUARTER_NODES = IL_TILE_NODES / 2,
};

/* Half diagonal of a tile: sqrt(2) * 7.5, rounded up. */
static const float TILE_RADIUS = 10.60661f;

/* From here on distances are told by how far they differ from that of the tile's
 * middle: what floats lose in squares of such numbers comes near to 1e-5. */
#define FAR 32

/* ---- culling ---- */

static float square(float v)
{
    return v * v;
}

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

/* The way (X, Y) from the foot on a segment along (UX, UY), BEYOND it at one end.
 * In a square of half a side HALF the foot moves along by no more than the square
 * reaches out past that end. */
IL_LANEWISE void store_way(il_distance_way *w, il_f8 x, il_f8 y, il_f8 ux, il_f8 uy, il_f8 beyond, float half)
{
    il_f8 moves = il_f8_max((il_f8_abs(ux) + il_f8_abs(uy)) * half - il_f8_abs(beyond), il_f8_all(0));
    il_f8_store(w->square, x * x + y * y);
    il_f8_store(w->x, x);
    il_f8_store(w->y, y);
    il_f8_store(w->lack, moves * moves);
}

IL_CLONES static void measure_runs(const il_distance_run *run, const uint32_t *kept, size_t n,
                                   float x, float y, float half, il_distance_way *way)
{
    il_f8 none = il_f8_all(0);
    for (size_t i = 0; i < n; i++) {
        const il_distance_run *r = &run[kept[i]];
        il_f8 ux = il_f8_load(r->ux), uy = il_f8_load(r->uy);
        il_f8 px = x - il_f8_load(r->ax), py = y - il_f8_load(r->ay);
        il_f8 along = px * ux + py * uy;
        il_f8 foot = il_f8_min(il_f8_max(along, none), il_f8_load(r->length));
        store_way(&way[i], px - foot * ux, py - foot * uy, ux, uy, along - foot, half);
    }
}

/* A segment that may rule out others. */
typedef struct rival { float square, x, y; } rival;
enum { RIVALS = 4 };

/* A key of 22 bits of a length >= 0 and 10 of an index, to be compared as a float:
 * which of two lengths that are nearly the same is less does not matter here. */
enum { INDEX_BITS = 0x3ff };

IL_LANEWISE void keep_less(il_f8 *key, il_f8 length, il_i8 index)
{
    *key = il_f8_min((il_f8)(((il_i8)length & ~INDEX_BITS) | (index & INDEX_BITS)), *key);
}

IL_LANEWISE rival least_rival(const il_distance_way *way, il_f8 key)
{
    uint32_t index;
    float least = il_f8_least(key);
    memcpy(&index, &least, sizeof index);
    const il_distance_way *w = &way[(index & INDEX_BITS) / IL_LANES];
    return (rival){ w->square[index % IL_LANES], w->x[index % IL_LANES], w->y[index % IL_LANES] };
}

/* Those nearest to the middles of the sides, were their feet to stay: each rules out
 * what lies beyond its side.  The least square. */
IL_LANEWISE float find_rivals(rival *a, const il_distance_way *way, size_t n, float half)
{
    il_f8 key[RIVALS];
    for (int k = 0; k < RIVALS; k++)
        key[k] = il_f8_all(INFINITY);
    il_i8 index = { 0, 1, 2, 3, 4, 5, 6, 7 };
    for (size_t i = 0; i < n; i += IL_LANES, index += IL_LANES) {
        const il_distance_way *w = &way[i / IL_LANES];
        il_f8 q = il_f8_load(w->square), x = il_f8_load(w->x) * (2 * half), y = il_f8_load(w->y) * (2 * half);
        q += half * half;
        keep_less(&key[0], q + x, index);
        keep_less(&key[1], q - x, index);
        keep_less(&key[2], q + y, index);
        keep_less(&key[3], q - y, index);
    }
    float least = INFINITY;
    for (int k = 0; k < RIVALS; k++) {
        a[k] = least_rival(way, key[k]);
        least = a[k].square < least ? a[k].square : least;
    }
    return least;
}

/* Of N ways those of segments that can be nearest within HALF of the middle in x and y.
 *
 * With b the way from the foot of segment B to the middle m, the squared distance
 * of m + p from B is at least |b + p|^2 - lack, and that from A at most |a + p|^2.
 * The difference is linear in p, so it is least in a corner of the square: there
 *     |b|^2 - |a|^2 - lack - 2 HALF (|b_x - a_x| + |b_y - a_y|).
 * Where that is positive B is out. */
IL_CLONES static size_t keep(const il_distance_way *way, size_t n, float half, float slack, uint32_t *kept)
{
    rival a[RIVALS];
    float most = slack * (32 + 2 * sqrtf(find_rivals(a, way, n, half)));
    size_t n_kept = 0;
    for (size_t i = 0; i < n; i += IL_LANES, way++) {
        il_f8 own = il_f8_load(way->square) - il_f8_load(way->lack) - most, x = il_f8_load(way->x), y = il_f8_load(way->y);
        il_f8 out = il_f8_all(-INFINITY);
        for (int k = 0; k < RIVALS; k++)
            out = il_f8_max(own - a[k].square - (il_f8_abs(x - a[k].x) + il_f8_abs(y - a[k].y)) * (2 * half), out);
        uint32_t signs = il_f8_signs(out);
        for (size_t k = 0; k < IL_LANES && i + k < n; k++) {
            kept[n_kept] = (uint32_t)(i + k);
            n_kept += signs >> k & 1;
        }
    }
    return n_kept;
}

/* The segments that can be nearest somewhere in the square around (X, Y), as
 * candidates of the next tile; false without memory. */
static bool cull_all(il_distance *d, float x, float y)
{
    float most = square(bound_runs(d->box, d->n_runs, x, y, d->bound) + 2 * TILE_RADIUS + d->slack);
    size_t n_runs = 0;
    for (size_t r = 0; r < d->n_runs; r++) {
        d->kept[n_runs] = (uint32_t)r;
        n_runs += !(d->bound[r] > most);
    }
    if (!il_grow(&d->candidate, &d->cap_candidate, d->n_candidates + n_runs * IL_LANES, sizeof *d->candidate))
        return false;
    measure_runs(d->run, d->kept, n_runs, x, y, 0.5f * IL_TILE_CELLS, d->way);
    size_t n = n_runs * IL_LANES; /* the last run may be filled up */
    if (d->kept[n_runs - 1] == d->n_runs - 1)
        n -= d->n_runs * IL_LANES - d->n;
    uint32_t *candidate = d->candidate + d->n_candidates;
    size_t n_kept = keep(d->way, n, 0.5f * IL_TILE_CELLS, d->slack, candidate);
    for (size_t i = 0; i < n_kept; i++)
        candidate[i] = d->kept[candidate[i] / IL_LANES] * IL_LANES + candidate[i] % IL_LANES;
    d->n_candidates += n_kept;
    return true;
}

/* ---- the segments as the tile sees them ---- */

typedef struct view {
    const il_distance_near *near;
    const uint32_t *candidate;
    size_t n;
    double distance; /* of the tile's middle, when it is far */
    bool is_far;
} view;

/* Further than this along a segment from the foot of the middle is no other foot. */
#define REACH 16.

/* Way from foot to (X, Y) in the axes of S; where the foot is on it. */
typedef struct sight { double along, across, foot; } sight;

static sight sight_of(const il_distance_segment *s, double x, double y)
{
    double px = x - s->ax, py = y - s->ay, along = px * s->ux + py * s->uy;
    double foot = !(along > 0) ? 0 : along < s->length ? along : s->length;
    return (sight){ along - foot, px * s->uy - py * s->ux, foot };
}

static void look_at(il_distance_near *to, size_t k, const il_distance_segment *s, sight g)
{
    double low = g.foot < REACH ? -g.foot : -REACH;
    double high = s->length - g.foot < REACH ? s->length - g.foot : REACH;
    double middle = 0.5 * (low + high);
    to->ux[k] = (float)s->ux, to->uy[k] = (float)s->uy;
    to->k[k] = (float)(g.along - middle), to->half[k] = (float)(0.5 * (high - low));
    to->across[k] = (float)g.across;
    to->to_foot[k] = (float)-middle;
}

static double square_of(sight g)
{
    return g.along * g.along + g.across * g.across;
}

/* |m - f|^2 is told apart in doubles: the difference is all that floats hold. */
static void look_far(view *v, il_distance_near *near, const il_distance_segment *segment, double x, double y)
{
    double least = INFINITY;
    for (size_t i = 0; i < v->n; i++) {
        double q = square_of(sight_of(&segment[v->candidate[i]], x, y));
        least = q < least ? q : least;
    }
    for (size_t i = 0; i < v->n; i++) {
        double q = square_of(sight_of(&segment[v->candidate[i]], x, y));
        near[i / IL_LANES].excess[i % IL_LANES] = (float)(q - least);
    }
    v->distance = sqrt(least);
}

static view look(il_distance *d, const uint32_t *candidate, size_t n, double x, double y)
{
    view v = { d->near, candidate, n, 0, false };
    double least = INFINITY;
    for (size_t i = 0; i < n; i++) {
        const il_distance_segment *s = &d->segment[candidate[i]];
        sight g = sight_of(s, x, y);
        double q = square_of(g);
        least = q < least ? q : least;
        look_at(&d->near[i / IL_LANES], i % IL_LANES, s, g);
    }
    const il_distance_segment *last = &d->segment[candidate[n - 1]];
    for (size_t i = n; i % IL_LANES != 0; i++) /* no lane may be nearer */
        look_at(&d->near[i / IL_LANES], i % IL_LANES, last, sight_of(last, x, y));
    v.is_far = least > FAR * FAR;
    if (v.is_far)
        look_far(&v, d->near, d->segment, x, y);
    return v;
}

/* ---- a quarter of a tile ---- */

IL_CLONES static void measure_near(const view *v, float x, float y, float reach, il_distance_way *way)
{
    for (size_t i = 0; i < v->n; i += IL_LANES) {
        const il_distance_near *s = &v->near[i / IL_LANES];
        il_f8 ux = il_f8_load(s->ux), uy = il_f8_load(s->uy), half = il_f8_load(s->half);
        il_f8 along = x * ux + (y * uy + il_f8_load(s->k));
        il_f8 beyond = along - il_f8_max(il_f8_min(along, half), -half);
        il_f8 across = x * uy - (y * ux - il_f8_load(s->across));
        store_way(&way[i / IL_LANES], beyond * ux + across * uy, beyond * uy - across * ux, ux, uy, beyond, reach);
    }
}

/* The candidates KEPT for rows of nodes from Y on. */
IL_CLONES static void lay_rows(const view *v, const uint32_t *kept, size_t n, float y, il_distance_rows *rows)
{
    il_f8 py = (il_f8){ 0, 1, 2, 3, 4, 5, 6, 7 } + y;
    for (size_t i = 0; i < n; i++, rows++) {
        const il_distance_near *s = &v->near[kept[i] / IL_LANES];
        size_t k = kept[i] % IL_LANES;
        il_f8_store(rows->along, py * s->uy[k] + s->k[k]);
        il_f8_store(rows->across, py * s->ux[k] - s->across[k]);
        rows->ux = s->ux[k], rows->uy = s->uy[k], rows->half = s->half[k];
        rows->segment = v->candidate[kept[i]];
    }
}

typedef struct row_state { il_f8 least; il_i8 label; } row_state;

IL_LANEWISE void compare(row_state *r, il_f8 q, uint32_t segment)
{
    int32_t label = (int32_t)segment;
    for (int k = 0; k < IL_LANES; k++)
        r->label[k] = q[k] < r->least[k] ? label : r->label[k];
    r->least = il_f8_min(q, r->least);
}

/* Distances and labels of 8 rows of 8 nodes from X on. */
IL_CLONES static void measure_rows(const il_distance_rows *rows, size_t n, float x, float *value, uint32_t *nearest)
{
    il_f8 px = (il_f8){ 0, 1, 2, 3, 4, 5, 6, 7 } + x, none = il_f8_all(0);
    for (int j = 0; j < QUARTER_NODES; j++) {
        row_state r = { il_f8_all(INFINITY), { 0 } };
        for (size_t i = 0; i < n; i++) {
            const il_distance_rows *s = &rows[i];
            il_f8 beyond = il_f8_max(none, il_f8_abs(px * s->ux + s->along[j]) - s->half);
            il_f8 across = px * s->uy - s->across[j];
            compare(&r, beyond * beyond + across * across, s->segment);
        }
        il_f8_store(value, il_f8_root(r.least));
        il_i8_store(nearest, r.label);
        value += IL_TILE_NODES, nearest += IL_TILE_NODES;
    }
}

/* As lay_rows, but `along` and `across` are what they differ from the middle's. */
IL_CLONES static void lay_far_rows(const view *v, const uint32_t *kept, size_t n, float y, il_distance_rows *rows)
{
    il_f8 py = (il_f8){ 0, 1, 2, 3, 4, 5, 6, 7 } + y;
    for (size_t i = 0; i < n; i++, rows++) {
        const il_distance_near *s = &v->near[kept[i] / IL_LANES];
        size_t k = kept[i] % IL_LANES;
        il_f8_store(rows->along, py * s->uy[k]);
        il_f8_store(rows->across, py * s->ux[k]);
        rows->ux = s->ux[k], rows->uy = s->uy[k], rows->half = s->half[k];
        rows->segment = v->candidate[kept[i]];
        rows->k = s->k[k], rows->to_foot = s->to_foot[k], rows->excess = s->excess[k];
        rows->twice_along = 2 * (s->k[k] - s->to_foot[k]), rows->twice_across = 2 * s->across[k];
    }
}

/* From afar: with w = (wu, wn) how the way from the foot differs from that of the
 * middle, g, it is |g + w|^2 - D^2 = excess + (2g + w).w, of which nothing is large
 * but g, and a relative error of that is one of w only; and then
 * sqrt(D^2 + q) = D + q / (sqrt(D^2 + q) + D), D the middle's distance in two floats. */
IL_CLONES static void measure_far_rows(const il_distance_rows *rows, size_t n, double distance, float x,
                                       float *value, uint32_t *nearest)
{
    float high = (float)distance, low = (float)(distance - (double)high);
    il_f8 px = (il_f8){ 0, 1, 2, 3, 4, 5, 6, 7 } + x;
    for (int j = 0; j < QUARTER_NODES; j++) {
        row_state r = { il_f8_all(INFINITY), { 0 } };
        for (size_t i = 0; i < n; i++) {
            const il_distance_rows *s = &rows[i];
            il_f8 along = px * s->ux + s->along[j], half = il_f8_all(s->half);
            il_f8 foot = il_f8_max(il_f8_min(along + s->k, half), -half);
            il_f8 wu = along - (foot - s->to_foot);
            il_f8 wn = px * s->uy - s->across[j];
            compare(&r, s->excess + (wu * (wu + s->twice_along) + wn * (wn + s->twice_across)), s->segment);
        }
        il_f8_store(value, high + (low + r.least / (il_f8_root(high * high + r.least) + high)));
        il_i8_store(nearest, r.label);
        value += IL_TILE_NODES, nearest += IL_TILE_NODES;
    }
}

/* Nodes from (I, J) of the tile. */
static void measure_quarter(il_distance *d, const view *v, int i, int j, float *value, uint32_t *nearest)
{
    const float middle = 0.5f * IL_TILE_CELLS, half = 0.5f * (QUARTER_NODES - 1);
    float x = (float)i - middle, y = (float)j - middle;
    measure_near(v, x + half, y + half, half, d->way);
    size_t n = keep(d->way, v->n, half, d->slack, d->kept);
    if (v->is_far) {
        lay_far_rows(v, d->kept, n, y, d->rows);
        measure_far_rows(d->rows, n, v->distance, x, value, nearest);
    } else {
        lay_rows(v, d->kept, n, y, d->rows);
        measure_rows(d->rows, n, x, value, nearest);
    }
}

/* ---- signs ---- */

/* Nodes whose bit is unset lie outside. */
IL_LANEWISE void sign_row(float *value, uint32_t inside)
{
    const il_i8 to_top = { 31, 30, 29, 28, 27, 26, 25, 24 };
    for (int i = 0; i < IL_TILE_NODES; i += IL_LANES) {
        il_i8 sign = il_i8_all((int32_t)(~inside >> i)) << to_top & INT32_MIN;
        il_f8_store(value + i, (il_f8)((il_i8)il_f8_load(value + i) ^ sign));
    }
}

/* From node (I, J) of the raster; tiles at its end stick out. */
IL_CLONES static void sign_tile(const il_distance *d, size_t i, size_t j, float *value)
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

/* ---- blocks ---- */

static void extend(il_distance_block *b, const il_distance_segment *s)
{
    double end_x = s->ax + s->length * s->ux, end_y = s->ay + s->length * s->uy;
    b->x0 = fmin(b->x0, fmin(s->ax, end_x));
    b->y0 = fmin(b->y0, fmin(s->ay, end_y));
    b->x1 = fmax(b->x1, fmax(s->ax, end_x));
    b->y1 = fmax(b->y1, fmax(s->ay, end_y));
}

/* Candidates BEGIN .. n_candidates of the next tile, by as many blocks as there are
 * candidates in each, but at least 16: they come in the order of segments, so those
 * of one block lie together. */
static bool make_blocks(il_distance *d, size_t begin)
{
    size_t n = d->n_candidates - begin, size = (size_t)fmax(16, ceil(sqrt((double)n)));
    if (!il_grow(&d->block, &d->cap_block, d->n_blocks + (n + size - 1) / size, sizeof *d->block))
        return false;
    for (size_t c = begin; c < d->n_candidates;) {
        size_t end = d->n_candidates - c < size ? d->n_candidates : c + size;
        il_distance_block b = { INFINITY, INFINITY, -INFINITY, -INFINITY, (uint32_t)end };
        for (; c < end; c++)
            extend(&b, &d->segment[d->candidate[c]]);
        d->block[d->n_blocks++] = b;
    }
    return true;
}

/* ---- the tile ---- */

int32_t il_distance_make_tile(il_distance *d, uint32_t t)
{
    size_t slot = d->n_tiles_done, begin = d->n_candidates;
    uint32_t i = t % d->tiles_x * IL_TILE_CELLS, j = t / d->tiles_x * IL_TILE_CELLS;
    float x = (float)i + 0.5f * IL_TILE_CELLS, y = (float)j + 0.5f * IL_TILE_CELLS;
    if (!il_grow(&d->value, &d->cap_value, (slot + 1) * NODES, sizeof *d->value)
        || !il_grow(&d->nearest, &d->cap_nearest, (slot + 1) * NODES, sizeof *d->nearest)
        || !il_grow(&d->first, &d->cap_first, slot + 2, sizeof *d->first)
        || !il_grow(&d->first_block, &d->cap_first_block, slot + 2, sizeof *d->first_block)
        || !cull_all(d, x, y) || !make_blocks(d, begin)) {
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
    d->first_block[slot + 1] = (uint32_t)d->n_blocks;
    d->slot[t] = (int32_t)slot;
    d->n_tiles_done = slot + 1;
    return (int32_t)slot;
}
