#include "config.h"
#include "region/join-pieces.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "model/order.h"

#include <math.h>
#include <stdlib.h>

/* A line that shares edges: of[v], behind its vertex v. */
typedef struct path {
    const il_ring *ring;
    const uint32_t *of;
    uint32_t line;
    il_shared_edge *edge;
} path;

/* ---- where shared stretches end -------------------------------------------------- */

static size_t before(const il_ring *r, size_t v)
{
    return v > 0 ? v - 1 : r->n - 1;
}

static size_t behind(const il_ring *r, size_t v)
{
    return v + 1 < r->n ? v + 1 : 0;
}

/* The shared edges that lead to vertex V and away from it, IL_NO_EDGE for none; an
 * open line has none before its first vertex and behind its last. */
static uint32_t edge_to(const path *p, size_t v)
{
    return v == 0 && p->ring->open ? IL_NO_EDGE : p->of[before(p->ring, v)];
}

static uint32_t edge_from(const path *p, size_t v)
{
    return p->of[v];
}

/* Which end of the edge between vertices V and W is V? */
static int side_of(const path *p, size_t v, size_t w)
{
    return il_vertex_compare(p->ring->xy + 2 * v, p->ring->xy + 2 * w) > 0;
}

/* Edge A is followed by B (IL_NO_EDGE: nothing shared) at its end SIDE. */
static void follow(il_shared_edge *edge, uint32_t a, int side, uint32_t b)
{
    if (a == IL_NO_EDGE)
        return;
    il_shared_edge *e = &edge[a];
    if (b == IL_NO_EDGE || (e->next[side] != IL_NO_EDGE && e->next[side] != b))
        e->splits[side] = true;
    e->next[side] = b;
}

static void follow_line(const path *p)
{
    for (size_t v = 0; v < p->ring->n; v++) {
        uint32_t to = edge_to(p, v), from = edge_from(p, v);
        follow(p->edge, to, side_of(p, v, before(p->ring, v)), from);
        follow(p->edge, from, side_of(p, v, behind(p->ring, v)), to);
    }
}

/* Is line P cut at vertex V, which is no end of it? */
static bool is_cut(const path *p, size_t v)
{
    uint32_t to = edge_to(p, v), from = edge_from(p, v);
    if (to == IL_NO_EDGE || from == IL_NO_EDGE)
        return to != from;
    return p->edge[to].splits[side_of(p, v, before(p->ring, v))] || p->edge[from].splits[side_of(p, v, behind(p->ring, v))];
}

/* ---- pieces ------------------------------------------------------------------------ */

double il_piece_along(const il_piece *p, const il_slice *s, const il_shared_edges *e)
{
    const il_ring *r = &s->ring[p->line];
    const path of = { r, p->is_shared ? e->of[p->line] : NULL, p->line, e->edge };
    bool is_ring = p->whole && p->closed;
    double sum = 0;
    for (size_t k = 1; k < p->n + is_ring; k++) {
        const double *a = il_piece_vertex(p, s, k - 1), *b = il_piece_vertex(p, s, k < p->n ? k : 0);
        double length = sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
        if (p->is_shared) {
            int32_t net = of.edge[of.of[(size_t)(a - r->xy) / 2]].net;
            length *= il_vertex_compare(a, b) < 0 ? net : -net;
        }
        sum += length;
    }
    return sum;
}

static void keep(const path *p, const il_piece *piece)
{
    for (size_t k = 0; k + !(piece->whole && piece->closed) < piece->n; k++)
        p->edge[p->of[(piece->from + k) % p->ring->n]].kept = true;
}

static bool append(il_pieces *out, const il_piece *p)
{
    if (!il_grow(&out->piece, &out->cap, out->n + 1, sizeof *out->piece))
        return false;
    out->piece[out->n++] = *p;
    return true;
}

/* Copies of a shared stretch are cut alike, so that one is kept wholly or not at all.
 * *N_DROPPED grows by the edges of one that is not.  There and back is no ring. */
static bool add_piece(il_pieces *out, const path *p, il_piece piece, size_t *n_dropped, il_report *report)
{
    const il_ring *r = p->ring;
    bool is_ring = piece.whole && !r->open;
    size_t last = (piece.from + piece.n - 1) % r->n;
    piece.line = p->line;
    piece.is_shared = p->of[piece.from] != IL_NO_EDGE;
    piece.closed = is_ring || il_vertex_compare(r->xy + 2 * piece.from, r->xy + 2 * last) == 0;
    if (piece.is_shared && p->edge[p->of[piece.from]].kept) {
        *n_dropped += piece.n - !is_ring;
        return true;
    }
    if (piece.is_shared)
        keep(p, &piece);
    if (piece.closed && !is_ring && piece.n <= 3) {
        il_report_repair(report, IL_REPAIR_DEGENERATE_RING, 1);
        return true;
    }
    return append(out, &piece);
}

