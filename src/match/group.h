/* group.h - one group of rings matched: phi, and what corresponds to what. */
#ifndef IL_MATCH_GROUP_H
#define IL_MATCH_GROUP_H

#include "match/course.h"
#include "model/stack.h"

/* The image of an upper ring under phi, in the stack's unit. */
typedef struct il_image {
    il_course_row *row;
    size_t n, cap;
} il_image;

/* Match group G of PAIR, which has rings on both sides: sets its fit, appends its
 * matched and unmatched arcs to PAIR, and fills image[r] of its upper rings.
 * All in the stack's unit.  KEEP_LATTICES: leave the steps in the fit.
 * IL_E_NOMEM: PAIR and IMAGE are only good to be freed. */
il_status il_group_match(il_pair *pair, il_group *g, const il_slice *lower, const il_slice *upper,
                         il_ffd *solver, bool keep_lattices, il_image *image, il_error *err);

#endif
