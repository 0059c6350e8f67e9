#include "config.h"
#include "region/join-chains.h"
#include "base/alloc.h"
#include "model/order.h"

#include <math.h>

/* Lengths each way that differ by no more than this share of all are equal: sums of
 * the same edges may differ by where they were cut. */
static const double EVEN = 1e-9;

/* A piece in its place.  along: see il_piece_along, as it runs here. */
typedef struct link {
    uint32_t piece;
    bool backwards;
    double along;
} link;

/* link[n_links]: the chain at hand.  is_closed: its last end is joined with its first.
 * made: the lines so far.  used[k]: open piece k is in one. */
typedef struct maker {
    const il_chains *c;
    il_slice made;
    link *link;
    size_t n_links, cap_links;
    bool is_closed;
    bool *used;
    size_t n_reversed;
} maker;

/* ---- one line --------------------------------------------------------------------- */

static const il_piece *piece_of(const maker *m, const link *l)
{
    return &m->c->pieces->piece[l->piece];
}

static size_t place_in(const link *l, const il_piece *p, size_t k)
{
    return l->backwards ? p->n - 1 - k : k;
}

/* Marks of vertex K of piece P as it runs in the link: the edge behind it may be the
 * one before it there. */
static unsigned char mark_of(const link *l, const il_piece *p, const il_ring *r, size_t k)
{
    size_t at = place_in(l, p, k), edge = l->backwards ? at - 1 : at;
    if (!r->mark)
        return 0;
    unsigned char inserted = r->mark[(p->from + at) % r->n] & IL_VERTEX_INSERTED;
    unsigned char map_edge = k + 1 < p->n ? r->mark[(p->from + edge) % r->n] & IL_VERTEX_MAP_EDGE : 0;
    return inserted | map_edge;
}

/* Of a vertex of two pieces, which is inserted when it is so in both, and of the edge
 * behind it, which A or B has. */
static unsigned char meet(unsigned char a, unsigned char b)
{
    return (unsigned char)((a & b & IL_VERTEX_INSERTED) | ((a | b) & IL_VERTEX_MAP_EDGE));
}

static bool add_link(const maker *m, il_ring *r, const link *l)
{
    const il_piece *p = piece_of(m, l);
    const il_ring *from = &m->c->slice->ring[p->line];
    for (size_t k = 0; k < p->n; k++) {
        const double *xy = il_piece_vertex(p, m->c->slice, place_in(l, p, k));
        unsigned char mark = mark_of(l, p, from, k);
        if (k == 0 && r->n > 0 && il_vertex_compare(r->xy + 2 * (r->n - 1), xy) == 0) {
            r->n--;
            mark = meet(r->mark ? r->mark[r->n] : 0, mark);
        }
        if (!il_ring_add(r, xy[0], xy[1], mark))
            return false;
    }
    return true;
}

static void close_ring(il_ring *r)
{
    r->open = false;
    if (il_vertex_compare(r->xy, r->xy + 2 * (r->n - 1)) == 0) {
        r->n--;
        if (r->mark)
            r->mark[0] = meet(r->mark[0], r->mark[r->n]);
    }
}

/* The private lines of the lines that have a piece here, unless they are taken. */
static void take_extra(const maker *m, il_ring *r)
{
    il_extra **tail = &r->extra;
    for (size_t i = 0; i < m->n_links; i++) {
        il_ring *from = &m->c->slice->ring[piece_of(m, &m->link[i])->line];
        il_extra_move(tail, &from->extra);
        while (*tail)
            tail = &(*tail)->next;
    }
}

/* The links put together.  A line that is as it was is moved. */
static bool build(const maker *m, il_ring *r)
{
    const il_piece *p = piece_of(m, m->link);
    il_ring *first = &m->c->slice->ring[p->line];
    if (m->n_links == 1 && p->whole) {
        *r = *first;
        *first = (il_ring)IL_RING_INIT;
    } else {
        size_t n = 0;
        for (size_t i = 0; i < m->n_links; i++)
            n += piece_of(m, &m->link[i])->n;
        r->open = true;
        il_ring_take_origin(r, first);
        if (!il_grow(&r->xy, &r->cap, n, 2 * sizeof *r->xy))
            return false;
        for (size_t i = 0; i < m->n_links; i++)
            if (!add_link(m, r, &m->link[i]))
                return false;
        take_extra(m, r);
    }
    if (r->open && (m->is_closed || p->closed))
        close_ring(r);
    return true;
}

/* ---- its direction ------------------------------------------------------------------ */

