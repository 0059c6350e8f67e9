#include "config.h"
#include "loft/section.h"
#include "base/alloc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void il_section_free(il_section *s)
{
    il_free(s->xy);
    il_free(s->ring);
    il_free(s->vertex);
    il_free(s->node_at);
    il_free(s->next);
    il_free(s->ring_at);
    il_free(s->vertex_at);
    il_free(s->t_at);
    *s = (il_section)IL_SECTION_INIT;
}

static bool add_node(il_section *s, double x, double y, int32_t ring, int32_t vertex)
{
    size_t n = s->n_nodes;
    if (!il_grow(&s->xy, &s->cap_nodes, 2 * (n + 1), sizeof *s->xy) ||
        !il_grow(&s->ring, &s->cap_ring, n + 1, sizeof *s->ring) ||
        !il_grow(&s->vertex, &s->cap_vertex, n + 1, sizeof *s->vertex))
        return false;
    s->xy[2 * n] = x;
    s->xy[2 * n + 1] = y;
    s->ring[n] = ring;
    s->vertex[n] = vertex;
    s->n_nodes++;
    return true;
}

static void free_stations(il_section *s)
{
    il_free(s->node_at);
    il_free(s->next);
    il_free(s->ring_at);
    il_free(s->vertex_at);
    il_free(s->t_at);
    s->node_at = s->next = s->ring_at = s->vertex_at = NULL;
    s->t_at = NULL;
    s->n_stations = 0;
}

/* Room for N stations; the old ones are given up. */
static bool new_stations(il_section *s, size_t n)
{
    free_stations(s);
    s->node_at = il_alloc(n, sizeof *s->node_at);
    s->next = il_alloc(n, sizeof *s->next);
    s->ring_at = il_alloc(n, sizeof *s->ring_at);
    s->vertex_at = il_alloc(n, sizeof *s->vertex_at);
    s->t_at = il_alloc(n, sizeof *s->t_at);
    return s->node_at && s->next && s->ring_at && s->vertex_at && s->t_at;
}

static void add_station(il_section *s, uint32_t node, uint32_t ring, uint32_t vertex, double t)
{
    s->node_at[s->n_stations] = node;
    s->ring_at[s->n_stations] = ring;
    s->vertex_at[s->n_stations] = vertex;
    s->t_at[s->n_stations] = t;
    s->next[s->n_stations] = (uint32_t)s->n_stations + 1;
    s->n_stations++;
}

/* The longer side of the box of S; 0 when it is empty. */
static double extent_of(const il_slice *s)
{
    double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < 2 * s->ring[i].n; k++) {
            low[k % 2] = fmin(low[k % 2], s->ring[i].xy[k]);
            high[k % 2] = fmax(high[k % 2], s->ring[i].xy[k]);
        }
    return s->n > 0 ? fmax(high[0] - low[0], high[1] - low[1]) : 0;
}

il_status il_section_from_slice(il_section *out, const il_slice *s, il_error *err)
{
    il_keymap at = IL_KEYMAP_INIT;
    *out = (il_section)IL_SECTION_INIT;
    size_t points = il_slice_points(s);
    if (points >= INT32_MAX / 4)
        return il_fail(err, IL_E_INPUT, s->line, "a slice of %zu points is too large", points);
    double extent = extent_of(s);
    if (extent > 0 && extent < IL_SECTION_EXTENT_LEAST)
        return il_fail(err, IL_E_INPUT, s->line, "a slice is less than 1e-40 across; use another unit");
    bool ok = il_keymap_reserve(&at, points) && new_stations(out, points);
    out->z = s->z;
    out->n_rings = s->n;
    for (size_t i = 0; ok && i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        uint32_t first = (uint32_t)out->n_stations;
        for (size_t k = 0; ok && k < r->n; k++) {
            double x = r->xy[2 * k], y = r->xy[2 * k + 1];
            uint32_t *node = il_keymap_put(&at, il_keymap_double(x), il_keymap_double(y), (uint32_t)out->n_nodes);
            ok = node && (*node < out->n_nodes || add_node(out, x, y, (int32_t)i, (int32_t)k));
            if (ok)
                add_station(out, *node, (uint32_t)i, (uint32_t)k, 0);
        }
        if (ok)
            out->next[out->n_stations - 1] = first;
    }
    il_keymap_free(&at);
    if (ok)
        return IL_OK;
    il_section_free(out);
    return il_fail_nomem(err);
}

static il_status copy(il_section *to, const il_section *from, il_error *err)
{
    size_t n = from->n_nodes, m = from->n_stations;
    *to = (il_section)IL_SECTION_INIT;
    to->z = from->z;
    to->n_rings = from->n_rings;
    if (!il_grow(&to->xy, &to->cap_nodes, 2 * n, sizeof *to->xy) || !il_grow(&to->ring, &to->cap_ring, n, sizeof *to->ring) ||
        !il_grow(&to->vertex, &to->cap_vertex, n, sizeof *to->vertex) || !new_stations(to, m)) {
        il_section_free(to);
        return il_fail_nomem(err);
    }
    if (n > 0) {
        memcpy(to->xy, from->xy, 2 * n * sizeof *to->xy);
        memcpy(to->ring, from->ring, n * sizeof *to->ring);
        memcpy(to->vertex, from->vertex, n * sizeof *to->vertex);
        memcpy(to->node_at, from->node_at, m * sizeof *to->node_at);
        memcpy(to->next, from->next, m * sizeof *to->next);
        memcpy(to->ring_at, from->ring_at, m * sizeof *to->ring_at);
        memcpy(to->vertex_at, from->vertex_at, m * sizeof *to->vertex_at);
        memcpy(to->t_at, from->t_at, m * sizeof *to->t_at);
    }
    to->n_nodes = n;
    to->n_stations = m;
    return IL_OK;
}

