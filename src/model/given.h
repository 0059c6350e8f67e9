/* given.h - what the user says belongs together, of whole stacks (formats/links.txt). */
#ifndef IL_MODEL_GIVEN_H
#define IL_MODEL_GIVEN_H

#include "model/pair.h"

/* explained: a reason and a reach were said with it; else the reason is IL_LINK_GIVEN, and the
 * reach not known yet.  line: where it stands, as below. */
typedef struct il_given_link {
    il_link link;
    bool explained;
    long line;
} il_given_link;

/* The links between the slices at z = below and z = above, unit: link[first] .. link[first + n]. */
typedef struct il_given_slab {
    double below, above;
    size_t first, n;
    long line;
} il_given_slab;

/* name: UTF-8.  number: its own, or its place among the stacks, from 1, when it has none.
 * Its slabs: slab[first] .. slab[first + n]. */
typedef struct il_given_stack {
    char *name;
    long number;
    size_t first, n;
    long line;
} il_given_stack;

/* file: where it was read from.  Stacks and slabs in the order of the lines. */
typedef struct il_given {
    char *file;
    il_given_stack *stack; size_t n_stacks, cap_stacks;
    il_given_slab *slab;   size_t n_slabs, cap_slabs;
    il_given_link *link;   size_t n_links, cap_links;
} il_given;

#define IL_GIVEN_INIT { 0 }
void il_given_free(il_given *g); /* safe twice */

#endif
