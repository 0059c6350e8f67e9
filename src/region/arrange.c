#include "config.h"
#include "region/arrange.h"
#include "base/alloc.h"
#include "bridge/boxes.h"
#include "bridge/predicates.h"
#include "model/ring.h"

#include <math.h>
#include <stdlib.h>

/* Edges that meet pairwise grow with the square of their number; a drawing
 * with more meetings than this is noise, not contours. */
static const size_t MAX_PAIRS = 50 * 1000 * 1000;

/* After this many rounds the cuts die out.  Where they double the edges instead,
 * points lie closer than the grid and edges run to and fro between them; that
 * would go on until memory ends. */
enum { CALM_ROUND = 6 };

/* Edge runs through NODE; along orders the cuts of one edge. */
typedef struct cut {
    uint32_t edge, node;
    double along;
} cut;

typedef struct cut_list {
    cut *cut;
    size_t n, cap;
} cut_list;

void il_arrangement_free(il_arrangement *a)
{
    il_free(a->xy);
    il_free(a->mark);
    il_free(a->edge);
    il_free(a->owner);
    il_free(a->edge_mark);
    il_keymap_free(&a->at);
    *a = (il_arrangement)IL_ARRANGEMENT_INIT;
}

uint32_t il_arrangement_node(il_arrangement *a, double x, double y, unsigned char mark)
{
    uint32_t *id = il_keymap_put(&a->at, il_keymap_double(x), il_keymap_double(y), (uint32_t)a->n_nodes);
    if (!id || a->n_nodes >= UINT32_MAX / 2)
        return UINT32_MAX;
    if (*id < a->n_nodes) {
        a->mark[*id] &= mark;
        return *id;
    }
    size_t n = a->n_nodes;
    if (!il_grow(&a->xy, &a->cap_nodes, 2 * (n + 1), sizeof *a->xy) ||
        !il_grow(&a->mark, &a->cap_marks, n + 1, sizeof *a->mark))
        return UINT32_MAX;
    a->xy[2 * n] = x;
    a->xy[2 * n + 1] = y;
    a->mark[n] = mark;
    a->n_nodes++;
    return (uint32_t)n;
}

bool il_arrangement_edge(il_arrangement *a, uint32_t from, uint32_t to, uint32_t owner, unsigned char mark)
{
    size_t n = a->n_edges;
    if (!il_grow(&a->edge, &a->cap_edges, 2 * (n + 1), sizeof *a->edge) ||
        !il_grow(&a->owner, &a->cap_owners, n + 1, sizeof *a->owner) ||
        !il_grow(&a->edge_mark, &a->cap_edge_marks, n + 1, sizeof *a->edge_mark))
        return false;
    a->edge[2 * n] = from;
    a->edge[2 * n + 1] = to;
    a->owner[n] = owner;
    a->edge_mark[n] = mark;
    a->n_edges++;
    return true;
}

il_status il_arrangement_from_slice(il_arrangement *a, const il_slice *s, il_error *err)
{
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        uint32_t first = 0, before = 0;
        for (size_t k = 0; k < r->n; k++) {
            unsigned char mark = r->mark ? r->mark[k] & IL_VERTEX_INSERTED : 0;
            uint32_t node = il_arrangement_node(a, r->xy[2 * k], r->xy[2 * k + 1], mark);
            unsigned char edge_mark = r->mark && k > 0 ? r->mark[k - 1] & IL_VERTEX_MAP_EDGE : 0;
            if (node == UINT32_MAX || (k > 0 && !il_arrangement_edge(a, before, node, (uint32_t)i, edge_mark)))
                return il_fail_nomem(err);
            first = k == 0 ? node : first;
            before = node;
        }
        unsigned char last_mark = r->mark && r->n > 0 ? r->mark[r->n - 1] & IL_VERTEX_MAP_EDGE : 0;
        if (r->n > 0 && !il_arrangement_edge(a, before, first, (uint32_t)i, last_mark))
            return il_fail_nomem(err);
    }
    return IL_OK;
}

/* Position of node P along edge E, by the axis in which the edge is longer:
 * for points on the edge that is monotone and needs no arithmetic. */
static double place_along(const il_arrangement *a, uint32_t e, uint32_t p)
{
    const double *from = a->xy + 2 * a->edge[2 * e], *to = a->xy + 2 * a->edge[2 * e + 1];
    double dx = to[0] - from[0], dy = to[1] - from[1];
    size_t axis = fabs(dx) >= fabs(dy) ? 0 : 1;
    return (axis ? dy : dx) > 0 ? a->xy[2 * p + axis] : -a->xy[2 * p + axis];
}

static bool add_cut(cut_list *list, const il_arrangement *a, uint32_t e, uint32_t node)
{
    if (node == a->edge[2 * e] || node == a->edge[2 * e + 1])
        return true;
    if (!il_grow(&list->cut, &list->cap, list->n + 1, sizeof *list->cut))
        return false;
    list->cut[list->n++] = (cut){ e, node, place_along(a, e, node) };
    return true;
}

