/* map-edge.c - vertices on the frame, then edges between them, then runs of such edges. */
#include "config.h"
#include "terrain/map-edge.h"
#include "base/alloc.h"
#include "terrain/frame-sides.h"

#include <math.h>

static const uint32_t NO_SIDE = UINT32_MAX, MANY = UINT32_MAX - 1;

/* line[side]: the one line that has a vertex on it, NO_SIDE for none, MANY.  side_of[k]: that
 * vertex k of the ring at hand lies on; edge[k]: that its edge to the next lies along. */
typedef struct marking {
    il_frame_sides sides;
    bool is_given;              /* sides are the user's, not found from the lines */
    uint32_t *line;
    uint32_t *side_of, *edge;
    size_t cap_side_of, cap_edge;
    size_t n;
} marking;

/* The side on which (X, Y) lies, NO_SIDE inside. */
static uint32_t side_at(const marking *m, double x, double y)
{
    const double *b = m->sides.box;
    double far = m->sides.slack;
    bool is_inner = !m->is_given && !m->sides.is_curved &&
                    fmin(fmin(x - b[0], b[2] - x), fmin(y - b[1], b[3] - y)) > far;
    il_nearest_place near;
    if (is_inner || !il_nearest_point(&m->sides.tree, 0, x, y, &near) || near.distance > far)
        return NO_SIDE;
    return (uint32_t)near.id;
}

static bool look_at_vertices(marking *m, const il_ring *r)
{
    if (!il_grow(&m->side_of, &m->cap_side_of, r->n, sizeof *m->side_of) ||
        !il_grow(&m->edge, &m->cap_edge, r->n, sizeof *m->edge))
        return false;
    for (size_t v = 0; v < r->n; v++)
        m->side_of[v] = side_at(m, r->xy[2 * v], r->xy[2 * v + 1]);
    return true;
}

/* Both ends and the middle on the frame: along it, for it is straight between corners. */
static uint32_t side_along(const marking *m, const il_ring *r, size_t v)
{
    size_t w = v + 1 < r->n ? v + 1 : 0;
    const double *p = r->xy + 2 * v, *q = r->xy + 2 * w;
    if ((w == 0 && r->open) || m->side_of[v] == NO_SIDE || m->side_of[w] == NO_SIDE)
        return NO_SIDE;
    return side_at(m, p[0] + (q[0] - p[0]) / 2, p[1] + (q[1] - p[1]) / 2);
}

/* Which lines have vertices on which sides. */
static void meet_sides(marking *m, const il_slice *level, size_t n_levels)
{
    uint32_t line = 0;
    for (size_t k = 0; k < n_levels; k++)
        for (size_t i = 0; i < level[k].n; i++, line++) {
            const il_ring *r = &level[k].ring[i];
            for (size_t v = 0; v < r->n; v++) {
                uint32_t s = side_at(m, r->xy[2 * v], r->xy[2 * v + 1]);
                if (s != NO_SIDE)
                    m->line[s] = m->line[s] == NO_SIDE || m->line[s] == line ? line : MANY;
            }
        }
}

/* The LENGTH edges from that after vertex FROM lie on the frame.  They are the map's edge if one
 * of them is, or if they go around a corner. */
static bool mark_run(marking *m, il_ring *r, size_t from, size_t length)
{
    bool is_edge = false;
    for (size_t i = 0; i < length; i++) {
        size_t v = (from + i) % r->n;
        is_edge = is_edge || m->is_given || m->line[m->edge[v]] == MANY || m->edge[v] != m->edge[from];
    }
    if (!is_edge)
        return true;
    if (!r->mark) {
        r->mark = il_calloc(r->n, 1);
        r->cap_mark = r->n;
        if (!r->mark)
            return false;
    }
    for (size_t i = 0; i < length; i++)
        r->mark[(from + i) % r->n] |= IL_VERTEX_MAP_EDGE;
    m->n += length;
    return true;
}

/* Lines that isoloft interpolated are closed along nothing. */
static bool is_interpolated(const il_ring *r)
{
    for (size_t v = 0; v < r->n; v++)
        if (!r->mark || !(r->mark[v] & IL_VERTEX_INSERTED))
            return false;
    return true;
}

/* Runs of edges on the frame, one after the other from an edge that is not. */
static bool mark_ring(marking *m, il_ring *r)
{
    size_t start = r->n;
    if (is_interpolated(r))
        return true;
    if (!look_at_vertices(m, r))
        return false;
    for (size_t v = 0; v < r->n; v++)
        m->edge[v] = side_along(m, r, v);
    for (size_t v = 0; v < r->n && start == r->n; v++)
        start = m->edge[v] == NO_SIDE ? v : start;
    if (start == r->n)
        return true; /* all of a ring; a line has none after its last vertex */
    size_t length = 0;
    for (size_t i = 1; i <= r->n; i++) {
        size_t v = (start + i) % r->n;
        if (m->edge[v] != NO_SIDE) {
            length++;
            continue;
        }
        if (length > 0 && !mark_run(m, r, (start + i - length) % r->n, length))
            return false;
        length = 0;
    }
    return true;
}

static bool mark(marking *m, il_slice *level, size_t n_levels)
{
    m->line = il_alloc(m->sides.n, sizeof *m->line);
    if (!m->line)
        return false;
    for (size_t s = 0; s < m->sides.n; s++)
        m->line[s] = NO_SIDE;
    if (!m->is_given)
        meet_sides(m, level, n_levels);
    for (size_t k = 0; k < n_levels; k++)
        for (size_t i = 0; i < level[k].n; i++)
            if (!mark_ring(m, &level[k].ring[i]))
                return false;
    return true;
}

il_status il_map_edge_mark(il_slice *level, size_t n_levels, const il_frame_options *o, const il_stack_head *head,
                           size_t *n, il_error *err)
{
    marking m = { .is_given = o->kind == IL_FRAME_OUTLINE };
    il_frame_options box = *o;
    size_t n_lines = 0;
    for (size_t k = 0; k < n_levels; k++)
        n_lines += level[k].n;
    *n = 0;
    if (n_lines == 0)
        return IL_OK;
    box.kind = m.is_given ? IL_FRAME_OUTLINE : IL_FRAME_BBOX;
    il_status st = il_frame_sides_make(&m.sides, &box, head, level, n_levels, err);
    if (st == IL_OK && !mark(&m, level, n_levels))
        st = il_fail_nomem(err);
    il_frame_sides_free(&m.sides);
    il_free(m.line);
    il_free(m.side_of);
    il_free(m.edge);
    *n = m.n;
    return st;
}
