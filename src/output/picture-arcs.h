/* picture-arcs.h - the arcs of a pair as lines: where they run, where phi takes
 * them, and what corresponds to what along them. */
#ifndef IL_OUTPUT_PICTURE_ARCS_H
#define IL_OUTPUT_PICTURE_ARCS_H

#include "model/pair.h"
#include "model/stack.h"

/* A part of a ring: n points xy[2*n] of it, and phi[2*n] of these.  For the lower
 * slice, and where there is no phi, both are the same. */
typedef struct il_trace {
    double *xy, *phi;
    size_t n, cap_xy, cap_phi;
} il_trace;

#define IL_TRACE_INIT { NULL, NULL, 0, 0, 0 }
void il_trace_free(il_trace *t);

/* A pair with its slices, all borrowed.  row[i]: the first phi row of upper ring
 * i, row[n] their number; null without phi.  budget: points that may still be
 * traced, for arcs that lie over one another would make the work quadratic. */
typedef struct il_arcs {
    const il_slice *lower, *upper;
    const il_pair *pair;
    size_t *row;
    size_t budget;
    il_trace from, to;              /* of the match at hand */
    double *sample, *cost;          size_t cap_sample, cap_cost;
    uint32_t *back;                 size_t cap_back;
} il_arcs;

#define IL_ARCS_INIT { 0 }

il_status il_arcs_open(il_arcs *a, const il_slice *lower, const il_slice *upper, const il_pair *pair, il_error *err);
void il_arcs_free(il_arcs *a); /* safe twice */

/* ARC of the upper or the lower slice.  IL_E_INPUT when the arcs traced so far
 * are longer together than arcs that do not overlap can be; IL_E_NOMEM. */
il_status il_arcs_trace(il_arcs *a, bool upper, const il_arc *arc, il_trace *out, il_error *err);

/* Points of M about SPACING apart along the upper arc, each with its partner:
 * sample[4*i]: x and y of the upper one, x and y of the lower.  The partners are
 * those that make the sum of |phi(u) - l|^2 least while they run along the lower
 * arc without turning back (dynamic programming over places FINENESS apart).
 * *N: how many; none for an arc much shorter than SPACING. */
il_status il_arcs_links(il_arcs *a, const il_match *m, double spacing, double fineness, size_t *n, il_error *err);

/* The length of the N points xy[2*n], joined. */
double il_trace_length(const double *xy, size_t n);

#endif
