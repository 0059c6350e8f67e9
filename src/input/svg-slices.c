#include "config.h"
#include "input/svg-slices.h"
#include "base/alloc.h"
#include "input/svg-join.h"
#include "input/svg-pen.h"

#include <math.h>
#include <stdlib.h>

void il_svg_slices_free(il_svg_slices *s)
{
    for (size_t i = 0; i < s->n; i++)
        il_slice_free(&s->part[i].slice);
    il_free(s->part);
    *s = (il_svg_slices)IL_SVG_SLICES_INIT;
}

/* ---- gathering -------------------------------------------------------------- */

static bool is_same(const il_svg_part *p, const il_svg_level *l, size_t slot, size_t file)
{
    if (p->file != file || p->level.kind != l->kind)
        return false;
    if (l->kind == IL_SVG_LEVEL_NONE)
        return p->slot == slot;
    return p->level.owner == l->owner && p->level.value == l->value;
}

static il_status move_rings(il_slice *to, il_slice *from, il_error *err)
{
    for (size_t i = 0; i < from->n; i++) {
        il_ring *r = il_slice_add_ring(to);
        if (!r)
            return il_fail_nomem(err);
        *r = from->ring[i];
        from->ring[i] = (il_ring)IL_RING_INIT;
    }
    il_slice_free(from);
    return IL_OK;
}

il_status il_svg_slices_add(il_svg_slices *s, const il_svg_level *level, size_t slot, size_t file, long line,
                            il_slice *drawn, il_error *err)
{
    if (s->n == 0 || !is_same(&s->part[s->n - 1], level, slot, file)) {
        if (!il_grow(&s->part, &s->cap, s->n + 1, sizeof *s->part))
            return il_fail_nomem(err);
        s->part[s->n] = (il_svg_part){ *level, slot, file, s->n, line, 0, IL_SLICE_INIT };
        s->part[s->n++].slice.line = line;
    }
    return move_rings(&s->part[s->n - 1].slice, drawn, err);
}

static void flip(il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t v = 0; v < s->ring[i].n; v++)
            s->ring[i].xy[2 * v + 1] = 0.0 - s->ring[i].xy[2 * v + 1]; /* 0, not -0 */
}

/* Slic3r 1.3.0 writes millimetres times 1e-6, some of its relatives write
 * millimetres.  No print is 1 m high and none a micrometre: a file whose
 * heights are all below 0.001 is of the first kind. */
static bool is_in_millionths(const il_svg_slices *s, size_t first)
{
    for (size_t i = first; i < s->n; i++)
        if (s->part[i].level.kind == IL_SVG_LEVEL_SLIC3R && !(fabs(s->part[i].level.raw) < 1e-3))
            return false;
    return true;
}

void il_svg_slices_end_file(il_svg_slices *s, size_t file, const char *name, bool turn, il_report *report)
{
    size_t first = s->n;
    while (first > 0 && s->part[first - 1].file == file)
        first--;
    bool in_millionths = is_in_millionths(s, first);
    if (!in_millionths)
        il_report_note(report, "%.200s: slic3r:z is taken as it stands, not times 1e6, for one is 0.001 or more", name);
    for (size_t i = first; i < s->n; i++) {
        il_svg_level *l = &s->part[i].level;
        if (l->kind == IL_SVG_LEVEL_SLIC3R) {
            l->value = in_millionths ? l->value : l->raw;
            l->kind = IL_SVG_LEVEL_HEIGHT;
        }
        if (turn)
            flip(&s->part[i].slice);
    }
}

/* ---- heights ------------------------------------------------------------------- */

static il_status fail_at(const il_svg_part *p, il_source *const *source, il_error *err, const char *what)
{
    il_status st = il_fail(err, IL_E_INPUT, p->line, "%s", what);
    il_error_set_file(err, il_source_name(source[p->file]));
    return st;
}

static bool has_height(const il_svg_part *p)
{
    return p->level.kind != IL_SVG_LEVEL_NONE;
}

