/* piece.h - rings as il_outline has them, owned. */
#ifndef IL_MATCH_PIECE_H
#define IL_MATCH_PIECE_H

#include "match/ffd.h"
#include "model/ring.h"

/* crumbs: other rings were left out. */
typedef struct il_piece {
    bool crumbs;
    double *xy;              size_t n, cap;
    uint32_t *next;          size_t cap_next;
} il_piece;

void il_piece_free(il_piece *p); /* safe twice */
il_outline il_piece_outline(const il_piece *p);

/* Append the closed ring R; false without memory. */
bool il_piece_add_ring(il_piece *p, const il_ring *r);

/* *TO, empty before: P, moved by (DX, DY); false without memory. */
bool il_piece_move(il_piece *to, const il_piece *p, double dx, double dy);

/* Of what P is about, on its left: the centre of area, and how large it is.  P has a point. */
double il_piece_centre(const il_piece *p, double centre[2]);

/* The length of all its edges. */
double il_piece_length(const il_piece *p);

#endif
