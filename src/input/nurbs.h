/* nurbs.h - rational B-splines as polylines. */
#ifndef IL_INPUT_NURBS_H
#define IL_INPUT_NURBS_H

#include "base/status.h"

#include <stddef.h>

enum { IL_NURBS_DEGREE_MOST = 15 };

/* knot[n + degree + 1]: not falling.  point[3 n]: x, y, z of the control points.
 * weight[n]: above 0, or null when all are 1.  degree: 1 to IL_NURBS_DEGREE_MOST,
 * below n. */
typedef struct il_nurbs {
    int degree;
    size_t n;
    const double *knot, *point, *weight;
} il_nurbs;

typedef il_status il_nurbs_put(void *self, double x, double y, double z, il_error *err);

/* Hand points of the curve to PUT, both ends too, so that chords lie within FLATNESS,
 * > 0, of it in x and y (curve.h on sizes).  The curve is cut into its Bezier pieces,
 * and these are halved.  Nothing when no knot is above the one before. */
il_status il_nurbs_draw(const il_nurbs *c, double flatness, il_nurbs_put *put, void *self, il_error *err);

#endif
