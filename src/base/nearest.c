#include "config.h"
#include "base/nearest.h"
#include "base/alloc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The tree of n segments splits them in halves down to LEAF.  Its boxes lie in
 * depth-first order: a node's own, then those of its left half, then its right;
 * so the place of a child follows from the counts and needs no pointers. */
enum { LEAF = 4 };

/* Halving gives 2^d parts of n >> d segments on level d, some with one more.
 * O(log n): this is asked on every step of a search. */
static size_t boxes_of(size_t n)
{
    size_t boxes = 1, parts = 1, least = n;
    while (least > LEAF) {
        boxes += 2 * parts;
        parts *= 2;
        least = n / parts;
    }
    return least == LEAF ? boxes + 2 * (n % parts) : boxes;
}

static int compare_classes(const void *p, const void *q)
{
    const il_segment *a = p, *b = q;
    return a->class < b->class ? -1 : a->class > b->class;
}

static int compare_in_x(const void *p, const void *q)
{
    const il_segment *a = p, *b = q;
    double d = (a->ax + a->bx) - (b->ax + b->bx);
    return d < 0 ? -1 : d > 0;
}

static int compare_in_y(const void *p, const void *q)
{
    const il_segment *a = p, *b = q;
    double d = (a->ay + a->by) - (b->ay + b->by);
    return d < 0 ? -1 : d > 0;
}

static void bound(double *box, const il_segment *s, size_t n)
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t i = 0; i < n; i++) {
        box[0] = fmin(box[0], fmin(s[i].ax, s[i].bx)), box[2] = fmax(box[2], fmax(s[i].ax, s[i].bx));
        box[1] = fmin(box[1], fmin(s[i].ay, s[i].by)), box[3] = fmax(box[3], fmax(s[i].ay, s[i].by));
    }
}

/* Are the middles of S spread more in x than in y?  Long segments side by side are parted
 * across them so. */
static bool is_wide(const il_segment *s, size_t n)
{
    double box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    for (size_t i = 0; i < n; i++) {
        double x = s[i].ax + s[i].bx, y = s[i].ay + s[i].by;
        box[0] = fmin(box[0], x), box[2] = fmax(box[2], x);
        box[1] = fmin(box[1], y), box[3] = fmax(box[3], y);
    }
    return box[2] - box[0] > box[3] - box[1];
}

static void build(double *box, il_segment *s, size_t n)
{
    bound(box, s, n);
    if (n <= LEAF)
        return;
    qsort(s, n, sizeof *s, is_wide(s, n) ? compare_in_x : compare_in_y);
    build(box + 4, s, n / 2);
    build(box + 4 + 4 * boxes_of(n / 2), s + n / 2, n - n / 2);
}

il_status il_nearest_build(il_nearest *t, il_segment *segment, size_t n, size_t n_classes, il_error *err)
{
    *t = (il_nearest){ segment, NULL, NULL, NULL, n, n_classes };
    t->first = il_alloc(n_classes + 1, sizeof *t->first);
    t->root = il_alloc(n_classes + 1, sizeof *t->root);
    if (!t->first || !t->root)
        goto no_memory;
    if (n > 0)
        qsort(segment, n, sizeof *segment, compare_classes);
    size_t i = 0, n_boxes = 0;
    for (size_t c = 0; c <= n_classes; c++) {
        while (i < n && segment[i].class < c)
            i++;
        t->first[c] = i;
        if (c > 0 && i > t->first[c - 1])
            n_boxes += boxes_of(i - t->first[c - 1]);
        t->root[c] = n_boxes;
    }
    t->box = il_alloc(n_boxes, 4 * sizeof *t->box);
    if (!t->box)
        goto no_memory;
    for (size_t c = 0; c < n_classes; c++)
        if (t->first[c + 1] > t->first[c])
            build(t->box + 4 * t->root[c], segment + t->first[c], t->first[c + 1] - t->first[c]);
    return IL_OK;
no_memory:
    il_nearest_free(t);
    return il_fail_nomem(err);
}

void il_nearest_free(il_nearest *t)
{
    il_free(t->segment);
    il_free(t->box);
    il_free(t->first);
    il_free(t->root);
    *t = (il_nearest){ 0 };
}

/* Where on S the point (X, Y) is nearest. */
static double nearest_t(const il_segment *s, double x, double y)
{
    double ux = s->bx - s->ax, uy = s->by - s->ay, px = x - s->ax, py = y - s->ay;
    double length2 = ux * ux + uy * uy;
    return length2 > 0 ? fmin(fmax((px * ux + py * uy) / length2, 0), 1) : 0;
}

static double segment_distance2(const il_segment *s, double x, double y)
{
    double t = nearest_t(s, x, y);
    double dx = x - s->ax - t * (s->bx - s->ax), dy = y - s->ay - t * (s->by - s->ay);
    return dx * dx + dy * dy;
}

static double box_distance2(const double *box, double x, double y)
{
    double dx = fmax(fmax(box[0] - x, x - box[2]), 0), dy = fmax(fmax(box[1] - y, y - box[3]), 0);
    return dx * dx + dy * dy;
}

