#include "config.h"
#include "input/map-borders.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "base/sort.h"

#include <math.h>
#include <string.h>

/* Edges are known by the index of their first point in the map.  owner: the line of
 * each point; partner: the edge that meets it, NONE when there is none.  table: a hash
 * table of edges, open addressing.  level[n_levels]: all heights of bands, rising.
 * n_old: lines there were before the new ones; n_new: points of these. */
enum { NONE = UINT32_MAX };

typedef struct borders {
    il_map *map;
    uint32_t *owner, *partner, *table;
    size_t mask, n_old;
    double *level;
    size_t n_levels;
    size_t n_new, n_edges, n_shared, n_alone, n_unlike, n_overlapping;
} borders;

/* ---- edges ------------------------------------------------------------------ */

static size_t next_point(const il_map_line *l, size_t p)
{
    return p + 1 == l->begin + l->n ? l->begin : p + 1;
}

static bool is_outline(const il_map_line *l)
{
    return l->kind == IL_MAP_RING && il_map_takes_part(l);
}

static const double *point(const borders *b, size_t p)
{
    return b->map->xy + 2 * p;
}

static bool same_point(const double *p, const double *q)
{
    return p[0] == q[0] && p[1] == q[1];
}

/* The address makes hashes of a run its own, so that no file can be made to have them
 * all alike. */
static uint64_t hash_point(const borders *b, const double *p)
{
    return il_keymap_mix(il_keymap_mix(il_keymap_double(p[0]) ^ (uintptr_t)b->table) + il_keymap_double(p[1]));
}

/* The two ends add up, so that the direction does not count. */
static size_t hash_edge(const borders *b, const double *p, const double *q)
{
    return (size_t)il_keymap_mix(hash_point(b, p) + hash_point(b, q));
}

static bool same_edge(const borders *b, size_t e, const double *p, const double *q)
{
    const double *r = point(b, e), *s = point(b, next_point(&b->map->line[b->owner[e]], e));
    return (same_point(p, r) && same_point(q, s)) || (same_point(p, s) && same_point(q, r));
}

/* Meet edge E with one that is there and has no partner, or put it into the table: in the
 * place of one that has met its partner and is asked for no more, so that an edge that
 * comes a thousand times does not make a row of a thousand. */
static void enter_edge(borders *b, const il_map_line *l, size_t e)
{
    const double *p = point(b, e), *q = point(b, next_point(l, e));
    if (same_point(p, q))
        return;
    for (size_t k = hash_edge(b, p, q) & b->mask;; k = (k + 1) & b->mask) {
        uint32_t at = b->table[k];
        bool same = at != NONE && same_edge(b, at, p, q);
        if (same && b->partner[at] == NONE) {
            b->partner[at] = (uint32_t)e;
            b->partner[e] = at;
            return;
        }
        if (same || at == NONE) {
            b->table[k] = (uint32_t)e;
            return;
        }
    }
}

static bool allocate(borders *b)
{
    size_t n = b->map->n, size = 16;
    while (size < 2 * n)
        size *= 2;
    b->mask = size - 1;
    b->owner = il_alloc(n, sizeof *b->owner);
    b->partner = il_alloc(n, sizeof *b->partner);
    b->table = il_alloc(size, sizeof *b->table);
    b->level = il_alloc(2 * b->map->n_lines, sizeof *b->level);
    if (!b->owner || !b->partner || !b->table || !b->level)
        return false;
    memset(b->partner, 0xFF, n * sizeof *b->partner);
    memset(b->table, 0xFF, size * sizeof *b->table);
    return true;
}

static void meet_edges(borders *b)
{
    for (size_t i = 0; i < b->map->n_lines; i++) {
        const il_map_line *l = &b->map->line[i];
        for (size_t e = l->begin; e < l->begin + l->n; e++)
            b->owner[e] = (uint32_t)i;
        for (size_t e = l->begin; e < l->begin + l->n && is_outline(l); e++)
            enter_edge(b, l, e);
    }
}

/* ---- outlines that come twice ---------------------------------------------------- */

/* Do the outlines X and Y have the same edges in the same order, wherever they begin
 * and whichever way they run? */
static bool same_outline(const borders *b, const il_map_line *x, const il_map_line *y)
{
    size_t at = 0, n = x->n;
    if (n != y->n || x->height != y->height)
        return false;
    while (at < n && !same_point(point(b, x->begin), point(b, y->begin + at)))
        at++;
    bool forward = at < n, backward = at < n;
    for (size_t k = 0; k < n && (forward || backward); k++) {
        const double *p = point(b, x->begin + k);
        forward = forward && same_point(p, point(b, y->begin + (at + k) % n));
        backward = backward && same_point(p, point(b, y->begin + (at + n - k) % n));
    }
    return forward || backward;
}

