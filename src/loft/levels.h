/* levels.h - a slab's surface cut by planes between its slices. */
#ifndef IL_LOFT_LEVELS_H
#define IL_LOFT_LEVELS_H

#include "loft/surface.h"

/* Where a point goes that lies at fraction F of the straight edge from vertex A to B (rows of
 * il_surface_row); P comes as that point. */
typedef void il_levels_mover(const void *self, size_t a, size_t b, double f, double p[3]);

/* S between its sections, its vertices standing at xyz[3*] (rows), to be cut at the heights
 * level[n], rising, strictly between the slices.  All borrowed. */
typedef struct il_levels {
    const il_surface *s;
    const il_section *section[2];
    const double *xyz, *level;
    size_t n;
    il_levels_mover *move;
    const void *self;
} il_levels;

enum { IL_LEVELS_MOST = 64 };

/* OUT: every triangle of S in parts between the levels, all vertices but those of the sections
 * moved; inner points of S keep their numbers, what is
 * pinched its codes.  (*parent)[t]: the triangle of S that triangle t is
 * a part of; the caller's, to il_free.  Both to be freed after failure too.  IL_E_NOMEM. */
il_status il_levels_cut(il_surface *out, uint32_t **parent, const il_levels *l, il_error *err);

#endif
