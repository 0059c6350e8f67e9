/* join-edges.c - edges that come more than once, found by hashing.
 *
 * Nearly all edges of a map come once, and a table of all of them would
 * not stay in the cache.  So two bits a hash say first whether an edge may have come
 * before, with 16 hashes an edge; the few that may go into a table with their ends. */
#include "config.h"
#include "region/join-edges.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "model/order.h"

#include <string.h>

/* An edge that may be shared, where it came. */
typedef struct occurrence { uint32_t line, vertex, edge; } occurrence;

/* edge: index + 1, 0 for a free slot. */
typedef struct slot { uint64_t hash; uint32_t edge; } slot;

/* hash[n]: of all edges, line by line.  seen, again: bit h is set when an edge with
 * that hash came, and when another did. */
typedef struct search {
    const il_slice *slice;
    il_shared_edges *out;
    uint64_t *hash, *seen, *again;
    size_t n, n_again, bits;
    slot *table;
    size_t size;
    occurrence *found;
    size_t n_found;
} search;

static size_t edges_of(const il_ring *r)
{
    return r->open ? r->n - 1 : r->n;
}

static const double *end_of(const il_ring *r, size_t v)
{
    return r->xy + 2 * (v + 1 < r->n ? v + 1 : 0);
}

/* ---- edges that may have come before ------------------------------------------- */

/* The address makes hashes of a run its own, so that no file can be made to have
 * them all alike. */
static uint64_t hash_point(const double *p, uint64_t salt)
{
    return il_keymap_mix(il_keymap_mix(il_keymap_double(p[0]) ^ salt) + il_keymap_double(p[1]));
}

/* The sum does not tell the direction. */
static void hash_line(const il_ring *r, uint64_t salt, uint64_t *to)
{
    uint64_t first = hash_point(r->xy, salt), before = first;
    for (size_t v = 1; v < r->n; v++) {
        uint64_t here = hash_point(r->xy + 2 * v, salt);
        *to++ = il_keymap_mix(before + here);
        before = here;
    }
    if (!r->open)
        *to = il_keymap_mix(before + first);
}

static void mark_hashes(search *s)
{
    for (size_t i = 0; i < s->n; i++) {
        uint64_t h = s->hash[i] & (s->bits - 1), bit = UINT64_C(1) << (h & 63);
        s->again[h >> 6] |= s->seen[h >> 6] & bit;
        s->seen[h >> 6] |= bit;
    }
}

static bool may_be_shared(const search *s, uint64_t hash)
{
    uint64_t h = hash & (s->bits - 1);
    return s->again[h >> 6] >> (h & 63) & 1;
}

static size_t power_of_two_from(size_t n)
{
    size_t p = 64;
    while (p < n)
        p *= 2;
    return p;
}

static bool hash_all(search *s)
{
    s->bits = power_of_two_from(16 * s->n);
    s->hash = il_alloc(s->n, sizeof *s->hash);
    s->seen = il_calloc(s->bits / 64, sizeof *s->seen);
    s->again = il_calloc(s->bits / 64, sizeof *s->again);
    if (!s->hash || !s->seen || !s->again)
        return false;
    uint64_t *to = s->hash;
    for (size_t l = 0; l < s->slice->n; l++) {
        hash_line(&s->slice->ring[l], (uintptr_t)s->hash, to);
        to += edges_of(&s->slice->ring[l]);
    }
    mark_hashes(s);
    for (size_t i = 0; i < s->n; i++)
        s->n_again += may_be_shared(s, s->hash[i]);
    return true;
}

/* ---- and those that did ---------------------------------------------------------- */

static bool same_edge(const double *a, const double *b, const double *c, const double *d)
{
    return (il_vertex_compare(a, c) == 0 && il_vertex_compare(b, d) == 0) ||
           (il_vertex_compare(a, d) == 0 && il_vertex_compare(b, c) == 0);
}

