/* given.h - the links of a stack as the user says them. */
#ifndef IL_MATCH_GIVEN_H
#define IL_MATCH_GIVEN_H

#include "match/linkage.h"
#include "model/given.h"

/* *OUT: all links that stack S of G names, of slice[n], clean and rising; known[k]: a gap's record,
 * or null.  A slab is the one whose slices lie where it says, to within a thousandth of its
 * height.  What a line says of a link stays if it is true of its rings: `overlap` of regions that
 * overlap, another reason of outlines that are REACH apart; of a hole anything.  Else the reason
 * is GIVEN, and the reach is measured.  IL_E_INPUT, with G's file and the line, for slabs and rings
 * that there are not, and for a slab or link that stands twice; IL_E_NOMEM.  O(n log n). */
il_status il_linkage_given(il_linkage *out, const il_slice *slice, size_t n, const il_pair *const *known,
                           const il_given *g, const il_given_stack *s, il_error *err);

#endif
