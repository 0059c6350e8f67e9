#include "config.h"
#include "terrain/refine.h"
#include "base/alloc.h"
#include "bridge/predicates.h"

#include <math.h>

/* How many triangles away from where it should be a point is looked for. */
enum { STEPS_MOST = 4 };

/* Of how many triangles' corners the nearest is looked for. */
enum { CAVITY_MOST = 64 };

il_refine il_refine_begin(il_tin *t, il_chart *c)
{
    return (il_refine){ .t = t, .c = c, .cap_corners = t->n, .cap_across = t->n, .cap_edges = t->n, .cap_faces = t->n,
                        .cap_sides = t->n_sides, .cap_cliffs = t->n_sides };
}

void il_refine_end(il_refine *r)
{
    il_free(r->star);
    *r = (il_refine){ 0 };
}

static const double *place(const il_refine *r, size_t k)
{
    return r->c->xy + 2 * (size_t)r->t->corner[k];
}

static size_t before(size_t k)
{
    return il_tin_after(il_tin_after(k));
}

/* ---- triangles --------------------------------------------------------------- */

/* A side of a triangle: what lies across, and the edge of the chart that it is. */
typedef struct side {
    uint32_t across, edge;
} side;

static side side_of(const il_refine *r, size_t k)
{
    return (side){ r->t->across[k], r->t->edge[k] };
}

/* Between two triangles of one face. */
static side open_to(uint32_t triangle)
{
    return (side){ triangle, IL_CHART_NONE };
}

static void set(il_refine *r, uint32_t triangle, const uint32_t corner[3], const side s[3])
{
    for (size_t i = 0; i < 3; i++) {
        size_t k = 3 * (size_t)triangle + i;
        r->t->corner[k] = corner[i];
        r->t->across[k] = s[i].across;
        r->t->edge[k] = s[i].edge;
    }
}

/* What had OLD across has NEW there now. */
static void relink(il_refine *r, uint32_t triangle, uint32_t old, uint32_t new)
{
    if (triangle == IL_CHART_NONE)
        return;
    size_t k = 3 * (size_t)triangle;
    while (r->t->across[k] != old)
        k++;
    r->t->across[k] = new;
}

/* Room for N more triangles, and the first of them. */
static bool make_room(il_refine *r, size_t n, uint32_t *first)
{
    il_tin *t = r->t;
    *first = (uint32_t)t->n;
    return t->n + n < IL_CHART_NONE && il_grow(&t->corner, &r->cap_corners, t->n + n, 3 * sizeof *t->corner) &&
           il_grow(&t->across, &r->cap_across, t->n + n, 3 * sizeof *t->across) &&
           il_grow(&t->edge, &r->cap_edges, t->n + n, 3 * sizeof *t->edge) &&
           il_grow(&t->face, &r->cap_faces, t->n + n, sizeof *t->face) &&
           il_grow(&r->star, &r->cap_star, 4, sizeof *r->star);
}

/* ---- flips -------------------------------------------------------------------- */

/* Edge K, from a to b, of (a, b, c) and (b, a, d): (a, d, c) and (d, b, c) take their places. */
static void flip(il_refine *r, size_t k)
{
    const il_tin *t = r->t;
    size_t j = il_tin_twin(t, k);
    uint32_t near = (uint32_t)(k / 3), far = (uint32_t)(j / 3);
    uint32_t a = t->corner[k], b = t->corner[j], c = t->corner[before(k)], d = t->corner[before(j)];
    side bc = side_of(r, il_tin_after(k)), ca = side_of(r, before(k)), ad = side_of(r, il_tin_after(j)), db = side_of(r, before(j));
    set(r, near, (uint32_t[3]){ a, d, c }, (side[3]){ ad, open_to(far), ca });
    set(r, far, (uint32_t[3]){ d, b, c }, (side[3]){ db, bc, open_to(near) });
    relink(r, ad.across, far, near);
    relink(r, bc.across, near, far);
}

bool il_refine_is_convex(const il_refine *r, size_t k)
{
    size_t j = il_tin_twin(r->t, k);
    const double *a = place(r, k), *b = place(r, j), *c = place(r, before(k)), *d = place(r, before(j));
    return il_orientation(a, d, c) > 0 && il_orientation(d, b, c) > 0;
}

bool il_refine_flip(il_refine *r, size_t k)
{
    uint32_t far = r->t->across[k];
    if (!il_grow(&r->star, &r->cap_star, 2, sizeof *r->star))
        return false;
    flip(r, k);
    r->n_star = 2;
    r->star[0] = (uint32_t)(k / 3);
    r->star[1] = far;
    return true;
}

/* Does the far corner over edge K lie in the circle of its triangle? */
static bool is_illegal(const il_refine *r, size_t k)
{
    const il_tin *t = r->t;
    if (t->edge[k] != IL_CHART_NONE || t->across[k] == IL_CHART_NONE)
        return false;
    return il_in_circle(place(r, k), place(r, il_tin_after(k)), place(r, before(k)), place(r, before(il_tin_twin(t, k)))) > 0;
}

