/* trees.h - random vessel trees whose connectivity is known, and their slices.
 *
 * A tree is a union of tubes, each the hull of two balls, along a tree of segments.  Tubes that
 * share a node meet there; all others keep TREE_MARGIN apart, so that what crosses in projection
 * has no contact.  Lengths are in radii of the thinnest tube.  Tests only: aborts without memory. */
#ifndef IL_TESTS_TREES_H
#define IL_TESTS_TREES_H

#include "model/stack.h"

/* How far tubes lean away from the direction of stacking: 0 to 20 degrees, 20 to 40, 40 to 60,
 * 60 to 80, or any of these from tube to tube; of the last some go down again as well. */
typedef enum tree_kind { TREE_STEEP, TREE_LEANING, TREE_SLANTED, TREE_FLAT, TREE_MIXED, TREE_N_KINDS } tree_kind;

#define TREE_MARGIN 0.5

/* Balls of radius r[0], r[1] about end[0], end[1], and all between; node[]: which of the tree's nodes
 * these are. */
typedef struct tree_tube {
    double end[2][3], r[2];
    size_t node[2];
} tree_tube;

enum { TREE_MOST_TUBES = 10 };

/* z[node]: their heights.  width: mean diameter of the tubes, by length. */
typedef struct tree {
    tree_tube tube[TREE_MOST_TUBES];
    double z[TREE_MOST_TUBES + 1];
    size_t n;
    double width;
} tree;

/* A tree of 4 to TREE_MOST_TUBES tubes. */
void tree_make(tree *t, tree_kind kind, uint64_t seed);

/* Pairs of tubes without a common node whose axes cross, seen along z. */
size_t tree_crossings(const tree *t);

/* The outlines at height Z, clean; where the pit between three branches is cut, with a hole. */
void tree_section(const tree *t, double z, il_slice *to);

/* The slices that have contours, and of ring i of slice k the piece of the body that it bounds in
 * the slabs above and below: above[first[k] + i], below[first[k] + i].  Rings of neighbouring
 * slices bound one piece in the slab between them if above[] of the lower one is below[] of the
 * upper one. */
typedef struct tree_slices {
    il_slice *slice;
    size_t n, *first;
    uint32_t *above, *below;
} tree_slices;

/* Cut T by planes SPACING apart, which leave out the pits between three branches: clean slices
 * without holes. */
void tree_cut(const tree *t, double spacing, uint64_t seed, tree_slices *to);
void tree_slices_free(tree_slices *s);

#endif
