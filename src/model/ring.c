#include "config.h"
#include "model/ring.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

void il_ring_free(il_ring *r)
{
    il_free(r->xy);
    il_free(r->mark);
    il_extra_free(&r->extra);
    *r = (il_ring)IL_RING_INIT;
}

/* Marks are rare: the array appears with the first one. */
static bool add_mark(il_ring *r, unsigned char mark)
{
    if (!r->mark && mark == 0)
        return true;
    size_t before = r->mark ? r->n : 0;
    if (!il_grow(&r->mark, &r->cap_mark, r->n + 1, sizeof *r->mark))
        return false;
    memset(r->mark + before, 0, r->n - before);
    r->mark[r->n] = mark;
    return true;
}

bool il_ring_add(il_ring *r, double x, double y, unsigned char mark)
{
    if (!il_grow(&r->xy, &r->cap, r->n + 1, 2 * sizeof *r->xy) || !add_mark(r, mark))
        return false;
    r->xy[2 * r->n] = x;
    r->xy[2 * r->n + 1] = y;
    r->n++;
    return true;
}

double il_ring_area2(const il_ring *r)
{
    double sum = 0;
    for (size_t i = 1; i + 1 < r->n; i++) {
        double ax = r->xy[2 * i] - r->xy[0], ay = r->xy[2 * i + 1] - r->xy[1];
        double bx = r->xy[2 * i + 2] - r->xy[0], by = r->xy[2 * i + 3] - r->xy[1];
        sum += ax * by - ay * bx;
    }
    return sum;
}

static double distance(const il_ring *r, size_t i, size_t j)
{
    double dx = r->xy[2 * j] - r->xy[2 * i], dy = r->xy[2 * j + 1] - r->xy[2 * i + 1];
    return sqrt(dx * dx + dy * dy);
}

double il_ring_length(const il_ring *r)
{
    double sum = 0;
    for (size_t i = 0; i + 1 < r->n; i++)
        sum += distance(r, i, i + 1);
    if (!r->open && r->n > 1)
        sum += distance(r, r->n - 1, 0);
    return sum;
}

/* Turn the vertices FROM..TO-1 round, marks with them. */
static void reverse_range(il_ring *r, size_t from, size_t to)
{
    for (; from + 1 < to; from++, to--) {
        for (size_t k = 0; k < 2; k++) {
            double c = r->xy[2 * from + k];
            r->xy[2 * from + k] = r->xy[2 * (to - 1) + k];
            r->xy[2 * (to - 1) + k] = c;
        }
        if (r->mark) {
            unsigned char m = r->mark[from];
            r->mark[from] = r->mark[to - 1];
            r->mark[to - 1] = m;
        }
    }
}

/* Behind a reversal the edge marks stand at their edges' ends: give each to the
 * vertex before it, which is where the edge now begins. */
static void move_edge_marks_back(il_ring *r)
{
    if (!r->mark || r->n == 0)
        return;
    unsigned char first = r->mark[0] & IL_VERTEX_MAP_EDGE;
    for (size_t i = 0; i < r->n; i++) {
        unsigned char next = i + 1 < r->n ? r->mark[i + 1] & IL_VERTEX_MAP_EDGE : first;
        r->mark[i] = (unsigned char)((r->mark[i] & ~IL_VERTEX_MAP_EDGE) | next);
    }
}

void il_ring_reverse(il_ring *r)
{
    reverse_range(r, r->open || r->n == 0 ? 0 : 1, r->n);
    move_edge_marks_back(r);
}

void il_ring_rotate(il_ring *r, size_t k)
{
    reverse_range(r, 0, k);
    reverse_range(r, k, r->n);
    reverse_range(r, 0, r->n);
}

static bool same_point(const il_ring *r, size_t i, size_t j)
{
    return r->xy[2 * i] == r->xy[2 * j] && r->xy[2 * i + 1] == r->xy[2 * j + 1];
}

/* Vertex TO stands for vertex K as well, behind which its edge begins now. */
static void join_marks(il_ring *r, size_t to, size_t k)
{
    if (r->mark)
        r->mark[to] = (unsigned char)((r->mark[to] & r->mark[k] & IL_VERTEX_INSERTED) | (r->mark[k] & IL_VERTEX_MAP_EDGE));
}

static void move_vertex(il_ring *r, size_t to, size_t from)
{
    if (to == from)
        return;
    memmove(r->xy + 2 * to, r->xy + 2 * from, 2 * sizeof *r->xy);
    if (r->mark)
        r->mark[to] = r->mark[from];
}

size_t il_ring_drop_repeated(il_ring *r)
{
    size_t n = 0, before = r->n;
    for (size_t i = 0; i < r->n; i++) {
        if (n > 0 && same_point(r, i, n - 1))
            join_marks(r, n - 1, i);
        else
            move_vertex(r, n++, i);
    }
    if (!r->open && n > 1 && same_point(r, 0, n - 1)) {
        n--;
        if (r->mark)
            r->mark[0] &= (unsigned char)(r->mark[n] | IL_VERTEX_MAP_EDGE);
    }
    r->n = n;
    return before - n;
}

/* Is there a vertex whose neighbours are one place? */
static bool has_spike(const il_ring *r)
{
    for (size_t i = 2; i < r->n; i++)
        if (same_point(r, i, i - 2))
            return true;
    return !r->open && r->n > 2 && (same_point(r, r->n - 1, 1) || same_point(r, r->n - 2, 0));
}

/* Spikes around the first vertex of a ring that has no others. */
static void drop_spikes_at_start(il_ring *r)
{
    size_t first = 0, n = r->n;
    while (n > 2 && (same_point(r, first + n - 2, first) || same_point(r, first + 1, first + n - 1))) {
        if (same_point(r, first + n - 2, first)) {
            if (r->mark)
                r->mark[first] &= (unsigned char)(r->mark[first + n - 2] | IL_VERTEX_MAP_EDGE);
        } else {
            join_marks(r, first + n - 1, first + 1);
            move_vertex(r, first + 1, first + n - 1);
            first++;
        }
        n -= 2;
    }
    for (size_t i = 0; i < n; i++)
        move_vertex(r, i, first + i);
    r->n = n;
}

size_t il_ring_drop_spikes(il_ring *r)
{
    size_t n = 0, before = r->n;
    if (!has_spike(r))
        return 0;
    for (size_t i = 0; i < r->n; i++) {
        if (n > 1 && same_point(r, i, n - 2))
            join_marks(r, --n - 1, i);
        else
            move_vertex(r, n++, i);
    }
    r->n = n;
    if (!r->open)
        drop_spikes_at_start(r);
    return (before - r->n) / 2;
}

bool il_extra_add(il_extra **list, const char *text, size_t n)
{
    il_extra *e = il_alloc(1, sizeof *e);
    if (!e)
        return false;
    e->text = il_strndup(text, n);
    e->next = NULL;
    if (!e->text) {
        il_free(e);
        return false;
    }
    il_extra_move(list, &e);
    return true;
}

void il_extra_move(il_extra **to, il_extra **from)
{
    while (*to)
        to = &(*to)->next;
    *to = *from;
    *from = NULL;
}

void il_extra_free(il_extra **list)
{
    while (*list) {
        il_extra *e = *list;
        *list = e->next;
        il_free(e->text);
        il_free(e);
    }
}
