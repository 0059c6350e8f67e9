/* judge.h - how good a deformation is: measured by brute force, in doubles, from
 * nothing but the outlines and the deformation itself. */
#ifndef IL_TESTS_BENCH_JUDGE_H
#define IL_TESTS_BENCH_JUDGE_H

#include "model/pair.h"
#include "../pairs.h"

#include <stdbool.h>

/* Lengths in cells of the frame.  up: distances from phi(upper) to the lower
 * outline; down: from the lower outline to phi(upper).  least_jacobian: of phi,
 * over a grid of 1 cell near the upper outline, of 4 cells elsewhere, and on the
 * outline.  distortion: root mean square of log stretch along the upper outline.
 * off_truth: mean distance of phi(upper vertex) from where it belongs, NaN where
 * that is not known. */
typedef struct judged {
    double up_mean, up_max, down_mean, down_max;
    double least_jacobian, distortion, off_truth;
} judged;

judged judge(const pairs_pair *p, const il_fit *phi);

/* The outlines lie on each other, and nothing is folded. */
bool judged_solved(const judged *j);

/* The distance from (X, Y) to the outline's edges. */
double judge_distance(const pairs_outline *o, double x, double y);

/* Is (X, Y) inside, by the even-odd rule? */
bool judge_inside(const pairs_outline *o, double x, double y);

#endif
