/* unlinked.h - the stage that leaves out pair records which say nothing of links. */
#ifndef IL_MATCH_UNLINKED_H
#define IL_MATCH_UNLINKED_H

#include "model/sink.h"

/* A sink that passes all on to NEXT (borrowed) but pair records without groups: of which
 * rings belong together they say no more than a missing one, which the linker makes. */
il_status il_unlinked_new(il_sink **out, il_sink *next, il_error *err);
void il_unlinked_free(il_sink *s); /* null is fine */

#endif
