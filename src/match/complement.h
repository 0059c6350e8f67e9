/* complement.h - which holes of two slices go together, and which open to the outside.
 *
 * What lies about the solid is linked as the solid is: rings bound one piece of the surface
 * between two slices when the solid on one side of them and what is on the other both hang
 * together in the slab. */
#ifndef IL_MATCH_COMPLEMENT_H
#define IL_MATCH_COMPLEMENT_H

#include "model/pair.h"
#include "model/stack.h"

/* To the links between outer rings of the clean slices LOWER and UPPER, *LINK with *N of them
 * (il_alloc's), add those of holes; they come out rising by lower and upper ring.
 *
 * Holes that overlap are linked (IL_LINK_OVERLAP).  A hole of a linked region opens
 * (IL_LINK_OPENING) to an outer ring of the regions that its own is linked to, directly or
 * through others, when a fiftieth of it lies outside all outer rings of the other slice, or
 * more than half where it has a hole to go on to: as it lies where the regions overlap by
 * 0.3 of the lesser, else moved by the mean of where their links would take it.  So does
 * every hole that hangs together with one that opens.  The ring is the nearest of those that
 * its own region is linked to, or else of all; reach is the distance of the two as they lie.
 * Links keep to groups: between regions that are not linked there is none, whatever their holes
 * do.
 * O(n log n) for contours; nothing to do without holes.  IL_E_NOMEM: *LINK and *N stay. */
il_status il_complement_link(il_link **link, size_t *n, const il_slice *lower, const il_slice *upper, il_error *err);

#endif
