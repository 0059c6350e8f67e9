/* simple.h - slices whose rings meet nowhere: all they need is their direction. */
#ifndef IL_REGION_SIMPLE_H
#define IL_REGION_SIMPLE_H

#include "model/stack.h"

/* With more rings than this a triangulation finds the inside sooner: here each
 * ring is compared with all others. */
enum { IL_SIMPLE_RINGS = 64 };

/* Append to OUT a copy of each ring of S that has vertices, in canonical order
 * and turned so that the even-odd region lies on its left; x- lines are moved, those
 * of rings without vertices to OUT itself.  The rings of S are simple and neither
 * cross nor touch one another.  *TURNED: how many had to be turned round.
 * O(rings x vertices); exact.  IL_E_NOMEM. */
il_status il_slice_take_simple(il_slice *out, il_slice *s, size_t *turned, il_error *err);

#endif
