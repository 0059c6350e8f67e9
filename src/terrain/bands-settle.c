/* bands-settle.c - clusters found breadth first, settled from the leaves to the root and back. */
#include "config.h"
#include "terrain/bands-settle.h"
#include "base/alloc.h"

il_status il_settler_make(il_settler *s, il_bands_graph *g, il_error *err)
{
    size_t n = g->n_faces;
    *s = (il_settler){ .graph = g, .lost = UINT32_MAX };
    s->face = il_alloc(n, sizeof *s->face);
    s->before = il_alloc(n, sizeof *s->before);
    s->seen = il_calloc(n, sizeof *s->seen);
    s->parent = il_alloc(n, sizeof *s->parent);
    s->cost = il_alloc(n, sizeof *s->cost);
    return s->face && s->before && s->seen && s->parent && s->cost ? IL_OK : il_fail_nomem(err);
}

void il_settler_free(il_settler *s)
{
    il_free(s->face);
    il_free(s->before);
    il_free(s->seen);
    il_free(s->parent);
    il_free(s->cost);
    *s = (il_settler){ 0 };
}

void il_settle_begin(il_settler *s)
{
    s->epoch++;
    s->n = s->n_lost = 0;
    s->lost = UINT32_MAX;
}

void il_settle_undo(il_settler *s)
{
    while (s->n > 0) {
        uint32_t face = s->face[--s->n];
        s->graph->lie[face] = s->before[s->n] & 1;
        s->graph->directed[face] = s->before[s->n] >> 1 & 1;
    }
}

/* PARENT: the border that led to FACE. */
static void enter(il_settler *s, uint32_t face, uint32_t parent)
{
    il_bands_graph *g = s->graph;
    s->seen[face] = s->epoch;
    s->parent[face] = parent;
    s->before[s->n] = (uint32_t)(g->lie[face] | g->directed[face] << 1);
    s->face[s->n++] = face;
    s->cost[face][0] = s->cost[face][1] = (il_wrong){ 0, 0 };
}

/* The face beyond border B of FACE, and on which side of B's line it is. */
static uint32_t beyond(const il_bands_graph *g, uint32_t b, uint32_t face, int *side)
{
    *side = il_bands_graph_leader(g, b, 0) == face;
    return il_bands_graph_leader(g, b, *side);
}

static il_wrong plus(il_wrong a, il_wrong b)
{
    return (il_wrong){ a.n + b.n, a.length + b.length };
}

static bool is_less(il_wrong a, il_wrong b)
{
    return a.n != b.n ? a.n < b.n : a.length < b.length;
}

/* What border B costs when the face on its SIDE lies so, and the one beyond so. */
static il_wrong cost_of(const il_bands_graph *g, uint32_t b, int side, il_lie lie, il_lie other, bool directed)
{
    bool is_wrong = lie == other || (directed && lie != il_bands_graph_directed_lie(g, side));
    return is_wrong ? (il_wrong){ 1, g->border[b].length } : (il_wrong){ 0, 0 };
}

/* The faces of one level that hang together with ROOT; *GUIDES: borders with faces of more
 * levels that say something, *FREE: that do not. */
static void gather(il_settler *s, uint32_t root, size_t *guides, size_t *free)
{
    il_bands_graph *g = s->graph;
    size_t begin = s->n;
    enter(s, root, UINT32_MAX);
    for (size_t i = begin; i < s->n; i++) {
        uint32_t b;
        for (il_round r = il_round_begin(g, s->face[i]); il_round_next(&r, &b);) {
            int side;
            uint32_t other = beyond(g, b, s->face[i], &side);
            if (!il_around_is_single(&g->around[other]))
                ++*(il_bands_graph_lie(g, other, g->border[b].level) == IL_LIE_FREE ? free : guides);
            else if (s->seen[other] != s->epoch)
                enter(s, other, b);
        }
    }
}

