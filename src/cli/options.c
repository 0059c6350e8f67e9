/* options.c - the command line, word by word, and what its options mean together. */
#include "config.h"
#include "cli/options.h"
#include "base/alloc.h"
#include "cli/destination.h"
#include "cli/filename.h"
#include "output/picture.h"

#include <string.h>

void il_options_init(il_options *o)
{
    *o = (il_options){ .action = IL_ACTION_RUN, .verb = IL_VERB_CONVERT, .cap = IL_CAP_FLAT, .between = IL_BETWEEN_AUTO,
                       .matcher = IL_MATCHER_FFD, .progress = IL_WHEN_AUTO };
    o->read = (il_read_options)IL_READ_OPTIONS_INIT;
    o->relief.placement = (il_placement_options)IL_PLACEMENT_OPTIONS_INIT;
}

void il_options_free(il_options *o)
{
    il_free(o->input);
    il_free(o->pattern);
    il_free(o->read.map.layer);
    il_options_init(o);
}

/* ---- words ---------------------------------------------------------------- */

static const il_option *find_long(const char *name, size_t n)
{
    for (const il_option *p = il_option_table; p->name; p++)
        if (strlen(p->name) == n && memcmp(p->name, name, n) == 0)
            return p;
    return NULL;
}

static const il_option *find_letter(char letter)
{
    for (const il_option *p = il_option_table; p->name; p++)
        if (p->letter && p->letter == letter)
            return p;
    return NULL;
}

static il_status apply(il_options *o, const il_option *p, const char *value, bool on, il_error *err)
{
    o->given |= UINT64_C(1) << (p - il_option_table);
    return p->set(o, value, on, err);
}

bool il_options_given(const il_options *o, const char *name)
{
    return o->given >> (find_long(name, strlen(name)) - il_option_table) & 1;
}

static bool needs_value(const il_option *p)
{
    return p->kind == IL_OPTION_VALUE || p->kind == IL_OPTION_VALUE_OR_NO;
}

static bool can_be_negated(const il_option *p)
{
    return p->kind == IL_OPTION_SWITCH || p->kind == IL_OPTION_MAYBE || p->kind == IL_OPTION_VALUE_OR_NO;
}

/* argv[*i] is "--NAME" or "--NAME=VALUE"; the value may be argv[*i + 1]. */
static il_status parse_long(il_options *o, int argc, char **argv, int *i, il_error *err)
{
    const char *name = argv[*i] + 2, *equals = strchr(name, '='), *value = equals ? equals + 1 : NULL;
    size_t n = equals ? (size_t)(equals - name) : strlen(name);
    bool on = true;
    const il_option *p = find_long(name, n);
    if (!p && n > 3 && memcmp(name, "no-", 3) == 0) {
        p = find_long(name + 3, n - 3);
        on = false;
        if (p && !can_be_negated(p))
            p = NULL;
    }
    if (!p)
        return il_fail(err, IL_E_USAGE, 0, "there is no option '--%.*s' (--help lists them)",
                       n < 60 ? (int)n : 60, name);
    if (value && (!on || p->kind == IL_OPTION_SWITCH || p->kind == IL_OPTION_ACTION))
        return il_fail(err, IL_E_USAGE, 0, "--%s%s takes no value", on ? "" : "no-", p->name);
    if (needs_value(p) && on && !value) {
        if (*i + 1 >= argc)
            return il_fail(err, IL_E_USAGE, 0, "--%s needs a value: %s", p->name, p->argument);
        value = argv[++*i];
    }
    return apply(o, p, value, on, err);
}

/* argv[*i] is "-abc": letters in a row, the last of which may have a value,
 * right behind it or in argv[*i + 1]. */
