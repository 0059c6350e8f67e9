/* curve.h - arcs of ellipses as polylines, whoever draws them. */
#ifndef IL_INPUT_CURVE_H
#define IL_INPUT_CURVE_H

#include "base/status.h"

#include <stdbool.h>

typedef struct il_vec { double x, y; } il_vec;

/* The ellipse c + u w_x + v w_y, w a unit vector: u and v are conjugate half
 * diameters, so that an affine map of an ellipse is the map of its three vectors. */
typedef struct il_ellipse { il_vec c, u, v; } il_ellipse;

/* Where points go, one after the other.  flatness: the farthest that a chord may lie
 * from the curve, > 0. */
typedef struct il_curve_pen {
    il_status (*put)(void *self, double x, double y, il_error *err);
    void *self;
    double flatness;
} il_curve_pen;

/* A curve is also allowed this much of its own size, so that a few bytes of a
 * hostile file cannot ask for millions of vertices. */
#define IL_RELATIVE_FLATNESS 1e-6

/* The tolerance for a curve of a size. */
double il_curve_tolerance(double flatness, double size);

/* Length of the longer half axis. */
double il_ellipse_radius(const il_ellipse *e);

/* The points of the arc from the unit vector A to B that lie between its ends, in
 * order.  large: it is longer than half of the ellipse; sweep: w turns from x to y.
 * A and B are at most the rounding of a unit vector's length off. */
il_status il_curve_arc(const il_curve_pen *p, const il_ellipse *e, il_vec a, il_vec b, bool large, bool sweep,
                       il_error *err);

/* The points of the whole ellipse behind c + u, from u to v and round, without c + u. */
il_status il_curve_ellipse(const il_curve_pen *p, const il_ellipse *e, il_error *err);

#endif
