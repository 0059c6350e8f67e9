/* frame-curves.h - the box of a map that was in degrees: its sides are curves in the plane. */
#ifndef IL_TERRAIN_FRAME_CURVES_H
#define IL_TERRAIN_FRAME_CURVES_H

#include "terrain/frame-sides.h"

/* Has a map with head HEAD such a box?  One more than half way around a pole has not: its
 * sides would meet behind it. */
bool il_frame_is_curved(const il_stack_head *head);

/* Add the box of longitudes and latitudes of HEAD, which is projected, in chords that are
 * off by at most a millionth of their side; S's slack is how far.  IL_E_NOMEM. */
il_status il_frame_curves_make(il_frame_sides *s, const il_stack_head *head, il_error *err);

/* The place on the curves where P belongs: t of side `side`, at (x, y).  is_on: P is that
 * place, within rounding. */
typedef struct il_curve_place {
    size_t side;
    double t, at[2];
    bool is_on;
} il_curve_place;

/* For P near the sides of S.  IL_E_NOMEM. */
il_status il_frame_curves_locate(const il_frame_sides *s, const double p[2], il_curve_place *out, il_error *err);

/* N points xy[2*n], longitudes and latitudes, to the plane of a stack that `p` and then
 * `scale` made.  IL_E_NOMEM, IL_E_INPUT. */
il_status il_frame_project(const il_projection *p, double scale, double *xy, size_t n, il_error *err);

/* In how many pieces, as equal in degrees, the straight line between two longitudes and
 * latitudes is cut, so that chords stray from it by at most TOLERANCE of the plane; *STRAY:
 * by how much they do. */
il_status il_frame_count_pieces(const il_projection *p, double scale, const double from[2], const double to[2],
                                double tolerance, size_t *n, double *stray, il_error *err);

/* What metres were multiplied by to make the unit of HEAD. */
double il_frame_scale(const il_stack_head *head);

#endif
