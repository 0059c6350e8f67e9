/* svg-transform.h - affine maps and the transform attribute. */
#ifndef IL_INPUT_SVG_TRANSFORM_H
#define IL_INPUT_SVG_TRANSFORM_H

#include "input/affine.h"
#include "input/svg-text.h"

/* Put the list in T ("translate(1,2) rotate(90)") inside *M, as an element's
 * transform stands inside its group's.  *M is as before after failure. */
il_status il_svg_transform_parse(il_svg_text *t, il_affine *m, il_error *err);

#endif
