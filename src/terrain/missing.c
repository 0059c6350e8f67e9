#include "config.h"
#include "terrain/missing.h"
#include "base/alloc.h"
#include "terrain/cliff.h"

#include <math.h>

/* once: edges that were drawn, by their nodes; the index of the edge, or IL_CHART_NONE when it was
 * drawn from both of its sides, which are then on the same side of it.
 * lies: whether a face that lacks lines lies above the line through a node, whose level is
 * strictly inside its band. */
typedef struct drawing {
    il_chart *c;
    const il_tin *t;
    const il_law *law;
    size_t n_lines;
    const il_placement_options *o;
    il_keymap once, lies;
} drawing;

static bool lacks_lines(const drawing *d, size_t triangle)
{
    uint32_t f = d->t->face[triangle];
    return f != IL_CHART_NONE && d->law->band[f].high - d->law->band[f].low > 1;
}

/* Corners of the frame have no height yet: in these faces they need one now. */
static void raise_corners(const drawing *d)
{
    for (size_t k = 0; k < 3 * d->t->n; k++) {
        uint32_t v = d->t->corner[k];
        if (lacks_lines(d, k / 3) && isnan(d->c->node[v].z))
            d->c->node[v].z = il_law_height(d->law, d->t->face[k / 3], d->c->xy[2 * (size_t)v], d->c->xy[2 * (size_t)v + 1]);
    }
}

/* Lines of a level inside a face's band bound it where another part of that level is missing:
 * the face lies beside them as it does far from there (the sea about islands, of which one lacks
 * its lowest line).  Find out on which side. */
static bool find_lies(drawing *d)
{
    const il_chart *c = d->c;
    for (size_t k = 0; k < 2 * d->t->n_sides; k++) {
        uint32_t f = d->t->side[k], e = (uint32_t)(k / 2);
        if (f == IL_CHART_NONE || d->t->side[k ^ 1] == f || c->height[e] < 0 || d->t->cliff[2 * e] >= 0)
            continue;
        if (c->height[e] <= d->law->band[f].low || c->height[e] >= d->law->band[f].high)
            continue;
        uint32_t above = il_law_is_above(d->t, c, d->law->band, k);
        for (int end = 0; end < 2; end++)
            if (!il_keymap_put(&d->lies, c->edge[2 * e + (size_t)end], f, above))
                return false;
    }
    return true;
}

enum { BELOW, ABOVE, NOWHERE };

static uint32_t lie_of(const drawing *d, size_t k)
{
    return il_keymap_get(&d->lies, d->t->corner[k], d->t->face[k / 3], NOWHERE);
}

/* The height of corner K, beside a line half an interval to the side where its face lies: so
 * that the missing part of that line comes to lie between. */
static double z_of(const drawing *d, size_t k)
{
    const il_chart *c = d->c;
    double z = il_cliff_z(d->t, c, d->law->band, k);
    uint32_t lie = lie_of(d, k);
    if (lie == NOWHERE)
        return z;
    size_t level = (size_t)c->node[d->t->corner[k]].level, last = c->n_levels - 1;
    size_t from = lie == ABOVE ? (level < last ? level : last - 1) : (level > 0 ? level - 1 : 0);
    double half = (c->level_z[from + 1] - c->level_z[from]) / 2;
    return lie == ABOVE ? z + half : z - half;
}

/* Where the edge from corner J to corner K of triangles passes through LEVEL: J is below it and
 * K is not.  The same from either triangle.  IL_CHART_NONE without memory. */
static uint32_t node_between(drawing *d, size_t j, size_t k, int32_t level)
{
    il_chart *c = d->c;
    uint32_t a = d->t->corner[j], b = d->t->corner[k];
    double z = c->level_z[level], za = z_of(d, j), zb = z_of(d, k), p[2];
    if (zb == z)
        return b;
    const double *from = c->xy + 2 * (size_t)a, *to = c->xy + 2 * (size_t)b, t = (z - za) / (zb - za);
    for (int i = 0; i < 2; i++)
        p[i] = il_placement_round(d->o, from[i] + t * (to[i] - from[i]));
    uint32_t n = il_chart_node_at(c, p[0], p[1]);
    if (n != IL_CHART_NONE && c->node[n].level < 0) {
        c->node[n].level = c->node[n].top = c->node[n].slice = level;
        c->node[n].z = z;
    }
    return n;
}

static bool draw(drawing *d, uint32_t a, uint32_t b, int32_t level)
{
    il_chart *c = d->c;
    if (a == IL_CHART_NONE || b == IL_CHART_NONE)
        return false;
    if (a == b)
        return true;
    uint32_t *at = il_keymap_put(&d->once, IL_KEYMAP_EDGE(a, b), (uint32_t)c->n_edges);
    if (!at)
        return false;
    if (*at != c->n_edges) {
        if (*at != IL_CHART_NONE)
            c->edge[2 * (size_t)*at + 1] = c->edge[2 * (size_t)*at];
        *at = IL_CHART_NONE;
        return true;
    }
    return il_chart_add_edge(c, a, b, (uint32_t)d->n_lines + (uint32_t)level, level);
}

