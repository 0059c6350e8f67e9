/* overlay.h - both slices' reference rings in one triangulation (loft.md 4).
 *
 * Parity tells of every triangle whether it lies in the lower region, the upper
 * region or both.  The slab's surface lies over the triangles where they differ
 * ("sheet" triangles), and stands as a wall on edges where both boundaries run
 * the same way.  Nothing else is surface, so there is nothing to fill. */
#ifndef IL_LOFT_OVERLAY_H
#define IL_LOFT_OVERLAY_H

#include "bridge/triangulation.h"
#include "loft/snap.h"

/* What the triangle edge from corner k to corner k + 1 is. */
enum {
    IL_EDGE_LOWER = 1,         /* on the lower boundary */
    IL_EDGE_UPPER = 2,         /* on the upper boundary */
    IL_EDGE_LOWER_BACK = 4,    /* the lower boundary runs from k + 1 to k */
    IL_EDGE_UPPER_BACK = 8,
    IL_EDGE_CONTOUR = IL_EDGE_LOWER | IL_EDGE_UPPER
};

/* How one side passes a contour point: at node >= 0 of its section, or between
 * nodes on edge `station` at t in (0, 1); station NONE: not at all.  vertex: the
 * reference vertex from which the passing edge starts. */
typedef struct il_pass {
    int32_t node;
    uint32_t station, vertex;
    double t;
} il_pass;

/* Points 0..n_contour are the snapped ones with their passes [side]; beyond are
 * free points, inside the sheets.  xy[2*n_points] in grid units.  Triangles as
 * in bridge/triangulation.h; inside[t]: IL_EDGE_LOWER and IL_EDGE_UPPER as the
 * regions that it lies in; edge[3*t + k]: see above. */
typedef struct il_overlay {
    const il_reference *reference;
    const il_snapped *snapped;
    double *xy;               size_t n_points, cap_points, n_contour;
    il_pass *pass[2];
    il_keymap edge_at;        /* undirected edge -> flags, forwards = from the lesser point */
    uint32_t *rim;            size_t n_edges; /* [2*n_edges] contour edges as first run */
    il_triangulation *triangulation;
    uint32_t *corner, *across; size_t n_triangles;
    unsigned char *inside, *edge;
} il_overlay;

#define IL_NONE UINT32_MAX

/* Build it; R and S are borrowed and must outlive O.  *SOUND is false when the
 * real order of points along an edge is lost in rounding. */
il_status il_overlay_build(il_overlay *o, const il_reference *r, const il_snapped *s, bool *sound, il_error *err);

/* Add N free points xy[2*N] and triangulate anew. */
il_status il_overlay_add_points(il_overlay *o, const double *xy, size_t n, il_error *err);

void il_overlay_free(il_overlay *o);

/* What the edge from contour point A to B is: IL_EDGE_… flags in this direction. */
unsigned char il_overlay_edge(const il_overlay *o, uint32_t a, uint32_t b);

/* The point of the upper slice that stands at contour point P, which the upper side passes. */
void il_overlay_upper_point(const il_overlay *o, uint32_t p, double out[2]);

/* Is triangle T part of the surface? */
static inline bool il_overlay_is_sheet(const il_overlay *o, uint32_t t)
{
    return t != IL_NONE && (o->inside[t] == IL_EDGE_LOWER || o->inside[t] == IL_EDGE_UPPER);
}

#endif
