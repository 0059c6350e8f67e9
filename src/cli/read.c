/* read.c - any contours to clean ones. */
#include "config.h"
#include "cli/command.h"

il_status il_command_read(const il_options *o, il_voice *v, il_error *err)
{
    il_plan plan = { .match = false };
    return il_command_run_plan(o, &plan, v, err);
}
