#include "config.h"
#include "loft/flip.h"
#include "base/alloc.h"
#include "loft/certificate.h"

#include <math.h>
#include <string.h>

/* Edges are tried PASSES times over; flips about triangles that meet are dropped ROUNDS times. */
enum { PASSES = 6, ROUNDS = 3 };

/* A flip makes the smaller of the smallest angles so many times what it was, or it is not worth it. */
static const double GAIN = 1.05;

/* A half-edge that more than one triangle has. */
static const uint32_t SEVERAL = UINT32_MAX - 1, NONE = UINT32_MAX;

/* half: from the two codes of a half-edge to the corner of tri where it starts.
 * frozen[t], touched[t]: triangle t is not to be flipped; it has been. */
typedef struct flipping {
    il_surface *s;
    const il_section *section[2];
    double height;
    il_keymap half;
    unsigned char *frozen, *touched;
} flipping;

/* ---- shapes ---------------------------------------------------------------------- */

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double length(const double a[3])
{
    return sqrt(dot(a, a));
}

/* The normal of a triangle, as long as twice its area; the sine of its smallest angle, which is
 * that between its two longest edges. */
static double measure(const double a[3], const double b[3], const double c[3], double normal[3])
{
    double u[3], v[3], w[3];
    subtract(b, a, u);
    subtract(c, b, v);
    subtract(a, c, w);
    cross(u, v, normal);
    double l[3] = { length(u), length(v), length(w) };
    double least = fmin(fmin(l[0], l[1]), l[2]);
    double longest2 = least == l[0] ? l[1] * l[2] : least == l[1] ? l[2] * l[0] : l[0] * l[1];
    return longest2 > 0 ? length(normal) / longest2 : 0;
}

/* Edge AB has the triangles ABC and BAD: is CD the better diagonal?  The diagonals pass each other
 * at the distance |AB x CD . AC| / |AB x CD|; the quadrilateral is convex when the
 * new triangles look where both old ones do. */
static bool is_better(double p[4][3], double most_move)
{
    double old[2][3], new[2][3], ab[3], cd[3], ac[3], axis[3];
    double before = fmin(measure(p[0], p[1], p[2], old[0]), measure(p[1], p[0], p[3], old[1]));
    double after = fmin(measure(p[0], p[3], p[2], new[0]), measure(p[3], p[1], p[2], new[1]));
    if (!(after > GAIN * before))
        return false;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            if (!(dot(old[i], new[k]) > 0))
                return false;
    subtract(p[1], p[0], ab);
    subtract(p[3], p[2], cd);
    subtract(p[2], p[0], ac);
    cross(ab, cd, axis);
    return fabs(dot(axis, ac)) <= most_move * length(axis);
}

/* ---- edges ----------------------------------------------------------------------- */

static bool index_edges(flipping *f)
{
    const il_surface *s = f->s;
    if (!il_keymap_reserve(&f->half, 3 * s->n_triangles))
        return false;
    for (size_t i = 0; i < 3 * s->n_triangles; i++) {
        uint32_t *at = il_keymap_put(&f->half, s->tri[i], s->tri[i % 3 == 2 ? i - 2 : i + 1], NONE);
        *at = *at == NONE ? (uint32_t)i : SEVERAL;
    }
    return true;
}

static uint32_t half_at(const flipping *f, uint32_t a, uint32_t b)
{
    return il_keymap_get(&f->half, a, b, NONE);
}

static bool may_join(const flipping *f, uint32_t c, uint32_t d)
{
    bool in_plane = IL_CODE_WHERE(c) == IL_CODE_WHERE(d) && IL_CODE_WHERE(c) != IL_INNER;
    return c != d && !in_plane && half_at(f, c, d) == NONE && half_at(f, d, c) == NONE;
}

static bool set_triangle(flipping *f, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t v[3] = { a, b, c };
    memcpy(f->s->tri + 3 * (size_t)t, v, sizeof v);
    f->touched[t] = 1;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t *at = il_keymap_put(&f->half, v[k], v[(k + 1) % 3], NONE);
        if (!at)
            return false;
        *at = 3 * t + k;
    }
    return true;
}

