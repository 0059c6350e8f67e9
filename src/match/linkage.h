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
 * be below.  slants: links are told that slant (link.h). */
typedef struct il_linkage_options {
    double free, reach, dominant, small;
    bool slants;
} il_linkage_options;

#define IL_LINKAGE_OPTIONS_INIT { 0.1, 0.75, 0.25, 0.25, false }

/* In a slab with more pairs of regions within reach, for each of its regions, gaps reach half as far, or a quarter
 * and so on: joining over so many that are nearer means nothing, and time would grow with the square of the
 * regions.  With 128 regions a slice there are never more. */
enum { IL_LINKAGE_NEAR = 64 };

/* USUAL: reach 0.75, which never harmed what is not a vessel; FEW: 4, for vessels, where all is
 * one piece; OVERLAP: 0, overlaps alone, which need not know the whole stack.
 * Slanted vessels of which no two slices overlap are many parts of about one size, so a tenth
 * of the volume is enough to be joined onto, and what is joined may be as large; and they are
 * trees, so that what does not overlap closes no loop, however near it lies.  On the trees of
 * tests/t-trees.c that have 78 to 100 % of their links without overlap, F1 of the links rises
 * from 0.58 to 0.90 by the former; by the latter all links are right in 428 instead of 386 stacks
 * of 599, 1 to 4 mean diameters apart.  Neither changes anything on scanned portal veins. */
il_linkage_options il_linkage_options_for(il_pieces_mode pieces);

/* link[first[k]] .. link[first[k + 1]]: the links of slab k, between outer rings of slices k and
 * k + 1, and of holes (complement.h), rising.  reach: the gap, unit. */
typedef struct il_linkage {
    il_link *link;
    size_t *first;
} il_linkage;

#define IL_LINKAGE_INIT { NULL, NULL }
void il_linkage_free(il_linkage *l); /* safe twice */

/* Link slice[n], clean and rising.  known[k]: the record that slab k has already, or null:
 * then it gets no links, but what its groups join is one part, and without groups what
 * overlaps; a gap joins nothing.  O(n log^2 n) for contours.  IL_E_NOMEM. */
il_status il_linkage_find(il_linkage *out, const il_slice *slice, size_t n, const il_pair *const *known,
                          const il_linkage_options *o, il_error *err);

#endif
