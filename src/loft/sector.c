#include "config.h"
#include "loft/sector.h"
#include "base/alloc.h"

#include <string.h>

/* Not yet decided: inside a mixed sector. */
enum { OPEN = 3 };

/* A corner of a triangle: 3 * t + k. */
typedef uint32_t corner;

typedef struct sectors {
    const il_overlay *o;
    il_labels *l;
    corner *run;      /* the corners of the sector at hand, counter-clockwise */
    size_t n, cap;
} sectors;

static corner before(corner c)
{
    return c % 3 == 0 ? c + 2 : c - 1;
}

unsigned char il_edge_plane(const il_overlay *o, uint32_t e)
{
    switch (o->edge[e] & IL_EDGE_CONTOUR) {
    case IL_EDGE_LOWER: return IL_LOWER;
    case IL_EDGE_UPPER: return IL_UPPER;
    default:            return o->inside[e / 3] == IL_EDGE_UPPER ? IL_UPPER : IL_LOWER;
    }
}

static bool collect(sectors *s, corner c)
{
    const il_overlay *o = s->o;
    s->n = 0;
    for (;;) {
        if (!il_grow(&s->run, &s->cap, s->n + 1, sizeof *s->run))
            return false;
        s->run[s->n++] = c;
        corner arriving = before(c);
        if (o->edge[arriving] & IL_EDGE_CONTOUR)
            return true;
        uint32_t t = o->across[arriving], pivot = o->corner[c];
        for (c = 3 * t; o->corner[c] != pivot; c++)
            continue;
    }
}

/* Give the corners before J the start copy, those after it the end copy. */
static void split_at(sectors *s, size_t j, unsigned char start, unsigned char end)
{
    for (size_t i = 0; i < s->n; i++) {
        s->l->out[s->run[i]] = i <= j ? start : end;
        s->l->in[s->run[i]] = i < j ? start : end;
    }
}

/* The place of both copies that leaves the fewest of the sector's inner edges
 * flat, the first such.  Moving it from j to j + 1 gives the edge between these
 * two corners the start copy instead of the end copy.  O(n). */
static size_t best_split(const sectors *s, unsigned char start, unsigned char end)
{
    size_t best = 0, gained = 0, lost = 0; /* flat edges, since the best */
    for (size_t j = 0; j + 1 < s->n; j++) {
        unsigned char far = s->l->out[before(s->run[j])]; /* the edge's other end */
        gained += far == start;
        lost += far == end;
        if (lost > gained) {
            best = j + 1;
            gained = lost = 0;
        }
    }
    return best;
}

/* Pass 0 settles pure sectors and opens mixed ones; pass 1 settles these one
 * after another, each seeing what is settled already. */
static bool settle(sectors *s, int pass)
{
    const il_overlay *o = s->o;
    for (corner c = 0; c < 3 * o->n_triangles; c++) {
        if (!il_overlay_is_sheet(o, c / 3) || !(o->edge[c] & IL_EDGE_CONTOUR))
            continue;
        if (pass == 1 && s->l->out[c] != OPEN)
            continue;
        if (!collect(s, c))
            return false;
        unsigned char start = il_edge_plane(o, c), end = il_edge_plane(o, before(s->run[s->n - 1]));
        if (start == end)
            split_at(s, 0, start, end);
        else if (pass == 0)
            split_at(s, 0, OPEN, OPEN);
        else
            split_at(s, best_split(s, start, end), start, end);
    }
    return true;
}

il_status il_labels_assign(il_labels *l, const il_overlay *o, il_error *err)
{
    sectors s = { o, l, NULL, 0, 0 };
    l->in = il_alloc(o->n_triangles, 3);
    l->out = il_alloc(o->n_triangles, 3);
    bool ok = l->in && l->out;
    if (ok) {
        memset(l->in, IL_FREE, 3 * o->n_triangles);
        memset(l->out, IL_FREE, 3 * o->n_triangles);
        ok = settle(&s, 0) && settle(&s, 1);
    }
    il_free(s.run);
    if (ok)
        return IL_OK;
    il_labels_free(l);
    return il_fail_nomem(err);
}

void il_labels_free(il_labels *l)
{
    il_free(l->in);
    il_free(l->out);
    l->in = l->out = NULL;
}
