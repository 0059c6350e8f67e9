/* cutter.h - a terrain's mesh cut at a height: the isoline that lies on it. */
#ifndef IL_TERRAIN_CUTTER_H
#define IL_TERRAIN_CUTTER_H

#include "base/keymap.h"
#include "terrain/skin.h"

/* Borrowed: skin.  triangle[first[k]] .. triangle[first[k + 1] - 1]: those of the surface and of
 * cliffs that reach into band k, strictly between levels k and k + 1, of n_bands; level: their
 * heights in the mesh, n_bands + 1.
 * Of the cut at hand, side[v], round[v] and turns[v] of the band's vertices: see cutter.c.  Node i
 * lies on the mesh's edge from vertex below[i] to vertex above[i], and next[i] follows it with
 * the higher ground on the left; IL_CHART_NONE at the frame.  node: of an edge's vertices. */
typedef struct il_cutter {
    const il_skin *skin;
    const double *level;
    size_t n_bands;
    size_t *first;
    uint32_t *triangle;
    unsigned char *side, *turns;
    uint32_t *round;
    il_keymap node;
    uint32_t *below, *above, *next;
    unsigned char *state;
    size_t n, cap_below, cap_above, cap_next, cap_state;
} il_cutter;

/* LEVEL[N]: rising, as heights of the mesh; borrowed.  IL_E_NOMEM; *C is to be freed either way. */
il_status il_cutter_build(il_cutter *c, const il_skin *s, const double *level, size_t n, il_error *err);
void il_cutter_free(il_cutter *c); /* safe twice */

/* Append to S the isoline at height Z strictly inside BAND: closed rings, and lines that end at
 * the frame, with the higher ground on their left, all vertices marked as inserted.  Each vertex lies on
 * an edge of the mesh, where that has the height Z, but for a millionth of the band or of the edge.
 * Ridges and valley floors at just that height have no lines about them, and the lines touch
 * neither themselves nor each other but where the mesh is upright.  Rings with no extent in plan
 * are left out.  O(n) for the n triangles of the band.  IL_E_NOMEM. */
il_status il_cutter_cut(il_cutter *c, size_t band, double z, il_slice *s, il_error *err);

#endif
