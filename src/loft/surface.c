#include "config.h"
#include "loft/surface.h"
#include "base/alloc.h"

#include <string.h>

void il_surface_free(il_surface *s)
{
    il_free(s->tri);
    il_free(s->inner);
    il_free(s->insertion[0]);
    il_free(s->insertion[1]);
    il_free(s->pinched);
    *s = (il_surface)IL_SURFACE_INIT;
}

void il_surface_replace(il_surface *s, il_surface *with)
{
    for (int k = 0; k < 2; k++) {
        il_free(with->insertion[k]);
        with->insertion[k] = s->insertion[k];
        with->n_insertions[k] = s->n_insertions[k];
        with->cap_insertions[k] = s->cap_insertions[k];
        s->insertion[k] = NULL;
    }
    il_surface_free(s);
    *s = *with;
    *with = (il_surface)IL_SURFACE_INIT;
}

double *il_surface_positions(const il_surface *s, const il_section *lower, const il_section *upper)
{
    const il_section *section[2] = { lower, upper };
    double *xyz = il_alloc(lower->n_nodes + upper->n_nodes + s->n_inner, 3 * sizeof *xyz), *p = xyz;
    if (!xyz)
        return NULL;
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < section[k]->n_nodes; i++, p += 3)
            p[0] = section[k]->xy[2 * i], p[1] = section[k]->xy[2 * i + 1], p[2] = section[k]->z;
    if (s->n_inner > 0)
        memcpy(p, s->inner, 3 * s->n_inner * sizeof *p);
    return xyz;
}

bool il_surface_add_triangle(il_surface *s, uint32_t a, uint32_t b, uint32_t c)
{
    if (!il_grow(&s->tri, &s->cap_triangles, 3 * (s->n_triangles + 1), sizeof *s->tri))
        return false;
    uint32_t *t = s->tri + 3 * s->n_triangles++;
    t[0] = a, t[1] = b, t[2] = c;
    return true;
}

uint32_t il_surface_add_inner(il_surface *s, const double xyz[3])
{
    if (s->n_inner >= UINT32_MAX / 3 - 1 || !il_grow(&s->inner, &s->cap_inner, 3 * (s->n_inner + 1), sizeof *s->inner))
        return UINT32_MAX;
    memcpy(s->inner + 3 * s->n_inner, xyz, 3 * sizeof *xyz);
    return IL_CODE(IL_INNER, s->n_inner++);
}
