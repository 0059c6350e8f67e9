/* select.h - only the stacks whose names match. */
#ifndef IL_CLI_SELECT_H
#define IL_CLI_SELECT_H

#include "cli/message.h"
#include "model/report.h"
#include "model/sink.h"

/* A sink that passes on to NEXT (borrowed) the stacks that PATTERN[0..N) choose
 * and drops the others, with what REPORT has of them.  The patterns are those of
 * the shell (borrowed), and ! before one, as il_pattern_choose has them.
 * IL_E_INPUT at the end, with some of the names there are, when none was taken;
 * else VOICE (borrowed) tells which patterns no name matched. */
il_status il_select_new(il_sink **out, const char *const *pattern, size_t n, il_sink *next,
                        il_report *report, il_voice *voice, il_error *err);
void il_select_free(il_sink *s); /* null is fine */

#endif