/* The index of edge V of line L among those in the table, new or not. */
static uint32_t find_edge(search *s, uint32_t l, uint32_t v, uint64_t hash)
{
    const il_ring *r = &s->slice->ring[l];
    const double *a = r->xy + 2 * (size_t)v, *b = end_of(r, v);
    size_t i = (hash >> 7) & (s->size - 1);
    for (; s->table[i].edge; i = (i + 1) & (s->size - 1)) {
        const il_shared_edge *e = &s->out->edge[s->table[i].edge - 1];
        const il_ring *other = &s->slice->ring[e->line];
        if (s->table[i].hash == hash && same_edge(a, b, other->xy + 2 * (size_t)e->vertex, end_of(other, e->vertex)))
            return s->table[i].edge - 1;
    }
    s->out->edge[s->out->n] = (il_shared_edge){ .line = l, .vertex = v, .is_within = true, .next = { IL_NO_EDGE, IL_NO_EDGE } };
    s->table[i] = (slot){ hash, (uint32_t)++s->out->n };
    return s->table[i].edge - 1;
}

static void take_edge(search *s, uint32_t l, uint32_t v, uint64_t hash)
{
    const il_ring *r = &s->slice->ring[l];
    uint32_t at = find_edge(s, l, v, hash);
    il_shared_edge *e = &s->out->edge[at];
    e->is_within &= e->line == l;
    e->is_shared |= e->line != l || e->vertex != v;
    e->net += il_vertex_compare(r->xy + 2 * (size_t)v, end_of(r, v)) < 0 ? 1 : -1;
    s->found[s->n_found++] = (occurrence){ l, v, at };
}

static bool tell_apart(search *s)
{
    s->size = power_of_two_from(2 * s->n_again);
    s->table = il_calloc(s->size, sizeof *s->table);
    s->found = il_alloc(s->n_again, sizeof *s->found);
    s->out->edge = il_alloc(s->n_again, sizeof *s->out->edge);
    if (!s->table || !s->found || !s->out->edge)
        return false;
    const uint64_t *hash = s->hash;
    for (uint32_t l = 0; l < s->slice->n; l++)
        for (uint32_t v = 0, n = (uint32_t)edges_of(&s->slice->ring[l]); v < n; v++, hash++)
            if (may_be_shared(s, *hash))
                take_edge(s, l, v, *hash);
    return true;
}

/* ---- by line ----------------------------------------------------------------------- */

static bool tell_line(il_shared_edges *out, const il_slice *s, const occurrence *o)
{
    if (!out->of) {
        out->of = il_calloc(s->n, sizeof *out->of);
        out->n_lines = s->n;
    }
    if (out->of && !out->of[o->line]) {
        size_t n = s->ring[o->line].n;
        out->of[o->line] = il_alloc(n, sizeof **out->of);
        if (out->of[o->line])
            memset(out->of[o->line], 0xFF, n * sizeof **out->of); /* IL_NO_EDGE */
    }
    if (!out->of || !out->of[o->line])
        return false;
    out->of[o->line][o->vertex] = o->edge;
    return true;
}

static bool tell_lines(search *s)
{
    for (size_t i = 0; i < s->n_found; i++)
        if (s->out->edge[s->found[i].edge].is_shared && !tell_line(s->out, s->slice, &s->found[i]))
            return false;
    return true;
}

il_status il_shared_edges_find(il_shared_edges *out, const il_slice *slice, il_error *err)
{
    search s = { .slice = slice, .out = out };
    *out = (il_shared_edges)IL_SHARED_EDGES_INIT;
    for (size_t l = 0; l < slice->n; l++)
        s.n += edges_of(&slice->ring[l]);
    if (s.n >= IL_NO_EDGE)
        return il_fail(err, IL_E_INPUT, slice->line, "more than %u edges at one height", IL_NO_EDGE - 1);
    bool ok = hash_all(&s) && (s.n_again == 0 || (tell_apart(&s) && tell_lines(&s)));
    il_free(s.hash);
    il_free(s.seen);
    il_free(s.again);
    il_free(s.table);
    il_free(s.found);
    if (ok)
        return IL_OK;
    il_shared_edges_free(out);
    return il_fail_nomem(err);
}

void il_shared_edges_free(il_shared_edges *e)
{
    for (size_t l = 0; l < e->n_lines && e->of; l++)
        il_free(e->of[l]);
    il_free(e->of);
    il_free(e->edge);
    *e = (il_shared_edges)IL_SHARED_EDGES_INIT;
}
