#include "config.h"
#include "model/near.h"
#include "base/alloc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void il_near_free(il_near *m)
{
    il_free(m->xy);
    il_keymap_free(&m->in_box);
    *m = (il_near)IL_NEAR_INIT;
}

/* Number of the box at V: whole, and below 2^53 by the choice of cells (arrange.h). */
static int64_t box_of(const il_near *m, double v)
{
    return (int64_t)floor(v / m->cell);
}

static bool is_nearer(const double *p, const double *q, double x, double y)
{
    double dp = fmax(fabs(p[0] - x), fabs(p[1] - y)), dq = fmax(fabs(q[0] - x), fabs(q[1] - y));
    if (dp != dq)
        return dp < dq;
    return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
}

uint32_t il_near_find(const il_near *m, double x, double y)
{
    uint32_t best = UINT32_MAX;
    for (int k = 0; k < 9; k++) {
        uint64_t bx = (uint64_t)(box_of(m, x) + k % 3 - 1), by = (uint64_t)(box_of(m, y) + k / 3 - 1);
        uint32_t i = il_keymap_get(&m->in_box, bx, by, UINT32_MAX);
        if (i == UINT32_MAX || !(fabs(m->xy[2 * i] - x) < m->cell && fabs(m->xy[2 * i + 1] - y) < m->cell))
            continue;
        if (best == UINT32_MAX || is_nearer(m->xy + 2 * i, m->xy + 2 * best, x, y))
            best = i;
    }
    return best;
}

bool il_near_add(il_near *m, double x, double y)
{
    if (!il_grow(&m->xy, &m->cap, 2 * (m->n + 1), sizeof *m->xy) ||
        !il_keymap_put(&m->in_box, (uint64_t)box_of(m, x), (uint64_t)box_of(m, y), (uint32_t)m->n))
        return false;
    m->xy[2 * m->n] = x;
    m->xy[2 * m->n + 1] = y;
    m->n++;
    return true;
}

/* ---- gathering ---- */

static int compare_places(const void *p, const void *q)
{
    const double *a = p, *b = q;
    if (a[0] != b[0])
        return a[0] < b[0] ? -1 : 1;
    return a[1] < b[1] ? -1 : a[1] > b[1];
}

/* All vertices of S by rising x, then y: xy[2*n], to il_free; null without memory. */
static double *sort_vertices(const il_slice *s, size_t *n)
{
    double *xy = il_alloc(il_slice_points(s), 2 * sizeof *xy);
    *n = 0;
    for (size_t i = 0; xy && i < s->n; *n += s->ring[i].n, i++)
        if (s->ring[i].n > 0)
            memcpy(xy + 2 * *n, s->ring[i].xy, 2 * s->ring[i].n * sizeof *xy);
    if (xy)
        qsort(xy, *n, 2 * sizeof *xy, compare_places);
    return xy;
}

/* Are the sorted points a cell apart, or equal?  False also where many have one x
 * and this would take long.  Nearly all slices are so, and need no boxes: these
 * took a third of the time of cleaning. */
static bool are_apart(const double *xy, size_t n, double cell)
{
    size_t steps = 0, most = 8 * n;
    for (size_t i = 0; i < n; i++) {
        const double *p = xy + 2 * i;
        for (size_t k = i + 1; k < n && xy[2 * k] - p[0] < cell; k++)
            if (++steps > most || (fabs(xy[2 * k + 1] - p[1]) < cell && (xy[2 * k] != p[0] || xy[2 * k + 1] != p[1])))
                return false;
    }
    return true;
}

/* The places that stay of the sorted points. */
static bool find_places(il_near *places, const double *xy, size_t n)
{
    bool ok = true;
    for (size_t i = 0; ok && i < n; i++)
        if (il_near_find(places, xy[2 * i], xy[2 * i + 1]) == UINT32_MAX)
            ok = il_near_add(places, xy[2 * i], xy[2 * i + 1]);
    return ok;
}

/* Move the vertices of R to the places near them; moved[n] marks those. */
static size_t move_ring(il_ring *r, const il_near *places, bool *moved)
{
    size_t n = 0;
    for (size_t k = 0; k < r->n; k++) {
        double *p = r->xy + 2 * k;
        const double *to = places->xy + 2 * (size_t)il_near_find(places, p[0], p[1]);
        moved[k] = to[0] != p[0] || to[1] != p[1];
        n += moved[k];
        p[0] = to[0], p[1] = to[1];
    }
    return n;
}

static bool same_place(const il_ring *r, size_t i, size_t k)
{
    return r->xy[2 * i] == r->xy[2 * k] && r->xy[2 * i + 1] == r->xy[2 * k + 1];
}

static size_t count_joined(const il_ring *r, const bool *moved)
{
    size_t n = 0;
    for (size_t k = 0; k < r->n; k++)
        n += moved[k] && !same_place(r, k, (k + 1) % r->n) && !same_place(r, k, (k + r->n - 1) % r->n);
    return n;
}

il_status il_slice_gather(il_slice *s, double cell, size_t *n_moved, size_t *n_joined, il_error *err)
{
    il_near places = { .cell = cell };
    size_t n = 0;
    double *xy = sort_vertices(s, &n);
    bool *moved = il_alloc(il_slice_points(s), sizeof *moved), ok = xy && moved;
    bool is_done = ok && are_apart(xy, n, cell);
    ok = ok && (is_done || find_places(&places, xy, n));
    *n_moved = *n_joined = 0;
    for (size_t i = 0; ok && !is_done && i < s->n; i++) {
        *n_moved += move_ring(&s->ring[i], &places, moved);
        *n_joined += count_joined(&s->ring[i], moved);
    }
    il_free(xy);
    il_free(moved);
    il_near_free(&places);
    return ok ? IL_OK : il_fail_nomem(err);
}
