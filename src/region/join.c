/* join.c - the lines of one level, step by step (joiner.h). */
#include "config.h"
#include "base/alloc.h"
#include "model/order.h"
#include "region/join-chains.h"
#include "region/join-gaps.h"
#include "region/join-prune.h"
#include "region/joiner.h"

#include <math.h>
#include <string.h>

/* One run over a level.  open_piece[n_open]: pieces that have ends. */
typedef struct level {
    il_slice *slice;
    il_shared_edges edges;
    il_pieces pieces;
    il_ends ends;
    uint32_t *open_piece;
    size_t n_open;
} level;

/* ---- each line by itself ----------------------------------------------------------- */

/* One zero, so that the same lines give the same bytes on every road. */
static void drop_negative_zeros(il_ring *r)
{
    for (size_t i = 0; i < 2 * r->n; i++)
        r->xy[i] += 0.0;
}

static bool comes_back(const il_ring *r)
{
    return r->open && r->n > 2 && il_vertex_compare(r->xy, r->xy + 2 * (r->n - 1)) == 0;
}

/* False when nothing is left of R. */
static bool tidy_line(il_ring *r, il_report *report)
{
    drop_negative_zeros(r);
    il_report_repair(report, IL_REPAIR_REPEATED_POINT, il_ring_drop_repeated(r));
    if (comes_back(r)) {
        r->open = false;
        r->n--;
        if (r->mark)
            r->mark[0] &= (unsigned char)(r->mark[r->n] | IL_VERTEX_MAP_EDGE);
        il_report_repair(report, IL_REPAIR_JOINED_LINE, 1);
    }
    il_report_repair(report, IL_REPAIR_SPIKE, r->n > 2 ? il_ring_drop_spikes(r) : 0);
    if (r->n > 2 || (r->open && r->n == 2))
        return true;
    il_report_repair(report, r->n == 2 ? IL_REPAIR_DEGENERATE_RING : IL_REPAIR_POINT_LINE, 1);
    return false;
}

/* The private lines of what is dropped become the slice's. */
static void tidy_lines(il_slice *s, il_report *report)
{
    size_t n = 0;
    il_extra **tail = &s->extra;
    for (size_t i = 0; i < s->n; i++) {
        if (tidy_line(&s->ring[i], report)) {
            il_ring kept = s->ring[i];
            s->ring[i] = (il_ring)IL_RING_INIT;
            s->ring[n++] = kept;
            continue;
        }
        while (*tail)
            tail = &(*tail)->next;
        il_extra_move(tail, &s->ring[i].extra);
        il_ring_free(&s->ring[i]);
    }
    s->n = n;
}

/* ---- all of them --------------------------------------------------------------------- */

static il_status place_ends(level *l, il_error *err)
{
    const il_pieces *p = &l->pieces;
    l->open_piece = il_alloc(p->n, sizeof *l->open_piece);
    if (!l->open_piece)
        return il_fail_nomem(err);
    for (uint32_t i = 0; i < p->n; i++)
        if (!p->piece[i].closed)
            l->open_piece[l->n_open++] = i;
    il_status st = il_ends_init(&l->ends, 2 * l->n_open, err);
    for (size_t k = 0; k < l->n_open && st == IL_OK; k++) {
        const il_piece *q = &p->piece[l->open_piece[k]];
        memcpy(l->ends.at + 4 * k, il_piece_vertex(q, l->slice, 0), 2 * sizeof *l->ends.at);
        memcpy(l->ends.at + 4 * k + 2, il_piece_vertex(q, l->slice, q->n - 1), 2 * sizeof *l->ends.at);
    }
    return st;
}

/* Of every place with an end, under its coordinates. */
static bool index_places(const il_ends *e, il_keymap *at)
{
    bool ok = il_keymap_reserve(at, e->n_places);
    for (size_t k = 0; k < e->n && ok; k++)
        ok = il_keymap_put(at, il_keymap_double(e->at[2 * k]), il_keymap_double(e->at[2 * k + 1]), e->place[k]) != NULL;
    return ok;
}

