/* slabs.h - round contours, and single slabs between two slices. */
#ifndef IL_TESTS_SLABS_H
#define IL_TESTS_SLABS_H

#include "lofting.h"
#include "loft/slab.h"
#include "stacks.h"

/* An ellipse about (X, Y) with the half-axes A, B as a ring of N points, counter-clockwise, one of which is on
 * the x-axis. */
void add_ellipse(il_slice *s, double x, double y, double a, double b, size_t n);
void add_circle(il_slice *s, double x, double y, double r, size_t n);
/* A slice at Z with one circle; the caller's, to il_slice_free. */
il_slice circle(double z, double x, double y, double r, size_t n);

/* A copy made clean; the caller's, to il_slice_free. */
il_slice clean_slice(const il_slice *s, bool round_float);

/* A slab of two slices made clean, lofted as they lie, with how it leans: what the window bends. */
typedef struct test_slab {
    il_section section[2];
    il_slab slab;
} test_slab;

test_slab new_slab(const il_slice slice[2], bool round_float);
void free_slab(test_slab *t);

#endif
