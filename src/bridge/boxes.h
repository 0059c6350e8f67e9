/* boxes.h - which boxes of the plane overlap (CGAL). */
#ifndef IL_BRIDGE_BOXES_H
#define IL_BRIDGE_BOXES_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All pairs i < j of the N closed boxes box[4*N] (x and y least, x and y
 * greatest) that overlap or touch, as pair[2*n_pairs], sorted; the caller's,
 * to il_free.  Zomorodian & Edelsbrunner 2000: O(n log n + pairs) for contour
 * edges, O(n log^2 n + pairs) at worst.  More than LIMIT pairs: IL_E_INPUT. */
il_status il_box_pairs(const double *box, size_t n, size_t limit,
                       uint32_t **pair, size_t *n_pairs, il_error *err);

/* As il_box_pairs between two sets: pairs (i of A, j of B). */
il_status il_box_pairs_between(const double *a, size_t n_a, const double *b, size_t n_b, size_t limit,
                               uint32_t **pair, size_t *n_pairs, il_error *err);

#ifdef __cplusplus
}
#endif
#endif
