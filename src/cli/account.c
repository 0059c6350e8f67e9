#include "config.h"
#include "cli/account.h"
#include "base/alloc.h"
#include "base/text.h"
#include "cli/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static il_stack_account *current(il_account *a)
{
    return &a->stack[a->n - 1];
}

static void stack_account_free(il_stack_account *s)
{
    il_free(s->name);
    il_free(s->type);
    il_free(s->algorithm);
    il_free(s->frame_uid);
    il_free(s->file);
    il_free(s->error);
    il_free(s->gap);
    il_link_facts_free(&s->links);
    il_terrain_free(&s->terrain);
    il_report_free(&s->report);
}

/* ---- a record is opened -------------------------------------------------- */

/* Null for slices across z, whatever way x and y go. */
static const char *words_of_planes(const il_stack_head *h)
{
    const double *c = h->frame + 9;
    if (!h->has_frame || (c[0] == 0 && c[1] == 0))
        return NULL;
    return c[1] == 0 && c[2] == 0 ? "across x" : c[0] == 0 && c[2] == 0 ? "across y" : "tilted";
}

/* Null stays null. */
static bool copy_attribute(char **to, const il_stack_head *head, const char *key)
{
    const char *value = il_stack_head_attribute(head, key);
    *to = value ? il_strndup(value, strlen(value)) : NULL;
    return *to || !value;
}

static il_status open_record(il_account *a, const il_stack_head *head, il_error *err)
{
    if (!il_grow(&a->stack, &a->cap, a->n + 1, sizeof *a->stack))
        return il_fail_nomem(err);
    const char *name = il_stack_head_name(head);
    il_stack_account s = { .has_number = head->has_number, .has_color = head->has_color, .number = head->number,
                           .unit = head->unit, .set_spacing = head->usual_spacing, .planes = words_of_planes(head),
                           .is_terrain = head->kind == IL_KIND_TERRAIN,
                           .box = { INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY },
                           .report = IL_REPORT_INIT };
    memcpy(s.color, head->color, sizeof s.color);
    s.name = il_strndup(name, strlen(name));
    bool ok = s.name && copy_attribute(&s.type, head, "RTROIInterpretedType") &&
              copy_attribute(&s.algorithm, head, "ROIGenerationAlgorithm") &&
              copy_attribute(&s.frame_uid, head, "FrameOfReferenceUID");
    if (!ok || (s.is_terrain && il_terrain_begin(&s.terrain, head, err) != IL_OK)) {
        stack_account_free(&s);
        return il_fail_nomem(err);
    }
    a->stack[a->n++] = s;
    a->began = a->began > 0 ? a->began : il_clock_seconds();
    a->in_stack = true;
    a->skipping = false;
    a->inserted_slices = a->inserted_rings = a->inserted_points = 0;
    il_slicing_clear(&a->slicing);
    const char *note = s.is_terrain ? a->options.note_on_terrain : a->options.note_on_solids;
    if (note)
        il_report_note(&a->report, "%s", note);
    return IL_OK;
}

static void widen(double box[6], double x, double y, double z)
{
    const double p[3] = { x, y, z };
    for (int k = 0; k < 3; k++) {
        box[k] = fmin(box[k], p[k]);
        box[k + 3] = fmax(box[k + 3], p[k]);
    }
}

static il_status count_slice(il_account *a, const il_slice *slice, il_error *err)
{
    il_stack_account *s = current(a);
    bool counts = s->is_terrain || !il_slice_is_inserted(slice);
    s->slices++;
    s->rings += slice->n;
    for (size_t i = 0; i < slice->n; i++) {
        const il_ring *r = &slice->ring[i];
        s->points += r->n;
        for (size_t k = 0; k < r->n; k++)
            widen(s->box, r->xy[2 * k], r->xy[2 * k + 1], slice->z);
    }
    if (!counts) {
        a->inserted_slices++;
        a->inserted_rings += slice->n;
        a->inserted_points += il_slice_points(slice);
    }
    if (!s->is_terrain)
        il_sections_slice(&s->sections, slice, counts);
    il_status st = s->is_terrain ? il_terrain_slice(&s->terrain, slice, err) : IL_OK;
    return st == IL_OK ? il_slicing_slice(&a->slicing, slice->z, counts, err) : st;
}

