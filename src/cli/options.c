#include "config.h"
#include "cli/options.h"
#include "base/alloc.h"
#include "base/number.h"
#include "cli/destination.h"
#include "cli/filename.h"
#include "output/picture.h"

#include <string.h>

static const char *const verb_names[IL_N_VERBS] = { "convert", "read", "match", "mesh", "info", "check", "plot" };

const char *il_verb_name(il_verb v)
{
    return verb_names[v];
}

/* ---- one setter an option ------------------------------------------------ */

static il_status set_from(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    o->from = il_reader_named(value);
    return o->from ? IL_OK
        : il_fail(err, IL_E_USAGE, 0, "no input format is called '%.40s' (--formats lists them)", value);
}

static il_status set_to(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    o->to = il_writer_named(value);
    return o->to ? IL_OK
        : il_fail(err, IL_E_USAGE, 0, "no output format is called '%.40s' (--formats lists them)", value);
}

static il_status set_path(const char **path, const char *value, const char *option, il_error *err)
{
    if (!*value)
        return il_fail(err, IL_E_USAGE, 0, "%s is given an empty name", option);
    *path = value;
    return IL_OK;
}

static il_status set_output(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return set_path(&o->output, value, "--output", err);
}

static il_status set_pairs(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return set_path(&o->pairs, value, "--pairs", err);
}

static il_status add_pattern(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    if (!il_grow(&o->pattern, &o->cap_patterns, o->n_patterns + 1, sizeof *o->pattern))
        return il_fail_nomem(err);
    o->pattern[o->n_patterns++] = value;
    return IL_OK;
}

static il_status set_list(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->list = on;
    return IL_OK;
}

static il_status set_ras(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->ras = on;
    return IL_OK;
}

static il_status set_json(il_options *o, const char *value, bool on, il_error *err)
{
    o->json = on;
    o->json_path = NULL;
    return value ? set_path(&o->json_path, value, "--json", err) : IL_OK;
}

static il_status parse_unit(const char *value, il_unit *u, il_error *err)
{
    return il_unit_parse(value, strlen(value), u) ? IL_OK
        : il_fail(err, IL_E_USAGE, 0, "'%.40s' is no unit (um mm cm m km in ft deg)", value);
}

static il_status set_unit(il_options *o, const char *value, bool on, il_error *err)
{
    o->read.has_unit = on;
    return parse_unit(value, &o->read.unit, err);
}

static il_status set_to_unit(il_options *o, const char *value, bool on, il_error *err)
{
    o->convert_unit = on;
    il_status st = parse_unit(value, &o->to_unit, err);
    if (st == IL_OK && !(il_unit_metres(o->to_unit) > 0))
        st = il_fail(err, IL_E_USAGE, 0, "--to needs a unit of length, not '%.40s'", value);
    return st;
}

static il_status parse_length(const char *value, double *length, const char *option, il_error *err)
{
    size_t n = strlen(value);
    if (n > 0 && il_number_parse(value, n, length) == n && *length > 0 && *length < 1e15)
        return IL_OK;
    return il_fail(err, IL_E_USAGE, 0, "%s takes a number above 0, not '%.40s'", option, value);
}

static il_status set_spacing(il_options *o, const char *value, bool on, il_error *err)
{
    o->read.has_spacing = on;
    return parse_length(value, &o->read.spacing, "--spacing", err);
}

static il_status set_flatness(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return parse_length(value, &o->read.flatness, "--flatness", err);
}

static il_status set_flip(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->read.no_flip = !on;
    return IL_OK;
}

/* Digits only, from LEAST to MOST. */
static il_status parse_count(const char *value, size_t least, size_t most, size_t *count, const char *option, il_error *err)
{
    size_t n = 0;
    const char *s = value;
    for (; *s >= '0' && *s <= '9' && n <= most / 10; s++)
        n = 10 * n + (size_t)(*s - '0');
    if (*s || s == value || n < least || n > most)
        return il_fail(err, IL_E_USAGE, 0, "%s takes a whole number from %zu to %zu, not '%.40s'", option, least, most, value);
    *count = n;
    return IL_OK;
}

enum { LIMIT_MOST = 2000000000 };

static il_status set_max_line(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return parse_count(value, 1, LIMIT_MOST, &o->read.max_line, "--max-line", err);
}

static il_status set_max_depth(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return parse_count(value, 1, LIMIT_MOST, &o->read.max_depth, "--max-depth", err);
}

static il_status set_max_points(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return parse_count(value, 1, LIMIT_MOST, &o->read.max_points, "--max-points", err);
}

