/* contours.h - contours from arrays, as a reader would bring them. */
#ifndef IL_API_CONTOURS_H
#define IL_API_CONTOURS_H

#include "isoloft.h"
#include "model/sink.h"

/* Send CONTOUR[0..N) through SINK: a stack for each stack number, the least
 * first, its slices by rising z, the rings of a slice in the order given.
 * IL_E_INPUT names a contour whose numbers are not finite and below 1e15.
 * O(n log n). */
il_status il_contours_send(const il_contour *contour, size_t n, il_unit unit, il_sink *sink, il_error *err);

#endif
