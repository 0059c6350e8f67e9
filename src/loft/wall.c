/* wall.c - strips between arcs that coincide in the reference plane (loft.md 6).
 *
 * Where both boundaries run along an edge in the same direction there is no
 * sheet on either side; the surface stands there.  Edges of that kind form
 * chains between nodes, which are points where anything else meets them. */
#include "config.h"
#include "loft/builder.h"
#include "base/zipper.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* Chain ends and continuations: degree[p] counts the contour edges at p,
 * in[p] and out[p] the wall edges; next[p] is the end of the last that leaves. */
typedef struct walls {
    il_builder *b;
    unsigned char *degree, *in, *out;
    uint32_t *next;
    unsigned char *used;       /* [n_edges] rim edges that are in a chain already */
    uint32_t *edge_of;         /* [n_contour] rim edge that leaves as a wall */
    uint32_t *chain; size_t n_chain, cap_chain;
    il_zip_vertex *list[2]; size_t n_list[2], cap_list[2];
} walls;

/* Is rim edge I a wall?  Then it runs, lower boundary's way, from *A to *B. */
static bool wall_edge(const il_overlay *o, size_t i, uint32_t *a, uint32_t *b)
{
    *a = o->rim[2 * i], *b = o->rim[2 * i + 1];
    unsigned flags = il_overlay_edge(o, *a, *b);
    if ((flags & IL_EDGE_CONTOUR) != IL_EDGE_CONTOUR || !(flags & IL_EDGE_LOWER_BACK) != !(flags & IL_EDGE_UPPER_BACK))
        return false;
    if (flags & IL_EDGE_LOWER_BACK) {
        uint32_t swap = *a;
        *a = *b, *b = swap;
    }
    return true;
}

static void count(unsigned char *n)
{
    *n = (unsigned char)(*n < 200 ? *n + 1 : *n);
}

static bool survey(walls *w)
{
    const il_overlay *o = w->b->o;
    w->degree = il_calloc(o->n_contour, 1);
    w->in = il_calloc(o->n_contour, 1);
    w->out = il_calloc(o->n_contour, 1);
    w->next = il_alloc(o->n_contour, sizeof *w->next);
    w->edge_of = il_alloc(o->n_contour, sizeof *w->edge_of);
    w->used = il_calloc(o->n_edges, 1);
    if (!w->degree || !w->in || !w->out || !w->next || !w->edge_of || !w->used)
        return false;
    for (size_t i = 0; i < o->n_edges; i++) {
        uint32_t a, b;
        if (il_overlay_edge(o, o->rim[2 * i], o->rim[2 * i + 1]) == 0)
            continue;
        count(&w->degree[o->rim[2 * i]]);
        count(&w->degree[o->rim[2 * i + 1]]);
        if (!wall_edge(o, i, &a, &b))
            continue;
        count(&w->out[a]);
        count(&w->in[b]);
        w->next[a] = b;
        w->edge_of[a] = (uint32_t)i;
    }
    return true;
}

static bool is_node(const walls *w, uint32_t p)
{
    return w->degree[p] != 2 || w->in[p] != 1 || w->out[p] != 1;
}

static bool extend(walls *w, uint32_t p)
{
    if (!il_grow(&w->chain, &w->cap_chain, w->n_chain + 1, sizeof *w->chain))
        return false;
    w->chain[w->n_chain++] = p;
    return true;
}

/* The chain from rim edge I (A to B) on, until a node or its own start. */
static bool collect(walls *w, size_t i, uint32_t a, uint32_t b)
{
    w->n_chain = 0;
    w->used[i] = 1;
    bool ok = extend(w, a) && extend(w, b);
    for (uint32_t p = b; ok && p != a && !is_node(w, p); p = w->next[p]) {
        w->used[w->edge_of[p]] = 1;
        ok = extend(w, w->next[p]);
    }
    return ok;
}

static bool is_real(const il_overlay *o, int side, uint32_t p)
{
    return o->pass[side][p].node >= 0;
}

/* A closed chain without a node begins where both slices have a vertex. */
static void rotate_closed(walls *w)
{
    const il_overlay *o = w->b->o;
    size_t n = w->n_chain - 1, k = 0;
    while (k < n && !(is_real(o, 0, w->chain[k]) && is_real(o, 1, w->chain[k])))
        k++;
    if (k == 0 || k == n)
        return;
    for (size_t moved = 0, start = 0; moved < n; start++) { /* in cycles, in place */
        uint32_t first = w->chain[start];
        size_t i = start;
        for (size_t from = (i + k) % n; from != start; from = (i + k) % n) {
            w->chain[i] = w->chain[from];
            i = from;
            moved++;
        }
        w->chain[i] = first;
        moved++;
    }
    w->chain[n] = w->chain[0];
}

