/* isoloft.c - isoloft.h: the stages put together for a caller's program.
 *
 *     reader or arrays > clean > join > [gaps] > [link] > match > survey > [round] > relief or lofter > tally > writer or arrays
 *
 * As in the command, rounding for formats of 32-bit floats is a cleaning stage
 * of its own behind the matching, so that both give the same bytes. */
#include "config.h"
#include "isoloft.h"
#include "api/contours.h"
#include "api/solids.h"
#include "base/alloc.h"
#include "base/output.h"
#include "base/source.h"
#include "base/threads.h"
#include "input/reader.h"
#include "loft/lofter.h"
#include "match/linker.h"
#include "match/matcher.h"
#include "match/refit.h"
#include "match/survey.h"
#include "model/tee.h"
#include "output/writer.h"
#include "region/clean.h"
#include "region/gapper.h"
#include "region/joiner.h"
#include "region/keyhole.h"
#include "terrain/relief.h"

#include <stdio.h>
#include <string.h>

/* More would only wait for each other. */
enum { THREADS_MOST = 256 };

/* Counts the triangles that pass, for a run that makes none has failed. */
typedef struct tally {
    il_mesh_sink sink;
    il_mesh_sink *next;
    size_t triangles;
} tally;

/* Everything that has to be closed again.  first: the stage that is fed. */
typedef struct work {
    const il_from *from;
    const il_to *to;
    il_settings settings;
    il_unit unit;
    il_source **source;
    size_t n_sources;
    const il_reader *reader;
    const il_writer *writer;    /* null when arrays are wanted */
    il_output *output;
    il_mesh_sink *mesh_writer;
    il_solids_sink solids;
    tally tally;
    il_sink *lofter, *relief, *rounder, *survey, *survey_tee, *matcher, *linker, *gapper, *joiner, *cleaner, *first;
    il_link_facts links;
    il_refit *refit;
    il_report report, rounding;
} work;

/* ---- what the call asks for ------------------------------------------------ */

static il_status check_call(work *w, il_error *err)
{
    const il_from *f = w->from;
    const il_to *t = w->to;
    if ((f->path != NULL) + (f->data != NULL) + (f->contour != NULL) != 1)
        return il_fail(err, IL_E_USAGE, 0, "give one of path, data and contour to read from");
    if ((t->path != NULL) + (t->bytes != NULL) + (t->solids != NULL) != 1)
        return il_fail(err, IL_E_USAGE, 0, "give one of path, bytes and solids to write to");
    if ((t->bytes && t->bytes->data) || (t->solids && t->solids->solid))
        return il_fail(err, IL_E_USAGE, 0, "what is to be filled must be empty");
    if (f->unit && !il_unit_parse(f->unit, strlen(f->unit), &w->unit))
        return il_fail(err, IL_E_USAGE, 0, "unknown unit '%.40s'", f->unit);
    if (!(f->spacing >= 0 && f->spacing < 1e15))
        return il_fail(err, IL_E_USAGE, 0, "the spacing must be positive, or 0 for none");
    if (!(w->settings.thickness >= 0 && w->settings.thickness < 1e15))
        return il_fail(err, IL_E_USAGE, 0, "the thickness must be positive, or 0 for none");
    const il_map_settings *m = &w->settings.map;
    if (!(m->fit >= 0 && m->fit < 1e15) || !(m->z_scale >= 0 && m->z_scale < 1e15) || !(m->base > -1e15 && m->base < 1e15))
        return il_fail(err, IL_E_USAGE, 0, "fit and z_scale of maps must be positive, or 0 for none, and base a height");
    if ((unsigned)m->law > IL_GROUND_STRAIGHT || !(m->spread >= 0 && m->spread <= 10))
        return il_fail(err, IL_E_USAGE, 0, "the ground of maps follows no such law");
    if (!(m->detail <= 1))
        return il_fail(err, IL_E_USAGE, 0, "detail of maps must be a part of an interval, 1 at most");
    if (w->settings.between < -1 || w->settings.between > IL_BETWEEN_MOST)
        return il_fail(err, IL_E_USAGE, 0, "between is from -1 to %d, not %d", IL_BETWEEN_MOST, w->settings.between);
    if ((unsigned)w->settings.gaps > IL_GAPS_FAIL)
        return il_fail(err, IL_E_USAGE, 0, "gaps are treated in no way number %d", (int)w->settings.gaps);
    if ((unsigned)w->settings.pieces > IL_PIECES_OVERLAP)
        return il_fail(err, IL_E_USAGE, 0, "pieces are linked in no way number %d", (int)w->settings.pieces);
    return IL_OK;
}

