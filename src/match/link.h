/* link.h - which rings of two slices belong together.
 *
 * A ring goes with its region: an outer ring and the holes in it.  Regions of
 * the two slices that overlap or touch are linked, and what is linked, directly
 * or through others, is one group. */
#ifndef IL_MATCH_LINK_H
#define IL_MATCH_LINK_H

#include "model/pair.h"
#include "model/stack.h"

/* Append all groups of the clean slices LOWER and UPPER to PAIR: every ring is in
 * one, rings rising; groups by their first lower ring, behind them those without
 * by their first upper ring.  Links stand between outer rings of overlapping
 * regions; exact.  O(n log n) for contours, after the pairs of edges whose boxes
 * meet.  IL_E_NOMEM: PAIR is only good to be freed. */
il_status il_link_slices(il_pair *pair, const il_slice *lower, const il_slice *upper, il_error *err);

#endif
