/* lofting.h - stacks through the lofter, and what every mesh must be. */
#ifndef IL_TESTS_LOFTING_H
#define IL_TESTS_LOFTING_H

#include "loft/lofter.h"
#include "model/mesh.h"

/* A mesh sink that keeps everything. */
typedef struct keeper {
    il_mesh_sink sink;
    il_mesh mesh;
    il_mesh_facts facts;
    int begun, ended, abandoned;
} keeper;

keeper new_keeper(void);

/* Clean slice[N] and their pairs, pair[N - 1] or null, through a lofter into K;
 * copies of the slices, but the pairs are given up. */
il_status loft_pairs(keeper *k, const il_slice *slice, size_t n, il_pair *pair, const il_loft_options *o, il_error *err);

void free_slices(il_slice *slice, size_t n);

/* The mesh of K is closed, manifold, oriented, and as its facts say; WHAT and SEED
 * name it in the failure. */
void assert_sound(const keeper *k, const char *what, unsigned long long seed);

void assert_same_mesh(const il_mesh *a, const il_mesh *b);

#endif