static il_status choose_formats(work *w, il_error *err)
{
    const char *from = w->from->format, *to = w->to->format;
    w->reader = from ? il_reader_named(from) : NULL;
    if (from && !w->reader)
        return il_fail(err, IL_E_USAGE, 0, "unknown input format '%.40s'", from);
    if (w->to->solids)
        return to ? il_fail(err, IL_E_USAGE, 0, "arrays have no format") : IL_OK;
    if (to)
        w->writer = il_writer_named(to);
    else if (w->to->path)
        w->writer = il_writer_for_path(w->to->path);
    if (!to && !w->writer)
        w->writer = &il_writer_stl;
    if (!w->writer || !w->writer->mesh_new)
        return il_fail(err, IL_E_USAGE, 0, "'%.40s' is no format for meshes", to ? to : w->writer->name);
    return IL_OK;
}

/* ---- input ------------------------------------------------------------------ */

static il_status open_sources(work *w, il_error *err)
{
    const il_from *f = w->from;
    if (f->contour)
        return IL_OK;
    size_t n = f->data ? 1 : f->n_paths;
    w->source = il_calloc(n, sizeof *w->source);
    if (!w->source)
        return il_fail_nomem(err);
    for (; w->n_sources < n; w->n_sources++) {
        il_source **s = &w->source[w->n_sources];
        il_status st = f->data ? il_source_from_memory(s, f->data, f->size, "", err)
                               : il_source_open(s, f->path[w->n_sources], err);
        if (st != IL_OK)
            return st;
    }
    if (!w->reader && n > 0)
        return il_reader_detect(w->source[0], &w->reader, err);
    return n > 0 ? IL_OK : il_fail(err, IL_E_USAGE, 0, "no path is given to read from");
}

static int threads_of(const il_settings *s)
{
    int n = s->threads > 0 ? s->threads : il_threads_available();
    return n < THREADS_MOST ? n : THREADS_MOST;
}

static il_status feed(work *w, il_error *err)
{
    const il_from *f = w->from;
    if (f->contour)
        return il_contours_send(f->contour, f->n_contours, w->unit, w->first, err);
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.has_unit = f->unit != NULL;
    o.unit = w->unit;
    o.has_spacing = f->spacing > 0;
    o.spacing = f->spacing;
    o.threads = threads_of(&w->settings);
    return w->reader->read(w->source, w->n_sources, &o, w->first, &w->report, err);
}

/* ---- output ----------------------------------------------------------------- */

static il_status open_output(work *w, il_error *err)
{
    if (!w->writer) {
        il_solids_sink_init(&w->solids, w->to->solids);
        w->tally.next = &w->solids.sink;
        return IL_OK;
    }
    il_status st = w->to->path ? il_output_open(&w->output, w->to->path, err) : il_output_to_memory(&w->output, err);
    static const char *const comments[] = { "made by isoloft " PACKAGE_VERSION, NULL };
    il_write_options o = { .comment = comments };
    if (st == IL_OK)
        st = w->writer->mesh_new(&w->mesh_writer, w->output, &o, err);
    w->tally.next = w->mesh_writer;
    return st;
}

static il_status copy_bytes(const il_output *o, il_blob *to, il_error *err)
{
    size_t n;
    const unsigned char *data = il_output_memory(o, &n);
    to->data = il_alloc(n, 1);
    if (!to->data)
        return il_fail_nomem(err);
    memcpy(to->data, data, n);
    to->size = n;
    return IL_OK;
}

static il_status commit(work *w, il_error *err)
{
    if (w->tally.triangles == 0)
        return il_fail(err, IL_E_INPUT, 0, "there are no contours, so there is nothing to write");
    if (!w->writer)
        return IL_OK;
    il_status st = w->to->bytes ? il_output_status(w->output, err) : IL_OK;
    if (st == IL_OK && w->to->bytes)
        return copy_bytes(w->output, w->to->bytes, err);
    il_output *o = w->output;
    w->output = NULL;
    return st == IL_OK ? il_output_commit(o, err) : st;
}

/* ---- stages ----------------------------------------------------------------- */

static il_status tally_begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    il_mesh_sink *next = ((tally *)self)->next;
    return next->begin(next, head, err);
}