static double clamp(double v, double a, double b)
{
    return fmin(fmax(v, fmin(a, b)), fmax(a, b));
}

static int compare_points(const double *p, const double *q)
{
    if (p[0] != q[0])
        return p[0] < q[0] ? -1 : 1;
    return p[1] < q[1] ? -1 : p[1] > q[1];
}

static void order(const double **p, const double **q)
{
    if (compare_points(*p, *q) > 0) {
        const double *swap = *p;
        *p = *q, *q = swap;
    }
}

/* Where the edges ab and cd cross, on the grid.  The same to the bit whatever
 * the order of edges and ends. */
static void crossing_point(const double *a, const double *b, const double *c, const double *d, double cell, double out[2])
{
    order(&a, &b);
    order(&c, &d);
    int first = compare_points(a, c) != 0 ? compare_points(a, c) : compare_points(b, d);
    if (first > 0) {
        const double *swap = a;
        a = c, c = swap;
        swap = b;
        b = d, d = swap;
    }
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = d[0] - c[0], vy = d[1] - c[1];
    double det = ux * vy - uy * vx;
    double t = ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / det;
    t = isfinite(t) ? clamp(t, 0, 1) : 0.5;
    out[0] = rint((a[0] + t * ux) / cell) * cell;
    out[1] = rint((a[1] + t * uy) / cell) * cell;
}

/* Is node P nearer to the inside of the edge from A to B than 0.72 cells?  That
 * is a little more than a crossing can be moved (0.7072, half the diagonal).
 * Rounding errs by 2^-53 of the extent, far less than a cell. */
static bool is_near(const il_arrangement *g, uint32_t a, uint32_t b, uint32_t p)
{
    static const double REACH = 0.72;
    const double *pa = g->xy + 2 * a, *pb = g->xy + 2 * b, *pp = g->xy + 2 * p;
    double ux = pb[0] - pa[0], uy = pb[1] - pa[1], px = pp[0] - pa[0], py = pp[1] - pa[1];
    double along = ux * px + uy * py, length2 = ux * ux + uy * uy, area = ux * py - uy * px;
    return along > 0 && along < length2 && area * area < REACH * REACH * g->cell * g->cell * length2;
}

/* Lead edge E through the ends of F that are near it. */
static bool cut_at_ends(const il_arrangement *a, uint32_t e, uint32_t f, cut_list *cuts)
{
    for (size_t k = 0; k < 2; k++) {
        uint32_t node = a->edge[2 * f + k];
        if (node == a->edge[2 * e] || node == a->edge[2 * e + 1] || !is_near(a, a->edge[2 * e], a->edge[2 * e + 1], node))
            continue;
        if (!add_cut(cuts, a, e, node))
            return false;
    }
    return true;
}

static bool cross_properly(const il_arrangement *a, const uint32_t e[2], const uint32_t f[2])
{
    const double *p = a->xy + 2 * e[0], *q = a->xy + 2 * e[1], *r = a->xy + 2 * f[0], *s = a->xy + 2 * f[1];
    if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1])
        return false;
    return il_orientation(p, q, r) * il_orientation(p, q, s) < 0 && il_orientation(r, s, p) * il_orientation(r, s, q) < 0;
}

/* Cut edges E and F where they meet; *N_CROSSINGS or *N_TOUCHES counts it. */
static bool cut_pair(il_arrangement *a, uint32_t e, uint32_t f, cut_list *cuts, size_t *n_crossings, size_t *n_touches)
{
    const uint32_t en[2] = { a->edge[2 * e], a->edge[2 * e + 1] }, fn[2] = { a->edge[2 * f], a->edge[2 * f + 1] };
    size_t before = cuts->n;
    if (!cut_at_ends(a, e, f, cuts) || !cut_at_ends(a, f, e, cuts))
        return false;
    *n_touches += cuts->n > before;
    if (cuts->n > before || !cross_properly(a, en, fn))
        return true;
    double p[2];
    crossing_point(a->xy + 2 * en[0], a->xy + 2 * en[1], a->xy + 2 * fn[0], a->xy + 2 * fn[1], a->cell, p);
    uint32_t node = il_arrangement_node(a, p[0], p[1], IL_VERTEX_INSERTED);
    ++*n_crossings;
    return node != UINT32_MAX && add_cut(cuts, a, e, node) && add_cut(cuts, a, f, node);
}

/* Extent and magnitude of points, from which the cell follows. */
typedef struct spread {
    double low[2], high[2], largest;
} spread;

static const spread NO_SPREAD = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY }, 0 };

