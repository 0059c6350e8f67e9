/* svg-shape.h - the elements that are contours. */
#ifndef IL_INPUT_SVG_SHAPE_H
#define IL_INPUT_SVG_SHAPE_H

#include "input/svg-attr.h"
#include "input/svg-pen.h"

typedef struct il_svg_shape il_svg_shape;

/* polyline polygon path line rect circle ellipse, or null for another name. */
const il_svg_shape *il_svg_shape_named(const char *name);

/* Draw E, an element of that name, with PEN.  *WHY is set to a reason when
 * there is nothing to draw (no points, a size of 0 or in per cent), and null
 * else.  *AT gets the attribute a failure was in, for its line. */
il_status il_svg_shape_draw(const il_svg_shape *shape, const il_svg_element *e, il_svg_pen *pen,
                            const char **why, il_svg_text *at, il_error *err);

#endif
