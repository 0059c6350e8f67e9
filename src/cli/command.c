/* command.c - what the commands have in common once they have a plan. */
#include "config.h"
#include "cli/command.h"
#include "cli/summary.h"

il_status il_command_put_json(const il_options *o, bool to_stdout, void (*write)(const void *self, il_output *out),
                              const void *self, il_voice *v, il_error *err)
{
    if (!o->json)
        return IL_OK;
    bool named = o->json_path || to_stdout;
    il_output *out = NULL;
    il_status st = named ? il_output_open(&out, o->json_path ? o->json_path : "-", err)
                         : il_output_to_memory(&out, err);
    if (st != IL_OK)
        return st;
    write(self, out);
    if (named)
        return il_output_commit(out, err);
    st = il_output_status(out, err);
    if (st == IL_OK) {
        size_t n;
        const unsigned char *text = il_output_memory(out, &n);
        il_message_raw(v, text, n);
    }
    il_output_discard(out);
    return st;
}

static void write_account(const void *self, il_output *out)
{
    il_summary_json(self, out);
}

il_status il_command_put_account(const il_options *o, bool to_stdout, const il_result *r, il_voice *v, il_error *err)
{
    return il_command_put_json(o, to_stdout, write_account, r, v, err);
}

/* Say what the user has to know of a run.  An error that ended it stands alone,
 * on one line, unless V is verbose; *ERR is clear then. */
static void tell(const il_result *r, il_voice *v, il_error *err)
{
    bool failed = err->code != IL_OK;
    if (!failed || v->verbose)
        il_summary_say(r, v);
    if (failed)
        il_message_error(v, err);
    il_error_clear(err);
}

il_status il_command_run_plan(const il_options *o, const il_plan *plan, il_voice *v, il_error *err)
{
    il_result result;
    il_status st = il_pipeline_run(&result, o, plan, v, err);
    tell(&result, v, err);
    il_status json = il_command_put_account(o, false, &result, v, st == IL_E_NOMEM ? NULL : err);
    il_account_free(&result.account);
    return st == IL_OK ? json : st;
}
