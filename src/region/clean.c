#include "config.h"
#include "region/clean.h"
#include "base/alloc.h"
#include "base/number.h"
#include "bridge/predicates.h"
#include "region/arrange.h"
#include "region/boundary.h"
#include "region/separate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void round_ring(il_ring *r, il_report *report)
{
    size_t moved = 0;
    for (size_t i = 0; i < r->n; i++) {
        double x = il_number_round_float(r->xy[2 * i]), y = il_number_round_float(r->xy[2 * i + 1]);
        double move = hypot(x - r->xy[2 * i], y - r->xy[2 * i + 1]);
        if (move > 0) {
            moved++;
            if (report && move > report->largest_move)
                report->largest_move = move;
        }
        r->xy[2 * i] = x;
        r->xy[2 * i + 1] = y;
    }
    if (moved > 0)
        il_report_repair(report, IL_REPAIR_ROUNDED_POINT, moved);
}

static bool same_point(const il_ring *r, size_t i, size_t j, double cell)
{
    return fabs(r->xy[2 * i] - r->xy[2 * j]) < cell && fabs(r->xy[2 * i + 1] - r->xy[2 * j + 1]) < cell;
}

/* One zero, so that the same contours give the same bytes on every road. */
static void drop_negative_zeros(il_ring *r)
{
    for (size_t i = 0; i < 2 * r->n; i++)
        r->xy[i] += 0.0;
}

/* Drop vertices equal to the one before, and last ones equal to the first, be it
 * but for rounding: programs that compute a closing point miss it by an ulp. */
static void drop_repeated(il_ring *r, double cell, il_report *report)
{
    size_t n = 0;
    for (size_t i = 0; i < r->n; i++) {
        if (n > 0 && same_point(r, i, n - 1, cell))
            continue;
        memmove(r->xy + 2 * n, r->xy + 2 * i, 2 * sizeof *r->xy);
        if (r->mark)
            r->mark[n] = r->mark[i];
        n++;
    }
    while (n > 1 && same_point(r, 0, n - 1, cell))
        n--;
    if (n < r->n)
        il_report_repair(report, IL_REPAIR_REPEATED_POINT, r->n - n);
    r->n = n;
}

/* All vertices on one line, or fewer than three: no area to bound. */
static bool is_degenerate(const il_ring *r)
{
    for (size_t i = 2; i < r->n; i++)
        if (il_orientation(r->xy, r->xy + 2, r->xy + 2 * i) != 0)
            return false;
    return true;
}

static size_t least_vertex(const il_ring *r)
{
    size_t k = 0;
    for (size_t i = 1; i < r->n; i++)
        if (r->xy[2 * i] < r->xy[2 * k] || (r->xy[2 * i] == r->xy[2 * k] && r->xy[2 * i + 1] < r->xy[2 * k + 1]))
            k = i;
    return k;
}

/* A ring read from its least vertex towards the lesser neighbour, so that equal
 * rings read equally whatever their start and direction. */
typedef struct reading {
    const il_ring *ring;
    size_t start, index;
    bool backwards;
} reading;

static const double *point_of(const reading *r, size_t i)
{
    size_t n = r->ring->n, k = r->backwards ? r->start + n - i : r->start + i;
    return r->ring->xy + 2 * (k >= n ? k - n : k);
}

static int compare_points(const double *p, const double *q)
{
    if (p[0] != q[0])
        return p[0] < q[0] ? -1 : 1;
    return p[1] < q[1] ? -1 : p[1] > q[1];
}

static int compare_shapes(const reading *a, const reading *b)
{
    if (a->ring->n != b->ring->n)
        return a->ring->n < b->ring->n ? -1 : 1;
    for (size_t i = 0; i < a->ring->n; i++) {
        int c = compare_points(point_of(a, i), point_of(b, i));
        if (c)
            return c;
    }
    return 0;
}

static int compare_readings(const void *p, const void *q)
{
    const reading *a = p, *b = q;
    int c = compare_shapes(a, b);
    return c ? c : a->index < b->index ? -1 : a->index > b->index;
}

static reading reading_of(const il_ring *r, size_t index)
{
    reading d = { r, least_vertex(r), index, false };
    d.backwards = compare_points(point_of(&d, r->n - 1), point_of(&d, 1)) < 0;
    return d;
}

/* Empty all but the first of equal rings.  Even-odd alone would erase a region
 * that is listed twice, as some planning systems do. */
static il_status drop_duplicates(il_slice *s, il_report *report, il_error *err)
{
    reading *d = il_alloc(s->n, sizeof *d);
    if (!d)
        return il_fail_nomem(err);
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++)
        if (s->ring[i].n >= 3)
            d[n++] = reading_of(&s->ring[i], i);
    qsort(d, n, sizeof *d, compare_readings);
    for (size_t i = 1, first = 0; i < n; i++) {
        if (compare_shapes(&d[first], &d[i]) != 0) {
            first = i;
            continue;
        }
        s->ring[d[i].index].n = 0;
        il_report_repair(report, IL_REPAIR_DUPLICATE_RING, 1);
    }
    il_free(d);
    return IL_OK;
}

static il_status check_open(const il_slice *s, il_error *err)
{
    for (size_t i = 0; i < s->n; i++)
        if (s->ring[i].open)
            return il_fail(err, IL_E_INPUT, s->ring[i].line, "an open line cannot bound a region");
    return IL_OK;
}

