/* command.h - one function a verb. */
#ifndef IL_CLI_COMMAND_H
#define IL_CLI_COMMAND_H

#include "cli/message.h"
#include "cli/options.h"
#include "cli/pipeline.h"

/* Do what O asks.  The code is the program's exit code; *ERR is set for what
 * the user has not been told yet. */
il_status il_command_convert(const il_options *o, il_voice *v, il_error *err);
il_status il_command_read(const il_options *o, il_voice *v, il_error *err);
il_status il_command_match(const il_options *o, il_voice *v, il_error *err);
il_status il_command_mesh(const il_options *o, il_voice *v, il_error *err);
il_status il_command_info(const il_options *o, il_voice *v, il_error *err);
il_status il_command_check(const il_options *o, il_voice *v, il_error *err);
il_status il_command_plot(const il_options *o, il_voice *v, il_error *err);

/* --list: a table of the stacks, without a mesh. */
il_status il_command_list(const il_options *o, il_voice *v, il_error *err);

/* For those that only look: run PLAN, put WRITE's text about the result to
 * standard output, and what --json asks for there or to its file. */
typedef il_status il_summary_writer(const il_result *r, il_output *out, il_error *err);
il_status il_command_survey(const il_options *o, const il_plan *plan, il_summary_writer *write, il_voice *v, il_error *err);

/* For the five that write: run PLAN and say what there is to say of it. */
il_status il_command_run_plan(const il_options *o, const il_plan *plan, il_voice *v, il_error *err);

/* What --json asks for: WRITE's text about SELF to the file named, or to
 * standard output when TO_STDOUT and none is, else as the last line on standard
 * error.  Nothing without --json. */
il_status il_command_put_json(const il_options *o, bool to_stdout, void (*write)(const void *self, il_output *out),
                              const void *self, il_voice *v, il_error *err);
/* The same with the account of a run. */
il_status il_command_put_account(const il_options *o, bool to_stdout, const il_result *r, il_voice *v, il_error *err);

#endif