/* ---- a record is closed -------------------------------------------------- */

/* What is told of the contours is told of the input's, unless there are none. */
static void leave_out_inserted(il_account *a)
{
    il_stack_account *s = current(a);
    if (s->slices <= a->inserted_slices)
        return;
    s->slices -= a->inserted_slices;
    s->rings -= a->inserted_rings;
    s->points -= a->inserted_points;
}

static il_status find_gaps(il_account *a, il_error *err)
{
    const il_slicing *h = &a->slicing;
    il_stack_account *s = current(a);
    il_status st = il_spacing_measure(&s->spacing, h->z, h->n, err);
    if (st == IL_OK && s->is_terrain)
        st = il_terrain_settle(&s->terrain, &s->spacing, err);
    for (size_t k = 1; k < h->n && st == IL_OK && !s->is_terrain; k++) {
        if (!h->gap_below[k] && !il_spacing_is_gap(&s->spacing, h->z[k - 1], h->z[k]))
            continue;
        if (!il_grow(&s->gap, &s->cap_gaps, s->n_gaps + 1, sizeof *s->gap))
            return il_fail_nomem(err);
        s->gap[s->n_gaps++] = (il_gap){ h->z[k - 1], h->z[k], h->gap_below[k] };
    }
    return st;
}

/* Rounding cleans again what is clean: what it finds is new, but for the
 * pinches, which it finds again. */
static void merge_rounding(il_report *r, il_report *rounding)
{
    for (int k = 0; k < IL_N_REPAIRS; k++) {
        size_t n = rounding->repair[k];
        r->repair[k] = k == IL_REPAIR_PINCH ? (n > r->repair[k] ? n : r->repair[k]) : r->repair[k] + n;
    }
    r->largest_move = fmax(r->largest_move, rounding->largest_move);
    il_report_free(rounding);
}

static il_status close_record(il_account *a, il_error *err)
{
    il_stack_account *s = current(a);
    a->in_stack = a->skipping = false;
    merge_rounding(&a->report, &a->rounding);
    s->seconds = il_clock_seconds() - a->began;
    a->began = 0;
    s->report = a->report;
    a->report = (il_report)IL_REPORT_INIT;
    s->links = a->links;
    a->links = (il_link_facts)IL_LINK_FACTS_INIT;
    const char *file = s->status == IL_OK && a->options.file_of ? a->options.file_of(a->options.file_of_self) : NULL;
    if (file && !(s->file = il_strndup(file, strlen(file))))
        return il_fail_nomem(err);
    leave_out_inserted(a);
    return find_gaps(a, err);
}

static void fail_record(il_account *a, il_status st, const il_error *err)
{
    il_stack_account *s = current(a);
    char text[sizeof err->text + sizeof err->path + sizeof err->file + 32];
    il_error_message(err, text, sizeof text);
    s->status = st;
    s->has_mesh = false;
    s->error = il_strndup(text, strlen(text));
    if (st > a->worst)
        a->worst = st;
}

/* What a stage behind the tap answered.  A stack that has no surface, is not as
 * strict asks, or has not what is asked of it (a pair to draw), is told and
 * dropped where the others shall go on. */
static il_status settle(il_account *a, il_status st, il_error *err)
{
    if (st == IL_OK)
        return st;
    il_error_set_file(err, a->options.input);
    if (!a->options.keep_going || (st != IL_E_SURFACE && st != IL_E_INPUT && st != IL_E_USAGE))
        return st;
    fail_record(a, st, err);
    il_message_error(a->options.voice, err);
    il_error_clear(err);
    a->skipping = true;
    return IL_OK;
}

