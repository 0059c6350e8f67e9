/* dxf-spline.c - SPLINE: from groups to a rational B-spline on the map. */
#include "config.h"
#include "base/alloc.h"
#include "input/dxf-drawing.h"
#include "input/nurbs.h"

#include <math.h>

/* knot[n_knots], weight[n_weights], point[3 n_points], fit[3 n_fit], in D's work one
 * behind the other. */
typedef struct spline {
    const il_dxf_entity *e;
    size_t n_knots, n_weights, n_points, n_fit;
    double *knot, *weight, *point, *fit;
    unsigned long flags, degree;
} spline;

static il_status fail(const spline *s, il_error *err, const char *what)
{
    return il_fail(err, IL_E_INPUT, s->e->line, "SPLINE %s", what);
}

/* ---- taking it in ---------------------------------------------------------------- */

static void count(const il_dxf *d, spline *s)
{
    for (size_t i = 0; i < s->e->n; i++) {
        int code = d->group[s->e->begin + i].code;
        s->n_knots += code == 40;
        s->n_weights += code == 41;
        s->n_points += code == 10;
        s->n_fit += code == 11;
    }
}

static bool lay_out(il_dxf *d, spline *s)
{
    size_t need = s->n_knots + s->n_weights + 3 * s->n_points + 3 * s->n_fit;
    if (!il_grow(&d->work, &d->cap_work, need + 1, sizeof *d->work))
        return false;
    s->knot = d->work;
    s->weight = s->knot + s->n_knots;
    s->point = s->weight + s->n_weights;
    s->fit = s->point + 3 * s->n_points;
    for (size_t i = 0; i < 3 * s->n_points + 3 * s->n_fit; i++)
        s->point[i] = 0;
    return true;
}

/* y and z belong to the x before them. */
static void take(const il_dxf *d, spline *s)
{
    size_t knots = 0, weights = 0, points = 0, fits = 0;
    for (size_t i = 0; i < s->e->n; i++) {
        const il_dxf_group *g = &d->group[s->e->begin + i];
        switch (g->code) {
        case 40: s->knot[knots++] = g->value; break;
        case 41: s->weight[weights++] = g->value; break;
        case 10: s->point[3 * points++] = g->value; break;
        case 11: s->fit[3 * fits++] = g->value; break;
        case 20: case 30:
            if (points > 0)
                s->point[3 * points - 3 + (size_t)(g->code / 10 - 1)] = g->value;
            break;
        case 21: case 31:
            if (fits > 0)
                s->fit[3 * fits - 3 + (size_t)(g->code / 10 - 1)] = g->value;
            break;
        default: break;
        }
    }
}

/* Counts are compared, and not believed. */
static il_status check(const il_dxf *d, const spline *s, il_error *err)
{
    static const struct { int code; const char *what; } stated[] = {
        { 72, "states another number of knots than it has" }, { 73, "states another number of control points than it has" },
        { 74, "states another number of fit points than it has" } };
    const size_t has[] = { s->n_knots, s->n_points, s->n_fit };
    for (size_t k = 0; k < sizeof has / sizeof *has; k++)
        if (il_dxf_value(d, s->e, stated[k].code, (double)has[k]) != (double)has[k])
            return fail(s, err, stated[k].what);
    if (s->n_points == 0)
        return IL_OK;
    if (s->degree < 1 || s->degree > IL_NURBS_DEGREE_MOST || s->degree >= s->n_points)
        return il_fail(err, IL_E_INPUT, s->e->line, "SPLINE has the degree %lu, with %zu control points", s->degree, s->n_points);
    if (s->n_knots != s->n_points + s->degree + 1)
        return il_fail(err, IL_E_INPUT, s->e->line, "SPLINE has %zu knots; %zu control points of degree %lu take %zu",
                       s->n_knots, s->n_points, s->degree, s->n_points + s->degree + 1);
    for (size_t i = 1; i < s->n_knots; i++)
        if (s->knot[i] < s->knot[i - 1])
            return fail(s, err, "has knots that fall");
    if (!(s->knot[s->degree] < s->knot[s->n_points]) || !isfinite(s->knot[s->n_points] - s->knot[s->degree]))
        return fail(s, err, "has knots of no length");
    if (s->n_weights != 0 && s->n_weights != s->n_points)
        return fail(s, err, "has another number of weights than of control points");
    return IL_OK;
}

