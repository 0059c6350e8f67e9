/* map-trim.c - the vertices next to ends are hashed, and all vertices looked up. */
#include "config.h"
#include "input/map-trim.h"
#include "base/alloc.h"
#include "base/keymap.h"

#include <math.h>
#include <string.h>

/* How far from an edge an end may lie that is on it, as a share of the map: coordinates
 * have few decimals. */
static const double ASIDE = 1e-6;

/* Where more lines end next to one vertex than sheets overlap, it is something else;
 * comparing each with each would take time without end. */
enum { CROWD = 8 };

#define NO_END UINT32_MAX

/* End 2 l is the first vertex of line l, end 2 l + 1 the last; its anchor is the vertex
 * next to it.  table[size]: the first end with an anchor, NO_END in free slots; next[end]:
 * another with the same.  covered[end]: it lies on an edge. */
typedef struct trim {
    il_map *map;
    double aside;
    uint64_t salt;
    uint32_t *table, *next;
    size_t size;
    bool *covered;
} trim;

static const il_map_line *line_of(const trim *t, uint32_t end)
{
    return &t->map->line[end / 2];
}

static const double *tip_of(const trim *t, uint32_t end)
{
    const il_map_line *l = line_of(t, end);
    return t->map->xy + 2 * (end & 1 ? l->begin + l->n - 1 : l->begin);
}

static const double *anchor_of(const trim *t, uint32_t end)
{
    const il_map_line *l = line_of(t, end);
    return t->map->xy + 2 * (end & 1 ? l->begin + l->n - 2 : l->begin + 1);
}

static bool has_ends(const il_map_line *l)
{
    return il_map_takes_part(l) && !l->closed && l->n > 1;
}

/* The slot of the ends of lines of HEIGHT with their anchor at P, which may be free.  The
 * salt keeps files from having all hashes alike. */
static uint32_t *find_slot(const trim *t, const double *p, double height)
{
    uint64_t h = il_keymap_mix(il_keymap_mix(il_keymap_double(p[0]) ^ t->salt) + il_keymap_double(p[1]));
    for (size_t i = il_keymap_mix(h + il_keymap_double(height)) & (t->size - 1);; i = (i + 1) & (t->size - 1)) {
        uint32_t e = t->table[i];
        if (e == NO_END)
            return &t->table[i];
        const double *q = anchor_of(t, e);
        if (p[0] == q[0] && p[1] == q[1] && height == line_of(t, e)->height)
            return &t->table[i];
    }
}

static bool index_ends(trim *t)
{
    const il_map *m = t->map;
    size_t n = 0;
    for (size_t i = 0; i < m->n_lines; i++)
        n += has_ends(&m->line[i]) ? 2 : 0;
    for (t->size = 64; t->size < 2 * n;)
        t->size *= 2;
    t->table = il_alloc(t->size, sizeof *t->table);
    t->next = il_alloc(2 * m->n_lines, sizeof *t->next);
    t->covered = il_calloc(2 * m->n_lines, sizeof *t->covered);
    if (!t->table || !t->next || !t->covered)
        return false;
    memset(t->table, 0xFF, t->size * sizeof *t->table); /* NO_END */
    t->salt = (uintptr_t)t->table;
    for (uint32_t e = 0; e < 2 * m->n_lines; e++) {
        if (!has_ends(line_of(t, e)))
            continue;
        uint32_t *slot = find_slot(t, anchor_of(t, e), line_of(t, e)->height);
        t->next[e] = *slot;
        *slot = e;
    }
    return true;
}

/* Does V lie on the edge from U to W, and not at its end? */
static bool is_on_edge(const trim *t, const double *v, const double *u, const double *w)
{
    double dx = w[0] - u[0], dy = w[1] - u[1], x = v[0] - u[0], y = v[1] - u[1];
    double square = dx * dx + dy * dy, along = x * dx + y * dy;
    return along > 0 && x * x + y * y < square && fabs(dx * y - dy * x) <= t->aside * sqrt(square);
}

/* Find which of the ends from E on lie on the edges from vertex K of L. */
static void cover(trim *t, uint32_t e, const il_map_line *l, size_t k)
{
    const double *xy = t->map->xy + 2 * l->begin, *u = xy + 2 * k;
    const double *before = k > 0 ? u - 2 : l->closed ? xy + 2 * (l->n - 1) : u;
    const double *behind = k + 1 < l->n ? u + 2 : l->closed ? xy : u;
    size_t n = 0;
    for (uint32_t f = e; f != NO_END && n <= CROWD; f = t->next[f])
        n++;
    for (; e != NO_END && n <= CROWD; e = t->next[e])
        t->covered[e] |= is_on_edge(t, tip_of(t, e), u, before) || is_on_edge(t, tip_of(t, e), u, behind);
}

static void cover_all(trim *t)
{
    const il_map *m = t->map;
    for (size_t i = 0; i < m->n_lines; i++) {
        const il_map_line *l = &m->line[i];
        for (size_t k = 0; k < (il_map_takes_part(l) ? l->n : 0); k++) {
            uint32_t e = *find_slot(t, m->xy + 2 * (l->begin + k), l->height);
            if (e != NO_END)
                cover(t, e, l, k);
        }
    }
}

static void take_off(trim *t)
{
    il_map *m = t->map;
    for (size_t i = 0; i < m->n_lines; i++) {
        il_map_line *l = &m->line[i];
        size_t n = (size_t)t->covered[2 * i] + t->covered[2 * i + 1];
        if (n > 0 && l->n < n + 2) {
            il_report_repair(m->report, IL_REPAIR_DUPLICATE_LINE, 1);
            l->height = NAN;
            l->n = 0;
            continue;
        }
        il_report_repair(m->report, IL_REPAIR_SHARED_EDGE, n);
        l->begin += t->covered[2 * i];
        l->n -= n;
    }
}

il_status il_map_trim(il_map *m, il_error *err)
{
    trim t = { .map = m, .aside = ASIDE * hypot(m->box[2] - m->box[0], m->box[3] - m->box[1]) };
    if (m->n_lines >= NO_END / 2)
        return il_fail(err, IL_E_INPUT, 0, "more than %u lines", NO_END / 2 - 1);
    bool ok = index_ends(&t);
    if (ok) {
        cover_all(&t);
        take_off(&t);
    }
    il_free(t.table);
    il_free(t.next);
    il_free(t.covered);
    return ok ? IL_OK : il_fail_nomem(err);
}