static il_status tally_piece(il_mesh_sink *self, const il_mesh *m, il_error *err)
{
    il_mesh_sink *next = ((tally *)self)->next;
    return next->piece(next, m, err);
}

static il_status tally_end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    tally *t = (tally *)self;
    t->triangles += facts->triangles;
    return t->next->end(t->next, facts, err);
}

static void tally_abandon(il_mesh_sink *self)
{
    il_mesh_sink *next = ((tally *)self)->next;
    next->abandon(next);
}

static il_status tally_finish(il_mesh_sink *self, il_error *err)
{
    il_mesh_sink *next = ((tally *)self)->next;
    return next->finish(next, err);
}

static il_status build_lofter(work *w, bool rounds, il_error *err)
{
    il_loft_options o = IL_LOFT_OPTIONS_INIT;
    o.threads = threads_of(&w->settings);
    o.cap = w->settings.dome == 2 ? IL_CAP_AUTO : w->settings.dome ? IL_CAP_DOME : IL_CAP_FLAT;
    o.between = w->settings.between == 0 ? IL_BETWEEN_AUTO : w->settings.between < 0 ? 0 : w->settings.between;
    o.round_float = rounds;
    w->tally.sink = (il_mesh_sink){ tally_begin, tally_piece, tally_end, tally_abandon, tally_finish };
    return il_lofter_new(&w->lofter, &o, &w->tally.sink, err);
}

static il_status build_relief(work *w, bool rounds, il_error *err)
{
    const il_map_settings *m = &w->settings.map;
    il_relief_options o = { .frame.kind = m->hull ? IL_FRAME_HULL : IL_FRAME_BBOX, .has_detail = m->detail != 0,
                            .detail = m->detail > 0 ? m->detail : 0 };
    o.placement = (il_placement_options){ .fit = m->fit, .z_scale = m->z_scale > 0 ? m->z_scale : 1,
                                          .recentre = m->recentre > 0 || (m->recentre == 0 && rounds), .solid = m->solid,
                                          .has_base = m->has_base, .round_float = rounds, .base = m->base };
    o.law = (il_law_options){ (il_law_kind)m->law, m->spread > 0, m->spread };
    il_status st = il_relief_new(&w->relief, &o, &w->tally.sink, w->lofter, &w->report, err);
    if (st == IL_OK)
        il_lofter_number_by(w->lofter, il_relief_stack(w->relief));
    return st;
}

/* From here on w->first is the stage that the one built next is to call. */
static il_status build_rounder(work *w, bool rounds, il_error *err)
{
    const il_clean_options rounded = { .round_float = true };
    w->first = w->relief;
    if (!rounds)
        return IL_OK;
    il_status st = il_refit_new(&w->refit, w->first, err);
    if (st == IL_OK)
        st = il_cleaner_new(&w->rounder, &rounded, il_refit_behind(w->refit), &w->rounding, err);
    if (st == IL_OK)
        w->first = il_refit_before(w->refit, w->rounder);
    return st;
}

static il_status build_matcher(work *w, il_error *err)
{
    il_match_options m = IL_MATCH_OPTIONS_INIT;
    m.matcher = w->settings.unmatched ? IL_MATCHER_NONE : IL_MATCHER_FFD;
    m.threads = threads_of(&w->settings);
    bool hints = !w->settings.unmatched && w->settings.pieces == IL_PIECES_USUAL;
    il_status st = il_survey_new(&w->survey, hints, &w->links, &w->report, err);
    if (st == IL_OK)
        st = il_tee_new(&w->survey_tee, w->survey, w->first, err);
    if (st == IL_OK)
        st = il_matcher_new(&w->matcher, &m, w->survey_tee, err);
    w->first = w->matcher;
    return st;
}

static il_status build_linker(work *w, il_error *err)
{
    if (w->settings.unmatched || w->settings.pieces == IL_PIECES_OVERLAP)
        return IL_OK; /* the matcher links what overlaps itself */
    il_linkage_options o = il_linkage_options_for(w->settings.pieces);
    il_status st = il_linker_new(&w->linker, &o, NULL, w->first, &w->report, err);
    w->first = w->linker;
    return st;
}

static il_status build_gapper(work *w, il_error *err)
{
    il_gap_options g = { .mode = w->settings.gaps, .thickness = w->settings.thickness };
    if (!il_gap_options_settle(&g, w->reader && w->reader->is_patient))
        return IL_OK;
    il_status st = il_gapper_new(&w->gapper, &g, w->first, &w->report, err);
    w->first = w->gapper;
    return st;
}

