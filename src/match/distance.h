/* distance.h - the distance map of one slice's rings, worked out where it is asked for.
 *
 * Phi(p): signed Euclidean distance to the nearest contour segment, positive
 * inside (paper, section 3.2), sampled at the nodes of a raster.  It is the
 * distance to segments, not to pixels, which would be wrong by half a cell; and
 * it is worked out by tiles at first touch, for the solver looks at the strip
 * that the moving contour sweeps and nowhere else. */
#ifndef IL_MATCH_DISTANCE_H
#define IL_MATCH_DISTANCE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Node (i, j) of the raster lies at (i, j): one cell is the unit of everything
 * here.  A tile is IL_TILE_CELLS cells square and holds its border nodes itself,
 * so that a point's four nodes are always in one tile. */
enum { IL_TILE_NODES = 16, IL_TILE_CELLS = 15, IL_DISTANCE_MOST_CELLS = 256 };

/* The fields are the implementation's, but for n_tiles_done.  One map can be
 * rebuilt again and again and keeps its memory. */
typedef struct il_distance {
    struct il_distance_segment *segment; size_t n, cap_segment;
    struct il_distance_run *run;         size_t n_runs, cap_run;   /* of IL_LANES segments */
    struct il_distance_box *box;         size_t cap_box;           /* around IL_LANES runs */
    float slack;                                                   /* what floats may be off by in a distance */
    uint32_t cells_x, cells_y, tiles_x, tiles_y;
    uint64_t *inside;        size_t row_words, cap_inside;         /* a bit a node, [cells_y + 1][row_words] */
    int32_t *slot;           size_t cap_slot;      /* [tiles_x*tiles_y] or -1 */
    float *value;            size_t cap_value;     /* [n_tiles_done * 256] */
    uint32_t *nearest;       size_t cap_nearest;   /* segment at each node, as value */
    uint32_t *candidate;     size_t n_candidates, cap_candidate;
    uint32_t *first;         size_t cap_first;     /* [n_tiles_done + 1] into candidate */
    struct il_distance_block *block; size_t n_blocks, cap_block;
    uint32_t *first_block;   size_t cap_first_block; /* [n_tiles_done + 1] into block */
    size_t n_tiles_done;
    /* of the tile being made */
    float *bound;            size_t cap_bound;     /* of runs */
    uint32_t *kept;          size_t cap_kept;
    struct il_distance_way *way;   size_t cap_way;
    struct il_distance_near *near; size_t cap_near;
    struct il_distance_rows *rows; size_t cap_rows;
    bool failed;
} il_distance;

#define IL_DISTANCE_INIT { 0 }
void il_distance_free(il_distance *d);

/* Begin the map of closed rings in a raster of CELLS_X by CELLS_Y cells (at most
 * IL_DISTANCE_MOST_CELLS each): vertices xy[2*N]; vertex i is joined to next[i],
 * and segment i starts there.  The region is on the left of the rings; inside is
 * even-odd.  N at least 1.  IL_E_NOMEM: D is only good to be begun again or freed. */
il_status il_distance_begin(il_distance *d, const double *xy, const uint32_t *next, size_t n,
                            uint32_t cells_x, uint32_t cells_y, il_error *err);

/* Phi and its gradient at P[k] = (x[k], y[k]), k < N, bilinear between the nodes,
 * where it is good to 1e-5 up to 128 away and to a float's last place beyond
 * (error about curvature / 8; the gradient is that of the bilinear patch).  A
 * point outside of the raster is taken at the nearest place of its border.  Without
 * memory D->failed is set and zeros come back. */
void il_distance_sample(il_distance *d, const float *x, const float *y, size_t n,
                        float *phi, float *gx, float *gy);

/* The point of the contours nearest to a point in the raster: on segment
 * `segment` at t in [0, 1], so far away (>= 0). */
typedef struct il_foot {
    uint32_t segment;
    float t, distance;
} il_foot;

/* Exact but for rounding: all segments that can be nearest in the tile are tried.
 * Outside of the raster and without memory as il_distance_sample.  About the root
 * of the number of segments in the tile. */
il_foot il_distance_foot(il_distance *d, float x, float y);

#endif