static il_status set_keyhole(il_options *o, const char *value, bool on, il_error *err)
{
    size_t n = on ? strlen(value) : 0;
    o->has_keyhole = true;
    o->keyhole = 0;
    if (!on || (n > 0 && il_number_parse(value, n, &o->keyhole) == n && o->keyhole >= 0 && o->keyhole < 1e15))
        return IL_OK;
    return il_fail(err, IL_E_USAGE, 0, "--keyhole takes a number from 0 on, not '%.40s'", value);
}

static il_status set_cap(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    if (strcmp(value, "flat") != 0 && strcmp(value, "dome") != 0)
        return il_fail(err, IL_E_USAGE, 0, "--cap is flat or dome, not '%.40s'", value);
    o->cap = strcmp(value, "dome") == 0 ? IL_CAP_DOME : IL_CAP_FLAT;
    return IL_OK;
}

static il_status set_gap(il_options *o, const char *value, bool on, il_error *err)
{
    static const char *const words[] = { [IL_GAPS_BRIDGE] = "bridge", [IL_GAPS_CAP] = "cap", [IL_GAPS_FAIL] = "fail" };
    (void)on;
    for (int k = IL_GAPS_BRIDGE; k <= IL_GAPS_FAIL; k++) {
        if (strcmp(value, words[k]) == 0) {
            o->gap = (il_gap_mode)k;
            return IL_OK;
        }
    }
    return il_fail(err, IL_E_USAGE, 0, "--gap is bridge, cap or fail, not '%.40s'", value);
}

static il_status set_thickness(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return parse_length(value, &o->thickness, "--thickness", err);
}

static il_status set_groups(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    if (strcmp(value, "stack") != 0 && strcmp(value, "slab") != 0)
        return il_fail(err, IL_E_USAGE, 0, "--groups is stack or slab, not '%.40s'", value);
    o->groups_by_slab = strcmp(value, "slab") == 0;
    return IL_OK;
}

static il_status set_matcher(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    bool ffd = strcmp(value, "ffd") == 0;
    if (!ffd && strcmp(value, "none") != 0)
        return il_fail(err, IL_E_USAGE, 0, "no matcher is called '%.40s' (there are: ffd, none)", value);
    o->matcher = ffd ? IL_MATCHER_FFD : IL_MATCHER_NONE;
    return IL_OK;
}

static il_status set_lattice(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->keep_lattices = on;
    return IL_OK;
}

static const char two_pictures[] = "--slices and --pair are two pictures: give one of them";

static il_status set_slices(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    if (on && o->picture.what == IL_PICTURE_PAIR)
        return il_fail(err, IL_E_USAGE, 0, two_pictures);
    if (on || o->picture.what == IL_PICTURE_SLICES)
        o->picture.what = on ? IL_PICTURE_SLICES : IL_PICTURE_AUTO;
    return IL_OK;
}

static il_status set_pair(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    if (o->picture.what == IL_PICTURE_SLICES)
        return il_fail(err, IL_E_USAGE, 0, two_pictures);
    o->picture.what = IL_PICTURE_PAIR;
    return parse_count(value, 0, LIMIT_MOST, &o->picture.pair, "--pair", err);
}

static il_status set_threads(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    size_t n = 0;
    il_status st = parse_count(value, 1, IL_THREADS_MOST, &n, "--threads", err);
    o->threads = (int)n;
    return st;
}

static il_status set_progress(il_options *o, const char *value, bool on, il_error *err)
{
    static const char *const words[] = { "auto", "always", "never" };
    if (!value) {
        o->progress = on ? IL_WHEN_ALWAYS : IL_WHEN_NEVER;
        return IL_OK;
    }
    for (int k = 0; k < 3; k++) {
        if (strcmp(value, words[k]) == 0) {
            o->progress = (il_when)k;
            return IL_OK;
        }
    }
    return il_fail(err, IL_E_USAGE, 0, "--progress is auto, always or never, not '%.40s'", value);
}

static il_status set_strict(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->strict = on;
    return IL_OK;
}

static il_status set_quiet(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->quiet = on;
    return IL_OK;
}

static il_status set_verbose(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->verbose = on;
    return IL_OK;
}

static il_status set_formats(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)on;
    (void)err;
    o->action = IL_ACTION_FORMATS;
    return IL_OK;
}

static il_status set_help(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)on;
    (void)err;
    o->action = IL_ACTION_HELP;
    return IL_OK;
}

static il_status set_version(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)on;
    (void)err;
    o->action = IL_ACTION_VERSION;
    return IL_OK;
}

/* ---- the table ----------------------------------------------------------- */

enum {
    CONVERT = 1 << IL_VERB_CONVERT, READ = 1 << IL_VERB_READ, MATCH = 1 << IL_VERB_MATCH,
    MESH = 1 << IL_VERB_MESH, INFO = 1 << IL_VERB_INFO, CHECK = 1 << IL_VERB_CHECK,
    PLOT = 1 << IL_VERB_PLOT,
    READERS = CONVERT | READ | INFO, WRITERS = CONVERT | READ | MATCH | MESH,
    LOFTERS = CONVERT | MESH | INFO, STREAMS = WRITERS | INFO, ALL = STREAMS | CHECK | PLOT
};

