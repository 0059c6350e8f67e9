/* svg-page.h - a page of SVG 1.1, written from top to bottom and as high as it gets.
 *
 * Lengths on the page are CSS pixels, y down.  Everything is written with two
 * decimals, and outlines lose the vertices that a page cannot show. */
#ifndef IL_OUTPUT_SVG_PAGE_H
#define IL_OUTPUT_SVG_PAGE_H

#include "base/output.h"

/* body: all between the header and the end.  y: how far down the page is full.
 * tolerance: how far an outline on the page may lie from the true one, about. */
typedef struct il_svg_page {
    il_output *to, *body;
    double width, y, tolerance;
    const char *path;           /* attributes of the path that is being written */
    bool path_open;             /* and its element has begun */
    unsigned clips;
} il_svg_page;

/* From a plane to the page: x -> page_x + scale (x - x0), y -> page_y - scale (y - y0),
 * so that up in the plane is up on the page. */
typedef struct il_svg_view {
    double x0, y0, page_x, page_y, scale;
} il_svg_view;

/* Begin a page of that width, for TO (borrowed).  IL_E_NOMEM. */
il_status il_svg_page_begin(il_svg_page *p, il_output *to, double width, il_error *err);
/* Write it all to TO, Y pixels high.  TITLE is the document's. */
il_status il_svg_page_finish(il_svg_page *p, const char *title, il_error *err);
void il_svg_page_free(il_svg_page *p); /* safe twice */

/* A group of elements with ATTRIBUTES, which are markup and so never from a file. */
void il_svg_open(il_svg_page *p, const char *attributes);
void il_svg_close(il_svg_page *p);
/* A group clipped to a rectangle. */
void il_svg_open_clipped(il_svg_page *p, double x, double y, double width, double height);

/* A path: subpaths between begin and end.  Without any, nothing is written. */
void il_svg_path_begin(il_svg_page *p, const char *attributes);
void il_svg_path_end(il_svg_page *p);
/* The N points xy[2*n] joined, and the last with the first when CLOSED.  What is
 * too small to show is a dot.  O(n). */
void il_svg_outline(il_svg_page *p, const il_svg_view *v, const double *xy, size_t n, bool closed);
/* From (x, y) to (x2, y2) on the page. */
void il_svg_segment(il_svg_page *p, double x, double y, double x2, double y2);

void il_svg_rectangle(il_svg_page *p, double x, double y, double width, double height, const char *attributes);
void il_svg_circle(il_svg_page *p, double x, double y, double radius, const char *attributes);
/* TEXT is data: escaped here.  It stands on the line at Y. */
void il_svg_text(il_svg_page *p, double x, double y, const char *attributes, const char *text);

/* Where V puts the point (x, y); far off the page is at its edge, and so is what
 * is no number. */
void il_svg_view_point(const il_svg_view *v, double x, double y, double at[2]);

#endif
