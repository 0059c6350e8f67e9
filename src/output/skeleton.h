/* skeleton.h - what holds together in a stack: the centres of its regions, joined
 * along the links of the pairs (the paper's Figure 4a). */
#ifndef IL_OUTPUT_SKELETON_H
#define IL_OUTPUT_SKELETON_H

#include "output/picture-parts.h"

/* Why two regions are joined: by the reasons of links, of which those that reach
 * farther than the slab is high are guesses; or, without links, by a common group. */
typedef enum il_bond {
    IL_BOND_OVERLAP, IL_BOND_NEAR, IL_BOND_JOIN, IL_BOND_GUESS, IL_BOND_GIVEN, IL_BOND_GROUP, IL_N_BONDS
} il_bond;

/* Outer ring RING of level LEVEL; (x, y): the area centroid of what it encloses.
 * n_up, n_down: bones to the level above and below.  ends: inside the stack, at a
 * side where there is a slice to go on to. */
typedef struct il_joint {
    uint32_t level, ring, piece;
    double x, y;
    uint32_t n_up, n_down;
    bool ends;
} il_joint;

/* Joints A of a level and B of the next. */
typedef struct il_bone {
    uint32_t a, b;
    il_bond bond;
} il_bone;

/* What bones hold together.  volume: areas within outer rings times half the
 * distance between the slices beside them, unit^3.  low, high: levels. */
typedef struct il_piece {
    double volume;
    size_t n_joints;
    uint32_t low, high;
} il_piece;

/* joint[]: by level, then ring.  bone[]: by a, then b, each pair once.  piece[]: by falling
 * volume.  piece_of[first[k] + i]: of ring i of level k; UINT32_MAX for a hole of which the
 * pairs do not tell.  branches: joints with more than one bone on a side; ends: joints that
 * end; loops: bones that could be cut before a piece fell in two. */
typedef struct il_skeleton {
    il_joint *joint;         size_t n_joints;
    il_bone *bone;           size_t n_bones, cap_bones;
    il_piece *piece;         size_t n_pieces;
    size_t *first;
    uint32_t *piece_of, *joint_of;
    size_t bonds[IL_N_BONDS], branches, ends, loops;
} il_skeleton;

#define IL_SKELETON_INIT { 0 }

/* Of F, which has all of its slices, clean.  O(n log n) for n rings and links.  IL_E_NOMEM;
 * *S is to be freed either way. */
il_status il_skeleton_find(il_skeleton *s, const il_figure *f, il_error *err);
void il_skeleton_free(il_skeleton *s); /* safe twice */

#endif
