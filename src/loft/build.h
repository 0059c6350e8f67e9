/* build.h - from an overlay to the surface of its slab. */
#ifndef IL_LOFT_BUILD_H
#define IL_LOFT_BUILD_H

#include "loft/builder.h"

/* Surface of the slab over O, which gains free points.  OUT is empty before. */
il_status il_build_surface(il_surface *out, il_overlay *o, const il_build_options *options, il_error *err);

#endif