/* What is looked for, and the best so far (square of the distance). */
typedef struct search {
    double x, y, dx, dy;
    bool directed;
    double least;
    const il_segment *best;
} search;

static void look_at(search *q, const il_segment *s)
{
    if (q->directed && !((s->bx - s->ax) * q->dx + (s->by - s->ay) * q->dy > 0))
        return;
    double distance2 = segment_distance2(s, q->x, q->y);
    if (distance2 < q->least) {
        q->least = distance2;
        q->best = s;
    }
}

static void look_into(search *q, const double *box, const il_segment *s, size_t n)
{
    if (n <= LEAF) {
        for (size_t i = 0; i < n; i++)
            look_at(q, &s[i]);
        return;
    }
    const double *left = box + 4, *right = left + 4 * boxes_of(n / 2);
    double to_left = box_distance2(left, q->x, q->y), to_right = box_distance2(right, q->x, q->y);
    for (int turn = 0; turn < 2; turn++) {
        bool go_left = (to_left <= to_right) == (turn == 0);
        if ((go_left ? to_left : to_right) >= q->least)
            continue;
        if (go_left)
            look_into(q, left, s, n / 2);
        else
            look_into(q, right, s + n / 2, n - n / 2);
    }
}

static void find(const il_nearest *t, size_t c, search *q)
{
    size_t n = t->first[c + 1] - t->first[c];
    q->least = INFINITY;
    q->best = NULL;
    if (n > 0)
        look_into(q, t->box + 4 * t->root[c], t->segment + t->first[c], n);
}

double il_nearest_distance(const il_nearest *t, size_t c, double x, double y)
{
    search q = { .x = x, .y = y };
    find(t, c, &q);
    return sqrt(q.least);
}

static bool find_place(const il_nearest *t, size_t c, search *q, il_nearest_place *out)
{
    find(t, c, q);
    if (!q->best)
        return false;
    *out = (il_nearest_place){ q->best->id, nearest_t(q->best, q->x, q->y), sqrt(q->least) };
    return true;
}

bool il_nearest_find(const il_nearest *t, size_t c, double x, double y, double dx, double dy, il_nearest_place *out)
{
    search q = { .x = x, .y = y, .dx = dx, .dy = dy, .directed = true };
    return find_place(t, c, &q, out);
}

bool il_nearest_point(const il_nearest *t, size_t c, double x, double y, il_nearest_place *out)
{
    search q = { .x = x, .y = y };
    return find_place(t, c, &q, out);
}

static bool boxes_meet(const double *a, const double *b)
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

/* What is shown: all that meets the box and, if there is one, the segment from `from` to `to`
 * in it. */
typedef struct view {
    double box[4];
    const double *from, *to;
    il_nearest_visitor *visit;
    void *context;
} view;

/* Does B meet what is wanted?  A box lies beside a line by more than it extends across it,
 * and by more than what rounding does. */
static bool meets(const view *v, const double *b)
{
    if (!boxes_meet(b, v->box))
        return false;
    if (!v->from)
        return true;
    double ux = v->to[0] - v->from[0], uy = v->to[1] - v->from[1];
    double along = ux * ((b[1] + b[3]) / 2 - v->from[1]), across = uy * ((b[0] + b[2]) / 2 - v->from[0]);
    double extent = (fabs(ux) * (b[3] - b[1]) + fabs(uy) * (b[2] - b[0])) / 2;
    return fabs(along - across) <= extent + 1e-9 * (extent + fabs(along) + fabs(across));
}

static bool show(const view *v, const double *box, const il_segment *s, size_t n)
{
    if (!meets(v, box))
        return false;
    if (n > LEAF)
        return show(v, box + 4, s, n / 2) || show(v, box + 4 + 4 * boxes_of(n / 2), s + n / 2, n - n / 2);
    for (size_t i = 0; i < n; i++) {
        double own[4];
        bound(own, &s[i], 1);
        if (meets(v, own) && v->visit(v->context, &s[i]))
            return true;
    }
    return false;
}

static bool show_class(const il_nearest *t, size_t c, const view *v)
{
    size_t n = t->first[c + 1] - t->first[c];
    return n > 0 && show(v, t->box + 4 * t->root[c], t->segment + t->first[c], n);
}

bool il_nearest_visit(const il_nearest *t, size_t c, const double box[4], il_nearest_visitor *visit, void *context)
{
    view v = { .visit = visit, .context = context };
    memcpy(v.box, box, sizeof v.box);
    return show_class(t, c, &v);
}

bool il_nearest_visit_along(const il_nearest *t, size_t c, const double from[2], const double to[2],
                            il_nearest_visitor *visit, void *context)
{
    view v = { .from = from, .to = to, .visit = visit, .context = context };
    for (int k = 0; k < 2; k++) {
        v.box[k] = fmin(from[k], to[k]);
        v.box[2 + k] = fmax(from[k], to[k]);
    }
    return show_class(t, c, &v);
}
