#include "config.h"
#include "cli/frame-file.h"
#include "base/alloc.h"
#include "cli/nowhere.h"
#include "region/clean.h"

#include <string.h>

void il_frame_file_free(il_frame_file *o)
{
    il_slice_free(&o->rings);
    il_free(o->crs);
    *o = (il_frame_file)IL_FRAME_FILE_INIT;
}

/* ---- rings of a file -------------------------------------------------------------- */

typedef struct gatherer {
    il_sink sink;
    il_frame_file *outline;
    il_report *report;
    const char *file;
    size_t n_stacks;
} gatherer;

static il_status take_head(il_sink *self, const il_stack_head *head, il_error *err)
{
    gatherer *g = (gatherer *)self;
    il_frame_file *o = g->outline;
    if (g->n_stacks++ > 0)
        return head->unit == o->unit ? IL_OK : il_fail(err, IL_E_INPUT, head->line, "its stacks are in different units");
    o->unit = head->unit;
    o->crs = head->crs ? il_strndup(head->crs, strlen(head->crs)) : NULL;
    o->is_labelled = o->crs || head->unit == IL_UNIT_DEG;
    return head->crs && !o->crs ? il_fail_nomem(err) : IL_OK;
}

static il_status take_slice(il_sink *self, il_slice *s, il_error *err)
{
    gatherer *g = (gatherer *)self;
    for (size_t k = 0; k < s->n; k++) {
        if (s->ring[k].open) {
            il_report_skip(g->report, g->file, s->ring[k].line, "line", "is not closed: no outline");
            continue;
        }
        il_ring *r = il_slice_add_ring(&g->outline->rings);
        if (!r)
            return il_fail_nomem(err);
        *r = s->ring[k];
        s->ring[k] = (il_ring)IL_RING_INIT;
    }
    return IL_OK;
}

static il_status read_rings(gatherer *g, const il_read_options *read, il_error *err)
{
    il_source *source;
    const il_reader *r = NULL;
    il_status st = il_source_open(&source, g->file, err);
    if (st != IL_OK)
        return st;
    st = il_reader_detect(source, &r, err);
    if (st == IL_OK && !r->is_map && r != &il_reader_loft)
        st = il_fail(err, IL_E_INPUT, 0, "is %s, which has no outlines of maps", r->name);
    il_read_options o = *read;
    o.map = (il_map_options){ .project = IL_PROJECT_NONE, .outline = true };
    if (st == IL_OK) {
        g->outline->native = r == &il_reader_loft;
        o.has_unit = read->has_unit && r->is_map;
        st = r->read(&source, 1, &o, &g->sink, g->report, err);
    }
    il_source_close(source);
    return st;
}

/* Directions and the order of rings mean nothing here; what is mended is told. */
static il_status clean(il_frame_file *o, il_report *report, il_error *err)
{
    const il_clean_options options = { 0 };
    il_report own = IL_REPORT_INIT;
    il_status st = il_slice_clean(&o->rings, &options, &own, NULL, err);
    size_t n = own.repair[IL_REPAIR_CROSSING] + own.repair[IL_REPAIR_TOUCH] + own.repair[IL_REPAIR_KEYHOLE_EDGE];
    if (st == IL_OK && n > 0)
        il_report_note(report, "the outline crosses or touches itself at %zu place%s: what lies in an odd number of its rings is the map",
                       n, n == 1 ? "" : "s");
    il_report_free(&own);
    if (st == IL_OK && o->rings.n == 0)
        st = il_fail(err, IL_E_INPUT, 0, "its outline encloses nothing");
    return st;
}

il_status il_frame_file_read(il_frame_file *o, const char *file, const il_read_options *read, il_report *report, il_error *err)
{
    *o = (il_frame_file)IL_FRAME_FILE_INIT;
    gatherer g = { il_nowhere_contours(), o, report, file, 0 };
    g.sink.stack_begin = take_head;
    g.sink.slice = take_slice;
    il_status st = read_rings(&g, read, err);
    if (st == IL_OK)
        st = clean(o, report, err);
    if (st != IL_OK) {
        il_error_set_file(err, file);
        il_frame_file_free(o);
    }
    return st;
}

il_frame_options il_frame_file_frame(const il_frame_file *o)
{
    return (il_frame_options){ .kind = IL_FRAME_OUTLINE, .outline = &o->rings, .in_degrees = o->unit == IL_UNIT_DEG,
                               .may_be_degrees = !o->is_labelled && !o->native, .has_unit = o->native, .unit = o->unit };
}

/* ---- coordinate systems ------------------------------------------------------------- */

typedef struct guard {
    il_sink sink;
    il_sink *next;
    const il_frame_file *outline;
} guard;

/* An outline in degrees is brought into the system of the map; others must be in it. */
static il_status guard_head(il_sink *self, const il_stack_head *head, il_error *err)
{
    guard *g = (guard *)self;
    il_crs own, map;
    il_crs_parse(g->outline->crs, &own);
    il_crs_parse(head->crs, &map);
    if (g->outline->unit != IL_UNIT_DEG && !il_crs_agree(&own, &map))
        return il_fail(err, IL_E_INPUT, head->line, "the map is in %.80s, and its outline in %.80s: "
                       "ogr2ogr -t_srs brings one into the system of the other", head->crs, g->outline->crs);
    return g->next->stack_begin(g->next, head, err);
}

static il_status guard_slice(il_sink *self, il_slice *s, il_error *err)
{
    guard *g = (guard *)self;
    return g->next->slice(g->next, s, err);
}

static il_status guard_pair(il_sink *self, il_pair *p, il_error *err)
{
    guard *g = (guard *)self;
    return g->next->pair(g->next, p, err);
}

static il_status guard_stack_end(il_sink *self, il_error *err)
{
    guard *g = (guard *)self;
    return g->next->stack_end(g->next, err);
}

static il_status guard_end(il_sink *self, il_error *err)
{
    guard *g = (guard *)self;
    return g->next->end(g->next, err);
}

il_status il_frame_file_guard_new(il_sink **out, const il_frame_file *o, il_sink *next, il_error *err)
{
    guard *g = il_calloc(1, sizeof *g);
    *out = g ? &g->sink : NULL;
    if (!g)
        return il_fail_nomem(err);
    *g = (guard){ { guard_head, guard_slice, guard_pair, guard_stack_end, guard_end }, next, o };
    return IL_OK;
}

void il_frame_file_guard_free(il_sink *s)
{
    il_free(s);
}
