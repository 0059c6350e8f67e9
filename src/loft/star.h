/* star.h - a sheet as a star round one point: for what hangs between the arms of a branching.
 *
 * Where phi pulls a region apart, over the cuts of divide.h, the sheet in the reference plane is
 * a band of any length and width, and in space it is a saddle between a few short arcs.  Its
 * triangles in the reference plane may fold in space; those round a point in its midst do not
 * where the arcs can all be seen from there. */
#ifndef IL_LOFT_STAR_H
#define IL_LOFT_STAR_H

#include "loft/builder.h"

/* Build the sheets of B that are discs with arcs in both planes as stars.  component[t] of
 * n_components: of the overlay's triangles; done[n_components] is set for those that are built.
 * O(triangles).  IL_E_NOMEM. */
il_status il_build_stars(il_builder *b, const uint32_t *component, size_t n_components, bool *done, il_error *err);

#endif
