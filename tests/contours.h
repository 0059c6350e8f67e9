/* contours.h - contours as a line of text, and what is true of them by brute force. */
#ifndef IL_TESTS_CONTOURS_H
#define IL_TESTS_CONTOURS_H

#include "base/status.h"
#include "bridge/predicates.h"
#include "model/report.h"
#include "model/stack.h"
#include "stacks.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CONTOURS_TEXT = 2000 };

/* A slice from "x y, x y, x y; x y, ...": points, and rings. */
static inline il_slice slice_of(const char *s)
{
    il_slice slice = IL_SLICE_INIT;
    while (*s) {
        il_ring *r = il_slice_add_ring(&slice);
        assert_non_null(r);
        while (*s && *s != ';') {
            char *end;
            double x = strtod(s, &end), y = strtod(end, &end);
            assert_true(end > s);
            assert_true(il_ring_add(r, x, y, 0));
            s = *end == ',' ? end + 1 : end;
        }
        s += *s == ';';
    }
    return slice;
}

/* The way back; TO[CONTOURS_TEXT]. */
static inline char *slice_text(const il_slice *s, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->ring[i].n; k++)
            n += (size_t)snprintf(to + n, n < CONTOURS_TEXT ? CONTOURS_TEXT - n : 0, "%s%.10g %.10g",
                                  k > 0 ? ", " : i > 0 ? "; " : "", s->ring[i].xy[2 * k], s->ring[i].xy[2 * k + 1]);
    return to;
}

/* "crossings 1, pinches 2": the repairs that were made; TO[CONTOURS_TEXT]. */
static inline char *repairs_text(const il_report *r, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (int i = 0; i < IL_N_REPAIRS; i++)
        if (r->repair[i] > 0)
            n += (size_t)snprintf(to + n, CONTOURS_TEXT - n, "%s%s %zu", n > 0 ? ", " : "", il_repair_key((il_repair)i), r->repair[i]);
    return to;
}

static inline void assert_same_bits(const il_slice *a, const il_slice *b)
{
    assert_int_equal(a->n, b->n);
    for (size_t i = 0; i < a->n; i++) {
        const il_ring *p = &a->ring[i], *q = &b->ring[i];
        assert_int_equal(p->n, q->n);
        assert_memory_equal(p->xy, q->xy, 2 * p->n * sizeof *p->xy);
        for (size_t k = 0; k < p->n; k++)
            assert_int_equal(p->mark ? p->mark[k] : 0, q->mark ? q->mark[k] : 0);
    }
}

/* All edges of a slice's rings as x y x y; *N of them; free them. */
static inline double *edges_of(const il_slice *s, size_t *n)
{
    double *e = malloc((il_slice_points(s) + 1) * 4 * sizeof *e);
    assert_non_null(e);
    *n = 0;
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->ring[i].n; k++, ++*n) {
            memcpy(e + 4 * *n, s->ring[i].xy + 2 * k, 2 * sizeof *e);
            memcpy(e + 4 * *n + 2, s->ring[i].xy + 2 * ((k + 1) % s->ring[i].n), 2 * sizeof *e);
        }
    return e;
}

static inline bool same_place(const double *p, const double *q)
{
    return p[0] == q[0] && p[1] == q[1];
}

/* Does point P lie on the closed edge from A to B, exactly? */
static inline bool lies_on(const double *p, const double *a, const double *b)
{
    return il_orientation(a, b, p) == 0 && fmin(a[0], b[0]) <= p[0] && p[0] <= fmax(a[0], b[0]) &&
           fmin(a[1], b[1]) <= p[1] && p[1] <= fmax(a[1], b[1]);
}

/* Do the edges E and F (x y x y) meet in more than a common end? */
static inline bool edges_meet(const double *e, const double *f)
{
    const double *a = e, *b = e + 2, *c = f, *d = f + 2;
    for (int k = 0; k < 2; k++) { /* an end of one inside the other */
        const double *p = k ? b : a, *q = k ? d : c;
        if ((lies_on(p, c, d) && !same_place(p, c) && !same_place(p, d)) ||
            (lies_on(q, a, b) && !same_place(q, a) && !same_place(q, b)))
            return true;
    }
    if ((same_place(a, c) && same_place(b, d)) || (same_place(a, d) && same_place(b, c)))
        return true;
    return il_orientation(a, b, c) * il_orientation(a, b, d) < 0 && il_orientation(c, d, a) * il_orientation(c, d, b) < 0;
}

/* Is (X, Y) inside by the even-odd rule?  For points that keep off the edges. */
static inline bool is_inside(const double *e, size_t n, double x, double y)
{
    bool in = false;
    for (size_t i = 0; i < n; i++, e += 4)
        if ((e[1] > y) != (e[3] > y) && e[0] + (e[2] - e[0]) * ((y - e[1]) / (e[3] - e[1])) > x)
            in = !in;
    return in;
}

static inline int compare_doubles(const void *p, const void *q)
{
    double a = *(const double *)p, b = *(const double *)q;
    return a < b ? -1 : a > b;
}

/* Even-odd length of the line at height Y inside the edges; X[n] is room. */
static inline double inside_length(const double *e, size_t n, double y, double *x)
{
    size_t m = 0;
    double sum = 0;
    for (size_t i = 0; i < n; i++, e += 4)
        if ((e[1] > y) != (e[3] > y))
            x[m++] = e[0] + (e[2] - e[0]) * ((y - e[1]) / (e[3] - e[1]));
    qsort(x, m, sizeof *x, compare_doubles);
    for (size_t i = 0; i + 1 < m; i += 2)
        sum += x[i + 1] - x[i];
    return sum;
}

/* Even-odd area within N edges: in strips between the heights of all ends and
 * all crossings the inside length is linear, so its value half way is exact. */
static inline double even_odd_area(const double *e, size_t n)
{
    double *y = malloc((2 * n + n * n + 1) * sizeof *y), *x = malloc((n + 1) * sizeof *x), sum = 0;
    size_t m = 0;
    assert_true(y && x);
    for (size_t i = 0; i < n; i++) {
        y[m++] = e[4 * i + 1], y[m++] = e[4 * i + 3];
        for (size_t j = 0; j < i; j++) {
            const double *a = e + 4 * i, *c = e + 4 * j;
            double ux = a[2] - a[0], uy = a[3] - a[1], vx = c[2] - c[0], vy = c[3] - c[1], det = ux * vy - uy * vx;
            double t = det != 0 ? ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / det : -1;
            if (t > 0 && t < 1)
                y[m++] = a[1] + t * uy;
        }
    }
    if (m > 0)
        qsort(y, m, sizeof *y, compare_doubles);
    for (size_t i = 0; i + 1 < m; i++)
        sum += (y[i + 1] - y[i]) * inside_length(e, n, (y[i] + y[i + 1]) / 2, x);
    free(x);
    free(y);
    return sum;
}

/* A tangle: 1 to 4 rings of 3 to 9 vertices on the points (0..SIZE - 1)^2. */
static inline il_slice random_tangle(uint64_t *seed, unsigned size)
{
    il_slice s = IL_SLICE_INIT;
    for (uint64_t rings = 1 + stack_random(seed) % 4; rings > 0; rings--) {
        il_ring *r = il_slice_add_ring(&s);
        assert_non_null(r);
        for (uint64_t n = 3 + stack_random(seed) % 7; n > 0; n--) {
            double x = (double)(stack_random(seed) % size), y = (double)(stack_random(seed) % size);
            assert_true(il_ring_add(r, x, y, 0));
        }
    }
    return s;
}

#endif
