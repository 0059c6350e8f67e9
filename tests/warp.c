#include "config.h"
#include "warp.h"
#include "base/alloc.h"

#include <math.h>
#include <stdlib.h>

static void must(bool ok)
{
    if (!ok)
        abort();
}

void warp_affine(const double p[2], const double *a, double out[2])
{
    out[0] = a[0] * p[0] + a[1] * p[1] + a[4];
    out[1] = a[2] * p[0] + a[3] * p[1] + a[5];
}

void warp_wavy(const double p[2], const double *a, double out[2])
{
    out[0] = p[0] + a[0] + a[2] * sin(a[3] * p[1]);
    out[1] = p[1] + a[1] + a[2] * sin(a[3] * p[0]);
}

static void add_rows(il_pair *p, const il_slice *upper, const warp *w)
{
    for (uint32_t r = 0; r < upper->n; r++)
        for (uint32_t v = 0; v < upper->ring[r].n; v++)
            for (size_t k = 0; k <= w->bends; k++) {
                const il_ring *ring = &upper->ring[r];
                const double *a = ring->xy + 2 * v, *b = ring->xy + 2 * ((v + 1) % ring->n);
                double t = (double)k / (double)(w->bends + 1), at[2] = { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]) }, to[2];
                w->map(at, w->a, to);
                must(il_grow(&p->phi, &p->cap_phi, p->n_phi + 1, sizeof *p->phi));
                p->phi[p->n_phi++] = (il_phi_point){ { r, v, t }, to[0], to[1] };
            }
}

static void widen(double box[4], double x, double y)
{
    box[0] = fmin(box[0], x), box[1] = fmin(box[1], y);
    box[2] = fmax(box[2], x), box[3] = fmax(box[3], y);
}

static void fill_fit(il_fit *f, const il_pair *p, const il_slice *lower, const warp *w)
{
    f->box[0] = f->box[1] = INFINITY;
    f->box[2] = f->box[3] = -INFINITY;
    for (size_t r = 0; r < lower->n; r++)
        for (size_t k = 0; k < lower->ring[r].n; k++)
            widen(f->box, lower->ring[r].xy[2 * k], lower->ring[r].xy[2 * k + 1]);
    for (size_t i = 0; i < p->n_phi; i++)
        widen(f->box, p->phi[i].x, p->phi[i].y);
    double margin = .2 * fmax(f->box[2] - f->box[0], f->box[3] - f->box[1]) + 1e-9;
    for (int k = 0; k < 4; k++)
        f->box[k] += k < 2 ? -margin : margin;
    f->global[0] = f->global[3] = 1;
    for (int k = 0; k < 6 && w->map == warp_affine; k++)
        f->global[k] = w->a[k];
    for (int k = 0; k < 2 && w->map == warp_wavy; k++)
        f->global[4 + k] = w->a[k];
    f->least_jacobian = f->global[0] * f->global[3] - f->global[1] * f->global[2]; /* to be trusted */
}

static il_group *add_group(il_pair *p)
{
    must(il_grow(&p->group, &p->cap_groups, p->n_groups + 1, sizeof *p->group));
    p->group[p->n_groups] = (il_group){ 0 };
    return &p->group[p->n_groups++];
}

static void add_ring(uint32_t **ring, size_t *n, size_t *cap, uint32_t r)
{
    must(il_grow(ring, cap, *n + 1, sizeof **ring));
    (*ring)[(*n)++] = r;
}

il_pair warp_pair(const il_slice *lower, const il_slice *upper, const warp *w)
{
    il_pair p = IL_PAIR_INIT;
    p.matcher = IL_MATCHER_FFD;
    add_rows(&p, upper, w);
    il_group *g = add_group(&p);
    for (uint32_t r = 0; r < lower->n; r++)
        add_ring(&g->lower, &g->n_lower, &g->cap_lower, r);
    for (uint32_t r = 0; r < upper->n; r++)
        add_ring(&g->upper, &g->n_upper, &g->cap_upper, r);
    g->fitted = true;
    fill_fit(&g->fit, &p, lower, w);
    return p;
}

void warp_match_arcs(il_pair *p, il_arc lower, il_arc upper)
{
    must(il_grow(&p->match, &p->cap_matches, p->n_matches + 1, sizeof *p->match));
    p->match[p->n_matches++] = (il_match){ .lower = lower, .upper = upper };
}

void warp_match_rings(il_pair *p, uint32_t r, uint32_t v, uint32_t u, uint32_t k)
{
    il_place low = { r, v, 0 }, high = { u, k, 0 };
    warp_match_arcs(p, (il_arc){ low, low }, (il_arc){ high, high });
}

void warp_regroup(il_pair *p, const uint32_t *lower, size_t n_lower, const uint32_t *upper, size_t n_upper, size_t n_groups)
{
    p->group[0].n_lower = p->group[0].n_upper = 0;
    while (p->n_groups < n_groups) {
        il_group *g = add_group(p);
        g->fitted = true;
        g->fit = p->group[0].fit;
    }
    for (uint32_t r = 0; r < n_lower; r++) {
        il_group *g = &p->group[lower[r]];
        add_ring(&g->lower, &g->n_lower, &g->cap_lower, r);
    }
    for (uint32_t r = 0; r < n_upper; r++) {
        il_group *g = &p->group[upper[r]];
        add_ring(&g->upper, &g->n_upper, &g->cap_upper, r);
    }
}
