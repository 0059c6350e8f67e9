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
