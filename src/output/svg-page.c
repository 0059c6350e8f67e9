#include "config.h"
#include "output/svg-page.h"
#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Beyond this nothing is on any page; keeps what is written short. */
static const double FAR = 20000;

/* ---- numbers and text ---------------------------------------------------- */

static long hundredths(double v)
{
    return lround(100 * v);
}

static void put_hundredths(il_output *o, long v)
{
    if (v < 0)
        il_output_char(o, '-');
    v = labs(v);
    if (v >= 100 || v == 0)
        il_output_integer(o, v / 100);
    if (v % 100 == 0)
        return;
    il_output_char(o, '.');
    il_output_char(o, (char)('0' + v / 10 % 10));
    if (v % 10 != 0)
        il_output_char(o, (char)('0' + v % 10));
}

/* NAME="V" behind a blank. */
static void put_attribute(il_output *o, const char *name, double v)
{
    il_output_char(o, ' ');
    il_output_string(o, name);
    il_output_string(o, "=\"");
    put_hundredths(o, hundredths(v));
    il_output_char(o, '"');
}

static const char *escaped(char c)
{
    return c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : NULL;
}

/* What XML has no character for is replaced: controls, broken UTF-8, U+FFFE, U+FFFF. */
static void put_text(il_output *o, const char *s)
{
    size_t n = strlen(s), length;
    for (size_t i = 0; i < n; i += length > 0 ? length : 1) {
        unsigned long code = 0;
        length = il_utf8_char(s + i, n - i, &code);
        if (length == 0 || code < 0x20 || code == 0x7F || (code & 0xFFFEul) == 0xFFFEul)
            il_output_string(o, "\xEF\xBF\xBD");
        else if (escaped(s[i]))
            il_output_string(o, escaped(s[i]));
        else
            il_output_write(o, s + i, length);
    }
}

/* ---- the page ------------------------------------------------------------ */

il_status il_svg_page_begin(il_svg_page *p, il_output *to, double width, il_error *err)
{
    *p = (il_svg_page){ .to = to, .width = width, .tolerance = 0.1 };
    return il_output_spool(&p->body, err);
}

