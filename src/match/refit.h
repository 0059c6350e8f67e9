/* refit.h - pair records that follow their slices when these are rounded.
 *
 * For STL the slices are cleaned a second time, with coordinates rounded to
 * 32-bit floats, behind the matching.  Rings may then begin elsewhere or stand in
 * another order, and places that a record names are other places.  Two stages,
 * one before that cleaning and one behind it, carry the records over; where the
 * rings are no longer the same, vertex by vertex, the slices are matched again, by the links
 * that they had. */
#ifndef IL_MATCH_REFIT_H
#define IL_MATCH_REFIT_H

#include "match/matcher.h"

typedef struct il_refit il_refit;

/* NEXT (borrowed) gets the rounded slices with their records.  *OUT is null after
 * IL_E_NOMEM. */
il_status il_refit_new(il_refit **out, il_sink *next, il_error *err);
void il_refit_free(il_refit *r); /* null is fine */

/* The sink that the cleaning stage calls. */
il_sink *il_refit_behind(il_refit *r);

/* The sink to call, given the cleaning stage (borrowed) that ends in
 * il_refit_behind. */
il_sink *il_refit_before(il_refit *r, il_sink *cleaning);

#endif
