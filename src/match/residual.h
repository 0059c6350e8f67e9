/* residual.h - how far the deformed upper contours and the lower ones are apart. */
#ifndef IL_MATCH_RESIDUAL_H
#define IL_MATCH_RESIDUAL_H

#include "match/course.h"

/* Set the residuals of FIT, in cells: up, the distances of UPPER's points from the
 * lower contours; down, those of LOWER's points from UPPER's polylines.  Means are
 * over the lengths of the original contours.  SOLVER has just matched them.  Or
 * IL_E_NOMEM. */
il_status il_residuals_measure(il_fit *fit, const il_course *lower, const il_course *upper, il_ffd *solver, il_error *err);

#endif
