/* pipeline.h - the stages put together and run.
 *
 *     reader > select > rescale > [ras] > clean > join > [gaps] > match > [pairs] > [round]
 *            > account > contour writer, or relief (terrain) or lofter (solids) > account > mesh writer
 *
 * Rounding for STL is a cleaning stage of its own behind the matching, so that
 * `read | match | mesh` and `convert` do the same to the same numbers. */
#ifndef IL_CLI_PIPELINE_H
#define IL_CLI_PIPELINE_H

#include "cli/account.h"
#include "cli/options.h"

/* native_only: the input has to be a native stream.  match, loft: these stages
 * take part.  survey: nothing is written, and no stack ends the run.  draw: a
 * picture is made of the contours as they are; none is cleaned, but for link: they
 * are, and what belongs together is found where the stream does not say it. */
typedef struct il_plan {
    bool native_only, match, loft, survey, draw, link;
} il_plan;

/* What a run has found out: the account (to il_account_free), and its time. */
typedef struct il_result {
    il_account account;
    double seconds;
} il_result;

/* Run the inputs of O through the stages of PLAN.  The code is that of the first
 * failure that ended the run, or else the worst of any stack; *ERR is set only
 * for what has not been told yet.  *RESULT is filled in any case. */
il_status il_pipeline_run(il_result *result, const il_options *o, const il_plan *plan, il_voice *voice, il_error *err);

#endif