static il_status check_strict(const il_account *a, il_error *err)
{
    if (!a->options.strict || !il_report_any(&a->report))
        return IL_OK;
    size_t repairs = 0;
    for (int k = 0; k < IL_N_REPAIRS; k++)
        repairs += a->report.repair[k];
    return il_fail(err, IL_E_INPUT, 0, "stack '%.80s': %zu repairs and %zu skipped parts, which --strict refuses",
                   a->stack[a->n - 1].name, repairs, a->report.n_skipped);
}

static il_account *of_meshes(il_mesh_sink *self)
{
    return (il_account *)(void *)((char *)self - offsetof(il_account, meshes));
}

/* The writer is told once that a stack is given up, whoever says so first. */
static void on_mesh_abandon(il_mesh_sink *self)
{
    il_account *a = of_meshes(self);
    if (a->in_mesh)
        a->next_mesh->abandon(a->next_mesh);
    a->in_mesh = false;
}

/* ---- the tap among the contours ------------------------------------------ */

static il_account *of_contours(il_sink *self)
{
    return (il_account *)(void *)((char *)self - offsetof(il_account, contours));
}

static il_status begin_stack(il_account *a, const il_stack_head *head, il_error *err)
{
    il_status st = il_stack_head_refuse_fault(head, err);
    return st == IL_OK ? a->next->stack_begin(a->next, head, err) : st;
}

static il_status on_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    il_account *a = of_contours(self);
    il_status st = open_record(a, head, err);
    return st == IL_OK ? settle(a, begin_stack(a, head, err), err) : st;
}

static il_status on_slice(il_sink *self, il_slice *slice, il_error *err)
{
    il_account *a = of_contours(self);
    il_status st = count_slice(a, slice, err);
    if (st != IL_OK || a->skipping)
        return st;
    il_progress_show(a->options.voice, current(a)->name, current(a)->slices, 0);
    return settle(a, a->next->slice(a->next, slice, err), err);
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    il_account *a = of_contours(self);
    il_sections_pair(&current(a)->sections, pair);
    if (pair->gap)
        il_slicing_gap(&a->slicing);
    return a->skipping ? IL_OK : settle(a, a->next->pair(a->next, pair, err), err);
}

/* A stack without contours has no surface, and takes none from the others. */
static il_status leave_out_empty(il_account *a, il_error *err)
{
    il_status st = check_strict(a, err);
    if (st == IL_OK)
        il_report_note(&a->report, il_report_any(&a->report) ? "nothing is left of its contours, so there is nothing to write of it"
                                                             : "it has no contours, so there is nothing to write of it");
    on_mesh_abandon(&a->meshes);
    return st;
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    il_account *a = of_contours(self);
    il_status st = IL_OK;
    if (a->next_mesh && current(a)->points == 0 && !a->skipping) {
        st = settle(a, leave_out_empty(a, err), err);
    } else if (!a->skipping) {
        st = a->next_mesh ? IL_OK : check_strict(a, err);
        if (st == IL_OK)
            st = a->next->stack_end(a->next, err);
        st = settle(a, st, err);
    }
    return st == IL_OK ? close_record(a, err) : st;
}

static il_status on_end(il_sink *self, il_error *err)
{
    il_account *a = of_contours(self);
    if (a->n == 0 && !a->options.empty_allowed)
        return il_fail(err, IL_E_INPUT, 0, "there are no contours, so there is nothing to write");
    return a->next->end(a->next, err);
}

/* ---- the tap among the meshes -------------------------------------------- */

/* Whoever prints takes the numbers of STL for mm, so those that are not are told. */
static void note_unit(il_account *a, il_unit u)
{
    bool prints = u == IL_UNIT_MM || u == IL_UNIT_CM || u == IL_UNIT_IN;
    if (a->options.no_unit && current(a)->is_terrain && !prints)
        il_report_note(&a->report, "STL has no unit: lengths are in %s; --fit 150mm makes a model to print", il_unit_name(u));
}

