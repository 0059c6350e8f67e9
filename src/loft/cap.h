/* cap.h - the flat lid on the first or last section of a stack (loft.md 10). */
#ifndef IL_LOFT_CAP_H
#define IL_LOFT_CAP_H

#include "loft/surface.h"

/* The region of SECTION as triangles without further points, in the codes of
 * SIDE.  IL_UPPER: the lid lies under the first section and faces down;
 * IL_LOWER: it lies on the last and faces up.  Constrained Delaunay. */
il_status il_cap_flat(il_surface *out, const il_section *section, int side, il_error *err);

#endif
