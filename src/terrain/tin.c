#include "config.h"
#include "terrain/tin.h"
#include "base/alloc.h"
#include "bridge/triangulation.h"
#include "terrain/links.h"

void il_tin_free(il_tin *t)
{
    il_free(t->corner);
    il_free(t->across);
    il_free(t->edge);
    il_free(t->face);
    il_free(t->side);
    il_free(t->cliff);
    *t = (il_tin)IL_TIN_INIT;
}

double il_tin_area2(const il_tin *t, const il_chart *c, size_t triangle)
{
    const double *p = c->xy + 2 * (size_t)t->corner[3 * triangle], *q = c->xy + 2 * (size_t)t->corner[3 * triangle + 1];
    const double *r = c->xy + 2 * (size_t)t->corner[3 * triangle + 2];
    return (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
}

/* ---- the chart's edges found again ------------------------------------------- */

/* Where a line runs along the frame, the frame's. */
static uint32_t find_edge(const il_links *l, const il_chart *c, uint32_t a, uint32_t b)
{
    uint32_t found = IL_CHART_NONE;
    il_links_range r = il_links_find(l, a, b);
    for (uint32_t i = r.begin; i < r.end; i++)
        if (found == IL_CHART_NONE || il_chart_is_frame(c, l->of[i]))
            found = l->of[i];
    return found;
}

/* The levels of all edges between the nodes of edge E, when they do not part as one line does:
 * lines of several levels, or an even number of one, which parts nothing. */
static void find_cliff(il_tin *t, const il_links *l, const il_chart *c, uint32_t e)
{
    int32_t least = c->height[e], most = least;
    size_t n = 0;
    il_links_range r = il_links_find(l, c->edge[2 * e], c->edge[2 * e + 1]);
    for (uint32_t i = r.begin; i < r.end; i++) {
        int32_t level = c->height[l->of[i]];
        if (level < 0)
            continue;
        n++;
        least = level < least ? level : least;
        most = level > most ? level : most;
    }
    if (least >= 0 && (least < most || n % 2 == 0) && t->cliff[2 * e] < 0) {
        t->cliff[2 * e] = least;
        t->cliff[2 * e + 1] = most;
        t->n_cliffs++;
    }
}

/* *ALL: whether every edge of the chart is one of triangles. */
static il_status find_edges(il_tin *t, const il_chart *c, bool *all, il_error *err)
{
    il_links l = IL_LINKS_INIT;
    size_t found = 0;
    il_free(t->edge);
    il_free(t->cliff);
    t->edge = il_alloc(3 * t->n, sizeof *t->edge);
    t->cliff = il_alloc(2 * c->n_edges, sizeof *t->cliff);
    bool ok = t->edge && t->cliff && il_links_build(&l, c->edge, c->n_edges, false, c->n_nodes);
    t->n_cliffs = 0;
    for (size_t e = 0; ok && e < 2 * c->n_edges; e++)
        t->cliff[e] = -1;
    for (size_t k = 0; ok && k < 3 * t->n; k++) {
        uint32_t across = t->across[k];
        t->edge[k] = find_edge(&l, c, t->corner[k], t->corner[il_tin_after(k)]);
        if (t->edge[k] != IL_CHART_NONE)
            find_cliff(t, &l, c, t->edge[k]);
        found += t->edge[k] != IL_CHART_NONE && (across == IL_CHART_NONE || across > k / 3);
    }
    *all = ok && found == il_links_count_pairs(&l, c->n_edges);
    il_links_free(&l);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* ---- faces ------------------------------------------------------------------- */

/* Outside of the frame, and not yet found. */
#define OUTSIDE IL_CHART_NONE
#define UNKNOWN (IL_CHART_NONE - 1)

static bool is_left_of(const il_chart *c, const il_tin *t, size_t k)
{
    return c->edge[2 * (size_t)t->edge[k]] == t->corner[k];
}

/* All of the face of triangle SEED, over edges that are none of the chart's. */
static void flood(il_tin *t, uint32_t seed, uint32_t face, uint32_t *stack)
{
    size_t n = 0;
    stack[n++] = seed;
    t->face[seed] = face;
    while (n > 0) {
        uint32_t at = stack[--n];
        for (size_t k = 3 * (size_t)at; k < 3 * (size_t)at + 3; k++) {
            uint32_t next = t->across[k];
            if (t->edge[k] != IL_CHART_NONE || next == IL_CHART_NONE || t->face[next] != UNKNOWN)
                continue;
            t->face[next] = face;
            stack[n++] = next;
        }
    }
}

/* Number faces, then tell those outside from those inside: crossing the frame leads in or out. */
static il_status find_faces(il_tin *t, il_error *err)
{
    uint32_t *stack = il_alloc(t->n, sizeof *stack);
    t->face = il_alloc(t->n, sizeof *t->face);
    bool ok = stack && t->face;
    if (ok) {
        for (size_t k = 0; k < t->n; k++)
            t->face[k] = UNKNOWN;
        t->n_faces = 0;
        for (size_t k = 0; k < t->n; k++)
            if (t->face[k] == UNKNOWN)
                flood(t, (uint32_t)k, (uint32_t)t->n_faces++, stack);
    }
    il_free(stack);
    return ok ? IL_OK : il_fail_nomem(err);
}

static il_status find_sides(il_tin *t, const il_chart *c, il_error *err)
{
    t->n_sides = c->n_edges;
    t->side = il_alloc(2 * c->n_edges, sizeof *t->side);
    if (!t->side)
        return il_fail_nomem(err);
    for (size_t k = 0; k < 2 * c->n_edges; k++)
        t->side[k] = IL_CHART_NONE;
    for (size_t k = 0; k < 3 * t->n; k++)
        if (t->edge[k] != IL_CHART_NONE)
            t->side[2 * (size_t)t->edge[k] + (is_left_of(c, t, k) ? 0 : 1)] = t->face[k / 3];
    return IL_OK;
}

/* A face is inside when the frame must be crossed an odd number of times to leave it. */
typedef struct inside {
    const il_chart *c;
    unsigned char *known, *is_in;   /* a face each */
    uint32_t *first, *of;           /* edges of each face */
} inside;

static void spread(inside *s, const il_tin *t, uint32_t seed, uint32_t *stack)
{
    size_t n = 0;
    stack[n++] = seed;
    s->known[seed] = 1;
    while (n > 0) {
        uint32_t f = stack[--n];
        for (uint32_t k = s->first[f]; k < s->first[f + 1]; k++) {
            uint32_t e = s->of[k], g = t->side[2 * (size_t)e] == f ? t->side[2 * (size_t)e + 1] : t->side[2 * (size_t)e];
            if (g == IL_CHART_NONE || s->known[g])
                continue;
            s->known[g] = 1;
            s->is_in[g] = il_chart_is_frame(s->c, e) ? !s->is_in[f] : s->is_in[f];
            stack[n++] = g;
        }
    }
}

static void list_edges(inside *s, const il_tin *t)
{
    for (int pass = 0; pass < 2; pass++) {
        for (size_t k = 0; k < 2 * t->n_sides; k++) {
            uint32_t f = t->side[k];
            if (f == IL_CHART_NONE)
                continue;
            if (pass == 0)
                s->first[f + 2]++;
            else
                s->of[s->first[f + 1]++] = (uint32_t)(k / 2);
        }
        for (size_t f = 2; pass == 0 && f < t->n_faces + 2; f++)
            s->first[f] += s->first[f - 1];
    }
}

/* From the hull inwards. */
static void find_inside(inside *s, const il_tin *t, uint32_t *stack)
{
    for (size_t k = 0; k < 3 * t->n; k++) {
        uint32_t f = t->face[k / 3];
        if (t->across[k] != IL_CHART_NONE || s->known[f])
            continue;
        s->is_in[f] = t->edge[k] != IL_CHART_NONE && il_chart_is_frame(s->c, t->edge[k]);
        spread(s, t, f, stack);
    }
}

static il_status drop_outside(il_tin *t, const il_chart *c, il_error *err)
{
    inside s = { c, il_calloc(t->n_faces, 1), il_calloc(t->n_faces, 1), il_calloc(t->n_faces + 2, sizeof *s.first),
                 il_alloc(2 * t->n_sides, sizeof *s.of) };
    uint32_t *stack = il_alloc(t->n_faces, sizeof *stack), *number = il_alloc(t->n_faces, sizeof *number), n = 0;
    bool ok = s.known && s.is_in && s.first && s.of && stack && number;
    if (ok) {
        list_edges(&s, t);
        find_inside(&s, t, stack);
        for (size_t f = 0; f < t->n_faces; f++)
            number[f] = s.is_in[f] ? n++ : OUTSIDE;
        for (size_t k = 0; k < t->n; k++)
            t->face[k] = number[t->face[k]];
        for (size_t k = 0; k < 2 * t->n_sides; k++)
            t->side[k] = t->side[k] == IL_CHART_NONE ? IL_CHART_NONE : number[t->side[k]];
        t->n_faces = n;
    }
    il_free(s.known);
    il_free(s.is_in);
    il_free(s.first);
    il_free(s.of);
    il_free(stack);
    il_free(number);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* ---- lines along the frame ------------------------------------------------------- */

static bool lies_nowhere(const il_tin *t, const il_chart *c, size_t e)
{
    return !il_chart_is_frame(c, e) && t->side[2 * e] == IL_CHART_NONE && t->side[2 * e + 1] == IL_CHART_NONE;
}

/* Edges of lines that run along the frame have its sides. */
static bool share_sides(il_tin *t, const il_chart *c)
{
    il_keymap frame = IL_KEYMAP_INIT;
    bool any = false, ok = true;
    for (size_t e = 0; e < c->n_edges; e++)
        any = any || lies_nowhere(t, c, e);
    for (size_t e = 0; any && ok && e < c->n_edges; e++)
        ok = !il_chart_is_frame(c, e) || il_keymap_put(&frame, IL_KEYMAP_EDGE(c->edge[2 * e], c->edge[2 * e + 1]), (uint32_t)e);
    for (size_t e = 0; any && ok && e < c->n_edges; e++) {
        uint32_t f = IL_CHART_NONE;
        if (lies_nowhere(t, c, e))
            f = il_keymap_get(&frame, IL_KEYMAP_EDGE(c->edge[2 * e], c->edge[2 * e + 1]), IL_CHART_NONE);
        if (f == IL_CHART_NONE)
            continue;
        bool alike = c->edge[2 * e] == c->edge[2 * (size_t)f];
        t->side[2 * e] = t->side[2 * (size_t)f + (alike ? 0 : 1)];
        t->side[2 * e + 1] = t->side[2 * (size_t)f + (alike ? 1 : 0)];
    }
    il_keymap_free(&frame);
    return ok;
}

/* ---- building ----------------------------------------------------------------- */

static il_status triangulate(il_tin *t, const il_chart *c, bool *crosses, il_error *err)
{
    il_triangulation *all = NULL;
    il_status st = il_triangulation_try(&all, c->xy, c->n_nodes, c->edge, c->n_edges, crosses, err);
    if (st == IL_OK && !*crosses)
        st = il_triangulation_export(all, &t->corner, &t->across, &t->n, err);
    il_triangulation_free(all);
    return st;
}

il_status il_tin_build(il_tin *t, const il_chart *c, bool *crosses, il_error *err)
{
    bool all = false;
    il_status st = triangulate(t, c, crosses, err);
    if (st != IL_OK || *crosses)
        return st;
    st = find_edges(t, c, &all, err);
    *crosses = st == IL_OK && !all && t->n > 0; /* no triangles: all nodes lie on one straight line */
    if (*crosses)
        il_tin_free(t);
    if (st != IL_OK || *crosses)
        return st;
    st = find_faces(t, err);
    if (st == IL_OK)
        st = find_sides(t, c, err);
    if (st == IL_OK)
        st = drop_outside(t, c, err);
    return st == IL_OK && !share_sides(t, c) ? il_fail_nomem(err) : st;
}

/* ---- borders -------------------------------------------------------------------- */

static bool is_same_stretch(const il_border *b, const uint32_t *side, uint32_t line, size_t n_faces)
{
    return b->line == line && (b->face[0] == side[0] || (side[0] == IL_CHART_NONE && b->face[0] >= n_faces)) &&
           (b->face[1] == side[1] || (side[1] == IL_CHART_NONE && b->face[1] >= n_faces));
}

il_status il_tin_borders(const il_tin *t, const il_chart *c, il_border **border, size_t *n, size_t *n_faces, il_error *err)
{
    size_t cap = 0;
    *border = NULL;
    *n = 0;
    *n_faces = t->n_faces;
    for (size_t e = 0; e < c->n_edges; e++) {
        const uint32_t *side = t->side + 2 * e, *v = c->edge + 2 * e;
        /* one face on both sides, or none: a spike, or outside */
        if (il_chart_is_frame(c, e) || t->cliff[2 * e] >= 0 || side[0] == side[1])
            continue;
        double length = il_chart_length(c, e);
        if (*n > 0 && is_same_stretch(&(*border)[*n - 1], side, c->owner[e], t->n_faces)) {
            (*border)[*n - 1].length += length;
            continue;
        }
        if (!il_grow(border, &cap, *n + 1, sizeof **border)) {
            il_free(*border);
            *border = NULL;
            *n = 0;
            return il_fail_nomem(err);
        }
        il_border b = { { side[0], side[1] }, c->owner[e], c->height[e], length, { c->xy[2 * v[0]], c->xy[2 * v[0] + 1] } };
        for (int k = 0; k < 2; k++)
            b.face[k] = side[k] == IL_CHART_NONE ? (uint32_t)(*n_faces)++ : side[k];
        (*border)[(*n)++] = b;
    }
    return IL_OK;
}
