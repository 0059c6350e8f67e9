/* info.c - what is in the input, and what comes out of it; nothing is written. */
#include "config.h"
#include "cli/command.h"
#include "cli/summary.h"

static il_status print(il_summary_writer *write, const il_result *r, il_error *err)
{
    il_output *out = NULL;
    il_status st = il_output_open(&out, "-", err);
    if (st != IL_OK)
        return st;
    st = write(r, out, err);
    if (st == IL_OK)
        return il_output_commit(out, err);
    il_output_discard(out);
    return st;
}

il_status il_command_survey(const il_options *o, const il_plan *plan, il_summary_writer *write, il_voice *v, il_error *err)
{
    il_result result;
    il_status st = il_pipeline_run(&result, o, plan, v, err);
    bool memory = st != IL_E_NOMEM; /* there is none left to say more */
    if (err->code != IL_OK)
        il_message_error(v, err);
    il_error_clear(err);
    il_status said = IL_OK;
    if (memory && (!o->json || o->json_path))
        said = print(write, &result, err);
    if (memory && said == IL_OK)
        said = il_command_put_account(o, true, &result, v, err);
    il_account_free(&result.account);
    return said == IL_OK ? st : said;
}

static il_status write_text(const il_result *r, il_output *out, il_error *err)
{
    (void)err;
    il_summary_text(r, out);
    return IL_OK;
}

il_status il_command_info(const il_options *o, il_voice *v, il_error *err)
{
    il_plan plan = { .match = true, .loft = true, .survey = true };
    return il_command_survey(o, &plan, write_text, v, err);
}
