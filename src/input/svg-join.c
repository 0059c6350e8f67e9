#include "config.h"
#include "input/svg-join.h"
#include "base/alloc.h"

#include <stdlib.h>
#include <string.h>

/* End 2 k is where ring k begins, end 2 k + 1 where it ends.  mate[e] is the
 * end that e is joined to, or NONE. */
#define NONE ((size_t)-1)

typedef struct end { double x, y; size_t id; } end;

typedef struct joiner {
    il_slice *s;
    end *ends;              /* ends[n_ends], of open rings alone */
    size_t n_ends;
    size_t *mate;           /* mate[2 s->n] */
    unsigned char *done;    /* done[s->n] */
} joiner;

static int compare_ends(const void *pa, const void *pb)
{
    const end *a = pa, *b = pb;
    if (a->x != b->x)
        return a->x < b->x ? -1 : 1;
    if (a->y != b->y)
        return a->y < b->y ? -1 : 1;
    return a->id < b->id ? -1 : a->id > b->id;
}

static void list_ends(joiner *j)
{
    for (size_t k = 0; k < j->s->n; k++) {
        const il_ring *r = &j->s->ring[k];
        if (!r->open)
            continue;
        j->ends[j->n_ends++] = (end){ r->xy[0], r->xy[1], 2 * k };
        j->ends[j->n_ends++] = (end){ r->xy[2 * r->n - 2], r->xy[2 * r->n - 1], 2 * k + 1 };
    }
}

static void pair_ends(joiner *j)
{
    qsort(j->ends, j->n_ends, sizeof *j->ends, compare_ends);
    for (size_t i = 0; i < 2 * j->s->n; i++)
        j->mate[i] = NONE;
    for (size_t i = 0; i + 1 < j->n_ends; i++) {
        const end *a = &j->ends[i], *b = a + 1;
        if (a->x == b->x && a->y == b->y) {
            j->mate[a->id] = b->id;
            j->mate[b->id] = a->id;
            i++;
        }
    }
}

/* From the end of ring K on, line after line: does the chain come back to K's
 * beginning?  Marks what it visits; *LENGTH counts its lines.  A line visited
 * from elsewhere ends the walk, so that all walks together are linear: a cycle
 * would have been visited whole. */
static bool is_cycle(joiner *j, size_t k, size_t *length)
{
    size_t at = 2 * k + 1;
    *length = 0;
    for (;;) {
        j->done[at / 2] = 1;
        ++*length;
        size_t next = j->mate[at];
        if (next == 2 * k)
            return true;
        if (next == NONE || j->done[next / 2])
            return false;
        at = next ^ 1;
    }
}

/* Append R without its first vertex, turned round if BACKWARDS. */
static bool append(il_ring *to, const il_ring *r, bool backwards)
{
    for (size_t i = 1; i < r->n; i++) {
        size_t v = backwards ? r->n - 1 - i : i;
        if (!il_ring_add(to, r->xy[2 * v], r->xy[2 * v + 1], 0))
            return false;
    }
    return true;
}

/* Make ring K the whole cycle; the other lines are emptied. */
static bool weld(joiner *j, size_t k)
{
    il_ring *whole = &j->s->ring[k];
    size_t at = j->mate[2 * k + 1];
    while (at != 2 * k) {
        il_ring *r = &j->s->ring[at / 2];
        if (!append(whole, r, at % 2 == 1))
            return false;
        il_ring_free(r);
        at = j->mate[at ^ 1];
    }
    whole->n--; /* the last vertex is the first again */
    whole->open = false;
    return true;
}

static bool weld_cycles(joiner *j, il_svg_joined *count)
{
    for (size_t k = 0; k < j->s->n; k++) {
        size_t length;
        if (!j->s->ring[k].open || j->done[k] || !is_cycle(j, k, &length))
            continue;
        if (!weld(j, k))
            return false;
        count->n_joined += length;
    }
    return true;
}

/* What is left open is closed, or bounds nothing; emptied rings go. */
static void settle(il_slice *s, il_svg_joined *count)
{
    size_t kept = 0;
    for (size_t k = 0; k < s->n; k++) {
        il_ring *r = &s->ring[k];
        if (r->open && r->n < 3) {
            if (count->n_dropped++ == 0)
                count->dropped_line = r->line;
            il_ring_free(r);
        } else if (r->open) {
            count->n_closed++;
            r->open = false;
        }
        if (r->n > 0) {
            il_ring moved = *r;
            *r = (il_ring)IL_RING_INIT;
            s->ring[kept++] = moved;
        }
    }
    s->n = kept;
}

il_status il_svg_join(il_slice *s, il_svg_joined *count, il_error *err)
{
    size_t n_open = 0;
    for (size_t k = 0; k < s->n; k++)
        n_open += s->ring[k].open ? 1 : 0;
    if (n_open == 0)
        return IL_OK;
    il_status st = IL_OK;
    joiner j = { s, il_alloc(2 * n_open, sizeof(end)), 0, il_alloc(s->n, 2 * sizeof(size_t)), il_calloc(s->n, 1) };
    if (!j.ends || !j.mate || !j.done) {
        st = il_fail_nomem(err);
        goto done;
    }
    list_ends(&j);
    pair_ends(&j);
    if (!weld_cycles(&j, count))
        st = il_fail_nomem(err);
    else
        settle(s, count);
done:
    il_free(j.ends);
    il_free(j.mate);
    il_free(j.done);
    return st;
}