static uint64_t hash_outline(const borders *b, const il_map_line *l)
{
    uint64_t sum = 0;
    for (size_t p = l->begin; p < l->begin + l->n; p++)
        sum += hash_point(b, point(b, p));
    return sum;
}

/* One of two equal outlines goes, as their borders would cancel. */
static bool drop_twins(borders *b)
{
    il_map *m = b->map;
    il_keymap seen = IL_KEYMAP_INIT;
    bool ok = il_keymap_reserve(&seen, m->n_lines);
    for (size_t i = 0; i < m->n_lines && ok; i++) {
        il_map_line *l = &m->line[i];
        if (!is_outline(l))
            continue;
        uint32_t *at = il_keymap_put(&seen, hash_outline(b, l), il_keymap_double(l->height) + l->n, (uint32_t)i);
        ok = at != NULL;
        if (ok && *at != i && same_outline(b, l, &m->line[*at])) {
            il_report_repair(m->report, IL_REPAIR_DUPLICATE_RING, 1);
            l->height = NAN;
            l->n = 0;
        }
    }
    il_keymap_free(&seen);
    return ok;
}

/* ---- which of them are isolines, and at what heights --------------------------- */

static void collect_levels(borders *b)
{
    size_t n = 0;
    for (size_t i = 0; i < b->map->n_lines; i++) {
        const il_map_line *l = &b->map->line[i];
        if (is_outline(l))
            b->level[n++] = l->height;
        if (is_outline(l) && !isnan(l->upper))
            b->level[n++] = l->upper;
    }
    il_sort_doubles(b->level, n);
    for (size_t k = 0; k < n; k++)
        if (b->n_levels == 0 || b->level[k] != b->level[b->n_levels - 1])
            b->level[b->n_levels++] = b->level[k];
}

/* The heights low..high at which edge E of L is an isoline, seen from the polygon that
 * is to draw it: of two bands the higher one; false when it draws none. */
static bool heights_of(borders *b, const il_map_line *l, size_t e, double *low, double *high)
{
    bool is_band = !isnan(l->upper);
    b->n_edges++;
    if (b->partner[e] == NONE) {
        b->n_alone += is_band;
        *low = *high = l->height;
        return !is_band;
    }
    const il_map_line *other = &b->map->line[b->owner[b->partner[e]]];
    b->n_shared++;
    if (!is_band) {
        b->n_unlike += l->height != other->height;
        *low = *high = l->height;
        return l->height != other->height;
    }
    *low = other->upper;
    *high = l->height;
    b->n_overlapping += l->height < other->upper && other->height < l->upper && l->height != other->height;
    return other->upper <= l->height;
}

/* ---- runs of edges become lines -------------------------------------------------- */

/* Points FIRST and on, N_EDGES edges of outline I, as a line of height H. */
static il_status add_run(borders *b, size_t i, size_t first, size_t n_edges, double h, il_error *err)
{
    il_map *m = b->map;
    bool whole = n_edges == m->line[i].n;
    size_t n = n_edges + !whole, most = m->options->max_points;
    if (n > most || b->n_new > most - n)
        return il_fail(err, IL_E_INPUT, m->line[i].line, "more than %zu points on the borders of polygons (--max-points)", most);
    if (!il_grow(&m->line, &m->cap_lines, m->n_lines + 1, sizeof *m->line) ||
        !il_grow(&m->xy, &m->cap, m->n + n, 2 * sizeof *m->xy))
        return il_fail_nomem(err);
    const il_map_line *l = &m->line[i];
    il_map_line *run = &m->line[m->n_lines++];
    *run = (il_map_line){ .begin = m->n, .n = n, .height = h, .upper = NAN, .line = l->line, .feature = l->feature,
                          .file = l->file, .kind = IL_MAP_LINE, .closed = whole };
    for (size_t k = 0, p = first; k < n; k++, p = next_point(l, p), m->n++) {
        m->xy[2 * m->n] = m->xy[2 * p];
        m->xy[2 * m->n + 1] = m->xy[2 * p + 1];
    }
    b->n_new += n;
    return IL_OK;
}

