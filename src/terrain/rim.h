/* rim.h - heights along the frame. */
#ifndef IL_TERRAIN_RIM_H
#define IL_TERRAIN_RIM_H

#include "terrain/chart.h"

/* Nodes of C on the frame without a height, between two that have different ones, get theirs
 * by the distances to both along the frame, as nothing else is known there.  Between equal
 * ones the ground rises or falls like that beside it, which is for the law to say.  False without
 * memory. */
bool il_rim_raise(il_chart *c);

/* Take heights of the frame that neither a line nor a spot gives away again, for a law to give. */
void il_rim_lower(il_chart *c);

#endif
