/* reference.h - the two slices of a slab in one plane, where phi makes them alike.
 *
 * The lower slice stays as it is; the upper is placed at phi(upper).  Only here
 * does the lofter meet phi: all that follows sees reference positions and, for
 * each of them, the real point that it stands for (loft.md 2). */
#ifndef IL_LOFT_REFERENCE_H
#define IL_LOFT_REFERENCE_H

#include "loft/section.h"

/* Both regions, as in IL_EDGE_LOWER | IL_EDGE_UPPER (overlay.h). */
enum { IL_OUTSIDE_SOLID = 3 };

/* One vertex of a reference ring: on edge STATION of its section at parameter t
 * (0: the station's node itself, else a reference-only point). */
typedef struct il_ref_vertex {
    double x, y;
    uint32_t station;
    double t;
} il_ref_vertex;

/* The reference rings of one side: vertex[n]; edge i runs to next[i]. */
typedef struct il_ref_side {
    il_ref_vertex *vertex;
    uint32_t *next;
    size_t n, cap, cap_next;
} il_ref_side;

/* outside: what the rings lie in, nothing (0) or solid in both slices
 * (IL_OUTSIDE_SOLID), as for a group of holes. */
typedef struct il_reference {
    const il_section *section[2];
    il_ref_side side[2];
    unsigned char outside;
} il_reference;

/* Reference rings for phi = identity (attempt B).  Matching by deformation
 * enters here and in il_reference_to_real, and nowhere else.  The sections are
 * borrowed and must outlive R. */
il_status il_reference_build(il_reference *r, const il_section *lower, const il_section *upper, il_error *err);
void il_reference_free(il_reference *r);

/* psi_z(p) = (1 - z) p + z phi^-1(p): where a reference point P at height Z in
 * [0, 1] of the slab lies in the real plane. */
void il_reference_to_real(const il_reference *r, const double p[2], double z, double out[2]);

#endif
