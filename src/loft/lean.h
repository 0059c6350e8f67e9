/* lean.h - how the surface leans at the contours of a slice, and how it shall.
 *
 * Cut across a contour the surface is a curve n(z): n outwards in the slice's plane, z the height.
 * Straight strips give it one slope dn/dz above the slice and another below; a smooth
 * surface has one, made of both. */
#ifndef IL_LOFT_LEAN_H
#define IL_LOFT_LEAN_H

#include "loft/surface.h"

/* slope[n_stations]: dn/dz at the contour edges of one side of a slab, from the triangle that
 * has the edge; null where nothing joins the slab's sections.  height: of the slab, unit. */
typedef struct il_lean {
    double *slope;
    double height;
} il_lean;

#define IL_LEAN_INIT { NULL, 0 }

/* Of S, between LOWER and UPPER, at its section of SIDE.  slope is the caller's, to il_free. */
il_status il_lean_measure(il_lean *out, const il_surface *s, const il_section *lower, const il_section *upper,
                          int side, il_error *err);

/* By how much the smooth surface leans otherwise than the straight one, at each node of SECTION:
 * bend[3*n_nodes], the caller's to il_free.  OWN: of the slab that is to be bent; BEYOND: of the one
 * on the section's other side.  Per node: dn/dz smooth less straight, as a vector along the
 * contour's normal, no longer than IL_LEAN_BEND, for what leans more is rather level than
 * upright; and dz/dn, smooth over straight, less 1, at most IL_LEAN_RISE - 1. */
#define IL_LEAN_BEND 2.0
#define IL_LEAN_RISE 5.0
il_status il_lean_bend(double **bend, const il_section *section, const il_lean *own, const il_lean *beyond, il_error *err);

/* The slope at a point between straight pieces of slopes S0 and S1 over the heights H0 and H1: that of
 * the circle through the ends of both, to which it is tangent there.
 * At most three times the lesser slope, so that a cubic with it stays monotone where the
 * pieces are (Fritsch & Carlson 1980). */
double il_lean_between(double s0, double h0, double s1, double h1);

#endif
