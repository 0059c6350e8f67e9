#include "config.h"
#include "loft/levels.h"
#include "base/alloc.h"
#include "loft/certificate.h"

#include <math.h>
#include <string.h>

/* cut: from an edge, lesser code first, to the first of its new points. */
typedef struct cutting {
    const il_levels *l;
    il_surface *out;
    uint32_t *parent;
    size_t cap_parent;
    il_keymap cut;
} cutting;

static const double *stand(const il_levels *l, uint32_t code)
{
    return l->xyz + 3 * il_surface_row(l->section[0], l->section[1], code);
}

/* ---- points -------------------------------------------------------------------- */

static bool move_inner(cutting *c)
{
    for (uint32_t i = 0; i < c->l->s->n_inner; i++) {
        size_t v = il_surface_row(c->l->section[0], c->l->section[1], IL_CODE(IL_INNER, i));
        double p[3];
        memcpy(p, c->l->xyz + 3 * v, sizeof p);
        c->l->move(c->l->self, v, v, 0, p);
        if (il_surface_add_inner(c->out, p) == UINT32_MAX)
            return false;
    }
    return true;
}

/* How many levels lie strictly between heights A and B; the lowest of them is *FIRST. */
static size_t levels_between(const il_levels *l, double a, double b, size_t *first)
{
    double low = fmin(a, b), high = fmax(a, b);
    size_t i = 0, n = 0;
    while (i < l->n && l->level[i] <= low)
        i++;
    *first = i;
    while (i + n < l->n && l->level[i + n] < high)
        n++;
    return n;
}

/* All points of edge AB, upwards, as inner points of OUT; the first of them. */
static uint32_t cut_edge(cutting *c, uint32_t a, uint32_t b, size_t first, size_t n)
{
    const il_levels *l = c->l;
    const double *p = stand(l, a), *q = stand(l, b);
    uint32_t from = (uint32_t)c->out->n_inner;
    for (size_t i = first; i < first + n; i++) {
        double f = (l->level[i] - p[2]) / (q[2] - p[2]);
        double r[3] = { p[0] + f * (q[0] - p[0]), p[1] + f * (q[1] - p[1]), l->level[i] };
        l->move(l->self, il_surface_row(l->section[0], l->section[1], a), il_surface_row(l->section[0], l->section[1], b), f, r);
        if (il_surface_add_inner(c->out, r) == UINT32_MAX)
            return UINT32_MAX;
    }
    return from;
}

/* The points of edge AB, N of them from level FIRST on; the first, or UINT32_MAX without memory. */
static uint32_t points_of(cutting *c, uint32_t a, uint32_t b, size_t first, size_t n)
{
    uint32_t *at = il_keymap_put(&c->cut, IL_KEYMAP_EDGE(a, b), UINT32_MAX);
    if (at && *at == UINT32_MAX)
        *at = a < b ? cut_edge(c, a, b, first, n) : cut_edge(c, b, a, first, n);
    return at ? *at : UINT32_MAX;
}

/* ---- triangles ------------------------------------------------------------------- */

/* A triangle's corners and the points of its edges, around. */
typedef struct outline {
    uint32_t code[3 + 2 * IL_LEVELS_MOST];
    double z[3 + 2 * IL_LEVELS_MOST];
    size_t n;
} outline;

static bool walk(cutting *c, const uint32_t *tri, outline *o)
{
    o->n = 0;
    for (size_t k = 0; k < 3; k++) {
        uint32_t a = tri[k], b = tri[(k + 1) % 3];
        double za = stand(c->l, a)[2], zb = stand(c->l, b)[2];
        size_t first, n = levels_between(c->l, za, zb, &first);
        uint32_t from = n > 0 ? points_of(c, a, b, first, n) : 0;
        if (from == UINT32_MAX)
            return false;
        o->code[o->n] = a;
        o->z[o->n++] = za;
        for (size_t i = 0; i < n; i++) {
            size_t at = za < zb ? i : n - 1 - i;
            o->code[o->n] = IL_CODE(IL_INNER, from + (uint32_t)at);
            o->z[o->n++] = c->l->level[first + at];
        }
    }
    return true;
}

static bool add(cutting *c, uint32_t parent, uint32_t a, uint32_t b, uint32_t d)
{
    if (!il_grow(&c->parent, &c->cap_parent, c->out->n_triangles + 1, sizeof *c->parent))
        return false;
    c->parent[c->out->n_triangles] = parent;
    return il_surface_add_triangle(c->out, a, b, d);
}

static double chord(const cutting *c, uint32_t a, uint32_t b)
{
    double p[3], q[3];
    il_surface_position(c->out, c->l->section[0], c->l->section[1], a, p);
    il_surface_position(c->out, c->l->section[0], c->l->section[1], b, q);
    return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
}

/* A convex polygon of at most five corners: the ear with the shortest chord is cut off until a
 * triangle is left. */
static bool fill(cutting *c, uint32_t parent, uint32_t *v, size_t n)
{
    for (; n > 3; n--) {
        size_t ear = 0;
        double least = INFINITY;
        for (size_t i = 0; i < n; i++) {
            double d = chord(c, v[i], v[(i + 2) % n]);
            ear = d < least ? (i + 1) % n : ear;
            least = fmin(least, d);
        }
        if (!add(c, parent, v[(ear + n - 1) % n], v[ear], v[(ear + 1) % n]))
            return false;
        memmove(v + ear, v + ear + 1, (n - ear - 1) * sizeof *v);
    }
    return n < 3 || add(c, parent, v[0], v[1], v[2]);
}

/* What lies between two levels has two points on each edge that it meets, and the corners within. */
static bool cut_triangle(cutting *c, uint32_t t)
{
    const il_levels *l = c->l;
    outline o;
    if (!walk(c, l->s->tri + 3 * (size_t)t, &o))
        return false;
    for (size_t k = 0; k <= l->n; k++) {
        double low = k > 0 ? l->level[k - 1] : -INFINITY, high = k < l->n ? l->level[k] : INFINITY;
        uint32_t v[6];
        size_t n = 0, above = 0;
        for (size_t i = 0; i < o.n; i++) {
            if (o.z[i] < low || o.z[i] > high)
                continue;
            above += o.z[i] > low; /* a triangle that lies in a level is part of what is below */
            v[n++] = o.code[i];
        }
        if (n >= 3 && above > 0 && !fill(c, t, v, n))
            return false;
    }
    return true;
}

static bool copy_pinched(il_surface *out, const il_surface *s)
{
    if (s->n_pinched == 0)
        return true;
    if (!il_grow(&out->pinched, &out->cap_pinched, s->n_pinched, sizeof *out->pinched))
        return false;
    memcpy(out->pinched, s->pinched, s->n_pinched * sizeof *s->pinched);
    out->n_pinched = s->n_pinched;
    return true;
}

il_status il_levels_cut(il_surface *out, uint32_t **parent, const il_levels *l, il_error *err)
{
    cutting c = { .l = l, .out = out };
    *out = (il_surface)IL_SURFACE_INIT;
    out->walled = l->s->walled;
    bool ok = copy_pinched(out, l->s) && move_inner(&c);
    for (size_t t = 0; ok && t < l->s->n_triangles; t++)
        ok = cut_triangle(&c, (uint32_t)t);
    *parent = c.parent;
    il_keymap_free(&c.cut);
    return ok ? IL_OK : il_fail_nomem(err);
}
