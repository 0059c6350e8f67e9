#include "config.h"
#include "cli/help.h"

#include <stdio.h>
#include <string.h>

/* How a verb is called, and what it does. */
static const struct { const char *call, *words; } calls[IL_N_VERBS] = {
    [IL_VERB_CONVERT] = { "[convert] INPUT...", "contours to a closed, certified mesh" },
    [IL_VERB_READ]    = { "read INPUT...",      "contours, cleaned, as a native stream" },
    [IL_VERB_MATCH]   = { "match [FILE]",       "adds correspondences to a native stream" },
    [IL_VERB_MESH]    = { "mesh [FILE]",        "a native stream to a mesh" },
    [IL_VERB_INFO]    = { "info INPUT...",      "what is in it, and what comes out" },
    [IL_VERB_CHECK]   = { "check FILE",         "is a native stream or a mesh sound?" },
    [IL_VERB_PLOT]    = { "plot [FILE]",        "a picture (SVG) of a native stream" },
};

static void usage_line(char *to, size_t size, int v)
{
    snprintf(to, size, "%s isoloft %-19s %s\n", v == 0 ? "usage:" : "      ", calls[v].call, calls[v].words);
}

void il_help_usage(void)
{
    char line[120];
    for (int v = 0; v < IL_N_VERBS; v++) {
        usage_line(line, sizeof line, v);
        fputs(line, stderr);
    }
    fputs("isoloft --help tells more.\n", stderr);
}

/* "  -o, --output FILE        write ..." */
static void option_line(il_output *out, const il_option *p, const char *words)
{
    char letter[8] = "    ", name[64], line[160];
    if (p->letter)
        snprintf(letter, sizeof letter, "-%c, ", p->letter);
    bool value = p->kind == IL_OPTION_VALUE || p->kind == IL_OPTION_VALUE_OR_NO, maybe = p->kind == IL_OPTION_MAYBE;
    snprintf(name, sizeof name, "%s%s%s%s", p->name, value ? " " : maybe ? "[=" : "",
             value || maybe ? p->argument : "", maybe ? "]" : "");
    snprintf(line, sizeof line, "  %s--%-22s %s\n", letter, name, words);
    il_output_string(out, line);
}

/* The first screen: at most 24 lines of 80 columns. */
static void help_all(il_output *out)
{
    char line[120];
    for (int v = 0; v < IL_N_VERBS; v++) {
        usage_line(line, sizeof line, v);
        il_output_string(out, line);
    }
    for (const il_option *p = il_option_table; p->name; p++)
        if (p->brief)
            option_line(out, p, p->brief);
    il_output_string(out, "isoloft VERB --help lists all options of a verb; also --formats, --version;\n"
                          "man isoloft tells everything.\n");
}

static void help_verb(il_output *out, il_verb v)
{
    char line[120];
    snprintf(line, sizeof line, "usage: isoloft %s\n%s\n\n", calls[v].call, calls[v].words);
    il_output_string(out, line);
    for (const il_option *p = il_option_table; p->name; p++)
        if (p->verbs >> v & 1)
            option_line(out, p, p->help);
    il_output_string(out, "\nEvery switch has a --no- form; -- ends the options; - is standard input.\n");
}

static void list_formats(il_output *out)
{
    char line[160];
    for (const il_reader *const *r = il_readers; *r; r++) {
        snprintf(line, sizeof line, "-f %-10s %s\n", (*r)->name, (*r)->words);
        il_output_string(out, line);
    }
    for (const il_writer *const *w = il_writers; *w; w++) {
        snprintf(line, sizeof line, "-t %-10s %s\n", (*w)->name, (*w)->words);
        il_output_string(out, line);
    }
}

il_status il_help_run(const il_options *o, il_error *err)
{
    il_output *out = NULL;
    il_status st = il_output_open(&out, "-", err);
    if (st != IL_OK)
        return st;
    if (o->action == IL_ACTION_VERSION)
        il_output_string(out, "isoloft " PACKAGE_VERSION "\n");
    else if (o->action == IL_ACTION_FORMATS)
        list_formats(out);
    else if (o->verb_given)
        help_verb(out, o->verb);
    else
        help_all(out);
    return il_output_commit(out, err);
}
