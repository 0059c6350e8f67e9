/* spacing.h - how far apart the slices of a stack lie, and where that is far. */
#ifndef IL_MODEL_SPACING_H
#define IL_MODEL_SPACING_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* Of the distances of neighbouring slices, in the stack's unit: the least, the
 * median and the largest; all 0 with fewer than two slices. */
typedef struct il_spacing { double least, usual, largest; } il_spacing;

#define IL_SPACING_INIT { 0, 0, 0 }

/* Beyond this many usual spacings two neighbouring slices have a gap: one slice
 * that is left out makes 2 and none, two make 3, and spacings may be uneven by
 * half of one on either side. */
#define IL_GAP_SPACINGS 2.5

/* Measure the heights z[N], rising.  Of an even number of distances the median is
 * the lower of the two in the middle: of few distances half may be gaps, and two
 * slices with one far off have one of either.  O(n log n); IL_E_NOMEM. */
il_status il_spacing_measure(il_spacing *out, const double *z, size_t n, il_error *err);

/* Do neighbouring slices at BELOW and ABOVE have a gap? */
bool il_spacing_is_gap(const il_spacing *s, double below, double above);

#endif
