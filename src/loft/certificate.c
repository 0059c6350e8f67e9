#include "config.h"
#include "loft/certificate.h"
#include "base/alloc.h"
#include "bridge/intersection.h"

#include <math.h>
#include <string.h>

const char *il_flaw_words(il_flaw f)
{
    switch (f) {
    case IL_FLAW_NONE:      return "sound";
    case IL_FLAW_BOUNDARY:  return "the surface does not end in the contours";
    case IL_FLAW_OPEN:      return "the surface is open";
    case IL_FLAW_CROSSING:  return "the surface meets itself";
    case IL_FLAW_REFERENCE: return "the contours are too close together to be told apart";
    }
    return "unknown";
}

void il_surface_position(const il_surface *s, const il_section *lower, const il_section *upper,
                         uint32_t code, double xyz[3])
{
    uint32_t i = IL_CODE_INDEX(code);
    if (IL_CODE_WHERE(code) == IL_INNER) {
        memcpy(xyz, s->inner + 3 * i, 3 * sizeof *xyz);
        return;
    }
    const il_section *section = IL_CODE_WHERE(code) == 0 ? lower : upper;
    xyz[0] = section->xy[2 * i];
    xyz[1] = section->xy[2 * i + 1];
    xyz[2] = section->z;
}

static void flaw_at(il_verdict *v, il_flaw flaw, const il_surface *s, const il_section *lower, const il_section *upper, uint32_t code)
{
    v->flaw = flaw;
    il_surface_position(s, lower, upper, code, v->at);
}

/* ---- (a) and (b): half-edges ---- */

static bool count_half_edges(il_keymap *count, const il_surface *s)
{
    if (!il_keymap_reserve(count, 3 * s->n_triangles))
        return false;
    for (size_t i = 0; i < 3 * s->n_triangles; i++) {
        uint32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1];
        ++*il_keymap_put(count, a, b, 0);
    }
    return true;
}

/* Every contour edge must be there once: as it runs in the lower plane, against
 * it in the upper.  Takes them out of the count. */
static bool take_contour(il_keymap *count, const il_section *section, int side, uint32_t *missing)
{
    for (size_t i = 0; i < section->n_stations; i++) {
        uint32_t a = IL_CODE(side, section->node_at[i]), b = IL_CODE(side, section->node_at[section->next[i]]);
        uint32_t from = side == 0 ? a : b, to = side == 0 ? b : a;
        if (il_keymap_get(count, from, to, 0) != 1) {
            *missing = a;
            return false;
        }
        *il_keymap_put(count, from, to, 0) = 0;
    }
    return true;
}

/* What is left over must cancel, and none of it may lie in a slice plane. */
static il_flaw check_rest(const il_keymap *count, const il_surface *s, uint32_t *where, size_t *multiple)
{
    for (size_t i = 0; i < 3 * s->n_triangles; i++) {
        uint32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1];
        uint32_t n = il_keymap_get(count, a, b, 0);
        *where = a;
        if (n == 0)
            continue;
        if (IL_CODE_WHERE(a) == IL_CODE_WHERE(b) && IL_CODE_WHERE(a) != IL_INNER)
            return IL_FLAW_BOUNDARY;
        if (il_keymap_get(count, b, a, 0) != n)
            return IL_FLAW_OPEN;
        *multiple += n > 1;
    }
    return IL_FLAW_NONE;
}

il_status il_certify_edges(const il_surface *s, const il_section *lower, const il_section *upper,
                           il_verdict *v, il_error *err)
{
    il_keymap count = IL_KEYMAP_INIT;
    uint32_t where = 0;
    *v = (il_verdict){ IL_FLAW_NONE, { 0, 0, 0 }, 0 };
    if (!count_half_edges(&count, s))
        return il_fail_nomem(err);
    if (!take_contour(&count, lower, 0, &where) || !take_contour(&count, upper, 1, &where)) {
        flaw_at(v, IL_FLAW_BOUNDARY, s, lower, upper, where);
    } else {
        il_flaw flaw = check_rest(&count, s, &where, &v->multiple);
        if (flaw != IL_FLAW_NONE)
            flaw_at(v, flaw, s, lower, upper, where);
    }
    il_keymap_free(&count);
    return IL_OK;
}

/* ---- folds ---- */

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* P less its part along AXIS. */
static void across(const double axis[3], double p[3])
{
    double along = dot(p, axis) / dot(axis, axis);
    for (int k = 0; k < 3; k++)
        p[k] -= along * axis[k];
}

