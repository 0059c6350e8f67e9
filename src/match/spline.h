/* spline.h - a cubic B-spline lattice in single precision: the solver's kernels.
 *
 * The same deformation as model/lattice.h, which is for whoever draws or applies
 * a finished one; here for hundreds of points at a time, many times over. */
#ifndef IL_MATCH_SPLINE_H
#define IL_MATCH_SPLINE_H

#include <stddef.h>
#include <stdint.h>

/* nx by ny nodes, `spacing` cells apart; node (0, 0) at (-spacing, -spacing), so
 * that all of [0, cells] has its four nodes each way.  A field over the lattice
 * is `size` floats, x and y of a node side by side, node (i, j) at 2 * (j * nx + i),
 * between `margin` floats of zeros before and behind. */
typedef struct il_spline {
    float spacing;
    uint32_t nx, ny;
    size_t size, margin;
} il_spline;

/* The lattice of the given spacing over a raster of cells. */
il_spline il_spline_over(uint32_t cells_x, uint32_t cells_y, float spacing);

/* Floats that a field needs with its margins; it starts at + margin. */
static inline size_t il_spline_room(const il_spline *s)
{
    return s->size + 2 * s->margin;
}

/* Where a point falls: its first node's offset in a field, and its weights, those
 * along x doubled up for x and y (paper, eq. 2).  Points outside of [0, cells]
 * are taken at the nearest place of its border. */
typedef struct il_stencil {
    float bx[8];
    float by[4];
    uint32_t at;
} il_stencil;

void il_spline_stencils(const il_spline *s, const float *x, const float *y, size_t n, il_stencil *out);

/* (dx, dy)[k]: the field C at stencil k (paper, eq. 3, without the x). */
void il_spline_eval(const il_spline *s, const float *c, const il_stencil *at, size_t n, float *dx, float *dy);

/* Its transpose: C += sum over k of B_k' (vx[k], vy[k]). */
void il_spline_scatter(const il_spline *s, float *c, const il_stencil *at, size_t n, const float *vx, const float *vy);

/* As il_spline_scatter with the weights squared. */
void il_spline_scatter_squares(const il_spline *s, float *c, const il_stencil *at, size_t n, const float *vx, const float *vy);

/* OUT += FACTOR times L C: at every node the sum of its differences from the up
 * to four neighbours, the gradient of eq. (5) on the increments (Eilers & Marx
 * 1996); positive semidefinite, with a free border. */
void il_spline_roughness(const il_spline *s, const float *c, float factor, float *out);

/* Take points N points (x, y) one step along the field C, and multiply jacobian[k]
 * by the determinant of the step's derivative there. */
void il_spline_move(const il_spline *s, const float *c, float *x, float *y, float *jacobian, size_t n);

#endif
