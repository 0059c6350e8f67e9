/* select.h - only the stacks whose names match. */
#ifndef IL_CLI_SELECT_H
#define IL_CLI_SELECT_H

#include "model/report.h"
#include "model/sink.h"

/* A sink that passes on to NEXT (borrowed) the stacks whose name matches the
 * shell pattern PATTERN (borrowed; fnmatch(3)) and drops the others, with what
 * REPORT has of them.
 * IL_E_INPUT at the end when none matched. */
il_status il_select_new(il_sink **out, const char *pattern, il_sink *next, il_report *report, il_error *err);
void il_select_free(il_sink *s); /* null is fine */

#endif
