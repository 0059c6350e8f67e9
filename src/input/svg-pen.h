/* svg-pen.h - draws lines, Bezier curves and elliptic arcs into rings.
 *
 * The pen is told user coordinates; what it leaves behind are polylines in the
 * stack's coordinates.  Curves are flattened there, so the tolerance is the
 * stack's, whatever the transforms. */
#ifndef IL_INPUT_SVG_PEN_H
#define IL_INPUT_SVG_PEN_H

#include "input/svg-transform.h"
#include "model/stack.h"

/* Coordinates at or beyond this are refused. */
#define IL_SVG_COORDINATE_LIMIT 1e15

/* matrix: user to stack coordinates.  flatness: farthest a curve may lie from
 * its polyline, > 0.  n_points counts what was drawn over all subpaths and may
 * not pass max_points.  The rest is the subpath being drawn: its start and the
 * pen's place (stack coordinates), and its ring in SLICE once it has an edge. */
typedef struct il_svg_pen {
    il_affine matrix;
    double flatness;
    size_t max_points, n_points;
    long line;
    il_slice *slice;
    il_ring *ring;
    double start_x, start_y, x, y;
} il_svg_pen;

/* Begin a subpath; the one before is left open. */
il_status il_svg_pen_move(il_svg_pen *p, double x, double y, il_error *err);

il_status il_svg_pen_line(il_svg_pen *p, double x, double y, il_error *err);

/* Quadratic and cubic Bezier curves from where the pen is: control points, end. */
il_status il_svg_pen_quadratic(il_svg_pen *p, const double q[4], il_error *err);
il_status il_svg_pen_cubic(il_svg_pen *p, const double c[6], il_error *err);

/* The arc of the path command A from (X0, Y0), where the pen is, to (X, Y):
 * SVG 1.1 (2nd edition) appendix F.6, radii too small grown (F.6.6). */
typedef struct il_svg_arc {
    double rx, ry, rotation_deg;
    bool large, sweep;
} il_svg_arc;
il_status il_svg_pen_arc(il_svg_pen *p, double x0, double y0, const il_svg_arc *arc,
                         double x, double y, il_error *err);

/* A whole ellipse with axes along x and y, as a closed subpath. */
il_status il_svg_pen_ellipse(il_svg_pen *p, double cx, double cy, double rx, double ry, il_error *err);

/* Close the subpath; a following line starts where it started. */
void il_svg_pen_close(il_svg_pen *p);

/* End the last subpath, which stays open unless its ends coincide. */
void il_svg_pen_end(il_svg_pen *p);

#endif
