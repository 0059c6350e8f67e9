/* bands-graph.c - borders sorted, faces with their borders, lines out and in again. */
#include "config.h"
#include "terrain/bands-graph.h"
#include "base/alloc.h"

#include <stdlib.h>
#include <string.h>

/* Of a hostile map, every second line of which is wrong, trials would take quadratic time.
 * These are some seconds for 10^6 borders, and enough for some dozens of wrong lines in a sea
 * with 10^4 islands. */
static const size_t PATIENCE_A_BORDER = 64, PATIENCE = 50000000;

static int by_size(double a, double b)
{
    return (a > b) - (a < b);
}

static uint32_t lesser_face(const il_border *b)
{
    return b->face[b->face[1] < b->face[0]];
}

static uint32_t greater_face(const il_border *b)
{
    return b->face[b->face[1] >= b->face[0]];
}

/* A total order but for borders that agree in all that labels depend on. */
static int by_line(const void *pa, const void *pb)
{
    const il_border *a = pa, *b = pb;
    if (a->line != b->line)
        return a->line < b->line ? -1 : 1;
    if (lesser_face(a) != lesser_face(b))
        return lesser_face(a) < lesser_face(b) ? -1 : 1;
    if (greater_face(a) != greater_face(b))
        return greater_face(a) < greater_face(b) ? -1 : 1;
    int c = by_size(a->length, b->length);
    if (c == 0)
        c = by_size(a->at[0], b->at[0]);
    if (c == 0)
        c = by_size(a->at[1], b->at[1]);
    return c != 0 ? c : (a->face[0] > b->face[0]) - (a->face[0] < b->face[0]);
}

static void sort_borders(il_border *b, size_t n)
{
    for (size_t i = 1; i < n; i++)
        if (by_line(b + i - 1, b + i) > 0) {
            qsort(b, n, sizeof *b, by_line);
            return;
        }
}

/* first[f] is the end of f's borders before, and their beginning after. */
static void list_incident(il_bands_graph *g)
{
    for (size_t b = 0; b < g->n; b++)
        for (int side = 0; side < 2; side++)
            g->first[g->border[b].face[side]]++;
    for (size_t f = 1; f <= g->n_faces; f++)
        g->first[f] += g->first[f - 1];
    for (size_t b = g->n; b-- > 0;)
        for (int side = 2; side-- > 0;)
            g->incident[--g->first[g->border[b].face[side]]] = (uint32_t)b;
}

static void list_lines(il_bands_graph *g)
{
    for (size_t b = 0; b < g->n; b++)
        g->first_of_line[g->border[b].line + 1]++;
    for (size_t i = 0; i < g->n_lines; i++)
        g->first_of_line[i + 1] += g->first_of_line[i];
}

static bool allocate(il_bands_graph *g, size_t n, size_t n_faces, size_t n_lines)
{
    g->border = il_alloc(n, sizeof *g->border);
    g->first = il_calloc(n_faces + 1, sizeof *g->first);
    g->incident = il_alloc(2 * n, sizeof *g->incident);
    g->first_of_line = il_calloc(n_lines + 1, sizeof *g->first_of_line);
    g->leader = il_alloc(n_faces, sizeof *g->leader);
    g->next = il_alloc(n_faces, sizeof *g->next);
    g->members = il_alloc(n_faces, sizeof *g->members);
    g->around = il_alloc(n_faces, sizeof *g->around);
    g->lie = il_calloc(n_faces, 1);
    g->directed = il_calloc(n_faces, 1);
    g->out = il_calloc(n_lines, 1);
    return g->border && g->first && g->incident && g->first_of_line && g->leader && g->next && g->members && g->around &&
           g->lie && g->directed && g->out;
}

il_status il_bands_graph_make(il_bands_graph *g, const il_border *border, size_t n, size_t n_faces, size_t n_lines,
                              size_t n_levels, il_side high, il_error *err)
{
    *g = (il_bands_graph){ .n = n, .n_faces = n_faces, .n_lines = n_lines, .n_levels = n_levels, .high = high,
                           .patience = PATIENCE_A_BORDER * n + PATIENCE };
    if (!allocate(g, n, n_faces, n_lines))
        return il_fail_nomem(err);
    if (n > 0)
        memcpy(g->border, border, n * sizeof *border);
    sort_borders(g->border, n);
    list_incident(g);
    list_lines(g);
    for (uint32_t f = 0; f < n_faces; f++) {
        g->leader[f] = g->next[f] = f;
        g->members[f] = 1;
    }
    return IL_OK;
}

void il_bands_graph_free(il_bands_graph *g)
{
    void *all[] = { g->border, g->first, g->incident, g->first_of_line, g->leader, g->next, g->members, g->around,
                    g->lie, g->directed, g->out };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        il_free(all[i]);
    *g = (il_bands_graph){ 0 };
}

/* ---- lines out and in ------------------------------------------------------------- */

