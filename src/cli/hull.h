/* hull.h - the convex hull of many points, which need not be held. */
#ifndef IL_CLI_HULL_H
#define IL_CLI_HULL_H

#include <stdbool.h>
#include <stddef.h>

enum { IL_HULL_ROOM = 4096, IL_HULL_SIDES = 256 };

/* xy[2 * n]: the hull so far, counter-clockwise, and behind its n_hull points those that
 * may be outside of it.  Points in the box from inner[0], inner[1] to inner[2], inner[3]
 * are in the hull.  across[k], once it is settled: how wide the hull is behind its side k,
 * times the length of that. */
typedef struct il_hull {
    double *xy;
    size_t n, n_hull;
    double inner[4], across[IL_HULL_SIDES];
} il_hull;

#define IL_HULL_INIT { .inner = { 1, 1, 0, 0 } }

/* Points XY[2 * N], finite, are in it, too.  False without memory. */
bool il_hull_add(il_hull *o, const double *xy, size_t n);

/* All are in it; corners beyond IL_HULL_SIDES, of those that stand out little, are left
 * out.  False without memory. */
bool il_hull_settle(il_hull *o);

/* Is P, one of the points, farther from every side than SHARE of how wide the hull is
 * across that side?  Never, where the hull encloses nothing. */
bool il_hull_is_inside(const il_hull *o, const double *p, double share);

void il_hull_free(il_hull *o); /* safe twice */

#endif