static const il_svg_part *find_with_height(const il_svg_slices *s)
{
    for (size_t i = 0; i < s->n; i++)
        if (has_height(&s->part[i]))
            return &s->part[i];
    return NULL;
}

static const il_svg_part *find_contour_without(const il_svg_slices *s)
{
    for (size_t i = 0; i < s->n; i++)
        if (!has_height(&s->part[i]) && s->part[i].slice.n > 0)
            return &s->part[i];
    return NULL;
}

/* Where heights are given, a group without one that holds nothing is nothing. */
static void drop_empty_without(il_svg_slices *s)
{
    size_t kept = 0;
    for (size_t i = 0; i < s->n; i++)
        if (has_height(&s->part[i]))
            s->part[kept++] = s->part[i];
    s->n = kept;
}

static bool has_contours(const il_svg_slices *s)
{
    for (size_t i = 0; i < s->n; i++)
        if (s->part[i].slice.n > 0)
            return true;
    return false;
}

/* Several files without any height are a slice each. */
static void number_parts(il_svg_slices *s, size_t n_files)
{
    for (size_t i = 0; n_files > 1 && i < s->n; i++)
        s->part[i].slot = s->part[i].file;
}

static bool is_one_slot(const il_svg_slices *s)
{
    for (size_t i = 1; i < s->n; i++)
        if (s->part[i].slot != s->part[0].slot)
            return false;
    return true;
}

static double height(const il_svg_part *p, const il_read_options *o)
{
    double step = o->has_spacing ? o->spacing : 1;
    return p->level.kind == IL_SVG_LEVEL_NONE ? (double)p->slot * step
         : p->level.kind == IL_SVG_LEVEL_ORDINAL ? p->level.value * step
         : p->level.value;
}

static il_status set_heights(il_svg_slices *s, il_source *const *source, size_t n_files,
                             const il_read_options *o, il_report *report, il_error *err)
{
    const il_svg_part *with = find_with_height(s), *without = find_contour_without(s);
    bool counted = false;
    if (with && without)
        return fail_at(without, source, err, "no height here (data-z, z, slic3r:z, or a group named like layer12 or "
            "z=3.5), though other contours have one");
    if (with)
        drop_empty_without(s);
    else
        number_parts(s, n_files);
    if (without && !o->has_spacing && !is_one_slot(s))
        return fail_at(without, source, err, "no heights: give --spacing to count slices from here, or write data-z "
            "on the groups or elements");
    for (size_t i = 0; i < s->n; i++) {
        s->part[i].z = height(&s->part[i], o);
        counted = counted || s->part[i].level.kind == IL_SVG_LEVEL_ORDINAL;
        if (!(fabs(s->part[i].z) < IL_SVG_COORDINATE_LIMIT))
            return fail_at(&s->part[i], source, err, "a height is not below 1e15");
    }
    if (counted && !o->has_spacing)
        il_report_note(report, "the numbers in group names are taken as heights (--spacing gives their distance)");
    return IL_OK;
}

/* ---- order ----------------------------------------------------------------------- */

