#include "config.h"
#include "match/partner.h"
#include "base/simd.h"

#include <math.h>

/* The nearest of the agreeing samples FIRST .. LAST of M to the point (x, y) with
 * normal (nx, ny).  Each lane keeps its first least; of these the least counts, so
 * that the result does not depend on how the samples fall into lanes. */
IL_LANEWISE uint32_t nearest(const il_samples *m, size_t first, size_t last, float x, float y, float nx, float ny)
{
    const float far = 1e12f;
    il_f8 best = il_f8_all(far);
    il_i8 at = { 0, 0, 0, 0, 0, 0, 0, 0 }, number = { 0, 1, 2, 3, 4, 5, 6, 7 };
    number += (int32_t)first;
    for (size_t k = first; k < last; k += IL_LANES) {
        il_f8 dx = il_f8_load(m->x + k) - x, dy = il_f8_load(m->y + k) - y;
        il_f8 d2 = dx * dx + dy * dy;
        il_i8 agree = il_f8_load(m->nx + k) * nx + il_f8_load(m->ny + k) * ny > IL_NORMALS_AGREE;
        il_i8 nearer = agree & (d2 < best);
        best = il_f8_choose(nearer, d2, best);
        at = il_i8_choose(nearer, number, at);
        number += IL_LANES;
    }
    float least = far;
    uint32_t found = IL_NO_PARTNER;
    for (int k = 0; k < IL_LANES; k++)
        if (best[k] < least || (best[k] == least && least < far && (uint32_t)at[k] < found)) {
            least = best[k];
            found = (uint32_t)at[k];
        }
    return found;
}

/* ---- the whole of a long contour ----
 *
 * Samples that follow each other lie together: runs of them have boxes, and only
 * those are looked into that are not further off than the best so far and in which
 * something faces the right way.  Distances from boxes round as those from samples
 * do, never to more, so the result is the same to the bit.  At most 512 runs, on
 * the stack; a comb of 260000 samples takes a hundredth of the time. */

enum { MOST_RUNS = 512, WORTH_RUNS = 2048 };

typedef struct runs {
    float x0[MOST_RUNS], y0[MOST_RUNS], x1[MOST_RUNS], y1[MOST_RUNS];
    uint8_t faces[MOST_RUNS]; /* the octants in which normals are, a bit each */
    size_t n, size;           /* samples of each but the last, a multiple of IL_LANES */
} runs;

/* Of eight, counter-clockwise. */
static inline unsigned octant(float nx, float ny)
{
    static const unsigned char of[8] = { 0, 1, 3, 2, 7, 6, 4, 5 };
    return of[(ny < 0) * 4 + (nx < 0) * 2 + (fabsf(ny) > fabsf(nx))];
}

/* All octants with a direction less than a right angle from one in octant K. */
static inline unsigned facing(unsigned k)
{
    unsigned five = 31u << (k + 6) % 8;
    return (five | five >> 8) & 255;
}

static void make_runs(runs *r, const il_samples *m)
{
    r->size = (m->n / MOST_RUNS / IL_LANES + 1) * IL_LANES;
    r->n = (m->n + r->size - 1) / r->size;
    for (size_t i = 0; i < MOST_RUNS; i++) { /* those that are not there are far */
        r->x0[i] = r->y0[i] = 1e12f;
        r->x1[i] = r->y1[i] = -1e12f;
        r->faces[i] = 0;
    }
    for (size_t k = 0; k < m->n; k++) {
        size_t i = k / r->size;
        r->x0[i] = fminf(r->x0[i], m->x[k]);
        r->y0[i] = fminf(r->y0[i], m->y[k]);
        r->x1[i] = fmaxf(r->x1[i], m->x[k]);
        r->y1[i] = fmaxf(r->y1[i], m->y[k]);
        r->faces[i] |= (uint8_t)(1u << octant(m->nx[k], m->ny[k]));
    }
}

/* The best so far. */
typedef struct found {
    float d2;
    uint32_t at;
} found;

