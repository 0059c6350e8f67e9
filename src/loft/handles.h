/* handles.h - the topology of one group's surface between its contours. */
#ifndef IL_LOFT_HANDLES_H
#define IL_LOFT_HANDLES_H

#include "loft/surface.h"

/* The handles of S: how much more its parts hang together than branches need,
 * by Euler's formula with the contours as its borders.  0 where contours touch,
 * of which the formula says nothing.  LOWER and UPPER are without S's insertions. */
il_status il_surface_handles(const il_surface *s, const il_section *lower, const il_section *upper,
                             long *handles, il_error *err);

#endif
