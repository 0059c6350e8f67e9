/* cliff.h - where lines of several levels run together.
 *
 * The ground is upright there: a point of the plane has several heights, and each triangle
 * round it takes the one that its band allows.  Between triangles that differ stands a piece
 * of cliff. */
#ifndef IL_TERRAIN_CLIFF_H
#define IL_TERRAIN_CLIFF_H

#include "terrain/tin.h"

/* Of the levels of node N, which lies on some, the one that a face in BAND ends at. */
int32_t il_cliff_level(const il_chart_node *n, il_band band);

/* The height of corner K of T's triangles, inside the frame, in the unit of the map's heights;
 * NAN where the node has none. */
double il_cliff_z(const il_tin *t, const il_chart *c, const il_band *band, size_t k);

/* Faces that nothing but cliffs bounds lie above them all or below, as what is across does
 * not (of an even number of lines: as it does): give those of T their bands, all others having
 * theirs.  IL_E_NOMEM. */
il_status il_cliff_label(const il_tin *t, const il_chart *c, il_band *band, il_error *err);

#endif
