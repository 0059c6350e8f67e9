/* sink.h - the one way contours travel: as calls, stack by stack, slice by slice.
 *
 * A reader calls a sink; a stage (cleaning, matching) is a sink that calls the
 * next one; a writer or the lofter is the last.  The calls come in this order:
 *     (stack_begin (slice pair?)* stack_end)* end
 * with slices in rising z; the pair of slices k and k + 1 comes right after
 * slice k + 1.  After a failure nothing more is called.  What a call gets is
 * the caller's: a sink that keeps a slice or pair swaps it for an empty one
 * (il_slice_INIT), which the caller frees as well. */
#ifndef IL_MODEL_SINK_H
#define IL_MODEL_SINK_H

#include "model/pair.h"
#include "model/stack.h"

typedef struct il_sink il_sink;
struct il_sink {
    il_status (*stack_begin)(il_sink *self, const il_stack_head *head, il_error *err);
    il_status (*slice)(il_sink *self, il_slice *slice, il_error *err);
    il_status (*pair)(il_sink *self, il_pair *pair, il_error *err);
    il_status (*stack_end)(il_sink *self, il_error *err);
    il_status (*end)(il_sink *self, il_error *err);
};

#endif