static bool list_vertex(walls *w, int side, size_t i)
{
    const il_overlay *o = w->b->o;
    uint32_t p = w->chain[i];
    if (!is_real(o, side, p) && i > 0 && i + 1 < w->n_chain)
        return true;
    if (!il_grow(&w->list[side], &w->cap_list[side], w->n_list[side] + 1, sizeof *w->list[side]))
        return false;
    il_zip_vertex *v = &w->list[side][w->n_list[side]++];
    double xy[2];
    il_snapped_point(o->snapped, p, xy);
    *v = (il_zip_vertex){ xy[0], xy[1], il_builder_copy(w->b, side, p), i };
    if (is_real(o, side, p)) { /* where phi takes it, neither laid on anything nor snapped */
        const il_ref_vertex *r = &o->reference->side[side].vertex[o->pass[side][p].vertex];
        v->x = r->at[0], v->y = r->at[1];
    }
    return v->code != IL_NONE;
}

/* Add up the chain's matched edges. */
static void measure(walls *w)
{
    const il_overlay *o = w->b->o;
    for (size_t i = 0; i + 1 < w->n_chain; i++) {
        const il_pass *pass = &o->pass[IL_LOWER][w->chain[i]];
        const double *a = o->xy + 2 * w->chain[i], *b = o->xy + 2 * w->chain[i + 1];
        if (o->reference->side[IL_LOWER].vertex[pass->vertex].matched)
            w->b->out->walled += o->snapped->cell * hypot(b[0] - a[0], b[1] - a[1]);
    }
}

/* Does a strip round a ring first go all along one side, then all along the other,
 * wherever it begins?  Then the edge where it changes over is also the one where
 * it changes back, and the ring is pinched there. */
static bool is_pinched(const walls *w, const unsigned char *step)
{
    size_t n = w->n_list[0] + w->n_list[1] - 2, changes = 0;
    for (size_t k = 0; k < n; k++)
        changes += step[k] != step[k + 1 < n ? k + 1 : 0];
    return changes <= 2 && w->chain[0] == w->chain[w->n_chain - 1];
}

/* Fill STEP in the order of the chain, or (BY_TURNS) as the counts of vertices
 * have it, which never pinches a ring of three and more on either side. */
static void fill_steps(const walls *w, bool by_turns, unsigned char *step)
{
    size_t i = 0, j = 0, last_i = w->n_list[0] - 1, last_j = w->n_list[1] - 1;
    for (size_t k = 0; k < last_i + last_j; k++) {
        bool upper = i == last_i;
        if (i < last_i && j < last_j)
            upper = by_turns ? (j + 1) * last_i < (i + 1) * last_j : w->list[1][j + 1].place < w->list[0][i + 1].place;
        step[k] = upper;
        *(upper ? &j : &i) += 1;
    }
}

static il_status emit_strip(walls *w, il_error *err)
{
    unsigned char *step = NULL;
    w->n_list[0] = w->n_list[1] = 0;
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < w->n_chain; i++)
            if (!list_vertex(w, side, i))
                return il_fail_nomem(err);
    size_t n = w->n_list[0] + w->n_list[1] - 2, i = 0, j = 0;
    il_status st = il_zip(w->list[0], w->n_list[0], w->list[1], w->n_list[1], &step, err);
    for (int by_turns = 0; st == IL_OK && by_turns < 2 && is_pinched(w, step); by_turns++)
        fill_steps(w, by_turns, step);
    for (size_t k = 0; st == IL_OK && k < n; k++) {
        uint32_t low = w->list[0][i].code, high = w->list[1][j].code;
        uint32_t next = step[k] ? w->list[1][++j].code : w->list[0][++i].code;
        if (!il_surface_add_triangle(w->b->out, low, next, high))
            st = il_fail_nomem(err);
    }
    il_free(step);
    return st;
}

/* First the chains that start at nodes, then those that close on themselves. */
static il_status build_chains(walls *w, bool from_nodes, il_error *err)
{
    const il_overlay *o = w->b->o;
    il_status st = IL_OK;
    for (size_t i = 0; st == IL_OK && i < o->n_edges; i++) {
        uint32_t a, b;
        if (w->used[i] || !wall_edge(o, i, &a, &b) || (from_nodes && !is_node(w, a)))
            continue;
        if (!collect(w, i, a, b))
            return il_fail_nomem(err);
        if (!from_nodes)
            rotate_closed(w);
        measure(w);
        st = emit_strip(w, err);
    }
    return st;
}

il_status il_build_walls(il_builder *b, il_error *err)
{
    walls w = { 0 };
    w.b = b;
    il_status st = survey(&w) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK)
        st = build_chains(&w, true, err);
    if (st == IL_OK)
        st = build_chains(&w, false, err);
    il_free(w.degree);
    il_free(w.in);
    il_free(w.out);
    il_free(w.next);
    il_free(w.edge_of);
    il_free(w.used);
    il_free(w.chain);
    il_free(w.list[0]);
    il_free(w.list[1]);
    return st;
}
