/* sheet.c - the triangles over the sheets of an overlay (loft.md 5 and 6).
 *
 * Each sheet triangle becomes a small polygon: its corners, two copies of them
 * where the sheet contains a vertical edge, and the middles of edges that would
 * lie flat.  What cannot be cut up otherwise becomes a star round its centre. */
#include "config.h"
#include "loft/axis.h"
#include "loft/builder.h"
#include "loft/inverse.h"
#include "loft/polygon.h"
#include "loft/star.h"
#include "base/alloc.h"
#include "base/number.h"

#include <string.h>

typedef struct sheets {
    il_builder *b;
    il_labels labels;
    il_heights heights;
    il_free_point *free;      /* the overlay's free points, then middles, then centres */
    size_t n_free, cap_free;
    uint32_t *code;           /* [n_free] their codes, once they have heights */
    uint32_t *middle;         /* [3*n_triangles] free point on the edge, or IL_NONE */
    uint32_t *centre;         /* [n_triangles] free point of a star, or IL_NONE */
    bool *done;               /* [components] built as stars */
} sheets;

static bool add_free(sheets *s, double x, double y, uint32_t component, uint32_t *id)
{
    if (!il_grow(&s->free, &s->cap_free, s->n_free + 1, sizeof *s->free))
        return false;
    s->free[s->n_free] = (il_free_point){ x, y, { 0, 0 }, component, 0 };
    *id = (uint32_t)s->n_free++;
    return true;
}

/* The overlay's own free points; the component is that of any triangle there. */
static bool take_free_points(sheets *s)
{
    const il_overlay *o = s->b->o;
    uint32_t id;
    for (size_t i = o->n_contour; i < o->n_points; i++)
        if (!add_free(s, o->xy[2 * i], o->xy[2 * i + 1], 0, &id))
            return false;
    for (size_t e = 0; e < 3 * o->n_triangles; e++)
        if (o->corner[e] >= o->n_contour)
            s->free[o->corner[e] - o->n_contour].component = s->heights.component[e / 3];
    return true;
}

/* A free point at the middle of every edge that is still flat. */
static bool add_middles(sheets *s)
{
    const il_overlay *o = s->b->o;
    for (uint32_t e = 0; e < 3 * o->n_triangles; e++) {
        uint32_t t = e / 3, k = e % 3, u = o->across[e];
        if (s->middle[e] != IL_NONE || !il_overlay_is_sheet(o, t) || !il_labels_flat(&s->labels, o, t, k))
            continue;
        const double *a = o->xy + 2 * o->corner[e], *b = o->xy + 2 * o->corner[3 * t + (k + 1) % 3];
        if (!add_free(s, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, s->heights.component[t], &s->middle[e]))
            return false;
        for (uint32_t f = 3 * u; f < 3 * u + 3; f++)
            if (o->across[f] == t && o->corner[f] == o->corner[3 * t + (k + 1) % 3])
                s->middle[f] = s->middle[e];
    }
    return true;
}

static void add_corner(il_polygon *p, uint32_t code, size_t at, unsigned char label)
{
    p->v[p->n++] = (il_polygon_vertex){ code, (unsigned char)at, label, { 0, 0, 0 } };
}

/* Position of a polygon's vertex, from its grid position: good for lengths. */
static void place(const sheets *s, il_polygon_vertex *v, const double *grid, double z)
{
    const il_overlay *o = s->b->o;
    v->xyz[0] = grid[0] * o->snapped->cell;
    v->xyz[1] = grid[1] * o->snapped->cell;
    v->xyz[2] = z * (s->b->section[IL_UPPER]->z - s->b->section[IL_LOWER]->z);
}

/* The polygon of triangle T; codes are free-point numbers for free vertices and
 * contour points for others, resolved when triangles are made. */
static void make_polygon(const sheets *s, uint32_t t, il_polygon *p)
{
    const il_overlay *o = s->b->o;
    p->n = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t e = 3 * t + k, point = o->corner[e];
        const double *grid = o->xy + 2 * point;
        unsigned char in = s->labels.in[e], out = s->labels.out[e];
        if (point >= o->n_contour) {
            uint32_t f = point - (uint32_t)o->n_contour;
            add_corner(p, f, 2 * k, IL_FREE);
            place(s, &p->v[p->n - 1], grid, s->free[f].z);
        } else {
            add_corner(p, point, 2 * k, in);
            place(s, &p->v[p->n - 1], grid, in);
            if (out != in) {
                add_corner(p, point, 2 * k, out);
                place(s, &p->v[p->n - 1], grid, out);
            }
        }
        if (s->middle[e] != IL_NONE) {
            add_corner(p, s->middle[e], 2 * k + 1, IL_FREE);
            place(s, &p->v[p->n - 1], &s->free[s->middle[e]].x, s->free[s->middle[e]].z);
        }
        p->opposite[k] = (o->edge[e] & IL_EDGE_CONTOUR) == IL_EDGE_CONTOUR;
    }
}

