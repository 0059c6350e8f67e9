/* bands-blame.h - what is to blame for a border that goes wrong.
 *
 * Where a single line with another level, or two that exchange theirs, would put right all
 * that is around (wrong heights are the commonest of errors), one of these is to blame.
 * Else each line that may be is left out for trial, and each face that may be is taken for
 * wide: a line of the level that makes it wrong is missing in it.  The remedy after which
 * the fewest borders go wrong is the one; of equal ones the one after which the fewest
 * lines are missing or left out; then the one whose line would do best with another level;
 * then to leave nothing out; then the shorter line; then the first. */
#ifndef IL_TERRAIN_BANDS_BLAME_H
#define IL_TERRAIN_BANDS_BLAME_H

#include "terrain/bands-trial.h"

/* Leave out LINE; or, when that is UINT32_MAX, take FACE for wide. */
typedef struct il_remedy { uint32_t line, face; int wide; } il_remedy;

/* What to do about B, which is bad. */
il_remedy il_blame(il_trier *t, uint32_t b);

/* How LINE, which is to go out, is to be reported. */
il_discord il_blame_discord(il_bands_graph *g, uint32_t line);

#endif
