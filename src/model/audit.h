/* audit.h - what a mesh is worth: closed, manifold, oriented, free of crossings. */
#ifndef IL_MODEL_AUDIT_H
#define IL_MODEL_AUDIT_H

#include "model/mesh.h"

/* Vertices are told apart by index, not by position: a mesh whose pinches were
 * split on purpose is manifold.  Positions count for areas and crossings. */
typedef struct il_audit {
    size_t vertices, triangles;
    size_t loose_vertices;          /* used by no triangle */
    size_t edges;
    size_t boundary_edges;          /* of one triangle */
    size_t nonmanifold_edges;       /* of more than two */
    size_t inconsistent_edges;      /* run unequally often in both directions, by two triangles or more */
    size_t nonmanifold_vertices;    /* whose triangles, joined across edges, form several fans */
    size_t degenerate_triangles;    /* without area, exactly; those that name a vertex twice have no edges either */
    size_t duplicate_triangles;     /* with the vertices of an earlier one, in any order */
    size_t components;              /* joined across edges */
    bool has_genus;                 /* closed, manifold and oriented */
    long genus;                     /* summed over the components (Euler) */
    size_t self_intersections;      /* pairs of triangles that meet in more than they share */
    bool more_intersections;        /* counting stopped at IL_AUDIT_INTERSECTIONS */
    uint32_t first_intersection[2]; /* the least such pair; UINT32_MAX without one */
    bool closed;                    /* no boundary edge */
    bool manifold;                  /* at edges and vertices */
    bool oriented;                  /* no inconsistent edge */
    bool outward;                   /* closed, oriented, solids positive and their cavities negative */
    double volume, area;            /* unit^3, signed; unit^2 */
    double lo[3], hi[3];            /* of the vertices in use */
} il_audit;

enum { IL_AUDIT_INTERSECTIONS = 1000000 };

/* Examine M: fewer than 2^32 / 3 triangles, which name only vertices that
 * exist, finite and below 1e15.  O(n log n) but for
 * triangles whose boxes overlap without meeting.  IL_E_NOMEM, IL_E_INTERNAL. */
il_status il_mesh_audit(const il_mesh *m, il_audit *out, il_error *err);

/* Nothing above is wrong: fit for printing or computing with.  Loose vertices
 * are no fault. */
bool il_audit_is_sound(const il_audit *a);

#endif
