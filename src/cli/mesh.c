/* mesh.c - a native stream, matched or not, to a mesh. */
#include "config.h"
#include "cli/command.h"

il_status il_command_mesh(const il_options *o, il_voice *v, il_error *err)
{
    il_plan plan = { .native_only = true, .match = true, .loft = true };
    return il_command_run_plan(o, &plan, v, err);
}
