/* main.c - picks the command; nothing else. */
#include "config.h"
#include "base/alloc.h"
#include "cli/command.h"
#include "cli/help.h"
#include "cli/progress.h"

#include <signal.h>
#include <unistd.h>

static il_status (*const commands[IL_N_VERBS])(const il_options *, il_voice *, il_error *) = {
    [IL_VERB_CONVERT] = il_command_convert, [IL_VERB_READ] = il_command_read, [IL_VERB_MATCH] = il_command_match,
    [IL_VERB_MESH] = il_command_mesh, [IL_VERB_INFO] = il_command_info, [IL_VERB_CHECK] = il_command_check,
    [IL_VERB_PLOT] = il_command_plot
};

static il_status run(const il_options *o, il_voice *v, il_error *err)
{
    if (o->action != IL_ACTION_RUN)
        return il_help_run(o, err);
    if (o->n_inputs == 0 && isatty(STDIN_FILENO)) {
        il_help_usage();
        return IL_E_USAGE;
    }
    return o->list ? il_command_list(o, v, err) : commands[o->verb](o, v, err);
}

int main(int argc, char **argv)
{
    il_options options;
    il_voice voice = { 0 };
    il_error err = IL_ERROR_INIT;
    signal(SIGPIPE, SIG_DFL); /* a parent may have it ignored; a closed pipe ends us without a word */
    il_alloc_test_environment();
    il_options_init(&options);
    il_status st = il_options_parse(&options, argc, argv, &err);
    if (st == IL_OK) {
        il_voice_init(&voice, &options);
        st = run(&options, &voice, &err);
    }
    if (err.code != IL_OK)
        il_message_error(&voice, &err);
    il_options_free(&options);
    return (int)st;
}
