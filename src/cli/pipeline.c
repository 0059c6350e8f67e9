#include "config.h"
#include "cli/pipeline.h"
#include "base/alloc.h"
#include "base/threads.h"
#include "cli/destination.h"
#include "cli/index.h"
#include "cli/nowhere.h"
#include "cli/frame-file.h"
#include "cli/progress.h"
#include "cli/select.h"
#include "cli/stopwatch.h"
#include "input/links-file.h"
#include "match/linker.h"
#include "match/matcher.h"
#include "match/refit.h"
#include "match/survey.h"
#include "match/unlinked.h"
#include "model/ras.h"
#include "model/rescale.h"
#include "model/tee.h"
#include "output/links.h"
#include "region/clean.h"
#include "region/joiner.h"
#include "region/keyhole.h"
#include "region/measure.h"
#include "terrain/isolines.h"

#include <string.h>
#include <sys/resource.h>

/* Everything that has to be closed again.  first: the stage the reader calls. */
typedef struct pipeline {
    const il_options *options;
    const il_plan *plan;
    il_account *account;
    il_source **source;
    size_t n_sources;
    const il_reader *reader;
    il_destination *destination;
    il_output *pairs, *links_out;
    il_given given;
    il_sink *pairs_writer, *links_writer, *lofter, *relief, *isolines, *rounder, *tee, *links_tee, *survey, *survey_tee, *matcher, *linker;
    il_sink *unlinked, *gapper, *measure, *joiner, *cleaner, *ras, *rescaler;
    il_sink *select, *guard, *first;
    il_frame_file outline;
    il_refit *refit;
    il_sink nowhere;
    il_mesh_sink nowhere_mesh;
    il_stopwatch stopwatch;
} pipeline;

/* ---- input --------------------------------------------------------------- */

/* Each input is open from the start, for the reader takes them as one set. */
static void allow_open_files(size_t n)
{
    struct rlimit limit;
    if (n < 200 || getrlimit(RLIMIT_NOFILE, &limit) != 0)
        return;
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
}

static il_status open_sources(pipeline *p, il_error *err)
{
    static const char *const standard_input[] = { "-" };
    const il_options *o = p->options;
    const char *const *name = o->n_inputs > 0 ? o->input : standard_input;
    size_t n = o->n_inputs > 0 ? o->n_inputs : 1;
    p->source = il_calloc(n, sizeof *p->source);
    if (!p->source)
        return il_fail_nomem(err);
    allow_open_files(n);
    for (; p->n_sources < n; p->n_sources++) {
        il_status st = il_source_open(&p->source[p->n_sources], name[p->n_sources], err);
        if (st != IL_OK)
            return st;
    }
    return IL_OK;
}

static il_status find_reader(pipeline *p, il_error *err)
{
    p->reader = p->options->from;
    for (size_t k = 0; k < p->n_sources && !p->options->from; k++) {
        const il_reader *r = NULL;
        il_status st = il_reader_detect(p->source[k], &r, err);
        if (st == IL_OK && p->reader && r->read != p->reader->read)
            st = il_fail(err, IL_E_INPUT, 0, "is %s, and '%.100s' is %s: a run takes inputs of one format",
                         r->name, il_source_name(p->source[0]), p->reader->name);
        if (st != IL_OK) {
            il_error_set_file(err, il_source_name(p->source[k]));
            return st;
        }
        p->reader = r;
    }
    return IL_OK;
}

/* Options that say what isolines mean, and what they are for: maps of any format, or
 * one format. */
static const struct { const char *option, *what, *format; bool any_map; } meanings[] = {
    { "height", "maps", NULL, true },
    { "depth", "maps", NULL, true },
    { "z-unit", "maps", NULL, true },
    { "project", "maps", NULL, true },
    { "high", "isolines", "loft", true },
    { "layer", "DXF drawings", "dxf", false },
    { "join", "isolines", "loft", true },
    { "frame", "isolines", "loft", true },
    { "law", "isolines", "loft", true },
    { "spread", "isolines", "loft", true },
    { "detail", "isolines", "loft", true },
    { "solid", "isolines", "loft", true },
    { "base", "isolines", "loft", true },
    { "z-scale", "isolines", "loft", true },
    { "fit", "isolines", "loft", true },
    { "recentre", "isolines", "loft", true },
};