/* The edge that starts at corner I: flipped where that is better.  False without memory. */
static bool try_edge(flipping *f, uint32_t i, bool *flipped)
{
    const uint32_t *tri = f->s->tri;
    uint32_t t = i / 3, v[4] = { tri[i], tri[3 * t + (i + 1) % 3], tri[3 * t + (i + 2) % 3], 0 };
    uint32_t j = half_at(f, v[1], v[0]);
    *flipped = false;
    if (v[0] > v[1] || j >= SEVERAL || half_at(f, v[0], v[1]) >= SEVERAL || f->frozen[t] || f->frozen[j / 3])
        return true;
    v[3] = tri[3 * (j / 3) + (j + 2) % 3];
    if (!may_join(f, v[2], v[3]))
        return true;
    double p[4][3];
    for (int k = 0; k < 4; k++)
        il_surface_position(f->s, f->section[0], f->section[1], v[k], p[k]);
    if (!is_better(p, IL_FLIP_MOVE * f->height))
        return true;
    *flipped = true;
    il_keymap_put(&f->half, v[0], v[1], NONE)[0] = NONE;
    il_keymap_put(&f->half, v[1], v[0], NONE)[0] = NONE;
    return set_triangle(f, t, v[0], v[3], v[2]) && set_triangle(f, j / 3, v[3], v[1], v[2]);
}

/* ---- all of them, until they are sound ---------------------------------------------- */

static il_status flip_all(flipping *f, size_t *n_flips, il_error *err)
{
    bool ok = index_edges(f), again = true;
    for (int pass = 0; ok && again && pass < PASSES; pass++) {
        again = false;
        for (uint32_t i = 0; ok && i < 3 * f->s->n_triangles; i++) {
            bool flipped = false;
            ok = try_edge(f, i, &flipped);
            *n_flips += flipped;
            again = again || flipped;
        }
    }
    il_keymap_free(&f->half);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* Freeze the flipped triangles that meet others; *FOUND: are there any? */
static il_status freeze(flipping *f, bool *found, il_error *err)
{
    uint32_t *pair = NULL, *self = il_alloc(f->s->n_triangles, sizeof *self);
    size_t n = 0;
    *found = false;
    if (!self)
        return il_fail_nomem(err);
    for (size_t t = 0; t < f->s->n_triangles; t++)
        self[t] = (uint32_t)t;
    il_status st = il_certify_between(f->s, f->section[0], f->section[1], self, &pair, &n, err);
    for (size_t i = 0; i < 2 * n; i++)
        if (f->touched[pair[i]])
            f->frozen[pair[i]] = 1, *found = true;
    il_free(pair);
    il_free(self);
    return st;
}

/* One round: sound, or it is to be done again. */
static il_status flip_and_judge(flipping *f, bool *sound, bool *again, il_error *err)
{
    il_verdict v = { .flaw = IL_FLAW_NONE };
    size_t n_flips = 0;
    *again = false;
    il_status st = flip_all(f, &n_flips, err);
    if (st == IL_OK && n_flips > 0)
        st = il_certify_edges(f->s, f->section[0], f->section[1], &v, err);
    if (st == IL_OK && n_flips > 0 && v.flaw == IL_FLAW_NONE)
        st = il_certify_touched(f->s, f->section[0], f->section[1], f->touched, &v, err);
    *sound = st == IL_OK && v.flaw == IL_FLAW_NONE;
    if (st == IL_OK && v.flaw == IL_FLAW_CROSSING)
        st = freeze(f, again, err);
    return st;
}

il_status il_flip_edges(il_surface *s, const il_section *lower, const il_section *upper, il_error *err)
{
    size_t n = s->n_triangles;
    if (n == 0)
        return IL_OK;
    flipping f = { .s = s, .section = { lower, upper }, .height = upper->z - lower->z, .half = IL_KEYMAP_INIT };
    uint32_t *before = il_alloc(n, 3 * sizeof *before);
    f.frozen = il_calloc(n, 1);
    f.touched = il_alloc(n, 1);
    il_status st = before && f.frozen && f.touched ? IL_OK : il_fail_nomem(err);
    bool sound = false, again = st == IL_OK;
    if (again)
        memcpy(before, s->tri, 3 * n * sizeof *before);
    for (int round = 0; again && round <= ROUNDS; round++) {
        memset(f.touched, 0, n);
        st = flip_and_judge(&f, &sound, &again, err);
        if (!sound)
            memcpy(s->tri, before, 3 * n * sizeof *before);
    }
    il_free(before);
    il_free(f.frozen);
    il_free(f.touched);
    return st;
}
