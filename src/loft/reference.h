/* reference.h - the two slices of a slab in one plane, where phi makes them alike.
 *
 * The lower slice stays as it is; the upper is placed at phi(upper), and arcs
 * that correspond are laid on each other (loft.md 2).  All that follows sees
 * reference positions and, for each of them, the real point that it stands for;
 * free points find their way back by inverse.h. */
#ifndef IL_LOFT_REFERENCE_H
#define IL_LOFT_REFERENCE_H

#include "loft/seam.h"

/* Both regions, as in IL_EDGE_LOWER | IL_EDGE_UPPER (overlay.h). */
enum { IL_OUTSIDE_SOLID = 3 };

/* One vertex of a reference ring: on edge STATION of its section at parameter t
 * (0: the station's node itself, else a reference-only point).  at: the point
 * itself in the lower plane, deformed but not laid on anything, which tells how
 * near two points of different sides are in truth.  matched: the edge from here
 * on is laid on one of the other side's. */
typedef struct il_ref_vertex {
    double x, y;
    uint32_t station;
    double t, at[2];
    bool matched;
} il_ref_vertex;

/* The reference rings of one side: vertex[n]; edge i runs to next[i]. */
typedef struct il_ref_side {
    il_ref_vertex *vertex;
    uint32_t *next;
    size_t n, cap, cap_next;
} il_ref_side;

/* outside: what the rings lie in, nothing (0) or solid in both slices
 * (IL_OUTSIDE_SOLID), as for a group of holes.  deformed: phi is not the
 * identity; fit then tells of its surroundings, or is null. */
typedef struct il_reference {
    const il_section *section[2];
    il_ref_side side[2];
    unsigned char outside;
    bool deformed;
    const il_fit *fit;
} il_reference;

/* Reference rings for phi = identity (attempt B).  The sections are borrowed
 * and must outlive R. */
il_status il_reference_build(il_reference *r, const il_section *lower, const il_section *upper, il_error *err);

/* With the upper side at phi: its edges bend where phi has rows, but for rows
 * less than NEAR from a neighbour; and with the seams seam[N] laid down (attempt
 * S; without any: P). */
il_status il_reference_deform(il_reference *r, const il_section *lower, const il_section *upper, const il_phi *phi,
                              const il_seam *seam, size_t n, double near, il_error *err);

void il_reference_free(il_reference *r);

#endif
