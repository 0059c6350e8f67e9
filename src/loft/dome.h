/* dome.h - how far a solid goes on beyond its first and last slice. */
#ifndef IL_LOFT_DOME_H
#define IL_LOFT_DOME_H

#include "loft/lean.h"

/* S closes its section of SIDE by domes of half the slab's height, the section beyond being empty.
 * BODY tells how the solid leans there on the other side.  Each dome becomes part of the sphere
 * that goes on with that slope s outwards (dn/dz towards the dome) over a lid of radius r (of the
 * largest circle in it), which is r (sqrt(1 + s^2) + s) high, pressed to half the slab where it is higher.  S is as it
 * was when that would not be sound; what comes out is certified.  IL_E_NOMEM. */
il_status il_dome_follow(il_surface *s, const il_section *lower, const il_section *upper, int side,
                         const il_lean *body, bool round_float, il_error *err);

#endif
