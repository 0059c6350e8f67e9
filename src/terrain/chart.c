#include "config.h"
#include "terrain/chart.h"
#include "base/alloc.h"

#include <math.h>

/* The frame is divided into at least so many pieces: where no line meets it for long, the
 * ground beside it needs heights of its own. */
enum { FRAME_PIECES = 256 };

void il_chart_free(il_chart *c)
{
    il_free(c->xy);
    il_free(c->node);
    il_free(c->edge);
    il_free(c->owner);
    il_free(c->height);
    il_keymap_free(&c->at);
    *c = (il_chart)IL_CHART_INIT;
}

uint32_t il_chart_node_at(il_chart *c, double x, double y)
{
    uint32_t *place = il_keymap_put(&c->at, il_keymap_double(x), il_keymap_double(y), (uint32_t)c->n_nodes);
    if (!place)
        return IL_CHART_NONE;
    if (*place < c->n_nodes)
        return *place;
    if (c->n_nodes >= INT32_MAX || !il_grow(&c->xy, &c->cap_xy, c->n_nodes + 1, 2 * sizeof *c->xy) ||
        !il_grow(&c->node, &c->cap_nodes, c->n_nodes + 1, sizeof *c->node))
        return IL_CHART_NONE;
    c->xy[2 * c->n_nodes] = x == 0 ? 0 : x;
    c->xy[2 * c->n_nodes + 1] = y == 0 ? 0 : y;
    c->node[c->n_nodes] = (il_chart_node){ .z = NAN, .level = -1, .top = -1, .slice = -1, .ring = -1, .vertex = -1 };
    return (uint32_t)c->n_nodes++;
}

bool il_chart_add_edge(il_chart *c, uint32_t from, uint32_t to, uint32_t owner, int32_t level)
{
    if (from == to)
        return true;
    if (!il_grow(&c->edge, &c->cap_edges, c->n_edges + 1, 2 * sizeof *c->edge) ||
        !il_grow(&c->owner, &c->cap_owners, c->n_edges + 1, sizeof *c->owner) ||
        !il_grow(&c->height, &c->cap_heights, c->n_edges + 1, sizeof *c->height))
        return false;
    c->edge[2 * c->n_edges] = from;
    c->edge[2 * c->n_edges + 1] = to;
    c->height[c->n_edges] = level;
    c->owner[c->n_edges++] = owner;
    return true;
}

double il_chart_distance(const il_chart *c, uint32_t a, uint32_t b)
{
    const double *p = c->xy + 2 * (size_t)a, *q = c->xy + 2 * (size_t)b;
    return hypot(q[0] - p[0], q[1] - p[1]);
}

double il_chart_length(const il_chart *c, size_t e)
{
    return il_chart_distance(c, c->edge[2 * e], c->edge[2 * e + 1]);
}

void il_chart_drop_points(il_chart *c)
{
    size_t n = 0;
    for (size_t e = 0; e < c->n_edges; e++) {
        if (c->edge[2 * e] == c->edge[2 * e + 1])
            continue;
        c->edge[2 * n] = c->edge[2 * e];
        c->edge[2 * n + 1] = c->edge[2 * e + 1];
        c->height[n] = c->height[e];
        c->owner[n++] = c->owner[e];
    }
    c->n_edges = n;
}

bool il_chart_unfold_frame(il_chart *c)
{
    il_keymap once = IL_KEYMAP_INIT;
    bool ok = true;
    for (size_t e = 0; e < c->n_edges && ok; e++) {
        if (!il_chart_is_frame(c, e))
            continue;
        uint32_t *at = il_keymap_put(&once, IL_KEYMAP_EDGE(c->edge[2 * e], c->edge[2 * e + 1]), (uint32_t)e);
        ok = at != NULL;
        if (!ok || *at == e)
            continue;
        if (*at != IL_CHART_NONE) {
            c->edge[2 * (size_t)*at + 1] = c->edge[2 * (size_t)*at];
            c->edge[2 * e + 1] = c->edge[2 * e];
        }
        *at = *at == IL_CHART_NONE ? (uint32_t)e : IL_CHART_NONE;
    }
    il_keymap_free(&once);
    il_chart_drop_points(c);
    return ok;
}

void il_chart_put_on(il_chart *c, uint32_t node, int32_t level)
{
    il_chart_node *n = &c->node[node];
    n->level = n->level < 0 || level < n->level ? level : n->level;
    n->top = level > n->top ? level : n->top;
    n->z = c->level_z[n->level];
}

/* What all steps need. */
typedef struct drawing {
    il_chart *c;
    const il_slice *slice;
    const il_chart_line *line;
    size_t n_lines;
    const il_frame *frame;
    const il_stack_head *head;
    const il_placement_options *o;
} drawing;

static uint32_t node_of(drawing *d, const double map[2])
{
    double p[2];
    il_placement_apply(d->head, d->o, map, p);
    return il_chart_node_at(d->c, p[0], p[1]);
}

/* Is the edge from vertex V of R to the next no isoline, but the map's edge? */
static bool is_map_edge(const il_ring *r, size_t v)
{
    return r->mark && r->mark[v] & IL_VERTEX_MAP_EDGE;
}

/* Is vertex V of R on an edge that is an isoline? */
static bool is_on_line(const il_ring *r, size_t v)
{
    bool is_before = v > 0 ? !is_map_edge(r, v - 1) : !r->open && !is_map_edge(r, r->n - 1);
    return is_before || ((v + 1 < r->n || !r->open) && !is_map_edge(r, v));
}