static il_status prepare_rings(il_slice *s, const il_clean_options *o, il_report *report, il_error *err)
{
    for (size_t i = 0; i < s->n; i++) {
        if (o->round_float)
            round_ring(&s->ring[i], report);
        drop_negative_zeros(&s->ring[i]);
    }
    double cell = il_slice_cell(s);
    for (size_t i = 0; i < s->n; i++) {
        il_ring *r = &s->ring[i];
        drop_repeated(r, cell, report);
        if (is_degenerate(r)) {
            il_report_repair(report, IL_REPAIR_DEGENERATE_RING, 1);
            r->n = 0;
        }
    }
    return drop_duplicates(s, report, err);
}

/* Directed edge of the clean rings -> ring, by the arrangement's nodes. */
static bool index_edges(il_keymap *ring_at, const il_arrangement *a, const il_slice *s)
{
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        uint32_t before = 0;
        for (size_t k = 0; k <= r->n; k++) {
            const double *p = r->xy + 2 * (k == r->n ? 0 : k);
            uint32_t node = il_keymap_get(&a->at, il_keymap_double(p[0]), il_keymap_double(p[1]), UINT32_MAX);
            if (k > 0 && !il_keymap_put(ring_at, before, node, (uint32_t)i))
                return false;
            before = node;
        }
    }
    return true;
}

static void move_extra(il_extra **to, il_extra **from)
{
    while (*to)
        to = &(*to)->next;
    *to = *from;
    *from = NULL;
}

/* What belonged to an input ring (its line, its x- lines) goes to the clean
 * ring that has its first surviving edge, or else to the slice.  Counts rings
 * that were turned round. */
static il_status hand_down(il_slice *from, const il_arrangement *a, il_slice *to, il_report *report, il_error *err)
{
    il_keymap ring_at = IL_KEYMAP_INIT;
    bool ok = index_edges(&ring_at, a, to);
    uint32_t settled = UINT32_MAX;
    for (size_t e = 0; ok && e < a->n_edges; e++) {
        if (a->owner[e] == settled)
            continue;
        uint32_t p = a->edge[2 * e], q = a->edge[2 * e + 1];
        uint32_t forward = il_keymap_get(&ring_at, p, q, UINT32_MAX);
        uint32_t reverse = il_keymap_get(&ring_at, q, p, UINT32_MAX);
        uint32_t heir = forward != UINT32_MAX ? forward : reverse;
        if (heir == UINT32_MAX)
            continue;
        settled = a->owner[e];
        if (forward == UINT32_MAX)
            il_report_repair(report, IL_REPAIR_REVERSED_RING, 1);
        if (to->ring[heir].line == 0)
            to->ring[heir].line = from->ring[settled].line;
        move_extra(&to->ring[heir].extra, &from->ring[settled].extra);
    }
    for (size_t i = 0; i < from->n; i++)
        move_extra(&to->extra, &from->ring[i].extra);
    il_keymap_free(&ring_at);
    return ok ? IL_OK : il_fail_nomem(err);
}

static unsigned char mark_of(const il_ring *r, size_t i)
{
    return r->mark ? r->mark[i] : 0;
}

static bool same_rings(const il_slice *a, const il_slice *b)
{
    if (a->n != b->n)
        return false;
    for (size_t i = 0; i < a->n; i++) {
        const il_ring *p = &a->ring[i], *q = &b->ring[i];
        if (p->n != q->n || memcmp(p->xy, q->xy, 2 * p->n * sizeof *p->xy) != 0)
            return false;
        for (size_t k = 0; k < p->n; k++)
            if (mark_of(p, k) != mark_of(q, k))
                return false;
    }
    return true;
}

static size_t count_dropped(const il_report *r)
{
    return r->repair[IL_REPAIR_REPEATED_POINT] + r->repair[IL_REPAIR_DEGENERATE_RING] +
           r->repair[IL_REPAIR_DUPLICATE_RING] + r->repair[IL_REPAIR_ROUNDED_POINT];
}

il_status il_slice_clean(il_slice *s, const il_clean_options *o, il_report *report, bool *changed, il_error *err)
{
    il_arrangement a = IL_ARRANGEMENT_INIT;
    il_slice clean = IL_SLICE_INIT;
    il_report own = IL_REPORT_INIT;
    size_t crossings = 0, touches = 0, cancelled = 0, pinches = 0;
    il_status st = check_open(s, err);
    if (!report)
        report = &own;
    size_t dropped_before = count_dropped(report);
    if (st == IL_OK)
        st = prepare_rings(s, o, report, err);
    if (st == IL_OK)
        st = il_arrangement_from_slice(&a, s, err);
    if (st == IL_OK)
        st = il_arrangement_settle(&a, &crossings, &touches, err);
    if (st == IL_OK)
        st = il_boundary_extract(&a, &clean, &cancelled, &pinches, err);
    if (st == IL_OK)
        st = hand_down(s, &a, &clean, report, err);
    if (st == IL_OK && pinches > 0)
        st = il_slice_separate(&clean, o->round_float, &pinches, err);
    if (st == IL_OK) {
        il_report_repair(report, IL_REPAIR_CROSSING, crossings);
        il_report_repair(report, IL_REPAIR_TOUCH, touches);
        il_report_repair(report, IL_REPAIR_KEYHOLE_EDGE, cancelled);
        il_report_repair(report, IL_REPAIR_PINCH, pinches);
        if (changed)
            *changed = count_dropped(report) != dropped_before || !same_rings(s, &clean);
        clean.z = s->z;
        clean.line = s->line;
        move_extra(&s->extra, &clean.extra);
        move_extra(&clean.extra, &s->extra);
        il_slice swap = *s;
        *s = clean;
        clean = swap;
    }
    il_slice_free(&clean);
    il_arrangement_free(&a);
    il_report_free(&own);
    return st;
}