/* Flip the edges opposite the new node, the first of each triangle about it, until all are
 * legal; each flip brings it another triangle. */
static bool legalise(il_refine *r)
{
    for (size_t i = 0; i < r->n_star; i++) {
        size_t k = 3 * (size_t)r->star[i];
        while (is_illegal(r, k)) {
            uint32_t far = r->t->across[k];
            if (!il_grow(&r->star, &r->cap_star, r->n_star + 1, sizeof *r->star))
                return false;
            flip(r, k);
            r->star[r->n_star++] = far;
        }
    }
    return true;
}

/* ---- points -------------------------------------------------------------------- */

/* The triangle (a, b, c) becomes three about NODE. */
static void put_inside(il_refine *r, uint32_t triangle, uint32_t node, uint32_t first)
{
    il_tin *t = r->t;
    size_t k = 3 * (size_t)triangle;
    uint32_t a = t->corner[k], b = t->corner[k + 1], c = t->corner[k + 2], second = first + 1;
    side ab = side_of(r, k), bc = side_of(r, k + 1), ca = side_of(r, k + 2);
    t->n += 2;
    t->face[first] = t->face[second] = t->face[triangle];
    set(r, triangle, (uint32_t[3]){ a, b, node }, (side[3]){ ab, open_to(first), open_to(second) });
    set(r, first, (uint32_t[3]){ b, c, node }, (side[3]){ bc, open_to(second), open_to(triangle) });
    set(r, second, (uint32_t[3]){ c, a, node }, (side[3]){ ca, open_to(triangle), open_to(first) });
    relink(r, bc.across, triangle, first);
    relink(r, ca.across, triangle, second);
    r->n_star = 3;
    r->star[0] = triangle, r->star[1] = first, r->star[2] = second;
}

/* Half of the edge from a to b, seen from triangle (a, b, c), which becomes (b, c, NODE) and
 * (c, a, NODE) = NEW; across them lie, over the halves at b and at a, AT_B and AT_A. */
static void halve(il_refine *r, size_t k, uint32_t node, uint32_t new, side at_b, side at_a)
{
    il_tin *t = r->t;
    uint32_t triangle = (uint32_t)(k / 3), a = t->corner[k], b = t->corner[il_tin_after(k)], c = t->corner[before(k)];
    side bc = side_of(r, il_tin_after(k)), ca = side_of(r, before(k));
    t->face[new] = t->face[triangle];
    set(r, triangle, (uint32_t[3]){ b, c, node }, (side[3]){ bc, open_to(new), at_b });
    set(r, new, (uint32_t[3]){ c, a, node }, (side[3]){ ca, at_a, open_to(triangle) });
    relink(r, ca.across, triangle, new);
    r->star[r->n_star++] = triangle;
    r->star[r->n_star++] = new;
}

/* On edge K from a to b: its triangles become two each.  AT_A, AT_B: the edges of the chart that
 * its halves are. */
static void put_between(il_refine *r, size_t k, uint32_t node, uint32_t first, uint32_t at_a, uint32_t at_b)
{
    il_tin *t = r->t;
    uint32_t near = (uint32_t)(k / 3), far = t->across[k], second = far == IL_CHART_NONE ? far : first + 1;
    size_t j = far == IL_CHART_NONE ? 0 : il_tin_twin(t, k);
    r->n_star = 0;
    t->n += far == IL_CHART_NONE ? 1 : 2;
    /* from the far side b comes first: it becomes (a, d, NODE) and (d, b, NODE) */
    halve(r, k, node, first, (side){ second, at_b }, (side){ far, at_a });
    if (far != IL_CHART_NONE)
        halve(r, j, node, second, (side){ first, at_a }, (side){ near, at_b });
}

/* Is P strictly inside the triangles on edge K, but for that edge itself? */
static bool is_between(const il_refine *r, size_t k, const double p[2])
{
    const double *a = place(r, k), *b = place(r, il_tin_after(k)), *c = place(r, before(k));
    if (il_orientation(b, c, p) <= 0 || il_orientation(c, a, p) <= 0)
        return false;
    if (r->t->across[k] == IL_CHART_NONE)
        return true;
    const double *d = place(r, before(il_tin_twin(r->t, k)));
    return il_orientation(a, d, p) > 0 && il_orientation(d, b, p) > 0;
}

/* Which triangle P is in, and on which of its edges (SIZE_MAX: none); false when it is beyond the
 * face's lines, or on a node or line. */
