/* group.h - which rings of two neighbouring slices are lofted together.
 *
 * A pair record names groups of rings that belong together; each is lofted by
 * itself.  Groups whose surfaces meet are joined, so numbers of groups are
 * those of the record at first, and of the least of those joined later on. */
#ifndef IL_LOFT_GROUP_H
#define IL_LOFT_GROUP_H

#include "base/status.h"
#include "model/pair.h"

/* of[side][r]: the group of ring r; up[n]: groups that were joined (base/forest.h). */
typedef struct il_groups {
    uint32_t *of[2];
    size_t n_rings[2];
    uint32_t *up;
    size_t n;
} il_groups;

#define IL_GROUPS_INIT { { NULL, NULL }, { 0, 0 }, NULL, 0 }
void il_groups_free(il_groups *g);

/* The groups of PAIR, which is null or between slices of n_rings[2] rings.  Its
 * own come first, in order; then every ring of the lower slice that is in none,
 * then those of the upper.  With the matcher none, with no groups, and without
 * a pair all rings are group 0. */
il_status il_groups_find(il_groups *g, const il_pair *pair, const size_t n_rings[2], il_error *err);

/* The rings of one side by groups: group g (a leader, or it has none) has those
 * in ring[first[g]] .. ring[first[g + 1] - 1], rising. */
typedef struct il_group_rings {
    uint32_t *first, *ring;
} il_group_rings;

/* As the groups are joined now. */
il_status il_group_rings_list(il_group_rings *l, il_groups *g, int side, il_error *err);
void il_group_rings_free(il_group_rings *l);

#endif