uint32_t il_section_first_station(const il_section *s, size_t ring)
{
    size_t low = 0, high = s->n_stations;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (s->ring_at[middle] < ring)
            low = middle + 1;
        else
            high = middle;
    }
    return (uint32_t)low;
}

/* Append station I of WHOLE, and its node unless NUMBER knows it. */
static bool take_station(il_section *part, const il_section *whole, uint32_t i, il_keymap *number, uint32_t *node_of)
{
    uint32_t node = whole->node_at[i];
    uint32_t *known = il_keymap_put(number, node, 0, (uint32_t)part->n_nodes);
    if (!known)
        return false;
    if (*known == part->n_nodes) {
        node_of[part->n_nodes] = node;
        if (!add_node(part, whole->xy[2 * node], whole->xy[2 * node + 1], whole->ring[node], whole->vertex[node]))
            return false;
    }
    add_station(part, *known, whole->ring_at[i], whole->vertex_at[i], whole->t_at[i]);
    return true;
}

il_status il_section_take(il_section *part, const il_section *whole, const uint32_t *ring, size_t n,
                          uint32_t **node_of, uint32_t **station_of, il_error *err)
{
    size_t n_stations = 0;
    il_keymap number = IL_KEYMAP_INIT;
    *part = (il_section)IL_SECTION_INIT;
    for (size_t r = 0; r < n; r++)
        n_stations += il_section_first_station(whole, ring[r] + (size_t)1) - il_section_first_station(whole, ring[r]);
    *node_of = il_alloc(n_stations, sizeof **node_of);
    *station_of = il_alloc(n_stations, sizeof **station_of);
    bool ok = *node_of && *station_of && new_stations(part, n_stations) && il_keymap_reserve(&number, n_stations);
    part->z = whole->z;
    part->n_rings = whole->n_rings;
    for (size_t r = 0; ok && r < n; r++) {
        uint32_t first = (uint32_t)part->n_stations, end = il_section_first_station(whole, ring[r] + (size_t)1);
        for (uint32_t i = il_section_first_station(whole, ring[r]); ok && i < end; i++) {
            (*station_of)[part->n_stations] = i;
            ok = take_station(part, whole, i, &number, *node_of);
        }
        if (ok && part->n_stations > first)
            part->next[part->n_stations - 1] = first;
    }
    il_keymap_free(&number);
    if (ok)
        return IL_OK;
    il_free(*node_of);
    il_free(*station_of);
    *node_of = *station_of = NULL;
    il_section_free(part);
    return il_fail_nomem(err);
}

double il_section_end_t(const il_section *s, uint32_t station)
{
    double t = s->t_at[s->next[station]];
    return t > 0 ? t : 1;
}

double il_section_length(const il_section *s)
{
    double length = 0;
    for (size_t i = 0; i < s->n_stations; i++) {
        const double *a = s->xy + 2 * s->node_at[i], *b = s->xy + 2 * s->node_at[s->next[i]];
        length += hypot(b[0] - a[0], b[1] - a[1]);
    }
    return length;
}

/* Insertions in place order, with the node that each becomes. */
typedef struct placed {
    uint32_t station, node;
    double t;
} placed;

static int compare_placed(const void *p, const void *q)
{
    const placed *a = p, *b = q;
    if (a->station != b->station)
        return a->station < b->station ? -1 : 1;
    if (a->t != b->t)
        return a->t < b->t ? -1 : 1;
    return a->node < b->node ? -1 : a->node > b->node;
}

static bool insert_stations(il_section *s, const placed *p, size_t n)
{
    il_section old = *s;
    s->node_at = s->next = s->ring_at = s->vertex_at = NULL;
    s->t_at = NULL;
    bool ok = new_stations(s, old.n_stations + n);
    uint32_t first = 0;
    for (uint32_t i = 0, k = 0; ok && i < old.n_stations; i++) {
        double from = old.t_at[i], to = il_section_end_t(&old, i);
        add_station(s, old.node_at[i], old.ring_at[i], old.vertex_at[i], from);
        for (; k < n && p[k].station == i; k++)
            add_station(s, p[k].node, old.ring_at[i], old.vertex_at[i], from + p[k].t * (to - from));
        if (old.next[i] != i + 1) { /* the ring ends here */
            s->next[s->n_stations - 1] = first;
            first = (uint32_t)s->n_stations;
        }
    }
    free_stations(&old);
    return ok;
}

il_status il_section_insert(il_section *s, const il_split *p, size_t n, il_error *err)
{
    if (n == 0)
        return IL_OK;
    placed *list = il_alloc(n, sizeof *list);
    bool ok = list != NULL;
    for (size_t i = 0; ok && i < n; i++) {
        list[i] = (placed){ p[i].station, (uint32_t)s->n_nodes, p[i].t };
        ok = add_node(s, p[i].xy[0], p[i].xy[1], -1, -1);
    }
    if (ok) {
        qsort(list, n, sizeof *list, compare_placed);
        ok = insert_stations(s, list, n);
    }
    il_free(list);
    return ok ? IL_OK : il_fail_nomem(err);
}

il_status il_section_copy_inserted(il_section *to, const il_section *from, const il_split *p, size_t n, il_error *err)
{
    il_status st = copy(to, from, err);
    return st == IL_OK ? il_section_insert(to, p, n, err) : st;
}
