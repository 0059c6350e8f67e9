/* dxf-draw.c - entities as parts of the map: lines, polylines, arcs, points. */
#include "config.h"
#include "input/dxf-drawing.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* ---- groups ------------------------------------------------------------------------ */

static const il_dxf_group *find(const il_dxf *d, const il_dxf_entity *e, int code)
{
    const il_dxf_group *g = d->group + e->begin, *end = g + e->n;
    for (; g < end && g->code != 0; g++)
        if (g->code == code)
            return g;
    return NULL;
}

double il_dxf_value(const il_dxf *d, const il_dxf_entity *e, int code, double otherwise)
{
    const il_dxf_group *g = find(d, e, code);
    return g ? g->value : otherwise;
}

static il_status to_whole(const il_dxf_entity *e, const il_dxf_group *g, unsigned long *value, il_error *err)
{
    *value = 0;
    if (g && !(g->value >= 0 && g->value < 2147483648.0 && g->value == floor(g->value)))
        return il_fail(err, IL_E_INPUT, e->line + g->line, "group %d is no whole number from 0 to 2147483647", (int)g->code);
    if (g)
        *value = (unsigned long)g->value;
    return IL_OK;
}

il_status il_dxf_whole(const il_dxf *d, const il_dxf_entity *e, int code, unsigned long *value, il_error *err)
{
    return to_whole(e, find(d, e, code), value, err);
}

void il_dxf_skip(il_dxf *d, const il_dxf_entity *e, const char *why)
{
    il_map_skip(d->set, e->line, il_dictionary_text(&d->types, e->name), why);
}

/* ---- places ------------------------------------------------------------------------ */

/* The arbitrary axis algorithm gives a plane seen from above the axes of the world,
 * and one seen from below x and z the other way round.  A direction of which no more
 * than 1e-12 points aside is a rounded one. */
bool il_dxf_own_place(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_dxf_place *own)
{
    double x = il_dxf_value(d, e, 210, 0), y = il_dxf_value(d, e, 220, 0), z = il_dxf_value(d, e, 230, 1);
    *own = *place;
    if (!(fabs(x) <= 1e-12 * fabs(z) && fabs(y) <= 1e-12 * fabs(z) && z != 0)) {
        il_dxf_skip(d, e, "lies in a tilted plane");
        return false;
    }
    if (z < 0) {
        static const il_affine mirror = { -1, 0, 0, 1, 0, 0 };
        own->xy = il_affine_multiply(&place->xy, &mirror);
        own->z_scale = -place->z_scale;
    }
    return true;
}

il_status il_dxf_put(il_dxf *d, const il_dxf_place *place, double x, double y, double z, long line, il_error *err)
{
    il_affine_apply(&place->xy, &x, &y);
    return il_map_point(d->set, x, y, place->z_scale * z + place->z_shift, line, err);
}

/* ---- curves ------------------------------------------------------------------------- */

/* Without --flatness a hundredth of the drawing's unit, or a thousandth of the curve
 * where that is less: drawings in degrees and kilometres have curves too. */
double il_dxf_flatness(const il_dxf *d, double size)
{
    return d->options->flatness > 0 ? d->options->flatness : fmin(0.01, size / 1000);
}

/* Where the points of a curve go: the map's own coordinates, one height. */
typedef struct pencil {
    il_dxf *d;
    double z;
    long line;
} pencil;

static il_status put_curved(void *self, double x, double y, il_error *err)
{
    pencil *p = self;
    p->d->n_curved++;
    return il_map_point(p->d->set, x, y, p->z, p->line, err);
}

/* The ellipse E of a drawing, on the map. */
static il_ellipse place_ellipse(const il_dxf_place *place, const il_ellipse *e)
{
    il_affine turn = place->xy;
    il_ellipse to = *e;
    turn.e = turn.f = 0;
    il_affine_apply(&place->xy, &to.c.x, &to.c.y);
    il_affine_apply(&turn, &to.u.x, &to.u.y);
    il_affine_apply(&turn, &to.v.x, &to.v.y);
    return to;
}

/* From the unit vector a to b, counter-clockwise. */
typedef struct arc { il_vec a, b; bool is_large, is_whole; } arc;

