/* rt-roi.h - what a structure set says of one region of interest (ROI). */
#ifndef IL_INPUT_RT_ROI_H
#define IL_INPUT_RT_ROI_H

#include "model/report.h"

#include <stdbool.h>
#include <stddef.h>

/* How the points of a contour are kept: a plane across axis 0, 1 or 2 has one
 * coordinate the same in all points, bit for bit, which is kept once. */
typedef enum il_rt_layout { IL_RT_ACROSS_X, IL_RT_ACROSS_Y, IL_RT_ACROSS_Z, IL_RT_OBLIQUE } il_rt_layout;

/* One closed contour, its first point not repeated.  Oblique: p[3*n], patient
 * coordinates in mm; across axis k: p[2*n], the coordinates k + 1 and k + 2 modulo
 * 3, and LEVEL is coordinate k.  Owned by its ROI.  is_xor: of type
 * CLOSEDPLANAR_XOR. */
typedef struct il_rt_contour {
    double *p;
    size_t n;
    il_rt_layout layout;
    bool is_xor;
    double level;
    long line;
} il_rt_contour;

void il_rt_contour_free(il_rt_contour *c); /* leaves an empty one; safe twice */

/* C, which is empty, takes over the N points at *XYZ, which is null then. */
void il_rt_contour_take_points(il_rt_contour *c, double **xyz, size_t n);

/* Point I of C in patient coordinates. */
void il_rt_contour_point(const il_rt_contour *c, size_t i, double xyz[3]);

/* Texts are UTF-8, owned, and null where the file says nothing.  fault: why the
 * ROI cannot be had, null when it can.  report: what was skipped of it.
 * n_points: of its contours.  rank: the least comes first. */
typedef struct il_rt_roi {
    bool has_number, has_color;
    long number;
    size_t rank;
    unsigned char color[3];
    char *name, *algorithm, *type, *frame_uid, *fault;
    long line, fault_line;
    il_rt_contour *contour;     size_t n, cap;
    size_t n_points;
    il_report report;
} il_rt_roi;

void il_rt_roi_free(il_rt_roi *r); /* with its contours and report; likewise */

/* Take over the contour C.  False without memory. */
bool il_rt_roi_add(il_rt_roi *r, il_rt_contour *c);

/* Say why R cannot be had, unless that is said already.  IL_E_NOMEM. */
il_status il_rt_roi_fail(il_rt_roi *r, long line, il_error *err, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* What FROM has goes to TO: contours behind TO's, the rest where TO has none.
 * FROM is empty then.  IL_E_NOMEM. */
il_status il_rt_roi_merge(il_rt_roi *to, il_rt_roi *from, il_error *err);

#endif
