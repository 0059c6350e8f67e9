/* emit.h - finished slabs become pieces of the output mesh. */
#ifndef IL_LOFT_EMIT_H
#define IL_LOFT_EMIT_H

#include "loft/census.h"
#include "loft/pinch.h"
#include "loft/window.h"

/* Runs along a stack: the section that the next slab stands on is numbered
 * already.  below: the surface under it, kept for its fans. */
typedef struct il_emitter {
    il_mesh_sink *next;
    int32_t stack;            /* index of the stack in the stream */
    bool flat_caps;
    il_umbrellas lower;       /* vertices of the section at hand */
    uint32_t lower_first, n_vertices;
    il_surface lid;           /* flat cap under the first section */
    il_census census;
    il_mesh_facts facts;
} il_emitter;

void il_emitter_begin(il_emitter *e, il_mesh_sink *next, int32_t stack, bool flat_caps);
void il_emitter_free(il_emitter *e);

/* Emit the first slab of W, which is ready.  The slab above it, if any, is
 * finished too. */
il_status il_emitter_slab(il_emitter *e, il_window *w, il_error *err);

/* Complete the facts after the last slab. */
void il_emitter_end(il_emitter *e);

#endif
