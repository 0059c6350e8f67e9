#include "config.h"
#include "input/svg-shape.h"
#include "input/svg-path.h"
#include "input/svg-view.h"

#include <string.h>

/* What a draw function works on; see il_svg_shape_draw. */
typedef struct job {
    const il_svg_element *e;
    il_svg_pen *pen;
    const char *why;
    il_svg_text *at;
    il_error *err;
} job;

struct il_svg_shape {
    const char *name;
    il_status (*draw)(job *j);
};

/* ---- lists of points and path data -------------------------------------------- */

static il_status take_pair(il_svg_text *t, bool first, double *x, double *y, il_error *err)
{
    il_status st = first ? il_svg_text_number(t, x, err) : il_svg_text_next_number(t, x, err);
    if (st == IL_OK && !il_svg_text_more(t))
        st = il_svg_text_fail(t, err, "an x without its y");
    return st == IL_OK ? il_svg_text_next_number(t, y, err) : st;
}

static il_status draw_points(job *j)
{
    il_svg_text *t = j->at;
    il_status st = IL_OK;
    if (!il_svg_attr(j->e, IL_SVG_NS_NONE, "points", t) || !il_svg_text_more(t)) {
        j->why = "it has no points";
        return IL_OK;
    }
    for (bool first = true; st == IL_OK && il_svg_text_more(t); first = false) {
        double x, y;
        st = take_pair(t, first, &x, &y, j->err);
        if (st == IL_OK)
            st = first ? il_svg_pen_move(j->pen, x, y, j->err) : il_svg_pen_line(j->pen, x, y, j->err);
    }
    return st;
}

static il_status draw_polyline(job *j)
{
    il_status st = draw_points(j);
    il_svg_pen_end(j->pen);
    return st;
}

static il_status draw_polygon(job *j)
{
    il_status st = draw_points(j);
    il_svg_pen_close(j->pen);
    return st;
}

static il_status draw_path(job *j)
{
    if (!il_svg_attr(j->e, IL_SVG_NS_NONE, "d", j->at) || !il_svg_text_more(j->at) ||
        il_svg_text_is_word(j->at, "none")) {
        j->why = "it has no path data";
        return IL_OK;
    }
    return il_svg_path_draw(j->at, j->pen, j->err);
}

/* ---- shapes given by lengths ---------------------------------------------------- */

/* The attribute NAME in user units, MISSING when it is not there (*GIVEN tells,
 * if not null).  Lengths in mm and the like would mean 96 user units an inch,
 * whatever the drawing's scale, which is not what anyone means by them. */
static il_status take_length(job *j, const char *name, double missing, double *value, bool *given)
{
    il_svg_length l;
    il_status st = il_svg_length_of(j->e, name, &l, j->err);
    *value = l.kind == IL_SVG_LENGTH_NONE ? missing : l.value;
    if (given)
        *given = l.kind != IL_SVG_LENGTH_NONE;
    if (st == IL_OK && l.kind == IL_SVG_LENGTH_PERCENT)
        j->why = "it is measured in per cent";
    else if (st == IL_OK && (l.kind == IL_SVG_LENGTH_MM || l.kind == IL_SVG_LENGTH_OTHER))
        st = il_fail(j->err, IL_E_INPUT, 0, "%s: a length inside the drawing must be a plain number", name);
    return st;
}

static il_status take_size(job *j, const char *name, double missing, double *value, bool *given)
{
    il_status st = take_length(j, name, missing, value, given);
    if (st == IL_OK && *value < 0)
        st = il_fail(j->err, IL_E_INPUT, 0, "%s: must not be negative", name);
    return st;
}

static bool is_point(job *j, double w, double h)
{
    if (!j->why && (w == 0 || h == 0))
        j->why = "its size is 0";
    return j->why != NULL;
}

static il_status draw_line(job *j)
{
    double x1, y1, x2, y2;
    il_status st = take_length(j, "x1", 0, &x1, NULL);
    if (st == IL_OK)
        st = take_length(j, "y1", 0, &y1, NULL);
    if (st == IL_OK)
        st = take_length(j, "x2", 0, &x2, NULL);
    if (st == IL_OK)
        st = take_length(j, "y2", 0, &y2, NULL);
    if (st == IL_OK && !j->why)
        st = il_svg_pen_move(j->pen, x1, y1, j->err);
    if (st == IL_OK && !j->why)
        st = il_svg_pen_line(j->pen, x2, y2, j->err);
    il_svg_pen_end(j->pen);
    return st;
}

static il_status draw_ellipse_of(job *j, double rx, double ry)
{
    double cx, cy;
    il_status st = take_length(j, "cx", 0, &cx, NULL);
    if (st == IL_OK)
        st = take_length(j, "cy", 0, &cy, NULL);
    if (st != IL_OK || is_point(j, rx, ry))
        return st;
    return il_svg_pen_ellipse(j->pen, cx, cy, rx, ry, j->err);
}

