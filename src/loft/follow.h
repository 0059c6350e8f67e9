/* follow.h - which groups of a slab follow phi, and phi as it is then.
 *
 * The surface of a group whose phi is not trusted is made as the slices lie, and so is that
 * of one that was in the way of others.  Groups that are joined are lofted over one reference
 * plane, so their phis are put together: rings of groups that follow at phi, others at rest. */
#ifndef IL_LOFT_FOLLOW_H
#define IL_LOFT_FOLLOW_H

#include "loft/group.h"
#include "loft/phi.h"

/* phi: the rows of the record, and of rings that do not follow their vertices where they lie;
 * its pair is null when there is no phi that could be used.  group[]: does each group of the
 * record follow?  rows: the record with rows of its own.  What is given is borrowed. */
typedef struct il_follow {
    il_phi phi;
    const il_pair *pair;
    const il_section *upper;
    const uint32_t *group_of; /* [upper rings] */
    bool *group, *rests;      /* rests[upper rings]: those that were dropped alone */
    il_pair rows;
} il_follow;

/* Of PAIR (or null), whose upper slice is UPPER with its ring r in group group_of[r].  All
 * groups follow that are trusted (model/pair.h).  IL_E_NOMEM: F is only good to be freed. */
il_status il_follow_begin(il_follow *f, const il_pair *pair, const il_section *upper, const uint32_t *group_of, il_error *err);
void il_follow_free(il_follow *f);

/* Upper ring R does not follow any more, or does again.  IL_E_NOMEM likewise. */
il_status il_follow_rest(il_follow *f, uint32_t r, bool rests, il_error *err);

/* Does matched arc I, of group G, hold for G as it follows or not? */
bool il_follow_holds(const il_follow *f, size_t i, uint32_t g);

#endif
