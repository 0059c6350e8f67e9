/* tidy.h - better triangles for a finished slab. */
#ifndef IL_LOFT_TIDY_H
#define IL_LOFT_TIDY_H

#include "loft/surface.h"

/* S between its sections gets fewer and better triangles (thin.h, flip.h), its contours stay.  What
 * comes out is certified: what meets is left as it was, and so is all of S when that does not
 * help.  IL_E_NOMEM. */
il_status il_tidy(il_surface *s, const il_section *lower, const il_section *upper, il_error *err);

#endif
