/* missing.h - lines that the map does not have, interpolated. */
#ifndef IL_TERRAIN_MISSING_H
#define IL_TERRAIN_MISSING_H

#include "terrain/law.h"

/* In each face of T that spans more than a band, draw the levels between: where heights along
 * the edges of triangles, between the lines of the map, pass through a level.  So a single
 * missing line follows the chordal axis between its neighbours.  New edges of level k have the
 * owner N_LINES + k; the frame is divided where they meet it.  *N: faces that had lines
 * missing.  C needs a new triangulation then.  LAW may not know the new lines.  IL_E_NOMEM. */
il_status il_missing_draw(il_chart *c, const il_tin *t, const il_law *law, size_t n_lines,
                          const il_placement_options *o, size_t *n, il_error *err);

#endif
