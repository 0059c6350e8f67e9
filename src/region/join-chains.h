/* join-chains.h - pieces that are joined, as lines and rings. */
#ifndef IL_REGION_JOIN_CHAINS_H
#define IL_REGION_JOIN_CHAINS_H

#include "region/join-ends.h"
#include "region/join-pieces.h"

/* What a level's lines are made of: open_piece[k] is the piece whose ends are 2 k and
 * 2 k + 1 of ENDS.  All are borrowed. */
typedef struct il_chains {
    il_slice *slice;
    const il_shared_edges *edges;
    const il_pieces *pieces;
    const il_ends *ends;
    const uint32_t *open_piece;
} il_chains;

/* Make of the pieces and their joints the lines of C's slice anew.  A joined line runs
 * as most of its length did, or, when neither way is longer, so that its sequence is
 * least; a bridged gap is a straight edge.  Private lines go to the line that begins
 * with theirs or has a piece of it, or to the slice's when there is none.  Pieces
 * turned round are counted into REPORT (may be null).  O(n); IL_E_NOMEM, and the slice
 * can be freed then. */
il_status il_chains_make(const il_chains *c, il_report *report, il_error *err);

#endif
