/* tee.h - one stream of contours to two places. */
#ifndef IL_MODEL_TEE_H
#define IL_MODEL_TEE_H

#include "model/sink.h"

/* A sink that makes every call on SIDE first, then on NEXT (both borrowed).
 * SIDE only looks: it must not take the slices and pairs it is shown. */
il_status il_tee_new(il_sink **out, il_sink *side, il_sink *next, il_error *err);
void il_tee_free(il_sink *s); /* null is fine */

#endif
