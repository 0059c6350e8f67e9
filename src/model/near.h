/* near.h - points that keep a cell apart, and the one that is near a place. */
#ifndef IL_MODEL_NEAR_H
#define IL_MODEL_NEAR_H

#include "base/keymap.h"
#include "base/status.h"
#include "model/stack.h"

/* Points xy[2*n], found by the boxes of side `cell` that they lie in; of several
 * in one box the first is found. */
typedef struct il_near {
    double cell;
    double *xy;            size_t n, cap;
    il_keymap in_box;
} il_near;

#define IL_NEAR_INIT { 0 }
void il_near_free(il_near *m);

/* The point nearer to (X, Y) than a cell in both x and y, the nearest of several;
 * UINT32_MAX when there is none. */
uint32_t il_near_find(const il_near *m, double x, double y);

/* Add a point, which gets the number n; false without memory. */
bool il_near_add(il_near *m, double x, double y);

/* Make points of S that are near one another equal: each, by rising x, then y,
 * goes to one that stayed, if any is near.  So all positions of S are a cell
 * apart, whatever the order of its rings.  *N_MOVED counts those that moved,
 * *N_JOINED those of them that did not join a neighbour in their ring.  O(n log n). */
il_status il_slice_gather(il_slice *s, double cell, size_t *n_moved, size_t *n_joined, il_error *err);

#endif
