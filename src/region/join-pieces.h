/* join-pieces.h - the lines of a level, cut where they begin or cease to share edges.
 *
 * A stretch that several lines have becomes a piece of its own, kept once; what was
 * cut for it is joined again with the other ends (join-ends.h).  Where a line is cut
 * depends on all lines alike, not on their order. */
#ifndef IL_REGION_JOIN_PIECES_H
#define IL_REGION_JOIN_PIECES_H

#include "model/report.h"
#include "region/join-edges.h"

/* Vertices from, from + 1, ... of line LINE, N of them; around the ring when it is
 * one.  whole: the line as it is.  closed: a ring, or first and last vertex are the
 * same.  is_shared: other lines had it, too. */
typedef struct il_piece {
    uint32_t line;
    bool whole, closed, is_shared;
    size_t from, n;
} il_piece;

/* n_lines: open lines of which a piece is left. */
typedef struct il_pieces {
    il_piece *piece;
    size_t n, cap, n_lines;
} il_pieces;

#define IL_PIECES_INIT { NULL, 0, 0, 0 }

/* Cut the lines of S, whose shared edges are E (may have none).  Lines and edges that
 * are left out are counted into REPORT (may be null).  O(n), and O(m log m) for m
 * lines that share edges.  IL_E_NOMEM; empty then. */
il_status il_pieces_cut(il_pieces *out, const il_slice *s, il_shared_edges *e, il_report *report, il_error *err);
void il_pieces_free(il_pieces *p);

/* The length of the copies of P that run as it does, less that of the others; E as
 * above. */
double il_piece_along(const il_piece *p, const il_slice *s, const il_shared_edges *e);

/* Vertex K of piece P, K < n. */
static inline const double *il_piece_vertex(const il_piece *p, const il_slice *s, size_t k)
{
    const il_ring *r = &s->ring[p->line];
    size_t v = p->from + k;
    return r->xy + 2 * (v < r->n ? v : v - r->n);
}

#endif
