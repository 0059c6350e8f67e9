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

static bool in_box(const double *p, const double *a, const double *b)
{
    return fmin(a[0], b[0]) <= p[0] && p[0] <= fmax(a[0], b[0]) &&
           fmin(a[1], b[1]) <= p[1] && p[1] <= fmax(a[1], b[1]);
}

static double clamp(double v, double a, double b)
{
    return fmin(fmax(v, fmin(a, b)), fmax(a, b));
}

/* Where the lines ab and cd cross, rounded, kept inside the box of ab. */
static void crossing_point(const double *a, const double *b, const double *c, const double *d, double out[2])
{
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = d[0] - c[0], vy = d[1] - c[1];
    double det = ux * vy - uy * vx;
    double t = ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / det;
    t = isfinite(t) ? clamp(t, 0, 1) : 0.5;
    out[0] = clamp(a[0] + t * ux, a[0], b[0]);
    out[1] = clamp(a[1] + t * uy, a[1], b[1]);
}

/* Cut edges E and F where they meet; *N_CROSSINGS or *N_TOUCHES counts it. */
static bool cut_pair(il_arrangement *a, uint32_t e, uint32_t f, cut_list *cuts, size_t *n_crossings, size_t *n_touches)
{
    const uint32_t *en = a->edge + 2 * e, *fn = a->edge + 2 * f;
    int side_f[2], side_e[2]; /* of f's ends from e, and the other way */
    bool touch = false;
    for (int k = 0; k < 2; k++) {
        side_f[k] = fn[k] == en[0] || fn[k] == en[1] ? 0
                  : il_orientation(a->xy + 2 * en[0], a->xy + 2 * en[1], a->xy + 2 * fn[k]);
        if (side_f[k] == 0 && fn[k] != en[0] && fn[k] != en[1] &&
            in_box(a->xy + 2 * fn[k], a->xy + 2 * en[0], a->xy + 2 * en[1])) {
            touch = true;
            if (!add_cut(cuts, a, e, fn[k]))
                return false;
        }
    }
    if (side_f[0] == side_f[1] && side_f[0] != 0)
        return true;
    for (int k = 0; k < 2; k++) {
        side_e[k] = en[k] == fn[0] || en[k] == fn[1] ? 0
                  : il_orientation(a->xy + 2 * fn[0], a->xy + 2 * fn[1], a->xy + 2 * en[k]);
        if (side_e[k] == 0 && en[k] != fn[0] && en[k] != fn[1] &&
            in_box(a->xy + 2 * en[k], a->xy + 2 * fn[0], a->xy + 2 * fn[1])) {
            touch = true;
            if (!add_cut(cuts, a, f, en[k]))
                return false;
        }
    }
    *n_touches += touch;
    if (side_f[0] * side_f[1] >= 0 || side_e[0] * side_e[1] >= 0)
        return true;
    double p[2];
    crossing_point(a->xy + 2 * en[0], a->xy + 2 * en[1], a->xy + 2 * fn[0], a->xy + 2 * fn[1], p);
    uint32_t node = il_arrangement_node(a, p[0], p[1], IL_VERTEX_INSERTED);
    ++*n_crossings;
    return node != UINT32_MAX && add_cut(cuts, a, e, node) && add_cut(cuts, a, f, node);
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
        box[4 * e] = fmin(p[0], q[0]), box[4 * e + 1] = fmin(p[1], q[1]);
        box[4 * e + 2] = fmax(p[0], q[0]), box[4 * e + 3] = fmax(p[1], q[1]);
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
    *crossings = *touches = 0;
    for (int round = 0;; round++) {
        if (round == IL_ARRANGE_ROUNDS)
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
