/* attempt.h - one group of rings: tried in turn until a surface is certified.
 *
 * S: phi, with matched arcs laid on each other; P: phi alone; B: the slices as
 * they lie (loft.md).  Each has its ladder of grids and of heights of caps. */
#ifndef IL_LOFT_ATTEMPT_H
#define IL_LOFT_ATTEMPT_H

#include "loft/certificate.h"
#include "loft/phi.h"
#include "model/pair.h"

/* A group: its sections (the rings of the group alone), and what is known of
 * them: phi (null: nothing), match[n_matches], which of phi's matched arcs are
 * theirs, and fit (or null); all borrowed.  as_they_lie: phi is the identity, so
 * that P would be B.  deformed_only: B is not tried.  apart: the group
 * lies apart (model/pair.h), so that sheets may be built as stars.  outside: as in reference.h. */
typedef struct il_task {
    const il_section *lower, *upper;
    const il_phi *phi;
    const uint32_t *match; size_t n_matches;
    const il_fit *fit;
    unsigned char outside;
    bool as_they_lie, round_float, deformed_only, apart;
} il_task;

/* What came of it: attempt is the one that passed, or the last.  What passed as
 * S with less than nine tenths of its matched length in walls counts as P. */
typedef struct il_outcome {
    il_surface surface;
    il_attempt attempt;
    il_verdict verdict;
} il_outcome;

#define IL_OUTCOME_INIT { 0 }
void il_outcome_free(il_outcome *o);

/* IL_OK also when no attempt passed: the verdict tells. */
il_status il_attempt_group(il_outcome *out, const il_task *task, il_error *err);

#endif
