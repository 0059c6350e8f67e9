#include "config.h"
#include "terrain/plate-grid.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* Sweeps over the finest grid; twice as many over each coarser one, up to the most, which the
 * coarsest has, of at most COARSEST nodes one way. */
enum { SWEEPS = 16, SWEEPS_MOST = 256, COARSEST = 8 };

/* The weight of a line against bending, which is 20 at a node, and how far each step overshoots. */
static const double WEIGHT = 300, OVERSHOOT = 1.7;

/* Nodes that take part, those whose neighbours two steps about all do, and those on edges that
 * are held. */
enum { ACTIVE = 1, INNER = 2, HELD = 4 };

void il_plate_grid_free(il_plate_grid *g)
{
    il_free(g->z);
    il_free(g->bound);
    il_free(g->held);
    il_free(g->kind);
    il_free(g->hold);
    *g = (il_plate_grid)IL_PLATE_GRID_INIT;
}

bool il_plate_grid_make(il_plate_grid *g, const size_t n[2])
{
    size_t size = n[0] * n[1];
    *g = (il_plate_grid){ .n = { n[0], n[1] } };
    g->z = il_alloc(size, sizeof *g->z);
    g->bound = il_alloc(size, 2 * sizeof *g->bound);
    g->held = il_calloc(size, 2 * sizeof *g->held);
    g->kind = il_calloc(size, 1);
    return g->z && g->bound && g->held && g->kind;
}

static il_plate_hold *hold_of(il_plate_grid *g, size_t node, int axis)
{
    uint32_t *at = &g->held[2 * node + (size_t)axis];
    if (*at == 0) {
        if (g->n_holds >= UINT32_MAX - 1 || !il_grow(&g->hold, &g->cap_holds, g->n_holds + 1, sizeof *g->hold))
            return NULL;
        g->hold[g->n_holds] = (il_plate_hold){ 0 };
        *at = (uint32_t)++g->n_holds;
    }
    return &g->hold[*at - 1];
}

bool il_plate_grid_hold(il_plate_grid *g, size_t node, int axis, double t, double z)
{
    il_plate_hold *h = hold_of(g, node, axis);
    if (!h)
        return false;
    h->n += 1, h->t += t, h->tt += t * t, h->z += z, h->tz += t * z;
    return true;
}

/* ---- which nodes take part ------------------------------------------------------------ */

static bool is_active(const il_plate_grid *g, size_t i, size_t j)
{
    return i < g->n[0] && j < g->n[1] && g->kind[i + g->n[0] * j] & ACTIVE;
}

/* Those with bounds, and others up to two steps from them. */
static void find_active(il_plate_grid *g)
{
    for (size_t j = 0; j < g->n[1]; j++)
        for (size_t i = 0; i < g->n[0]; i++) {
            if (isinf(g->bound[2 * (i + g->n[0] * j)]))
                continue;
            for (size_t y = j < 2 ? 0 : j - 2; y <= j + 2 && y < g->n[1]; y++)
                for (size_t x = i < 2 ? 0 : i - 2; x <= i + 2 && x < g->n[0]; x++)
                    g->kind[x + g->n[0] * y] |= ACTIVE;
        }
}

static void find_inner(il_plate_grid *g)
{
    for (size_t j = 2; j + 2 < g->n[1]; j++)
        for (size_t i = 2; i + 2 < g->n[0]; i++) {
            bool inner = is_active(g, i - 2, j) && is_active(g, i + 2, j) && is_active(g, i, j - 2) && is_active(g, i, j + 2);
            for (size_t y = j - 1; y <= j + 1; y++)
                for (size_t x = i - 1; x <= i + 1; x++)
                    inner = inner && is_active(g, x, y);
            g->kind[i + g->n[0] * j] |= inner ? INNER : 0;
        }
}

static void find_held(il_plate_grid *g)
{
    for (size_t k = 0; k < 2 * g->n[0] * g->n[1]; k++)
        if (g->held[k]) {
            g->kind[k / 2] |= HELD;
            g->kind[k / 2 + (k % 2 ? g->n[0] : 1)] |= HELD;
        }
}

static void find_kinds(il_plate_grid *g)
{
    find_active(g);
    find_inner(g);
    find_held(g);
}

/* ---- one node -------------------------------------------------------------------------- */

/* Of the energy as a function of a single node's height, den z^2 - 2 num z. */
typedef struct pull { double num, den; } pull;

/* Node 0 of the terms (w0 z0 + w1 z1 + w2 z2 ...)^2, whose rest is REST. */
static void add_term(pull *p, double w0, double rest)
{
    p->num -= w0 * rest;
    p->den += w0 * w0;
}

