/* under.h - which edge of a slice lies next below a place: what regions are nested by. */
#ifndef IL_MATCH_UNDER_H
#define IL_MATCH_UNDER_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* The edges a[e] to b[e] of a clean slice, which meet in their ends only, with
 * their boxes box[4*n] (all borrowed); a tree of boxes over them as they follow
 * each other, which in canonical order is from left to right. */
typedef struct il_under {
    const double *const *a, *const *b, *box;
    size_t n, n_leaves;
    double *node;             /* [4 * (2 * n_leaves - 1)], children 2 k + 1 and 2 k + 2 */
} il_under;

#define IL_UNDER_INIT { 0 }
/* O(n); IL_E_NOMEM leaves nothing to free. */
il_status il_under_make(il_under *u, const double *const *a, const double *const *b, const double *box, size_t n, il_error *err);
void il_under_free(il_under *u);

/* The highest edge strictly below the point P (of those that end straight below
 * it, the ones that go on to the right); n when there is none.  Exact.  O(log n)
 * for contours. */
size_t il_under_point(const il_under *u, const double p[2]);

/* The next edge below edge E at the right of its left end, or (AT_RIGHT) at the
 * left of its right end; n when there is none. */
size_t il_under_edge(const il_under *u, size_t e, bool at_right);

#endif
