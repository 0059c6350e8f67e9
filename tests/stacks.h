/* stacks.h - stacks of contours made to be hard, from a seed. */
#ifndef IL_TESTS_STACKS_H
#define IL_TESTS_STACKS_H

#include "model/stack.h"

#include <stdint.h>

/* Kinds of trouble between slices, and inside them. */
typedef enum stack_kind {
    STACK_EQUAL,        /* the same ring in every slice */
    STACK_CELLS,        /* random cells of a grid: shared, collinear, opposite edges, pinches */
    STACK_CELLS_ULP,    /* the same, every vertex off by 0 or 1 ulp */
    STACK_CELLS_NANO,   /* off by up to 1e-9 */
    STACK_UNRELATED,    /* random star shapes */
    STACK_FRAME,        /* a common frame with random holes */
    STACK_SLIDING,      /* a ring that slides along its own edges */
    STACK_HALVES,       /* halves of a square by turns: opposite edges */
    STACK_ULP_COPIES,   /* one shape, copies 1 ulp off */
    STACK_TANGLED,      /* rings that cross themselves, on few grid points */
    STACK_N_KINDS
} stack_kind;

/* splitmix64 */
uint64_t stack_random(uint64_t *state);
double stack_uniform(uint64_t *state);  /* in [0, 1) */

/* Slices of the stack of KIND and SEED, 2 to 6; the caller frees them.  Aborts
 * without memory: it is a test. */
size_t stack_make(stack_kind kind, uint64_t seed, il_slice slice[6]);

#endif
