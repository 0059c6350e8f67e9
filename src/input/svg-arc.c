/* svg-arc.c - the arcs of paths and the ellipses of shapes, for curve.c to cut. */
#include "config.h"
#include "input/svg-arc.h"

#include <math.h>

static il_status put(void *self, double x, double y, il_error *err)
{
    return il_svg_pen_put(self, x, y, err);
}

/* The ellipse to stack coordinates: U and V are directions. */
static il_status place_ellipse(const il_svg_pen *p, il_ellipse *e, il_error *err)
{
    il_affine turn = p->matrix;
    turn.e = turn.f = 0;
    il_affine_apply(&turn, &e->u.x, &e->u.y);
    il_affine_apply(&turn, &e->v.x, &e->v.y);
    il_status st = il_svg_pen_place(p, &e->c.x, &e->c.y, err);
    if (st == IL_OK && !(il_ellipse_radius(e) < IL_SVG_COORDINATE_LIMIT))
        st = il_fail(err, IL_E_INPUT, 0, "the radius of an arc is not finite or not below 1e15");
    return st;
}

il_status il_svg_pen_ellipse(il_svg_pen *p, double cx, double cy, double rx, double ry, il_error *err)
{
    il_ellipse e = { { cx, cy }, { rx, 0 }, { 0, ry } };
    const il_curve_pen pen = { put, p, p->flatness };
    il_status st = il_svg_pen_move(p, cx + rx, cy, err);
    if (st == IL_OK)
        st = place_ellipse(p, &e, err);
    if (st == IL_OK)
        st = il_curve_ellipse(&pen, &e, err);
    il_svg_pen_close(p);
    return st;
}

/* Section F.6.5 with everything divided by the radii: q is the first end seen
 * from the middle of the chord, so |q|^2 is the Lambda of F.6.6, and the centre
 * lies across it at sqrt((1 - Lambda) / Lambda) of its length. */
static void find_centre(il_vec q, double lambda, const il_svg_arc *arc, il_vec *centre)
{
    double k = lambda < 1 ? sqrt((1 - lambda) / lambda) : 0;
    if (arc->large == arc->sweep)
        k = -k;
    *centre = (il_vec){ k * q.y, -k * q.x };
}

il_status il_svg_pen_arc(il_svg_pen *p, double x0, double y0, const il_svg_arc *arc,
                         double x, double y, il_error *err)
{
    const il_curve_pen pen = { put, p, p->flatness };
    double rx = fabs(arc->rx), ry = fabs(arc->ry), s, c;
    if (x0 == x && y0 == y)
        return IL_OK;
    il_sincos_deg(arc->rotation_deg, &s, &c);
    il_vec half = { x0 / 2 - x / 2, y0 / 2 - y / 2 };
    il_vec q = { (c * half.x + s * half.y) / rx, (c * half.y - s * half.x) / ry };
    double lambda = q.x * q.x + q.y * q.y;
    if (rx == 0 || ry == 0 || !(lambda > 0)) /* F.6.2, or an arc too flat for doubles */
        return il_svg_pen_line(p, x, y, err);
    if (lambda > 1) { /* F.6.6: grow the radii until the chord is a diameter */
        double grow = hypot(q.x, q.y);
        rx *= grow, ry *= grow;
        q = (il_vec){ q.x / grow, q.y / grow };
        lambda = 1;
    }
    il_vec m;
    find_centre(q, lambda, arc, &m);
    il_vec a = { q.x - m.x, q.y - m.y }, b = { -q.x - m.x, -q.y - m.y };
    il_ellipse e = { { x0 / 2 + x / 2 + c * rx * m.x - s * ry * m.y, y0 / 2 + y / 2 + s * rx * m.x + c * ry * m.y },
                     { c * rx, s * rx }, { -s * ry, c * ry } };
    il_status st = place_ellipse(p, &e, err);
    if (st == IL_OK)
        st = il_curve_arc(&pen, &e, a, b, arc->large, arc->sweep, err);
    return st == IL_OK ? il_svg_pen_line(p, x, y, err) : st;
}