static il_status parse_letters(il_options *o, int argc, char **argv, int *i, il_error *err)
{
    for (const char *s = argv[*i] + 1; *s; s++) {
        const il_option *p = find_letter(*s);
        if (!p)
            return il_fail(err, IL_E_USAGE, 0, "there is no option '-%.*s' (--help lists them)", 1, s);
        const char *value = NULL;
        if (needs_value(p)) {
            if (!s[1] && *i + 1 >= argc)
                return il_fail(err, IL_E_USAGE, 0, "-%c needs a value: %s", *s, p->argument);
            value = s[1] ? s + 1 : argv[++*i];
        }
        il_status st = apply(o, p, value, true, err);
        if (st != IL_OK || value)
            return st;
    }
    return IL_OK;
}

static bool parse_verb(il_options *o, const char *word)
{
    for (int v = 0; v < IL_N_VERBS; v++) {
        if (strcmp(word, il_verb_name((il_verb)v)) == 0) {
            o->verb = (il_verb)v;
            o->verb_given = true;
            return true;
        }
    }
    return false;
}

static il_status take_operand(il_options *o, const char *word, bool first, il_error *err)
{
    if (first && parse_verb(o, word))
        return IL_OK;
    if (!il_grow(&o->input, &o->cap_inputs, o->n_inputs + 1, sizeof *o->input))
        return il_fail_nomem(err);
    o->input[o->n_inputs++] = word;
    return IL_OK;
}

/* ---- all of them together -------------------------------------------------- */

/* A picture is SVG, and so is its file. */
static il_status settle_picture(il_options *o, const char *extension, il_error *err)
{
    o->to = &il_writer_picture;
    if (*extension && strcmp(extension, "svg") != 0)
        return il_fail(err, IL_E_USAGE, 0, "'plot' writes SVG, which a file with the extension '.%.40s' is not", extension);
    return IL_OK;
}

/* The output format where -t did not give it, and whether the verb writes it. */
static il_status settle_format(il_options *o, il_error *err)
{
    bool contours = o->verb == IL_VERB_READ || o->verb == IL_VERB_MATCH;
    if (o->verb == IL_VERB_INFO || o->verb == IL_VERB_CHECK || o->list)
        return IL_OK;
    bool named = o->output && strcmp(o->output, "-") != 0 && !il_destination_is_folder(o->output);
    const char *extension = named ? il_filename_extension(o->output) : "";
    if (o->verb == IL_VERB_PLOT)
        return settle_picture(o, extension, err);
    if (!o->to && *extension && !(o->to = il_writer_for_path(o->output)))
        return il_fail(err, IL_E_USAGE, 0, "no output format has the extension '.%.40s' (--formats lists them)",
                       extension);
    if (!o->to)
        o->to = contours ? &il_writer_loft : &il_writer_stl;
    if (contours && !o->to->contours_new)
        return il_fail(err, IL_E_USAGE, 0, "'%s' writes contours, not %s", il_verb_name(o->verb), o->to->name);
    if (o->verb == IL_VERB_MESH && !o->to->mesh_new)
        return il_fail(err, IL_E_USAGE, 0, "'mesh' writes a mesh, not %s", o->to->name);
    return IL_OK;
}

/* Two outputs of one run must not be one file. */
static il_status check_outputs_differ(const il_options *o, il_error *err)
{
    bool writes = o->verb != IL_VERB_INFO && o->verb != IL_VERB_CHECK && !o->list;
    const char *path[4] = { o->output || !writes ? o->output : "-", o->pairs, o->json_path, o->links_out };
    for (int i = 0; i < 4; i++)
        for (int k = i + 1; k < 4; k++)
            if (path[i] && path[k] && strcmp(path[i], path[k]) == 0)
                return il_fail(err, IL_E_USAGE, 0, "two outputs cannot both go to '%.100s'", path[i]);
    return IL_OK;
}

static il_status check_inputs(const il_options *o, il_error *err)
{
    bool one = o->verb == IL_VERB_MATCH || o->verb == IL_VERB_MESH || o->verb == IL_VERB_CHECK || o->verb == IL_VERB_PLOT;
    if (one && o->n_inputs > 1)
        return il_fail(err, IL_E_USAGE, 0, "'%s' takes one file", il_verb_name(o->verb));
    size_t n_dashes = 0;
    for (size_t k = 0; k < o->n_inputs; k++) {
        if (!*o->input[k])
            return il_fail(err, IL_E_USAGE, 0, "an input's name is empty");
        n_dashes += strcmp(o->input[k], "-") == 0;
    }
    n_dashes += o->links && strcmp(o->links, "-") == 0;
    return n_dashes <= 1 ? IL_OK : il_fail(err, IL_E_USAGE, 0, "standard input (-) can be read once only");
}

