/* crowd.h - the groups of a slab: each lofted alone, then put together.
 *
 * A surface that is sound by itself may run into another group's.  Groups that
 * meet are joined and tried again as one, until none meet; the last resort is
 * one group of everything, as the slices lie. */
#ifndef IL_LOFT_CROWD_H
#define IL_LOFT_CROWD_H

#include "loft/attempt.h"
#include "loft/follow.h"

/* A group at work: its rings as sections of their own, with the numbers that
 * their nodes and stations have in the whole sections (null: the same ones). */
typedef struct il_member {
    il_section section[2];
    uint32_t *node_of[2], *station_of[2];
    il_outcome outcome;
    bool settled;
} il_member;

/* member[groups.n], in use where a group leads others or stands alone. */
typedef struct il_crowd {
    const il_section *whole[2];
    const il_pair *pair;
    il_follow follow;
    bool round_float;
    il_groups groups;
    il_member *member;
} il_crowd;

/* The groups of PAIR (or null); all that is given is borrowed. */
il_status il_crowd_gather(il_crowd *c, const il_section *lower, const il_section *upper,
                          const il_pair *pair, bool round_float, il_error *err);

/* *OUT, empty before: the surface of all groups, over the whole sections, in
 * the order of the groups.  IL_OK with a flaw in *VERDICT when nothing passed. */
il_status il_crowd_settle(il_crowd *c, il_surface *out, il_verdict *verdict, il_error *err);

/* After settling: add the lengths of the contours to length_by[] under the
 * attempts that settled them, and to *ALONE for groups on one side only. */
void il_crowd_measure(const il_crowd *c, double length_by[IL_N_ATTEMPTS], double *alone);

void il_crowd_free(il_crowd *c);

#endif
