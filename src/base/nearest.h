/* nearest.h - distance to the nearest of a set of segments. */
#ifndef IL_BASE_NEAREST_H
#define IL_BASE_NEAREST_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* Segments in classes: end points, the number of the class, and a number that
 * il_nearest_find gives back. */
typedef struct il_segment {
    double ax, ay, bx, by;
    size_t class, id;
} il_segment;

/* A bounding-box tree for each class over segment[n], which it owns and has
 * sorted by class.  first[c] .. first[c + 1] are the segments of class c. */
typedef struct il_nearest {
    il_segment *segment;
    double *box;         /* [4*n_boxes] of runs of segments, see nearest.c */
    size_t *first;       /* [n_classes + 1] */
    size_t *root;        /* [n_classes + 1] where the class's boxes begin */
    size_t n, n_classes;
} il_nearest;

/* Build over segment[n], which is taken over also on failure (il_free).
 * Classes count from 0 to n_classes - 1.  O(n log^2 n). */
il_status il_nearest_build(il_nearest *t, il_segment *segment, size_t n, size_t n_classes, il_error *err);
void il_nearest_free(il_nearest *t);

/* Distance of (X, Y) to the nearest segment of class C, in the unit of the
 * coordinates; infinity when the class is empty. */
double il_nearest_distance(const il_nearest *t, size_t c, double x, double y);

/* A place on a segment, t in [0, 1], and how far away it is. */
typedef struct il_nearest_place {
    size_t id;
    double t, distance;
} il_nearest_place;

/* The place of class C nearest to (X, Y) on segments that turn less than a right
 * angle from (DX, DY); false when there are none. */
bool il_nearest_find(const il_nearest *t, size_t c, double x, double y, double dx, double dy, il_nearest_place *out);

/* Likewise on all segments of the class. */
bool il_nearest_point(const il_nearest *t, size_t c, double x, double y, il_nearest_place *out);

/* Show VISIT each segment of class C whose own box meets BOX (least x and y, greatest x
 * and y), until it says true: what it said last, false when there was none.  CONTEXT is
 * passed on. */
typedef bool il_nearest_visitor(void *context, const il_segment *s);
bool il_nearest_visit(const il_nearest *t, size_t c, const double box[4], il_nearest_visitor *visit, void *context);

/* Likewise those whose box meets the straight line from FROM to TO, or comes near it within
 * rounding. */
bool il_nearest_visit_along(const il_nearest *t, size_t c, const double from[2], const double to[2],
                            il_nearest_visitor *visit, void *context);

#endif
