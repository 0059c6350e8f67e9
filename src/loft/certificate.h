/* certificate.h - what a slab must show before it is accepted (loft.md 7). */
#ifndef IL_LOFT_CERTIFICATE_H
#define IL_LOFT_CERTIFICATE_H

#include "loft/surface.h"

/* Why a surface was refused, and near which point (stack coordinates). */
typedef enum il_flaw {
    IL_FLAW_NONE,
    IL_FLAW_BOUNDARY,      /* its edges in a slice plane are not the contours */
    IL_FLAW_OPEN,          /* an edge between the planes lacks its reverse */
    IL_FLAW_CROSSING,      /* two triangles meet, or one has no area */
    IL_FLAW_REFERENCE      /* it could not even be laid out in the reference plane */
} il_flaw;

/* multiple: edges that more than two triangles share, where the input touches
 * itself; sound, but to be taken apart (pinch.h). */
typedef struct il_verdict {
    il_flaw flaw;
    double at[3];
    size_t multiple;
} il_verdict;

const char *il_flaw_words(il_flaw f);

/* Judge S between its sections, which hold its insertions already:
 * (a) the half-edges in either plane are those of the contours, once each, with
 *     the right signs; (b) every other half-edge is matched by its reverse;
 * (c) no two triangles meet but in what they share.  Neighbouring slabs meet
 * in contour edges only, so these verdicts together prove the whole mesh. */
il_status il_certify(const il_surface *s, const il_section *lower, const il_section *upper,
                     il_verdict *verdict, il_error *err);

/* Parts (a) and (b) alone. */
il_status il_certify_edges(const il_surface *s, const il_section *lower, const il_section *upper,
                           il_verdict *verdict, il_error *err);

/* Look for two triangles at an edge that lie on each other but for an angle below
 * ANGLE (radians): sound as they are, but not when a neighbour slab puts a point
 * on one of them, which moves it by an ulp.  They count as crossing. */
il_status il_certify_unfolded(const il_surface *s, const il_section *lower, const il_section *upper,
                              double angle, il_verdict *verdict, il_error *err);

/* Part (c) between groups of triangles: which of them meet (bridge/intersection.h); for pairs with one
 * of those that touched[] marks when it is not null.  Without GROUP each triangle is its own. */
il_status il_certify_between(const il_surface *s, const il_section *lower, const il_section *upper, const uint32_t *group,
                             const unsigned char *touched, uint32_t **pair, size_t *n_pairs, il_error *err);

/* Part (c) alone, for pairs with one of the triangles that touched[] marks. */
il_status il_certify_touched(const il_surface *s, const il_section *lower, const il_section *upper,
                             const unsigned char *touched, il_verdict *verdict, il_error *err);

/* Position of vertex CODE. */
void il_surface_position(const il_surface *s, const il_section *lower, const il_section *upper,
                         uint32_t code, double xyz[3]);

#endif
