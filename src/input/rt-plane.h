/* rt-plane.h - the planes that the contours of an ROI lie in. */
#ifndef IL_INPUT_RT_PLANE_H
#define IL_INPUT_RT_PLANE_H

#include "input/rt-roi.h"

/* Directions of unit length, right-handed, in patient coordinates: A and B lie
 * in the planes, C across them, its largest component positive.  layout: the
 * axis that C is, or oblique. */
typedef struct il_rt_plane {
    il_rt_layout layout;
    double a[3], b[3], c[3];
} il_rt_plane;

/* The planes of N contours.  An axis that half of the contours' area, or more,
 * lies straight across is taken, so that axial, sagittal and coronal contours
 * keep their coordinates bit for bit.  Else it is the eigenvector to the largest
 * eigenvalue of the sum of n n' / |n| over the area vectors n (Newell's sums) of
 * all contours that are plane within FLAT; one within a thousandth of an axis is
 * that axis.  The axial plane for contours without area. */
il_rt_plane il_rt_plane_fit(const il_rt_contour *contour, size_t n, double flat);

/* Where C lies along P's normal, mm: the middle of its points, and in *SPREAD how
 * far apart they are that way. */
double il_rt_plane_level(const il_rt_plane *p, const il_rt_contour *c, double *spread);

/* The points of C as x y pairs along P's directions, in C's own memory; C has
 * no points then.  Of an axis-aligned plane these are the coordinates themselves. */
double *il_rt_plane_flatten(const il_rt_plane *p, il_rt_contour *c);

#endif
