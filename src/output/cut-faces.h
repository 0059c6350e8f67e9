/* cut-faces.h - the pieces into which its cuts part the regions of a slice. */
#ifndef IL_OUTPUT_CUT_FACES_H
#define IL_OUTPUT_CUT_FACES_H

#include "model/pair.h"
#include "model/stack.h"

/* Loops, each closed: loop i has the points xy[2*first[i]] .. xy[2*first[i + 1]] and bounds
 * face[i] < n_faces, which is on its left.  Faces of regions that are in one piece are left out. */
typedef struct il_cut_faces {
    double *xy;             size_t n_points, cap_points;
    size_t *first;          size_t cap_first;
    uint32_t *face;         size_t n_loops, cap_face;
    size_t n_faces;
} il_cut_faces;

#define IL_CUT_FACES_INIT { 0 }
void il_cut_faces_free(il_cut_faces *f); /* safe twice */

/* Of S and those of the N cuts that are in it (UPPER).  Cuts that end a little short of what
 * they should meet are drawn out to it.  None where rings and cuts make no sense together, or
 * cross each other all over.  O(n log n) for n edges.  IL_E_NOMEM; *F is to be freed either way. */
il_status il_cut_faces_find(il_cut_faces *f, const il_slice *s, const il_cut *cut, size_t n, bool upper, il_error *err);

#endif