/* E drawn from A to B, both ends too, or all round. */
static il_status draw_ellipse(il_dxf *d, const il_dxf_entity *entity, const il_dxf_place *place, const il_ellipse *given,
                              const arc *w, double z, il_error *err)
{
    il_ellipse e = place_ellipse(place, given);
    pencil to = { d, place->z_scale * z + place->z_shift, entity->line };
    il_curve_pen pen = { put_curved, &to, il_dxf_flatness(d, 2 * il_ellipse_radius(&e)) };
    il_vec a = w->is_whole ? (il_vec){ 1, 0 } : w->a, b = w->is_whole ? a : w->b;
    if (!(il_ellipse_radius(&e) < IL_COORDINATE_BOUND))
        return il_fail(err, IL_E_INPUT, entity->line, "a radius is not below 1e15");
    il_status st = il_map_begin_part(d->set, IL_MAP_LINE, entity->line, err);
    if (st == IL_OK)
        st = put_curved(&to, e.c.x + e.u.x * a.x + e.v.x * a.y, e.c.y + e.u.y * a.x + e.v.y * a.y, err);
    if (st == IL_OK)
        st = w->is_whole ? il_curve_ellipse(&pen, &e, err) : il_curve_arc(&pen, &e, w->a, w->b, w->is_large, true, err);
    if (st == IL_OK)
        st = put_curved(&to, e.c.x + e.u.x * b.x + e.v.x * b.y, e.c.y + e.u.y * b.x + e.v.y * b.y, err);
    return st == IL_OK ? il_map_end_part(d->set, err) : st;
}

/* CIRCLE and ARC; an arc of no angle, or of all but what rounding leaves, is whole. */
static il_status draw_circle(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    il_dxf_place own;
    double r = il_dxf_value(d, e, 40, 0), begin = il_dxf_value(d, e, 50, 0), end = il_dxf_value(d, e, 51, 360);
    if (!il_dxf_own_place(d, e, place, &own))
        return IL_OK;
    if (!(r > 0)) {
        il_dxf_skip(d, e, "has no radius above 0");
        return IL_OK;
    }
    double angle = fmod(end - begin, 360);
    angle += angle < 0 ? 360 : 0;
    arc w = { .is_large = angle > 180, .is_whole = e->kind == IL_DXF_CIRCLE || angle < 1e-6 || angle > 360 - 1e-6 };
    il_sincos_deg(begin, &w.a.y, &w.a.x);
    il_sincos_deg(end, &w.b.y, &w.b.x);
    il_ellipse given = { { il_dxf_value(d, e, 10, 0), il_dxf_value(d, e, 20, 0) }, { r, 0 }, { 0, r } };
    return draw_ellipse(d, e, &own, &given, &w, il_dxf_value(d, e, 30, 0), err);
}

/* In the world's coordinates; the direction says on which side of the long axis the
 * short one lies. */
static il_status draw_whole_ellipse(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    il_dxf_place own;
    if (!il_dxf_own_place(d, e, place, &own))
        return IL_OK;
    il_vec u = { il_dxf_value(d, e, 11, 0), il_dxf_value(d, e, 21, 0) };
    double k = il_dxf_value(d, e, 40, 1) * (il_dxf_value(d, e, 230, 1) < 0 ? -1 : 1);
    double begin = il_dxf_value(d, e, 41, 0), end = il_dxf_value(d, e, 42, 2 * pi), lift = il_dxf_value(d, e, 31, 0);
    double angle = fmod(end - begin, 2 * pi), length = sqrt(u.x * u.x + u.y * u.y);
    bool is_tilted = fabs(lift) > 1e-12 * length;
    if (is_tilted || !(length > 0) || k == 0) {
        il_dxf_skip(d, e, is_tilted ? "lies in a tilted plane" : "has an axis of no length");
        return IL_OK;
    }
    angle += angle < 0 ? 2 * pi : 0;
    arc w = { { cos(begin), sin(begin) }, { cos(end), sin(end) }, angle > pi, angle < 1e-5 || angle > 2 * pi - 1e-5 };
    il_ellipse given = { { il_dxf_value(d, e, 10, 0), il_dxf_value(d, e, 20, 0) }, u, { -k * u.y, k * u.x } };
    return draw_ellipse(d, e, place, &given, &w, il_dxf_value(d, e, 30, 0), err);
}

/* ---- polylines ------------------------------------------------------------------------ */

/* bulge: the tangent of a quarter of the angle of the arc to the next vertex, > 0 to
 * the left, as seen from above. */
typedef struct vertex {
    double x, y, z, bulge;
    unsigned long flags;
    long line;
} vertex;