/* The least level that is not below LOW. */
static size_t first_level(const borders *b, double low)
{
    size_t from = 0, to = b->n_levels;
    while (from < to) {
        size_t mid = from + (to - from) / 2;
        if (b->level[mid] < low)
            from = mid + 1;
        else
            to = mid;
    }
    return from;
}

/* The run at every level from LOW to HIGH: bands that are no neighbours meet in a cliff. */
static il_status add_runs(borders *b, size_t i, size_t first, size_t n_edges, double low, double high, il_error *err)
{
    il_status st = IL_OK;
    if (n_edges == 0)
        return IL_OK;
    if (low == high)
        return add_run(b, i, first, n_edges, low, err);
    for (size_t k = first_level(b, low); k < b->n_levels && b->level[k] <= high && st == IL_OK; k++)
        st = add_run(b, i, first, n_edges, b->level[k], err);
    return st;
}

/* An edge after which another run begins, for a start; the first point if all is one. */
static size_t find_break(borders *b, const il_map_line *l)
{
    borders quiet = *b; /* what it counts is counted when the runs are made */
    double low = 0, high = 0, before_low = 0, before_high = 0;
    bool before = heights_of(&quiet, l, l->begin + l->n - 1, &before_low, &before_high);
    for (size_t e = l->begin; e < l->begin + l->n; e++) {
        bool draws = heights_of(&quiet, l, e, &low, &high);
        if (draws != before || (draws && (low != before_low || high != before_high)))
            return e;
    }
    return l->begin;
}

static il_status cut_outline(borders *b, size_t i, il_error *err)
{
    il_map_line l = b->map->line[i];
    size_t e = find_break(b, &l), first = e, n_edges = 0;
    double run_low = 0, run_high = 0;
    for (size_t k = 0; k < l.n; k++, e = next_point(&l, e)) {
        double low, high;
        bool draws = heights_of(b, &l, e, &low, &high);
        if (n_edges > 0 && (!draws || low != run_low || high != run_high)) {
            il_status st = add_runs(b, i, first, n_edges, run_low, run_high, err);
            if (st != IL_OK)
                return st;
            n_edges = 0;
        }
        if (draws && n_edges++ == 0) {
            first = e;
            run_low = low;
            run_high = high;
        }
    }
    return add_runs(b, i, first, n_edges, run_low, run_high, err);
}

static il_status cut_outlines(borders *b, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0; i < b->n_old && st == IL_OK; i++) {
        if (!is_outline(&b->map->line[i]))
            continue;
        st = cut_outline(b, i, err);
        if (st != IL_OK)
            il_error_set_file(err, il_map_file_of(b->map, &b->map->line[i]));
        b->map->line[i].height = NAN;
        b->map->line[i].n = 0;
    }
    return st;
}

/* ---- all of it ------------------------------------------------------------------- */

static il_status tell(const borders *b, il_error *err)
{
    if (2 * b->n_unlike > b->n_edges)
        return il_fail(err, IL_E_INPUT, 0, "is polygons that share their borders, so they are bands, of which both heights are "
                       "needed: --height LOW,HIGH names the two attributes (gdal_contour -p -amin LOW -amax HIGH writes them)");
    if (b->n_overlapping > 0)
        il_report_note(b->map->report, "%zu edges lie between bands that overlap in height; no isoline is taken from them",
                       b->n_overlapping);
    if (b->map->place.kind == IL_MAP_BAND)
        il_report_note(b->map->report, "bands: isolines are the %zu edges between two of them; %zu edges on the map's frame are none",
                       b->n_shared / 2, b->n_alone);
    return IL_OK;
}

static size_t count_outlines(const il_map *m)
{
    size_t n = 0;
    for (size_t i = 0; i < m->n_lines; i++)
        n += is_outline(&m->line[i]);
    return n;
}

il_status il_map_find_borders(il_map *m, il_error *err)
{
    borders b = { .map = m, .n_old = m->n_lines };
    if (count_outlines(m) < (m->place.kind == IL_MAP_BAND ? 1 : 2))
        return IL_OK;
    if (m->n >= NONE)
        return il_fail(err, IL_E_INPUT, 0, "has %zu points, more than polygons may have", m->n);
    il_status st = allocate(&b) && drop_twins(&b) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK) {
        meet_edges(&b);
        collect_levels(&b);
        st = cut_outlines(&b, err);
    }
    il_free(b.owner);
    il_free(b.partner);
    il_free(b.table);
    il_free(b.level);
    return st == IL_OK ? tell(&b, err) : st;
}
