#include "config.h"
#include "loft/dome.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "base/nearest.h"
#include "base/number.h"
#include "loft/certificate.h"

#include <math.h>
#include <string.h>

/* Of a dome, by the first of its inner points: the length of its contours, the slope summed along
 * them, its highest point, how high and how far from the contours that is. */
typedef struct lid { double length, slope, rise, radius; uint32_t highest; } lid;

/* contour: the edges of each lid, as a class of segments. */
typedef struct domes {
    const il_surface *s;
    const il_section *section[2];
    int side;
    uint32_t *up;             /* inner points that hang together */
    lid *lid;
    il_segment *contour;      size_t n_contour, cap_contour;
} domes;

/* The inner point of triangle T, or UINT32_MAX. */
static uint32_t inner_of(const il_surface *s, size_t t)
{
    for (size_t k = 3 * t; k < 3 * t + 3; k++)
        if (IL_CODE_WHERE(s->tri[k]) == IL_INNER)
            return IL_CODE_INDEX(s->tri[k]);
    return UINT32_MAX;
}

static void join(domes *d)
{
    il_forest_plant(d->up, d->s->n_inner);
    for (size_t t = 0; t < d->s->n_triangles; t++) {
        uint32_t first = inner_of(d->s, t);
        for (size_t k = 3 * t; first != UINT32_MAX && k < 3 * t + 3; k++)
            if (IL_CODE_WHERE(d->s->tri[k]) == IL_INNER)
                il_forest_join(d->up, first, IL_CODE_INDEX(d->s->tri[k]));
    }
}

/* What triangle T, of the lid LEADER, has along the contour. */
static bool add_contour(domes *d, size_t t, uint32_t leader, const il_keymap *slope_at, const il_lean *body)
{
    const il_section *section = d->section[d->side];
    for (size_t k = 0; k < 3; k++) {
        uint32_t a = d->s->tri[3 * t + k], b = d->s->tri[3 * t + (k + 1) % 3];
        if (IL_CODE_WHERE(a) == IL_INNER || IL_CODE_WHERE(b) == IL_INNER)
            continue;
        const double *p = section->xy + 2 * (size_t)IL_CODE_INDEX(a), *q = section->xy + 2 * (size_t)IL_CODE_INDEX(b);
        double length = hypot(q[0] - p[0], q[1] - p[1]);
        uint32_t station = il_keymap_get(slope_at, IL_KEYMAP_EDGE(IL_CODE_INDEX(a), IL_CODE_INDEX(b)), UINT32_MAX);
        d->lid[leader].length += length;
        d->lid[leader].slope += station == UINT32_MAX ? 0 : length * body->slope[station];
        if (!il_grow(&d->contour, &d->cap_contour, d->n_contour + 1, sizeof *d->contour))
            return false;
        d->contour[d->n_contour++] = (il_segment){ p[0], p[1], q[0], q[1], leader, 0 };
    }
    return true;
}

static bool measure(domes *d, const il_keymap *slope_at, const il_lean *body)
{
    bool ok = true;
    for (size_t t = 0; ok && t < d->s->n_triangles; t++) {
        uint32_t inner = inner_of(d->s, t);
        ok = inner == UINT32_MAX || add_contour(d, t, il_forest_leader(d->up, inner), slope_at, body);
    }
    for (uint32_t i = 0; i < d->s->n_inner; i++) {
        lid *l = &d->lid[il_forest_leader(d->up, i)];
        double rise = fabs(d->s->inner[3 * i + 2] - d->section[d->side]->z);
        if (rise > l->rise)
            l->rise = rise, l->highest = i;
    }
    return ok;
}

