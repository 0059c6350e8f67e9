/* bends.h - what the smooth surface has beyond the straight one, all over a slab. */
#ifndef IL_LOFT_BENDS_H
#define IL_LOFT_BENDS_H

#include "loft/lean.h"

/* of[6*v], for vertex v in the row of il_surface_row: the bend (lean.h) at the lower section where the
 * surface through v leaves it, then that at the upper. */
typedef struct il_bends {
    double *of;
    size_t n;
} il_bends;

#define IL_BENDS_INIT { NULL, 0 }
void il_bends_free(il_bends *b); /* safe twice */

/* Of S, which leans as lean[side] tells at its sections and, beyond them, the next slabs do as
 * beyond[side] tells.  Known at the contours, bends are carried along the surface: a vertex has
 * the mean of its neighbours'.  Where nothing goes on beyond a section, the curves end as
 * parabolas. */
il_status il_bends_find(il_bends *out, const il_surface *s, const il_section *lower, const il_section *upper,
                        const il_lean lean[2], const il_lean beyond[2], il_error *err);

#endif
