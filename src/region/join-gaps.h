/* join-gaps.h - ends that lie apart by little, joined. */
#ifndef IL_REGION_JOIN_GAPS_H
#define IL_REGION_JOIN_GAPS_H

#include "base/keymap.h"
#include "region/join-ends.h"

/* Join the ends of E that are alone at their places, pair by pair, the nearest first,
 * each once, none farther apart than DISTANCE (above 0); of pairs equally near, the one
 * with the least vertices.  EDGES has an entry under IL_KEYMAP_EDGE of two places where
 * a line has an edge between them: such ends are not joined, a single edge's own least
 * of all.  Ends in knots stay.  *N_BRIDGED: how many pairs; *LARGEST: how far apart the
 * farthest were.
 * O(n log n) where ends are spread, and never quadratic.  IL_E_NOMEM. */
il_status il_ends_bridge(il_ends *e, double distance, const il_keymap *edges, size_t *n_bridged, double *largest, il_error *err);

#endif
