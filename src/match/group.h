/* group.h - one group of rings matched: phi, and what corresponds to what. */
#ifndef IL_MATCH_GROUP_H
#define IL_MATCH_GROUP_H

#include "match/rows.h"
#include "model/stack.h"

/* Two slices at work: PAIR is their record, outer[side][r] the outer ring of ring r's region
 * (null: no group needs it), image[r] gets the rows of upper ring r in the stack's unit.
 * keep_lattices: leave the steps in the fits, but of divided groups.  All borrowed. */
typedef struct il_group_work {
    il_pair *pair;
    const il_slice *slice[2];
    const uint32_t *outer[2];
    il_ffd *solver;
    bool keep_lattices;
    il_rows *image;
} il_group_work;

/* Match group G of the pair, which has rings on both sides: sets its fit, appends its
 * matched and unmatched arcs and its cuts to the pair, and fills the image of its upper rings.
 * All in the stack's unit.  IL_E_NOMEM: pair and image are only good to be freed. */
il_status il_group_match(const il_group_work *w, il_group *g, il_error *err);

#endif
