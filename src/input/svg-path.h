/* svg-path.h - path data: the attribute d. */
#ifndef IL_INPUT_SVG_PATH_H
#define IL_INPUT_SVG_PATH_H

#include "input/svg-pen.h"

/* Draw all of D, SVG 1.1 section 8.3 and its grammar (8.3.9), with PEN.  Data
 * that breaks the grammar is IL_E_INPUT with D's cursor at the place; browsers
 * would draw what stands before it, which is no contour anyone meant. */
il_status il_svg_path_draw(il_svg_text *d, il_svg_pen *pen, il_error *err);

#endif
