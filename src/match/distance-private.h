/* distance-private.h - what the map's own files share. */
#ifndef IL_MATCH_DISTANCE_PRIVATE_H
#define IL_MATCH_DISTANCE_PRIVATE_H

#include "base/simd.h"
#include "match/distance.h"

/* From (ax, ay) by LENGTH in the direction (ux, uy); both zero for none. */
typedef struct il_distance_segment {
    double ax, ay, ux, uy, length;
} il_distance_segment;

/* The same in floats, eight in a row; the last run is filled up with copies. */
typedef struct il_distance_run {
    float ax[IL_LANES], ay[IL_LANES], ux[IL_LANES], uy[IL_LANES], length[IL_LANES];
} il_distance_run;

/* Middles and half extents of eight runs, and a point of each. */
typedef struct il_distance_box {
    float x[IL_LANES], y[IL_LANES], half_x[IL_LANES], half_y[IL_LANES], on_x[IL_LANES], on_y[IL_LANES];
} il_distance_box;

/* Eight segments seen from the middle m of a tile: (fx, fy) is the foot of m on
 * the segment less m, and the foot of m + p is that of m moved along by
 * clamp(p.u + k, low, high).  All that matters in the tile is small then, and the
 * floats are as exact as the tile is near.  excess: |f|^2 less that of the segment
 * nearest to m. */
typedef struct il_distance_near {
    float fx[IL_LANES], fy[IL_LANES], ux[IL_LANES], uy[IL_LANES];
    float k[IL_LANES], low[IL_LANES], high[IL_LANES], excess[IL_LANES];
} il_distance_near;

/* Work out tile T; its slot, or -1 without memory. */
int32_t il_distance_make_tile(il_distance *d, uint32_t t);

#endif
