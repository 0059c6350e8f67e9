#include "config.h"
#include "input/rt-stacks.h"
#include "base/alloc.h"
#include "base/sort.h"
#include "input/rt-levels.h"
#include "input/rt-plane.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A contour's points may lie this share of the spacing apart across its plane,
 * and where there is no spacing, this far, mm. */
static const double FLAT_SHARE = 0.1, FLAT_MM = 0.2;

/* Moves below this, mm, are rounding of oblique planes and not told. */
static const double MOVE_LEAST = 1e-6;

/* Where a contour lies along the normal of its ROI's plane. */
typedef struct lie {
    double level, spread;
    size_t contour;
} lie;

/* The planes of an ROI and their usual distance, 0 when there is one. */
typedef struct view {
    il_rt_plane plane;
    double spacing;
} view;

/* view: of each ROI; usual: the median of their spacings, 0 when none has one.
 * lie, level: of the contours of the ROI at hand. */
typedef struct emission {
    const char *file;
    il_sink *sink;
    il_report *report;
    il_unit unit;
    view *view;
    double usual;
    lie *lie;           size_t n_lies, cap_lies;
    double *level;      size_t cap_levels;
    double *scratch;    size_t cap_scratch;
} emission;

static int compare_lies(const void *a, const void *b)
{
    const lie *p = a, *q = b;
    if (p->level != q->level)
        return p->level < q->level ? -1 : 1;
    return p->contour < q->contour ? -1 : p->contour > q->contour;
}

/* ---- planes and spacing ------------------------------------------------------------ */

static bool make_room(emission *e, size_t n)
{
    return il_grow(&e->lie, &e->cap_lies, n, sizeof *e->lie) && il_grow(&e->level, &e->cap_levels, n, sizeof *e->level) &&
           il_grow(&e->scratch, &e->cap_scratch, n, sizeof *e->scratch);
}

/* e->level[0..n_lies): the levels of e->lie. */
static void copy_levels(emission *e)
{
    for (size_t i = 0; i < e->n_lies; i++)
        e->level[i] = e->lie[i].level;
}

/* All contours of R that are plane within FLAT by rising level; the others are
 * counted in REPORT. */
static il_status sort_contours(emission *e, const il_rt_roi *r, const il_rt_plane *plane, double flat,
                               il_report *report, il_error *err)
{
    if (!make_room(e, r->n + 1)) /* one more, so that there is something to sort */
        return il_fail_nomem(err);
    e->n_lies = 0;
    for (size_t i = 0; i < r->n; i++) {
        lie l = { 0, 0, i };
        l.level = il_rt_plane_level(plane, &r->contour[i], &l.spread);
        if (l.spread <= flat)
            e->lie[e->n_lies++] = l;
        else
            il_report_skip(report, e->file, r->contour[i].line, "contour", "it lies across the planes of its ROI's contours");
    }
    qsort(e->lie, e->n_lies, sizeof *e->lie, compare_lies);
    copy_levels(e);
    return IL_OK;
}

/* Contours that lie across the planes are left out of the spacing. */
static il_status find_view(emission *e, const il_rt_roi *r, view *v, il_error *err)
{
    v->plane = il_rt_plane_fit(r->contour, r->n, 2 * FLAT_MM);
    il_status st = sort_contours(e, r, &v->plane, 2 * FLAT_MM, NULL, err);
    if (st == IL_OK)
        v->spacing = il_rt_levels_spacing(e->level, e->n_lies, e->scratch);
    return st;
}

static il_status find_views(emission *e, const il_rt_roi *roi, size_t n, il_error *err)
{
    double *spacing = il_alloc(n, sizeof *spacing);
    size_t many = 0;
    e->view = il_alloc(n, sizeof *e->view);
    il_status st = spacing && e->view ? IL_OK : il_fail_nomem(err);
    for (size_t k = 0; k < n && st == IL_OK; k++) {
        st = find_view(e, &roi[k], &e->view[k], err);
        if (st == IL_OK && e->view[k].spacing > 0)
            spacing[many++] = e->view[k].spacing;
    }
    if (st == IL_OK && many > 0) {
        il_sort_doubles(spacing, many);
        e->usual = spacing[many / 2];
    }
    il_free(spacing);
    return st;
}