/* The highest point is the one farthest inside. */
static il_status find_radii(domes *d, il_error *err)
{
    il_nearest contours;
    il_status st = il_nearest_build(&contours, d->contour, d->n_contour, d->s->n_inner, err);
    d->contour = NULL; /* taken over */
    for (uint32_t i = 0; st == IL_OK && i < d->s->n_inner; i++) {
        const double *top = d->s->inner + 3 * (size_t)d->lid[i].highest;
        if (d->lid[i].length > 0)
            d->lid[i].radius = il_nearest_distance(&contours, i, top[0], top[1]);
    }
    if (st == IL_OK)
        il_nearest_free(&contours);
    return st;
}

/* The height of a dome at a point where one of height 1 and upright sides is TAU high: of the
 * sphere over the lid L, at most half of HEIGHT. */
static double height_at(const lid *l, double tau, double height, double sign)
{
    double r = l->radius, s = sign * l->slope / l->length, most = r * (sqrt(1 + s * s) + s);
    double inwards2 = 1 - tau * tau; /* (1 - d / r)^2 */
    double z = r * (sqrt(1 + s * s - inwards2) + s);
    return most > height / 2 ? z * height / 2 / most : z;
}

static void raise(const domes *d, double *inner, double height, bool round_float)
{
    double z0 = d->section[d->side]->z, up = d->side == IL_LOWER ? 1 : -1;
    for (uint32_t i = 0; i < d->s->n_inner; i++) {
        const lid *l = &d->lid[il_forest_leader(d->up, i)];
        double tau = fmin(fabs(d->s->inner[3 * i + 2] - z0) / l->rise, 1);
        double z = z0 + up * fmax(height_at(l, tau, height, up), IL_INNER_LEAST * height);
        inner[3 * i + 2] = round_float ? il_number_round_float(z) : z;
    }
}

/* INNER: the inner points of S as they stand when the domes follow BODY. */
static il_status rise_of(domes *d, const il_lean *body, bool round_float, double *inner, il_error *err)
{
    const il_section *contour = d->section[d->side];
    il_keymap slope_at = IL_KEYMAP_INIT;
    d->up = il_alloc(d->s->n_inner, sizeof *d->up);
    d->lid = il_calloc(d->s->n_inner, sizeof *d->lid);
    bool ok = d->up && d->lid && il_keymap_reserve(&slope_at, contour->n_stations);
    for (uint32_t i = 0; ok && i < contour->n_stations; i++)
        il_keymap_put(&slope_at, IL_KEYMAP_EDGE(contour->node_at[i], contour->node_at[contour->next[i]]), i);
    if (ok) {
        join(d);
        ok = measure(d, &slope_at, body);
    }
    il_keymap_free(&slope_at);
    il_status st = ok ? find_radii(d, err) : il_fail_nomem(err);
    if (st == IL_OK)
        raise(d, inner, d->section[1]->z - d->section[0]->z, round_float);
    return st;
}

static il_status follow(domes *d, il_surface *s, const il_lean *body, bool round_float, il_error *err)
{
    double *before = s->inner, *inner = il_alloc(s->n_inner, 3 * sizeof *inner);
    il_verdict v = { .flaw = IL_FLAW_CROSSING };
    if (!inner)
        return il_fail_nomem(err);
    memcpy(inner, before, 3 * s->n_inner * sizeof *inner);
    il_status st = rise_of(d, body, round_float, inner, err);
    s->inner = inner;
    if (st == IL_OK)
        st = il_certify(s, d->section[0], d->section[1], &v, err);
    bool sound = st == IL_OK && v.flaw == IL_FLAW_NONE;
    s->inner = sound ? inner : before;
    il_free(sound ? before : inner);
    return st;
}

il_status il_dome_follow(il_surface *s, const il_section *lower, const il_section *upper, int side,
                         const il_lean *body, bool round_float, il_error *err)
{
    domes d = { .s = s, .section = { lower, upper }, .side = side };
    il_status st = s->n_inner > 0 && body->slope ? follow(&d, s, body, round_float, err) : IL_OK;
    il_free(d.up);
    il_free(d.lid);
    il_free(d.contour);
    return st;
}
