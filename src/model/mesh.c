#include "config.h"
#include "model/mesh.h"
#include "base/alloc.h"

#include <string.h>

void il_mesh_free(il_mesh *m)
{
    il_free(m->xyz);
    il_free(m->origin);
    il_free(m->tri);
    *m = (il_mesh)IL_MESH_INIT;
}

bool il_mesh_add_vertex(il_mesh *m, const double xyz[3], il_origin origin)
{
    if (!il_grow(&m->xyz, &m->cap_vertices, m->n_vertices + 1, 3 * sizeof *m->xyz) ||
        !il_grow(&m->origin, &m->cap_origins, m->n_vertices + 1, sizeof *m->origin))
        return false;
    memcpy(m->xyz + 3 * m->n_vertices, xyz, 3 * sizeof *xyz);
    m->origin[m->n_vertices++] = origin;
    return true;
}

bool il_mesh_add_triangle(il_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    if (!il_grow(&m->tri, &m->cap_triangles, m->n_triangles + 1, 3 * sizeof *m->tri))
        return false;
    uint32_t *t = m->tri + 3 * m->n_triangles++;
    t[0] = a, t[1] = b, t[2] = c;
    return true;
}
