/* rows.h - the image of a ring's edges under a deformation, broken where it bends. */
#ifndef IL_MATCH_ROWS_H
#define IL_MATCH_ROWS_H

#include "match/course.h"

typedef struct il_rows {
    il_course_row *row;      size_t n, cap;
} il_rows;

/* Append the row of place (VERTEX, T) that lies at P; rows rise.  False without memory. */
bool il_rows_add(il_rows *r, uint32_t vertex, double t, const double p[2]);

/* A map of the plane, APPLY(CONTEXT, p), that is straight to within what is asked for or not.
 * cell: of the raster that it was found on, and spacing: of its points, in cells, both in the
 * unit of the coordinates where that is not the cell. */
typedef struct il_bend {
    void (*apply)(const void *context, double p[2]);
    const void *context;
    bool straight;
    double cell, spacing;
} il_bend;

/* That of FIT. */
il_bend il_bend_of_fit(const il_fit *fit, double cell, double spacing);

/* Rows for the part [T0, T1) of the edge FROM .. TO, which begins at VERTEX: as many as its
 * image has bends.  False: no memory. */
bool il_rows_add_part(il_rows *r, const il_bend *b, uint32_t vertex, const double from[2], const double to[2], double t0, double t1);

#endif