/* Second differences along the axis whose neighbours are STEP apart: AROUND[2..6] tells which of
 * the nodes from 2 before to 2 after take part. */
static void bend_along(pull *p, const double *z, ptrdiff_t step, const bool around[5])
{
    if (around[0] && around[1])
        add_term(p, 1, z[-2 * step] - 2 * z[-step]);
    if (around[1] && around[3])
        add_term(p, -2, z[-step] + z[step]);
    if (around[3] && around[4])
        add_term(p, 1, z[2 * step] - 2 * z[step]);
}

/* A node beside the edge of those that take part. */
static pull pull_at_edge(const il_plate_grid *g, size_t i, size_t j, double tension2)
{
    pull p = { 0, 0 };
    size_t n = g->n[0];
    const double *z = g->z + i + n * j;
    bool x[5], y[5];
    for (size_t k = 0; k < 5; k++) { /* below 0 wraps, and is beyond */
        x[k] = is_active(g, i + k - 2, j);
        y[k] = is_active(g, i, j + k - 2);
    }
    bend_along(&p, z, 1, x);
    bend_along(&p, z, (ptrdiff_t)n, y);
    for (int k = 0; k < 4; k++) {
        ptrdiff_t dx = k % 2 ? 1 : -1, dy = k / 2 ? 1 : -1, row = dy * (ptrdiff_t)n;
        if (x[2 + dx] && y[2 + dy] && is_active(g, i + (size_t)dx, j + (size_t)dy)) {
            double rest = z[dx + row] - z[dx] - z[row];
            p.num -= 2 * rest;
            p.den += 2;
        }
    }
    for (int k = 1; k < 4; k += 2) {
        ptrdiff_t d = k - 2;
        if (x[k])
            p.num += tension2 * z[d], p.den += tension2;
        if (y[k])
            p.num += tension2 * z[d * (ptrdiff_t)n], p.den += tension2;
    }
    return p;
}

/* One with all its neighbours: the thirteen numbers of the plate. */
static pull pull_inside(const double *z, ptrdiff_t n, double tension2)
{
    double near = z[-1] + z[1] + z[-n] + z[n], corners = z[-n - 1] + z[-n + 1] + z[n - 1] + z[n + 1];
    double far = z[-2] + z[2] + z[-2 * n] + z[2 * n];
    return (pull){ (8 + tension2) * near - 2 * corners - far, 20 + 4 * tension2 };
}

/* The lines that cross the edges about NODE. */
static void add_holds(const il_plate_grid *g, size_t node, pull *p)
{
    for (size_t axis = 0; axis < 2; axis++) {
        size_t step = axis ? g->n[0] : 1;
        uint32_t k = g->held[2 * node + axis], m = node >= step ? g->held[2 * (node - step) + axis] : 0;
        if (k) {
            const il_plate_hold *h = &g->hold[k - 1];
            p->num += WEIGHT * (h->z - h->tz - (h->t - h->tt) * g->z[node + step]);
            p->den += WEIGHT * (h->n - 2 * h->t + h->tt);
        }
        if (m) {
            const il_plate_hold *h = &g->hold[m - 1];
            p->num += WEIGHT * (h->tz - (h->t - h->tt) * g->z[node - step]);
            p->den += WEIGHT * h->tt;
        }
    }
}

static void sweep(il_plate_grid *g, double tension2)
{
    const double inverse = 1 / (20 + 4 * tension2); /* division takes longer than all the rest */
    for (size_t j = 0; j < g->n[1]; j++)
        for (size_t i = 0; i < g->n[0]; i++) {
            size_t k = i + g->n[0] * j;
            unsigned char kind = g->kind[k];
            if (!(kind & ACTIVE))
                continue;
            pull p = kind & INNER ? pull_inside(g->z + k, (ptrdiff_t)g->n[0], tension2) : pull_at_edge(g, i, j, tension2);
            if (kind & HELD)
                add_holds(g, k, &p);
            if (!(p.den > 0))
                continue;
            double z = g->z[k] + OVERSHOOT * ((kind == (ACTIVE | INNER) ? p.num * inverse : p.num / p.den) - g->z[k]);
            z = z < g->bound[2 * k] ? g->bound[2 * k] : z;
            g->z[k] = z > g->bound[2 * k + 1] ? g->bound[2 * k + 1] : z;
        }
}

/* ---- from coarse to fine ---------------------------------------------------------------- */

/* H, on the edge from FROM to TO of an edge twice as long: (from, to) = (0, 1/2) or (1/2, 1). */
static bool add_half(il_plate_grid *g, size_t node, int axis, const il_plate_hold *h, double from)
{
    il_plate_hold *to = hold_of(g, node, axis);
    if (!to)
        return false;
    to->n += h->n;
    to->t += from * h->n + h->t / 2;
    to->tt += from * from * h->n + from * h->t + h->tt / 4;
    to->z += h->z;
    to->tz += from * h->z + h->tz / 2;
    return true;
}

