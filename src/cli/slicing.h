/* slicing.h - where the slices of the input lie, and where nothing joins them.
 *
 * Slices that isoloft put there, to thicken another, pass by as well; they are
 * told apart here, so that spacing and gaps are those of the input. */
#ifndef IL_CLI_SLICING_H
#define IL_CLI_SLICING_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* z[n]: heights of the input's slices.  gap_below[n]: a gap record stands between
 * that slice and the one before.  last_counts: the last slice that passed is
 * z[n - 1]; pending: a gap record came behind one that does not count. */
typedef struct il_slicing {
    double *z;          size_t n, cap_z;
    bool *gap_below;    size_t cap_gap_below;
    bool last_counts, pending;
} il_slicing;

#define IL_SLICING_INIT { NULL, 0, 0, NULL, 0, false, false }

/* A slice at Z passes; COUNTS: it is one of the input.  IL_E_NOMEM. */
il_status il_slicing_slice(il_slicing *h, double z, bool counts, il_error *err);

/* A gap record passes, right behind the upper one of its slices. */
void il_slicing_gap(il_slicing *h);

void il_slicing_clear(il_slicing *h);   /* for another stack */
void il_slicing_free(il_slicing *h);    /* safe twice */

#endif
