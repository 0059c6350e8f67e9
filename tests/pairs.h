/* pairs.h - pairs of slices to match, with what corresponds to what: from a family and a seed.
 *
 * Outlines are about 130 across, near the middle of a frame of 256 by 256, its
 * cells the unit. */
#ifndef IL_TESTS_PAIRS_H
#define IL_TESTS_PAIRS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum pairs_family {
    PAIRS_SLICE_LIKE,   /* a smooth outline, and it a little changed: neighbours in a stack */
    PAIRS_DIFFERENT,    /* changed as much as it varies itself */
    PAIRS_WILD,         /* changed twice as much */
    PAIRS_MOVED,        /* different, turned by up to 30 degrees, scaled by up to e^0.4, shifted */
    PAIRS_NAMED,        /* the hard ones, one by one: the seed is below PAIRS_N_NAMED */
    PAIRS_N_FAMILIES
} pairs_family;

enum { PAIRS_N_NAMED = 11, PAIRS_MOST_POINTS = 512, PAIRS_FRAME = 256 };

/* Rings one behind the other: vertices xy[2*n], vertex i joined to next[i],
 * counter-clockwise; ring k begins at vertex first[k] and ends before first[k + 1]. */
typedef struct pairs_outline {
    double xy[2 * PAIRS_MOST_POINTS];
    uint32_t next[PAIRS_MOST_POINTS];
    size_t n, n_rings, first[3];
} pairs_outline;

/* Where truth is known, vertex i of the upper outline belongs to vertex i of the
 * lower; it is not where the two differ in topology, or have a part each that
 * the other lacks. */
typedef struct pairs_pair {
    pairs_outline lower, upper;
    bool has_truth;
} pairs_pair;

/* "slice-like", "different", "wild", "moved", "named". */
const char *pairs_family_word(pairs_family f);

/* What the named pair is, in a few words. */
const char *pairs_name(uint32_t seed);

/* The same figures for the same family and seed wherever sin and cos are the same. */
void pairs_make(pairs_family f, uint32_t seed, pairs_pair *out);

#endif
