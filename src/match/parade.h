/* parade.h - a few slices in their order, with the pairs between them, matched by all threads.
 *
 * A pair needs its two slices as they came, and whoever gets a slice may take
 * it: so a slice stays until the pairs below and above it are settled, and
 * then leaves whole.  Nothing is copied. */
#ifndef IL_MATCH_PARADE_H
#define IL_MATCH_PARADE_H

#include "base/threads.h"
#include "match/matcher.h"

typedef enum il_pair_state {
    IL_PAIR_UNKNOWN,          /* the stream may still bring it */
    IL_PAIR_WAITING,          /* to be matched */
    IL_PAIR_MATCHING,
    IL_PAIR_SETTLED           /* matched, brought, or there is none */
} il_pair_state;

/* A slice and what follows it in the stream: the pair of the slice below and
 * this one.  has_pair: not for the first slice.  When status is not IL_OK the
 * pair failed, and error says why. */
typedef struct il_parade_place {
    il_slice slice;
    il_pair pair;
    bool has_pair;
    il_pair_state state;
    il_status status;
    il_error error;
} il_parade_place;

/* Slices first .. first + n - 1 of the stack are held; slice p is
 * place[p % IL_MATCH_WINDOW].  idle[n_idle]: solvers that no thread uses; as a
 * thread takes one at a time, there are never more than threads.  All fields
 * but options belong to the crew's mutex. */
typedef struct il_parade {
    il_match_options options;
    il_parade_place place[IL_MATCH_WINDOW];
    size_t first, n;
    bool cancelled;
    il_ffd **idle;
    size_t n_idle;
    il_crew crew;
} il_parade;

/* An empty parade with O's threads, at least one.  IL_E_NOMEM, or what the crew
 * answers (base/threads.h); nothing is left to stop then. */
il_status il_parade_start(il_parade *p, const il_match_options *o, il_error *err);
void il_parade_stop(il_parade *p);    /* ends the threads, frees all; safe on a zeroed parade */

/* With the crew's mutex held, from here on. */

/* Append a slice (taken over); there must be room (n < IL_MATCH_WINDOW), and
 * the pair of the last two must have been told. */
void il_parade_push(il_parade *p, il_slice *slice);

/* The pair of the last two slices, once: the stream brought it (taken over), or
 * null: it is to be matched. */
void il_parade_pair(il_parade *p, il_pair *pair);

/* May the first slice leave?  Its pair is settled, and so is that with the slice
 * above, if one is held. */
bool il_parade_ready(const il_parade *p);

/* The first place leaves; the caller frees it, with il_parade_place_free. */
il_parade_place il_parade_pop(il_parade *p);
void il_parade_place_free(il_parade_place *place);

/* Forget the stack: waits for running work, then empties the parade. */
void il_parade_clear(il_parade *p);

#endif
