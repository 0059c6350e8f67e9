#include "config.h"
#include "region/join-prune.h"
#include "base/alloc.h"
#include "base/keymap.h"

/* A line may end so many vertices from a knot, and be what is left of it at the edge of
 * its sheet. */
enum { STUB_MOST = 4 };

/* n: ends of pieces there.  n_stubs: of them those of pieces of up to STUB_MOST vertices
 * whose other end is alone, n_single of a single edge; overlaps: one is of a stretch that
 * lines share which run the same way. */
typedef struct place {
    uint32_t n, n_stubs, n_single;
    bool overlaps;
} place;

/* at[2 i], at[2 i + 1]: the places of the ends of piece i, if it is open. */
typedef struct prune {
    il_pieces *pieces;
    const il_slice *slice;
    const il_shared_edges *edges;
    uint32_t *at;
    place *place;
} prune;

static bool index_places(prune *p)
{
    il_keymap where = IL_KEYMAP_INIT;
    uint32_t n = 0;
    p->at = il_alloc(2 * p->pieces->n, sizeof *p->at);
    p->place = il_calloc(2 * p->pieces->n, sizeof *p->place);
    bool ok = p->at && p->place;
    for (size_t i = 0; i < 2 * p->pieces->n && ok; i++) {
        const il_piece *q = &p->pieces->piece[i / 2];
        if (q->closed)
            continue;
        const double *xy = il_piece_vertex(q, p->slice, i & 1 ? q->n - 1 : 0);
        const uint32_t *at = il_keymap_put(&where, il_keymap_double(xy[0]), il_keymap_double(xy[1]), n);
        ok = at != NULL;
        if (ok) {
            n += *at == n;
            p->at[i] = *at;
            p->place[*at].n++;
        }
    }
    il_keymap_free(&where);
    return ok;
}

/* The edges of a piece are shared by the same lines. */
static const il_shared_edge *edge_of(const prune *p, const il_piece *q)
{
    return &p->edges->edge[p->edges->of[q->line][q->from]];
}

static place *place_at(const prune *p, size_t end)
{
    return &p->place[p->at[end]];
}

/* Is END that of a stub, whose other end is alone? */
static bool is_stub(const prune *p, size_t end)
{
    const il_piece *q = &p->pieces->piece[end / 2];
    return !q->closed && !q->is_shared && q->n <= STUB_MOST && place_at(p, end ^ 1)->n == 1 && place_at(p, end)->n > 1;
}

static void describe_places(const prune *p)
{
    for (size_t i = 0; i < 2 * p->pieces->n; i++) {
        const il_piece *q = &p->pieces->piece[i / 2];
        if (q->closed)
            continue;
        place_at(p, i)->n_stubs += is_stub(p, i);
        place_at(p, i)->n_single += is_stub(p, i) && q->n == 2;
        place_at(p, i)->overlaps |= q->is_shared && edge_of(p, q)->net != 0;
    }
}

/* Do all lines that share a stretch go on where it ends, or none? */
static bool goes_on(const place *at)
{
    return at->n > 2 && at->n_stubs == 0;
}

static bool ends_here(const place *at)
{
    return at->n == 1;
}

/* As many copies of piece I run one way as the other, and they are of one line, or lie
 * between lines that go on, at one end at least: at the other may be the map's edge. */
static bool is_neck(const prune *p, size_t i)
{
    const il_piece *q = &p->pieces->piece[i];
    if (q->closed || !q->is_shared || edge_of(p, q)->net != 0)
        return false;
    const place *a = place_at(p, 2 * i), *b = place_at(p, 2 * i + 1);
    return edge_of(p, q)->is_within || (goes_on(a) && (goes_on(b) || ends_here(b))) || (ends_here(a) && goes_on(b));
}

static bool is_left_over(const prune *p, size_t end)
{
    const place *at = is_stub(p, end) && p->pieces->piece[end / 2].n == 2 ? place_at(p, end) : NULL;
    return at && at->n == 3 && at->n_single == 1 && at->overlaps;
}

static void leave_out(const prune *p, il_report *report)
{
    size_t n = 0;
    for (size_t i = 0; i < p->pieces->n; i++) {
        const il_piece q = p->pieces->piece[i];
        bool neck = is_neck(p, i), stub = !q.closed && (is_left_over(p, 2 * i) || is_left_over(p, 2 * i + 1));
        if (!neck && !stub) {
            p->at[2 * n] = p->at[2 * i];
            p->at[2 * n + 1] = p->at[2 * i + 1];
            p->pieces->piece[n++] = q;
            continue;
        }
        il_report_repair(report, neck ? IL_REPAIR_SHARED_EDGE : IL_REPAIR_SPIKE, q.n - 1);
        p->pieces->n_lines -= q.whole;
    }
    p->pieces->n = n;
}

il_status il_pieces_prune(il_pieces *p, const il_slice *s, const il_shared_edges *e, il_report *report, il_error *err)
{
    prune pr = { .pieces = p, .slice = s, .edges = e };
    if (!e->of)
        return IL_OK;
    bool ok = index_places(&pr);
    if (ok) {
        describe_places(&pr);
        leave_out(&pr, report);
    }
    il_free(pr.at);
    il_free(pr.place);
    return ok ? IL_OK : il_fail_nomem(err);
}
