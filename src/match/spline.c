#include "config.h"
#include "match/spline.h"
#include "base/simd.h"

#include <math.h>

il_spline il_spline_over(uint32_t cells_x, uint32_t cells_y, float spacing)
{
    il_spline s;
    s.spacing = spacing;
    s.nx = (uint32_t)ceilf((float)cells_x / spacing) + 4;
    s.ny = (uint32_t)ceilf((float)cells_y / spacing) + 4;
    s.size = (2 * (size_t)s.nx * s.ny + IL_LANES - 1) / IL_LANES * IL_LANES;
    s.margin = (2 * (size_t)s.nx + IL_LANES - 1) / IL_LANES * IL_LANES + IL_LANES;
    return s;
}

/* Cell and place in it of coordinate AT, of a direction with N nodes. */
static inline uint32_t locate(float at, uint32_t n, float *u)
{
    float last = (float)(n - 4);
    at = at > 0 ? at : 0;
    at = at < last ? at : last;
    uint32_t i = (uint32_t)at;
    *u = at - (float)i;
    return i;
}

static inline void weights(float u, float b[4])
{
    float v = 1 - u, uu = u * u, vv = v * v;
    b[0] = vv * v * (1.0f / 6);
    b[1] = (3 * uu * u - 6 * uu + 4) * (1.0f / 6);
    b[2] = (3 * vv * v - 6 * vv + 4) * (1.0f / 6);
    b[3] = uu * u * (1.0f / 6);
}

/* The derivatives of the weights by u. */
static inline void slopes(float u, float b[4])
{
    float v = 1 - u;
    b[0] = -0.5f * v * v;
    b[1] = (1.5f * u - 2) * u;
    b[2] = (2 - 1.5f * v) * v;
    b[3] = 0.5f * u * u;
}

void il_spline_stencils(const il_spline *s, const float *x, const float *y, size_t n, il_stencil *out)
{
    float inverse = 1 / s->spacing;
    for (size_t k = 0; k < n; k++) {
        float u, v, b[4];
        uint32_t i = locate(x[k] * inverse, s->nx, &u), j = locate(y[k] * inverse, s->ny, &v);
        out[k].at = 2 * (j * s->nx + i);
        weights(u, b);
        for (int m = 0; m < 4; m++)
            out[k].bx[2 * m] = out[k].bx[2 * m + 1] = b[m];
        weights(v, out[k].by);
    }
}

/* The four rows of a stencil, weighted along y. */
IL_LANEWISE il_f8 rows(const float *c, size_t stride, const float *by)
{
    return (by[0] * il_f8_load(c) + by[1] * il_f8_load(c + stride)) +
           (by[2] * il_f8_load(c + 2 * stride) + by[3] * il_f8_load(c + 3 * stride));
}

IL_LANEWISE float even_sum(il_f8 v)
{
    return (v[0] + v[4]) + (v[2] + v[6]);
}

IL_LANEWISE float odd_sum(il_f8 v)
{
    return (v[1] + v[5]) + (v[3] + v[7]);
}

IL_CLONES
void il_spline_eval(const il_spline *s, const float *c, const il_stencil *at, size_t n, float *dx, float *dy)
{
    size_t stride = 2 * (size_t)s->nx;
    for (size_t k = 0; k < n; k++) {
        il_f8 v = rows(c + at[k].at, stride, at[k].by) * il_f8_load(at[k].bx);
        dx[k] = even_sum(v);
        dy[k] = odd_sum(v);
    }
}

IL_CLONES
void il_spline_scatter(const il_spline *s, float *c, const il_stencil *at, size_t n, const float *vx, const float *vy)
{
    size_t stride = 2 * (size_t)s->nx;
    for (size_t k = 0; k < n; k++) {
        il_f8 v = { vx[k], vy[k], vx[k], vy[k], vx[k], vy[k], vx[k], vy[k] };
        v *= il_f8_load(at[k].bx);
        for (size_t r = 0; r < 4; r++) {
            float *row = c + at[k].at + r * stride;
            il_f8_store(row, il_f8_load(row) + at[k].by[r] * v);
        }
    }
}

IL_CLONES
void il_spline_scatter_squares(const il_spline *s, float *c, const il_stencil *at, size_t n, const float *vx, const float *vy)
{
    size_t stride = 2 * (size_t)s->nx;
    for (size_t k = 0; k < n; k++) {
        il_f8 v = { vx[k], vy[k], vx[k], vy[k], vx[k], vy[k], vx[k], vy[k] }, b = il_f8_load(at[k].bx);
        v *= b * b;
        for (size_t r = 0; r < 4; r++) {
            float *row = c + at[k].at + r * stride, w = at[k].by[r];
            il_f8_store(row, il_f8_load(row) + w * w * v);
        }
    }
}

/* What il_spline_roughness adds as if rows followed each other without end is
 * taken back at the lattice's sides, and behind its last node. */
static void open_sides(const il_spline *s, const float *c, float factor, float *out)
{
    size_t row = 2 * (size_t)s->nx, last = row * (s->ny - 1);
    for (size_t k = 0; k < row; k++) {
        out[k] -= factor * c[k]; /* the margin before is zero */
        out[last + k] -= factor * c[last + k];
    }
    for (size_t j = 0; j < s->ny; j++)
        for (size_t k = 0; k < 2; k++) {
            size_t left = j * row + k, right = left + row - 2;
            out[left] -= factor * (c[left] - *(c + left - 2));
            out[right] -= factor * (c[right] - *(c + right + 2));
        }
    for (size_t k = row * s->ny; k < s->size; k++)
        out[k] = 0;
}

IL_CLONES
void il_spline_roughness(const il_spline *s, const float *c, float factor, float *out)
{
    size_t row = 2 * (size_t)s->nx;
    for (size_t k = 0; k < s->size; k += IL_LANES) {
        il_f8 here = il_f8_load(c + k);
        il_f8 sides = il_f8_load(c + k - 2) + il_f8_load(c + k + 2);
        il_f8 rows = il_f8_load(c + k - row) + il_f8_load(c + k + row);
        il_f8_store(out + k, il_f8_load(out + k) + factor * (4 * here - sides - rows));
    }
    open_sides(s, c, factor, out);
}

IL_CLONES
void il_spline_move(const il_spline *s, const float *c, float *x, float *y, float *jacobian, size_t n)
{
    float inverse = 1 / s->spacing;
    size_t stride = 2 * (size_t)s->nx;
    for (size_t k = 0; k < n; k++) {
        float u, v, bx[4], by[4], sx[4], sy[4];
        uint32_t i = locate(x[k] * inverse, s->nx, &u), j = locate(y[k] * inverse, s->ny, &v);
        const float *at = c + 2 * ((size_t)j * s->nx + i);
        weights(u, bx);
        weights(v, by);
        slopes(u, sx);
        slopes(v, sy);
        il_f8 wx = { bx[0], bx[0], bx[1], bx[1], bx[2], bx[2], bx[3], bx[3] };
        il_f8 gx = { sx[0], sx[0], sx[1], sx[1], sx[2], sx[2], sx[3], sx[3] };
        il_f8 along = rows(at, stride, by), across = rows(at, stride, sy);
        il_f8 d = along * wx, by_x = along * gx, by_y = across * wx;
        float xx = even_sum(by_x) * inverse, yx = odd_sum(by_x) * inverse;
        float xy = even_sum(by_y) * inverse, yy = odd_sum(by_y) * inverse;
        x[k] += even_sum(d);
        y[k] += odd_sum(d);
        jacobian[k] *= (1 + xx) * (1 + yy) - xy * yx;
    }
}
