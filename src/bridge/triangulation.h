/* triangulation.h - constrained Delaunay triangulation of the plane (CGAL). */
#ifndef IL_BRIDGE_TRIANGULATION_H
#define IL_BRIDGE_TRIANGULATION_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct il_triangulation il_triangulation;

/* The constrained Delaunay triangulation (Chew 1989) of N distinct points
 * xy[2*N] and M edges edge[2*M] of them.  The edges must not cross and pass
 * through no point; predicates are exact on the doubles as given.
 * IL_E_INTERNAL when they do cross. */
il_status il_triangulation_new(il_triangulation **out, const double *xy, size_t n,
                               const uint32_t *edge, size_t m, il_error *err);

/* As il_triangulation_new, for edges of which nobody knows: when some cross, *OUT is null and
 * *CROSSES set.  An edge that passes through points comes out as several. */
il_status il_triangulation_try(il_triangulation **out, const double *xy, size_t n,
                               const uint32_t *edge, size_t m, bool *crosses, il_error *err);

/* Add N more points; they get the next indices.  None may equal another. */
il_status il_triangulation_insert(il_triangulation *t, const double *xy, size_t n, il_error *err);

/* Finite triangles, counter-clockwise.  corner[3*n]: points; across[3*n]: the
 * triangle on the far side of the edge from corner k to corner k + 1, or
 * UINT32_MAX beyond the hull.  The order follows from the corners alone: each
 * triangle starts at its least corner, triangles are sorted.  Both arrays are
 * the caller's, to il_free. */
il_status il_triangulation_export(il_triangulation *t, uint32_t **corner, uint32_t **across,
                                  size_t *n, il_error *err);

void il_triangulation_free(il_triangulation *t); /* null is fine */

#ifdef __cplusplus
}
#endif
#endif
