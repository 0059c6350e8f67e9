/* rt-stacks.h - the ROIs of a structure set as stacks of slices. */
#ifndef IL_INPUT_RT_STACKS_H
#define IL_INPUT_RT_STACKS_H

#include "input/reader.h"
#include "input/rt-roi.h"

/* Send the N ROIs to SINK, a stack each, in their order, in mm: contours in one
 * plane are a slice, planes nearer than a tenth of the usual spacing are one,
 * and the stack's frame takes them to patient coordinates (LPS).  The ROIs'
 * contours are used up.  What was skipped of an ROI is in REPORT when its stack
 * ends.  What the sink answers, or IL_E_NOMEM. */
il_status il_rt_stacks_emit(il_rt_roi *roi, size_t n, const char *file, const il_read_options *options,
                            il_sink *sink, il_report *report, il_error *err);

#endif