/* Where the mesh of a map was put, if its frame or its heights did not stay. */
static void take_placement(il_account *a, const il_stack_head *head)
{
    il_stack_account *s = current(a);
    s->frame = a->options.frame;
    s->law = a->options.law;
    s->mesh_unit = head->unit;
    s->placement = (il_placement){ { 0, 0, 0 }, { 1, 1, 1 }, s->unit };
    if (head->has_placement)
        s->placement = head->placement;
}

static il_status on_mesh_begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    il_account *a = of_meshes(self);
    a->in_mesh = true;
    if (a->in_stack) {
        take_placement(a, head);
        note_unit(a, head->unit);
    }
    return a->next_mesh->begin(a->next_mesh, head, err);
}

static il_status on_mesh_piece(il_mesh_sink *self, const il_mesh *piece, il_error *err)
{
    il_account *a = of_meshes(self);
    return a->next_mesh->piece(a->next_mesh, piece, err);
}

static il_status on_mesh_end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    il_account *a = of_meshes(self);
    il_status st = check_strict(a, err);
    if (st != IL_OK) {
        on_mesh_abandon(self);
        return st;
    }
    st = a->next_mesh->end(a->next_mesh, facts, err);
    a->in_mesh = false;
    if (st == IL_OK && a->in_stack) {
        current(a)->facts = *facts;
        current(a)->has_mesh = true;
        a->n_triangles += facts->triangles;
    }
    return st;
}

static il_status on_mesh_finish(il_mesh_sink *self, il_error *err)
{
    il_account *a = of_meshes(self);
    if (a->n_triangles == 0 && a->worst == IL_OK && !a->options.empty_allowed)
        return il_fail(err, IL_E_INPUT, 0, "the contours bound no solid, so there is nothing to write");
    return a->next_mesh->finish(a->next_mesh, err);
}

/* ---- the account --------------------------------------------------------- */

void il_account_init(il_account *a, const il_account_options *o)
{
    *a = (il_account){ .contours = { on_stack_begin, on_slice, on_pair, on_stack_end, on_end },
                       .meshes = { on_mesh_begin, on_mesh_piece, on_mesh_end, on_mesh_abandon, on_mesh_finish },
                       .options = *o, .report = IL_REPORT_INIT, .rounding = IL_REPORT_INIT };
}

void il_account_free(il_account *a)
{
    for (size_t k = 0; k < a->n; k++)
        stack_account_free(&a->stack[k]);
    il_free(a->stack);
    il_slicing_free(&a->slicing);
    il_link_facts_free(&a->links);
    il_report_free(&a->report);
    il_report_free(&a->rounding);
    a->stack = NULL;
    a->n = a->cap = 0;
}

double il_stack_account_slice_sum(const il_stack_account *s)
{
    double spacing = s->spacing.usual > 0 ? s->spacing.usual : s->set_spacing;
    return s->points == 0 ? 0 : spacing > 0 ? s->sections.areas * spacing : NAN;
}

il_sink *il_account_contours(il_account *a, il_sink *next)
{
    a->next = next;
    return &a->contours;
}

il_mesh_sink *il_account_meshes(il_account *a, il_mesh_sink *next)
{
    a->next_mesh = next;
    return &a->meshes;
}

void il_account_close(il_account *a, il_status st, const il_error *err)
{
    if (st > a->worst)
        a->worst = st;
    if (!a->in_stack)
        return;
    if (!current(a)->error)
        fail_record(a, st, err);
    il_error ignored = IL_ERROR_INIT;
    close_record(a, &ignored);
}

void il_account_progress(void *self, size_t slabs_done)
{
    il_account *a = self;
    if (a->in_stack)
        il_progress_show(a->options.voice, current(a)->name, current(a)->slices, slabs_done);
}
