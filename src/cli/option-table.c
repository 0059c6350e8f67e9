/* option-table.c - what options there are, and what each does to il_options. */
#include "config.h"
#include "cli/options.h"
#include "base/alloc.h"
#include "base/number.h"
#include "model/rescale.h"

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

static il_status set_links(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return set_path(&o->links, value, "--links", err);
}

static il_status set_links_out(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return set_path(&o->links_out, value, "--links-out", err);
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
    static const char *const words[] = { [IL_CAP_FLAT] = "flat", [IL_CAP_DOME] = "dome", [IL_CAP_AUTO] = "auto" };
    for (size_t k = 0; k < sizeof words / sizeof *words; k++)
        if (strcmp(value, words[k]) == 0) {
            o->cap = (il_cap)k;
            return IL_OK;
        }
    return il_fail(err, IL_E_USAGE, 0, "--cap is flat, dome or auto, not '%.40s'", value);
}

static il_status set_between(il_options *o, const char *value, bool on, il_error *err)
{
    size_t n = 0;
    o->between = IL_BETWEEN_AUTO;
    if (on && strcmp(value, "auto") == 0)
        return IL_OK;
    if (on && parse_count(value, 0, IL_BETWEEN_MOST, &n, "--between", NULL) != IL_OK)
        return il_fail(err, IL_E_USAGE, 0, "--between is auto or a whole number from 0 to %d, not '%.40s'", IL_BETWEEN_MOST, value);
    o->between = (int)n;
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

/* The index of VALUE among the N WORDS into *K; LIST names them for the refusal. */
static il_status parse_word(const char *value, const char *const *words, int n, int *k, const char *option,
                            const char *list, il_error *err)
{
    for (*k = 0; *k < n; ++*k)
        if (strcmp(value, words[*k]) == 0)
            return IL_OK;
    return il_fail(err, IL_E_USAGE, 0, "%s is %s, not '%.40s'", option, list, value);
}

static il_status set_height(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return set_path(&o->read.map.height, value, "--height", err);
}

static il_status set_depth(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->read.map.depth = on ? IL_DEPTH_DOWN : IL_DEPTH_UP;
    return IL_OK;
}

static il_status set_z_unit(il_options *o, const char *value, bool on, il_error *err)
{
    o->read.map.has_z_unit = on;
    il_status st = parse_unit(value, &o->read.map.z_unit, err);
    if (st == IL_OK && !(il_unit_metres(o->read.map.z_unit) > 0))
        st = il_fail(err, IL_E_USAGE, 0, "--z-unit needs a unit of length, not '%.40s'", value);
    return st;
}

static il_status set_project(il_options *o, const char *value, bool on, il_error *err)
{
    static const char *const words[] = {
        [IL_PROJECT_AUTO] = "auto", [IL_PROJECT_UTM] = "utm", [IL_PROJECT_TM] = "tm", [IL_PROJECT_NONE] = "none" };
    int k = on ? IL_PROJECT_AUTO : IL_PROJECT_NONE;
    il_status st = value ? parse_word(value, words, 4, &k, "--project", "auto, utm, tm or none", err) : IL_OK;
    o->read.map.project = (il_project)k;
    return st;
}

static il_status set_high(il_options *o, const char *value, bool on, il_error *err)
{
    static const char *const words[] = { "left", "right" };
    int k = 0;
    (void)on;
    il_status st = parse_word(value, words, 2, &k, "--high", "left or right", err);
    o->read.map.high = k == 0 ? IL_SIDE_LEFT : IL_SIDE_RIGHT;
    return st;
}

static il_status add_layer(il_options *o, const char *value, bool on, il_error *err)
{
    il_map_options *m = &o->read.map;
    (void)on;
    if (!il_grow(&m->layer, &m->cap_layers, m->n_layers + 1, sizeof *m->layer))
        return il_fail_nomem(err);
    m->layer[m->n_layers++] = value;
    return IL_OK;
}

static il_status set_join(il_options *o, const char *value, bool on, il_error *err)
{
    o->join = 0;
    return on && strcmp(value, "0") != 0 ? parse_length(value, &o->join, "--join", err) : IL_OK;
}

/* Files of these names are ./bbox and ./hull. */
static il_status set_frame(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    bool bbox = strcmp(value, "bbox") == 0, hull = strcmp(value, "hull") == 0;
    if (strcmp(value, "-") == 0 || !*value)
        return il_fail(err, IL_E_USAGE, 0, "--frame takes bbox, hull or the name of a file");
    o->relief.frame.kind = bbox ? IL_FRAME_BBOX : hull ? IL_FRAME_HULL : IL_FRAME_OUTLINE;
    o->frame_file = bbox || hull ? NULL : value;
    return IL_OK;
}

static il_status set_law(il_options *o, const char *value, bool on, il_error *err)
{
    static const char *const names[] = { "mean", "plate", "straight" };
    (void)on;
    for (int k = 0; k < 3; k++)
        if (strcmp(value, names[k]) == 0) {
            o->relief.law.kind = (il_law_kind)k;
            return IL_OK;
        }
    return il_fail(err, IL_E_USAGE, 0, "--law is mean, plate or straight, not '%.40s'", value);
}

static il_status set_spread(il_options *o, const char *value, bool on, il_error *err)
{
    size_t n = strlen(value);
    double *spread = &o->relief.law.spread;
    (void)on;
    o->relief.law.has_spread = strcmp(value, "auto") != 0;
    if (!o->relief.law.has_spread || (n > 0 && il_number_parse(value, n, spread) == n && *spread >= 0 && *spread <= 10))
        return IL_OK;
    return il_fail(err, IL_E_USAGE, 0, "--spread is auto or a number from 0 to 10, not '%.40s'", value);
}

/* More than an interval is no detail: all ground lies inside its band. */
static il_status set_detail(il_options *o, const char *value, bool on, il_error *err)
{
    size_t n = on ? strlen(value) : 0;
    double *detail = &o->relief.detail;
    o->relief.has_detail = true;
    *detail = 0;
    if (!on || (n > 0 && il_number_parse(value, n, detail) == n && *detail >= 0 && *detail <= 1))
        return IL_OK;
    return il_fail(err, IL_E_USAGE, 0, "--detail takes a part of an interval from 0 to 1, not '%.40s'", value);
}

static il_status set_solid(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->relief.placement.solid = on;
    return IL_OK;
}

static il_status set_base(il_options *o, const char *value, bool on, il_error *err)
{
    size_t n = strlen(value);
    double *base = &o->relief.placement.base;
    o->relief.placement.has_base = on;
    if (n > 0 && il_number_parse(value, n, base) == n && *base > -1e15 && *base < 1e15)
        return IL_OK;
    return il_fail(err, IL_E_USAGE, 0, "--base takes a height, not '%.40s'", value);
}

static il_status set_z_scale(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    return parse_length(value, &o->relief.placement.z_scale, "--z-scale", err);
}

/* A length with its unit right behind it, mm without one. */
static il_status set_fit(il_options *o, const char *value, bool on, il_error *err)
{
    (void)on;
    double length = 0;
    il_unit unit = IL_UNIT_MM;
    size_t n = strlen(value), used = il_number_parse(value, n, &length);
    bool is_unit = used == n || (il_unit_parse(value + used, n - used, &unit) && il_unit_metres(unit) > 0);
    if (used == 0 || !is_unit || !(length > 0 && length < 1e15))
        return il_fail(err, IL_E_USAGE, 0, "--fit takes a length such as 150mm, 15cm or 6in, not '%.40s'", value);
    o->relief.placement.fit = il_rescale_length(length, unit, IL_UNIT_MM);
    return IL_OK;
}

static il_status set_recentre(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    (void)err;
    o->relief.placement.recentre = on;
    return IL_OK;
}

static il_status set_pieces(il_options *o, const char *value, bool on, il_error *err)
{
    if (on && strcmp(value, "few") != 0 && strcmp(value, "overlap") != 0)
        return il_fail(err, IL_E_USAGE, 0, "--pieces is few or overlap, not '%.40s'", value);
    o->pieces = !on ? IL_PIECES_USUAL : strcmp(value, "few") == 0 ? IL_PIECES_FEW : IL_PIECES_OVERLAP;
    return IL_OK;
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

static il_status set_picture(il_options *o, il_picture what, bool on, il_error *err)
{
    if (on && o->picture.what != IL_PICTURE_AUTO && o->picture.what != what)
        return il_fail(err, IL_E_USAGE, 0, "--slices, --pair and --skeleton are different pictures: give one of them");
    if (on || o->picture.what == what)
        o->picture.what = on ? what : IL_PICTURE_AUTO;
    return IL_OK;
}

static il_status set_slices(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    return set_picture(o, IL_PICTURE_SLICES, on, err);
}

static il_status set_skeleton(il_options *o, const char *value, bool on, il_error *err)
{
    (void)value;
    return set_picture(o, IL_PICTURE_SKELETON, on, err);
}

static il_status set_pair(il_options *o, const char *value, bool on, il_error *err)
{
    il_status st = set_picture(o, IL_PICTURE_PAIR, on, err);
    return st == IL_OK ? parse_count(value, 0, LIMIT_MOST, &o->picture.pair, "--pair", err) : st;
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
    { 0, "skeleton", NULL, IL_OPTION_SWITCH, PLOT,
      NULL, "draw how the whole stack hangs together", set_skeleton },
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
      NULL, "distance of slices that state no height", set_spacing },
    { 0, "flip", NULL, IL_OPTION_SWITCH, READERS,
      NULL, "SVG: y points down and is turned up (default)", set_flip },
    { 0, "flatness", "D", IL_OPTION_VALUE, READERS,
      NULL, "distance of a flattened curve from the true one", set_flatness },
    { 0, "keyhole", "D", IL_OPTION_VALUE_OR_NO, READERS,
      NULL, "how far the sides of a keyhole are apart; 0: off", set_keyhole },
    { 0, "height", "NAME", IL_OPTION_VALUE, READERS,
      NULL, "maps: attribute with the heights, or z", set_height },
    { 0, "depth", NULL, IL_OPTION_SWITCH, READERS,
      NULL, "maps: heights are depths, positive down", set_depth },
    { 0, "z-unit", "U", IL_OPTION_VALUE, READERS,
      NULL, "maps: unit of the heights, m or ft; else found", set_z_unit },
    { 0, "project", "HOW", IL_OPTION_VALUE_OR_NO, READERS,
      NULL, "maps: degrees to metres by auto, utm, tm, none", set_project },
    { 0, "layer", "PATTERN", IL_OPTION_VALUE, READERS,
      NULL, "DXF: only layers that match; '!PATTERN': not", add_layer },
    { 0, "high", "left|right", IL_OPTION_VALUE, READERS | MESH,
      NULL, "maps of one level: the higher side of its lines", set_high },
    { 0, "join", "D", IL_OPTION_VALUE_OR_NO, STREAMS,
      NULL, "maps: join ends no farther apart; else 0", set_join },
    { 0, "frame", "FILE", IL_OPTION_VALUE, LOFTERS,
      NULL, "maps: where they end: bbox, hull or an outline", set_frame },
    { 0, "law", "NAME", IL_OPTION_VALUE, LOFTERS,
      NULL, "maps: ground as mean (default), plate, straight", set_law },
    { 0, "spread", "K|auto", IL_OPTION_VALUE, LOFTERS,
      NULL, "maps: how far it strays from a plate; 0: not", set_spread },
    { 0, "detail", "TOL", IL_OPTION_VALUE_OR_NO, LOFTERS,
      NULL, "maps: how near to its law, in intervals: 0.05", set_detail },
    { 0, "solid", NULL, IL_OPTION_SWITCH, LOFTERS,
      "maps: a closed solid; --fit 150mm: to print", "maps: a closed solid, with walls and a floor", set_solid },
    { 0, "base", "H", IL_OPTION_VALUE, LOFTERS,
      NULL, "maps: height of the solid's floor, on the map", set_base },
    { 0, "z-scale", "F", IL_OPTION_VALUE, LOFTERS,
      NULL, "maps: heights are exaggerated F times", set_z_scale },
    { 0, "fit", "LENGTH", IL_OPTION_VALUE, LOFTERS,
      NULL, "maps: scaled to a longer side of 150mm, 6in ...", set_fit },
    { 0, "recentre", NULL, IL_OPTION_SWITCH, LOFTERS,
      NULL, "maps: the middle goes to 0, 0; default for STL", set_recentre },
    { 0, "cap", "flat|dome|auto", IL_OPTION_VALUE, LOFTERS,
      "how the first and last slice are closed", "how first and last slice are closed; else flat", set_cap },
    { 0, "between", "N|auto", IL_OPTION_VALUE_OR_NO, LOFTERS,
      NULL, "contours in each slab; of maps: with -t loft", set_between },
    { 0, "gap", "bridge|cap|fail", IL_OPTION_VALUE, STREAMS,
      NULL, "what missing slices leave: joined or closed", set_gap },
    { 0, "thickness", "T", IL_OPTION_VALUE, STREAMS,
      NULL, "of single slices, input's unit; else a spacing", set_thickness },
    { 0, "matcher", "ffd|none", IL_OPTION_VALUE, LOFTERS | MATCH,
      NULL, "how slices are matched: deformed, or as they lie", set_matcher },
    { 0, "pieces", "few|overlap", IL_OPTION_VALUE_OR_NO, LOFTERS | MATCH | PLOT,
      NULL, "link across gaps: far, for vessels, or never", set_pieces },
    { 0, "links", "FILE", IL_OPTION_VALUE, LOFTERS | MATCH | PLOT,
      NULL, "rings belong together as FILE says", set_links },
    { 0, "links-out", "FILE", IL_OPTION_VALUE, CONVERT | MATCH | MESH,
      NULL, "also write which rings belong together", set_links_out },
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
