/* linker.h - the stage that links the regions of a whole stack before they are matched. */
#ifndef IL_MATCH_LINKER_H
#define IL_MATCH_LINKER_H

#include "match/linkage.h"
#include "model/given.h"
#include "model/report.h"
#include "model/sink.h"

/* A sink that holds each solid stack until it ends, and passes it on to NEXT (borrowed) with a
 * pair for each slab that had none: its groups and links, and nothing else (il_pair, linked),
 * which is for the matcher to complete.  Links are as il_linkage_find gives them; of a stack that
 * GIVEN (borrowed, or null) names they are as it says, whatever records the stream brought, which
 * il_linkage_given can refuse, and of others it is told in REPORT (borrowed) that they are not.
 * Terrain passes. */
il_status il_linker_new(il_sink **out, const il_linkage_options *o, const il_given *given, il_sink *next,
                        il_report *report, il_error *err);

/* The first of GIVEN's stacks from the K-th on that has not come; its n_stacks when all have. */
size_t il_linker_missed(const il_sink *s, size_t k);
void il_linker_free(il_sink *s); /* null is fine */

#endif
