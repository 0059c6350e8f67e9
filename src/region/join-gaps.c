/* join-gaps.c - nearest pairs first, over a grid that grows.
 *
 * With a reach r, all pairs of free ends within r are found in a grid of cells of about
 * that size, sorted and joined in turn; then r grows.  As no two ends within r are left
 * free, few of them share a cell of the next grid, however many there are.  The first
 * reach is small enough for that as well. */
#include "config.h"
#include "region/join-gaps.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "model/order.h"

#include <math.h>
#include <stdlib.h>

/* Grids are thin when the squares of their cells' numbers of ends add up to no more
 * than this many times the ends. */
enum { CROWD = 16 };

/* Reaches grow and shrink by STRIDE where that leaves the grid thin, else by 2; what
 * bridging leaves free anew is looked at as often as TURNS. */
enum { STRIDE = 16, TURNS = 8 };

/* Cells this much wider than the reach: what lies within it is in the next cell at
 * most, however the quotients are rounded. */
static const double CELL = 2;

/* Below this, cells are too small for numbers. */
static const double LEAST_REACH = 1e-280;

typedef struct cell { uint32_t first, n; } cell;

/* Two free ends, the lesser vertex first, and the square of their distance. */
typedef struct gap {
    double square;
    const double *at, *at_other;
    uint32_t end, other;
} gap;

/* free_end[n_free]: ends alone at their places and not joined.  next[end]: the next in
 * its cell. */
typedef struct bridge {
    il_ends *ends;
    const il_keymap *edges;
    uint32_t *free_end, *next;
    size_t n_free;
    il_keymap at;
    cell *cell;
    gap *gap;
    size_t n_gaps, cap_gaps;
    size_t n_bridged;
    double largest;
} bridge;

/* ---- the grid ------------------------------------------------------------------------ */

/* *CROWDED: too many ends share cells for this reach. */
static bool fill_grid(bridge *b, double reach, bool *crowded)
{
    double crowd = 0, size = CELL * reach;
    il_keymap_free(&b->at);
    if (!il_keymap_reserve(&b->at, b->n_free))
        return false;
    for (size_t i = 0; i < b->n_free; i++) {
        uint32_t e = b->free_end[i];
        const double *p = b->ends->at + 2 * (size_t)e;
        uint32_t fresh = (uint32_t)b->at.n;
        uint32_t *c = il_keymap_put(&b->at, il_keymap_double(floor(p[0] / size)), il_keymap_double(floor(p[1] / size)), fresh);
        if (!c)
            return false;
        if (*c == fresh)
            b->cell[fresh] = (cell){ IL_NO_END, 0 };
        b->next[e] = b->cell[*c].first;
        b->cell[*c].first = e;
        crowd += 2.0 * b->cell[*c].n++ + 1;
    }
    *crowded = crowd > CROWD * (double)b->n_free;
    return true;
}

/* ---- pairs ---------------------------------------------------------------------------- */

static bool has_edge(const bridge *b, uint32_t a, uint32_t c)
{
    return il_keymap_get(b->edges, IL_KEYMAP_EDGE(b->ends->place[a], b->ends->place[c]), 0) != 0;
}

