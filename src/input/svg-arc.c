/* svg-arc.c - elliptic arcs as polylines, by bisection of unit vectors.
 *
 * An arc is C + U w_x + V w_y for unit vectors w from A to B.  It is cut into
 * quarters and a rest, and each of them into 2^k equal parts, where the vector
 * halfway between two is their sum made a unit.  So no sine of an angle is
 * taken: additions, products and square roots alone, which every IEEE machine
 * rounds alike, and the axes' ends come out exact. */
#include "config.h"
#include "input/svg-arc.h"

#include <math.h>

typedef struct vec { double x, y; } vec;

/* The ellipse C + U w_x + V w_y in stack coordinates. */
typedef struct ellipse { vec c, u, v; } ellipse;

static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y; }
static double cross(vec a, vec b) { return a.x * b.y - a.y * b.x; }
static vec quarter_turn(vec a, bool sweep) { return sweep ? (vec){ -a.y, a.x } : (vec){ a.y, -a.x }; }

static vec halfway(vec a, vec b)
{
    vec m = { a.x + b.x, a.y + b.y };
    double n = sqrt(dot(m, m));
    return (vec){ m.x / n, m.y / n };
}

/* Length of the longer half axis: the larger singular value of (U V). */
static double longest_radius(const ellipse *e)
{
    double p = e->u.x + e->v.y, q = e->u.x - e->v.y, r = e->u.y + e->v.x, s = e->u.y - e->v.x;
    return (sqrt(p * p + s * s) + sqrt(q * q + r * r)) / 2;
}

static vec on_ellipse(const ellipse *e, vec w)
{
    return (vec){ e->c.x + e->u.x * w.x + e->v.x * w.y, e->c.y + e->u.y * w.x + e->v.y * w.y };
}

/* Halvings until the chords of the piece A to B (at most a quarter turn) lie
 * within the tolerance: the sagitta of an angle h is radius (1 - cos(h/2)).
 * With s2 = sin^2(h/2) that is s2 / (1 + sqrt(1 - s2)), free of cancellation,
 * and half of it is s2 of the angle h/2.  With the relative tolerance at most
 * 9 halvings are needed; 12 bound a sum that is not finite. */
enum { MAX_HALVINGS = 12 };

static int halvings(const ellipse *e, vec a, vec b, double flatness)
{
    double radius = longest_radius(e);
    double s2 = fmin(((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y)) / 4, 1);
    double tolerance = il_svg_tolerance(flatness, 2 * radius * sqrt(s2));
    for (int k = 0; k < MAX_HALVINGS; k++) {
        double versine = s2 / (1 + sqrt(1 - s2));
        if (!(radius * versine > tolerance))
            return k;
        s2 = versine / 2;
    }
    return MAX_HALVINGS;
}

/* The points after A up to and without B, in order.  A stack of the right
 * ends takes the place of recursion. */
static il_status put_between(il_svg_pen *p, const ellipse *e, vec a, vec b, il_error *err)
{
    vec right[MAX_HALVINGS + 1] = { b };
    int depth[MAX_HALVINGS + 1] = { 0 }, top = 0, deepest = halvings(e, a, b, p->flatness);
    il_status st = IL_OK;
    for (vec left = a; st == IL_OK;) {
        if (depth[top] < deepest) {
            right[top + 1] = halfway(left, right[top]);
            depth[top + 1] = ++depth[top];
            top++;
        } else if (top == 0) {
            break;
        } else {
            left = right[top--];
            vec q = on_ellipse(e, left);
            st = il_svg_pen_put(p, q.x, q.y, err);
        }
    }
    return st;
}

/* From A, where the pen is, to B without B itself, which the caller puts
 * exactly.  A large arc has two quarters at least and a small one two at most,
 * so once these are turned B lies within the next quarter when it lies on A's
 * side; no sign of a tiny cross product decides anything. */
