/* snap.h - the reference plane on a grid: after this all predicates are exact.
 *
 * Iterated snap rounding (Halperin & Packer 2002, doi:10.1016/S0925-7721(01)00064-5):
 * vertices go to a power-of-two grid, those of the upper side to points of the
 * lower side's that are less than a cell away; an edge within IL_SNAP_REACH of a
 * vertex is led through it; crossings become vertices; until nothing changes.  Near-
 * coincident contours then coincide exactly, and no later step can cross them. */
#ifndef IL_LOFT_SNAP_H
#define IL_LOFT_SNAP_H

#include "loft/reference.h"

/* Grid units within which an edge is led through a vertex: a little more than
 * half the diagonal of a cell (0.7072), so that rounding a crossing, which
 * moves it by at most that, cannot carry an edge across a vertex. */
#define IL_SNAP_REACH 0.72

/* Grid points x[n], y[n] (integers, at most 2^53 from 0) in units of `cell`
 * from `origin`.  run[side][i] .. run[side][i + 1] is the part of point[side]
 * that edge i of the reference side passes: its start and what lies between,
 * without its end. */
/* fold[2*n_folds]: edges of the deformed upper side that cross or touch where the
 * slice does not, by their reference vertices; not all of them. */
typedef struct il_snapped {
    double cell, origin[2];
    int64_t *x, *y;          size_t n, cap_x, cap_y;
    uint32_t *run[2];
    uint32_t *point[2];
    size_t n_points[2];
    uint32_t *fold;          size_t n_folds, cap_folds;
} il_snapped;

/* Snap R to cells of 2^EXPONENT.  *INJECTIVE tells whether no grid point is
 * visited twice by one side, but where its slice touches itself (loft.md I1);
 * also false when the rounds do not settle: then the caller tries a finer grid. */
il_status il_snap(il_snapped *out, const il_reference *r, int exponent, bool *injective, il_error *err);
void il_snapped_free(il_snapped *s);

/* Grid point I back in reference coordinates. */
void il_snapped_point(const il_snapped *s, size_t i, double out[2]);

/* The exponent with which to begin: cells of about 1e-7 of the size of R, and
 * with ROUND_FLOAT not below 8 ulp of a 32-bit float at its largest coordinate,
 * so that rounding cannot carry one inserted point past another. */
int il_snap_first_exponent(const il_reference *r, bool round_float);
/* The finest that 53 bits hold for R. */
int il_snap_last_exponent(const il_reference *r);

#endif