static int compare_parts(const void *pa, const void *pb)
{
    const il_svg_part *a = pa, *b = pb;
    if (a->z != b->z)
        return a->z < b->z ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

static void sort_parts(il_svg_slices *s, il_report *report)
{
    size_t n_late = 0;
    double highest = -INFINITY;
    for (size_t i = 0; i < s->n; i++) {
        n_late += s->part[i].z < highest ? 1 : 0;
        highest = fmax(highest, s->part[i].z);
    }
    qsort(s->part, s->n, sizeof *s->part, compare_parts);
    il_report_repair(report, IL_REPAIR_REORDERED_SLICE, n_late);
}

/* Single elements with equal heights are one slice as a matter of course; two
 * groups are two slices made one. */
static bool is_merger(const il_svg_part *to, const il_svg_part *p)
{
    return to->slice.n > 0 && p->slice.n > 0 && to->level.owner >= 0 && p->level.owner >= 0 &&
           to->level.kind != IL_SVG_LEVEL_NONE;
}

static il_status merge_parts(il_svg_slices *s, il_report *report, il_error *err)
{
    size_t kept = 0, n_merged = 0;
    il_status st = IL_OK;
    for (size_t i = 1; i < s->n && st == IL_OK; i++) {
        il_svg_part *to = &s->part[kept], *p = &s->part[i];
        if (p->z == to->z) {
            n_merged += is_merger(to, p) ? 1 : 0;
            if (to->slice.n == 0)
                to->level = p->level;
            st = move_rings(&to->slice, &p->slice, err);
        } else if (++kept < i) {
            s->part[kept] = *p;
            p->slice = (il_slice)IL_SLICE_INIT;
        }
    }
    if (st == IL_OK)
        s->n = kept + 1;
    il_report_repair(report, IL_REPAIR_MERGED_SLICE, n_merged);
    return st;
}

/* ---- sending ---------------------------------------------------------------------- */

static il_status join_lines(il_svg_slices *s, il_source *const *source, il_report *report, il_error *err)
{
    il_svg_joined all = { 0 };
    for (size_t i = 0; i < s->n; i++) {
        il_svg_joined here = { 0 };
        il_status st = il_svg_join(&s->part[i].slice, &here, err);
        if (st != IL_OK)
            return st;
        for (size_t k = 0; k < here.n_dropped; k++)
            il_report_skip(report, il_source_name(source[s->part[i].file]), here.dropped_line,
                           "a single segment", "it meets no others that make it a contour");
        all.n_joined += here.n_joined;
        all.n_closed += here.n_closed;
    }
    if (all.n_joined > 0)
        il_report_note(report, "open lines joined where their ends meet: %zu", all.n_joined);
    if (all.n_closed > 0)
        il_report_note(report, "open lines closed by a straight edge: %zu", all.n_closed);
    return IL_OK;
}

/* Empty slices below the first and above the last contour say nothing. */
static void find_extent(const il_svg_slices *s, size_t *first, size_t *end)
{
    *first = 0;
    *end = s->n;
    while (*first < *end && s->part[*first].slice.n == 0)
        ++*first;
    while (*first < *end && s->part[*end - 1].slice.n == 0)
        --*end;
}

/* What a stage finds wrong with a slice names the file it came from. */
static il_status send_parts(il_svg_slices *s, const il_stack_head *head, il_source *const *source,
                            il_sink *sink, il_error *err)
{
    size_t first, end;
    find_extent(s, &first, &end);
    il_status st = sink->stack_begin(sink, head, err);
    for (size_t i = first; i < end && st == IL_OK; i++) {
        s->part[i].slice.z = s->part[i].z;
        st = sink->slice(sink, &s->part[i].slice, err);
        il_slice_free(&s->part[i].slice);
        if (st == IL_E_INPUT)
            il_error_set_file(err, il_source_name(source[s->part[i].file]));
    }
    if (st == IL_OK)
        st = sink->stack_end(sink, err);
    return st == IL_OK ? sink->end(sink, err) : st;
}

il_status il_svg_slices_send(il_svg_slices *s, const il_stack_head *head, il_source *const *source, size_t n,
                             const il_read_options *o, il_sink *sink, il_report *report, il_error *err)
{
    if (!has_contours(s)) {
        il_status st = il_fail(err, IL_E_INPUT, 0, "no contour (polygon, path, polyline, line, rect, circle, ellipse)");
        il_error_set_file(err, il_source_name(source[0]));
        return st;
    }
    il_status st = set_heights(s, source, n, o, report, err);
    if (st != IL_OK)
        return st;
    sort_parts(s, report);
    st = merge_parts(s, report, err);
    if (st == IL_OK)
        st = join_lines(s, source, report, err);
    return st == IL_OK ? send_parts(s, head, source, sink, err) : st;
}