/* LEVEL in triangle T: of its three edges two pass through it, or none.  Points on the level
 * count as above. */
static bool draw_level(drawing *d, size_t triangle, int32_t level)
{
    il_chart *c = d->c;
    double z = c->level_z[level];
    uint32_t end[2];
    size_t n = 0;
    bool below[3]; /* beforehand: a corner of the frame so near to the level that the line runs through it rises to it */
    for (size_t i = 0; i < 3; i++)
        below[i] = z_of(d, 3 * triangle + i) < z;
    for (size_t i = 0; i < 3; i++) {
        size_t k = 3 * triangle + i;
        if (below[i] != below[(i + 1) % 3])
            end[n++] = node_between(d, below[i] ? k : il_tin_after(k), below[i] ? il_tin_after(k) : k, level);
    }
    /* the higher ground on the left, as nobody else has a say */
    return n < 2 || draw(d, end[0], end[1], level);
}

/* Is there a line of the map between two of its corners that both lie on LEVEL? */
static bool has_line(const drawing *d, size_t triangle, int32_t level)
{
    for (size_t k = 3 * triangle; k < 3 * triangle + 3; k++) {
        uint32_t e = d->t->edge[k];
        if (e == IL_CHART_NONE)
            continue;
        bool is_cliff = d->t->cliff[2 * e] <= level && level <= d->t->cliff[2 * e + 1];
        if (is_cliff || (d->c->height[e] == level && lie_of(d, k) == NOWHERE))
            return true;
    }
    return false;
}

static bool draw_levels(drawing *d, size_t triangle)
{
    il_band b = d->law->band[d->t->face[triangle]];
    int32_t last = b.high < (int32_t)d->c->n_levels ? b.high : (int32_t)d->c->n_levels;
    for (int32_t level = b.low + 1; level < last; level++)
        if (!has_line(d, triangle, level) && !draw_level(d, triangle, level))
            return false;
    return true;
}

/* The frame's edge E, on edge J of triangles, passes through levels: it becomes several. */
static bool divide(drawing *d, size_t j, size_t e)
{
    il_chart *c = d->c;
    size_t from = c->edge[2 * e] == d->t->corner[j] ? j : il_tin_after(j), to = from == j ? il_tin_after(j) : j;
    uint32_t b = c->edge[2 * e + 1], before = c->edge[2 * e];
    double za = z_of(d, from), zb = z_of(d, to);
    bool rises = za < zb, first = true;
    for (size_t k = 0; k < c->n_levels; k++) {
        int32_t level = (int32_t)(rises ? k : c->n_levels - 1 - k);
        double z = c->level_z[level];
        if (!((za < z) != (zb < z)))
            continue;
        uint32_t n = rises ? node_between(d, from, to, level) : node_between(d, to, from, level);
        if (n == IL_CHART_NONE)
            return false;
        if (n == before || n == b)
            continue;
        c->node[n].is_frame = true;
        if (first)
            c->edge[2 * e + 1] = n;
        else if (!il_chart_add_edge(c, before, n, IL_CHART_NONE, -1))
            return false;
        first = false;
        before = n;
    }
    return first || il_chart_add_edge(c, before, b, IL_CHART_NONE, -1);
}

static bool divide_frame(drawing *d)
{
    for (size_t k = 0; k < 3 * d->t->n; k++) {
        uint32_t e = d->t->edge[k];
        if (e != IL_CHART_NONE && il_chart_is_frame(d->c, e) && lacks_lines(d, k / 3) && !divide(d, k, e))
            return false;
    }
    return true;
}

il_status il_missing_draw(il_chart *c, const il_tin *t, const il_law *law, size_t n_lines,
                          const il_placement_options *o, size_t *n, il_error *err)
{
    drawing d = { c, t, law, n_lines, o, IL_KEYMAP_INIT, IL_KEYMAP_INIT };
    *n = 0;
    for (size_t f = 0; f < t->n_faces; f++)
        *n += law->band[f].high - law->band[f].low > 1;
    if (*n == 0)
        return IL_OK;
    bool ok = find_lies(&d);
    raise_corners(&d);
    for (size_t k = 0; k < t->n && ok; k++)
        ok = !lacks_lines(&d, k) || draw_levels(&d, k);
    ok = ok && divide_frame(&d);
    il_chart_drop_points(c);
    il_keymap_free(&d.once);
    il_keymap_free(&d.lies);
    return ok ? IL_OK : il_fail_nomem(err);
}
