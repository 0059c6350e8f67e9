/* ras.h - patient coordinates to the other convention, as a stage.
 *
 * DICOM counts x to the patient's left and y to the back (LPS); much software
 * for images counts x to the right and y to the front (RAS).  z is the same. */
#ifndef IL_MODEL_RAS_H
#define IL_MODEL_RAS_H

#include "model/report.h"
#include "model/sink.h"

/* A sink that gives NEXT (borrowed) all stacks with frames that lead to RAS
 * where they led to LPS: x and y of the frame change their sign, and a stack
 * without a frame gets one.  That is half a turn about z, so that insides stay
 * inside, and it is exact: contours are not touched.  The stacks have the
 * attribute IL_ATTRIBUTE_COORDINATES then; a note in REPORT says so once. */
il_status il_ras_new(il_sink **out, il_sink *next, il_report *report, il_error *err);
void il_ras_free(il_sink *s); /* null is fine */

#endif
