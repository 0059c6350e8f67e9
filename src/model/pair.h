/* pair.h - all that is known between two neighbouring slices.
 *
 * The upper slice is matched onto the lower: phi takes a point of the upper
 * slice to the plane of the lower.  Places on a ring are written (ring, vertex,
 * t): the point (1 - t) v + t w on the edge from vertex v to its successor w,
 * 0 <= t < 1; rings and vertices count from 0 as in the normalised stream. */
#ifndef IL_MODEL_PAIR_H
#define IL_MODEL_PAIR_H

#include "model/ring.h"

typedef struct il_place {
    uint32_t ring, vertex;
    double t;
} il_place;

/* phi of the upper slice's point at PLACE, in the stack's unit. */
typedef struct il_phi_point {
    il_place at;
    double x, y;
} il_phi_point;

/* From FROM to TO along the ring's direction; FROM equal to TO is the whole ring. */
typedef struct il_arc { il_place from, to; } il_arc;

/* The arcs correspond, ends to ends; residual: distance of phi(upper arc) from
 * the lower arc, mean and largest, in the stack's unit. */
typedef struct il_match {
    il_arc lower, upper;
    double residual_mean, residual_max;
} il_match;

typedef enum il_event { IL_EVENT_BRANCH, IL_EVENT_CAP, IL_EVENT_HOLE } il_event;

/* An arc without a partner, and what it was taken for. */
typedef struct il_unmatched {
    bool upper;              /* whose arc it is */
    il_arc arc;
    il_event event;
} il_unmatched;

typedef enum il_matcher { IL_MATCHER_NONE, IL_MATCHER_FFD } il_matcher;

/* How a group of corresponding rings was settled: see design "attempts". */
typedef enum il_attempt { IL_ATTEMPT_S, IL_ATTEMPT_P, IL_ATTEMPT_B, IL_N_ATTEMPTS } il_attempt;

/* Rings that belong together, as indices into the two slices; owned. */
typedef struct il_group {
    uint32_t *lower, *upper;
    size_t n_lower, n_upper;
} il_group;

/* matcher NONE: phi is the identity and phi[] is empty.  Otherwise phi[] has a
 * point for every vertex of the upper slice and more where an edge bends, in
 * order of place.  Rings in no group are groups of their own; no group at all
 * (n_groups 0) means that all rings form one.  distortion: root mean square of
 * the log stretch; least_jacobian > 0 when phi is one-to-one. */
typedef struct il_pair {
    il_matcher matcher;
    il_group *group;          size_t n_groups, cap_groups;
    il_phi_point *phi;        size_t n_phi, cap_phi;
    il_match *match;          size_t n_matches, cap_matches;
    il_unmatched *unmatched;  size_t n_unmatched, cap_unmatched;
    double residual_up_mean, residual_up_max;      /* phi(upper) to lower, unit */
    double residual_down_mean, residual_down_max;  /* lower to phi(upper), unit */
    double least_jacobian, distortion;
    uint32_t steps;
    long line;
    il_extra *extra;
} il_pair;

#define IL_PAIR_INIT { 0 }
void il_pair_free(il_pair *p);

#endif
