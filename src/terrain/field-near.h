/* field-near.h - the nearest lines of each node of a field. */
#ifndef IL_TERRAIN_FIELD_NEAR_H
#define IL_TERRAIN_FIELD_NEAR_H

#include "terrain/field.h"

/* Fill F's near, first, through and width, its faces and lines being known: beside the lines from the lines themselves,
 * then from node to node of one face, in sweeps from corner to corner (Danielsson 1980, with
 * edges in place of points).  False without memory.  O(nodes + edges). */
bool il_field_find_near(il_field *f);

#endif