/* Add to a face's costs those of its borders with faces of more levels. */
static void heed_guides(il_settler *s, uint32_t face, bool directed)
{
    il_bands_graph *g = s->graph;
    uint32_t b;
    for (il_round r = il_round_begin(g, face); il_round_next(&r, &b);) {
        int side;
        uint32_t other = beyond(g, b, face, &side);
        if (il_around_is_single(&g->around[other]))
            continue;
        il_lie lie = il_bands_graph_lie(g, other, g->border[b].level);
        for (il_lie mine = IL_LIE_BELOW; mine <= IL_LIE_ABOVE; mine++)
            s->cost[face][mine] = plus(s->cost[face][mine], cost_of(g, b, !side, mine, lie, directed));
    }
}

/* The cheaper lie of FACE when the face it hangs on lies on OTHER; opposite sides if equal. */
static il_lie choose(const il_settler *s, uint32_t face, il_lie other, bool directed, il_wrong *cost)
{
    int side;
    uint32_t b = s->parent[face];
    beyond(s->graph, b, face, &side);
    il_lie flip = other == IL_LIE_BELOW ? IL_LIE_ABOVE : IL_LIE_BELOW;
    il_wrong same = plus(s->cost[face][other], cost_of(s->graph, b, !side, other, other, directed));
    il_wrong opposite = plus(s->cost[face][flip], cost_of(s->graph, b, !side, flip, other, directed));
    *cost = is_less(same, opposite) ? same : opposite;
    return is_less(same, opposite) ? other : flip;
}

static uint32_t parent_of(const il_settler *s, uint32_t face)
{
    int side;
    return beyond(s->graph, s->parent[face], face, &side);
}

/* The faces from BEGIN, of which the first is the root.  A cluster that nothing tells a side
 * has a peak or ridge for a root. */
static void settle(il_settler *s, size_t begin, bool directed)
{
    il_bands_graph *g = s->graph;
    il_wrong cost;
    for (size_t i = s->n; i-- > begin;) {
        uint32_t face = s->face[i];
        heed_guides(s, face, directed);
        for (il_lie up = IL_LIE_BELOW; i > begin && up <= IL_LIE_ABOVE; up++) {
            il_wrong *sum = &s->cost[parent_of(s, face)][up];
            choose(s, face, up, directed, &cost);
            *sum = plus(*sum, cost);
        }
    }
    for (size_t i = begin; i < s->n; i++) {
        uint32_t face = s->face[i];
        il_lie lie = i > begin ? choose(s, face, g->lie[parent_of(s, face)], directed, &cost)
                   : is_less(s->cost[face][IL_LIE_BELOW], s->cost[face][IL_LIE_ABOVE]) ? IL_LIE_BELOW : IL_LIE_ABOVE;
        g->lie[face] = (unsigned char)lie;
        g->directed[face] = directed;
    }
}

static void settle_cluster(il_settler *s, uint32_t root)
{
    size_t begin = s->n, guides = 0, free = 0;
    il_bands_graph *g = s->graph;
    gather(s, root, &guides, &free);
    settle(s, begin, guides == 0 && g->high != IL_SIDE_UNKNOWN);
    if (guides == 0 && free == 0 && g->high == IL_SIDE_UNKNOWN) {
        s->n_lost++;
        s->lost = g->around[root].border[0];
    }
}

void il_settle_from(il_settler *s, uint32_t face)
{
    il_bands_graph *g = s->graph;
    if (s->seen[face] == s->epoch)
        return;
    if (il_around_is_single(&g->around[face])) {
        settle_cluster(s, face);
        return;
    }
    enter(s, face, UINT32_MAX);
    uint32_t b;
    for (il_round r = il_round_begin(g, face); il_round_next(&r, &b);) {
        int side;
        uint32_t other = beyond(g, b, face, &side);
        if (il_around_is_single(&g->around[other]) && s->seen[other] != s->epoch)
            settle_cluster(s, other);
    }
}
