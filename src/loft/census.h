/* census.h - components and genus of a mesh that passes by piece by piece. */
#ifndef IL_LOFT_CENSUS_H
#define IL_LOFT_CENSUS_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* label[n_front]: the component of each vertex of the section that the next
 * piece goes on from, as the least such vertex in it.  All else is counts. */
typedef struct il_census {
    uint32_t *label;
    size_t n_front;
    uint64_t vertices, triangles;
    long closed;              /* components that reach no further */
} il_census;

#define IL_CENSUS_INIT { NULL, 0, 0, 0, 0 }

/* The section that the first piece goes on from has N vertices. */
il_status il_census_begin(il_census *c, size_t n, il_error *err);

/* A piece: tri[3*n_triangles] over n_front + n_inner + n_next vertices in this
 * order; the last n_next are the front of the piece that follows. */
il_status il_census_add(il_census *c, const uint32_t *tri, size_t n_triangles,
                        size_t n_inner, size_t n_next, il_error *err);

/* What the mesh is when nothing more comes: the number of its components, and
 * its genus, the sum over them, by Euler: V - E + F = 2 (components - genus). */
void il_census_result(const il_census *c, long *components, long *genus);

void il_census_free(il_census *c);

#endif
