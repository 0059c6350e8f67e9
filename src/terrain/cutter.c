#include "config.h"
#include "terrain/cutter.h"
#include "base/alloc.h"

#include <limits.h>
#include <math.h>

/* Of a node: another leads to it; it is written. */
enum { IS_NEXT = 1, IS_DONE = 2 };

/* What counts as nothing, of a band's height and of an edge: more than rounding, and less than
 * any height is known to. */
static const double LEAST = 1e-6;

/* side[v]: ABOVE the cut, or not; LEVEL: by less than nothing, and then NEAR_BELOW and NEAR_ABOVE
 * when it has neighbours that are off the level. */
enum { ABOVE = 1, LEVEL = 2, NEAR_BELOW = 4, NEAR_ABOVE = 8 };

void il_cutter_free(il_cutter *c)
{
    il_free(c->first);
    il_free(c->triangle);
    il_free(c->side);
    il_free(c->turns);
    il_free(c->round);
    il_keymap_free(&c->node);
    il_free(c->below);
    il_free(c->above);
    il_free(c->next);
    il_free(c->state);
    *c = (il_cutter){ 0 };
}

/* ---- bands ------------------------------------------------------------------------ */

static double height(const il_skin *s, uint32_t vertex)
{
    return s->xyz[3 * (size_t)vertex + 2];
}

/* The bands that triangle T reaches into: from *FROM up to *TO, exclusive.  Above the last level and below
 * the first there is none. */
static void find_bands(const il_cutter *c, size_t t, size_t *from, size_t *to)
{
    const il_skin *s = c->skin;
    const double *level = c->level;
    const uint32_t *v = s->tri + 3 * t;
    size_t n = c->n_bands + 1;
    double low = fmin(height(s, v[0]), fmin(height(s, v[1]), height(s, v[2])));
    double high = fmax(height(s, v[0]), fmax(height(s, v[1]), height(s, v[2])));
    size_t a = 0, b = n;
    while (a < b) { /* the first level above LOW */
        size_t mid = a + (b - a) / 2;
        level[mid] > low ? (b = mid) : (a = mid + 1);
    }
    *from = a > 0 ? a - 1 : 0;
    *to = *from;
    while (*to + 1 < n && level[*to] < high)
        ++*to;
}

static size_t count_triangles(const il_skin *s)
{
    return s->n_surface + s->n_cliff;
}

/* first[k + 2] counts band k, then first[k + 1] is where its next triangle goes. */
static bool sort_bands(il_cutter *c)
{
    size_t from, to, n = c->n_bands + 1;
    c->first = il_calloc(n + 2, sizeof *c->first);
    if (!c->first)
        return false;
    for (size_t t = 0; t < count_triangles(c->skin); t++)
        for (find_bands(c, t, &from, &to); from < to; from++)
            c->first[from + 2]++;
    for (size_t k = 1; k < n + 2; k++)
        c->first[k] += c->first[k - 1];
    c->triangle = il_alloc(c->first[n + 1], sizeof *c->triangle);
    if (!c->triangle)
        return false;
    for (size_t t = 0; t < count_triangles(c->skin); t++)
        for (find_bands(c, t, &from, &to); from < to; from++)
            c->triangle[c->first[from + 1]++] = (uint32_t)t;
    return true;
}

il_status il_cutter_build(il_cutter *c, const il_skin *s, const double *level, size_t n, il_error *err)
{
    *c = (il_cutter){ .skin = s, .level = level, .n_bands = n > 0 ? n - 1 : 0 };
    c->side = il_alloc(s->n_vertices, 1);
    c->turns = il_alloc(s->n_vertices, 1);
    c->round = il_alloc(s->n_vertices, sizeof *c->round);
    return c->side && c->turns && c->round && sort_bands(c) ? IL_OK : il_fail_nomem(err);
}

/* ---- sides -------------------------------------------------------------------------- */

static const uint32_t *corners(const il_cutter *c, size_t i)
{
    return c->skin->tri + 3 * (size_t)c->triangle[i];
}

/* A vertex on the level may count as either: any choice gives lines that close.  On ridges it is
 * below and on valley floors above, where nothing is cut then; else, on slopes and saddles,
 * above. */
static unsigned char settle(unsigned char side)
{
    bool above = side & LEVEL ? (side & NEAR_ABOVE) != 0 : (side & ABOVE) != 0;
    return (unsigned char)((side & LEVEL) | (above ? ABOVE : 0));
}

/* What is off the level about corner K of V, which is on it. */
static void look_about(il_cutter *c, const uint32_t *v, size_t k)
{
    for (size_t i = 1; i < 3; i++) {
        uint32_t other = v[(k + i) % 3];
        unsigned char side = c->side[other];
        c->round[v[k]] ^= other;
        if (!(side & LEVEL))
            c->side[v[k]] |= side & ABOVE ? NEAR_ABOVE : NEAR_BELOW;
    }
}

/* round[v]: the neighbours in all triangles about vertex V together, each twice, so 0, but at
 * the frame.  turns[v]: how often neighbours that follow each other are on different sides. */