/* The edges of Q that lead from one place to another. */
static bool find_edges(const il_piece *q, const il_slice *s, const il_keymap *at, il_keymap *edges)
{
    uint32_t before = IL_NO_END;
    bool is_ring = q->whole && q->closed;
    for (size_t k = 0; k < q->n + is_ring; k++) {
        const double *p = il_piece_vertex(q, s, k < q->n ? k : 0);
        uint32_t place = il_keymap_get(at, il_keymap_double(p[0]), il_keymap_double(p[1]), IL_NO_END);
        if (place != IL_NO_END && before != IL_NO_END && !il_keymap_put(edges, IL_KEYMAP_EDGE(before, place), 1))
            return false;
        before = place;
    }
    return true;
}

static il_status bridge_gaps(level *l, double distance, size_t *n, double *largest, il_error *err)
{
    il_keymap at = IL_KEYMAP_INIT, edges = IL_KEYMAP_INIT;
    double widest = 0;
    bool ok = index_places(&l->ends, &at);
    for (size_t i = 0; i < l->pieces.n && ok; i++)
        ok = find_edges(&l->pieces.piece[i], l->slice, &at, &edges);
    il_status st = ok ? il_ends_bridge(&l->ends, distance, &edges, n, &widest, err) : il_fail_nomem(err);
    *largest = fmax(*largest, widest);
    il_keymap_free(&at);
    il_keymap_free(&edges);
    return st;
}

/* Each joint leaves an open line less.  What was cut for shared stretches is put together
 * again first, or ends in knots, and is none. */
static size_t count_joints(const level *l, size_t n_bridged)
{
    size_t n_left = l->n_open - l->ends.n_joined, n_gone = l->pieces.n_lines > n_left ? l->pieces.n_lines - n_left : 0;
    return n_gone > n_bridged ? n_gone - n_bridged : 0;
}

static il_status join_ends(level *l, const il_join_options *o, il_report *report, double *largest, il_error *err)
{
    il_status st = place_ends(l, err);
    if (st == IL_OK)
        st = il_ends_join(&l->ends, err);
    if (st != IL_OK)
        return st;
    size_t n_bridged = 0;
    if (o->distance > 0)
        st = bridge_gaps(l, o->distance, &n_bridged, largest, err);
    il_report_repair(report, IL_REPAIR_BRIDGED_GAP, n_bridged);
    il_report_repair(report, IL_REPAIR_JOINED_LINE, count_joints(l, n_bridged));
    il_report_repair(report, IL_REPAIR_KNOT, il_ends_knots(&l->ends));
    return st;
}

static il_status join_lines(level *l, const il_join_options *o, il_report *report, double *largest, il_error *err)
{
    il_status st = il_shared_edges_find(&l->edges, l->slice, err);
    if (st == IL_OK)
        st = il_pieces_cut(&l->pieces, l->slice, &l->edges, report, err);
    if (st == IL_OK)
        st = il_pieces_prune(&l->pieces, l->slice, &l->edges, report, err);
    if (st == IL_OK)
        st = join_ends(l, o, report, largest, err);
    const il_chains c = { l->slice, &l->edges, &l->pieces, &l->ends, l->open_piece };
    if (st == IL_OK)
        st = il_chains_make(&c, report, err);
    il_ends_free(&l->ends);
    il_free(l->open_piece);
    il_pieces_free(&l->pieces);
    il_shared_edges_free(&l->edges);
    return st;
}

/* ---- a level --------------------------------------------------------------------------- */

static size_t count_crumbs(const il_slice *s)
{
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++)
        n += s->ring[i].open && s->ring[i].n == 2;
    return n;
}

il_status il_slice_join(il_slice *s, const il_join_options *o, il_report *report, bool *changed, double *largest,
                        il_error *err)
{
    level l = { .slice = s, .edges = IL_SHARED_EDGES_INIT, .pieces = IL_PIECES_INIT, .ends = IL_ENDS_INIT };
    il_report own = IL_REPORT_INIT;
    if (s->n > INT32_MAX)
        return il_fail(err, IL_E_INPUT, s->line, "more than %d lines at one height", INT32_MAX);
    tidy_lines(s, &own);
    il_status st = join_lines(&l, o, &own, largest, err);
    bool in_order = !il_report_any(&own) && st == IL_OK && il_slice_in_order(s);
    if (changed)
        *changed = !in_order;
    if (st == IL_OK && !in_order)
        il_slice_put_in_order(s);
    il_report_repair(&own, IL_REPAIR_CRUMB, count_crumbs(s));
    il_report_merge(report, &own);
    return st;
}
