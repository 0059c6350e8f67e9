/* isolines.h - more isolines between those of a map, as a stage.
 *
 * The surface of relief.h is made of the map's lines, and cut at heights between its levels. */
#ifndef IL_TERRAIN_ISOLINES_H
#define IL_TERRAIN_ISOLINES_H

#include "terrain/relief.h"

/* A sink that gives NEXT (borrowed) each stack of terrain with N levels more between each two, at
 * even distances, and all else as it comes.  The map's own slices stay as they are, bit for bit;
 * those between have the isolines of the certified surface (terrain/cutter.h), in the order of
 * section 9 of formats/loft.txt, and are left out where there are none.  Nothing is
 * above the highest level or below the lowest.  Pairs of terrain are dropped.
 * O: how the surface is made, but for its placement: it lies on the map.  What the
 * surface had to leave out or put in, and how many lines came of it, is told in REPORT.  A
 * whole map is held.  Errors as il_relief_new tells; NEXT knows nothing of a stack that fails. */
il_status il_isolines_new(il_sink **out, const il_relief_options *o, size_t n, il_sink *next, il_report *report, il_error *err);
void il_isolines_free(il_sink *s); /* null is fine */

#endif
