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

/* Half as wide as a window of neighbours. */
enum { REACH = 8 };

IL_CLONES
void il_partners_find(const il_samples *moved, const il_samples *target, bool anew, uint32_t *partner)
{
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
