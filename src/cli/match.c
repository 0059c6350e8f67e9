/* match.c - a native stream to one with pair records. */
#include "config.h"
#include "cli/command.h"

il_status il_command_match(const il_options *o, il_voice *v, il_error *err)
{
    il_plan plan = { .native_only = true, .match = true };
    return il_command_run_plan(o, &plan, v, err);
}