/* ---- drawing it -------------------------------------------------------------------- */

/* Points go to the map one late: the last of a closed curve is its first.  extent: of
 * the control points. */
typedef struct pencil {
    il_dxf *d;
    long line;
    double extent;
    bool is_begun;
    double first[3], held[3];
} pencil;

static il_status put_held(const pencil *p, il_error *err)
{
    return il_map_point(p->d->set, p->held[0], p->held[1], p->held[2], p->line, err);
}

static il_status put(void *self, double x, double y, double z, il_error *err)
{
    pencil *p = self;
    il_status st = p->is_begun ? put_held(p, err) : IL_OK;
    p->held[0] = x, p->held[1] = y, p->held[2] = z;
    if (!p->is_begun)
        p->first[0] = x, p->first[1] = y, p->first[2] = z;
    p->is_begun = true;
    p->d->n_curved++;
    return st;
}

/* A curve that is told to be closed comes back to its first point but for rounding;
 * where it does not, its ends are left to those who join lines. */
static il_status put_last(pencil *p, bool is_closed, il_error *err)
{
    double gap = hypot(p->held[0] - p->first[0], p->held[1] - p->first[1]);
    if (is_closed && gap <= 1e-6 * p->extent && p->first[2] == p->held[2])
        p->held[0] = p->first[0], p->held[1] = p->first[1];
    return put_held(p, err);
}

/* The control points on the map, in place; the extent of them all. */
static double place_points(const spline *s, const il_dxf_place *place)
{
    double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < s->n_points; i++) {
        double *p = s->point + 3 * i;
        il_affine_apply(&place->xy, &p[0], &p[1]);
        p[2] = place->z_scale * p[2] + place->z_shift;
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
    }
    return hypot(high[0] - low[0], high[1] - low[1]);
}

static il_status draw_curve(il_dxf *d, const spline *s, const il_dxf_place *place, il_error *err)
{
    enum { CLOSED = 1 };
    pencil to = { .d = d, .line = s->e->line, .extent = place_points(s, place) };
    il_nurbs c = { (int)s->degree, s->n_points, s->knot, s->point, s->n_weights > 0 ? s->weight : NULL };
    if (!(to.extent < 4 * IL_COORDINATE_BOUND))
        return fail(s, err, "has a control point that is not below 1e15");
    il_status st = il_nurbs_draw(&c, fmax(il_dxf_flatness(d, to.extent), 1e-300), put, &to, err);
    return st == IL_OK ? put_last(&to, s->flags & CLOSED, err) : st;
}

/* How curves run through such points is nowhere said. */
static il_status draw_fit_points(il_dxf *d, const spline *s, const il_dxf_place *place, il_error *err)
{
    il_status st = IL_OK;
    d->n_fit++;
    for (size_t i = 0; i < s->n_fit && st == IL_OK; i++)
        st = il_dxf_put(d, place, s->fit[3 * i], s->fit[3 * i + 1], s->fit[3 * i + 2], s->e->line, err);
    if (st == IL_OK && s->flags & 1 && s->n_fit > 0)
        st = il_dxf_put(d, place, s->fit[0], s->fit[1], s->fit[2], s->e->line, err);
    return st;
}

static const char *why_not(const spline *s)
{
    for (size_t i = 0; i < s->n_weights; i++)
        if (!(s->weight[i] > 1e-100 && s->weight[i] < 1e100))
            return "has a weight that is not above 0, or is beyond all sense";
    return NULL;
}

il_status il_dxf_draw_spline(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    spline s = { .e = e };
    il_status st = il_dxf_whole(d, e, 70, &s.flags, err);
    if (st == IL_OK)
        st = il_dxf_whole(d, e, 71, &s.degree, err);
    if (st != IL_OK)
        return st;
    count(d, &s);
    if (!lay_out(d, &s))
        return il_fail_nomem(err);
    take(d, &s);
    st = check(d, &s, err);
    const char *why = st == IL_OK ? why_not(&s) : NULL;
    if (why)
        il_dxf_skip(d, e, why);
    if (st != IL_OK || why)
        return st;
    st = il_map_begin_part(d->set, IL_MAP_LINE, e->line, err);
    if (st == IL_OK)
        st = s.n_points > 0 ? draw_curve(d, &s, place, err) : draw_fit_points(d, &s, place, err);
    return st == IL_OK ? il_map_end_part(d->set, err) : st;
}