/* Every second node of FINE. */
static bool coarsen(const il_plate_grid *fine, il_plate_grid *g)
{
    const size_t n[2] = { (fine->n[0] - 1) / 2 + 1, (fine->n[1] - 1) / 2 + 1 };
    if (!il_plate_grid_make(g, n))
        return false;
    for (size_t j = 0; j < n[1]; j++)
        for (size_t i = 0; i < n[0]; i++) {
            size_t node = i + n[0] * j, from = 2 * i + fine->n[0] * 2 * j;
            memcpy(g->bound + 2 * node, fine->bound + 2 * from, 2 * sizeof *g->bound);
            for (int axis = 0; axis < 2; axis++) {
                if ((axis == 0 ? i : j) + 1 >= n[axis])
                    continue;
                uint32_t first = fine->held[2 * from + (size_t)axis];
                uint32_t second = fine->held[2 * (from + (axis ? fine->n[0] : 1)) + (size_t)axis];
                if ((first && !add_half(g, node, axis, &fine->hold[first - 1], 0)) ||
                    (second && !add_half(g, node, axis, &fine->hold[second - 1], 0.5)))
                    return false;
            }
        }
    return true;
}

/* The height between the nodes of G at half (I, J); beyond the last ones along the slope there; NAN
 * where none takes part. */
static double between(const il_plate_grid *g, size_t i, size_t j)
{
    size_t x[2] = { i / 2, (i + 1) / 2 }, y[2] = { j / 2, (j + 1) / 2 };
    double sum = 0, n = 0, beyond[2] = { x[1] < g->n[0] ? 0 : 0.5, y[1] < g->n[1] ? 0 : 0.5 };
    for (size_t m = 0; m < 4; m++)
        if (is_active(g, x[m % 2], y[m / 2])) {
            sum += g->z[x[m % 2] + g->n[0] * y[m / 2]];
            n++;
        }
    double z = n > 0 ? sum / n : NAN;
    const double *at = g->z + x[0] + g->n[0] * y[0];
    if (beyond[0] > 0 && x[0] > 0 && is_active(g, x[0] - 1, y[0]))
        z += beyond[0] * (at[0] - at[-1]);
    if (beyond[1] > 0 && y[0] > 0 && is_active(g, x[0], y[0] - 1))
        z += beyond[1] * (at[0] - at[-(ptrdiff_t)g->n[0]]);
    return z;
}

/* Start FINE between the nodes of G. */
static void refine(const il_plate_grid *g, il_plate_grid *fine)
{
    for (size_t j = 0; j < fine->n[1]; j++)
        for (size_t i = 0; i < fine->n[0]; i++) {
            size_t k = i + fine->n[0] * j;
            double z = fine->kind[k] & ACTIVE ? between(g, i, j) : NAN;
            if (!isnan(z))
                fine->z[k] = fmin(fmax(z, fine->bound[2 * k]), fine->bound[2 * k + 1]);
        }
}

/* Half way between the bounds, and outside as at the last node that had some. */
static void begin(il_plate_grid *g)
{
    double last = 0;
    for (int round = 0; round < 2; round++) /* twice, for those before the first */
        for (size_t k = 0; k < g->n[0] * g->n[1]; k++) {
            last = isinf(g->bound[2 * k]) ? last : (g->bound[2 * k] + g->bound[2 * k + 1]) / 2;
            g->z[k] = last;
        }
}

static bool solve(il_plate_grid *g, double tension, int sweeps)
{
    bool is_coarsest = g->n[0] <= COARSEST || g->n[1] <= COARSEST, ok = true;
    begin(g);
    find_kinds(g);
    if (!is_coarsest) {
        il_plate_grid coarse = IL_PLATE_GRID_INIT;
        ok = coarsen(g, &coarse) && solve(&coarse, 2 * tension, 2 * sweeps < SWEEPS_MOST ? 2 * sweeps : SWEEPS_MOST);
        if (ok)
            refine(&coarse, g);
        il_plate_grid_free(&coarse);
    }
    for (int k = 0; ok && k < (is_coarsest ? SWEEPS_MOST : sweeps); k++)
        sweep(g, tension * tension);
    return ok;
}

bool il_plate_grid_solve(il_plate_grid *g, double tension)
{
    bool ok = solve(g, tension, SWEEPS);
    for (size_t k = 0; k < g->n[0] * g->n[1]; k++)
        g->z[k] = g->kind[k] & ACTIVE ? g->z[k] : NAN;
    return ok;
}
