#include "config.h"
#include "model/arrange.h"
#include "base/alloc.h"
#include "bridge/boxes.h"
#include "bridge/predicates.h"
#include "model/order.h"
#include "model/ring.h"
#include "model/near.h"

#include <math.h>
#include <stdlib.h>

/* Edges that meet pairwise grow with the square of their number; a drawing
 * with more meetings than this is noise, not contours. */
static const size_t MAX_PAIRS = 50 * 1000 * 1000;

/* Edge runs through NODE; along, its coordinate in the edge's long axis, orders
 * the cuts of one edge. */
typedef struct cut {
    uint32_t edge, node;
    double along;
} cut;

/* The cuts of one round, and what all rounds go by: the nodes by their places;
 * touched[n_input]: the nodes of before that an edge was led through. */
typedef struct settling {
    il_arrangement *a;
    cut *cut;              size_t n_cuts, cap_cuts;
    il_near near;
    bool *touched;
    size_t n_input;
} settling;

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

il_status il_arrangement_from_slice(il_arrangement *a, const il_slice *s, double cell, il_error *err)
{
    a->cell = cell;
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

/* The axis in which edge E is longer: along it nodes on the edge are in order by
 * their coordinates alone, without arithmetic. */
static size_t long_axis(const il_arrangement *a, uint32_t e)
{
    const double *from = a->xy + 2 * a->edge[2 * e], *to = a->xy + 2 * a->edge[2 * e + 1];
    return fabs(to[0] - from[0]) >= fabs(to[1] - from[1]) ? 0 : 1;
}

static bool add_cut(settling *s, uint32_t e, uint32_t node)
{
    const il_arrangement *a = s->a;
    if (node == a->edge[2 * e] || node == a->edge[2 * e + 1])
        return true;
    if (!il_grow(&s->cut, &s->cap_cuts, s->n_cuts + 1, sizeof *s->cut))
        return false;
    s->cut[s->n_cuts++] = (cut){ e, node, a->xy[2 * node + long_axis(a, e)] };
    if (node < s->n_input)
        s->touched[node] = true;
    return true;
}

static double clamp(double v, double a, double b)
{
    return fmin(fmax(v, fmin(a, b)), fmax(a, b));
}

static void order(const double **p, const double **q)
{
    if (il_vertex_compare(*p, *q) > 0) {
        const double *swap = *p;
        *p = *q, *q = swap;
    }
}

/* Where the edges ab and cd cross, in cells, so that the smallest numbers do.
 * The same to the bit whatever the order of edges and ends. */
static void crossing_point(const double *a, const double *b, const double *c, const double *d, double cell, double out[2])
{
    order(&a, &b);
    order(&c, &d);
    int first = il_vertex_compare(a, c) != 0 ? il_vertex_compare(a, c) : il_vertex_compare(b, d);
    if (first > 0) {
        const double *swap = a;
        a = c, c = swap;
        swap = b;
        b = d, d = swap;
    }
    double ux = (b[0] - a[0]) / cell, uy = (b[1] - a[1]) / cell, vx = (d[0] - c[0]) / cell, vy = (d[1] - c[1]) / cell;
    double det = ux * vy - uy * vx;
    double t = ((c[0] - a[0]) / cell * vy - (c[1] - a[1]) / cell * vx) / det;
    t = isfinite(t) ? clamp(t, 0, 1) : 0.5;
    out[0] = a[0] / cell + t * ux;
    out[1] = a[1] / cell + t * uy;
}

/* From A to P in cells. */
static void way(const il_arrangement *g, uint32_t a, uint32_t p, double to[2])
{
    to[0] = (g->xy[2 * p] - g->xy[2 * a]) / g->cell;
    to[1] = (g->xy[2 * p + 1] - g->xy[2 * a + 1]) / g->cell;
}

static double length2(const double u[2])
{
    return u[0] * u[0] + u[1] * u[1];
}

/* Is P nearer to A and to B than they are to each other?  Only then may an edge
 * between them be led through it: so edges grow shorter with every cut, and
 * cutting comes to an end. */
static bool shortens(const il_arrangement *g, uint32_t a, uint32_t b, uint32_t p)
{
    double u[2], v[2], w[2];
    way(g, a, b, u);
    way(g, a, p, v);
    way(g, b, p, w);
    return length2(v) < length2(u) && length2(w) < length2(u);
}

/* Is node P nearer to the inside of the edge from A to B than 0.72 cells?  That
 * is a little more than a crossing can be moved (0.7072, half the diagonal).
 * Rounding errs by 2^-53 of the extent, far less than a cell. */
static bool is_near(const il_arrangement *g, uint32_t a, uint32_t b, uint32_t p)
{
    static const double REACH = 0.72;
    double u[2], v[2];
    way(g, a, b, u);
    way(g, a, p, v);
    double along = u[0] * v[0] + u[1] * v[1], area = u[0] * v[1] - u[1] * v[0];
    return along > 0 && along < length2(u) && area * area < REACH * REACH * length2(u) && shortens(g, a, b, p);
}

/* Lead edge E through the ends of F that are near it. */
static bool cut_at_ends(settling *s, uint32_t e, uint32_t f)
{
    const il_arrangement *a = s->a;
    for (size_t k = 0; k < 2; k++) {
        uint32_t node = a->edge[2 * f + k];
        if (node == a->edge[2 * e] || node == a->edge[2 * e + 1] || !is_near(a, a->edge[2 * e], a->edge[2 * e + 1], node))
            continue;
        if (!add_cut(s, e, node))
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

/* May edge E be led through NODE, or does it end there? */
static bool may_pass(const il_arrangement *a, uint32_t e, uint32_t node)
{
    uint32_t from = a->edge[2 * e], to = a->edge[2 * e + 1];
    return node == from || node == to || shortens(a, from, to, node);
}

/* The node at (X, Y), new if there is none; not at -0. */
static uint32_t node_at(settling *s, double x, double y)
{
    x += 0.0, y += 0.0;
    size_t n = s->a->n_nodes;
    uint32_t node = il_arrangement_node(s->a, x, y, IL_VERTEX_INSERTED);
    return node == UINT32_MAX || node < n || il_near_add(&s->near, x, y) ? node : UINT32_MAX;
}

/* The node for the crossing of edges E and F at P, in cells: one that is near,
 * else one on the grid; where edges are as short as cells, the very point. */
static uint32_t crossing_node(settling *s, uint32_t e, uint32_t f, const double p[2])
{
    const il_arrangement *a = s->a;
    double x = rint(p[0]) * a->cell, y = rint(p[1]) * a->cell;
    uint32_t node = il_near_find(&s->near, x, y);
    if (node == UINT32_MAX)
        node = node_at(s, x, y);
    if (node == UINT32_MAX || (may_pass(a, e, node) && may_pass(a, f, node)))
        return node;
    return node_at(s, p[0] * a->cell, p[1] * a->cell);
}

/* Cut edges E and F where they meet. */
static bool cut_pair(settling *s, uint32_t e, uint32_t f)
{
    const il_arrangement *a = s->a;
    const uint32_t en[2] = { a->edge[2 * e], a->edge[2 * e + 1] }, fn[2] = { a->edge[2 * f], a->edge[2 * f + 1] };
    size_t before = s->n_cuts;
    if (!cut_at_ends(s, e, f) || !cut_at_ends(s, f, e))
        return false;
    if (s->n_cuts > before || !cross_properly(a, en, fn))
        return true;
    double p[2];
    crossing_point(a->xy + 2 * en[0], a->xy + 2 * en[1], a->xy + 2 * fn[0], a->xy + 2 * fn[1], a->cell, p);
    uint32_t node = crossing_node(s, e, f, p);
    return node != UINT32_MAX && add_cut(s, e, node) && add_cut(s, f, node);
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

double il_slice_cell(const il_slice *slice, bool round_float)
{
    spread s = NO_SPREAD;
    for (size_t i = 0; i < slice->n; i++)
        widen(&s, slice->ring[i].xy, slice->ring[i].n);
    if (!(s.largest > 0))
        return 1;
    double extent = fmax(s.high[0] - s.low[0], s.high[1] - s.low[1]);
    int exponent = ilogb(s.largest) - 49;
    if (extent > 0 && ilogb(extent) - 44 > exponent)
        exponent = ilogb(extent) - 44;
    /* the last bits of a float and of a double; and the least numbers of each */
    int least = !round_float ? -1074 : ilogb(s.largest) - 23 > -149 ? ilogb(s.largest) - 23 : -149;
    return ldexp(1, exponent > least ? exponent : least);
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

/* Of the cuts K..END - 1 of edge FROM-TO, in order, keep those that shorten what
 * is left of it each time; the others wait for the next round.  Returns the end
 * of those kept. */
static size_t keep_cuts(settling *s, uint32_t from, uint32_t to, size_t k, size_t end)
{
    size_t kept = k;
    for (; k < end; k++)
        if (shortens(s->a, from, to, s->cut[k].node)) {
            from = s->cut[k].node;
            s->cut[kept++] = s->cut[k];
        }
    return kept;
}

/* Edge FROM-TO of OLD with its cuts K..END - 1 instead of it. */
static bool rewrite_edge(settling *s, const il_arrangement *old, size_t e, size_t k, size_t end)
{
    uint32_t from = old->edge[2 * e], to = old->edge[2 * e + 1];
    size_t axis = long_axis(old, (uint32_t)e);
    bool up = old->xy[2 * from + axis] <= old->xy[2 * to + axis], ok = true;
    size_t n = keep_cuts(s, up ? from : to, up ? to : from, k, end) - k;
    for (size_t i = 0; ok && i < n; i++) {
        uint32_t next = s->cut[up ? k + i : k + n - 1 - i].node;
        ok = il_arrangement_edge(s->a, from, next, old->owner[e], old->edge_mark[e]);
        from = next;
    }
    return ok && il_arrangement_edge(s->a, from, to, old->owner[e], old->edge_mark[e]);
}

/* Rewrite the edges with their cuts, in place order. */
static bool apply_cuts(settling *s)
{
    il_arrangement *a = s->a, old = *a;
    a->edge = NULL, a->owner = NULL, a->edge_mark = NULL;
    a->n_edges = a->cap_edges = a->cap_owners = a->cap_edge_marks = 0;
    qsort(s->cut, s->n_cuts, sizeof *s->cut, compare_cuts);
    bool ok = true;
    for (size_t e = 0, k = 0, end; ok && e < old.n_edges; e++, k = end) {
        for (end = k; end < s->n_cuts && s->cut[end].edge == e; end++)
            continue;
        ok = rewrite_edge(s, &old, e, k, end);
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

static il_status find_cuts(settling *s, il_error *err)
{
    uint32_t *pair = NULL;
    size_t n_pairs = 0;
    double *box = edge_boxes(s->a);
    s->n_cuts = 0;
    if (!box)
        return il_fail_nomem(err);
    il_status st = il_box_pairs(box, s->a->n_edges, MAX_PAIRS, &pair, &n_pairs, err);
    for (size_t i = 0; st == IL_OK && i < n_pairs; i++)
        if (!cut_pair(s, pair[2 * i], pair[2 * i + 1]))
            st = il_fail_nomem(err);
    il_free(pair);
    il_free(box);
    return st;
}

static bool note_nodes(settling *s)
{
    s->near.cell = s->a->cell;
    s->n_input = s->a->n_nodes;
    s->touched = il_calloc(s->n_input, sizeof *s->touched);
    bool ok = s->touched;
    for (size_t i = 0; ok && i < s->n_input; i++)
        ok = il_near_add(&s->near, s->a->xy[2 * i], s->a->xy[2 * i + 1]);
    return ok;
}

il_status il_arrangement_settle(il_arrangement *a, size_t *crossings, size_t *touches, il_error *err)
{
    settling s = { .a = a };
    il_status st = note_nodes(&s) ? IL_OK : il_fail_nomem(err);
    *crossings = *touches = 0;
    for (int round = 0; st == IL_OK; round++) {
        if (round == IL_ARRANGE_ROUNDS)
            st = il_fail(err, IL_E_INPUT, 0, "the crossings of the contours do not settle");
        if (st == IL_OK)
            st = find_cuts(&s, err);
        if (st != IL_OK || s.n_cuts == 0)
            break;
        if (!apply_cuts(&s))
            st = il_fail_nomem(err);
    }
    for (size_t i = 0; st == IL_OK && i < s.n_input; i++)
        *touches += s.touched[i];
    *crossings = a->n_nodes - s.n_input;
    il_free(s.cut);
    il_free(s.touched);
    il_near_free(&s.near);
    return st;
}
