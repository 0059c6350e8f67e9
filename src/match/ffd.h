/* ffd.h - a deformation of the plane that takes one slice's rings to another's.
 *
 * The incremental free-form deformation of the paper's section 3.3 (Huang,
 * Paragios & Metaxas 2006): see ffd.c for the method and what was changed. */
#ifndef IL_MATCH_FFD_H
#define IL_MATCH_FFD_H

#include "base/status.h"
#include "match/distance.h"
#include "model/pair.h"

/* Rings to match, in cells of the raster: vertices xy[2*n], vertex i joined to
 * next[i]; the region is on the left. */
typedef struct il_outline {
    const double *xy;
    const uint32_t *next;
    size_t n;
} il_outline;

/* What the solver keeps from pair to pair: its memory. */
typedef struct il_ffd il_ffd;
il_status il_ffd_new(il_ffd **out, il_error *err);
void il_ffd_free(il_ffd *f); /* null is fine */

/* How far apart points of two such outlines should be, in cells: 1.5, as denser
 * ones fit no better; more where there would be over 2^15 of them (the teeth of a
 * comb, crossing tile by tile, would cost the square of their number). */
double il_ffd_spacing(const il_outline *lower, const il_outline *upper);

/* Find phi, which takes UPPER to LOWER, both inside [0, cells_x] x [0, cells_y]
 * with the margin that il_frame leaves.  *FIT (empty before; il_fit_free) gets
 * the residuals, the least Jacobian, the distortion, the global step and the
 * lattices, all in cells.  TURNS: starts from a turn are tried too.  Same bits on every processor.  The only failure is
 * want of memory: how good phi is, the figures tell. */
il_status il_ffd_solve(il_ffd *f, const il_outline *lower, const il_outline *upper,
                       uint32_t cells_x, uint32_t cells_y, bool turns, il_fit *fit, il_error *err);

/* As if LOWER had been solved for: its map, for il_ffd_foot and il_ffd_maps.  IL_E_NOMEM. */
il_status il_ffd_show(il_ffd *f, const il_outline *lower, uint32_t cells_x, uint32_t cells_y, il_error *err);

/* After il_ffd_solve: the point of the lower contours nearest to (x, y), cells. */
il_foot il_ffd_foot(il_ffd *f, double x, double y);

/* The map of the lower contours, and in *SPARE one for the caller's use, so that
 * its memory is kept too.  Both stay F's. */
il_distance *il_ffd_maps(il_ffd *f, il_distance **spare);

#endif
