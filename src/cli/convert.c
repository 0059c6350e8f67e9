/* convert.c - any contours to a mesh; with -t loft to matched contours. */
#include "config.h"
#include "cli/command.h"

il_status il_command_convert(const il_options *o, il_voice *v, il_error *err)
{
    il_plan plan = { .match = true, .loft = o->to->mesh_new != NULL };
    return il_command_run_plan(o, &plan, v, err);
}
