/* plot.c - a picture of a native stream. */
#include "config.h"
#include "cli/command.h"

il_status il_command_plot(const il_options *o, il_voice *v, il_error *err)
{
    il_plan plan = { .native_only = true, .draw = true, .link = o->picture.what == IL_PICTURE_SKELETON };
    return il_command_run_plan(o, &plan, v, err);
}
