/* shift.h - where one region has gone in the next slice. */
#ifndef IL_MATCH_SHIFT_H
#define IL_MATCH_SHIFT_H

#include "match/patch.h"

/* The vector, unit, by which LOWER is best moved to lie on UPPER, which it is linked to; both
 * are planted.  None where they overlap by 0.3 of the lesser; between areas within a factor
 * 2.5 the difference of their centres; else the way from the nearest place of the large one
 * to the centre of the small one, which it may be a branch of.  SCAN is room to work in.
 * IL_E_NOMEM. */
il_status il_link_shift(const il_patch *lower, const il_patch *upper, il_scan *scan, double shift[2], il_error *err);

#endif