const il_option il_option_table[] = {
    { 'o', "output", "FILE", IL_OPTION_VALUE, WRITERS | PLOT,
      "write FILE, or DIR/ with one file a stack", "write FILE; DIR/: one file a stack; -: stdout", set_output },
    { 't', "output-format", "FORMAT", IL_OPTION_VALUE, WRITERS,
      "output format; else by the extension, or stl", "output format; else by the extension, or stl", set_to },
    { 'f', "input-format", "FORMAT", IL_OPTION_VALUE, STREAMS | PLOT,
      "input format; else by the first bytes", "input format; else by the first bytes", set_from },
    { 0, "pairs", "FILE", IL_OPTION_VALUE, CONVERT | MESH,
      "also write contours and correspondences", "also write contours and correspondences", set_pairs },
    { 0, "pair", "K", IL_OPTION_VALUE, PLOT,
      NULL, "draw the pair above slice K, from 0", set_pair },
    { 0, "slices", NULL, IL_OPTION_SWITCH, PLOT,
      NULL, "draw all slices side by side", set_slices },
    { 0, "list", NULL, IL_OPTION_SWITCH, READERS,
      "a table of what is in the input; no mesh", "a table of what is in the input; no mesh", set_list },
    { 0, "roi", "PATTERN", IL_OPTION_VALUE, STREAMS | PLOT,
      "only names that match; '!PATTERN': not those", "only names that match; '!PATTERN': not those", add_pattern },
    { 0, "stack", "PATTERN", IL_OPTION_VALUE, STREAMS | PLOT,
      NULL, "the same as --roi", add_pattern },
    { 0, "ras", NULL, IL_OPTION_SWITCH, CONVERT | READ,
      NULL, "structure sets: coordinates RAS instead of LPS", set_ras },
    { 0, "unit", "U", IL_OPTION_VALUE, READERS,
      "what the input's numbers mean: um mm ... in ft",
      "what the input's numbers mean: um mm ... ft deg", set_unit },
    { 0, "to", "U", IL_OPTION_VALUE, STREAMS | PLOT,
      "convert lengths to unit U", "convert lengths to unit U", set_to_unit },
    { 0, "spacing", "D", IL_OPTION_VALUE, READERS,
      "distance of slices that state no height", "distance of slices that state no height", set_spacing },
    { 0, "flip", NULL, IL_OPTION_SWITCH, READERS,
      NULL, "SVG: y points down and is turned up (default)", set_flip },
    { 0, "flatness", "D", IL_OPTION_VALUE, READERS,
      NULL, "distance of a flattened curve from the true one", set_flatness },
    { 0, "keyhole", "D", IL_OPTION_VALUE_OR_NO, READERS,
      NULL, "how far the sides of a keyhole are apart; 0: off", set_keyhole },
    { 0, "cap", "flat|dome", IL_OPTION_VALUE, LOFTERS,
      "how the first and last slice are closed", "how first and last slice are closed; else flat", set_cap },
    { 0, "gap", "bridge|cap|fail", IL_OPTION_VALUE, STREAMS,
      NULL, "what missing slices leave: joined or closed", set_gap },
    { 0, "thickness", "T", IL_OPTION_VALUE, STREAMS,
      NULL, "of single slices, input's unit; else a spacing", set_thickness },
    { 0, "matcher", "ffd|none", IL_OPTION_VALUE, LOFTERS | MATCH,
      NULL, "how slices are matched: deformed, or as they lie", set_matcher },
    { 0, "lattice", NULL, IL_OPTION_SWITCH, CONVERT | MATCH | MESH,
      NULL, "pair records hold the lattices too, for plots", set_lattice },
    { 0, "groups", "stack|slab", IL_OPTION_VALUE, CONVERT | MESH,
      NULL, "OBJ: a group for each stack (default) or slab", set_groups },
    { 0, "strict", NULL, IL_OPTION_SWITCH, STREAMS,
      "fail (3) where input was repaired or skipped", "fail (3) where input was repaired or skipped", set_strict },
    { 0, "max-line", "BYTES", IL_OPTION_VALUE, READERS | MATCH | MESH | CHECK | PLOT,
      NULL, "longest line that is read (default: 67108864)", set_max_line },
    { 0, "max-depth", "N", IL_OPTION_VALUE, READERS,
      NULL, "deepest nesting that is read (default: 1000)", set_max_depth },
    { 0, "max-points", "N", IL_OPTION_VALUE, READERS | MATCH | MESH | CHECK | PLOT,
      NULL, "most vertices in one stack (default: 500000000)", set_max_points },
    { 0, "threads", "N", IL_OPTION_VALUE, ALL,
      "default: all processors; same bytes for any", "default: all processors; same bytes for any", set_threads },
    { 0, "json", "FILE", IL_OPTION_MAYBE, ALL,
      "account of the run, to FILE or stderr", "account of the run: FILE, or last on stderr", set_json },
    { 0, "progress", "WHEN", IL_OPTION_MAYBE, ALL,
      NULL, "auto (on a terminal), always, never", set_progress },
    { 'q', "quiet", NULL, IL_OPTION_SWITCH, ALL,
      NULL, "errors only", set_quiet },
    { 'v', "verbose", NULL, IL_OPTION_SWITCH, ALL,
      "say more; -q, --quiet: errors only", "say more", set_verbose },
    { 0, "formats", NULL, IL_OPTION_ACTION, ALL, NULL, "list the formats", set_formats },
    { 'h', "help", NULL, IL_OPTION_ACTION, ALL, NULL, "this text", set_help },
    { 0, "version", NULL, IL_OPTION_ACTION, ALL, NULL, "the version", set_version },
    { 0, NULL, NULL, IL_OPTION_ACTION, 0, NULL, NULL, NULL }
};

