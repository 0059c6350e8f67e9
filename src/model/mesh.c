#include "config.h"
#include "model/mesh.h"
#include "base/alloc.h"
#include "bridge/predicates.h"

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

/* One of its three shadows along the axes has. */
bool il_triangle_has_area(const double a[3], const double b[3], const double c[3])
{
    for (int x = 0; x < 3; x++) {
        int y = (x + 1) % 3;
        const double p[3][2] = { { a[x], a[y] }, { b[x], b[y] }, { c[x], c[y] } };
        if (il_orientation(p[0], p[1], p[2]) != 0)
            return true;
    }
    return false;
}
