/* oblique.h - a stack seen from the side and a little from above, without perspective. */
#ifndef IL_OUTPUT_OBLIQUE_H
#define IL_OUTPUT_OBLIQUE_H

#include "output/picture-parts.h"

/* The point (x, y, z) is seen at u = c dx + s dy across and v = rise dz + lean (c dy - s dx) up,
 * (dx, dy, dz) from the middle at o[3]; across[2] = (c, s) is the direction in the slices that
 * is seen at full length.  stretch: what heights are multiplied by.  window: of all u and v,
 * least and greatest. */
typedef struct il_oblique {
    double o[3], across[2], rise, lean, stretch;
    il_box window;
} il_oblique;

/* A view of F with all its levels: across lies the direction in which the rings reach farthest,
 * by their second moments, x running to the right, or x itself where no direction stands out;
 * but for a turn of 15 degrees, so that depth is seen.
 * Heights are stretched or pressed by 1, 2 or 5 times a power of ten where the stack is far
 * flatter or far higher than it is wide. */
il_oblique il_oblique_view(const il_figure *f);
void il_oblique_point(const il_oblique *o, double x, double y, double z, double uv[2]);
/* uv[2*n] of the vertices of R at height Z. */
void il_oblique_ring(const il_oblique *o, const il_ring *r, double z, double *uv);

#endif
