/* wrap.h - one outline laid round another in the order of its points.
 *
 * Where no smooth map with a bearable distortion takes a piece to its partner, the order along
 * the outlines still tells what corresponds: both are walked once round, in step with each
 * other by dynamic time warping (Sakoe & Chiba 1978) of the one, brought to the other's moments,
 * against the other.  The image is the other outline itself, so it never folds. */
#ifndef IL_MATCH_WRAP_H
#define IL_MATCH_WRAP_H

#include "base/nearest.h"
#include "match/piece.h"

enum { IL_WRAP_STEPS = 96 };

/* Rings in order from a first point: xy[2*n], along[n + 1] the length up to each point;
 * edges: by their first points. */
typedef struct il_loop {
    double *xy, *along;
    size_t n;
    il_nearest edges;
} il_loop;

/* at[i]: where the place i / IL_WRAP_STEPS along `from` goes, in steps along `to`, rising;
 * the last is the first and one round. */
typedef struct il_wrap {
    il_loop from, to;
    double at[IL_WRAP_STEPS + 1];
} il_wrap;

/* A place of `from` that should go to a place of `to`, unit: where the piece meets the next one. */
typedef struct il_anchor { double from[2], to[2]; } il_anchor;

/* Wrap FROM round TO, both counter-clockwise; copies are kept; anchor[N] pull.  *SIMPLE is false when
 * one of them is not a single ring.  IL_E_NOMEM. */
il_status il_wrap_begin(il_wrap *w, const il_piece *from, const il_piece *to, const il_anchor *anchor, size_t n,
                        bool *simple, il_error *err);
void il_wrap_free(il_wrap *w);

/* How unevenly it stretches: the root mean square of the log of the stretch over its mean. */
double il_wrap_distortion(const il_wrap *w);

/* Take P, on FROM's outline or near it, to TO's.  O(log n). */
void il_wrap_apply(const il_wrap *w, double p[2]);

#endif
