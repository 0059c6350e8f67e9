/* axis.h - points inside the sheets: on the chordal axis, with their heights (loft.md 6).
 *
 * A sheet triangle, or an inner edge, with all its ends in one slice plane would
 * be a flat piece of surface.  Such edges are chords between contours of one
 * plane; their middles trace the chordal axis, the discrete medial axis (Prasad
 * 1997): saddles between branches, ridges of caps. */
#ifndef IL_LOFT_AXIS_H
#define IL_LOFT_AXIS_H

#include "base/nearest.h"
#include "loft/sector.h"

/* Twice: assign labels, break the flat edges of O at their middles by free
 * points, triangulate anew.  *L holds the labels of the last triangulation. */
il_status il_axis_insert(il_overlay *o, il_labels *l, il_error *err);

/* Heights of free points.  component[t]: sheets are connected over inner edges;
 * tree: the contour edges of component c in plane p as class 2 * c + p. */
typedef struct il_heights {
    uint32_t *component;
    size_t n_components;
    il_nearest tree;
} il_heights;

il_status il_heights_build(il_heights *h, const il_overlay *o, il_error *err);
void il_heights_free(il_heights *h);

/* A point of a sheet: xy in grid units, its component, and what becomes of it. */
typedef struct il_free_point {
    double x, y;
    double shift[2];      /* what takes it back to the upper slice, grid units */
    uint32_t component;
    double z;             /* 0 in the lower plane, 1 in the upper */
} il_free_point;

/* Set z of all N points: d_L / (d_L + d_U) with the distances to the component's
 * edges, each in its own slice: that in the upper from where the point is taken back to,
 * for what phi pulls apart or presses together is not near or far in truth.  A component with edges in one plane only is a cap: a
 * dome of height RISE, z = RISE sqrt(1 - (1 - d / d_max)^2) over the lower
 * plane and one minus that under the upper, where d_max is the largest of the
 * component's points.  Never nearer to a plane than IL_INNER_LEAST of the slab. */
il_status il_heights_set(const il_heights *h, il_free_point *p, size_t n, double rise, il_error *err);

#endif
