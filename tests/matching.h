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

/* In [LEAST, MOST). */
static inline double random_between(uint64_t *seed, double least, double most)
{
    return least + (most - least) * stack_uniform(seed);
}

#endif