/* ---- the command line ---------------------------------------------------- */

void il_options_init(il_options *o)
{
    *o = (il_options){ .action = IL_ACTION_RUN, .verb = IL_VERB_CONVERT, .cap = IL_CAP_FLAT,
                       .matcher = IL_MATCHER_FFD, .progress = IL_WHEN_AUTO };
    o->read = (il_read_options)IL_READ_OPTIONS_INIT;
}

void il_options_free(il_options *o)
{
    il_free(o->input);
    il_free(o->pattern);
    il_options_init(o);
}

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
        if (strcmp(word, verb_names[v]) == 0) {
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
        return il_fail(err, IL_E_USAGE, 0, "'%s' writes contours, not %s", verb_names[o->verb], o->to->name);
    if (o->verb == IL_VERB_MESH && !o->to->mesh_new)
        return il_fail(err, IL_E_USAGE, 0, "'mesh' writes a mesh, not %s", o->to->name);
    return IL_OK;
}

/* Two outputs of one run must not be one file. */
static il_status check_outputs_differ(const il_options *o, il_error *err)
{
    bool writes = o->verb != IL_VERB_INFO && o->verb != IL_VERB_CHECK && !o->list;
    const char *path[3] = { o->output || !writes ? o->output : "-", o->pairs, o->json_path };
    for (int i = 0; i < 3; i++)
        for (int k = i + 1; k < 3; k++)
            if (path[i] && path[k] && strcmp(path[i], path[k]) == 0)
                return il_fail(err, IL_E_USAGE, 0, "two outputs cannot both go to '%.100s'", path[i]);
    return IL_OK;
}

static il_status check_inputs(const il_options *o, il_error *err)
{
    bool one = o->verb == IL_VERB_MATCH || o->verb == IL_VERB_MESH || o->verb == IL_VERB_CHECK || o->verb == IL_VERB_PLOT;
    if (one && o->n_inputs > 1)
        return il_fail(err, IL_E_USAGE, 0, "'%s' takes one file", verb_names[o->verb]);
    size_t n_dashes = 0;
    for (size_t k = 0; k < o->n_inputs; k++) {
        if (!*o->input[k])
            return il_fail(err, IL_E_USAGE, 0, "an input's name is empty");
        n_dashes += strcmp(o->input[k], "-") == 0;
    }
    return n_dashes <= 1 ? IL_OK : il_fail(err, IL_E_USAGE, 0, "standard input (-) can be read once only");
}

static il_status check_list(const il_options *o, il_error *err)
{
    if (o->list && (o->output || o->pairs))
        return il_fail(err, IL_E_USAGE, 0, "--list writes its table alone, to standard output, and takes no --%s",
                       o->output ? "output" : "pairs");
    return IL_OK;
}

/* What can only be told when all of the line is known. */
static il_status check_together(il_options *o, il_error *err)
{
    for (const il_option *p = il_option_table; p->name; p++)
        if ((o->given >> (p - il_option_table) & 1) && !(p->verbs >> o->verb & 1))
            return il_fail(err, IL_E_USAGE, 0, "'%s' has no option --%s (isoloft %s --help lists them)",
                           verb_names[o->verb], p->name, verb_names[o->verb]);
    il_status st = check_inputs(o, err);
    if (st == IL_OK)
        st = check_list(o, err);
    if (st == IL_OK)
        st = settle_format(o, err);
    return st == IL_OK ? check_outputs_differ(o, err) : st;
}

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
