/* join-ends.h - which ends of lines are joined with which.
 *
 * Ends are numbered: 2 p and 2 p + 1 are first and last vertex of open line p. */
#ifndef IL_REGION_JOIN_ENDS_H
#define IL_REGION_JOIN_ENDS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define IL_NO_END UINT32_MAX

/* at[2 e]: where end e is; partner[e]: the end that it is joined with, or IL_NO_END;
 * other[e]: the far end of what e ends, as far as it is joined.  place[e]: which of
 * the n_places it lies at; alive[place]: how many ends there are not joined;
 * first[place], next[e]: all of them, one after the other.
 * n_joined: pairs joined. */
typedef struct il_ends {
    double *at;
    uint32_t *partner, *other, *place, *next;
    size_t n;
    uint32_t *alive, *first;
    size_t n_places;
    size_t n_joined;
} il_ends;

#define IL_ENDS_INIT { NULL, NULL, NULL, NULL, NULL, 0, NULL, NULL, 0, 0 }

/* Room for N ends, whose places the caller puts into at; IL_E_NOMEM, empty then. */
il_status il_ends_init(il_ends *e, size_t n, il_error *err);
void il_ends_free(il_ends *e);

/* Join ends at the same place: where there are two, and where both ends of what is
 * joined so far come back to one place, however many others end there.  More than two
 * that are left are a knot, and stay apart.  What comes out does not depend on the
 * order of the lines.  Expected O(n); IL_E_NOMEM. */
il_status il_ends_join(il_ends *e, il_error *err);

/* Join A and B, which are free and lie apart, and what that brings together. */
void il_ends_join_two(il_ends *e, uint32_t a, uint32_t b);

/* Places where three or more free ends are left. */
size_t il_ends_knots(const il_ends *e);

#endif
