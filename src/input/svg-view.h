/* svg-view.h - lengths, viewBox and viewports: what a user unit is. */
#ifndef IL_INPUT_SVG_VIEW_H
#define IL_INPUT_SVG_VIEW_H

#include "input/svg-attr.h"
#include "input/svg-transform.h"

/* A length: VALUE in user units (a plain number or px), in per cent, or in mm
 * (mm cm in pt pc Q, converted). */
typedef enum il_svg_length_kind { IL_SVG_LENGTH_NONE, IL_SVG_LENGTH_USER, IL_SVG_LENGTH_PERCENT,
                                  IL_SVG_LENGTH_MM, IL_SVG_LENGTH_OTHER } il_svg_length_kind;

typedef struct il_svg_length {
    il_svg_length_kind kind;
    double value;
} il_svg_length;

/* The attribute NAME of E as a length; kind NONE when it is missing or "auto",
 * OTHER for em, ex and the like. */
il_status il_svg_length_of(const il_svg_element *e, const char *name, il_svg_length *length, il_error *err);

/* width and height of a viewport in the user units inside it; 0 when unknown. */
typedef struct il_svg_viewport {
    double width, height;
} il_svg_viewport;

/* The outermost svg: *SCALE takes its user units to mm when it has a viewBox
 * and a width or height in a unit of length, and *IS_PHYSICAL tells; otherwise
 * it is the identity.  The origin stays where the drawing has it. */
il_status il_svg_view_root(const il_svg_element *e, il_affine *scale, bool *is_physical,
                           il_svg_viewport *inside, il_error *err);

/* An svg inside a viewport OUTSIDE: *M gets its place and its viewBox
 * (SVG 1.1 sections 7.7 to 7.9). */
il_status il_svg_view_nested(const il_svg_element *e, il_svg_viewport outside, il_affine *m,
                             il_svg_viewport *inside, il_error *err);

#endif