static il_status check_meanings(const pipeline *p, il_error *err)
{
    const il_reader *r = p->reader;
    if (p->options->ras && !r->is_patient)
        return il_fail(err, IL_E_USAGE, 0, "is %s; --ras is for DICOM structure sets, whose coordinates are LPS", r->name);
    for (size_t k = 0; k < sizeof meanings / sizeof *meanings; k++) {
        bool fits = (meanings[k].any_map && r->is_map) || (meanings[k].format && strcmp(meanings[k].format, r->name) == 0);
        if (il_options_given(p->options, meanings[k].option) && !fits)
            return il_fail(err, IL_E_USAGE, 0, "is %s; --%s is for %s", r->name, meanings[k].option, meanings[k].what);
    }
    return IL_OK;
}

/* Is it one for what is to be done? */
static il_status check_reader(const pipeline *p, il_error *err)
{
    il_status st = check_meanings(p, err);
    if (st == IL_OK && p->plan->native_only && p->reader != &il_reader_loft)
        st = il_fail(err, IL_E_INPUT, 0, "is %s; '%s' takes the native format, which 'isoloft read' makes of it",
                     p->reader->name, il_verb_name(p->options->verb));
    if (st != IL_OK)
        il_error_set_file(err, il_source_name(p->source[0]));
    return st;
}

/* ---- output -------------------------------------------------------------- */

static const char *const comments[] = { "made by isoloft " PACKAGE_VERSION, NULL };

static il_status open_outputs(pipeline *p, il_error *err)
{
    const il_options *o = p->options;
    if (p->plan->survey)
        return IL_OK;
    il_write_options w = { comments, o->groups_by_slab, o->picture };
    il_status st = il_destination_open(&p->destination, o->output, o->to, &w, err);
    if (st == IL_OK) {
        p->account->options.file_of = il_destination_take_file;
        p->account->options.file_of_self = p->destination;
    }
    if (st == IL_OK && o->pairs)
        st = il_output_open(&p->pairs, o->pairs, err);
    if (st == IL_OK && p->pairs)
        st = il_writer_loft.contours_new(&p->pairs_writer, p->pairs, err);
    if (st == IL_OK && o->links_out)
        st = il_output_open(&p->links_out, o->links_out, err);
    if (st == IL_OK && p->links_out)
        st = il_links_writer_new(&p->links_writer, p->links_out, &p->account->report, err);
    return st;
}

/* ---- the stages, last to first ------------------------------------------- */

static int threads_of(const il_options *o)
{
    int n = o->threads > 0 ? o->threads : il_threads_available();
    return n < IL_THREADS_MOST ? n : IL_THREADS_MOST;
}

static il_relief_options relief_options(pipeline *p)
{
    il_relief_options r = p->options->relief;
    if (p->options->frame_file)
        r.frame = il_frame_file_frame(&p->outline);
    return r;
}

/* The last stage of solids, and before it that of terrain, which takes its own. */
static il_status build_surfaces(pipeline *p, il_mesh_sink *meshes, il_error *err)
{
    const il_options *o = p->options;
    il_loft_options l = IL_LOFT_OPTIONS_INIT;
    l.threads = threads_of(o);
    l.cap = o->cap;
    l.between = o->between;
    l.round_float = o->to && o->to->round_float;
    l.progress = il_account_progress;
    l.progress_self = p->account;
    il_relief_options r = relief_options(p);
    il_status st = il_lofter_new(&p->lofter, &l, meshes, err);
    if (st == IL_OK)
        st = il_relief_new(&p->relief, &r, meshes, p->lofter, &p->account->report, err);
    if (st == IL_OK)
        il_lofter_number_by(p->lofter, il_relief_stack(p->relief));
    return st;
}

/* What takes terrain looks at an outline too: whether it is one for that map. */
static il_status build_guard(pipeline *p, il_sink *next, il_sink **end, il_error *err)
{
    *end = next;
    if (!p->options->frame_file)
        return IL_OK;
    il_status st = il_frame_file_guard_new(&p->guard, &p->outline, next, err);
    *end = p->guard;
    return st;
}

/* The end of contours: the writer, and before it those that a map gets between its levels. */
static il_status build_contours(pipeline *p, il_sink **end, il_error *err)
{
    *end = p->plan->survey ? &p->nowhere : il_destination_contours(p->destination);
    if (p->options->between <= 0)
        return IL_OK;
    il_relief_options r = relief_options(p);
    il_status st = il_isolines_new(&p->isolines, &r, (size_t)p->options->between, *end, &p->account->report, err);
    return st == IL_OK ? build_guard(p, p->isolines, end, err) : st;
}

