/* linkage.h - which regions of a whole stack belong together, from slice to slice.
 *
 * Regions that overlap always do.  Where slices are far apart for what is slanted, parts of
 * one body do not overlap; then the gap between outlines, in heights of the slab, tells best
 * (prediction by velocity, slant or shape adds nothing).  A gap below `free` links; wider ones,
 * by increasing gap, only where they join two parts still separate in the whole stack, onto
 * a part that dominates it, up to `reach`.  Never does such a link close a loop (Kruskal). */
#ifndef IL_MATCH_LINKAGE_H
#define IL_MATCH_LINKAGE_H

#include "model/pair.h"
#include "model/stack.h"

/* Gaps in heights of the slab.  dominant: the share of the stack's volume that a part must
 * have to be joined onto; small: of the volume of the dominant one, what the joined part must
 * be below. */
typedef struct il_linkage_options {
    double free, reach, dominant, small;
} il_linkage_options;

#define IL_LINKAGE_OPTIONS_INIT { 0.1, 0.75, 0.25, 0.25 }

/* How many pieces a stack should come out in: reach 0.75, which never harmed what is not a
 * vessel; 4, for vessels, where all is one piece; 0, overlaps alone, which need not know the
 * whole stack. */
typedef enum il_pieces { IL_PIECES_USUAL, IL_PIECES_FEW, IL_PIECES_OVERLAP } il_pieces;
il_linkage_options il_linkage_options_for(il_pieces pieces);

/* link[first[k]] .. link[first[k + 1]]: the links of slab k, between outer rings of slices k and
 * k + 1, and of holes (complement.h), rising.  reach: the gap, unit. */
typedef struct il_linkage {
    il_link *link;
    size_t *first;
} il_linkage;

#define IL_LINKAGE_INIT { NULL, NULL }
void il_linkage_free(il_linkage *l); /* safe twice */

/* Link slice[n], clean and rising; no link crosses a slab k with parted[k].  O(n log n) for
 * contours but for the rings whose boxes are as near as gaps may be wide.  IL_E_NOMEM. */
il_status il_linkage_find(il_linkage *out, const il_slice *slice, size_t n, const bool *parted,
                        const il_linkage_options *o, il_error *err);

#endif
