/* mesh.h - triangles with the origin of every vertex, and the pieces they come in. */
#ifndef IL_MODEL_MESH_H
#define IL_MODEL_MESH_H

#include "model/pair.h"
#include "model/stack.h"

/* Where a vertex comes from: indices of the normalised stream from 0, or -1
 * when isoloft inserted it (then slice is the plane it lies in, or -1). */
typedef struct il_origin { int32_t stack, slice, ring, vertex; } il_origin;

/* A piece of one stack's mesh: the vertices it adds and its triangles.
 * xyz[3*n_vertices], origin[n_vertices]; tri[3*n_triangles] count the vertices
 * of the stack's whole mesh from 0 and never exceed those given so far.
 * Outward normals by the right-hand rule. slab: index of the lower slice. */
typedef struct il_mesh {
    double *xyz;      size_t n_vertices, cap_vertices;
    il_origin *origin; size_t cap_origins;
    uint32_t *tri;    size_t n_triangles, cap_triangles;
    int32_t slab;
} il_mesh;

#define IL_MESH_INIT { 0 }
void il_mesh_free(il_mesh *m);
bool il_mesh_add_vertex(il_mesh *m, const double xyz[3], il_origin origin);
bool il_mesh_add_triangle(il_mesh *m, uint32_t a, uint32_t b, uint32_t c);

/* Is the area of the triangle not 0, exactly?  Finite coordinates. */
bool il_triangle_has_area(const double a[3], const double b[3], const double c[3]);

/* What a finished stack looks like: filled by the stage that makes the surface.  Of
 * terrain, slices are levels, rings lines, and faces what lines and frame divide the
 * map into.  is_open: it is bounded by the frame of a map, and has neither volume nor
 * genus (0). */
typedef struct il_mesh_facts {
    bool is_open;
    size_t vertices, triangles, slices, rings, points, faces;
    size_t pinches;          /* vertices or edges where the input touches itself, split */
    size_t between;          /* planes put between slices, and slabs whose bends met, */
    size_t slabs_halved, slabs_straight; /* so that they were halved, or left out everywhere (loft/curve.h) */
    long components, genus;
    double volume, area;     /* unit^3, unit^2 */
    double step, spread;     /* of the field and the law of a map's heights (terrain/smooth.h); 0 where there is none */
    /* of the contours, each in both of its slabs, unit: by the attempts that
     * settled them, and of those without a partner in the slab's other slice */
    double length_by[IL_N_ATTEMPTS], length_alone;
} il_mesh_facts;

/* Where meshes go.  Calls: (begin piece* end)* finish; the writer spools until
 * `end` says that the stack is certified, and writes nothing for a stack that
 * ends in `abandon`. */
typedef struct il_mesh_sink il_mesh_sink;
struct il_mesh_sink {
    il_status (*begin)(il_mesh_sink *self, const il_stack_head *head, il_error *err);
    il_status (*piece)(il_mesh_sink *self, const il_mesh *piece, il_error *err);
    il_status (*end)(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err);
    void (*abandon)(il_mesh_sink *self);
    il_status (*finish)(il_mesh_sink *self, il_error *err);
};

#endif
