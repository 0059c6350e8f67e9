/* global.h - where a deformation starts: shift, scale, stretch and turn in closed form.
 *
 * In place of the mutual information of the paper's source, which is searched for
 * by descent: the moments of the two regions say the same in microseconds. */
#ifndef IL_MATCH_GLOBAL_H
#define IL_MATCH_GLOBAL_H

#include "match/ffd.h"

/* (x, y) goes to (a[0] x + a[1] y + a[4], a[2] x + a[3] y + a[5]). */
typedef struct il_global {
    double a[6];
} il_global;

#define IL_GLOBAL_IDENTITY { { 1, 0, 0, 1, 0, 0 } }

/* The affine map without rotation that takes the area, centroid and second
 * moments of UPPER to those of LOWER (the optimal transport of their ellipses:
 * Olkin & Pukelsheim 1982), or scale and shift where that would stretch one way
 * more than 2.5 times as much as the other: a bar that bends is no wider bar.
 * False when either has no area, or less than 1 / 64^2 of the other's. */
bool il_global_by_moments(const il_outline *lower, const il_outline *upper, il_global *g);

/* As scale and shift, and the turn by at most 90 degrees that makes the greatest
 * radii by direction most alike; false when it does not bring them to below 0.7
 * of how different they are without. */
bool il_global_with_turn(const il_outline *lower, const il_outline *upper, il_global *g);

#endif
