/* warp.h - pair records made of a map that is known. */
#ifndef IL_TESTS_WARP_H
#define IL_TESTS_WARP_H

#include "model/pair.h"
#include "model/stack.h"

/* phi as a formula: takes a point of the upper slice to the plane of the lower. */
typedef struct warp {
    void (*map)(const double p[2], const double *a, double out[2]);
    double a[8];
    size_t bends;             /* rows between the vertices of each edge */
} warp;

void warp_affine(const double p[2], const double *a, double out[2]);  /* a: as il_fit.global */
void warp_wavy(const double p[2], const double *a, double out[2]);    /* a: shift x y, height, wave number */

/* The pair of UPPER matched onto LOWER by W: one group of all rings, whose box
 * and global step are those of an affine W, else fair ones.  The caller frees
 * it.  Aborts without memory, here and below. */
il_pair warp_pair(const il_slice *lower, const il_slice *upper, const warp *w);

/* Ring R of LOWER corresponds to ring U of UPPER, all of it, from vertices V and K on. */
void warp_match_rings(il_pair *p, uint32_t r, uint32_t v, uint32_t u, uint32_t k);
void warp_match_arcs(il_pair *p, il_arc lower, il_arc upper);

/* The rings of P's one group in groups of their own: group_of[side][ring]. */
void warp_regroup(il_pair *p, const uint32_t *lower, size_t n_lower, const uint32_t *upper, size_t n_upper, size_t n_groups);

#endif
