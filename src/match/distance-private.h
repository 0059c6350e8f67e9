/* distance-private.h - what the map's own files share. */
#ifndef IL_MATCH_DISTANCE_PRIVATE_H
#define IL_MATCH_DISTANCE_PRIVATE_H

#include "base/simd.h"
#include "match/distance.h"

/* From (ax, ay) by LENGTH in the direction (ux, uy), which is any for none. */
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

/* Eight segments seen from the middle m of a tile, whose foot on a segment is f.
 * In the segment's own axes, u and n = (uy, -ux), a point m + p is
 *     p.u + k along, beyond the segment where that exceeds +-half, and
 *     p.n + across beside it.
 * The axes begin in the middle not of the segment but of the little of it that
 * feet of the tile's points can be on.  All that matters is small then, and the
 * floats are as exact as the tile is near. */
typedef struct il_distance_near {
    float ux[IL_LANES], uy[IL_LANES], k[IL_LANES], half[IL_LANES], across[IL_LANES];
    float to_foot[IL_LANES]; /* where f lies along */
    float excess[IL_LANES];  /* |m - f|^2 less that of the segment nearest to m */
} il_distance_near;

/* From eight segments' feet to the middle of a square: squares of lengths, ways,
 * and what the square of a length can lack because the foot moves in the square. */
typedef struct il_distance_way {
    float square[IL_LANES], x[IL_LANES], y[IL_LANES], lack[IL_LANES];
} il_distance_way;

/* A segment as a quarter of a tile sees it: what is the same along a row of it. */
typedef struct il_distance_rows {
    float along[IL_LANES], across[IL_LANES], ux, uy, half;
    uint32_t segment;
    float k, twice_along, twice_across, to_foot, excess; /* from afar only */
} il_distance_rows;

/* The box of some candidates of a tile that follow each other. */
typedef struct il_distance_block {
    double x0, y0, x1, y1;
    uint32_t end;             /* behind the last, in candidate */
} il_distance_block;

/* Work out tile T; its slot, or -1 without memory. */
int32_t il_distance_make_tile(il_distance *d, uint32_t t);

#endif
