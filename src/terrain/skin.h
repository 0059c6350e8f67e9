/* skin.h - the mesh of a terrain: the surface, and for a solid its walls and floor. */
#ifndef IL_TERRAIN_SKIN_H
#define IL_TERRAIN_SKIN_H

#include "model/mesh.h"
#include "terrain/cliff.h"

/* xyz[3*n_vertices] in the mesh's coordinates; node[v]: of the chart, the same one for all that
 * stand at one place of the plane; level[v]: of a line that passes through it, -1 for none.
 * tri[3*n_triangles]: first n_surface of the surface, then n_cliff upright ones where lines run
 * together, then n_wall of the walls, then the floor; slab[t]: the level below the triangle's
 * band, -1 for none, walls and floor; of a cliff the level at its foot.  n_pinches: places where the
 * frame touches itself; the surface has a vertex there for each of its parts that meet. */
typedef struct il_skin {
    double *xyz;             size_t n_vertices, cap_vertices;
    uint32_t *node;          size_t cap_nodes;
    int32_t *level;          size_t cap_levels;
    uint32_t *tri;           size_t n_triangles, cap_triangles;
    int32_t *slab;           size_t cap_slabs;
    size_t n_surface, n_cliff, n_wall, n_pinches;
} il_skin;

#define IL_SKIN_INIT { 0 }
void il_skin_free(il_skin *s); /* safe twice */

/* The surface of T, whose nodes all have a height; a height of the map becomes one of the
 * mesh by HEAD's placement.  IL_E_SURFACE where cliffs would cross themselves; IL_E_NOMEM. */
il_status il_skin_lay(il_skin *s, const il_tin *t, const il_chart *c, const il_band *band,
                      const il_stack_head *head, const il_placement_options *o, il_error *err);

/* Close S with walls along the frame and a flat floor at height FLOOR of the mesh, below all of
 * S.  IL_E_NOMEM; S can only be freed then. */
il_status il_skin_close(il_skin *s, const il_tin *t, const il_chart *c, double floor, il_error *err);

#endif