/* Is the angle at edge AB between the triangles with the corners C and D below ANGLE? */
static bool is_fold(double p[4][3], double angle)
{
    double axis[3], c[3], d[3], e[3];
    subtract(p[1], p[0], axis);
    subtract(p[2], p[0], c);
    subtract(p[3], p[0], d);
    across(axis, c);
    across(axis, d);
    double lengths = sqrt(dot(c, c)) * sqrt(dot(d, d));
    if (!(dot(c, d) > 0.5 * lengths)) /* also when there is no telling */
        return false;
    e[0] = c[1] * d[2] - c[2] * d[1], e[1] = c[2] * d[0] - c[0] * d[2], e[2] = c[0] * d[1] - c[1] * d[0];
    return sqrt(dot(e, e)) < angle * lengths;
}

il_status il_certify_unfolded(const il_surface *s, const il_section *lower, const il_section *upper,
                              double angle, il_verdict *verdict, il_error *err)
{
    il_keymap apex = IL_KEYMAP_INIT; /* half-edge -> the corner opposite */
    if (!il_keymap_reserve(&apex, 3 * s->n_triangles))
        return il_fail_nomem(err);
    for (size_t i = 0; i < 3 * s->n_triangles; i++) {
        const uint32_t *t = s->tri + i - i % 3;
        il_keymap_put(&apex, t[i % 3], t[(i + 1) % 3], t[(i + 2) % 3]);
    }
    for (size_t i = 0; verdict->flaw == IL_FLAW_NONE && i < 3 * s->n_triangles; i++) {
        const uint32_t *t = s->tri + i - i % 3;
        uint32_t v[4] = { t[i % 3], t[(i + 1) % 3], t[(i + 2) % 3], 0 };
        v[3] = il_keymap_get(&apex, v[1], v[0], UINT32_MAX);
        if (v[0] > v[1] || v[3] == UINT32_MAX)
            continue;
        double p[4][3];
        for (int k = 0; k < 4; k++)
            il_surface_position(s, lower, upper, v[k], p[k]);
        if (is_fold(p, angle))
            flaw_at(verdict, IL_FLAW_CROSSING, s, lower, upper, v[0]);
    }
    il_keymap_free(&apex);
    return IL_OK;
}

/* ---- (c): triangles in space ---- */

typedef struct soup {
    double *xyz;
    uint32_t *tri;
    size_t n_vertices;
} soup;

static bool make_soup(soup *m, const il_surface *s, const il_section *lower, const il_section *upper)
{
    m->n_vertices = lower->n_nodes + upper->n_nodes + s->n_inner;
    m->xyz = il_surface_positions(s, lower, upper);
    m->tri = il_alloc(s->n_triangles, 3 * sizeof *m->tri);
    if (!m->xyz || !m->tri)
        return false;
    for (size_t i = 0; i < 3 * s->n_triangles; i++)
        m->tri[i] = (uint32_t)il_surface_row(lower, upper, s->tri[i]);
    return true;
}

il_status il_certify_touched(const il_surface *s, const il_section *lower, const il_section *upper,
                             const unsigned char *touched, il_verdict *verdict, il_error *err)
{
    soup m = { NULL, NULL, 0 };
    size_t found = 0;
    uint32_t first[2] = { 0, 0 };
    il_status st = make_soup(&m, s, lower, upper) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_intersections(m.xyz, m.n_vertices, m.tri, s->n_triangles, touched, 1, &found, first, err);
    if (st == IL_OK && found > 0)
        flaw_at(verdict, IL_FLAW_CROSSING, s, lower, upper, s->tri[3 * first[0]]);
    il_free(m.xyz);
    il_free(m.tri);
    return st;
}

il_status il_certify_between(const il_surface *s, const il_section *lower, const il_section *upper, const uint32_t *group,
                             const unsigned char *touched, uint32_t **pair, size_t *n_pairs, il_error *err)
{
    soup m = { NULL, NULL, 0 };
    uint32_t *own = group ? NULL : il_alloc(s->n_triangles, sizeof *own);
    *pair = NULL;
    *n_pairs = 0;
    il_status st = (group || own) && make_soup(&m, s, lower, upper) ? IL_OK : il_fail_nomem(err);
    for (size_t t = 0; own && t < s->n_triangles; t++)
        own[t] = (uint32_t)t;
    if (st == IL_OK)
        st = il_intersections_between(m.xyz, m.n_vertices, m.tri, s->n_triangles, group ? group : own, touched, pair, n_pairs, err);
    il_free(own);
    il_free(m.xyz);
    il_free(m.tri);
    return st;
}

il_status il_certify(const il_surface *s, const il_section *lower, const il_section *upper,
                     il_verdict *verdict, il_error *err)
{
    il_status st = il_certify_edges(s, lower, upper, verdict, err);
    if (st == IL_OK && verdict->flaw == IL_FLAW_NONE)
        st = il_certify_touched(s, lower, upper, NULL, verdict, err);
    return st;
}
