/* predicates.h - exact signs of the plane's basic determinants (CGAL). */
#ifndef IL_BRIDGE_PREDICATES_H
#define IL_BRIDGE_PREDICATES_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* 1 when a, b, c turn counter-clockwise, -1 clockwise, 0 when collinear; the
 * sign is that of the real numbers which the doubles are.  Finite arguments. */
int il_orientation(const double a[2], const double b[2], const double c[2]);

/* 1 when d is inside the circle through a, b, c, which turn counter-clockwise, -1 outside, 0 on
 * it; likewise exact. */
int il_in_circle(const double a[2], const double b[2], const double c[2], const double d[2]);

/* Have the closed edges from A to B and from C to D a point in common?  Exact, but for
 * collinear ones, which count as meeting wherever they lie: callers know that boxes do. */
static inline bool il_edges_meet(const double a[2], const double b[2], const double c[2], const double d[2])
{
    return il_orientation(a, b, c) * il_orientation(a, b, d) <= 0 && il_orientation(c, d, a) * il_orientation(c, d, b) <= 0;
}

#ifdef __cplusplus
}
#endif
#endif
