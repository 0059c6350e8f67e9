/* summary.h - the account of a run, for programs and for people. */
#ifndef IL_CLI_SUMMARY_H
#define IL_CLI_SUMMARY_H

#include "cli/message.h"
#include "cli/pipeline.h"

/* The JSON account on one line, as formats/summary.schema.json has it, to OUT. */
void il_summary_json(const il_result *r, il_output *out);

/* A table a stack, to OUT; for `info`. */
void il_summary_text(const il_result *r, il_output *out);

/* What the user has to know (notes, repairs, skipped parts, gaps), and when
 * verbose what became of every stack, through V. */
void il_summary_say(const il_result *r, il_voice *v);

#endif
