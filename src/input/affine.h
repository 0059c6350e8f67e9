/* affine.h - affine maps of the plane. */
#ifndef IL_INPUT_AFFINE_H
#define IL_INPUT_AFFINE_H

/* x' = a x + c y + e, y' = b x + d y + f: SVG's matrix(a b c d e f).  The
 * identity leaves every finite point as it is, bit for bit. */
typedef struct il_affine {
    double a, b, c, d, e, f;
} il_affine;

#define IL_AFFINE_IDENTITY { 1, 0, 0, 1, 0, 0 }

/* First INNER, then OUTER. */
il_affine il_affine_multiply(const il_affine *outer, const il_affine *inner);

void il_affine_apply(const il_affine *m, double *x, double *y);

/* Sine and cosine of an angle in degrees; exact at multiples of 90, and equal
 * to each other at odd multiples of 45. */
void il_sincos_deg(double deg, double *sine, double *cosine);

#endif