static void widen(spread *s, const double *xy, size_t n_points)
{
    for (size_t i = 0; i < 2 * n_points; i++) {
        s->low[i % 2] = fmin(s->low[i % 2], xy[i]);
        s->high[i % 2] = fmax(s->high[i % 2], xy[i]);
        s->largest = fmax(s->largest, fabs(xy[i]));
    }
}

/* A power of two: see arrange.h.  The floor keeps products of four lengths, as
 * in is_near(), clear of underflow, with which edges cross unseen. */
static double cell_of(const spread *s)
{
    double extent = fmax(s->high[0] - s->low[0], s->high[1] - s->low[1]);
    if (!(extent > 0))
        return 0x1p-44;
    return fmax(ldexp(1, (int)fmax(ilogb(extent) - 44, ilogb(s->largest) - 49)), 0x1p-200);
}

double il_slice_cell(const il_slice *slice)
{
    spread s = NO_SPREAD;
    for (size_t i = 0; i < slice->n; i++)
        widen(&s, slice->ring[i].xy, slice->ring[i].n);
    return cell_of(&s);
}

static int compare_cuts(const void *p, const void *q)
{
    const cut *a = p, *b = q;
    if (a->edge != b->edge)
        return a->edge < b->edge ? -1 : 1;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return a->node < b->node ? -1 : a->node > b->node;
}

/* Rewrite the edges with their cuts, in place order. */
static bool apply_cuts(il_arrangement *a, cut_list *cuts)
{
    il_arrangement old = *a;
    a->edge = NULL, a->owner = NULL, a->edge_mark = NULL;
    a->n_edges = a->cap_edges = a->cap_owners = a->cap_edge_marks = 0;
    qsort(cuts->cut, cuts->n, sizeof *cuts->cut, compare_cuts);
    bool ok = true;
    size_t k = 0;
    for (size_t e = 0; e < old.n_edges && ok; e++) {
        uint32_t from = old.edge[2 * e];
        for (; ok && k < cuts->n && cuts->cut[k].edge == e; k++) {
            uint32_t to = cuts->cut[k].node;
            if (to != from)
                ok = il_arrangement_edge(a, from, to, old.owner[e], old.edge_mark[e]);
            from = to;
        }
        ok = ok && il_arrangement_edge(a, from, old.edge[2 * e + 1], old.owner[e], old.edge_mark[e]);
    }
    il_free(old.edge);
    il_free(old.owner);
    il_free(old.edge_mark);
    return ok;
}

static double *edge_boxes(const il_arrangement *a)
{
    double *box = il_alloc(a->n_edges, 4 * sizeof *box);
    for (size_t e = 0; box && e < a->n_edges; e++) {
        const double *p = a->xy + 2 * a->edge[2 * e], *q = a->xy + 2 * a->edge[2 * e + 1];
        box[4 * e] = fmin(p[0], q[0]) - a->cell, box[4 * e + 1] = fmin(p[1], q[1]) - a->cell;
        box[4 * e + 2] = fmax(p[0], q[0]) + a->cell, box[4 * e + 3] = fmax(p[1], q[1]) + a->cell;
    }
    return box;
}

static il_status settle_once(il_arrangement *a, cut_list *cuts, size_t *crossings, size_t *touches, il_error *err)
{
    uint32_t *pair = NULL;
    size_t n_pairs = 0;
    il_status st = IL_OK;
    double *box = edge_boxes(a);
    cuts->n = 0;
    if (!box)
        return il_fail_nomem(err);
    st = il_box_pairs(box, a->n_edges, MAX_PAIRS, &pair, &n_pairs, err);
    for (size_t i = 0; st == IL_OK && i < n_pairs; i++)
        if (!cut_pair(a, pair[2 * i], pair[2 * i + 1], cuts, crossings, touches))
            st = il_fail_nomem(err);
    il_free(pair);
    il_free(box);
    return st;
}

il_status il_arrangement_settle(il_arrangement *a, size_t *crossings, size_t *touches, il_error *err)
{
    cut_list cuts = { NULL, 0, 0 };
    il_status st = IL_OK;
    size_t n_calm = 0;
    *crossings = *touches = 0;
    spread extent = NO_SPREAD;
    widen(&extent, a->xy, a->n_nodes);
    a->cell = cell_of(&extent);
    for (int round = 0;; round++) {
        if (round == CALM_ROUND)
            n_calm = a->n_edges;
        if (round == IL_ARRANGE_ROUNDS || (round > CALM_ROUND && a->n_edges / 2 > n_calm))
            st = il_fail(err, IL_E_INPUT, 0, "the crossings of the contours do not settle");
        if (st == IL_OK)
            st = settle_once(a, &cuts, crossings, touches, err);
        if (st != IL_OK || cuts.n == 0)
            break;
        if (!apply_cuts(a, &cuts))
            st = il_fail_nomem(err);
    }
    il_free(cuts.cut);
    return st;
}