static bool add_line(drawing *d, uint32_t l)
{
    il_chart *c = d->c;
    const il_ring *r = il_chart_ring(d->slice, d->line, l);
    uint32_t first = IL_CHART_NONE, before = IL_CHART_NONE;
    for (size_t v = 0; v < r->n; v++) {
        uint32_t node = node_of(d, r->xy + 2 * v);
        if (node == IL_CHART_NONE)
            return false;
        il_chart_node *n = &c->node[node];
        if (is_on_line(r, v)) {
            il_chart_put_on(c, node, d->line[l].level);
            if (n->vertex < 0 && !(r->mark && r->mark[v] & IL_VERTEX_INSERTED))
                n->slice = d->line[l].level, n->ring = d->line[l].ring, n->vertex = (int32_t)v;
        }
        if (v > 0 && !is_map_edge(r, v - 1) && !il_chart_add_edge(c, before, node, l, d->line[l].level))
            return false;
        first = first == IL_CHART_NONE ? node : first;
        before = node;
    }
    return r->open || is_map_edge(r, r->n - 1) || il_chart_add_edge(c, before, first, l, d->line[l].level);
}

/* ---- the frame --------------------------------------------------------------- */

static uint32_t line_of_end(const drawing *d, const il_frame_end *e)
{
    size_t low = 0, high = d->n_lines;
    while (low < high) {
        size_t mid = low + (high - low) / 2;
        const il_chart_line *l = &d->line[mid];
        bool before = l->level < (int32_t)e->level || (l->level == (int32_t)e->level && l->ring < (int32_t)e->ring);
        low = before ? mid + 1 : low;
        high = before ? high : mid;
    }
    return (uint32_t)low;
}

/* Lines that end near the frame go on to their feet. */
static bool add_feet(drawing *d)
{
    for (size_t k = 0; k < d->frame->n_ends; k++) {
        const il_frame_end *e = &d->frame->end[k];
        uint32_t l = line_of_end(d, e);
        if (d->line[l].left_out)
            continue;
        const il_ring *r = &d->slice[e->level].ring[e->ring];
        size_t v = e->last ? r->n - 1 : 0;
        if (!is_on_line(r, v))
            continue;
        uint32_t end = node_of(d, r->xy + 2 * v), foot = node_of(d, e->foot);
        if (end == IL_CHART_NONE || foot == IL_CHART_NONE ||
            !il_chart_add_edge(d->c, e->last ? end : foot, e->last ? foot : end, l, d->line[l].level))
            return false;
        il_chart_put_on(d->c, foot, d->line[l].level);
    }
    return true;
}

/* From node A to node B, in pieces no longer than LONGEST; between two ends of one level
 * there is a point at least, or the edge would be flat. */
static bool add_side(drawing *d, uint32_t a, uint32_t b, double longest)
{
    il_chart *c = d->c;
    const double p[2] = { c->xy[2 * a], c->xy[2 * a + 1] }, q[2] = { c->xy[2 * b], c->xy[2 * b + 1] };
    double pieces = fmin(ceil(il_chart_distance(c, a, b) / longest), FRAME_PIECES);
    bool flat = c->node[a].level >= 0 && c->node[a].level == c->node[b].level;
    size_t n = (size_t)fmax(pieces, flat ? 2 : 1);
    for (size_t k = 1; k <= n; k++) {
        double t = (double)k / (double)n, to[2];
        for (int i = 0; i < 2; i++)
            to[i] = il_placement_round(d->o, p[i] + t * (q[i] - p[i]));
        uint32_t next = k < n ? il_chart_node_at(c, to[0], to[1]) : b;
        if (next == IL_CHART_NONE || !il_chart_add_edge(c, a, next, IL_CHART_NONE, -1))
            return false;
        c->node[next].is_frame = true;
        a = next;
    }
    return true;
}

static bool add_frame_ring(drawing *d, const il_ring *r, double longest)
{
    uint32_t first = IL_CHART_NONE, before = IL_CHART_NONE;
    for (size_t v = 0; v <= r->n; v++) {
        uint32_t node = v < r->n ? node_of(d, r->xy + 2 * v) : first;
        if (node == IL_CHART_NONE)
            return false;
        d->c->node[node].is_frame = true;
        if (v > 0 && !add_side(d, before, node, longest))
            return false;
        first = v == 0 ? node : first;
        before = node;
    }
    return true;
}

static bool add_frame(drawing *d)
{
    double length = 0;
    for (size_t i = 0; i < d->frame->rings.n; i++)
        length += il_ring_length(&d->frame->rings.ring[i]);
    if (d->head->has_placement)
        length /= d->head->placement.scale[0];
    for (size_t i = 0; i < d->frame->rings.n; i++)
        if (!add_frame_ring(d, &d->frame->rings.ring[i], length / FRAME_PIECES))
            return false;
    return true;
}

il_status il_chart_build(il_chart *c, const il_slice *slice, const il_chart_line *line, size_t n_lines,
                         const il_frame *frame, const il_stack_head *head, const il_placement_options *o,
                         il_error *err)
{
    drawing d = { .c = c, .slice = slice, .line = line, .n_lines = n_lines, .frame = frame, .head = head, .o = o };
    bool ok = true;
    for (size_t l = 0; l < n_lines && ok; l++)
        ok = line[l].left_out || add_line(&d, (uint32_t)l);
    ok = ok && add_feet(&d) && add_frame(&d) && il_chart_unfold_frame(c);
    if (ok)
        return IL_OK;
    return c->n_nodes >= INT32_MAX ? il_fail(err, IL_E_INPUT, head->line, "the map has too many points") : il_fail_nomem(err);
}
