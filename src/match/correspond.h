/* correspond.h - which arc of the lower contours each arc of the deformed upper ones is. */
#ifndef IL_MATCH_CORRESPOND_H
#define IL_MATCH_CORRESPOND_H

#include "match/course.h"

/* Rings are numbered in the group, places and residuals are those of the courses
 * (cells).  Whole rings come first. */
typedef struct il_correspondence {
    il_match *match;          size_t n_matches, cap_matches;
    il_unmatched *unmatched;  size_t n_unmatched, cap_unmatched;
} il_correspondence;

#define IL_CORRESPONDENCE_INIT { 0 }
void il_correspondence_free(il_correspondence *c);

/* LOWER as it lies, UPPER as SOLVER's deformation lays it over, or as it lies
 * itself (AS_THEY_LIE: then feet may be further off).  Every upper point
 * has its foot on the lower contours; where feet are near, normals agree and the
 * feet run on with the points, the arcs correspond.  A matched arc begins and
 * ends at vertices of both, and no two overlap; it is the whole ring where all
 * of it runs once round a lower ring.  Its residuals are distances of upper
 * points from the lower arc, by the best monotone pairing (base/zipper.h).  The
 * rest is unmatched.
 *
 * Why no arcs are left out of the equations as ending between the slices: on the solids of
 * tests/check-links, thresholds chosen on one half of them, no figure of the deformation tells
 * on the other half what ends from what goes on (F1 of 0.1 to 0.25 by stretch, Jacobian,
 * normals and residual, 0.3 to 0.4 by the residual of a stiff pass; 0.4 to 0.5 by the distance
 * from the other slice's outlines as they lie, over 3 spacings), and leaving out even what the
 * solids themselves say ends makes surfaces no better (mean distance 1.0004 of what it was,
 * |volume error| 1.015): nine tenths of it lie in groups whose phi is not trusted anyway.
 *
 * IL_E_NOMEM leaves *OUT empty. */
il_status il_correspond(il_correspondence *out, const il_course *lower, const il_course *upper, bool as_they_lie,
                        il_ffd *solver, il_error *err);

#endif
