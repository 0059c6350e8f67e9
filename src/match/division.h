/* division.h - a group of regions that lie apart, at work: see divide.h. */
#ifndef IL_MATCH_DIVISION_H
#define IL_MATCH_DIVISION_H

#include "match/dissect.h"
#include "match/ffd.h"
#include "match/rows.h"
#include "match/wrap.h"
#include "model/stack.h"

/* An outer ring of the group with its holes, and the links that it has: link[n_links]. */
typedef struct il_region {
    uint32_t outer;
    il_piece outline;          /* of all its rings, unit */
    uint32_t *link;          size_t n_links, cap_links;
    bool cut;
    il_dissection cutting;
    double seam;               /* cells of the dissection */
} il_region;

/* A link with the numbers of its regions, its pieces, and its phi, unit: the fit, or the wrap
 * where that does not fit.  shift: from the centre of the upper piece to that of the lower. */
typedef struct il_joint {
    il_link link;
    size_t region[2];
    il_piece piece[2];
    double shift[2];
    il_fit fit;
    bool wrapped;
    il_wrap wrap;
    il_bend bend;
} il_joint;

typedef struct il_division {
    const il_group *group;
    const il_slice *slice[2];
    const uint32_t *const *outer;
    il_ffd *solver;
    il_region *region[2];       size_t n_regions[2];
    il_joint *joint;            size_t n_joints;
} il_division;

/* The number of the region that ring R of SIDE is in, or how many there are when it is in none.
 * O(log n). */
size_t il_division_region(const il_division *d, int side, uint32_t r);

/* What link J joins on SIDE: a piece, or the whole region where that has no other link. */
const il_piece *il_joint_piece(const il_division *d, const il_joint *j, int side);

/* phi of link J: joint.c.  IL_E_NOMEM. */
il_status il_joint_solve(il_division *d, il_joint *j, il_error *err);

/* *ROWS: the image of upper ring RING, when all links have their phi: image.c.  *SOUND is false
 * when none has a part of it.  IL_E_NOMEM. */
il_status il_division_map_ring(il_division *d, uint32_t ring, il_rows *rows, bool *sound, il_error *err);

/* Append the cuts of all regions to PAIR: cuts.c.  IL_E_NOMEM. */
il_status il_division_record_cuts(il_division *d, il_pair *pair, il_error *err);

#endif