/* Is the sequence of R less when it is turned round? */
static il_status turns_least(il_ring *r, bool *turns, il_error *err)
{
    il_slice one = { .ring = r, .n = 1 }, back = IL_SLICE_INIT;
    il_status st = il_slice_copy(&back, &one, err);
    if (st != IL_OK)
        return st;
    il_ring_reverse(&back.ring[0]);
    il_ring_order here = { r, il_ring_first(r), 0 }, there = { back.ring, il_ring_first(back.ring), 1 };
    *turns = il_ring_order_compare(&there, &here) < 0;
    il_slice_free(&back);
    return IL_OK;
}

/* Turn R, the line of the links, the way that most of them ran. */
static il_status turn(maker *m, il_ring *r, il_error *err)
{
    double along = 0, all = 0;
    for (size_t i = 0; i < m->n_links; i++) {
        along += m->link[i].along;
        all += fabs(m->link[i].along);
    }
    bool turns = along < 0;
    il_status st = fabs(along) <= EVEN * all ? turns_least(r, &turns, err) : IL_OK;
    if (st == IL_OK && turns)
        il_ring_reverse(r);
    for (size_t i = 0; i < m->n_links; i++)
        m->n_reversed += turns ? m->link[i].along > 0 : m->link[i].along < 0;
    return st;
}

/* ---- all lines ----------------------------------------------------------------------- */

/* Make a line of the links. */
static il_status make_line(maker *m, il_error *err)
{
    bool directed = m->n_links == 1 && !piece_of(m, m->link)->is_shared;
    for (size_t i = 0; i < m->n_links && !directed; i++) {
        double along = il_piece_along(piece_of(m, &m->link[i]), m->c->slice, m->c->edges);
        m->link[i].along = m->link[i].backwards ? -along : along;
    }
    il_ring *r = il_slice_add_ring(&m->made);
    if (!r || !build(m, r))
        return il_fail_nomem(err);
    return directed ? IL_OK : turn(m, r, err);
}

static bool add_to_chain(maker *m, uint32_t piece, bool backwards)
{
    if (!il_grow(&m->link, &m->cap_links, m->n_links + 1, sizeof *m->link))
        return false;
    m->link[m->n_links++] = (link){ piece, backwards, 0 };
    return true;
}

/* The line that begins with end START, or, when that is joined, the ring it is in. */
static il_status make_chain(maker *m, uint32_t start, il_error *err)
{
    uint32_t end = start;
    m->n_links = 0;
    do {
        m->used[end / 2] = true;
        if (!add_to_chain(m, m->c->open_piece[end / 2], end & 1))
            return il_fail_nomem(err);
        end = m->c->ends->partner[end ^ 1];
    } while (end != IL_NO_END && end != start);
    m->is_closed = end == start;
    return make_line(m, err);
}

static il_status make_closed(maker *m, il_error *err)
{
    const il_pieces *p = m->c->pieces;
    il_status st = IL_OK;
    for (uint32_t i = 0; i < p->n && st == IL_OK; i++) {
        m->n_links = 0;
        m->is_closed = false;
        if (p->piece[i].closed)
            st = add_to_chain(m, i, false) ? make_line(m, err) : il_fail_nomem(err);
    }
    return st;
}

/* Lines with free ends begin at one; what is left are rings. */
static il_status make_all(maker *m, il_error *err)
{
    const il_ends *e = m->c->ends;
    il_status st = make_closed(m, err);
    for (uint32_t k = 0; k < e->n && st == IL_OK; k++)
        if (!m->used[k / 2] && e->partner[k] == IL_NO_END)
            st = make_chain(m, k, err);
    for (uint32_t k = 0; k < e->n && st == IL_OK; k += 2)
        if (!m->used[k / 2])
            st = make_chain(m, k, err);
    return st;
}

/* The slice has the new lines, and what private lines are left of the old. */
static void replace_lines(il_slice *s, il_slice *made)
{
    il_slice old = *s;
    s->ring = made->ring;
    s->n = made->n;
    s->cap = made->cap;
    old.extra = NULL;
    il_extra **tail = &s->extra;
    for (size_t i = 0; i < old.n; i++) {
        while (*tail)
            tail = &(*tail)->next;
        il_extra_move(tail, &old.ring[i].extra);
    }
    il_slice_free(&old);
}

il_status il_chains_make(const il_chains *c, il_report *report, il_error *err)
{
    maker m = { .c = c, .made = IL_SLICE_INIT };
    m.used = il_calloc(c->ends->n / 2, sizeof *m.used);
    il_status st = m.used ? make_all(&m, err) : il_fail_nomem(err);
    if (st == IL_OK)
        replace_lines(c->slice, &m.made);
    else
        il_slice_free(&m.made);
    il_report_repair(report, IL_REPAIR_REVERSED_LINE, m.n_reversed);
    il_free(m.link);
    il_free(m.used);
    return st;
}
