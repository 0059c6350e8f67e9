/* progress.h - one line on the terminal that says how far the run is. */
#ifndef IL_CLI_PROGRESS_H
#define IL_CLI_PROGRESS_H

#include "cli/message.h"
#include "cli/options.h"

/* Set V up as the options say; without --progress the line is shown when
 * standard error is a terminal, and never when quiet. */
void il_voice_init(il_voice *v, const il_options *o);

/* Show the line, at most ten times a second. */
void il_progress_show(il_voice *v, const char *stack, size_t slices, size_t slabs);

/* Wipe it. */
void il_progress_clear(il_voice *v);

/* Seconds of a clock that only goes forward. */
double il_clock_seconds(void);

#endif
