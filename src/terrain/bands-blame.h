/* bands-blame.h - which line is to blame for a border that goes wrong.
 *
 * Each line that may be is left out for trial, and what hangs on it settled again.  That one
 * is to blame without which the fewest borders go wrong; of equal ones the one without which
 * the fewest levels are missing; then the one that another level would put right best (a
 * wrong height is the commonest of errors); then the shorter one; then the first. */
#ifndef IL_TERRAIN_BANDS_BLAME_H
#define IL_TERRAIN_BANDS_BLAME_H

#include "terrain/bands-settle.h"

/* wrong: borders that may go wrong, in the order in which they were found so. */
typedef struct il_blamer {
    il_bands_graph *graph;
    il_settler *settler;
    il_merger *merger;
    uint32_t *start, *stamp, *face_stamp;
    il_around *saved;
    uint32_t *wrong;        size_t n_wrong, cap_wrong;
    size_t n_start;
    uint32_t epoch, face_epoch;
} il_blamer;

il_status il_blamer_make(il_blamer *m, il_bands_graph *g, il_settler *s, il_error *err); /* freed even after failure */
void il_blamer_free(il_blamer *m);

/* All borders that go wrong as things are: into wrong. */
il_status il_blame_find_wrong(il_blamer *m, il_error *err);

/* The line to blame for B, which is bad. */
uint32_t il_blame(il_blamer *m, uint32_t b);

/* How LINE, which is to blame, is to be reported. */
il_discord il_blame_discord(il_blamer *m, uint32_t line);

/* Leave LINE out, settle what hangs on it, and add to wrong what goes wrong there. */
il_status il_blame_take_out(il_blamer *m, uint32_t line, il_error *err);

#endif
