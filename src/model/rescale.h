/* rescale.h - lengths from the stack's unit to another, as a stage. */
#ifndef IL_MODEL_RESCALE_H
#define IL_MODEL_RESCALE_H

#include "model/report.h"
#include "model/sink.h"

/* VALUE converted by NUMERATOR / DENOMINATOR, whole numbers below 2^31: one
 * correctly rounded operation when either is 1, else two.  *EXACT: no rounding
 * took place; then nothing was lost. */
double il_rescale_value(double value, double numerator, double denominator, bool *exact);

/* LENGTH in FROM as one in TO, both units of length, by whole numbers as above. */
double il_rescale_length(double length, il_unit from, il_unit to);

/* A sink that gives NEXT (borrowed) all stacks in the unit TO, a length:
 * vertices, heights, spot heights, the frame's origin, and what pairs say in lengths.
 * Coordinates that had to be rounded are counted in a note of REPORT, and its
 * largest_move is kept up.  A CRS text states its own unit, so it is dropped,
 * with a note.  Stacks in that unit already pass untouched.
 * IL_E_INPUT for a stack in degrees, and for coordinates that leave 1e15. */
il_status il_rescaler_new(il_sink **out, il_unit to, il_sink *next, il_report *report, il_error *err);
void il_rescaler_free(il_sink *s); /* null is fine */

#endif