/* The gap from end A to end C, unless it is too wide or a line has that edge. */
static bool consider(bridge *b, uint32_t a, uint32_t c, double reach)
{
    const double *p = b->ends->at + 2 * (size_t)a, *q = b->ends->at + 2 * (size_t)c;
    double square = (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
    if (sqrt(square) > reach || has_edge(b, a, c))
        return true;
    if (!il_grow(&b->gap, &b->cap_gaps, b->n_gaps + 1, sizeof *b->gap))
        return false;
    bool least = il_vertex_compare(p, q) < 0;
    b->gap[b->n_gaps++] = least ? (gap){ square, p, q, a, c } : (gap){ square, q, p, c, a };
    return true;
}

/* All gaps within REACH of end A: in its cell to those that are greater in number, and
 * to all in the next cells on one side, for the others look over here. */
static bool find_gaps_of(bridge *b, uint32_t a, double reach)
{
    static const int across[] = { 0, 1, 1, 1, 0 }, up[] = { 0, -1, 0, 1, 1 };
    const double *p = b->ends->at + 2 * (size_t)a;
    double size = CELL * reach, x = floor(p[0] / size), y = floor(p[1] / size);
    for (int k = 0; k < 5; k++) {
        double i = x + across[k], j = y + up[k]; /* far out, these are no other cells */
        if ((i == x && across[k] != 0) || (j == y && up[k] != 0))
            continue;
        uint32_t c = il_keymap_get(&b->at, il_keymap_double(i), il_keymap_double(j), IL_NO_END);
        for (uint32_t e = c == IL_NO_END ? IL_NO_END : b->cell[c].first; e != IL_NO_END; e = b->next[e])
            if ((k > 0 || e > a) && !consider(b, a, e, reach))
                return false;
    }
    return true;
}

static int compare(const void *va, const void *vb)
{
    const gap *a = va, *b = vb;
    if (a->square != b->square)
        return a->square < b->square ? -1 : 1;
    int c = il_vertex_compare(a->at, b->at);
    return c != 0 ? c : il_vertex_compare(a->at_other, b->at_other);
}

static void join_gaps(bridge *b)
{
    qsort(b->gap, b->n_gaps, sizeof *b->gap, compare);
    for (size_t i = 0; i < b->n_gaps; i++) {
        const gap *g = &b->gap[i];
        if (b->ends->partner[g->end] != IL_NO_END || b->ends->partner[g->other] != IL_NO_END)
            continue;
        il_ends_join_two(b->ends, g->end, g->other);
        b->n_bridged++;
        b->largest = fmax(b->largest, sqrt(g->square));
    }
}

static bool bridge_within(bridge *b, double reach)
{
    b->n_gaps = 0;
    for (size_t i = 0; i < b->n_free; i++)
        if (!find_gaps_of(b, b->free_end[i], reach))
            return false;
    if (b->n_gaps > 0)
        join_gaps(b);
    size_t n = 0;
    for (size_t i = 0; i < b->n_free; i++)
        if (b->ends->partner[b->free_end[i]] == IL_NO_END)
            b->free_end[n++] = b->free_end[i];
    b->n_free = n;
    return true;
}

/* The first reach is small enough, and so is the next, which is as wide as may be. */
static bool bridge_up_to(bridge *b, double distance)
{
    double reach = distance;
    bool crowded = false, ok = fill_grid(b, reach, &crowded);
    while (ok && crowded && reach / STRIDE > LEAST_REACH) {
        reach /= STRIDE;
        ok = fill_grid(b, reach, &crowded);
    }
    ok = ok && bridge_within(b, reach);
    while (ok && reach < distance && b->n_free > 1) {
        double before = reach;
        reach = fmin(STRIDE * before, distance);
        ok = fill_grid(b, reach, &crowded);
        if (ok && crowded) {
            reach = fmin(2 * before, distance);
            ok = fill_grid(b, reach, &crowded);
        }
        ok = ok && bridge_within(b, reach);
    }
    return ok;
}

static void find_free(bridge *b)
{
    b->n_free = 0;
    for (uint32_t k = 0; k < b->ends->n; k++)
        if (b->ends->alive[b->ends->place[k]] == 1 && b->ends->partner[k] == IL_NO_END)
            b->free_end[b->n_free++] = k;
}

/* A line that is closed leaves others free in its knot, which then take part. */
static bool bridge_all(bridge *b, double distance)
{
    for (int turn = 0; turn < TURNS; turn++) {
        size_t n_left = b->n_free;
        find_free(b);
        if (b->n_free < 2 || (turn > 0 && b->n_free == n_left))
            return true;
        if (!bridge_up_to(b, distance))
            return false;
    }
    return true;
}

il_status il_ends_bridge(il_ends *e, double distance, const il_keymap *edges, size_t *n_bridged, double *largest, il_error *err)
{
    bridge b = { .ends = e, .edges = edges, .at = IL_KEYMAP_INIT };
    b.free_end = il_alloc(e->n, sizeof *b.free_end);
    b.next = il_alloc(e->n, sizeof *b.next);
    b.cell = il_alloc(e->n, sizeof *b.cell);
    bool ok = b.free_end && b.next && b.cell && bridge_all(&b, distance);
    il_free(b.free_end);
    il_free(b.next);
    il_free(b.cell);
    il_free(b.gap);
    il_keymap_free(&b.at);
    *n_bridged = b.n_bridged;
    *largest = b.largest;
    return ok ? IL_OK : il_fail_nomem(err);
}
