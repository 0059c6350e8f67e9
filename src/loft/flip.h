/* flip.h - better triangles between the slices, by other diagonals. */
#ifndef IL_LOFT_FLIP_H
#define IL_LOFT_FLIP_H

#include "loft/surface.h"

/* How far a flip may move the surface of a slab, in slab heights. */
#define IL_FLIP_MOVE 0.01

/* Two triangles of S at an edge may get the other diagonal of their quadrilateral: where that raises
 * their smallest angle, and moves the surface by no more than IL_FLIP_MOVE of the slab's height.
 * Contour edges stay, no two nodes of one section are joined, no edge comes to be twice (loft.md
 * I3).  In the order of the triangles, a few times over: O(n).  What comes out is certified:
 * triangles that meet something are built again without flips, and S is as it was when that
 * does not help.  IL_E_NOMEM. */
il_status il_flip_edges(il_surface *s, const il_section *lower, const il_section *upper, il_error *err);

#endif
