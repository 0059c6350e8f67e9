/* separate.h - rings that touch only because their input crossed, drawn apart. */
#ifndef IL_REGION_SEPARATE_H
#define IL_REGION_SEPARATE_H

#include "model/stack.h"

/* Where edges crossed, even-odd leaves rings that touch in an inserted vertex.
 * No vertex of the input stands there, so it need not be one point: each ring
 * that passes moves its copy a little between its own two neighbours, and the
 * solid does not touch itself any more.  All of S is left as it was when that
 * would make rings meet elsewhere or pass over one another: S is clean (clean.h)
 * before and after.  *PINCHES is lowered by what was solved.
 * ROUND_FLOAT: copies must differ as 32-bit floats.  O(n log n). */
il_status il_slice_separate(il_slice *s, bool round_float, size_t *pinches, il_error *err);

#endif
