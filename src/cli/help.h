/* help.h - words about the program itself, to standard output. */
#ifndef IL_CLI_HELP_H
#define IL_CLI_HELP_H

#include "cli/options.h"

/* --help, --version or --formats, as O->action says. */
il_status il_help_run(const il_options *o, il_error *err);

/* The lines on how to call it, to standard error. */
void il_help_usage(void);

#endif
