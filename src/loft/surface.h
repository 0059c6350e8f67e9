/* surface.h - the triangles of one slab, as sheets and walls over an overlay. */
#ifndef IL_LOFT_SURFACE_H
#define IL_LOFT_SURFACE_H

#include "loft/section.h"

/* A vertex of a slab: a node of the lower or upper section (IL_LOWER, IL_UPPER)
 * or an inner point (IL_INNER), in one number that stays right when sections
 * and inner points grow. */
enum { IL_INNER = 2 };
#define IL_CODE(where, index) (3 * (uint32_t)(index) + (uint32_t)(where))
#define IL_CODE_WHERE(code) ((code) % 3)
#define IL_CODE_INDEX(code) ((code) / 3)

/* tri[3*n_triangles]: codes, outward by the right-hand rule.  inner[3*n_inner]:
 * x y z.  insertion[side][k] will be node n_nodes + k of that side's section,
 * with n_nodes as it was when the surface was built.  walled: the length of
 * matched edges that walls stand on, in the reference plane.  pinched: vertices
 * at which more than two triangles shared an edge, before it was split. */
typedef struct il_surface {
    uint32_t *tri;               size_t n_triangles, cap_triangles;
    double *inner;               size_t n_inner, cap_inner;
    il_split *insertion[2];  size_t n_insertions[2], cap_insertions[2];
    uint32_t *pinched;       size_t n_pinched, cap_pinched;
    double walled;
} il_surface;

#define IL_SURFACE_INIT { 0 }
void il_surface_free(il_surface *s);

/* Inner points are never nearer to a section than this part of the slab. */
#define IL_INNER_LEAST (1.0 / 1024)

/* *S becomes WITH, which is empty then, but keeps its insertions. */
void il_surface_replace(il_surface *s, il_surface *with);

/* The vertices in one row: the nodes of LOWER, those of UPPER, the inner points. */
static inline size_t il_surface_row(const il_section *lower, const il_section *upper, uint32_t code)
{
    size_t before[3] = { 0, lower->n_nodes, lower->n_nodes + upper->n_nodes };
    return before[IL_CODE_WHERE(code)] + IL_CODE_INDEX(code);
}

/* Where they stand, x y z; the caller's, to il_free.  Null without memory. */
double *il_surface_positions(const il_surface *s, const il_section *lower, const il_section *upper);

bool il_surface_add_triangle(il_surface *s, uint32_t a, uint32_t b, uint32_t c);

/* Append an inner point; its code, or UINT32_MAX without memory. */
uint32_t il_surface_add_inner(il_surface *s, const double xyz[3]);

#endif
