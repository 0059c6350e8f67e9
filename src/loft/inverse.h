/* inverse.h - from the reference plane back to the upper slice, away from its rings.
 *
 * The inverse of phi is known where the upper rings were put; between them and
 * the corners of a box round all it is linear on the triangles of a constrained
 * Delaunay triangulation (formats/loft.txt, section 8.3). */
#ifndef IL_LOFT_INVERSE_H
#define IL_LOFT_INVERSE_H

#include "loft/overlay.h"

/* xy[2*n] in grid units of the overlay, shift[2*n]: what takes each back to the
 * upper slice, unit.  Triangles as in bridge/triangulation.h; last: where the
 * last search ended, which depends on the calls so far alone. */
typedef struct il_inverse {
    double *xy, *shift;
    size_t n;
    uint32_t *corner, *across;
    size_t n_triangles;
    uint32_t last;
} il_inverse;

/* From the upper side as snapped in O. */
il_status il_inverse_build(il_inverse *v, const il_overlay *o, il_error *err);
void il_inverse_free(il_inverse *v);

/* What takes the reference point GRID, in grid units, back to the upper slice. */
void il_inverse_shift(il_inverse *v, const double grid[2], double out[2]);

#endif