static il_status build_cleaner(work *w, il_error *err)
{
    const il_join_options ends_meet = { 0 };
    bool is_set = w->reader && w->reader->is_patient;
    il_clean_options as_is = { .keyhole = is_set ? IL_KEYHOLE_MM : 0, .keyhole_is_mm = true };
    il_status st = il_joiner_new(&w->joiner, &ends_meet, w->first, &w->report, err);
    if (st == IL_OK)
        st = il_cleaner_new(&w->cleaner, &as_is, w->joiner, &w->report, err);
    w->first = w->cleaner;
    return st;
}

/* Last to first, for a stage is given the next one. */
static il_status build_stages(work *w, il_error *err)
{
    bool rounds = w->writer && w->writer->round_float;
    il_status st = build_lofter(w, rounds, err);
    if (st == IL_OK)
        st = build_relief(w, rounds, err);
    if (st == IL_OK)
        st = build_rounder(w, rounds, err);
    if (st == IL_OK)
        st = build_matcher(w, err);
    if (st == IL_OK)
        st = build_linker(w, err);
    if (st == IL_OK)
        st = build_gapper(w, err);
    return st == IL_OK ? build_cleaner(w, err) : st;
}

static void free_work(work *w)
{
    il_cleaner_free(w->cleaner);
    il_joiner_free(w->joiner);
    il_gapper_free(w->gapper);
    il_linker_free(w->linker);
    if (w->matcher)
        il_matcher_free(w->matcher);
    il_tee_free(w->survey_tee);
    il_survey_free(w->survey);
    il_link_facts_free(&w->links);
    il_cleaner_free(w->rounder);
    il_refit_free(w->refit);
    il_relief_free(w->relief);
    if (w->lofter)
        il_lofter_free(w->lofter);
    if (w->mesh_writer)
        w->writer->mesh_free(w->mesh_writer);
    il_solids_sink_free(&w->solids);
    il_output_discard(w->output);
    for (size_t k = 0; k < w->n_sources; k++)
        il_source_close(w->source[k]);
    il_free(w->source);
    il_report_free(&w->report);
    il_report_free(&w->rounding);
}

/* ---- the account ------------------------------------------------------------ */

static void tell_skips(const il_settings *s, const il_report *r)
{
    char text[512];
    for (size_t i = 0; i < r->n_skips; i++) {
        const il_skip *k = &r->skip[i];
        snprintf(text, sizeof text, "%.200s:%ld: skipped %.100s: %.120s (%zu)", k->file ? k->file : "", k->line,
                 k->what ? k->what : "", k->why ? k->why : "", k->count);
        s->note(s->note_self, text);
    }
}

static void tell(const il_settings *s, const il_report *r)
{
    char text[512];
    if (!s->note)
        return;
    for (size_t i = 0; i < r->n_notes; i++)
        s->note(s->note_self, r->note[i]);
    tell_skips(s, r);
    for (int i = 0; i < IL_N_REPAIRS; i++)
        if (r->repair[i] > 0) {
            snprintf(text, sizeof text, "repaired: %s (%zu)", il_repair_words((il_repair)i), r->repair[i]);
            s->note(s->note_self, text);
        }
}

/* ---- isoloft.h -------------------------------------------------------------- */

static il_status run(work *w, il_error *err)
{
    static il_status (*const steps[])(work *, il_error *) = {
        check_call, choose_formats, open_sources, open_output, build_stages, feed, commit };
    il_status st = IL_OK;
    for (size_t k = 0; k < sizeof steps / sizeof *steps && st == IL_OK; k++)
        st = steps[k](w, err);
    return st;
}

il_status il_loft(const il_from *from, const il_to *to, const il_settings *settings, il_error *err)
{
    il_error unseen;
    if (!err)
        err = &unseen;
    il_error_clear(err);
    work w = { .from = from, .to = to, .unit = IL_UNIT_MM, .report = IL_REPORT_INIT, .rounding = IL_REPORT_INIT };
    if (settings)
        w.settings = *settings;
    il_status st = run(&w, err);
    if (st != IL_OK && st != IL_E_USAGE && to->solids)
        il_solids_free(to->solids);
    tell(&w.settings, &w.report);
    tell(&w.settings, &w.rounding);
    free_work(&w);
    return st;
}

void il_blob_free(il_blob *b)
{
    il_free(b->data);
    *b = (il_blob)IL_BLOB_INIT;
}

const char *il_version(void)
{
    return PACKAGE_VERSION;
}
