/* rt-levels.h - which contours of an ROI are in one slice. */
#ifndef IL_INPUT_RT_LEVELS_H
#define IL_INPUT_RT_LEVELS_H

#include <stddef.h>

/* How far apart the slices usually are, mm: the median of the distances of
 * neighbouring levels LEVEL[0..N), rising, without those that are no more than
 * jitter.  Planning systems write the heights of one plane a few micrometres,
 * or a decimal, apart.  Distances are jitter when they are ten times less
 * than all others, group the levels into clumps not wider than a tenth of any
 * other, and are at most 0.05 mm, or 0.25 mm where the clumps have no more than
 * three levels in the mean.  With one clump there is no spacing: 0.
 * SCRATCH[n] is overwritten. */
double il_rt_levels_spacing(const double *level, size_t n, double *scratch);

/* The end of the slice that begins with LEVEL[BEGIN]: all levels up to a tenth
 * of SPACING, and not more than 1 mm, higher belong to it. */
size_t il_rt_levels_slice(const double *level, size_t n, size_t begin, double spacing);

/* The height of a slice of the N levels: the commonest, the middle one of
 * equally common ones. */
double il_rt_levels_height(const double *level, size_t n);

#endif