static void find_sides(il_cutter *c, size_t band, double z)
{
    double nothing = LEAST * (c->level[band + 1] - c->level[band]);
    size_t from = c->first[band], to = c->first[band + 1];
    for (size_t i = from; i < to; i++)
        for (size_t k = 0; k < 3; k++) {
            uint32_t v = corners(c, i)[k];
            double d = height(c->skin, v) - z;
            c->side[v] = fabs(d) <= nothing ? LEVEL : d > 0 ? ABOVE : 0;
            c->turns[v] = 0;
            c->round[v] = 0;
        }
    for (size_t i = 3 * from; i < 3 * to; i++)
        if (c->side[corners(c, i / 3)[i % 3]] & LEVEL)
            look_about(c, corners(c, i / 3), i % 3);
    for (size_t i = 3 * from; i < 3 * to; i++) {
        unsigned char *side = &c->side[corners(c, i / 3)[i % 3]];
        *side = *side & (NEAR_BELOW | NEAR_ABOVE) ? settle(*side) : *side;
    }
    for (size_t i = 3 * from; i < 3 * to; i++) {
        const uint32_t *v = corners(c, i / 3);
        unsigned char *turns = &c->turns[v[i % 3]];
        if (*turns < UCHAR_MAX && ((c->side[v[(i + 1) % 3]] ^ c->side[v[(i + 2) % 3]]) & ABOVE))
            ++*turns;
    }
}

static bool is_above(const il_cutter *c, uint32_t v)
{
    return c->side[v] & ABOVE;
}

/* Is vertex V on the level, and one line alone passes by it?  Then it passes through. */
static bool is_passed(const il_cutter *c, uint32_t v)
{
    return (c->side[v] & LEVEL) && c->turns[v] == (c->round[v] == 0 ? 2 : 1);
}

/* ---- the nodes of a cut ------------------------------------------------------------ */

/* The node on the edge of vertices BELOW and ABOVE the cut; IL_CHART_NONE without memory. */
static uint32_t node_on(il_cutter *c, uint32_t below, uint32_t above)
{
    const uint32_t *known = il_keymap_put(&c->node, IL_KEYMAP_EDGE(below, above), (uint32_t)c->n);
    if (!known || *known < c->n)
        return known ? *known : IL_CHART_NONE;
    if (!il_grow(&c->below, &c->cap_below, c->n + 1, sizeof *c->below) || !il_grow(&c->above, &c->cap_above, c->n + 1, sizeof *c->above) ||
        !il_grow(&c->next, &c->cap_next, c->n + 1, sizeof *c->next) || !il_grow(&c->state, &c->cap_state, c->n + 1, sizeof *c->state))
        return IL_CHART_NONE;
    c->below[c->n] = below;
    c->above[c->n] = above;
    c->next[c->n] = IL_CHART_NONE;
    c->state[c->n] = 0;
    return (uint32_t)c->n++;
}

/* The cut through a triangle comes in over the edge that goes down, seen counter-clockwise, and leaves over
 * the one that goes up: what is above is on its left then. */
static bool cut_triangle(il_cutter *c, size_t i)
{
    const uint32_t *v = corners(c, i);
    uint32_t from = IL_CHART_NONE, to = IL_CHART_NONE;
    for (size_t k = 0; k < 3; k++) {
        uint32_t a = v[k], b = v[(k + 1) % 3];
        bool falls = is_above(c, a);
        if (falls == is_above(c, b))
            continue;
        uint32_t node = node_on(c, falls ? b : a, falls ? a : b);
        if (node == IL_CHART_NONE)
            return false;
        *(falls ? &from : &to) = node;
    }
    if (from != IL_CHART_NONE) {
        c->next[from] = to;
        c->state[to] |= IS_NEXT;
    }
    return true;
}

/* ---- lines ------------------------------------------------------------------------- */

static bool add_point(const il_cutter *c, uint32_t node, double z, il_ring *r)
{
    uint32_t below = c->below[node], above = c->above[node];
    const double *p = c->skin->xyz + 3 * (size_t)below, *q = c->skin->xyz + 3 * (size_t)above;
    double t = fmin(fmax((z - p[2]) / (q[2] - p[2]), LEAST), 1 - LEAST);
    if (is_passed(c, above) || is_passed(c, below)) {
        p = is_passed(c, above) ? q : p;
        return il_ring_add(r, p[0], p[1], IL_VERTEX_INSERTED);
    }
    return il_ring_add(r, p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), IL_VERTEX_INSERTED);
}

/* The line that begins at node FIRST, to its end or round to it again. */
static bool add_line(il_cutter *c, uint32_t first, double z, il_slice *s)
{
    il_ring *r = il_slice_add_ring(s);
    uint32_t node = first;
    if (!r)
        return false;
    do {
        c->state[node] |= IS_DONE;
        if (!add_point(c, node, z, r))
            return false;
        node = c->next[node];
    } while (node != IL_CHART_NONE && !(c->state[node] & IS_DONE));
    r->open = node == IL_CHART_NONE;
    il_ring_drop_repeated(r);
    il_ring_drop_spikes(r);
    if (r->n < (r->open ? 2 : 3)) {
        il_ring_free(r);
        s->n--;
    }
    return true;
}

/* Those that begin at the frame, then the closed ones. */
static bool add_lines(il_cutter *c, double z, il_slice *s)
{
    for (int closed = 0; closed < 2; closed++)
        for (uint32_t i = 0; i < c->n; i++)
            if (!(c->state[i] & IS_DONE) && (closed || !(c->state[i] & IS_NEXT)) && !add_line(c, i, z, s))
                return false;
    return true;
}

il_status il_cutter_cut(il_cutter *c, size_t band, double z, il_slice *s, il_error *err)
{
    bool ok = true;
    il_keymap_free(&c->node);
    c->node = (il_keymap)IL_KEYMAP_INIT;
    c->n = 0;
    find_sides(c, band, z);
    for (size_t i = c->first[band]; i < c->first[band + 1] && ok; i++)
        ok = cut_triangle(c, i);
    return ok && add_lines(c, z, s) ? IL_OK : il_fail_nomem(err);
}
