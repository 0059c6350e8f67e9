#include "config.h"
#include "region/clean.h"
#include "base/alloc.h"
#include "base/number.h"
#include "bridge/predicates.h"
#include "model/order.h"
#include "model/arrange.h"
#include "region/boundary.h"
#include "model/near.h"
#include "region/separate.h"
#include "region/simple.h"

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

/* One zero, so that the same contours give the same bytes on every road. */
static void drop_negative_zeros(il_ring *r)
{
    for (size_t i = 0; i < 2 * r->n; i++)
        r->xy[i] += 0.0;
}

/* All vertices on one line, or fewer than three: no area to bound. */
static bool is_degenerate(const il_ring *r)
{
    for (size_t i = 2; i < r->n; i++)
        if (il_orientation(r->xy, r->xy + 2, r->xy + 2 * i) != 0)
            return false;
    return true;
}

/* A ring read from the start and in the direction that make the least sequence,
 * so that equal rings read equally whatever their start and direction. */
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

static int compare_shapes(const reading *a, const reading *b)
{
    if (a->ring->n != b->ring->n)
        return a->ring->n < b->ring->n ? -1 : 1;
    for (size_t i = 0; i < a->ring->n; i++) {
        int c = il_vertex_compare(point_of(a, i), point_of(b, i));
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

static reading reading_of(il_ring *r, size_t index)
{
    reading along = { r, il_ring_first(r), index, false }, against = { r, 0, index, true };
    il_ring_reverse(r); /* there and back: vertex 0 stays, vertex k becomes n - k */
    size_t first = il_ring_first(r);
    il_ring_reverse(r);
    against.start = first == 0 ? 0 : r->n - first;
    return compare_shapes(&along, &against) <= 0 ? along : against;
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

/* All that is done to points and rings one by one; *N_MOVED: points that were
 * near others and are where these are now. */
static il_status prepare_rings(il_slice *s, const il_clean_options *o, il_report *report, size_t *n_moved, il_error *err)
{
    size_t joined = 0;
    for (size_t i = 0; i < s->n; i++) {
        if (o->round_float)
            round_ring(&s->ring[i], report);
        drop_negative_zeros(&s->ring[i]);
    }
    il_status st = il_slice_gather(s, il_slice_cell(s, o->round_float), n_moved, &joined, err);
    if (st != IL_OK)
        return st;
    il_report_repair(report, IL_REPAIR_TOUCH, joined);
    for (size_t i = 0; i < s->n; i++) {
        il_ring *r = &s->ring[i];
        il_report_repair(report, IL_REPAIR_REPEATED_POINT, il_ring_drop_repeated(r));
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

/* Rings of the input and what became of their edges. */
typedef struct fate {
    uint32_t heir;            /* clean ring with the first that survived, or UINT32_MAX */
    bool kept, turned;        /* any that runs as it ran, any that was turned round */
} fate;

static bool find_fates(fate *f, size_t n, const il_arrangement *a, const il_slice *clean)
{
    il_keymap ring_at = IL_KEYMAP_INIT;
    bool ok = index_edges(&ring_at, a, clean);
    for (size_t i = 0; i < n; i++)
        f[i] = (fate){ UINT32_MAX, false, false };
    for (size_t e = 0; ok && e < a->n_edges; e++) {
        fate *of = &f[a->owner[e]];
        uint32_t p = a->edge[2 * e], q = a->edge[2 * e + 1];
        uint32_t forward = il_keymap_get(&ring_at, p, q, UINT32_MAX);
        uint32_t reverse = il_keymap_get(&ring_at, q, p, UINT32_MAX);
        of->kept |= forward != UINT32_MAX;
        of->turned |= reverse != UINT32_MAX;
        if (of->heir == UINT32_MAX)
            of->heir = forward != UINT32_MAX ? forward : reverse;
    }
    il_keymap_free(&ring_at);
    return ok;
}

/* What belonged to an input ring (its line, its x- lines) goes to the clean
 * ring that has its first surviving edge, or else to the slice.  Counts rings
 * that were turned round. */
static il_status hand_down(il_slice *from, const il_arrangement *a, il_slice *to, il_report *report, il_error *err)
{
    fate *f = il_alloc(from->n, sizeof *f);
    bool ok = f && find_fates(f, from->n, a, to);
    for (size_t i = 0; ok && i < from->n; i++) {
        il_ring *heir = f[i].heir == UINT32_MAX ? NULL : &to->ring[f[i].heir];
        if (heir && heir->line == 0 && heir->feature == 0)
            il_ring_take_origin(heir, &from->ring[i]);
        il_extra_move(heir ? &heir->extra : &to->extra, &from->ring[i].extra);
        if (f[i].turned && !f[i].kept)
            il_report_repair(report, IL_REPAIR_REVERSED_RING, 1);
    }
    il_free(f);
    return ok ? IL_OK : il_fail_nomem(err);
}

static size_t count_dropped(const il_report *r)
{
    return r->repair[IL_REPAIR_REPEATED_POINT] + r->repair[IL_REPAIR_DEGENERATE_RING] +
           r->repair[IL_REPAIR_DUPLICATE_RING] + r->repair[IL_REPAIR_ROUNDED_POINT];
}

/* Has the settled arrangement of S nothing but its rings, each vertex once? */
static bool is_simple(const il_arrangement *a, const il_slice *s, size_t crossings, size_t touches)
{
    size_t vertices = 0, rings = 0;
    for (size_t i = 0; i < s->n; i++) {
        vertices += s->ring[i].n;
        rings += s->ring[i].n > 0;
    }
    return crossings == 0 && touches == 0 && a->n_nodes == vertices && rings <= IL_SIMPLE_RINGS;
}

/* The boundary of what the arrangement A of S bounds. */
static il_status extract(il_slice *clean, il_slice *s, const il_arrangement *a, bool round_float, il_report *report, il_error *err)
{
    size_t cancelled = 0, pinches = 0;
    il_status st = il_boundary_extract(a, clean, &cancelled, &pinches, err);
    if (st == IL_OK)
        st = hand_down(s, a, clean, report, err);
    if (st == IL_OK && pinches > 0)
        st = il_slice_separate(clean, round_float, &pinches, err);
    if (st == IL_OK) {
        il_report_repair(report, IL_REPAIR_KEYHOLE_EDGE, cancelled);
        il_report_repair(report, IL_REPAIR_PINCH, pinches);
    }
    return st;
}

/* The boundary of the prepared slice S. */
static il_status rebuild(il_slice *clean, il_slice *s, bool round_float, il_report *report, il_error *err)
{
    il_arrangement a = IL_ARRANGEMENT_INIT;
    size_t crossings = 0, touches = 0, turned = 0;
    il_status st = il_arrangement_from_slice(&a, s, il_slice_cell(s, round_float), err);
    if (st == IL_OK)
        st = il_arrangement_settle(&a, &crossings, &touches, err);
    if (st == IL_OK)
        st = is_simple(&a, s, crossings, touches) ? il_slice_take_simple(clean, s, &turned, err)
                                                  : extract(clean, s, &a, round_float, report, err);
    if (st == IL_OK) {
        il_report_repair(report, IL_REPAIR_CROSSING, crossings);
        il_report_repair(report, IL_REPAIR_TOUCH, touches);
        il_report_repair(report, IL_REPAIR_REVERSED_RING, turned);
    }
    il_arrangement_free(&a);
    return st;
}

il_status il_slice_clean(il_slice *s, const il_clean_options *o, il_report *report, bool *changed, il_error *err)
{
    il_slice clean = IL_SLICE_INIT;
    il_report own = IL_REPORT_INIT;
    size_t n_moved = 0;
    if (check_open(s, err) != IL_OK)
        return IL_E_INPUT;
    if (!report)
        report = &own;
    size_t dropped_before = count_dropped(report);
    il_status st = prepare_rings(s, o, report, &n_moved, err);
    if (st == IL_OK)
        st = rebuild(&clean, s, o->round_float, report, err);
    if (st == IL_OK) {
        if (changed)
            *changed = n_moved > 0 || count_dropped(report) != dropped_before || !il_slice_equal_rings(s, &clean);
        clean.z = s->z;
        clean.line = s->line;
        il_extra_move(&s->extra, &clean.extra);
        il_extra_move(&clean.extra, &s->extra);
        il_slice swap = *s;
        *s = clean;
        clean = swap;
    } else {
        il_slice_free(s);
    }
    il_slice_free(&clean);
    il_report_free(&own);
    return st;
}
