/* frame.h - the raster over one group of rings: from the stack's unit to cells and back. */
#ifndef IL_MATCH_FRAME_H
#define IL_MATCH_FRAME_H

#include "match/ffd.h"
#include "model/stack.h"

/* Cell (0, 0) begins `margin` cells before (x, y), the least coordinates of the
 * group; a cell is a power of two of the stack's unit, so that contours moved by
 * a vector or scaled by a power of two come to lie on the raster as they did. */
typedef struct il_frame {
    double x, y, cell, margin;
    uint32_t cells_x, cells_y;
} il_frame;

/* The finest frame of at most 256 cells a side that leaves 15 % of the longer side
 * as margin all round the rings of group G: with less, shapes that touch the
 * frame cannot be moved freely there (2.4 cells off instead of 0.3). */
il_frame il_frame_about(const il_group *g, const il_slice *lower, const il_slice *upper);

/* BOX (least x and y, greatest x and y) so as to hold the points xy[2*N] too; and the rings
 * ring[N] of S. */
void il_frame_extend(double box[4], const double *xy, size_t n);
void il_frame_extend_rings(double box[4], const il_slice *s, const uint32_t *ring, size_t n);

/* Likewise of what lies in BOX. */
il_frame il_frame_over(const double box[4]);

/* Is F so near to the bound of coordinates that images, or the shift of a global
 * step, can lie beyond?  That shift is x - A x with factors up to 64 in A (global.h),
 * and some room.  Slices are then taken as they lie. */
bool il_frame_is_far(const il_frame *f);

/* The rings ring[n_rings] of a slice in cells: xy[2*n] and next[n], the caller's
 * to il_free, after IL_E_NOMEM too. */
il_status il_frame_outline(const il_frame *f, const il_slice *s, const uint32_t *ring, size_t n_rings,
                           double **xy, uint32_t **next, size_t *n, il_error *err);

/* The residuals of a fit that is in the stack's unit otherwise, and its box: the frame's. */
void il_frame_scale_found(const il_frame *f, il_fit *fit);

/* A fit in cells becomes one in the stack's unit, with the frame as its box; box and
 * residuals stop short of the bound of coordinates. */
void il_frame_scale_fit(const il_frame *f, il_fit *fit);

static inline void il_frame_to_cells(const il_frame *f, const double p[2], double out[2])
{
    out[0] = (p[0] - f->x) / f->cell + f->margin;
    out[1] = (p[1] - f->y) / f->cell + f->margin;
}

#endif