static void put_header(const il_svg_page *p, const char *title)
{
    il_output *o = p->to;
    il_output_string(o, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"");
    put_attribute(o, "width", p->width);
    put_attribute(o, "height", p->y);
    il_output_string(o, " viewBox=\"0 0 ");
    put_hundredths(o, hundredths(p->width));
    il_output_char(o, ' ');
    put_hundredths(o, hundredths(p->y));
    il_output_string(o, "\" font-family=\"sans-serif\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<title>");
    put_text(o, title);
    il_output_string(o, "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
}

il_status il_svg_page_finish(il_svg_page *p, const char *title, il_error *err)
{
    put_header(p, title);
    il_status st = il_output_append_spool(p->to, p->body, err);
    il_output_string(p->to, "</svg>\n");
    return st == IL_OK ? il_output_status(p->to, err) : st;
}

void il_svg_page_free(il_svg_page *p)
{
    il_output_discard(p->body);
    p->body = NULL;
}

void il_svg_open(il_svg_page *p, const char *attributes)
{
    il_output_string(p->body, "<g ");
    il_output_string(p->body, attributes);
    il_output_string(p->body, ">\n");
}

void il_svg_close(il_svg_page *p)
{
    il_output_string(p->body, "</g>\n");
}

void il_svg_open_clipped(il_svg_page *p, double x, double y, double width, double height)
{
    il_output_string(p->body, "<clipPath id=\"clip");
    il_output_integer(p->body, ++p->clips);
    il_output_string(p->body, "\">\n");
    il_svg_rectangle(p, x, y, width, height, "");
    il_output_string(p->body, "</clipPath>\n<g clip-path=\"url(#clip");
    il_output_integer(p->body, p->clips);
    il_output_string(p->body, ")\">\n");
}

/* " ATTRIBUTES/>", the end of an element. */
static void put_end(il_svg_page *p, const char *attributes)
{
    if (*attributes)
        il_output_char(p->body, ' ');
    il_output_string(p->body, attributes);
    il_output_string(p->body, "/>\n");
}

void il_svg_rectangle(il_svg_page *p, double x, double y, double width, double height, const char *attributes)
{
    il_output_string(p->body, "<rect");
    put_attribute(p->body, "x", x);
    put_attribute(p->body, "y", y);
    put_attribute(p->body, "width", width);
    put_attribute(p->body, "height", height);
    put_end(p, attributes);
}

void il_svg_circle(il_svg_page *p, double x, double y, double radius, const char *attributes)
{
    il_output_string(p->body, "<circle");
    put_attribute(p->body, "cx", x);
    put_attribute(p->body, "cy", y);
    put_attribute(p->body, "r", radius);
    put_end(p, attributes);
}

void il_svg_text(il_svg_page *p, double x, double y, const char *attributes, const char *text)
{
    il_output_string(p->body, "<text");
    put_attribute(p->body, "x", x);
    put_attribute(p->body, "y", y);
    if (*attributes)
        il_output_char(p->body, ' ');
    il_output_string(p->body, attributes);
    il_output_char(p->body, '>');
    put_text(p->body, text);
    il_output_string(p->body, "</text>\n");
}

/* ---- paths --------------------------------------------------------------- */

void il_svg_path_begin(il_svg_page *p, const char *attributes)
{
    p->path = attributes;
    p->path_open = false;
}

void il_svg_path_end(il_svg_page *p)
{
    if (p->path_open) {
        il_output_string(p->body, "\"");
        put_end(p, p->path);
    }
    p->path = NULL;
    p->path_open = false;
}

/* Where the pen is, in hundredths: steps are written from there, so that
 * rounding does not add up.  fresh: no step since the move. */
typedef struct pen {
    il_svg_page *page;
    long x, y;
    bool fresh;
} pen;

static void put_pair(il_output *o, long x, long y)
{
    put_hundredths(o, x);
    if (y >= 0)
        il_output_char(o, ' ');
    put_hundredths(o, y);
}

static void pen_move(pen *w, const double at[2])
{
    il_output *o = w->page->body;
    if (w->page->path_open)
        il_output_char(o, '\n');
    else
        il_output_string(o, "<path d=\"");
    w->page->path_open = true;
    w->x = hundredths(at[0]);
    w->y = hundredths(at[1]);
    w->fresh = true;
    il_output_char(o, 'M');
    put_pair(o, w->x, w->y);
}

static void pen_step(pen *w, const double at[2])
{
    il_output *o = w->page->body;
    long x = hundredths(at[0]), y = hundredths(at[1]), dx = x - w->x, dy = y - w->y;
    if (dx == 0 && dy == 0)
        return;
    if (w->fresh)
        il_output_char(o, 'l');
    else if (dx >= 0)
        il_output_char(o, ' ');
    put_pair(o, dx, dy);
    w->x = x;
    w->y = y;
    w->fresh = false;
}

void il_svg_segment(il_svg_page *p, double x, double y, double x2, double y2)
{
    pen w = { p, 0, 0, true };
    pen_move(&w, (double[2]){ x, y });
    pen_step(&w, (double[2]){ x2, y2 });
}

/* ---- outlines, thinned --------------------------------------------------- */

/* A line from the anchor may replace the points behind it while its direction
 * is within the cone of those that pass each of them closer than the tolerance
 * (the sleeve of Zhao & Saalfeld 1997), and while the points do not turn back.
 * left, right: the cone's sides; far: how far from the anchor the points got. */
typedef struct thinner {
    double anchor[2], last[2], left[2], right[2], far;
    bool has_cone;
} thinner;

static void set_anchor(thinner *t, const double at[2])
{
    memcpy(t->anchor, at, sizeof t->anchor);
    memcpy(t->last, at, sizeof t->last);
    t->far = 0;
    t->has_cone = false;
}

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/* Take the next point AT; false when the line from the anchor cannot reach it. */
static bool reach(thinner *t, const double at[2], double tolerance)
{
    double d[2] = { at[0] - t->anchor[0], at[1] - t->anchor[1] }, length = hypot(d[0], d[1]);
    if (length < t->far - tolerance || (t->has_cone && (cross(t->right, d) < 0 || cross(t->left, d) > 0)))
        return false;
    t->far = fmax(t->far, length);
    memcpy(t->last, at, sizeof t->last);
    if (length <= tolerance)
        return true;
    double s = tolerance / length, c = sqrt(1 - s * s);
    double left[2] = { c * d[0] - s * d[1], s * d[0] + c * d[1] };
    double right[2] = { c * d[0] + s * d[1], c * d[1] - s * d[0] };
    if (!t->has_cone || cross(t->left, left) < 0)
        memcpy(t->left, left, sizeof left);
    if (!t->has_cone || cross(t->right, right) > 0)
        memcpy(t->right, right, sizeof right);
    t->has_cone = true;
    return true;
}

void il_svg_view_point(const il_svg_view *v, double x, double y, double at[2])
{
    at[0] = fmin(fmax(v->page_x + v->scale * (x - v->x0), -FAR), FAR);
    at[1] = fmin(fmax(v->page_y - v->scale * (y - v->y0), -FAR), FAR);
}

void il_svg_outline(il_svg_page *p, const il_svg_view *v, const double *xy, size_t n, bool closed)
{
    pen w = { p, 0, 0, true };
    thinner t;
    double at[2];
    if (n == 0)
        return;
    il_svg_view_point(v, xy[0], xy[1], at);
    pen_move(&w, at);
    set_anchor(&t, at);
    for (size_t k = 1; k < n; k++) {
        il_svg_view_point(v, xy[2 * k], xy[2 * k + 1], at);
        if (!reach(&t, at, p->tolerance)) {
            double last[2] = { t.last[0], t.last[1] };
            pen_step(&w, last);
            set_anchor(&t, last);
            reach(&t, at, p->tolerance);
        }
    }
    pen_step(&w, t.last);
    il_output_string(p->body, closed || w.fresh ? "z" : "");
}