/* The arc from P to Q, without its ends.  With h = (1 - b^2) / (4 b) chords the centre
 * lies to the left of the chord's middle. */
static il_status draw_bulge(il_dxf *d, const il_dxf_place *place, const vertex *p, const vertex *q, il_error *err)
{
    double b = p->bulge, dx = q->x - p->x, dy = q->y - p->y, h = (1 - b * b) / (4 * b), r = (1 + b * b) / (4 * fabs(b));
    double chord = sqrt(dx * dx + dy * dy);
    if (!(chord > 0) || !(r < 1e9) || !(r > 0)) /* no arc, or one that doubles cannot tell from a line */
        return IL_OK;
    il_ellipse given = { { p->x / 2 + q->x / 2 - h * dy, p->y / 2 + q->y / 2 + h * dx }, { r * chord, 0 }, { 0, r * chord } };
    il_ellipse e = place_ellipse(place, &given);
    il_vec a = { (h * dy - dx / 2) / (r * chord), (-h * dx - dy / 2) / (r * chord) };
    il_vec c = { (h * dy + dx / 2) / (r * chord), (-h * dx + dy / 2) / (r * chord) };
    pencil to = { d, place->z_scale * p->z + place->z_shift, p->line };
    double radius = il_ellipse_radius(&e);
    il_curve_pen pen = { put_curved, &to, il_dxf_flatness(d, fabs(b) > 1 ? 2 * radius : radius / r) };
    if (!(radius < 1e9 * IL_COORDINATE_BOUND))
        return il_fail(err, IL_E_INPUT, p->line, "the radius of an arc is beyond 1e24");
    return il_curve_arc(&pen, &e, a, c, fabs(b) > 1, b > 0, err);
}

/* The polyline drawn so far. */
typedef struct polyline {
    const il_dxf_place *place;
    bool is_flat, is_begun;     /* not 3-D: arcs, one height */
    vertex first, last;
} polyline;

static il_status draw_to(il_dxf *d, polyline *l, const vertex *v, il_error *err)
{
    il_status st = IL_OK;
    if (l->is_begun && l->is_flat && l->last.bulge != 0)
        st = draw_bulge(d, l->place, &l->last, v, err);
    if (st == IL_OK)
        st = il_dxf_put(d, l->place, v->x, v->y, v->z, v->line, err);
    if (!l->is_begun)
        l->first = *v;
    l->is_begun = true;
    l->last = *v;
    return st;
}

/* Groups may come in any order behind the one that begins a vertex, which is BEGINS.
 * The vertex at *I of the groups G[0..N), *I behind it; its elevation is Z if it
 * has none. */
static il_status take_vertex(const il_dxf_entity *e, const il_dxf_group *g, size_t n, size_t *i, double z, vertex *v, il_error *err)
{
    int begins = g[*i].code;
    il_status st = IL_OK;
    *v = (vertex){ 0, 0, z, 0, 0, e->line + (long)g[*i].line };
    do {
        switch (g[*i].code) {
        case 10: v->x = g[*i].value; break;
        case 20: v->y = g[*i].value; break;
        case 30: v->z = g[*i].value; break;
        case 42: v->bulge = g[*i].value; break;
        case 70: st = begins == 0 ? to_whole(e, &g[*i], &v->flags, err) : st; break;
        default: break;
        }
        ++*i;
    } while (st == IL_OK && *i < n && g[*i].code != begins);
    return st;
}

/* The vertices of E, in groups that begin with BEGINS, from its group I on; a closed
 * one comes back to its first. */
static il_status draw_vertices(il_dxf *d, const il_dxf_entity *e, size_t i, polyline *l, double z, bool is_closed, il_error *err)
{
    enum { SPLINE_CONTROL = 16 };
    const il_dxf_group *g = d->group + e->begin;
    il_status st = il_map_begin_part(d->set, IL_MAP_LINE, e->line, err);
    while (st == IL_OK && i < e->n) {
        vertex v;
        st = take_vertex(e, g, e->n, &i, z, &v, err);
        if (l->is_flat && z != 0)
            v.z = z;
        if (st == IL_OK && !(v.flags & SPLINE_CONTROL))
            st = draw_to(d, l, &v, err);
    }
    const vertex first = l->first;
    if (st == IL_OK && is_closed && l->is_begun && !(l->last.x == first.x && l->last.y == first.y))
        st = draw_to(d, l, &first, err);
    return st == IL_OK ? il_map_end_part(d->set, err) : st;
}

