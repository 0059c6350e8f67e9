/* detail.h - vertices inside the bands, where the law asks for them. */
#ifndef IL_TERRAIN_DETAIL_H
#define IL_TERRAIN_DETAIL_H

#include "terrain/law.h"

/* In intervals: how far the ground may be off the law before a vertex is put there, and how far
 * it must rise or fall from a line to be more than flat. */
#define IL_DETAIL_USUAL 0.05
#define IL_DETAIL_FLAT 0.0002

/* Give heights to the nodes of C that lie on no line and are no spots, and put more into T's
 * faces:
 * 1. An edge that joins two points of one level and is no line is a chord of that level's
 *    region; the middles of such chords trace its chordal axis, the discrete medial axis
 *    (Prasad 1997): ridges, valley floors, saddles, tops.  A chord that lies off the law by
 *    more than IL_DETAIL_FLAT becomes the other diagonal, where that is no chord and nearer
 *    to the law, or gets a node on its middle.
 * 2. Greedy insertion (Garland & Heckbert 1995, with a queue in place of their heap): each
 *    triangle gets a node at the worst of a few places, until all of those are within TOLERANCE
 *    intervals of the law, or nearer to its corners than a quarter of the face's own grain:
 *    the mean edge of its lines or their distance, whichever is less.  0: none.
 * 3. Where TOLERANCE is above 0, diagonals nearer to the law replace others (Dyn, Levin & Rippa
 *    1990).
 * Lines keep their vertices and edges.  IL_E_NOMEM. */
il_status il_detail_insert(il_tin *t, il_chart *c, const il_law *law, const il_placement_options *o, double tolerance,
                           il_error *err);

#endif
