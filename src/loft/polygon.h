/* polygon.h - the small polygon over one sheet triangle, cut into triangles. */
#ifndef IL_LOFT_POLYGON_H
#define IL_LOFT_POLYGON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Up to two copies of each corner and a middle on each edge. */
enum { IL_POLYGON_MAX = 9 };

/* at: round the triangle, corner k is 2k and the middle of edge k (from corner k
 * to corner k + 1) is 2k + 1.  label: IL_LOWER, IL_UPPER or IL_FREE. */
typedef struct il_polygon_vertex {
    uint32_t code;
    unsigned char at, label;
    double xyz[3];
} il_polygon_vertex;

/* opposite[k]: on edge k both boundaries run, against each other, so that the
 * neighbour's sheet stands there too. */
typedef struct il_polygon {
    il_polygon_vertex v[IL_POLYGON_MAX];
    size_t n;
    bool opposite[3];
} il_polygon;

/* Triangles tri[3*(n - 2)], as numbers of vertices, counter-clockwise in plan,
 * with the least sum of diagonals among those allowed: no triangle and no
 * diagonal in a slice plane, none without area, none standing over an edge
 * where the neighbour stands too.  False when there is none.  O(n^3). */
bool il_polygon_triangulate(const il_polygon *p, unsigned char tri[3 * (IL_POLYGON_MAX - 2)]);

#endif