/* ---- slices -------------------------------------------------------------------------- */

static int compare_points(const il_rt_contour *c, const il_rt_contour *d)
{
    if (c->n != d->n)
        return c->n < d->n ? -1 : 1;
    for (size_t k = 0; k < 2 * c->n; k++)
        if (c->p[k] != d->p[k])
            return c->p[k] < d->p[k] ? -1 : 1;
    return 0;
}

/* Equal ones in their order in the file: both are of one array. */
static int compare_contours(const void *a, const void *b)
{
    const il_rt_contour *c = *(il_rt_contour *const *)a, *d = *(il_rt_contour *const *)b;
    int order = compare_points(c, d);
    return order != 0 ? order : (c > d) - (c < d);
}

/* What is covered twice by XOR is not covered: of equal contours of that type
 * two and two cancel.  (Equal contours of the plain type are one given twice.)
 * C[0..N) are of one slice and kept alike. */
static il_status cancel_xor_pairs(emission *e, il_rt_roi *r, il_rt_layout layout, const lie *l, size_t n, il_error *err)
{
    size_t many = 0;
    for (size_t i = 0; i < n; i++)
        many += r->contour[l[i].contour].is_xor && r->contour[l[i].contour].layout == layout;
    if (many < 2 || layout == IL_RT_OBLIQUE)
        return IL_OK;
    il_rt_contour **c = il_alloc(many, sizeof *c);
    if (!c)
        return il_fail_nomem(err);
    many = 0;
    for (size_t i = 0; i < n; i++)
        if (r->contour[l[i].contour].is_xor && r->contour[l[i].contour].layout == layout)
            c[many++] = &r->contour[l[i].contour];
    qsort(c, many, sizeof *c, compare_contours);
    for (size_t i = 1; i < many; i++) {
        if (compare_points(c[i - 1], c[i]) != 0)
            continue;
        il_rt_contour_free(c[i - 1]);
        il_rt_contour_free(c[i]);
        il_report_repair(e->report, IL_REPAIR_XOR_PAIR, 1);
        i++;
    }
    il_free(c);
    return IL_OK;
}

/* The contour of L as a ring of S, whose plane it is moved onto. */
static il_status add_ring(emission *e, il_slice *s, il_rt_roi *r, const il_rt_plane *plane, const lie *l, il_error *err)
{
    il_rt_contour *c = &r->contour[l->contour];
    size_t n = c->n;
    if (n == 0)
        return IL_OK; /* cancelled */
    il_ring *ring = il_slice_add_ring(s);
    if (!ring)
        return il_fail_nomem(err);
    ring->line = c->line;
    ring->xy = il_rt_plane_flatten(plane, c);
    ring->n = ring->cap = n;
    double move = fabs(l->level - s->z) + l->spread / 2;
    if (l->spread > MOVE_LEAST)
        il_report_repair(e->report, IL_REPAIR_FLATTENED_POINT, n);
    if (fabs(l->level - s->z) > MOVE_LEAST)
        il_report_repair(e->report, IL_REPAIR_MOVED_CONTOUR, 1);
    if (move > MOVE_LEAST && e->report && move > e->report->largest_move)
        e->report->largest_move = move;
    return IL_OK;
}

static il_status emit_slice(emission *e, il_rt_roi *r, const il_rt_plane *plane, size_t begin, size_t end, il_error *err)
{
    il_slice s = IL_SLICE_INIT;
    s.z = il_rt_levels_height(e->level + begin, end - begin);
    s.line = r->contour[e->lie[begin].contour].line;
    il_status st = cancel_xor_pairs(e, r, plane->layout, e->lie + begin, end - begin, err);
    for (size_t i = begin; i < end && st == IL_OK; i++)
        st = add_ring(e, &s, r, plane, &e->lie[i], err);
    if (st == IL_OK && s.n > 0)
        st = e->sink->slice(e->sink, &s, err);
    il_slice_free(&s);
    return st;
}

