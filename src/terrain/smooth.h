/* smooth.h - the law of heights that bends: a plate in its bands, then the mean of what a band
 * allows. */
#ifndef IL_TERRAIN_SMOOTH_H
#define IL_TERRAIN_SMOOTH_H

#include "terrain/plate.h"

/* z[]: the plate over the field, heights of the map; law[2 * node]: the law at its nodes, and how far the nearest
 * line is, NAN where nothing tells; null while there are none.  spread: how far, in
 * intervals, the ground strays from the plate where it is half a width from any line, times two. */
typedef struct il_smooth {
    il_field field;
    const il_chart *chart;
    const il_band *band;
    double *z, *law;
    double spread;
} il_smooth;

#define IL_SMOOTH_INIT { 0 }
void il_smooth_free(il_smooth *s); /* safe twice */

/* Over T, which C's lines bound as BAND says, both borrowed; EAST as for il_field_build.  SPREAD: NAN
 * to measure it (il_spread_measure).  IL_E_NOMEM. */
il_status il_smooth_build(il_smooth *s, const il_tin *t, const il_chart *c, const il_band *band, double east, double spread,
                          il_error *err);

/* The height at the mesh's (x, y) in FACE; *NEAREST: how far the nearest line is, in the plane of
 * the field.  NAN where no node of the field about it lies in that face, as lines are denser there.
 *
 * Let u in [0, 1] be the plate's height in the band, less what it misses the nearest places of both
 * lines by, which fades away from each.  Its mean in the band (terrain/mean.h) is taken with the
 * spread s = spread min(d / width, 1/2), d the distance to the nearest line: a plate is the likeliest
 * surface, but between two levels a mean lies nearer to the middle than that, the more so the
 * farther the lines are.
 * That is so at the nodes and in cells that a line passes through; in others heights lie between those of the
 * nodes, which takes a tenth of the time. */
double il_smooth_height(const il_smooth *s, uint32_t face, double x, double y, double *nearest);

#endif
