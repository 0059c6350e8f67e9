#include "config.h"
#include "input/svg-view.h"

#include <math.h>
#include <string.h>

/* ---- lengths --------------------------------------------------------------- */

static const struct { const char *name; il_svg_length_kind kind; double factor; } units[] = {
    { "", IL_SVG_LENGTH_USER, 1 },          { "px", IL_SVG_LENGTH_USER, 1 },
    { "%", IL_SVG_LENGTH_PERCENT, 1 },      { "mm", IL_SVG_LENGTH_MM, 1 },
    { "cm", IL_SVG_LENGTH_MM, 10 },         { "in", IL_SVG_LENGTH_MM, 25.4 },
    { "pt", IL_SVG_LENGTH_MM, 25.4 / 72 },  { "pc", IL_SVG_LENGTH_MM, 25.4 / 6 },
    { "Q", IL_SVG_LENGTH_MM, 0.25 },
};

static bool is_relative_unit(const il_svg_text *t)
{
    static const char *const names[] = { "em", "ex", "ch", "rem", "vw", "vh", "vmin", "vmax" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (il_svg_text_is_word(t, names[i]))
            return true;
    return false;
}

il_status il_svg_length_of(const il_svg_element *e, const char *name, il_svg_length *length, il_error *err)
{
    il_svg_text t;
    *length = (il_svg_length){ IL_SVG_LENGTH_NONE, 0 };
    if (!il_svg_attr(e, IL_SVG_NS_NONE, name, &t) || il_svg_text_is_word(&t, "auto"))
        return IL_OK;
    il_status st = il_svg_text_number(&t, &length->value, err);
    if (st != IL_OK)
        return st;
    length->kind = IL_SVG_LENGTH_OTHER;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (il_svg_text_is_word(&t, units[i].name)) {
            length->kind = units[i].kind;
            length->value *= units[i].factor;
            return IL_OK;
        }
    }
    return is_relative_unit(&t) ? IL_OK : il_svg_text_fail(&t, err, "a unit of length is expected");
}

/* ---- viewBox and preserveAspectRatio --------------------------------------- */

typedef struct view {
    double x, y, width, height;      /* viewBox */
    double align_x, align_y;         /* 0 min, 1/2 mid, 1 max */
    bool has_box, stretch, cover;    /* stretch: "none"; cover: "slice" */
} view;

static il_status read_box(const il_svg_element *e, view *v, il_error *err)
{
    il_svg_text t;
    v->has_box = il_svg_attr(e, IL_SVG_NS_NONE, "viewBox", &t);
    if (!v->has_box)
        return IL_OK;
    il_status st = il_svg_text_number(&t, &v->x, err);
    double *const rest[] = { &v->y, &v->width, &v->height };
    for (int i = 0; i < 3 && st == IL_OK; i++)
        st = il_svg_text_next_number(&t, rest[i], err);
    if (st == IL_OK && il_svg_text_more(&t))
        st = il_svg_text_fail(&t, err, "four numbers are enough");
    if (st == IL_OK && !(v->width > 0 && v->height > 0))
        st = il_fail(err, IL_E_INPUT, 0, "viewBox: width and height must be above 0");
    return st;
}

static bool take_word(il_svg_text *t, const char *word)
{
    size_t n = strlen(word);
    il_svg_text_more(t);
    if (t->n - t->at < n || memcmp(t->s + t->at, word, n) != 0)
        return false;
    t->at += n;
    return true;
}

/* -1 when no alignment of AXIS stands there. */
static double take_alignment(il_svg_text *t, char axis)
{
    static const struct { const char *name; double value; } places[] = { { "Min", 0 }, { "Mid", 0.5 }, { "Max", 1 } };
    if (t->at >= t->n || t->s[t->at] != axis)
        return -1;
    t->at++;
    for (int i = 0; i < 3; i++)
        if (t->n - t->at >= 3 && memcmp(t->s + t->at, places[i].name, 3) == 0)
            return t->at += 3, places[i].value;
    return -1;
}

static il_status read_aspect(const il_svg_element *e, view *v, il_error *err)
{
    il_svg_text t;
    v->align_x = v->align_y = 0.5;
    if (!il_svg_attr(e, IL_SVG_NS_NONE, "preserveAspectRatio", &t) || !il_svg_text_more(&t))
        return IL_OK;
    take_word(&t, "defer");
    v->stretch = take_word(&t, "none");
    if (v->stretch) {
        v->align_x = v->align_y = 0;
    } else {
        il_svg_text_more(&t);
        v->align_x = take_alignment(&t, 'x');
        v->align_y = take_alignment(&t, 'Y');
    }
    if (!take_word(&t, "meet"))
        v->cover = take_word(&t, "slice");
    if (il_svg_text_more(&t) || v->align_x < 0 || v->align_y < 0)
        return il_svg_text_fail(&t, err, "none, or an alignment such as xMidYMid, is expected");
    return IL_OK;
}

