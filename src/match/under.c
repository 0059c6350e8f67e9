#include "config.h"
#include "match/under.h"
#include "base/alloc.h"
#include "bridge/predicates.h"

#include <math.h>

enum { LEAF = 4, DEEPEST = 64 };

static size_t first_of_leaf(const il_under *u, size_t leaf)
{
    return (size_t)((double)leaf / (double)u->n_leaves * (double)u->n);
}

static void join_boxes(double *to, const double *box)
{
    for (int k = 0; k < 2; k++) {
        to[k] = fmin(to[k], box[k]);
        to[k + 2] = fmax(to[k + 2], box[k + 2]);
    }
}

il_status il_under_make(il_under *u, const double *const *a, const double *const *b, const double *box, size_t n, il_error *err)
{
    *u = (il_under){ a, b, box, n, 1, NULL };
    while (u->n_leaves * LEAF < n)
        u->n_leaves *= 2;
    u->node = il_alloc(2 * u->n_leaves, 4 * sizeof *u->node);
    if (!u->node)
        return il_fail_nomem(err);
    for (size_t k = 2 * u->n_leaves - 1; k-- > 0;) {
        double *node = u->node + 4 * k;
        node[0] = node[1] = INFINITY;
        node[2] = node[3] = -INFINITY;
        if (k + 1 < u->n_leaves) {
            join_boxes(node, u->node + 4 * (2 * k + 1));
            join_boxes(node, u->node + 4 * (2 * k + 2));
            continue;
        }
        size_t leaf = k + 1 - u->n_leaves;
        for (size_t e = first_of_leaf(u, leaf); e < first_of_leaf(u, leaf + 1); e++)
            join_boxes(node, box + 4 * e);
    }
    return IL_OK;
}

void il_under_free(il_under *u)
{
    il_free(u->node);
    *u = (il_under)IL_UNDER_INIT;
}

static const double *left_of(const il_under *u, size_t e)
{
    return u->a[e][0] < u->b[e][0] ? u->a[e] : u->b[e];
}

static const double *right_of(const il_under *u, size_t e)
{
    return u->a[e][0] < u->b[e][0] ? u->b[e] : u->a[e];
}

/* 1 when edge E runs above F where one is above the other, -1 when below, 0 when
 * they are the same: decided by the end that lies between those of the other. */
static int compare_heights(const il_under *u, size_t e, size_t f)
{
    const double *el = left_of(u, e), *er = right_of(u, e), *fl = left_of(u, f), *fr = right_of(u, f);
    int side;
    if (el[0] < fl[0]) {
        side = il_orientation(el, er, fl);
        return -(side != 0 ? side : il_orientation(el, er, fr));
    }
    side = il_orientation(fl, fr, el);
    return side != 0 ? side : il_orientation(fl, fr, er);
}

/* What is asked: below point p, or below edge `edge` (n: none) at p; from the left. */
typedef struct question {
    const double *p;
    size_t edge;
    double top;               /* no edge is looked for that is all above this */
    bool from_left;
} question;

static bool answers(const il_under *u, const question *q, size_t f)
{
    const double *l = left_of(u, f), *r = right_of(u, f);
    double x = q->p[0];
    if (q->from_left ? !(l[0] < x && x <= r[0]) : !(l[0] <= x && x < r[0]))
        return false;
    return q->edge == u->n ? il_orientation(l, r, q->p) > 0 : compare_heights(u, f, q->edge) < 0;
}

/* Can there be an answer in node K that is above edge BEST (n: none)? */
static bool is_promising(const il_under *u, const question *q, size_t k, size_t best)
{
    const double *node = u->node + 4 * k;
    return node[0] <= q->p[0] && q->p[0] <= node[2] && node[1] <= q->top &&
           (best == u->n || node[3] >= u->box[4 * best + 1]);
}

static size_t ask(const il_under *u, const question *q)
{
    size_t stack[DEEPEST], depth = 0, best = u->n;
    for (stack[depth++] = 0; depth > 0;) {
        size_t k = stack[--depth];
        if (!is_promising(u, q, k, best))
            continue;
        if (k + 1 < u->n_leaves) { /* the higher child first: it comes off the stack first */
            bool right_is_higher = u->node[4 * (2 * k + 2) + 3] > u->node[4 * (2 * k + 1) + 3];
            stack[depth++] = 2 * k + 1 + !right_is_higher;
            stack[depth++] = 2 * k + 1 + right_is_higher;
            continue;
        }
        size_t leaf = k + 1 - u->n_leaves;
        for (size_t e = first_of_leaf(u, leaf); e < first_of_leaf(u, leaf + 1); e++)
            if (answers(u, q, e) && (best == u->n || compare_heights(u, e, best) > 0))
                best = e;
    }
    return best;
}

size_t il_under_point(const il_under *u, const double p[2])
{
    const question q = { p, u->n, p[1], false };
    return ask(u, &q);
}

size_t il_under_edge(const il_under *u, size_t e, bool at_right)
{
    const question q = { at_right ? right_of(u, e) : left_of(u, e), e, u->box[4 * e + 3], at_right };
    return ask(u, &q);
}