static il_status draw_circle(job *j)
{
    double r;
    il_status st = take_size(j, "r", 0, &r, NULL);
    return st == IL_OK ? draw_ellipse_of(j, r, r) : st;
}

/* A radius that is missing is as the other one (SVG 2). */
static il_status take_radii(job *j, double *rx, double *ry)
{
    bool has_rx, has_ry = false;
    il_status st = take_size(j, "rx", 0, rx, &has_rx);
    if (st == IL_OK)
        st = take_size(j, "ry", *rx, ry, &has_ry);
    if (st == IL_OK && !has_rx && has_ry)
        *rx = *ry;
    return st;
}

static il_status draw_ellipse(job *j)
{
    double rx, ry;
    il_status st = take_radii(j, &rx, &ry);
    return st == IL_OK ? draw_ellipse_of(j, rx, ry) : st;
}

typedef struct box { double x, y, w, h, rx, ry; } box;

static il_status draw_sharp_rect(job *j, const box *b)
{
    double right = b->x + b->w, bottom = b->y + b->h;
    il_status st = il_svg_pen_move(j->pen, b->x, b->y, j->err);
    if (st == IL_OK)
        st = il_svg_pen_line(j->pen, right, b->y, j->err);
    if (st == IL_OK)
        st = il_svg_pen_line(j->pen, right, bottom, j->err);
    return st == IL_OK ? il_svg_pen_line(j->pen, b->x, bottom, j->err) : st;
}

/* Four sides and four quarters, each side beginning where a quarter ended
 * (SVG 1.1 section 9.2). */
static il_status draw_round_rect(job *j, const box *b)
{
    double x[4] = { b->x, b->x + b->rx, b->x + b->w - b->rx, b->x + b->w };
    double y[4] = { b->y, b->y + b->ry, b->y + b->h - b->ry, b->y + b->h };
    const double from[4][2] = { { x[2], y[0] }, { x[3], y[2] }, { x[1], y[3] }, { x[0], y[1] } };
    const double to[4][2] = { { x[3], y[1] }, { x[2], y[3] }, { x[0], y[2] }, { x[1], y[0] } };
    il_svg_arc arc = { b->rx, b->ry, 0, false, true };
    il_status st = il_svg_pen_move(j->pen, x[1], y[0], j->err);
    for (int i = 0; i < 4 && st == IL_OK; i++) {
        bool has_side = i % 2 == 0 ? x[1] < x[2] : y[1] < y[2];
        if (has_side)
            st = il_svg_pen_line(j->pen, from[i][0], from[i][1], j->err);
        if (st == IL_OK)
            st = il_svg_pen_arc(j->pen, from[i][0], from[i][1], &arc, to[i][0], to[i][1], j->err);
    }
    return st;
}

static il_status draw_rect(job *j)
{
    box b;
    il_status st = take_length(j, "x", 0, &b.x, NULL);
    if (st == IL_OK)
        st = take_length(j, "y", 0, &b.y, NULL);
    if (st == IL_OK)
        st = take_size(j, "width", 0, &b.w, NULL);
    if (st == IL_OK)
        st = take_size(j, "height", 0, &b.h, NULL);
    if (st == IL_OK)
        st = take_radii(j, &b.rx, &b.ry);
    if (st != IL_OK || is_point(j, b.w, b.h))
        return st;
    b.rx = b.rx > b.w / 2 ? b.w / 2 : b.rx;
    b.ry = b.ry > b.h / 2 ? b.h / 2 : b.ry;
    st = b.rx > 0 && b.ry > 0 ? draw_round_rect(j, &b) : draw_sharp_rect(j, &b);
    il_svg_pen_close(j->pen);
    return st;
}

/* ---- the table -------------------------------------------------------------------- */

static const il_svg_shape shapes[] = {
    { "polygon", draw_polygon }, { "path", draw_path },     { "polyline", draw_polyline }, { "line", draw_line },
    { "rect", draw_rect },       { "circle", draw_circle }, { "ellipse", draw_ellipse },
};

const il_svg_shape *il_svg_shape_named(const char *name)
{
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (strcmp(shapes[i].name, name) == 0)
            return &shapes[i];
    return NULL;
}

il_status il_svg_shape_draw(const il_svg_shape *shape, const il_svg_element *e, il_svg_pen *pen,
                            const char **why, il_svg_text *at, il_error *err)
{
    job j = { e, pen, NULL, at, err };
    *at = (il_svg_text){ 0 };
    il_status st = shape->draw(&j);
    *why = st == IL_OK ? j.why : NULL;
    return st;
}
