/* linker.h - the stage that links the regions of a whole stack before they are matched. */
#ifndef IL_MATCH_LINKER_H
#define IL_MATCH_LINKER_H

#include "match/linkage.h"
#include "model/sink.h"

/* A sink that holds each solid stack until it ends, and passes it on to NEXT (borrowed) with a
 * pair for each slab that had none: its groups and links, as il_linkage_find gives them, and
 * nothing else (il_pair, linked), which is for the matcher to complete.  Terrain passes. */
il_status il_linker_new(il_sink **out, const il_linkage_options *o, il_sink *next, il_error *err);
void il_linker_free(il_sink *s); /* null is fine */

#endif