/* Stars for triangles that cannot be cut up; lengths do not matter here. */
static bool add_centres(sheets *s)
{
    const il_overlay *o = s->b->o;
    unsigned char tri[3 * (IL_POLYGON_MAX - 2)];
    il_polygon p;
    for (uint32_t t = 0; t < o->n_triangles; t++) {
        if (!il_overlay_is_sheet(o, t))
            continue;
        make_polygon(s, t, &p);
        if (il_polygon_triangulate(&p, tri))
            continue;
        const double *a = o->xy + 2 * o->corner[3 * t], *b = o->xy + 2 * o->corner[3 * t + 1], *c = o->xy + 2 * o->corner[3 * t + 2];
        if (!add_free(s, (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, s->heights.component[t], &s->centre[t]))
            return false;
    }
    return true;
}

/* What takes the free points back to the upper slice.  Most slabs have none: the inverse is
 * built for those that do. */
static il_status take_back(sheets *s, il_error *err)
{
    il_inverse inverse = { 0 };
    if (s->n_free == 0 || !s->b->o->reference->deformed)
        return IL_OK;
    il_status st = il_inverse_build(&inverse, s->b->o, err);
    for (size_t i = 0; st == IL_OK && i < s->n_free; i++) {
        il_free_point *f = &s->free[i];
        il_inverse_shift(&inverse, (const double[2]){ f->x, f->y }, f->shift);
        for (size_t k = 0; k < 2; k++)
            f->shift[k] /= s->b->o->snapped->cell;
    }
    il_inverse_free(&inverse);
    return st;
}

/* Where free point F lies in space: psi_z(p) = (1 - z) p + z phi^-1(p). */
static void lift(const sheets *s, const il_free_point *f, double xyz[3])
{
    const il_snapped *grid = s->b->o->snapped;
    const double at[2] = { f->x, f->y };
    for (int k = 0; k < 2; k++) {
        xyz[k] = grid->origin[k] + grid->cell * at[k];
        xyz[k] += f->z * f->shift[k] * grid->cell;
        xyz[k] = s->b->options.round_float ? il_number_round_float(xyz[k]) : xyz[k];
    }
    xyz[2] = il_builder_height(s->b, f->z);
}

static il_status lift_free_points(sheets *s, il_error *err)
{
    s->code = il_alloc(s->n_free, sizeof *s->code);
    if (!s->code)
        return il_fail_nomem(err);
    for (size_t i = 0; i < s->n_free; i++) {
        double xyz[3];
        if (s->done[s->free[i].component])
            continue;
        lift(s, &s->free[i], xyz);
        s->code[i] = il_surface_add_inner(s->b->out, xyz);
        if (s->code[i] == UINT32_MAX)
            return il_fail_nomem(err);
    }
    return IL_OK;
}

static uint32_t code_of(const sheets *s, const il_polygon_vertex *v)
{
    return v->label == IL_FREE ? s->code[v->code] : il_builder_copy(s->b, v->label, v->code);
}

/* Over the lower region the sheet faces up, under the upper region down. */
static bool emit(const sheets *s, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
    bool up = s->b->o->inside[t] == IL_EDGE_LOWER;
    return a != IL_NONE && b != IL_NONE && c != IL_NONE &&
           il_surface_add_triangle(s->b->out, a, up ? b : c, up ? c : b);
}

static bool emit_triangle(const sheets *s, uint32_t t)
{
    unsigned char tri[3 * (IL_POLYGON_MAX - 2)];
    il_polygon p;
    uint32_t code[IL_POLYGON_MAX];
    make_polygon(s, t, &p);
    for (size_t i = 0; i < p.n; i++)
        code[i] = code_of(s, &p.v[i]);
    if (s->centre[t] != IL_NONE) {
        for (size_t i = 0; i < p.n; i++)
            if (!emit(s, t, code[i], code[(i + 1) % p.n], s->code[s->centre[t]]))
                return false;
        return true;
    }
    if (!il_polygon_triangulate(&p, tri))
        return false;
    for (size_t i = 0; i + 2 < p.n; i++)
        if (!emit(s, t, code[tri[3 * i]], code[tri[3 * i + 1]], code[tri[3 * i + 2]]))
            return false;
    return true;
}

static bool prepare(sheets *s)
{
    const il_overlay *o = s->b->o;
    s->middle = il_alloc(o->n_triangles, 3 * sizeof *s->middle);
    s->centre = il_alloc(o->n_triangles, sizeof *s->centre);
    if (!s->middle || !s->centre)
        return false;
    memset(s->middle, 0xFF, 3 * o->n_triangles * sizeof *s->middle);
    memset(s->centre, 0xFF, o->n_triangles * sizeof *s->centre);
    return take_free_points(s) && add_middles(s) && add_centres(s);
}

il_status il_build_sheets(il_builder *b, il_error *err)
{
    sheets s = { .b = b };
    il_status st = il_axis_insert(b->o, &s.labels, err);
    if (st == IL_OK)
        st = il_heights_build(&s.heights, b->o, err);
    s.done = st == IL_OK ? il_calloc(s.heights.n_components, sizeof *s.done) : NULL;
    if (st == IL_OK && (!s.done || !prepare(&s)))
        st = il_fail_nomem(err);
    if (st == IL_OK && b->options.stars)
        st = il_build_stars(b, s.heights.component, s.heights.n_components, s.done, err);
    if (st == IL_OK)
        st = take_back(&s, err);
    if (st == IL_OK)
        st = il_heights_set(&s.heights, s.free, s.n_free, b->options.rise, err);
    if (st == IL_OK)
        st = lift_free_points(&s, err);
    for (uint32_t t = 0; st == IL_OK && t < b->o->n_triangles; t++)
        if (il_overlay_is_sheet(b->o, t) && !s.done[s.heights.component[t]] && !emit_triangle(&s, t))
            st = il_fail_nomem(err);
    il_labels_free(&s.labels);
    il_heights_free(&s.heights);
    il_free(s.free);
    il_free(s.code);
    il_free(s.middle);
    il_free(s.centre);
    il_free(s.done);
    return st;
}
