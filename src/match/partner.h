/* partner.h - for every point of the target the nearest point that moves there. */
#ifndef IL_MATCH_PARTNER_H
#define IL_MATCH_PARTNER_H

#include "match/samples.h"

#define IL_NO_PARTNER UINT32_MAX

/* partner[q] for every sample q of TARGET: the nearest sample of MOVED whose
 * normal agrees (cosine above IL_NORMALS_AGREE), or IL_NO_PARTNER; equal
 * distances go to the lesser number.  ANEW: of all, O(n_moved *
 * n_target), by runs when these are many; else only of those near the partner that
 * partner[q] names already. */
#define IL_NORMALS_AGREE 0.2f
void il_partners_find(const il_samples *moved, const il_samples *target, bool anew, uint32_t *partner);

/* Distance of target sample Q from the polyline of MOVED about its sample P, or
 * from all of it when P is IL_NO_PARTNER. */
float il_partner_distance(const il_samples *moved, uint32_t p, const il_samples *target, uint32_t q);

#endif
