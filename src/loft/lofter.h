/* lofter.h - from matched slices to a certified surface, slab by slab. */
#ifndef IL_LOFT_LOFTER_H
#define IL_LOFT_LOFTER_H

#include "model/mesh.h"
#include "model/sink.h"

/* Flat, a dome of half a spacing, or one that goes on as the solid leans, of at most that. */
typedef enum il_cap { IL_CAP_FLAT, IL_CAP_DOME, IL_CAP_AUTO } il_cap;

/* How many contours are put between two slices: as many as the surface needs, or a number
 * up to the most that may be asked for. */
enum { IL_BETWEEN_AUTO = -1, IL_BETWEEN_MOST = 64 };

/* threads: at least 1; the mesh is the same for any number.  cap: how the first
 * and last slice are closed, and those at gaps.  round_float: positions are rounded to 32-bit
 * floats before they are certified (STL).  between: contours put
 * between each two slices, on smooth curves through several (loft/curve.h); 0 leaves straight strips. */
typedef struct il_loft_options {
    int threads;
    il_cap cap;
    bool round_float;
    int between;
    void (*progress)(void *self, size_t slabs_done); /* may be null; called on the caller's thread */
    void *progress_self;
} il_loft_options;

#define IL_LOFT_OPTIONS_INIT { 1, IL_CAP_FLAT, false, IL_BETWEEN_AUTO, NULL, NULL }

/* At most this many slices are held, with their pairs and slabs; beside them the
 * last one, until it is known what joins it to the one before, and with domes the
 * first of a run. */
enum { IL_LOFT_WINDOW = 8 };

/* A sink that lofts every stack into NEXT (borrowed); one without contours has no
 * surface, and is abandoned.  Slices come clean and in rising z; a slice without
 * a pair is matched by the identity.  At a gap (model/pair.h) each side is closed
 * as the stack's ends are; a slice that is not empty and stands alone beside a
 * gap is IL_E_INPUT.
 * IL_E_SURFACE names stack, slices and place when no attempt passes the
 * certificate: then NEXT was told to abandon the stack, and the caller may go
 * on with the next one by calling stack_begin. */
il_status il_lofter_new(il_sink **out, const il_loft_options *o, il_mesh_sink *next, il_error *err);
/* Where other stacks go elsewhere: *STACK is the number of each that comes here, which the
 * origins of its vertices get; else those that come are counted. */
void il_lofter_number_by(il_sink *s, const int32_t *stack);
void il_lofter_free(il_sink *s);

#endif
