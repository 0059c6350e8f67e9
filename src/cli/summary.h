/* summary.h - the account of a run, for programs and for people. */
#ifndef IL_CLI_SUMMARY_H
#define IL_CLI_SUMMARY_H

#include "cli/json.h"
#include "cli/message.h"
#include "cli/pipeline.h"

/* The JSON account on one line, as formats/summary.schema.json has it, to OUT. */
void il_summary_json(const il_result *r, il_output *out);

/* Its parts, for accounts that say more: the key "stacks", the one for a stack's
 * colour, and "seconds" with "peak_bytes". */
void il_summary_json_stacks(il_json *j, const il_result *r);
void il_summary_json_color(il_json *j, const il_stack_account *s); /* "colour" */
void il_summary_json_cost(il_json *j, double seconds);

/* A table a stack, to OUT; without the surface for `check`. */
void il_summary_text(const il_result *r, il_output *out);
void il_summary_contours(const il_result *r, il_output *out);

/* What the user has to know (notes, repairs, skipped parts, gaps), and when
 * verbose what became of every stack, through V. */
void il_summary_say(const il_result *r, il_voice *v);

#endif