static il_status check_list(const il_options *o, il_error *err)
{
    if (o->list && (o->output || o->pairs || o->links_out))
        return il_fail(err, IL_E_USAGE, 0, "--list writes its table alone, to standard output, and takes no --%s",
                       o->output ? "output" : o->pairs ? "pairs" : "links-out");
    return IL_OK;
}

/* Slices that are compared as they lie have no links. */
static il_status check_links(const il_options *o, il_error *err)
{
    if (o->matcher == IL_MATCHER_NONE && (o->links || o->links_out))
        return il_fail(err, IL_E_USAGE, 0, "--links%s is of no use with --matcher none, which links nothing", o->links ? "" : "-out");
    return IL_OK;
}

/* Map coordinates cost up to 0.7 m as 32-bit floats, so those formats get small ones. */
static il_status settle_relief(il_options *o, il_error *err)
{
    il_placement_options *p = &o->relief.placement;
    p->round_float = o->to && o->to->round_float;
    if (!il_options_given(o, "recentre"))
        p->recentre = p->round_float;
    if (p->has_base && !p->solid)
        return il_fail(err, IL_E_USAGE, 0, "--base is the floor of a solid, which --solid asks for");
    if (o->relief.law.kind != IL_LAW_MEAN && o->relief.law.has_spread)
        return il_fail(err, IL_E_USAGE, 0, "--spread is that of --law mean: the others have none");
    o->relief.high = o->read.map.high;
    return IL_OK;
}

/* The skeleton is the one picture for which links are looked for. */
static il_status check_pieces(const il_options *o, il_error *err)
{
    const char *given = il_options_given(o, "pieces") ? "pieces" : o->links ? "links" : NULL;
    if (o->verb == IL_VERB_PLOT && given && o->picture.what != IL_PICTURE_SKELETON)
        return il_fail(err, IL_E_USAGE, 0, "--%s goes with --skeleton: other pictures show what the stream says", given);
    return IL_OK;
}

/* What can only be told when all of the line is known. */
static il_status check_together(il_options *o, il_error *err)
{
    for (const il_option *p = il_option_table; p->name; p++)
        if ((o->given >> (p - il_option_table) & 1) && !(p->verbs >> o->verb & 1))
            return il_fail(err, IL_E_USAGE, 0, "'%s' has no option --%s (isoloft %s --help lists them)",
                           il_verb_name(o->verb), p->name, il_verb_name(o->verb));
    il_status st = check_inputs(o, err);
    if (st == IL_OK)
        st = check_list(o, err);
    if (st == IL_OK)
        st = check_pieces(o, err);
    if (st == IL_OK)
        st = check_links(o, err);
    if (st == IL_OK)
        st = settle_format(o, err);
    if (st == IL_OK)
        st = settle_relief(o, err);
    return st == IL_OK ? check_outputs_differ(o, err) : st;
}

/* ---- the command line ------------------------------------------------------- */

il_status il_options_parse(il_options *o, int argc, char **argv, il_error *err)
{
    bool first = true, options = true;
    il_status st = IL_OK;
    for (int i = 1; i < argc && st == IL_OK; i++) {
        const char *word = argv[i];
        if (options && strcmp(word, "--") == 0) {
            options = false;
        } else if (options && word[0] == '-' && word[1] == '-') {
            st = parse_long(o, argc, argv, &i, err);
        } else if (options && word[0] == '-' && word[1]) {
            st = parse_letters(o, argc, argv, &i, err);
        } else {
            st = take_operand(o, word, first, err);
            first = false;
        }
    }
    return st == IL_OK && o->action == IL_ACTION_RUN ? check_together(o, err) : st;
}
