/* spots.h - the spot heights of a terrain: points whose height is known. */
#ifndef IL_MODEL_SPOTS_H
#define IL_MODEL_SPOTS_H

#include "model/report.h"
#include "model/stack.h"

/* Sort S[0..N) by x, then y, then where they came from: file, feature, line, height. */
void il_spots_sort(il_spot *s, size_t n);

/* Do A and B stand at one place? */
static inline bool il_spots_meet(const il_spot *a, const il_spot *b)
{
    return a->x == b->x && a->y == b->y;
}

/* Put the spot heights of H, in any order, into the one that heads promise.  Of those that
 * are the same the first stays, which is told; where heights differ at one place all are
 * left out, each counted as skipped.  REPORT may be null.  O(n log n). */
void il_stack_head_settle_spots(il_stack_head *h, il_report *report);

#endif
