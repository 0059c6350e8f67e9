/* bands-settle.h - on which side of their level the faces with a single level lie.
 *
 * Faces of one level that border on one another make a cluster, in which neighbours lie on
 * opposite sides; faces of two levels around it say which is which.  Where they say different
 * things, as few borders go wrong as can be, and of as few the shortest: dynamic programming
 * over a tree of the cluster.  (All borders are in that tree but where lines touch or the
 * frame has holes; those left go right whenever all can.) */
#ifndef IL_TERRAIN_BANDS_SETTLE_H
#define IL_TERRAIN_BANDS_SETTLE_H

#include "terrain/bands-graph.h"

/* What goes wrong: borders, and their length. */
typedef struct il_wrong { long n; double length; } il_wrong;

/* face[n]: those settled since il_settle_begin, clusters one after the other, and faces of
 * more levels or of none that were begun from; before[n]: what their lies were.  seen[f] ==
 * epoch: f is in face.  n_lost: clusters that nothing tells a side. */
typedef struct il_settler {
    il_bands_graph *graph;
    uint32_t *face, *before, *seen, *parent;
    il_wrong (*cost)[2];
    size_t n, n_lost;
    uint32_t epoch, lost;       /* lost: a border of such a cluster */
} il_settler;

il_status il_settler_make(il_settler *s, il_bands_graph *g, il_error *err); /* to be freed even after failure */
void il_settler_free(il_settler *s);

void il_settle_begin(il_settler *s);
/* Settle the cluster of leader FACE; when it has more levels, those beside it. */
void il_settle_from(il_settler *s, uint32_t face);
void il_settle_undo(il_settler *s);

#endif
