/* pinch.c - edges of a slab that more than two triangles share. */
#include "config.h"
#include "loft/pinch.h"
#include "base/alloc.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One triangle at a shared edge A-B (a < b): half-edge 3 * t + k. */
typedef struct leaf {
    uint32_t a, b, half_edge;
    bool forward;           /* the half-edge runs from a to b */
    double angle;           /* of its apex round the edge, seen with a -> b towards the eye */
} leaf;

static uint32_t next_corner(uint32_t e)
{
    return e % 3 == 2 ? e - 2 : e + 1;
}

static int compare_leaves(const void *p, const void *q)
{
    const leaf *x = p, *y = q;
    if (x->a != y->a)
        return x->a < y->a ? -1 : 1;
    if (x->b != y->b)
        return x->b < y->b ? -1 : 1;
    if (x->angle != y->angle)
        return x->angle < y->angle ? -1 : 1;
    return x->half_edge < y->half_edge ? -1 : x->half_edge > y->half_edge;
}

static void cross(const double u[3], const double v[3], double out[3])
{
    out[0] = u[1] * v[2] - u[2] * v[1];
    out[1] = u[2] * v[0] - u[0] * v[2];
    out[2] = u[0] * v[1] - u[1] * v[0];
}

static double dot(const double u[3], const double v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/* Angle of point P round the axis a -> b, from a fixed direction across it. */
static double angle_round(const double a[3], const double b[3], const double p[3])
{
    double axis[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] }, to[3] = { p[0] - a[0], p[1] - a[1], p[2] - a[2] };
    double helper[3] = { 0, 0, 0 }, u[3], v[3];
    int least = fabs(axis[0]) <= fabs(axis[1]) ? 0 : 1;
    helper[fabs(axis[2]) < fabs(axis[least]) ? 2 : least] = 1;
    cross(axis, helper, u);
    cross(axis, u, v);
    double length = sqrt(dot(axis, axis));
    return atan2(dot(to, v) / length, dot(to, u));
}

static bool collect_leaves(const il_surface *s, const il_section *lower, const il_section *upper, leaf **list, size_t *n)
{
    il_keymap count = IL_KEYMAP_INIT;
    size_t cap = 0;
    bool ok = il_keymap_reserve(&count, 3 * s->n_triangles / 2 + 1);
    for (uint32_t e = 0; ok && e < 3 * s->n_triangles; e++) {
        uint32_t *c = il_keymap_put(&count, IL_KEYMAP_EDGE(s->tri[e], s->tri[next_corner(e)]), 0);
        ok = c != NULL;
        if (ok)
            ++*c;
    }
    for (uint32_t e = 0; ok && e < 3 * s->n_triangles; e++) {
        uint32_t a = s->tri[e], b = s->tri[next_corner(e)], apex = s->tri[next_corner(next_corner(e))];
        if (il_keymap_get(&count, IL_KEYMAP_EDGE(a, b), 0) <= 2)
            continue;
        ok = il_grow(list, &cap, *n + 1, sizeof **list);
        if (!ok)
            break;
        leaf l = { a < b ? a : b, a < b ? b : a, e, a < b, 0 };
        double pa[3], pb[3], p[3];
        il_surface_position(s, lower, upper, l.a, pa);
        il_surface_position(s, lower, upper, l.b, pb);
        il_surface_position(s, lower, upper, apex, p);
        l.angle = angle_round(pa, pb, p);
        (*list)[(*n)++] = l;
    }
    il_keymap_free(&count);
    return ok;
}

/* Split the triangle at LEAF by the inner point MIDDLE on its edge. */
static bool split_leaf(il_surface *s, const leaf *l, uint32_t middle)
{
    uint32_t *tri = s->tri + l->half_edge / 3 * 3, e = l->half_edge;
    uint32_t from = s->tri[e], to = s->tri[next_corner(e)], apex = s->tri[next_corner(next_corner(e))];
    tri[0] = from, tri[1] = middle, tri[2] = apex;
    return il_surface_add_triangle(s, middle, to, apex);
}