static bool find(const il_refine *r, const double p[2], size_t *triangle, size_t *on)
{
    for (int step = 0; step < STEPS_MOST; step++) {
        size_t out = SIZE_MAX, n_on = 0;
        *on = SIZE_MAX;
        for (size_t k = 3 * *triangle; k < 3 * *triangle + 3; k++) {
            int turn = il_orientation(place(r, k), place(r, il_tin_after(k)), p);
            out = turn < 0 ? k : out;
            *on = turn == 0 ? k : *on;
            n_on += turn == 0;
        }
        if (out == SIZE_MAX)
            return n_on == 0 || (n_on == 1 && r->t->edge[*on] == IL_CHART_NONE && r->t->across[*on] != IL_CHART_NONE);
        if (r->t->edge[out] != IL_CHART_NONE || r->t->across[out] == IL_CHART_NONE)
            return false;
        *triangle = r->t->across[out];
    }
    return false;
}

/* The lesser of LEAST2 and the square of the distance from A to B. */
static double nearer(double least2, const double a[2], const double b[2])
{
    double x = b[0] - a[0], y = b[1] - a[1], d2 = x * x + y * y;
    return d2 < least2 ? d2 : least2;
}

/* Without inner nodes the triangles hang together as a tree: each is come to once. */
double il_refine_clearance(il_refine *r, size_t triangle, const double p[2])
{
    double least2 = INFINITY;
    r->n_star = 0;
    for (size_t k = 3 * triangle; k < 3 * triangle + 3; k++) {
        least2 = nearer(least2, place(r, k), p);
        if (!il_grow(&r->star, &r->cap_star, r->n_star + 1, sizeof *r->star))
            return INFINITY;
        r->star[r->n_star++] = (uint32_t)k;
    }
    for (size_t n = 0; r->n_star > 0 && n < CAVITY_MOST; n++) {
        size_t k = r->star[--r->n_star];
        if (r->t->edge[k] != IL_CHART_NONE || r->t->across[k] == IL_CHART_NONE)
            continue;
        size_t j = il_tin_twin(r->t, k);
        const double *far = place(r, before(j));
        if (il_in_circle(place(r, j), place(r, il_tin_after(j)), far, p) <= 0)
            continue;
        least2 = nearer(least2, far, p);
        if (!il_grow(&r->star, &r->cap_star, r->n_star + 2, sizeof *r->star))
            return INFINITY;
        r->star[r->n_star++] = (uint32_t)il_tin_after(j);
        r->star[r->n_star++] = (uint32_t)before(j);
    }
    return sqrt(least2);
}

bool il_refine_insert(il_refine *r, size_t triangle, const double p[2], uint32_t *node)
{
    uint32_t first = 0;
    size_t on = SIZE_MAX;
    *node = IL_CHART_NONE;
    if (!find(r, p, &triangle, &on) || (on != SIZE_MAX && !is_between(r, on, p)))
        return true;
    if (!make_room(r, 2, &first))
        return false;
    *node = il_chart_node_at(r->c, p[0], p[1]);
    if (*node == IL_CHART_NONE)
        return false;
    if (on == SIZE_MAX)
        put_inside(r, (uint32_t)triangle, *node, first);
    else
        put_between(r, on, *node, first, IL_CHART_NONE, IL_CHART_NONE);
    return legalise(r);
}

/* ---- the frame ------------------------------------------------------------------ */

/* Edge E of the frame ends at NODE now, and a new one leads on from there. */
static bool divide_edge(il_refine *r, uint32_t e, uint32_t node, uint32_t *rest)
{
    il_chart *c = r->c;
    il_tin *t = r->t;
    *rest = (uint32_t)c->n_edges;
    if (!il_grow(&t->side, &r->cap_sides, t->n_sides + 1, 2 * sizeof *t->side) ||
        !il_grow(&t->cliff, &r->cap_cliffs, t->n_sides + 1, 2 * sizeof *t->cliff) ||
        !il_chart_add_edge(c, node, c->edge[2 * (size_t)e + 1], IL_CHART_NONE, -1))
        return false;
    c->edge[2 * (size_t)e + 1] = node;
    for (size_t i = 0; i < 2; i++) {
        t->side[2 * t->n_sides + i] = t->side[2 * (size_t)e + i];
        t->cliff[2 * t->n_sides + i] = -1;
    }
    t->n_sides++;
    return true;
}

bool il_refine_divide(il_refine *r, size_t k, const double p[2], uint32_t *node)
{
    uint32_t first = 0, e = r->t->edge[k], rest = 0;
    *node = IL_CHART_NONE;
    if (!is_between(r, k, p))
        return true;
    if (!make_room(r, 2, &first))
        return false;
    size_t n = r->c->n_nodes;
    *node = il_chart_node_at(r->c, p[0], p[1]);
    if (*node == IL_CHART_NONE)
        return false;
    if (*node != n) { /* rounding has brought it to another's place */
        *node = IL_CHART_NONE;
        return true;
    }
    bool forward = r->c->edge[2 * (size_t)e] == r->t->corner[k];
    if (!divide_edge(r, e, *node, &rest))
        return false;
    r->c->node[*node].is_frame = true;
    put_between(r, k, *node, first, forward ? e : rest, forward ? rest : e);
    return legalise(r);
}
