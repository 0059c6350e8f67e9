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
 * their positions are, whatever their index.  A triangle without area counts as
 * a pair with itself, and is tested against no other.
 *
 * Exact for all finite coordinates below 1e100.  A tree of boxes along a Morton
 * curve finds the candidates: O(n log n) plus the pairs whose boxes overlap.
 * With TOUCHED not null only pairs with at least one triangle k for which
 * touched[k] is nonzero are tested.
 *
 * *FOUND: how many pairs there are; counting stops at LIMIT.  first[2]: the
 * least of them (of those counted), lower index first; UINT32_MAX when there is
 * none.  Depends on the arguments alone.  Safe to call from several threads. */
il_status il_intersections(const double *xyz, size_t n_vertices, const uint32_t *tri, size_t n_triangles,
                           const unsigned char *touched, size_t limit,
                           size_t *found, uint32_t first[2], il_error *err);

/* Which groups of triangles meet in more than vertices and edges they share:
 * group[n_triangles] is the group of each, or UINT32_MAX for triangles that are
 * left out.  Triangles of one group are not compared, nor are those without
 * area, nor with TOUCHED not null two that it does not mark.  *PAIR, the caller's to il_free: 2 * *N_PAIRS groups, lesser first, all
 * pairs that meet, sorted.  Otherwise as il_intersections. */
il_status il_intersections_between(const double *xyz, size_t n_vertices, const uint32_t *tri, size_t n_triangles,
                                   const uint32_t *group, const unsigned char *touched,
                                   uint32_t **pair, size_t *n_pairs, il_error *err);

#ifdef __cplusplus
}
#endif
#endif
