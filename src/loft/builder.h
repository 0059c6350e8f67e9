/* builder.h - what sheets and walls share while a surface grows. */
#ifndef IL_LOFT_BUILDER_H
#define IL_LOFT_BUILDER_H

#include "loft/overlay.h"
#include "loft/surface.h"

/* rise: height of caps as a part of the slab (axis.h).  stars: discs between both planes are
 * built round one point (star.h).  round_float: positions are rounded to 32-bit floats. */
typedef struct il_build_options {
    double rise;
    bool stars, round_float;
} il_build_options;

/* The overlay, what is made of it, and for each side and contour point the
 * insertion made there, or IL_NONE. */
typedef struct il_builder {
    il_overlay *o;
    const il_section *section[2];
    il_build_options options;
    il_surface *out;
    uint32_t *inserted[2];
} il_builder;

/* The code of contour point P's copy in plane SIDE: its node, or an insertion
 * made on the first call; IL_NONE without memory or when SIDE does not pass P. */
uint32_t il_builder_copy(il_builder *b, int side, uint32_t p);

/* Height of fraction Z of the slab, rounded as the options say. */
double il_builder_height(const il_builder *b, double z);

/* Triangles over the sheet triangles of the overlay (sheet.c). */
il_status il_build_sheets(il_builder *b, il_error *err);

/* Strips between arcs that coincide in the reference plane (wall.c). */
il_status il_build_walls(il_builder *b, il_error *err);

#endif
