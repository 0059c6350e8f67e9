/* phi.h - the deformation of a pair record, at any place of the upper slice. */
#ifndef IL_LOFT_PHI_H
#define IL_LOFT_PHI_H

#include "loft/section.h"
#include "model/pair.h"

/* first[r] .. first[r + 1]: the rows of ring r in pair->phi.  pair is null when
 * there is no phi that could be used. */
typedef struct il_phi {
    const il_pair *pair;
    size_t *first;
} il_phi;

#define IL_PHI_INIT { NULL, NULL }
void il_phi_free(il_phi *phi);

/* Index the rows of PAIR (or null; borrowed), whose upper slice is UPPER.  Rows
 * that are not what formats/loft.txt asks for, or numbers beyond 1e100, leave
 * phi->pair null. */
il_status il_phi_index(il_phi *phi, const il_pair *pair, const il_section *upper, il_error *err);

/* The first row of AT's ring behind AT, or that behind the ring's last.  O(log n). */
size_t il_phi_row_after(const il_phi *phi, il_place at);

/* Where phi takes the place AT: straight between rows. */
void il_phi_at(const il_phi *phi, il_place at, double out[2]);

#endif
