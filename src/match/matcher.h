/* matcher.h - the stage that finds what corresponds to what between slices. */
#ifndef IL_MATCH_MATCHER_H
#define IL_MATCH_MATCHER_H

#include "model/sink.h"

/* keep_lattices: the records carry the steps of the deformation, for plots. */
typedef struct il_match_options {
    il_matcher matcher;
    bool keep_lattices;
} il_match_options;

typedef struct il_ffd il_ffd;

/* Match UPPER onto LOWER, both clean; *OUT is il_pair_INIT before and owned by
 * the caller after, empty after failure.  SOLVER is lent (ffd.h); null when the
 * matcher is none. */
il_status il_match_slices(const il_slice *lower, const il_slice *upper, const il_match_options *o,
                          il_ffd *solver, il_pair *out, il_error *err);

/* A sink that adds the pair record where the stream brings none, and passes
 * all on to NEXT (borrowed).  Keeps copies of two slices.  A pair that stands
 * anywhere but right after its upper slice is IL_E_INPUT. */
il_status il_matcher_new(il_sink **out, const il_match_options *o, il_sink *next, il_error *err);
void il_matcher_free(il_sink *s); /* null is fine */

#endif