static il_status build_end(pipeline *p, il_sink **end, il_error *err)
{
    if (!p->plan->loft)
        return build_contours(p, end, err);
    il_mesh_sink *meshes = p->plan->survey ? &p->nowhere_mesh : il_destination_meshes(p->destination);
    il_status st = build_surfaces(p, il_account_meshes(p->account, meshes), err);
    return st == IL_OK ? build_guard(p, p->relief, end, err) : st;
}

static il_status build_rounder(pipeline *p, il_error *err)
{
    if (!p->plan->loft || !p->options->to || !p->options->to->round_float)
        return IL_OK;
    il_clean_options c = { .round_float = true };
    il_status st = il_refit_new(&p->refit, p->first, err);
    if (st == IL_OK)
        st = il_cleaner_new(&p->rounder, &c, il_refit_behind(p->refit), &p->account->rounding, err);
    p->first = st == IL_OK ? il_refit_before(p->refit, p->rounder) : p->first;
    return st;
}

static il_status build_tee(pipeline *p, il_error *err)
{
    if (!p->pairs_writer)
        return IL_OK;
    il_status st = il_tee_new(&p->tee, p->pairs_writer, p->first, err);
    p->first = st == IL_OK ? p->tee : p->first;
    return st;
}

static il_status build_links_tee(pipeline *p, il_error *err)
{
    if (!p->links_writer)
        return IL_OK;
    il_status st = il_tee_new(&p->links_tee, p->links_writer, p->first, err);
    p->first = st == IL_OK ? p->links_tee : p->first;
    return st;
}

/* Whoever has said how to link needs no hint. */
static il_status build_survey(pipeline *p, il_error *err)
{
    const il_options *o = p->options;
    if (!p->plan->match)
        return IL_OK;
    bool hints = o->matcher != IL_MATCHER_NONE && !il_options_given(o, "pieces") && !o->links;
    il_status st = il_survey_new(&p->survey, hints, &p->account->links, &p->account->report, err);
    if (st == IL_OK)
        st = il_tee_new(&p->survey_tee, p->survey, p->first, err);
    p->first = st == IL_OK ? p->survey_tee : p->first;
    return st;
}

static il_status build_matcher(pipeline *p, il_error *err)
{
    if (!p->plan->match)
        return IL_OK;
    il_match_options m = { p->options->matcher, p->options->keep_lattices, threads_of(p->options) };
    il_status st = il_matcher_new(&p->matcher, &m, p->first, err);
    p->first = st == IL_OK ? p->matcher : p->first;
    return st;
}

static il_status build_linker(pipeline *p, il_error *err)
{
    const il_options *a = p->options;
    bool left = a->matcher == IL_MATCHER_NONE || (a->pieces == IL_PIECES_OVERLAP && !a->links);
    if (!p->plan->link && (!p->plan->match || left))
        return IL_OK; /* the matcher links what overlaps itself */
    il_linkage_options o = il_linkage_options_for(a->pieces);
    il_status st = il_linker_new(&p->linker, &o, a->links ? &p->given : NULL, p->first, &p->account->report, err);
    p->first = st == IL_OK ? p->linker : p->first;
    if (st != IL_OK || !p->plan->link)
        return st;
    st = il_unlinked_new(&p->unlinked, p->first, err);
    p->first = st == IL_OK ? p->unlinked : p->first;
    return st;
}

static il_status build_gapper(pipeline *p, il_error *err)
{
    il_gap_options g = { .mode = p->options->gap, .thickness = p->options->thickness };
    if (p->plan->draw || !il_gap_options_settle(&g, p->reader->is_patient))
        return IL_OK;
    il_status st = il_gapper_new(&p->gapper, &g, p->first, &p->account->report, err);
    p->first = st == IL_OK ? p->gapper : p->first;
    return st;
}

/* Geodesics take longer than reading: for those who ask only. */
static il_status build_measure(pipeline *p, il_error *err)
{
    if (!p->plan->survey)
        return IL_OK;
    il_status st = il_measure_new(&p->measure, p->first, err);
    p->first = st == IL_OK ? p->measure : p->first;
    return st;
}

static il_status build_joiner(pipeline *p, il_error *err)
{
    if (p->plan->draw)
        return IL_OK;
    il_join_options j = { p->options->join };
    il_status st = il_joiner_new(&p->joiner, &j, p->first, &p->account->report, err);
    p->first = st == IL_OK ? p->joiner : p->first;
    return st;
}

static il_status build_cleaner(pipeline *p, il_error *err)
{
    if (p->plan->draw && !p->plan->link)
        return IL_OK;
    il_clean_options c = { .keyhole = p->options->keyhole };
    if (!p->options->has_keyhole && p->reader->is_patient) {
        c.keyhole = IL_KEYHOLE_MM;
        c.keyhole_is_mm = true;
    }
    il_status st = il_cleaner_new(&p->cleaner, &c, p->first, &p->account->report, err);
    p->first = st == IL_OK ? p->cleaner : p->first;
    return st;
}

