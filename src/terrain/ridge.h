/* ridge.h - points on the chordal axis, so that no triangle lies flat between lines of one level. */
#ifndef IL_TERRAIN_RIDGE_H
#define IL_TERRAIN_RIDGE_H

#include "terrain/law.h"

/* An edge of a triangle that joins two points of one level and is no line is a chord of that
 * level's region; the middles of such chords trace its chordal axis, the discrete medial
 * axis (Prasad 1997): ridges, valley floors, saddles, tops.  Put a node with the law's height
 * on each that rises or falls by more than IL_RIDGE_LEAST intervals, divide the triangles
 * beside it, and once more for the chords that this leaves.  No edge is flipped: triangulated
 * anew, points near a line take slopes apart that were right, and errors at fine intervals
 * grow by 1 to 2 %. */
#define IL_RIDGE_LEAST 0.01
il_status il_ridge_insert(il_tin *t, il_chart *c, const il_law *law, const il_placement_options *o, il_error *err);

#endif
