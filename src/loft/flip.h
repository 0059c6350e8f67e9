/* flip.h - better triangles between the slices, by other diagonals. */
#ifndef IL_LOFT_FLIP_H
#define IL_LOFT_FLIP_H

#include "loft/net.h"

/* Two triangles of NET at an edge may get the other diagonal of their quadrilateral: where that raises
 * their smallest angle, and does not move the surface by more than IL_NET_MOVE tells.
 * Contour edges stay, between the slices too; no two nodes of one section are joined, no edge comes to be twice (loft.md
 * I3).  In the order of the triangles, a few times over: O(n).  How many were flipped. */
size_t il_flip_edges(il_net *net);

#endif
