#include "config.h"
#include "cli/command.h"
il_status il_command_check(const il_options *o, il_voice *v, il_error *err)
{
    (void)o; (void)v;
    return il_fail(err, IL_E_INTERNAL, 0, "later");
}
