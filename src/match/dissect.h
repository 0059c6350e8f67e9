/* dissect.h - a region cut into the pieces that go over into each of several partners.
 *
 * The pieces are the cells of a power diagram (Aurenhammer 1987) of the partners' centres, with
 * the weights by which each cell has its partner's share of the area: the transport of the
 * region onto its partners that moves it least (Aurenhammer, Hoffmann & Aronov 1998).  Of two,
 * the cut is the medial axis between discs about the centres, as the paper's section 3.4 has it,
 * but straight, and where the areas ask for it: pieces of plump regions stay plump, and a
 * smooth map can take a ring to them. */
#ifndef IL_MATCH_DISSECT_H
#define IL_MATCH_DISSECT_H

#include "match/frame.h"
#include "match/piece.h"

/* site[2*n], weight[n]: of the partners, in cells of frame, as is the grid: the region in
 * triangles, its outline's points first. */
typedef struct il_dissection {
    il_frame frame;
    double *site, *weight;   size_t n;
    size_t rings;            /* of the region */
    double *xy;              size_t n_points, cap_points;
    uint32_t *corner, *across; size_t n_triangles;
    unsigned char *inside;   /* [n_triangles] */
    double area;             /* of the region, cells^2 */
    double *side;            /* [n_points] scratch */
} il_dissection;

/* Cut REGION (unit) among N partners, at least 2, with centres site[2*N] and of areas share[N]
 * (any unit).  *SOUND is false when it cannot be cut: its outline touches itself, or centres
 * coincide.  IL_E_NOMEM. */
il_status il_dissection_begin(il_dissection *d, const il_outline *region, const double *site, const double *share, size_t n,
                              bool *sound, il_error *err);
void il_dissection_free(il_dissection *d);

/* How far P (unit) is inside piece I, from the nearest cut, in cells; below 0 outside it.
 * *RIVAL (or null): the piece beyond that cut. */
double il_dissection_side(const il_dissection *d, size_t i, const double p[2], size_t *rival);

/* In whose cell P (unit) is.  O(n). */
size_t il_dissection_cell(const il_dissection *d, const double p[2]);

/* Piece I in the region's unit, without a strip of SEAM cells along the cuts; empty when
 * nothing is left.  Of several parts, where the cut goes in and out of the region, the one about
 * the most.  IL_E_NOMEM. */
il_status il_dissection_piece(il_dissection *d, size_t i, double seam, il_piece *out, il_error *err);

/* The cuts between piece I and those behind it, unit; next[k] is UINT32_MAX where a line ends.
 * IL_E_NOMEM. */
il_status il_dissection_cuts(il_dissection *d, size_t i, il_piece *out, il_error *err);

/* *MEET: have pieces I and K a cut in common?  Its middle, unit.  IL_E_NOMEM. */
il_status il_dissection_meet(il_dissection *d, size_t i, size_t k, bool *meet, double middle[2], il_error *err);

/* Half the region's breadth or so, in cells: for how wide a seam should be. */
double il_dissection_breadth(const il_dissection *d);

#endif
