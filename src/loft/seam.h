/* seam.h - two arcs that correspond, as one polyline (loft.md 2, attempt S). */
#ifndef IL_LOFT_SEAM_H
#define IL_LOFT_SEAM_H

#include "loft/phi.h"

/* A vertex of the seam: on edge station[side] at t[side] of either section
 * (t = 0: the station's node).  xy: where both are put in the reference plane;
 * at[side]: where either is without having been put there. */
typedef struct il_seam_vertex {
    uint32_t station[2];
    double t[2], xy[2], at[2][2];
} il_seam_vertex;

typedef struct il_seam {
    il_seam_vertex *v; size_t n, cap;
} il_seam;

/* Seams of the arcs match[N] of PHI's pair between the sections, in order: the
 * shape is that of the lower arc.  Upper vertices are put on it in the order of
 * the arc, mostly where they are nearest; less than NEAR from a lower vertex
 * they are put on that.  Seams share vertices only where both arcs do; what
 * conflicts is cut short or left out.  *SEAM and its arrays are the caller's
 * (il_seams_free). */
il_status il_seams_lay(il_seam **seam, size_t *n_seams, const il_section *lower, const il_section *upper,
                       const il_phi *phi, const uint32_t *match, size_t n, double near, il_error *err);

/* The length of all in the reference plane, unit. */
double il_seams_length(const il_seam *seam, size_t n);

/* The edge that begins on edge STATION of the upper section at T is in the way of
 * another: leave it out of its seam, with all between it and the seam's nearer
 * end.  False when it is in none. */
bool il_seams_cut(il_seam *seam, size_t n, uint32_t station, double t);

/* The same for a vertex that a seam begins or ends with: take it away. */
bool il_seams_cut_end(il_seam *seam, size_t n, uint32_t station, double t);

void il_seams_free(il_seam *seam, size_t n);

#endif
