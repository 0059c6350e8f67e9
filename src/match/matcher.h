/* matcher.h - the stage that finds what corresponds to what between slices. */
#ifndef IL_MATCH_MATCHER_H
#define IL_MATCH_MATCHER_H

#include "model/sink.h"

/* keep_lattices: the records carry the steps of the deformation, for plots.
 * threads: at least 1; the records are the same for any number. */
typedef struct il_match_options {
    il_matcher matcher;
    bool keep_lattices;
    int threads;
} il_match_options;

#define IL_MATCH_OPTIONS_INIT { IL_MATCHER_NONE, false, 1 }

/* At most this many slices are held, with their pairs: so many less one are
 * matched at the same time.  With the matcher none, none is held. */
enum { IL_MATCH_WINDOW = 8 };

typedef struct il_ffd il_ffd;

/* Match UPPER onto LOWER, both clean; *OUT is il_pair_INIT before, or linked (model/pair.h), and owned by
 * the caller after, in the unit of the slices, empty after IL_E_NOMEM, the only
 * failure.  SOLVER is lent (ffd.h); null when the matcher is none. */
il_status il_match_slices(const il_slice *lower, const il_slice *upper, const il_match_options *o,
                          il_ffd *solver, il_pair *out, il_error *err);

/* A sink that adds the pair record where the stream brings none, nor a gap, and passes
 * all on to NEXT (borrowed) on the caller's thread, a few slices late: see
 * stage.c.  It takes the slices and records it is given.  A pair that stands
 * anywhere but right after its upper slice is IL_E_INPUT.  Terrain passes as it is.  After a failure
 * nothing is held and nothing runs; the caller may go on with stack_begin. */
il_status il_matcher_new(il_sink **out, const il_match_options *o, il_sink *next, il_error *err);
void il_matcher_free(il_sink *s); /* null is fine */

#endif