static il_status build_ras(pipeline *p, il_error *err)
{
    if (!p->options->ras)
        return IL_OK;
    il_status st = il_ras_new(&p->ras, p->first, &p->account->report, err);
    p->first = st == IL_OK ? p->ras : p->first;
    return st;
}

static il_status build_rescaler(pipeline *p, il_error *err)
{
    if (!p->options->convert_unit)
        return IL_OK;
    il_status st = il_rescaler_new(&p->rescaler, p->options->to_unit, p->first, &p->account->report, err);
    p->first = st == IL_OK ? p->rescaler : p->first;
    return st;
}

static il_status build_select(pipeline *p, il_error *err)
{
    const il_options *o = p->options;
    if (o->n_patterns == 0)
        return IL_OK;
    il_status st = il_select_new(&p->select, o->pattern, o->n_patterns, p->first, &p->account->report,
                                  p->account->options.voice, err);
    p->first = st == IL_OK ? p->select : p->first;
    return st;
}

static il_status build_stages(pipeline *p, il_error *err)
{
    static il_status (*const builders[])(pipeline *, il_error *) = {
        build_rounder, build_tee, build_links_tee, build_survey, build_matcher, build_linker, build_gapper, build_measure,
        build_joiner, build_cleaner, build_ras, build_rescaler, build_select };
    il_sink *end = NULL;
    il_status st = build_end(p, &end, err);
    p->first = il_account_contours(p->account, end);
    for (size_t k = 0; k < sizeof builders / sizeof *builders && st == IL_OK; k++)
        st = builders[k](p, err);
    p->first = il_stopwatch_init(&p->stopwatch, p->first, &p->account->began);
    return st;
}

static void free_pipeline(pipeline *p)
{
    il_select_free(p->select);
    il_rescaler_free(p->rescaler);
    il_ras_free(p->ras);
    if (p->cleaner)
        il_cleaner_free(p->cleaner);
    il_joiner_free(p->joiner);
    il_measure_free(p->measure);
    il_gapper_free(p->gapper);
    il_unlinked_free(p->unlinked);
    il_linker_free(p->linker);
    il_matcher_free(p->matcher);
    il_refit_free(p->refit);
    il_tee_free(p->tee);
    il_tee_free(p->links_tee);
    il_tee_free(p->survey_tee);
    il_survey_free(p->survey);
    if (p->rounder)
        il_cleaner_free(p->rounder);
    il_frame_file_guard_free(p->guard);
    il_relief_free(p->relief);
    il_isolines_free(p->isolines);
    il_frame_file_free(&p->outline);
    if (p->lofter)
        il_lofter_free(p->lofter);
    if (p->pairs_writer)
        il_writer_loft.contours_free(p->pairs_writer);
    il_links_writer_free(p->links_writer);
    il_given_free(&p->given);
    il_output_discard(p->pairs);
    il_output_discard(p->links_out);
    il_destination_free(p->destination);
    for (size_t k = 0; k < p->n_sources; k++)
        il_source_close(p->source[k]);
    il_free(p->source);
}

/* ---- the run ------------------------------------------------------------- */

/* *SIDE is what goes beside the output, or null. */
static il_status commit_side(il_output **side, il_error *err)
{
    il_output *o = *side;
    *side = NULL;
    return o ? il_output_commit(o, err) : IL_OK;
}

static il_status commit(pipeline *p, il_error *err)
{
    if (!p->destination)
        return IL_OK;
    il_status st = il_destination_commit(p->destination, err);
    if (st == IL_OK)
        st = commit_side(&p->pairs, err);
    return st == IL_OK ? commit_side(&p->links_out, err) : st;
}

static il_status read_links(pipeline *p, il_error *err)
{
    il_source *source = NULL;
    if (!p->options->links)
        return IL_OK;
    il_status st = il_source_open(&source, p->options->links, err);
    if (st == IL_OK)
        st = il_links_file_read(&p->given, source, p->options->read.max_line, err);
    il_source_close(source);
    return st;
}

/* A name may be misspelt, and what was said of it be missed late. */
static void say_missed(const pipeline *p)
{
    for (size_t k = 0; p->linker && p->options->links && (k = il_linker_missed(p->linker, k)) < p->given.n_stacks; k++)
        il_message_note(p->account->options.voice, "%s:%ld: there is no stack %ld '%.80s'", p->given.file, p->given.stack[k].line,
                        p->given.stack[k].number, p->given.stack[k].name);
}

