/* equations.c - the sampled energy and one step down it.
 *
 * Eq. (4) compares the two distance maps over all pixels.  Only Phi_u = 0 matters
 * to us, so it becomes a sum over samples p of the moving contour,
 *
 *     E_forward = mean of Phi_l(p + d(p))^2,
 *
 * and to it comes its mirror image, over samples q of the target with outward
 * normal n and the nearest moving sample p(q) whose normal agrees,
 *
 *     E_backward = mean of (n . (p(q) + d(p(q)) - q))^2;
 *
 * without it what the moving contour does not reach (a finger, a bay) goes
 * unseen.  The smoothness term, eq. (5), is taken of the increment alone, as
 * differences between neighbouring control points (P-splines).  Both terms are
 * squares of functions that are linear in d up to second order: Gauss-Newton.
 * Each sample's share of the normal matrix is one 2x2 block between the B-spline
 * weights, so the matrix is never put together. */
#include "config.h"
#include "match/equations.h"
#include "base/alloc.h"
#include "base/simd.h"

#include <math.h>
#include <string.h>

/* Weight of the smoothness of the increment against the mean squared distance;
 * 5e-5 to 5e-3 fit alike, less smoothness costs regularity, more costs time. */
static const float LAMBDA = 2e-4f;

/* A little pull against moving at all where the distance map says nothing,
 * along the contour: 0.02 to 0.1 do not hurt the fit. */
static const float ISOTROPIC = 0.02f;

/* A step is bounded anyway, so it need not be solved well. */
static const float TOLERANCE = 0.15f;
enum { MOST_ITERATIONS = 5 };

enum { STEP, RESIDUAL, DIRECTION, PRODUCT, DIAGONAL };

void il_equations_free(il_equations *e)
{
    float **row[10] = { &e->phi, &e->gx, &e->gy, &e->xx, &e->xy, &e->yy, &e->vx, &e->vy, &e->dx, &e->dy };
    for (int k = 0; k < 10; k++)
        il_free(*row[k]);
    for (int k = 0; k < 5; k++)
        il_free(e->field[k]);
    il_free(e->stencil);
    il_free(e->partner);
    *e = (il_equations)IL_EQUATIONS_INIT;
}

il_status il_equations_reserve(il_equations *e, size_t n, size_t n_target, const il_spline *s, il_error *err)
{
    float **row[10] = { &e->phi, &e->gx, &e->gy, &e->xx, &e->xy, &e->yy, &e->vx, &e->vy, &e->dx, &e->dy };
    bool ok = il_grow(&e->stencil, &e->cap[10], n, sizeof *e->stencil) &&
              il_grow(&e->partner, &e->cap_partner, n_target, sizeof *e->partner);
    for (int k = 0; ok && k < 10; k++)
        ok = il_grow(row[k], &e->cap[k], n, sizeof **row[k]);
    for (int k = 0; ok && k < 5; k++) {
        ok = il_grow(&e->field[k], &e->cap_field[k], il_spline_room(s), sizeof **e->field);
        if (ok)
            memset(e->field[k], 0, il_spline_room(s) * sizeof **e->field);
    }
    return ok ? IL_OK : il_fail_nomem(err);
}

/* ---- the blocks ---- */

static void add_forward(il_equations *e, il_misfit *m)
{
    float w = 1 / (float)e->n, sum = 0, most = 0;
    for (size_t k = 0; k < e->n; k++) {
        float r = e->phi[k], gx = e->gx[k], gy = e->gy[k];
        e->xx[k] = w * (gx * gx + ISOTROPIC);
        e->xy[k] = w * gx * gy;
        e->yy[k] = w * (gy * gy + ISOTROPIC);
        e->vx[k] = -w * r * gx;
        e->vy[k] = -w * r * gy;
        sum += r * r;
        most = fabsf(r) > most ? fabsf(r) : most;
    }
    m->forward_rms = sqrtf(sum * w);
    m->forward_max = most;
}

static void add_backward(il_equations *e, const il_samples *moved, const il_samples *target, il_misfit *m)
{
    float w = 1 / (float)target->n, sum = 0, most = 0;
    for (uint32_t q = 0; q < target->n; q++) {
        uint32_t p = e->partner[q];
        if (p == IL_NO_PARTNER) {
            most = INFINITY;
            continue;
        }
        float nx = target->nx[q], ny = target->ny[q];
        float r = nx * (moved->x[p] - target->x[q]) + ny * (moved->y[p] - target->y[q]);
        e->xx[p] += w * nx * nx;
        e->xy[p] += w * nx * ny;
        e->yy[p] += w * ny * ny;
        e->vx[p] -= w * r * nx;
        e->vy[p] -= w * r * ny;
        sum += r * r;
        most = fabsf(r) > most ? fabsf(r) : most;
    }
    m->backward_rms = sqrtf(sum * w);
    m->backward_max = most;
}

