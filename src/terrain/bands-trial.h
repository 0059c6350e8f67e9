/* bands-trial.h - what a map would be like without a line, or with another height for it. */
#ifndef IL_TERRAIN_BANDS_TRIAL_H
#define IL_TERRAIN_BANDS_TRIAL_H

#include "terrain/bands-settle.h"

/* What gets worse in a trial, around all faces that it touches: borders that go wrong (a
 * cluster that loses its last guide counts as two); levels that are missing, and faces of
 * more than two kinds.  turns: faces between several lines of one level.  is_clean:
 * nothing is wrong or missing there any more. */
typedef struct il_tally { long wrong, missing, turns; bool is_clean; } il_tally;

/* wrong: borders that went wrong, in the order in which they were found so. */
typedef struct il_trier {
    il_bands_graph *graph;
    il_settler *settler;
    il_merger *merger;
    uint32_t *start, *stamp, *face_stamp;
    il_around *saved;
    uint32_t *wrong;        size_t n_wrong, cap_wrong;
    size_t n_start;
    uint32_t epoch, face_epoch;
} il_trier;

il_status il_trier_make(il_trier *t, il_bands_graph *g, il_settler *s, il_error *err); /* freed even after failure */
void il_trier_free(il_trier *t);

/* Trials; all is as it was afterwards. */
il_tally il_try_without(il_trier *t, uint32_t line);
il_tally il_try_wide(il_trier *t, uint32_t face, int wide);       /* more so than it is */
il_tally il_try_level(il_trier *t, uint32_t line, int32_t level);
il_tally il_try_exchange(il_trier *t, uint32_t line, uint32_t other); /* their levels */

/* The same for good: what hangs on it is settled again, and what goes wrong there added to
 * wrong.  IL_E_NOMEM. */
il_status il_trier_take_out(il_trier *t, uint32_t line, il_error *err);
il_status il_trier_widen(il_trier *t, uint32_t face, int wide, il_error *err);
/* All borders that go wrong as things are: into wrong. */
il_status il_trier_find_wrong(il_trier *t, il_error *err);

#endif
