/* match-table.h - what bench-match measured, as text. */
#ifndef IL_TESTS_BENCH_MATCH_TABLE_H
#define IL_TESTS_BENCH_MATCH_TABLE_H

#include "judge.h"
#include "../pairs.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What one solver made of a pair; ms: of the processor. */
typedef struct match_figures {
    double ms;
    judged is;
    uint32_t steps;
} match_figures;

/* One pair.  same_again: every run gave the same bits.  scaled: it had to be made
 * smaller to lie in the frame.  peer: what elastix made of it. */
typedef struct match_result {
    pairs_family family;
    uint32_t seed;
    match_figures ours, peer;
    double said_up_mean, said_down_mean, said_jacobian, said_distortion;
    bool same_again, scaled, has_peer;
} match_result;

void match_print_csv(const match_result *r, size_t n);

/* A row for each family, then one for each named pair and whatever elastix tried. */
void match_print_tables(const match_result *r, size_t n);

/* Whether the figures are what they should be, in words; false when they are not. */
bool match_check_limits(const match_result *r, size_t n);

#endif
