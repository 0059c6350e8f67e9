/* spread.h - how far the ground strays from a plate, measured from the lines themselves. */
#ifndef IL_TERRAIN_SPREAD_H
#define IL_TERRAIN_SPREAD_H

#include "terrain/field.h"

/* Leave out every second level, lay a plate over the rest (on every second node), and look how far
 * it misses the lines left out, RMS over their edges by length, in distances of the levels about them: *SPREAD is four times
 * that, no less than 0.2 and no more than 1.4; 0.5 with fewer than three levels.  Not the spread
 * that serves the lines left out best: they lie in the middle of their bands by their nature, and
 * would always ask for the greatest.  IL_E_NOMEM. */
il_status il_spread_measure(const il_field *f, const il_chart *c, const il_band *band, double *spread, il_error *err);

#endif