/* A ring that is nowhere cut, once round: edges that come again show that it goes
 * round several times. */
static bool add_ring(il_pieces *out, const path *p, size_t *n_dropped, il_report *report)
{
    size_t n = p->ring->n, round = 1;
    while (round < n && p->of[round] != p->of[0])
        round++;
    if (round == n)
        return add_piece(out, p, (il_piece){ .n = n, .whole = true }, n_dropped, report);
    *n_dropped += n - round;
    return add_piece(out, p, (il_piece){ .n = round + 1 }, n_dropped, report);
}

/* The pieces between the vertices where P is cut. */
static bool cut_line(il_pieces *out, const path *p, size_t *n_dropped, il_report *report)
{
    const il_ring *r = p->ring;
    size_t first = 0, last = r->n - 1;
    if (!r->open) {
        while (first < r->n && !is_cut(p, first))
            first++;
        if (first == r->n)
            return add_ring(out, p, n_dropped, report);
        last = first + r->n;
    }
    for (size_t from = first, v = first + 1; v <= last; v++) {
        if (v < last && !is_cut(p, v % r->n))
            continue;
        il_piece piece = { .from = from % r->n, .n = v - from + 1, .whole = r->open && from == 0 && v == last };
        if (!add_piece(out, p, piece, n_dropped, report))
            return false;
        from = v;
    }
    return true;
}

/* ---- all lines ----------------------------------------------------------------------- */

/* A line that shares edges.  hash: of its edges, whatever their order. */
typedef struct candidate { size_t n_edges; uint64_t hash; uint32_t line; } candidate;

static uint64_t hash_vertex(const double *p)
{
    return il_keymap_mix(il_keymap_mix(il_keymap_double(p[0])) + il_keymap_double(p[1]));
}

static candidate candidate_of(const il_ring *r, uint32_t line)
{
    candidate c = { r->n - r->open, 0, line };
    for (size_t v = 0; v < c.n_edges; v++)
        c.hash += il_keymap_mix(hash_vertex(r->xy + 2 * v) + hash_vertex(r->xy + 2 * behind(r, v)));
    return c;
}

/* The longest first, so that lines which are part of another are the ones left out; of
 * equal length, any order that is not that of the input. */
static int compare(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->n_edges != q->n_edges)
        return p->n_edges > q->n_edges ? -1 : 1;
    if (p->hash != q->hash)
        return p->hash < q->hash ? -1 : 1;
    return p->line < q->line ? -1 : p->line > q->line;
}

static path path_of(const il_slice *s, il_shared_edges *e, uint32_t line)
{
    return (path){ &s->ring[line], e->of[line], line, e->edge };
}

static bool cut_sharing(il_pieces *out, const il_slice *s, il_shared_edges *e, candidate *c, size_t n, il_report *report)
{
    for (size_t i = 0; i < n; i++) {
        path p = path_of(s, e, c[i].line);
        follow_line(&p);
    }
    qsort(c, n, sizeof *c, compare);
    for (size_t i = 0; i < n; i++) {
        path p = path_of(s, e, c[i].line);
        size_t n_before = out->n, n_dropped = 0;
        if (!cut_line(out, &p, &n_dropped, report))
            return false;
        bool all = out->n == n_before;
        out->n_lines += p.ring->open && !all;
        il_report_repair(report, all ? IL_REPAIR_DUPLICATE_LINE : IL_REPAIR_SHARED_EDGE, all ? 1 : n_dropped);
    }
    return true;
}

il_status il_pieces_cut(il_pieces *out, const il_slice *s, il_shared_edges *e, il_report *report, il_error *err)
{
    *out = (il_pieces)IL_PIECES_INIT;
    candidate *c = e->of ? il_alloc(s->n, sizeof *c) : NULL;
    bool ok = (c || !e->of) && il_grow(&out->piece, &out->cap, s->n, sizeof *out->piece);
    size_t n = 0;
    for (uint32_t l = 0; l < s->n && ok; l++) {
        const il_ring *r = &s->ring[l];
        bool shares = e->of && e->of[l];
        out->n_lines += r->open && !shares;
        if (shares)
            c[n++] = candidate_of(r, l);
        else
            ok = append(out, &(il_piece){ .line = l, .n = r->n, .whole = true, .closed = !r->open });
    }
    ok = ok && (n == 0 || cut_sharing(out, s, e, c, n, report));
    il_free(c);
    if (ok)
        return IL_OK;
    il_pieces_free(out);
    return il_fail_nomem(err);
}

void il_pieces_free(il_pieces *p)
{
    il_free(p->piece);
    *p = (il_pieces)IL_PIECES_INIT;
}
