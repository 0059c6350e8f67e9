/* join-edges.h - the edges that a level's lines have more than once.
 *
 * Sheets of a map overlap, so that a stretch of an isoline is in two lines, point by
 * point, in either direction; who digitises a ring may go on beyond its beginning. */
#ifndef IL_REGION_JOIN_EDGES_H
#define IL_REGION_JOIN_EDGES_H

#include "model/stack.h"

#define IL_NO_EDGE UINT32_MAX

/* An edge.  line, vertex: where it was met first; it leads from there to the next
 * vertex.  is_shared: it came again; is_within: in the same line.  net: how many copies run from its lesser end (by x, then
 * y) to the greater, less those that run back.
 * For il_pieces_cut: next[k], at its lesser (0) and greater (1) end: the shared edge
 * that follows it there.  splits[k]: not the same one does wherever it comes.  kept:
 * it is in a piece. */
typedef struct il_shared_edge {
    uint32_t line, vertex, next[2];
    int32_t net;
    bool is_within, is_shared, splits[2], kept;
} il_shared_edge;

/* of[l]: null when line l has none that is shared; else of[l][v] is the index of the
 * edge behind its vertex v, IL_NO_EDGE when that comes nowhere else. */
typedef struct il_shared_edges {
    il_shared_edge *edge;
    size_t n;
    uint32_t **of;
    size_t n_lines;
} il_shared_edges;

#define IL_SHARED_EDGES_INIT { NULL, 0, NULL, 0 }

/* Find the edges that the lines of S have twice or more; of is null when there are none.
 * Lines have two vertices or more, rings three, no two neighbours are equal, and there
 * are no spikes (il_ring_drop_spikes).  O(n).  IL_E_INPUT beyond 2^32 - 2 edges,
 * IL_E_NOMEM; empty then. */
il_status il_shared_edges_find(il_shared_edges *out, const il_slice *s, il_error *err);
void il_shared_edges_free(il_shared_edges *e);

#endif