/* Note where the edge of leaf L ends: fans may meet in nothing but these points. */
static bool note_ends(il_surface *s, const leaf *l)
{
    if (!il_grow(&s->pinched, &s->cap_pinched, s->n_pinched + 2, sizeof *s->pinched))
        return false;
    s->pinched[s->n_pinched++] = l->a;
    s->pinched[s->n_pinched++] = l->b;
    return true;
}

/* The N leaves of one edge by rising angle: a half-edge against the axis has
 * the solid ahead of it, one along the axis behind it.  Join each of the first
 * kind to the next of the second. */
static il_status split_edge(il_surface *s, const il_section *lower, const il_section *upper, bool round_float,
                            const leaf *l, size_t n, il_error *err)
{
    double a[3], b[3], middle[3];
    if (!note_ends(s, l))
        return il_fail_nomem(err);
    il_surface_position(s, lower, upper, l->a, a);
    il_surface_position(s, lower, upper, l->b, b);
    for (int k = 0; k < 3; k++)
        middle[k] = a[k] + (b[k] - a[k]) / 2;
    for (int k = 0; k < 3 && round_float; k++)
        middle[k] = il_number_round_float(middle[k]);
    for (size_t i = 0; i < n; i++) {
        const leaf *start = &l[i], *end = &l[(i + 1) % n];
        if (start->forward == end->forward)
            return IL_E_SURFACE;
        if (start->forward)
            continue;
        uint32_t code = il_surface_add_inner(s, middle);
        if (code == UINT32_MAX || !split_leaf(s, start, code) || !split_leaf(s, end, code))
            return il_fail_nomem(err);
    }
    return IL_OK;
}

/* Mark the triangles of the N leaves as busy; false when one is already. */
static bool claim(unsigned char *busy, const leaf *l, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (busy[l[i].half_edge / 3])
            return false;
    for (size_t i = 0; i < n; i++)
        busy[l[i].half_edge / 3] = 1;
    return true;
}

/* One round: a triangle with two shared edges waits with the second for the
 * next.  *LEFT: edges that wait. */
static il_status split_round(il_surface *s, const il_section *lower, const il_section *upper, bool round_float,
                             unsigned char **touched, size_t *n_touched, size_t *n_split, size_t *left, il_error *err)
{
    leaf *l = NULL;
    size_t n = 0;
    il_status st = collect_leaves(s, lower, upper, &l, &n) ? IL_OK : il_fail_nomem(err);
    size_t n_old = s->n_triangles;
    unsigned char *busy = il_calloc(n_old, 1);
    if (st == IL_OK && !busy)
        st = il_fail_nomem(err);
    if (st == IL_OK && n > 0)
        qsort(l, n, sizeof *l, compare_leaves);
    *left = 0;
    for (size_t i = 0, j; st == IL_OK && i < n; i = j) {
        for (j = i; j < n && l[j].a == l[i].a && l[j].b == l[i].b; j++)
            continue;
        if (!claim(busy, l + i, j - i)) {
            ++*left;
            continue;
        }
        st = split_edge(s, lower, upper, round_float, l + i, j - i, err);
        ++*n_split;
    }
    size_t cap = *n_touched;
    if (st == IL_OK && !il_grow(touched, &cap, s->n_triangles, 1))
        st = il_fail_nomem(err);
    if (st == IL_OK) {
        memset(*touched + *n_touched, 0, n_old - *n_touched);
        for (size_t t = 0; t < n_old; t++)
            (*touched)[t] |= busy[t];
        memset(*touched + n_old, 1, s->n_triangles - n_old);
        *n_touched = s->n_triangles;
    }
    il_free(l);
    il_free(busy);
    return st;
}

il_status il_pinch_split_edges(il_surface *s, const il_section *lower, const il_section *upper,
                               bool round_float, unsigned char **touched, size_t *n_split, il_error *err)
{
    size_t n_touched = 0, left = 1;
    il_status st = IL_OK;
    *n_split = 0;
    while (st == IL_OK && left > 0)
        st = split_round(s, lower, upper, round_float, touched, &n_touched, n_split, &left, err);
    return st;
}