/* Index of the first group CODE of E, or n. */
static size_t index_of(const il_dxf *d, const il_dxf_entity *e, int code)
{
    size_t i = 0;
    while (i < e->n && d->group[e->begin + i].code != code)
        i++;
    return i;
}

static il_status draw_lwpolyline(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    il_dxf_place own;
    unsigned long flags;
    il_status st = il_dxf_whole(d, e, 70, &flags, err);
    if (st != IL_OK || !il_dxf_own_place(d, e, place, &own))
        return st;
    polyline l = { .place = &own, .is_flat = true };
    return draw_vertices(d, e, index_of(d, e, 10), &l, il_dxf_value(d, e, 38, 0), flags & 1, err);
}

/* Meshes are surfaces already. */
static il_status draw_polyline(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    enum { CLOSED = 1, IN_SPACE = 8, MESH = 16, POLYFACE = 64 };
    il_dxf_place own = *place;
    unsigned long flags;
    il_status st = il_dxf_whole(d, e, 70, &flags, err);
    if (st == IL_OK && flags & (MESH | POLYFACE)) {
        il_dxf_skip(d, e, "is a mesh");
        return IL_OK;
    }
    bool is_flat = !(flags & IN_SPACE);
    if (st != IL_OK || (is_flat && !il_dxf_own_place(d, e, place, &own)))
        return st;
    polyline l = { .place = &own, .is_flat = is_flat };
    return draw_vertices(d, e, index_of(d, e, 0), &l, is_flat ? il_dxf_value(d, e, 30, 0) : 0, flags & CLOSED, err);
}

/* ---- the simple ones --------------------------------------------------------------------- */

static il_status put_given(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, int code, il_error *err)
{
    return il_dxf_put(d, place, il_dxf_value(d, e, code, 0), il_dxf_value(d, e, code + 10, 0),
                      il_dxf_value(d, e, code + 20, 0), e->line, err);
}

static il_status draw_line(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    il_status st = il_map_begin_part(d->set, IL_MAP_LINE, e->line, err);
    if (st == IL_OK)
        st = put_given(d, e, place, 10, err);
    if (st == IL_OK)
        st = put_given(d, e, place, 11, err);
    return st == IL_OK ? il_map_end_part(d->set, err) : st;
}

static il_status draw_point(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    il_status st = il_map_begin_part(d->set, IL_MAP_POINT, e->line, err);
    if (st == IL_OK)
        st = put_given(d, e, place, 10, err);
    return st == IL_OK ? il_map_end_part(d->set, err) : st;
}

typedef il_status draw_kind(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err);

static il_status draw_feature(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    static draw_kind *const kinds[] = {
        [IL_DXF_ARC] = draw_circle,       [IL_DXF_CIRCLE] = draw_circle,         [IL_DXF_ELLIPSE] = draw_whole_ellipse,
        [IL_DXF_LINE] = draw_line,        [IL_DXF_LWPOLYLINE] = draw_lwpolyline, [IL_DXF_POINT] = draw_point,
        [IL_DXF_POLYLINE] = draw_polyline, [IL_DXF_SPLINE] = il_dxf_draw_spline };
    const il_dxf_layer *layer = &d->layers.layer[e->layer];
    il_status st = il_map_begin_feature(d->set, e->line, err);
    if (st == IL_OK)
        st = il_map_attribute(d->set, "Layer", 5, layer->name, layer->n_name, err);
    if (st == IL_OK)
        st = kinds[e->kind](d, e, place, err);
    return st == IL_OK ? il_map_end_feature(d->set, err) : st;
}

il_status il_dxf_draw(il_dxf *d, const il_dxf_entity *e, const il_dxf_place *place, il_error *err)
{
    il_dxf_layer *layer = &d->layers.layer[e->layer];
    if (e->kind == IL_DXF_INSERT && !e->is_paper && !e->is_hidden)
        return il_dxf_draw_insert(d, e, place, err); /* what it draws may be on any layer */
    *(layer->is_chosen ? &layer->n_taken : &layer->n_left) += 1;
    if (!layer->is_chosen)
        return IL_OK;
    const char *why = e->is_paper ? "is in paper space" : e->is_hidden ? "is hidden" : "is no line";
    if (!e->is_paper && !e->is_hidden && e->kind != IL_DXF_OTHER)
        return draw_feature(d, e, place, err);
    il_dxf_skip(d, e, why);
    return IL_OK;
}
