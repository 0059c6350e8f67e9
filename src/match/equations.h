/* equations.h - one Gauss-Newton step of the deformation: the normal equations of
 * the sampled energy, and their solution. */
#ifndef IL_MATCH_EQUATIONS_H
#define IL_MATCH_EQUATIONS_H

#include "match/distance.h"
#include "match/partner.h"
#include "match/spline.h"

/* Every moving sample k carries a 2x2 block H_k = (xx xy; xy yy)[k] and a vector
 * (vx, vy)[k]; the step c solves (sum B_k' H_k B_k + lambda L) c = sum B_k' v_k.
 * phi, gx, gy: the distance map at the samples.  Fields start behind their
 * margins; field[0] is the solution. */
typedef struct il_equations {
    float *phi, *gx, *gy, *xx, *xy, *yy, *vx, *vy, *dx, *dy;
    il_stencil *stencil;
    size_t n, cap[11];
    uint32_t *partner; size_t cap_partner;
    float *field[5];   size_t cap_field[5];
} il_equations;

#define IL_EQUATIONS_INIT { 0 }
void il_equations_free(il_equations *e);

/* How far apart the two contours still are: root mean square and largest of the
 * distances, in cells, both ways; backward along the target's normals. */
typedef struct il_misfit {
    float forward_rms, forward_max, backward_rms, backward_max;
} il_misfit;

/* Room for N samples, N_TARGET partners, and fields of S, which become 0; or
 * IL_E_NOMEM. */
il_status il_equations_reserve(il_equations *e, size_t n, size_t n_target, const il_spline *s, il_error *err);

/* Fill the blocks for MOVED as it lies; the partners are searched ANEW or about
 * where they were. */
il_misfit il_equations_fill(il_equations *e, const il_samples *moved, const il_samples *target, il_distance *map, bool anew);

/* Solve by conjugate gradients; the field is e->field[0] + s->margin. */
void il_equations_solve(il_equations *e, const il_samples *moved, const il_spline *s);

#endif
