/* svg-transform.h - affine maps and the transform attribute. */
#ifndef IL_INPUT_SVG_TRANSFORM_H
#define IL_INPUT_SVG_TRANSFORM_H

#include "input/svg-text.h"

/* x' = a x + c y + e, y' = b x + d y + f: SVG's matrix(a b c d e f).  The
 * identity leaves every finite point as it is, bit for bit. */
typedef struct il_svg_matrix {
    double a, b, c, d, e, f;
} il_svg_matrix;

#define IL_SVG_IDENTITY { 1, 0, 0, 1, 0, 0 }

/* First INNER, then OUTER. */
il_svg_matrix il_svg_matrix_multiply(const il_svg_matrix *outer, const il_svg_matrix *inner);

void il_svg_matrix_apply(const il_svg_matrix *m, double *x, double *y);

/* Sine and cosine of an angle in degrees; exact at multiples of 90, and equal
 * to each other at odd multiples of 45. */
void il_svg_sincos(double deg, double *sine, double *cosine);

/* Put the list in T ("translate(1,2) rotate(90)") inside *M, as an element's
 * transform stands inside its group's.  *M is as before after failure. */
il_status il_svg_transform_parse(il_svg_text *t, il_svg_matrix *m, il_error *err);

#endif
