/* lattice.h - the deformation that a pair's fit records, evaluated. */
#ifndef IL_MODEL_LATTICE_H
#define IL_MODEL_LATTICE_H

#include "model/pair.h"

/* The weights B_0 .. B_3 of the four nodes round a place, u in [0, 1) beyond
 * the second of them (paper, eq. 2). */
void il_lattice_weights(double u, double b[4]);

/* Take N points xy[2*n] one lattice step further: p + sum of b b d (paper, eq. 3),
 * as formats/loft.txt 8.3 words it.  Nodes that the lattice does not have count
 * as 0.  O(16 n). */
void il_lattice_apply(const il_lattice *l, double *xy, size_t n);

/* phi: the global step, then all lattice steps in order. */
void il_fit_apply(const il_fit *f, double *xy, size_t n);

/* Determinant of the derivative of one step at P. */
double il_lattice_jacobian(const il_lattice *l, const double p[2]);

#endif
