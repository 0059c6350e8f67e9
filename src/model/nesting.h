/* nesting.h - which closed parts of a mesh lie inside which. */
#ifndef IL_MODEL_NESTING_H
#define IL_MODEL_NESTING_H

#include "model/mesh.h"

/* winding[k]: how many solids, by orientation, enclose part K of M: the winding
 * number of the space just outside of it, 0 in the open.  part[t] < N_PARTS is
 * the part of triangle T, each a closed oriented surface that meets no other;
 * volume[k] its signed volume.  Triangles that
 * name a vertex twice belong to no part, whatever part[] says.  A hole in a solid has winding 1 and negative
 * volume.
 *
 * From next to the lowest point of each part along an oblique direction a ray
 * goes down.  What encloses a part reaches lower than it does, so only parts
 * before it in the order of lowest points count, and since parts do not cross,
 * the nearest of their triangles tells all: one search in a tree of boxes a
 * part.  In plain doubles: surfaces within a thousandth of a triangle of each
 * other may be told wrongly. */
il_status il_mesh_windings(const il_mesh *m, const uint32_t *part, size_t n_parts, const double *volume,
                           long *winding, il_error *err);

#endif