/* ---- stacks ---------------------------------------------------------------------------- */

/* The ROI's words under the names that DICOM has for them. */
static bool add_attribute(il_stack_head *h, const char *key, const char *value)
{
    return !value || il_stack_head_add_attribute(h, key, value);
}

static il_status fill_head(const emission *e, const il_rt_roi *r, const il_rt_plane *plane, il_stack_head *h, il_error *err)
{
    const char *name = r->name ? r->name : "", *fault = r->fault;
    h->unit = e->unit;
    h->line = r->line;
    h->has_number = r->has_number;
    h->number = r->number;
    h->has_color = r->has_color;
    memcpy(h->color, r->color, sizeof h->color);
    h->usual_spacing = e->usual;
    h->fault_line = r->fault_line;
    if (plane->layout != IL_RT_ACROSS_Z) {
        h->has_frame = true;
        memcpy(h->frame + 3, plane->a, sizeof plane->a);
        memcpy(h->frame + 6, plane->b, sizeof plane->b);
        memcpy(h->frame + 9, plane->c, sizeof plane->c);
    }
    bool ok = il_stack_head_set_name(h, name, strlen(name)) && add_attribute(h, "RTROIInterpretedType", r->type) &&
              add_attribute(h, "ROIGenerationAlgorithm", r->algorithm) &&
              add_attribute(h, "FrameOfReferenceUID", r->frame_uid) &&
              (!fault || (h->fault = il_strndup(fault, strlen(fault))));
    return ok ? IL_OK : il_fail_nomem(err);
}

static il_status emit_slices(emission *e, il_rt_roi *r, const il_rt_plane *plane, double spacing, il_error *err)
{
    il_status st = IL_OK;
    for (size_t begin = 0, end; begin < e->n_lies && st == IL_OK; begin = end) {
        end = il_rt_levels_slice(e->level, e->n_lies, begin, spacing);
        st = emit_slice(e, r, plane, begin, end, err);
    }
    return st;
}

/* Without any spacing planes a tenth of a millimetre apart are one. */
static il_status emit_stack(emission *e, il_rt_roi *r, const view *v, il_error *err)
{
    il_stack_head head = IL_STACK_HEAD_INIT;
    double spacing = v->spacing > 0 ? v->spacing : e->usual, flat = spacing > 0 ? FLAT_SHARE * spacing : FLAT_MM;
    il_report_merge(e->report, &r->report);
    il_status st = sort_contours(e, r, &v->plane, flat, e->report, err);
    if (st == IL_OK)
        st = fill_head(e, r, &v->plane, &head, err);
    if (st == IL_OK)
        st = e->sink->stack_begin(e->sink, &head, err);
    if (st == IL_OK && !r->fault)
        st = emit_slices(e, r, &v->plane, spacing > 0 ? spacing : 1, err);
    if (st == IL_OK)
        st = e->sink->stack_end(e->sink, err);
    il_stack_head_free(&head);
    il_rt_roi_free(r);
    return st;
}

il_status il_rt_stacks_emit(il_rt_roi *roi, size_t n, const char *file, const il_read_options *options,
                            il_sink *sink, il_report *report, il_error *err)
{
    emission e = { .file = file, .sink = sink, .report = report,
                   .unit = options->has_unit ? options->unit : IL_UNIT_MM };
    il_status st = find_views(&e, roi, n, err);
    for (size_t k = 0; k < n && st == IL_OK; k++)
        st = emit_stack(&e, &roi[k], &e.view[k], err);
    il_free(e.view);
    il_free(e.lie);
    il_free(e.level);
    il_free(e.scratch);
    return st;
}
