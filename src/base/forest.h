/* forest.h - which of N things belong together: union-find in an array.
 *
 * up[i] leads towards the leader of i's set, the least of its members, so that
 * the outcome does not depend on the order of joining.  Path halving (van Leeuwen
 * & van der Weide 1977): O(log n) a step, amortised. */
#ifndef IL_BASE_FOREST_H
#define IL_BASE_FOREST_H

#include <stddef.h>
#include <stdint.h>

/* N sets of one: up[N]. */
static inline void il_forest_plant(uint32_t *up, size_t n)
{
    for (size_t i = 0; i < n; i++)
        up[i] = (uint32_t)i;
}

static inline uint32_t il_forest_leader(uint32_t *up, uint32_t i)
{
    while (up[i] != i)
        i = up[i] = up[up[i]];
    return i;
}

static inline void il_forest_join(uint32_t *up, uint32_t a, uint32_t b)
{
    a = il_forest_leader(up, a);
    b = il_forest_leader(up, b);
    if (a < b)
        up[b] = a;
    else
        up[a] = b;
}

#endif
