/* intersection.h - do triangles of a mesh meet where they should not? (CGAL) */
#ifndef IL_BRIDGE_INTERSECTION_H
#define IL_BRIDGE_INTERSECTION_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Look for two triangles of tri[3*n_triangles] over xyz[3*n_vertices] that meet
 * in more than the vertices and edges they share; vertices are the same when
 * their positions are, whatever their index.  Also finds degenerate triangles
 * (no area).  Exact.  Boxes first (Zomorodian & Edelsbrunner 2000), O(n log^2 n)
 * plus the pairs tested.  With TOUCHED not null only pairs with at least one
 * triangle k for which touched[k] is nonzero are tested.
 * first[2]: the least pair found (a degenerate triangle stands twice);
 * *FOUND: how many pairs there are, counted up to LIMIT. */
il_status il_intersections(const double *xyz, size_t n_vertices, const uint32_t *tri, size_t n_triangles,
                           const unsigned char *touched, size_t limit,
                           size_t *found, uint32_t first[2], il_error *err);

#ifdef __cplusplus
}
#endif
#endif
