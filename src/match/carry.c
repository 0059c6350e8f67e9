#include "config.h"
#include "match/carry.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "base/number.h"

#include <stdlib.h>
#include <string.h>

enum { NONE = UINT32_MAX };

/* Of one slice: ring i of WAS goes on in to[i], and in from[i], next[from[i]] and so on, the rings
 * that are mostly of it; NONE ends. */
typedef struct heirs {
    uint32_t *to, *from, *next;
} heirs;

static void heirs_free(heirs *h)
{
    il_free(h->to);
    il_free(h->from);
    il_free(h->next);
}

/* ---- which ring goes on in which -------------------------------------------------------- */

static uint64_t half_key(double x)
{
    return il_keymap_double(il_number_round_float(x));
}

/* The ring at each vertex, of those that turn like SIGN. */
static bool map_vertices(il_keymap *at, const il_slice *s, bool outer)
{
    bool ok = il_keymap_reserve(at, il_slice_points(s));
    for (uint32_t i = 0; i < s->n && ok; i++) {
        const il_ring *r = &s->ring[i];
        for (size_t v = 0; (il_ring_area2(r) > 0) == outer && v < r->n && ok; v++)
            ok = il_keymap_put(at, half_key(r->xy[2 * v]), half_key(r->xy[2 * v + 1]), i) != NULL;
    }
    return ok;
}

/* The ring of AT that has most vertices of R, the first of several; NONE when none has any.
 * votes[]: zero, and again zero. */
static uint32_t elect(const il_keymap *at, const il_ring *r, size_t *votes)
{
    uint32_t best = NONE;
    for (int pass = 0; pass < 2; pass++) /* count, and look and forget */
        for (size_t v = 0; v < r->n; v++) {
            uint32_t i = il_keymap_get(at, half_key(r->xy[2 * v]), half_key(r->xy[2 * v + 1]), NONE);
            if (i == NONE)
                continue;
            if (pass == 0)
                votes[i]++;
            if (pass == 0 && (best == NONE || votes[i] > votes[best] || (votes[i] == votes[best] && i < best)))
                best = i;
            if (pass == 1)
                votes[i] = 0;
        }
    return best;
}

/* For each ring of A that turns like OUTER the one of B that has most of it. */
static il_status elect_all(uint32_t *of, const il_slice *a, const il_slice *b, bool outer, il_error *err)
{
    il_keymap at = IL_KEYMAP_INIT;
    size_t *votes = il_calloc(b->n, sizeof *votes);
    bool ok = votes && map_vertices(&at, b, outer);
    for (size_t i = 0; i < a->n && ok; i++)
        if ((il_ring_area2(&a->ring[i]) > 0) == outer)
            of[i] = elect(&at, &a->ring[i], votes);
    il_free(votes);
    il_keymap_free(&at);
    return ok ? IL_OK : il_fail_nomem(err);
}

static il_status find_heirs(heirs *h, const il_slice *was, const il_slice *is, il_error *err)
{
    uint32_t *origin = il_alloc(is->n, sizeof *origin);
    h->to = il_alloc(was->n, sizeof *h->to);
    h->from = il_alloc(was->n, sizeof *h->from);
    h->next = il_alloc(is->n, sizeof *h->next);
    il_status st = origin && h->to && h->from && h->next ? IL_OK : il_fail_nomem(err);
    for (int outer = 0; outer < 2 && st == IL_OK; outer++) {
        st = elect_all(h->to, was, is, outer, err);
        if (st == IL_OK)
            st = elect_all(origin, is, was, outer, err);
    }
    for (size_t i = 0; i < was->n && st == IL_OK; i++)
        h->from[i] = NONE;
    for (uint32_t i = 0; i < is->n && st == IL_OK; i++) {
        if (origin[i] == NONE)
            continue;
        h->next[i] = h->from[origin[i]];
        h->from[origin[i]] = i;
    }
    il_free(origin);
    return st;
}

/* ---- links -------------------------------------------------------------------------------- */

typedef struct links {
    il_link *link;
    size_t n, cap;
} links;

static bool add(links *l, il_link link)
{
    if (!il_grow(&l->link, &l->cap, l->n + 1, sizeof *l->link))
        return false;
    l->link[l->n++] = link;
    return true;
}

/* From each heir of its lower ring to each of its upper one: the elected, then the others. */
static bool add_heirs(links *l, const heirs h[2], const il_link *was)
{
    bool ok = true;
    for (uint32_t a = h[0].to[was->lower], i = h[0].from[was->lower]; a != NONE && ok; a = i, i = i == NONE ? NONE : h[0].next[i])
        for (uint32_t b = h[1].to[was->upper], k = h[1].from[was->upper]; b != NONE && ok; b = k, k = k == NONE ? NONE : h[1].next[k])
            ok = add(l, (il_link){ a, b, was->reason, was->reach });
    return ok;
}

static bool add_group(links *l, const heirs h[2], const il_group *g)
{
    bool ok = true;
    for (size_t i = 0; i < g->n_links && ok; i++)
        ok = add_heirs(l, h, &g->link[i]);
    if (g->n_links > 0 || g->n_lower == 0 || g->n_upper == 0)
        return ok;
    for (size_t i = 0; i < g->n_lower && ok; i++)
        ok = add_heirs(l, h, &(il_link){ g->lower[i], g->upper[0], IL_LINK_OVERLAP, 0 });
    for (size_t i = 1; i < g->n_upper && ok; i++)
        ok = add_heirs(l, h, &(il_link){ g->lower[0], g->upper[i], IL_LINK_OVERLAP, 0 });
    return ok;
}

static int compare_links(const void *pa, const void *pb)
{
    const il_link *a = pa, *b = pb;
    if (a->lower != b->lower)
        return a->lower < b->lower ? -1 : 1;
    if (a->upper != b->upper)
        return a->upper < b->upper ? -1 : 1;
    if (a->reason != b->reason)
        return a->reason < b->reason ? -1 : 1;
    return (a->reach > b->reach) - (a->reach < b->reach);
}

/* Of links between the same rings the first reason stays. */
static void sort_links(links *l)
{
    size_t n = 0;
    if (l->n > 1)
        qsort(l->link, l->n, sizeof *l->link, compare_links);
    for (size_t i = 0; i < l->n; i++)
        if (n == 0 || l->link[i].lower != l->link[n - 1].lower || l->link[i].upper != l->link[n - 1].upper)
            l->link[n++] = l->link[i];
    l->n = n;
}

il_status il_links_carry(const il_pair *p, const il_slice was[2], const il_slice is[2], il_link **link, size_t *n, il_error *err)
{
    heirs h[2] = { { NULL, NULL, NULL }, { NULL, NULL, NULL } };
    links l = { NULL, 0, 0 };
    il_status st = IL_OK;
    for (int side = 0; side < 2 && st == IL_OK; side++)
        st = find_heirs(&h[side], &was[side], &is[side], err);
    bool ok = true;
    for (size_t i = 0; i < p->n_groups && st == IL_OK && ok; i++)
        ok = add_group(&l, h, &p->group[i]);
    if (!ok)
        st = il_fail_nomem(err);
    sort_links(&l);
    if (st != IL_OK)
        il_free(l.link);
    *link = st == IL_OK ? l.link : NULL;
    *n = st == IL_OK ? l.n : 0;
    heirs_free(&h[0]);
    heirs_free(&h[1]);
    return st;
}