static il_status read_view(const il_svg_element *e, view *v, il_error *err)
{
    *v = (view){ 0 };
    il_status st = read_box(e, v, err);
    return st == IL_OK && v->has_box ? read_aspect(e, v, err) : st;
}

static void unify(const view *v, double *sx, double *sy)
{
    if (!v->stretch)
        *sx = *sy = v->cover ? fmax(*sx, *sy) : fmin(*sx, *sy);
}

/* ---- viewports --------------------------------------------------------------- */

static double user_size(il_svg_length l, double whole)
{
    if (l.kind == IL_SVG_LENGTH_USER)
        return l.value;
    double part = l.kind == IL_SVG_LENGTH_NONE ? 100 : l.kind == IL_SVG_LENGTH_PERCENT ? l.value : 0;
    return part / 100 * whole;
}

static il_status check_size(il_svg_length l, const char *name, il_error *err)
{
    if (l.kind != IL_SVG_LENGTH_NONE && !(l.value > 0))
        return il_fail(err, IL_E_INPUT, 0, "%s: must be above 0", name);
    return IL_OK;
}

static il_status read_sizes(const il_svg_element *e, il_svg_length *w, il_svg_length *h, il_error *err)
{
    il_status st = il_svg_length_of(e, "width", w, err);
    if (st == IL_OK)
        st = il_svg_length_of(e, "height", h, err);
    if (st == IL_OK)
        st = check_size(*w, "width", err);
    return st == IL_OK ? check_size(*h, "height", err) : st;
}

il_status il_svg_view_root(const il_svg_element *e, il_affine *scale, bool *is_physical,
                           il_svg_viewport *inside, il_error *err)
{
    view v;
    il_svg_length w = { IL_SVG_LENGTH_NONE, 0 }, h = w;
    *scale = (il_affine)IL_AFFINE_IDENTITY;
    *is_physical = false;
    *inside = (il_svg_viewport){ 0, 0 };
    il_status st = read_view(e, &v, err);
    if (st == IL_OK)
        st = read_sizes(e, &w, &h, err);
    if (st != IL_OK)
        return st;
    *inside = v.has_box ? (il_svg_viewport){ v.width, v.height }
                        : (il_svg_viewport){ user_size(w, 0), user_size(h, 0) };
    bool has_w = w.kind == IL_SVG_LENGTH_MM, has_h = h.kind == IL_SVG_LENGTH_MM;
    if (!v.has_box || (!has_w && !has_h))
        return IL_OK;
    scale->a = has_w ? w.value / v.width : h.value / v.height;
    scale->d = has_h ? h.value / v.height : scale->a;
    unify(&v, &scale->a, &scale->d);
    *is_physical = true;
    return IL_OK;
}

/* Where the drawing of extent DRAWN starts in a room of extent ROOM. */
static double place(double at, double room, double drawn, double align, double origin, double scale)
{
    return at + align * (room - drawn) - origin * scale;
}

il_status il_svg_view_nested(const il_svg_element *e, il_svg_viewport outside, il_affine *m,
                             il_svg_viewport *inside, il_error *err)
{
    view v;
    il_svg_length x, y, w = { IL_SVG_LENGTH_NONE, 0 }, h = w;
    il_status st = read_view(e, &v, err);
    if (st == IL_OK)
        st = read_sizes(e, &w, &h, err);
    if (st == IL_OK)
        st = il_svg_length_of(e, "x", &x, err);
    if (st == IL_OK)
        st = il_svg_length_of(e, "y", &y, err);
    if (st != IL_OK)
        return st;
    double room_w = user_size(w, outside.width), room_h = user_size(h, outside.height);
    double at_x = x.kind == IL_SVG_LENGTH_NONE ? 0 : user_size(x, outside.width);
    double at_y = y.kind == IL_SVG_LENGTH_NONE ? 0 : user_size(y, outside.height);
    *inside = (il_svg_viewport){ room_w, room_h };
    *m = (il_affine){ 1, 0, 0, 1, at_x, at_y };
    if (!v.has_box)
        return IL_OK;
    if (!(room_w > 0 && room_h > 0))
        return il_fail(err, IL_E_INPUT, 0, "an svg inside another needs width and height for its viewBox");
    double sx = room_w / v.width, sy = room_h / v.height;
    unify(&v, &sx, &sy);
    *m = (il_affine){ sx, 0, 0, sy, place(at_x, room_w, v.width * sx, v.align_x, v.x, sx),
                          place(at_y, room_h, v.height * sy, v.align_y, v.y, sy) };
    *inside = (il_svg_viewport){ v.width, v.height };
    return IL_OK;
}
