/* link.h - which rings of two slices belong together.
 *
 * A ring goes with its region: an outer ring and the holes in it.  Regions of
 * the two slices that overlap or touch are linked, and what is linked, directly
 * or through others, is one group. */
#ifndef IL_MATCH_LINK_H
#define IL_MATCH_LINK_H

#include "model/pair.h"
#include "model/stack.h"

/* outer[n]: of each ring of the clean slice S the outer ring of its region.  IL_E_NOMEM. */
il_status il_link_outers(const il_slice *s, uint32_t *outer, il_error *err);

/* The regions of the clean slices LOWER and UPPER that overlap or touch, exactly: *LINK, the
 * caller's to il_free, 2 * *N outer rings, lower and upper, rising, each pair once.
 * O(n log n) for contours, after the pairs of edges whose boxes meet.  IL_E_NOMEM. */
il_status il_link_overlaps(const il_slice *lower, const il_slice *upper, uint32_t **link, size_t *n, il_error *err);

/* Append all groups of LOWER and UPPER to PAIR, as link[n] (rising, between outer rings, and as
 * il_complement_link adds them) joins regions: every ring is in one, rings rising; groups by their first lower ring, behind them
 * those without by their first upper ring.  IL_E_NOMEM: PAIR is only good to be freed. */
il_status il_link_group(il_pair *pair, const il_slice *lower, const il_slice *upper, const il_link *link, size_t n, il_error *err);

/* Of links between outer rings that overlap those say that they slant (IL_LINK_SLANT) of which
 * less than 0.3 of the lesser does, or whose group has links to regions that lie apart too: so
 * it is with vessels.  IL_E_NOMEM. */
il_status il_link_slants(il_pair *pair, const il_slice *lower, const il_slice *upper, il_error *err);

/* Both, by overlaps alone. */
il_status il_link_slices(il_pair *pair, const il_slice *lower, const il_slice *upper, il_error *err);

#endif