static il_status run(pipeline *p, il_error *err)
{
    il_read_options read = p->options->read;
    read.threads = threads_of(p->options);
    il_status st = open_sources(p, err);
    if (st == IL_OK)
        st = find_reader(p, err);
    if (st == IL_OK)
        st = check_reader(p, err);
    if (st == IL_OK && p->options->frame_file)
        st = il_frame_file_read(&p->outline, p->options->frame_file, &read, &p->account->report, err);
    if (st == IL_OK)
        st = read_links(p, err);
    if (st == IL_OK)
        st = open_outputs(p, err);
    /* A native stream without stacks is whole, and is handed on as one. */
    p->account->options.empty_allowed = p->plan->survey || (p->reader == &il_reader_loft && !p->plan->loft && !p->plan->draw);
    if (st == IL_OK)
        st = build_stages(p, err);
    if (st == IL_OK)
        st = p->reader->read(p->source, p->n_sources, &read, p->first, &p->account->report, err);
    if (st != IL_OK)
        il_error_set_file(err, p->account->options.input);
    else
        say_missed(p);
    return st == IL_OK ? commit(p, err) : st;
}

typedef struct option_note { const char *option, *note; } option_note;

/* The note on the first of c[n] that was given; null for none. */
static const char *find_note(const il_options *o, const option_note *c, size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (il_options_given(o, c[k].option))
            return c[k].note;
    return NULL;
}

/* What is meant for maps and does nothing to solids, and the other way round. */
static const char *note_on_solids(const il_options *o)
{
    static const option_note c[] = {
        { "frame", "--frame is for terrain, which this is not" },
        { "law", "--law is for terrain, which this is not" }, { "spread", "--spread is for terrain, which this is not" },
        { "detail", "--detail is for terrain, which this is not" },
        { "solid", "--solid is for terrain, which this is not" }, { "z-scale", "--z-scale is for terrain, which this is not" },
        { "fit", "--fit is for terrain, which this is not" }, { "recentre", "--recentre is for terrain, which this is not" },
        { "high", "--high is for terrain, which this is not" } };
    if (o->between > 0 && o->to && !o->to->mesh_new)
        return "--between puts contours of solids into meshes alone, and none into a native stream";
    return find_note(o, c, sizeof c / sizeof *c);
}

static const char *note_on_terrain(const il_options *o)
{
    static const option_note c[] = {
        { "pairs", "terrain has no pairs: --pairs holds its lines alone" },
        { "cap", "--cap is for slices of solids, and terrain has none" }, { "gap", "--gap is for slices of solids, and terrain has none" },
        { "thickness", "--thickness is for slices of solids, and terrain has none" },
        { "matcher", "--matcher is for slices of solids, and terrain has none" } };
    if (o->between > 0 && o->to && o->to->mesh_new)
        return "--between changes no surface of terrain: with -t loft it writes isolines";
    if (o->verb == IL_VERB_MATCH)
        return "terrain has no pairs to match, and is passed on as it is";
    return find_note(o, c, sizeof c / sizeof *c);
}

il_status il_pipeline_run(il_result *result, const il_options *o, const il_plan *plan, il_voice *voice, il_error *err)
{
    double start = il_clock_seconds();
    pipeline p = { .options = o, .plan = plan, .account = &result->account,
                   .outline = IL_FRAME_FILE_INIT, .nowhere = il_nowhere_contours(), .nowhere_mesh = il_nowhere_meshes() };
    bool folder = o->output && il_destination_is_folder(o->output);
    il_account_options a = { .keep_going = plan->survey || folder, .strict = o->strict, .voice = voice,
                             .no_unit = plan->loft && !plan->survey && o->to->round_float,
                             .frame = o->relief.frame.kind, .law = o->relief.law.kind,
                             .note_on_solids = note_on_solids(o), .note_on_terrain = note_on_terrain(o),
                             .input = o->n_inputs == 0 ? "-" : o->n_inputs == 1 ? o->input[0] : NULL };
    il_account_init(&result->account, &a);
    il_status st = run(&p, err);
    il_account_close(&result->account, st, err);
    if (p.destination && il_destination_folder(p.destination)) {
        il_status index = il_index_write(il_destination_folder(p.destination), &result->account, err);
        st = st == IL_OK ? index : st;
    }
    free_pipeline(&p);
    il_progress_clear(voice);
    result->seconds = il_clock_seconds() - start;
    return st == IL_OK ? result->account.worst : st;
}
