/* solid.h - a closed mesh of triangles and the horizontal planes that cut it: for programs of the checks. */
#ifndef IL_TESTS_SOLID_H
#define IL_TESTS_SOLID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* xyz[3 * n_vertices], tri[3 * n_triangles].  slab_of[v]: how many of the planes z[n_planes]
 * (ascending, borrowed) vertex v is above, from solid_cut.  beyond[3 t + k]: the triangle behind
 * edge k of triangle t, which goes from its corner k to the next, from solid_find_neighbours. */
typedef struct solid {
    double *xyz;             size_t n_vertices;
    uint32_t *tri;           size_t n_triangles;
    const double *z;         size_t n_planes;
    uint32_t *slab_of, *beyond;
    double size;
} solid;

#define SOLID_INIT { 0 }
void solid_free(solid *s);

/* An OFF file of triangles; false: standard error has it why. */
bool solid_read(solid *s, const char *path);
void solid_cut(solid *s, const double *z, size_t n);
/* False: the mesh is open, or not oriented. */
bool solid_find_neighbours(solid *s);

/* The least and the greatest slab that triangle T has a part in. */
uint32_t solid_least_slab(const solid *s, size_t t);
uint32_t solid_greatest_slab(const solid *s, size_t t);

/* Of triangle T, which has corners on both sides of plane PLANE: the edge, 0 to 2, by which one
 * goes round it up (DIRECTION 1) or down (-1) through the plane, and where. */
int solid_edge_through(const solid *s, size_t t, uint32_t plane, int direction);
void solid_cross(const solid *s, size_t t, uint32_t plane, int direction, double at[2]);

/* P, or the end of the program. */
void *solid_must(void *p);
/* Says so on standard error; false. */
bool solid_fault(const char *what);

#endif
