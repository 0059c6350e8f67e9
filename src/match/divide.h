/* divide.h - a group of regions that lie apart: one phi for each link.
 *
 * A smooth map takes one ring to one ring.  So a region with several links is cut among its
 * partners first (dissect.h); then each link is a piece of one slice and a piece of the
 * other, and is matched for itself, from the shift that lays their centres on each other: by
 * deformation, without turns, or where that does not fit by order (wrap.h).  phi of a ring
 * is put together from its pieces' phis; over a cut it runs straight on. */
#ifndef IL_MATCH_DIVIDE_H
#define IL_MATCH_DIVIDE_H

#include "match/ffd.h"
#include "match/rows.h"
#include "model/stack.h"

/* Divide G, whose rings are of slice[2] with ring r in the region of outer[side][r].  *DONE,
 * unless a region cannot be cut or nothing is left of a piece; then nothing else is written.
 * image[r] gets the rows of the upper rings; *FIT the fit of the only link, or what is to be said
 * of all: the shift on average as the global step, no steps, least Jacobian and distortion,
 * without residuals and box; the cuts are appended to PAIR.  All in the unit of the slices.
 * IL_E_NOMEM. */
il_status il_group_divide(il_pair *pair, const il_group *g, const il_slice *const slice[2], const uint32_t *const outer[2],
                          il_ffd *solver, il_rows *image, il_fit *fit, bool *done, il_error *err);

#endif
