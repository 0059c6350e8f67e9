/* curve.c - arcs by bisection of unit vectors.
 *
 * An arc is C + U w_x + V w_y for unit vectors w from A to B.  It is cut into
 * quarters and a rest, and each of them into 2^k equal parts, where the vector
 * halfway between two is their sum made a unit.  So no sine of an angle is
 * taken: additions, products and square roots alone, which every IEEE machine
 * rounds alike, and the axes' ends come out exact. */
#include "config.h"
#include "input/curve.h"

#include <math.h>

static double dot(il_vec a, il_vec b) { return a.x * b.x + a.y * b.y; }
static double cross(il_vec a, il_vec b) { return a.x * b.y - a.y * b.x; }
static il_vec quarter_turn(il_vec a, bool sweep) { return sweep ? (il_vec){ -a.y, a.x } : (il_vec){ a.y, -a.x }; }

static il_vec halfway(il_vec a, il_vec b)
{
    il_vec m = { a.x + b.x, a.y + b.y };
    double n = sqrt(dot(m, m));
    return (il_vec){ m.x / n, m.y / n };
}

double il_curve_tolerance(double flatness, double size)
{
    return fmax(flatness, IL_RELATIVE_FLATNESS * size);
}

/* The larger singular value of (U V). */
double il_ellipse_radius(const il_ellipse *e)
{
    double p = e->u.x + e->v.y, q = e->u.x - e->v.y, r = e->u.y + e->v.x, s = e->u.y - e->v.x;
    return (sqrt(p * p + s * s) + sqrt(q * q + r * r)) / 2;
}

static il_status put_at(const il_curve_pen *p, const il_ellipse *e, il_vec w, il_error *err)
{
    return p->put(p->self, e->c.x + e->u.x * w.x + e->v.x * w.y, e->c.y + e->u.y * w.x + e->v.y * w.y, err);
}

/* Halvings until the chords of the piece A to B (at most a quarter turn) lie
 * within the tolerance: the sagitta of an angle h is radius (1 - cos(h/2)).
 * With s2 = sin^2(h/2) that is s2 / (1 + sqrt(1 - s2)), free of cancellation,
 * and half of it is s2 of the angle h/2.  With the relative tolerance at most
 * 9 halvings are needed; 12 bound a sum that is not finite. */
enum { MAX_HALVINGS = 12 };

static int halvings(const il_ellipse *e, il_vec a, il_vec b, double flatness)
{
    double radius = il_ellipse_radius(e);
    double s2 = fmin(((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y)) / 4, 1);
    double tolerance = il_curve_tolerance(flatness, 2 * radius * sqrt(s2));
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
static il_status put_between(const il_curve_pen *p, const il_ellipse *e, il_vec a, il_vec b, il_error *err)
{
    il_vec right[MAX_HALVINGS + 1] = { b };
    int depth[MAX_HALVINGS + 1] = { 0 }, top = 0, deepest = halvings(e, a, b, p->flatness);
    il_status st = IL_OK;
    for (il_vec left = a; st == IL_OK;) {
        if (depth[top] < deepest) {
            right[top + 1] = halfway(left, right[top]);
            depth[top + 1] = ++depth[top];
            top++;
        } else if (top == 0) {
            break;
        } else {
            left = right[top--];
            st = put_at(p, e, left, err);
        }
    }
    return st;
}

/* A large arc has two quarters at least and a small one two at most, so once
 * these are turned B lies within the next quarter when it lies on A's side; no
 * sign of a tiny cross product decides anything. */
il_status il_curve_arc(const il_curve_pen *p, const il_ellipse *e, il_vec a, il_vec b, bool large, bool sweep,
                       il_error *err)
{
    int least = large ? 2 : 0;
    for (int turned = 0; turned < 4 && !(turned >= least && dot(a, b) > 0);) {
        il_vec next = quarter_turn(a, sweep);
        il_status st = put_between(p, e, a, next, err);
        a = next;
        turned++;
        bool at_end = turned >= least && dot(a, b) > 0 && fabs(cross(a, b)) < 1e-12;
        if (st == IL_OK && !at_end)
            st = put_at(p, e, a, err);
        if (st != IL_OK || at_end)
            return st;
    }
    return put_between(p, e, a, b, err);
}

il_status il_curve_ellipse(const il_curve_pen *p, const il_ellipse *e, il_error *err)
{
    il_vec w = { 1, 0 };
    il_status st = IL_OK;
    for (int quarters = 0; quarters < 4 && st == IL_OK; quarters++) {
        il_vec next = quarter_turn(w, true);
        st = put_between(p, e, w, next, err);
        if (st == IL_OK && quarters < 3)
            st = put_at(p, e, next, err);
        w = next;
    }
    return st;
}
