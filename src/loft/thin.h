/* thin.h - better triangles between the slices, by fewer vertices. */
#ifndef IL_LOFT_THIN_H
#define IL_LOFT_THIN_H

#include "loft/net.h"

/* Inner vertices of NET are put into their nearest neighbour, on their contour where they have
 * one, where that makes the smallest angle about them larger.  The surface does not move by more
 * than IL_NET_MOVE tells: it moves by the distance of the vertex from the planes of the triangles
 * that come in place of its own.  No two nodes of one section are joined, and the surface stays
 * the same but for its shape (link condition, Dey, Edelsbrunner, Guha & Nekhayev 1999).  In the
 * order of the triangles, a few times over: O(n).  *N: how many vertices are gone.  IL_E_NOMEM. */
il_status il_thin(il_net *net, size_t *n, il_error *err);

#endif
