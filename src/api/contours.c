#include "config.h"
#include "api/contours.h"
#include "base/alloc.h"

#include <math.h>
#include <stdlib.h>

/* What a contour is sorted by; index settles ties, so that the order is total. */
typedef struct entry {
    long stack;
    double z;
    size_t index;
} entry;

static int compare(const void *a, const void *b)
{
    const entry *p = a, *q = b;
    if (p->stack != q->stack)
        return p->stack < q->stack ? -1 : 1;
    if (p->z != q->z)
        return p->z < q->z ? -1 : 1;
    return p->index < q->index ? -1 : p->index > q->index;
}

static bool is_usable(double v)
{
    return fabs(v) < 1e15; /* false for a NaN */
}

static il_status check(const il_contour *c, size_t index, il_error *err)
{
    bool good = is_usable(c->z) && (c->xy || c->n == 0) && c->n <= SIZE_MAX / 2;
    for (size_t i = 0; good && i < 2 * c->n; i++)
        good = is_usable(c->xy[i]);
    return good ? IL_OK
                : il_fail(err, IL_E_INPUT, 0, "contour %zu has a number that is not finite or not below 1e15", index);
}

static il_status add_ring(il_slice *s, const il_contour *c, il_error *err)
{
    il_ring *r = il_slice_add_ring(s);
    bool fits = r != NULL;
    for (size_t i = 0; fits && i < c->n; i++)
        fits = il_ring_add(r, c->xy[2 * i], c->xy[2 * i + 1], 0);
    return fits ? IL_OK : il_fail_nomem(err);
}

/* The slice of E[0..N): all of the same stack and height. */
static il_status send_slice(const il_contour *contour, const entry *e, size_t n, il_sink *sink, il_error *err)
{
    il_slice s = IL_SLICE_INIT;
    s.z = e[0].z;
    il_status st = IL_OK;
    for (size_t i = 0; i < n && st == IL_OK; i++)
        st = add_ring(&s, &contour[e[i].index], err);
    if (st == IL_OK)
        st = sink->slice(sink, &s, err);
    il_slice_free(&s);
    return st;
}

/* The stack of E[0..N). */
static il_status send_stack(const il_contour *contour, const entry *e, size_t n, il_unit unit, il_sink *sink,
                            il_error *err)
{
    il_stack_head head = IL_STACK_HEAD_INIT;
    head.kind = IL_KIND_SOLID;
    head.unit = unit;
    head.has_number = e[0].stack != 0;
    head.number = e[0].stack;
    il_status st = sink->stack_begin(sink, &head, err);
    for (size_t i = 0, k; i < n && st == IL_OK; i = k) {
        for (k = i + 1; k < n && e[k].z == e[i].z; k++) {}
        st = send_slice(contour, e + i, k - i, sink, err);
    }
    if (st == IL_OK)
        st = sink->stack_end(sink, err);
    il_stack_head_free(&head);
    return st;
}

il_status il_contours_send(const il_contour *contour, size_t n, il_unit unit, il_sink *sink, il_error *err)
{
    entry *e = il_alloc(n, sizeof *e);
    il_status st = e ? IL_OK : il_fail_nomem(err);
    for (size_t i = 0; i < n && st == IL_OK; i++) {
        st = check(&contour[i], i, err);
        e[i] = (entry){ contour[i].stack, contour[i].z, i };
    }
    if (st == IL_OK)
        qsort(e, n, sizeof *e, compare);
    for (size_t i = 0, k; i < n && st == IL_OK; i = k) {
        for (k = i + 1; k < n && e[k].stack == e[i].stack; k++) {}
        st = send_stack(contour, e + i, k - i, unit, sink, err);
    }
    if (st == IL_OK)
        st = sink->end(sink, err);
    il_free(e);
    return st;
}
