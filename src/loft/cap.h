/* cap.h - the flat lid on a section that nothing is joined to (loft.md 10). */
#ifndef IL_LOFT_CAP_H
#define IL_LOFT_CAP_H

#include "loft/surface.h"

/* The region of SECTION as triangles without further points, in the codes of
 * SIDE.  IL_UPPER: the lid lies under the first section and faces down;
 * IL_LOWER: it lies on the last and faces up.  Constrained Delaunay. */
il_status il_cap_flat(il_surface *out, const il_section *section, int side, il_error *err);

/* The surface between two sections with a gap between them: a lid on LOWER that
 * faces up, one under UPPER that faces down. */
il_status il_cap_gap(il_surface *out, const il_section *lower, const il_section *upper, il_error *err);

#endif
