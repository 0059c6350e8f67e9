/* course.h - the rings of one side of a group as points along the way, in cells. */
#ifndef IL_MATCH_COURSE_H
#define IL_MATCH_COURSE_H

#include "match/ffd.h"

/* Points of ring r (as numbered in the group) are first[r] .. first[r + 1] - 1, in
 * order: its vertices, and between them enough that none is further than
 * `spacing` from the next on the original contour.  Point k stands at
 * place (vertex, t) of its ring, `at` cells along it; (x, y) is where it lies in
 * the lower plane, (nx, ny) the outward normal there.  length[r]: of the ring. */

typedef struct il_course_point {
    double x, y, nx, ny, at, t;
    uint32_t vertex, ring;
} il_course_point;

typedef struct il_course {
    il_course_point *point;  size_t n, cap;
    size_t *first;           size_t n_rings, cap_first;
    double *length;          size_t cap_length;
    double spacing;           /* cells; to be set before rings are added */
} il_course;

#define IL_COURSE_INIT { 0 }
void il_course_free(il_course *c);

/* One row of the image of a ring: place and where it lies. */
typedef struct il_course_row {
    uint32_t vertex;
    double t, x, y;
} il_course_row;

/* Append a ring with vertices xy[2*n] in its own plane; rows[n_rows] its image,
 * straight between rows, every vertex among them; null: the ring as it is.
 * Cells.  IL_E_NOMEM: C is only good to be freed. */
il_status il_course_add(il_course *c, const double *xy, size_t n, const il_course_row *row, size_t n_rows, il_error *err);

/* Set all normals; after the last ring. */
void il_course_set_normals(il_course *c);

/* The point after, and the one before, point K on its ring. */
static inline size_t il_course_after(const il_course *c, size_t k)
{
    return k + 1 == c->first[c->point[k].ring + 1] ? c->first[c->point[k].ring] : k + 1;
}

static inline size_t il_course_before(const il_course *c, size_t k)
{
    return k == c->first[c->point[k].ring] ? c->first[c->point[k].ring + 1] - 1 : k - 1;
}

#endif
