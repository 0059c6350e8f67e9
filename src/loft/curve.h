/* curve.h - a slab's straight strips bent into smooth ones.
 *
 * Corresponding points of several slices lie on curves.  At height t of a slab (0 below, 1 above)
 * a point of the straight surface is shifted in its plane by what a cubic with the slopes m0, m1
 * at its ends has beyond the straight line of slope d (Hermite),
 *
 *     h [ (m0 - d) t (1 - t)^2 - (m1 - d) t^2 (1 - t) ],
 *
 * and what lies between the contours of both slices, branches and caps, where the surface is
 * rather level than upright, is raised to the monotone curve from 0 to 1 with the slopes r0, r1,
 *
 *     [ t^2 + r0 t (1 - t) ] / [ 1 + (r0 + r1 - 2) t (1 - t) ]
 *
 * (Gregory & Delbourgo 1982), which stays strictly between the slices whatever the slopes. */
#ifndef IL_LOFT_CURVE_H
#define IL_LOFT_CURVE_H

#include "loft/lean.h"

/* How near the surface comes to the curves by itself, in slab heights, at nine of ten contour
 * vertices; and the most contours that are put in to come so near. */
#define IL_CURVE_TOLERANCE 0.02
enum { IL_CURVE_BETWEEN_MOST = 7 };

/* Put BETWEEN contours into S, or as many as that takes when it is negative.  lean[side] tells how
 * S leans at its sections, beyond[side] how the next slabs do.  Contours of the slices stay as they are.
 * Where bent triangles meet, the bends about them are halved, at last dropped; S is as it was
 * when that does not help.  What comes out is certified. */
il_status il_curve_bend(il_surface *s, const il_section *lower, const il_section *upper, const il_lean lean[2],
                        const il_lean beyond[2], int between, bool round_float, il_error *err);

#endif
