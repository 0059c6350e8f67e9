#include "config.h"
#include "loft/dome.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "base/number.h"
#include "loft/certificate.h"

#include <math.h>
#include <string.h>

/* Of a dome, by the first of its inner points: twice the lid's area, the length of its contours,
 * and the slope summed along them. */
typedef struct lid { double area2, length, slope; } lid;

typedef struct domes {
    const il_surface *s;
    const il_section *section[2];
    int side;
    uint32_t *up;             /* inner points that hang together */
    lid *lid;
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

/* Seen from above, and along the contour edges. */
static void measure(domes *d, il_keymap *slope_at, const il_lean *body)
{
    const il_surface *s = d->s;
    for (size_t t = 0; t < s->n_triangles; t++) {
        uint32_t inner = inner_of(s, t);
        double p[3][3];
        if (inner == UINT32_MAX)
            continue;
        lid *l = &d->lid[il_forest_leader(d->up, inner)];
        for (size_t k = 0; k < 3; k++)
            il_surface_position(s, d->section[0], d->section[1], s->tri[3 * t + k], p[k]);
        l->area2 += fabs((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]));
        for (size_t k = 0; k < 3; k++) {
            uint32_t a = s->tri[3 * t + k], b = s->tri[3 * t + (k + 1) % 3];
            if (IL_CODE_WHERE(a) == IL_INNER || IL_CODE_WHERE(b) == IL_INNER)
                continue;
            double length = hypot(p[(k + 1) % 3][0] - p[k][0], p[(k + 1) % 3][1] - p[k][1]);
            uint32_t station = il_keymap_get(slope_at, IL_KEYMAP_EDGE(IL_CODE_INDEX(a), IL_CODE_INDEX(b)), UINT32_MAX);
            l->length += length;
            l->slope += station == UINT32_MAX ? 0 : length * body->slope[station];
        }
    }
}

/* The height of a dome at a point where one of height 1 and upright sides is TAU high: of the
 * sphere over the lid L, at most half of HEIGHT. */
static double height_at(const lid *l, double tau, double height, double sign)
{
    double r = l->area2 / l->length, s = sign * l->slope / l->length, most = r * (sqrt(1 + s * s) + s);
    double inwards2 = 1 - tau * tau; /* (1 - d / r)^2 */
    double z = r * (sqrt(1 + s * s - inwards2) + s);
    return most > height / 2 ? z * height / 2 / most : z;
}

static void raise(const domes *d, double *inner, double height, bool round_float)
{
    static const double LEAST = 1.0 / 1024; /* as in axis.h */
    double z0 = d->section[d->side]->z, up = d->side == IL_LOWER ? 1 : -1;
    for (uint32_t i = 0; i < d->s->n_inner; i++) {
        const lid *l = &d->lid[il_forest_leader(d->up, i)];
        double tau = fmin(fabs(d->s->inner[3 * i + 2] - z0) / (height / 2), 1);
        double z = z0 + up * fmax(height_at(l, tau, height, up), LEAST * height);
        inner[3 * i + 2] = round_float ? il_number_round_float(z) : z;
    }
}

static il_status follow(domes *d, il_surface *s, il_keymap *slope_at, const il_lean *body, bool round_float, il_error *err)
{
    const il_section *contour = d->section[d->side];
    double *before = s->inner, *inner = il_alloc(s->n_inner, 3 * sizeof *inner);
    d->up = il_alloc(s->n_inner, sizeof *d->up);
    d->lid = il_calloc(s->n_inner, sizeof *d->lid);
    bool ok = inner && d->up && d->lid && il_keymap_reserve(slope_at, contour->n_stations);
    il_verdict v = { .flaw = IL_FLAW_NONE };
    if (!ok) {
        il_free(inner);
        return il_fail_nomem(err);
    }
    for (uint32_t i = 0; i < contour->n_stations; i++)
        il_keymap_put(slope_at, IL_KEYMAP_EDGE(contour->node_at[i], contour->node_at[contour->next[i]]), i);
    join(d);
    measure(d, slope_at, body);
    memcpy(inner, before, 3 * s->n_inner * sizeof *inner);
    raise(d, inner, d->section[1]->z - d->section[0]->z, round_float);
    s->inner = inner;
    il_status st = il_certify(s, d->section[0], d->section[1], &v, err);
    bool sound = st == IL_OK && v.flaw == IL_FLAW_NONE;
    s->inner = sound ? inner : before;
    il_free(sound ? before : inner);
    return st;
}

il_status il_dome_follow(il_surface *s, const il_section *lower, const il_section *upper, int side,
                         const il_lean *body, bool round_float, il_error *err)
{
    domes d = { .s = s, .section = { lower, upper }, .side = side };
    il_keymap slope_at = IL_KEYMAP_INIT;
    il_status st = s->n_inner > 0 && body->slope ? follow(&d, s, &slope_at, body, round_float, err) : IL_OK;
    il_keymap_free(&slope_at);
    il_free(d.up);
    il_free(d.lid);
    return st;
}