static void follow(il_bands_graph *g, uint32_t from, uint32_t leader)
{
    uint32_t f = from;
    do {
        g->leader[f] = leader;
        f = g->next[f];
    } while (f != from);
}

/* Two circles become one, or one two again. */
static void swap_next(il_bands_graph *g, uint32_t a, uint32_t b)
{
    uint32_t next = g->next[a];
    g->next[a] = g->next[b];
    g->next[b] = next;
}

/* The smaller is relabelled, so that n faces are in O(n log n). */
static il_merger merge(il_bands_graph *g, uint32_t a, uint32_t b)
{
    bool keep_a = g->members[a] != g->members[b] ? g->members[a] > g->members[b] : a < b;
    il_merger m = { keep_a ? a : b, keep_a ? b : a };
    follow(g, m.absorbed, m.keep);
    swap_next(g, m.keep, m.absorbed);
    g->members[m.keep] += g->members[m.absorbed];
    return m;
}

size_t il_bands_graph_take_out(il_bands_graph *g, uint32_t line, il_merger *merger)
{
    size_t n = 0;
    g->out[line] = 1;
    for (uint32_t b = g->first_of_line[line]; b < g->first_of_line[line + 1]; b++) {
        uint32_t left = il_bands_graph_leader(g, b, 0), right = il_bands_graph_leader(g, b, 1);
        if (left != right)
            merger[n++] = merge(g, left, right);
    }
    return n;
}

void il_bands_graph_put_back(il_bands_graph *g, uint32_t line, const il_merger *merger, size_t n)
{
    while (n-- > 0) {
        const il_merger *m = merger + n;
        swap_next(g, m->keep, m->absorbed);
        g->members[m->keep] -= g->members[m->absorbed];
        follow(g, m->absorbed, m->absorbed);
    }
    g->out[line] = 0;
}

/* ---- what is around a face ---------------------------------------------------------- */

static void prefer_longer(const il_bands_graph *g, uint32_t *best, uint32_t b)
{
    if (g->border[b].length > g->border[*best].length || (g->border[b].length == g->border[*best].length && b < *best))
        *best = b;
}

static void see(const il_bands_graph *g, il_around *a, bool *more, uint32_t b)
{
    int32_t level = g->border[b].level;
    if (a->kinds == 0) {
        *a = (il_around){ level, level, 1, 0, { b, b } };
        return;
    }
    bool is_two = a->low != a->high;
    if (level < a->low || level > a->high) {
        int end = level > a->high;
        *(end ? &a->high : &a->low) = level;
        a->border[end] = b;
        *more |= is_two;
        return;
    }
    *more |= level != a->low && level != a->high;
    if (level == a->low)
        prefer_longer(g, &a->border[0], b);
    if (level == a->high)
        prefer_longer(g, &a->border[1], b);
}

void il_bands_graph_look_around(il_bands_graph *g, uint32_t face)
{
    il_around a = { 0, 0, 0, 0, { UINT32_MAX, UINT32_MAX } };
    bool more = false;
    uint32_t b;
    for (il_round r = il_round_begin(g, face); il_round_next(&r, &b);)
        see(g, &a, &more, b);
    if (a.kinds > 0)
        a.kinds = more ? 3 : a.low != a.high ? 2 : 1;
    g->around[face] = a;
}

void il_bands_graph_look_all_around(il_bands_graph *g)
{
    for (uint32_t f = 0; f < g->n_faces; f++)
        if (g->leader[f] == f)
            il_bands_graph_look_around(g, f);
}

il_lie il_bands_graph_lie(const il_bands_graph *g, uint32_t leader, int32_t level)
{
    const il_around *a = &g->around[leader];
    if (il_around_is_single(a))
        return g->lie[leader];
    const il_band band = il_around_band(a, g->n_levels);
    return level == band.low ? IL_LIE_ABOVE : level == band.high ? IL_LIE_BELOW : IL_LIE_FREE;
}

il_lie il_bands_graph_directed_lie(const il_bands_graph *g, int side)
{
    return (side == 0) == (g->high == IL_SIDE_LEFT) ? IL_LIE_ABOVE : IL_LIE_BELOW;
}

bool il_bands_graph_is_bad(const il_bands_graph *g, uint32_t b)
{
    uint32_t face[2] = { il_bands_graph_leader(g, b, 0), il_bands_graph_leader(g, b, 1) };
    if (g->out[g->border[b].line])
        return false;
    if (face[0] == face[1])
        return true;
    il_lie lie[2];
    bool directed = false;
    for (int side = 0; side < 2; side++) {
        lie[side] = il_bands_graph_lie(g, face[side], g->border[b].level);
        directed |= il_around_is_single(&g->around[face[side]]) && g->directed[face[side]];
    }
    if (directed)
        for (int side = 0; side < 2; side++)
            if (lie[side] != IL_LIE_FREE && lie[side] != il_bands_graph_directed_lie(g, side))
                return true;
    return lie[0] == lie[1] && lie[0] != IL_LIE_FREE;
}