static il_status put_arc(il_svg_pen *p, const ellipse *e, vec a, vec b, bool large, bool sweep, il_error *err)
{
    int least = large ? 2 : 0;
    for (int turned = 0; turned < 4 && !(turned >= least && dot(a, b) > 0);) {
        vec next = quarter_turn(a, sweep);
        il_status st = put_between(p, e, a, next, err);
        a = next;
        turned++;
        bool at_end = turned >= least && dot(a, b) > 0 && fabs(cross(a, b)) < 1e-12;
        vec q = on_ellipse(e, a);
        if (st == IL_OK && !at_end)
            st = il_svg_pen_put(p, q.x, q.y, err);
        if (st != IL_OK || at_end)
            return st;
    }
    return put_between(p, e, a, b, err);
}

/* C, U and V to stack coordinates: U and V are directions. */
static il_status place_ellipse(const il_svg_pen *p, ellipse *e, il_error *err)
{
    il_svg_matrix turn = p->matrix;
    turn.e = turn.f = 0;
    il_svg_matrix_apply(&turn, &e->u.x, &e->u.y);
    il_svg_matrix_apply(&turn, &e->v.x, &e->v.y);
    il_status st = il_svg_pen_place(p, &e->c.x, &e->c.y, err);
    if (st == IL_OK && !(longest_radius(e) < IL_SVG_COORDINATE_LIMIT))
        st = il_fail(err, IL_E_INPUT, 0, "the radius of an arc is not finite or not below 1e15");
    return st;
}

il_status il_svg_pen_ellipse(il_svg_pen *p, double cx, double cy, double rx, double ry, il_error *err)
{
    ellipse e = { { cx, cy }, { rx, 0 }, { 0, ry } };
    vec w = { 1, 0 };
    il_status st = il_svg_pen_move(p, cx + rx, cy, err);
    if (st == IL_OK)
        st = place_ellipse(p, &e, err);
    for (int quarters = 0; quarters < 4 && st == IL_OK; quarters++) {
        vec next = quarter_turn(w, true), q = on_ellipse(&e, next);
        st = put_between(p, &e, w, next, err);
        if (st == IL_OK && quarters < 3)
            st = il_svg_pen_put(p, q.x, q.y, err);
        w = next;
    }
    il_svg_pen_close(p);
    return st;
}

/* Section F.6.5 with everything divided by the radii: q is the first end seen
 * from the middle of the chord, so |q|^2 is the Lambda of F.6.6, and the centre
 * lies across it at sqrt((1 - Lambda) / Lambda) of its length. */
static void find_centre(vec q, double lambda, const il_svg_arc *arc, vec *centre)
{
    double k = lambda < 1 ? sqrt((1 - lambda) / lambda) : 0;
    if (arc->large == arc->sweep)
        k = -k;
    *centre = (vec){ k * q.y, -k * q.x };
}

il_status il_svg_pen_arc(il_svg_pen *p, double x0, double y0, const il_svg_arc *arc,
                         double x, double y, il_error *err)
{
    double rx = fabs(arc->rx), ry = fabs(arc->ry), s, c;
    if (x0 == x && y0 == y)
        return IL_OK;
    il_svg_sincos(arc->rotation_deg, &s, &c);
    vec half = { x0 / 2 - x / 2, y0 / 2 - y / 2 };
    vec q = { (c * half.x + s * half.y) / rx, (c * half.y - s * half.x) / ry };
    double lambda = dot(q, q);
    if (rx == 0 || ry == 0 || !(lambda > 0)) /* F.6.2, or an arc too flat for doubles */
        return il_svg_pen_line(p, x, y, err);
    if (lambda > 1) { /* F.6.6: grow the radii until the chord is a diameter */
        double grow = hypot(q.x, q.y);
        rx *= grow, ry *= grow;
        q = (vec){ q.x / grow, q.y / grow };
        lambda = 1;
    }
    vec m, a, b;
    find_centre(q, lambda, arc, &m);
    a = (vec){ q.x - m.x, q.y - m.y };
    b = (vec){ -q.x - m.x, -q.y - m.y };
    ellipse e = { { x0 / 2 + x / 2 + c * rx * m.x - s * ry * m.y, y0 / 2 + y / 2 + s * rx * m.x + c * ry * m.y },
                  { c * rx, s * rx }, { -s * ry, c * ry } };
    il_status st = place_ellipse(p, &e, err);
    if (st == IL_OK)
        st = put_arc(p, &e, a, b, arc->large, arc->sweep, err);
    return st == IL_OK ? il_svg_pen_line(p, x, y, err) : st;
}