il_misfit il_equations_fill(il_equations *e, const il_samples *moved, const il_samples *target, il_distance *map, bool anew)
{
    il_misfit m = { 0, 0, 0, 0 };
    e->n = moved->n;
    il_distance_sample(map, moved->x, moved->y, moved->n, e->phi, e->gx, e->gy);
    il_partners_find(moved, target, anew, e->partner);
    add_forward(e, &m);
    add_backward(e, moved, target, &m);
    return m;
}

/* ---- preconditioned conjugate gradients ---- */

/* OUT = A C.  OUT and C start behind their margins. */
static void apply(il_equations *e, const il_spline *s, const float *c, float *out)
{
    memset(out, 0, s->size * sizeof *out);
    il_spline_eval(s, c, e->stencil, e->n, e->dx, e->dy);
    for (size_t k = 0; k < e->n; k++) {
        float dx = e->dx[k], dy = e->dy[k];
        e->dx[k] = e->xx[k] * dx + e->xy[k] * dy;
        e->dy[k] = e->xy[k] * dx + e->yy[k] * dy;
    }
    il_spline_scatter(s, out, e->stencil, e->n, e->dx, e->dy);
    il_spline_roughness(s, c, LAMBDA, out);
}

/* The inverse of the matrix's diagonal. */
static void precondition(il_equations *e, const il_spline *s, float *inverse)
{
    memset(inverse, 0, s->size * sizeof *inverse);
    il_spline_scatter_squares(s, inverse, e->stencil, e->n, e->xx, e->yy);
    for (size_t k = 0; k < s->size; k++)
        inverse[k] = 1 / (inverse[k] + 4 * LAMBDA);
}

IL_CLONES
static float dot(const float *a, const float *b, size_t n)
{
    il_f8 sum = il_f8_all(0);
    for (size_t k = 0; k < n; k += IL_LANES)
        sum += il_f8_load(a + k) * il_f8_load(b + k);
    return il_f8_sum(sum);
}

/* sum of m r^2. */
IL_CLONES
static float weighted_square(const float *r, const float *m, size_t n)
{
    il_f8 sum = il_f8_all(0);
    for (size_t k = 0; k < n; k += IL_LANES) {
        il_f8 v = il_f8_load(r + k);
        sum += v * v * il_f8_load(m + k);
    }
    return il_f8_sum(sum);
}

/* d = m r + beta d. */
IL_CLONES
static void turn(float *d, const float *r, const float *m, float beta, size_t n)
{
    for (size_t k = 0; k < n; k += IL_LANES)
        il_f8_store(d + k, il_f8_load(m + k) * il_f8_load(r + k) + beta * il_f8_load(d + k));
}

/* a = a + factor b. */
IL_CLONES
static void add_scaled(float *a, float factor, const float *b, size_t n)
{
    for (size_t k = 0; k < n; k += IL_LANES)
        il_f8_store(a + k, il_f8_load(a + k) + factor * il_f8_load(b + k));
}

void il_equations_solve(il_equations *e, const il_samples *moved, const il_spline *s)
{
    float *c = e->field[STEP] + s->margin, *r = e->field[RESIDUAL] + s->margin, *d = e->field[DIRECTION] + s->margin;
    float *a = e->field[PRODUCT] + s->margin, *m = e->field[DIAGONAL] + s->margin;
    il_spline_stencils(s, moved->x, moved->y, moved->n, e->stencil);
    precondition(e, s, m);
    memset(c, 0, s->size * sizeof *c);
    memset(r, 0, s->size * sizeof *r);
    memset(d, 0, s->size * sizeof *d);
    il_spline_scatter(s, r, e->stencil, e->n, e->vx, e->vy);
    float rho = weighted_square(r, m, s->size), goal = TOLERANCE * TOLERANCE * rho, beta = 0;
    for (int i = 0; i < MOST_ITERATIONS && rho > goal; i++) {
        turn(d, r, m, beta, s->size);
        apply(e, s, d, a);
        float alpha = rho / dot(d, a, s->size);
        add_scaled(c, alpha, d, s->size);
        add_scaled(r, -alpha, a, s->size);
        float after = weighted_square(r, m, s->size);
        beta = after / rho;
        rho = after;
    }
}