IL_LANEWISE void look_into(found *f, const il_samples *m, const runs *r, size_t run, const il_samples *t, size_t q)
{
    size_t first = run * r->size, last = first + r->size < m->n ? first + r->size : m->n;
    uint32_t p = nearest(m, first, last, t->x[q], t->y[q], t->nx[q], t->ny[q]);
    if (p == IL_NO_PARTNER)
        return;
    float dx = m->x[p] - t->x[q], dy = m->y[p] - t->y[q], d2 = dx * dx + dy * dy;
    if (d2 < f->d2 || (d2 == f->d2 && p < f->at))
        *f = (found){ d2, p };
}

/* As nearest in all of M, begun where the partner NEAR is, if any. */
IL_LANEWISE uint32_t nearest_in_runs(const il_samples *m, const runs *r, const il_samples *t, size_t q, uint32_t near)
{
    found f = { 1e12f, IL_NO_PARTNER };
    unsigned faces = facing(octant(t->nx[q], t->ny[q]));
    float x = t->x[q], y = t->y[q];
    if (near != IL_NO_PARTNER)
        look_into(&f, m, r, near / r->size, t, q);
    for (size_t i = 0; i < r->n; i += IL_LANES) {
        il_f8 zero = il_f8_all(0);
        il_f8 dx = il_f8_max(il_f8_max(il_f8_load(r->x0 + i) - x, x - il_f8_load(r->x1 + i)), zero);
        il_f8 dy = il_f8_max(il_f8_max(il_f8_load(r->y0 + i) - y, y - il_f8_load(r->y1 + i)), zero);
        il_f8 d2 = dx * dx + dy * dy;
        if (il_f8_least(d2) > f.d2)
            continue;
        for (size_t k = 0; k < IL_LANES; k++)
            if (d2[k] <= f.d2 && (r->faces[i + k] & faces) != 0)
                look_into(&f, m, r, i + k, t, q);
    }
    return f.at;
}

IL_CLONES
static void find_in_runs(const il_samples *moved, const il_samples *target, uint32_t *partner)
{
    runs r;
    uint32_t near = IL_NO_PARTNER;
    make_runs(&r, moved);
    for (size_t q = 0; q < target->n; q++)
        partner[q] = near = nearest_in_runs(moved, &r, target, q, near);
}

/* Half as wide as a window of neighbours. */
enum { REACH = 8 };

IL_CLONES
void il_partners_find(const il_samples *moved, const il_samples *target, bool anew, uint32_t *partner)
{
    if (anew && moved->n >= WORTH_RUNS) {
        find_in_runs(moved, target, partner);
        return;
    }
    for (size_t q = 0; q < target->n; q++) {
        size_t first = 0, last = moved->n;
        if (!anew && partner[q] != IL_NO_PARTNER) {
            first = partner[q] > REACH ? partner[q] - REACH : 0;
            last = first + 2 * REACH < moved->n ? first + 2 * REACH : moved->n;
        }
        partner[q] = nearest(moved, first, last, target->x[q], target->y[q], target->nx[q], target->ny[q]);
    }
}

/* Squared distance of (x, y) from the segment. */
static inline float to_segment(float ax, float ay, float bx, float by, float x, float y)
{
    float dx = bx - ax, dy = by - ay, length2 = dx * dx + dy * dy;
    float t = length2 > 0 ? ((x - ax) * dx + (y - ay) * dy) / length2 : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    float ex = ax + t * dx - x, ey = ay + t * dy - y;
    return ex * ex + ey * ey;
}

float il_partner_distance(const il_samples *moved, uint32_t p, const il_samples *target, uint32_t q)
{
    uint32_t first = 0, last = (uint32_t)moved->n;
    float least = INFINITY;
    if (p != IL_NO_PARTNER) { /* the edges about it, those at the ring's seam too */
        first = p > REACH / 2 ? p - REACH / 2 : 0;
        last = p + REACH / 2 < last ? p + REACH / 2 : last;
        uint32_t b = moved->before[p];
        least = to_segment(moved->x[b], moved->y[b], moved->x[p], moved->y[p], target->x[q], target->y[q]);
    }
    for (uint32_t a = first; a < last; a++) {
        uint32_t b = moved->after[a];
        float d = to_segment(moved->x[a], moved->y[a], moved->x[b], moved->y[b], target->x[q], target->y[q]);
        least = d < least ? d : least;
    }
    return sqrtf(least);
}
