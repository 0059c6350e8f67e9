/* join-prune.h - pieces that bring an odd number of ends together. */
#ifndef IL_REGION_JOIN_PRUNE_H
#define IL_REGION_JOIN_PRUNE_H

#include "region/join-pieces.h"

/* Leave out of P, the pieces of S by E:
 *   necks   where coordinates were rounded, two stretches of lines that passed each other
 *           closely lie on the same edges and run in opposite directions.  Nothing is
 *           between them: both go, so that what is before them is joined across;
 *   stubs   where sheets overlap, a line may go on for one edge behind the stretch that it
 *           shares, to the end of its sheet, beside the other sheet's line.
 * Counted into REPORT (may be null).  Expected O(n); IL_E_NOMEM. */
il_status il_pieces_prune(il_pieces *p, const il_slice *s, const il_shared_edges *e, il_report *report, il_error *err);

#endif
