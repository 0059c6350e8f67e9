/* matching.h - what the tests of the matcher share. */
#ifndef IL_TESTS_MATCHING_H
#define IL_TESTS_MATCHING_H

#include "match/ffd.h"
#include "stacks.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inline void assert_near(double value, double wanted, double within)
{
    if (!(fabs(value - wanted) <= within))
        fail_msg("%.17g is not %.17g within %g", value, wanted, within);
}

/* But for the rounding of floats. */
static inline void assert_between(double value, double least, double most)
{
    if (!(value >= least - 2e-5 && value <= most + 2e-5))
        fail_msg("%.17g is not between %.17g and %.17g", value, least, most);
}

/* In [LEAST, MOST). */
static inline double random_between(uint64_t *seed, double least, double most)
{
    return least + (most - least) * stack_uniform(seed);
}

/* Rings one behind the other, each added vertex by vertex and then closed. */
typedef struct outline {
    il_outline o;                 /* of the arrays below */
    double *xy;
    uint32_t *next;
    size_t n, cap, first;         /* first: of the ring that is open */
} outline;

static inline void outline_add(outline *o, double x, double y)
{
    if (o->n == o->cap) {
        o->cap = 2 * o->cap + 64;
        o->xy = realloc(o->xy, 2 * o->cap * sizeof *o->xy);
        o->next = realloc(o->next, o->cap * sizeof *o->next);
        assert_true(o->xy && o->next);
    }
    o->xy[2 * o->n] = x;
    o->xy[2 * o->n + 1] = y;
    o->next[o->n] = (uint32_t)(o->n + 1);
    o->n++;
}

static inline void outline_close(outline *o)
{
    o->next[o->n - 1] = (uint32_t)o->first;
    o->first = o->n;
    o->o = (il_outline){ o->xy, o->next, o->n };
}

static inline void outline_free(outline *o)
{
    free(o->xy);
    free(o->next);
    *o = (outline){ 0 };
}

/* An ellipse of N vertices about (x, y); clockwise when RX is negative. */
static inline void outline_ellipse(outline *o, double x, double y, double rx, double ry, int n)
{
    for (int k = 0; k < n; k++)
        outline_add(o, x + rx * cos(2 * acos(-1.0) * k / n), y + ry * sin(2 * acos(-1.0) * k / n));
    outline_close(o);
}

/* The radius of a shape with arms of all lengths, no two ways alike. */
static inline double star_radius(double angle)
{
    return 50 + 18 * cos(5 * angle) + 7 * cos(2 * angle + 1) + 4 * sin(3 * angle);
}

/* That shape, scaled and turned by an ANGLE. */
static inline void outline_star(outline *o, double x, double y, double scale, double angle, int n)
{
    for (int k = 0; k < n; k++) {
        double at = 2 * acos(-1.0) * k / n, r = scale * star_radius(at);
        outline_add(o, x + r * cos(at + angle), y + r * sin(at + angle));
    }
    outline_close(o);
}

#endif
