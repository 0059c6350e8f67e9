/* predicates.h - exact signs of the plane's basic determinants (CGAL). */
#ifndef IL_BRIDGE_PREDICATES_H
#define IL_BRIDGE_PREDICATES_H

#ifdef __cplusplus
extern "C" {
#endif

/* 1 when a, b, c turn counter-clockwise, -1 clockwise, 0 when collinear; the
 * sign is that of the real numbers which the doubles are.  Finite arguments. */
int il_orientation(const double a[2], const double b[2], const double c[2]);

#ifdef __cplusplus
}
#endif
#endif
