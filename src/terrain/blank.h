/* blank.h - parts of the frame in which no line tells how high the ground is. */
#ifndef IL_TERRAIN_BLANK_H
#define IL_TERRAIN_BLANK_H

#include "terrain/tin.h"

/* Faces of T that have neither a line nor a band: an island of the user's outline without
 * isolines.  They become ground outside the frame; xy[2*n]: a place in each, the caller's, in the
 * coordinates of C.  IL_E_SURFACE where lines that run together are all that a face has:
 * they tell no band; IL_E_NOMEM. */
il_status il_blank_leave_out(il_tin *t, const il_chart *c, il_band *band, double **xy, size_t *n, il_error *err);

#endif
