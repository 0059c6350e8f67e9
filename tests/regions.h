/* regions.h - which regions of two slices meet, by brute force. */
#ifndef IL_TESTS_REGIONS_H
#define IL_TESTS_REGIONS_H

#include "contours.h"

static inline const double *vertex(const il_ring *r, size_t k)
{
    return r->xy + 2 * (k % r->n);
}

/* Do the closed segments from A to B and from C to D have a point in common? */
static inline bool segments_touch(const double *a, const double *b, const double *c, const double *d)
{
    if (lies_on(a, c, d) || lies_on(b, c, d) || lies_on(c, a, b) || lies_on(d, a, b))
        return true;
    return il_orientation(a, b, c) * il_orientation(a, b, d) < 0 && il_orientation(c, d, a) * il_orientation(c, d, b) < 0;
}

static inline bool rings_touch(const il_ring *r, const il_ring *s)
{
    for (size_t i = 0; i < r->n; i++)
        for (size_t j = 0; j < s->n; j++)
            if (segments_touch(vertex(r, i), vertex(r, i + 1), vertex(s, j), vertex(s, j + 1)))
                return true;
    return false;
}

/* Is P inside of R?  By crossings of a ray to the right, exactly. */
static inline bool ring_holds(const il_ring *r, const double p[2])
{
    bool in = false;
    for (size_t k = 0; k < r->n; k++) {
        const double *a = vertex(r, k), *b = vertex(r, k + 1);
        if ((a[1] > p[1]) != (b[1] > p[1]) && il_orientation(a, b, p) == (b[1] > a[1] ? 1 : -1))
            in = !in;
    }
    return in;
}

static inline void middle_of(const il_ring *r, double p[2])
{
    const double *a = vertex(r, 0), *b = vertex(r, 1);
    p[0] = a[0] / 2 + b[0] / 2;
    p[1] = a[1] / 2 + b[1] / 2;
}

/* The outer ring of ring I's region: the least one about a hole. */
static inline uint32_t outer_of(const il_slice *s, uint32_t i)
{
    double p[2], least = INFINITY;
    uint32_t found = i;
    if (il_ring_area2(&s->ring[i]) > 0)
        return i;
    middle_of(&s->ring[i], p);
    for (uint32_t k = 0; k < s->n; k++) {
        double area2 = il_ring_area2(&s->ring[k]);
        if (area2 > 0 && area2 < least && ring_holds(&s->ring[k], p)) {
            least = area2;
            found = k;
        }
    }
    return found;
}

/* Is P in the region whose outer ring is OUTER? */
static inline bool region_holds(const il_slice *s, uint32_t outer, const double p[2])
{
    if (!ring_holds(&s->ring[outer], p))
        return false;
    for (uint32_t k = 0; k < s->n; k++)
        if (k != outer && outer_of(s, k) == outer && ring_holds(&s->ring[k], p))
            return false;
    return true;
}

/* Do two regions overlap or touch?  Outlines meet, or one lies in the other. */
static inline bool regions_meet(const il_slice *a, uint32_t i, const il_slice *b, uint32_t j)
{
    double p[2];
    for (uint32_t r = 0; r < a->n; r++)
        for (uint32_t s = 0; s < b->n; s++)
            if (outer_of(a, r) == i && outer_of(b, s) == j && rings_touch(&a->ring[r], &b->ring[s]))
                return true;
    middle_of(&a->ring[i], p);
    if (region_holds(b, j, p))
        return true;
    middle_of(&b->ring[j], p);
    return region_holds(a, i, p);
}

#endif
