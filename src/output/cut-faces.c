#include "config.h"
#include "output/cut-faces.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "bridge/boxes.h"
#include "bridge/triangulation.h"
#include "model/arrange.h"

#include <math.h>

void il_cut_faces_free(il_cut_faces *f)
{
    il_free(f->xy);
    il_free(f->first);
    il_free(f->face);
    *f = (il_cut_faces)IL_CUT_FACES_INIT;
}

/* corner[3*n], across[3*n]: the triangles.  wall: of edges, what stands on them; inside[n];
 * region[n], face[n]: forests of triangles, without cuts and with them. */
typedef struct plan {
    il_arrangement a;
    il_keymap wall;
    uint32_t *corner, *across, *region, *face;
    unsigned char *inside, *done;
    size_t n;
} plan;

enum { RING = 1, ODD = 2, CUT = 4 };

static void plan_free(plan *p)
{
    il_arrangement_free(&p->a);
    il_keymap_free(&p->wall);
    il_free(p->corner);
    il_free(p->across);
    il_free(p->region);
    il_free(p->face);
    il_free(p->inside);
    il_free(p->done);
}

/* ---- rings and cuts, meeting in nodes ----------------------------------------- */

/* Rounded, a cut may end beside the outline: it is drawn out by this part of the slice. */
static const double BEYOND = 1e-5;

static double extent(const il_slice *s)
{
    double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < s->n; i++) {
        for (size_t k = 0; k < 2 * s->ring[i].n; k++) {
            low[k % 2] = fmin(low[k % 2], s->ring[i].xy[k]);
            high[k % 2] = fmax(high[k % 2], s->ring[i].xy[k]);
        }
    }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

/* Point K of C, the first and last drawn out by LENGTH. */
static void point_of(const il_cut *c, size_t k, double length, double at[2])
{
    const double *p = c->xy + 2 * k, *before = c->xy + 2 * (k == 0 ? 1 : k - 1);
    double d[2] = { p[0] - before[0], p[1] - before[1] }, step = hypot(d[0], d[1]);
    bool outer = (k == 0 || k + 1 == c->n) && step > 0;
    for (int i = 0; i < 2; i++)
        at[i] = p[i] + (outer ? d[i] / step * length : 0);
}

static bool add_cut(plan *p, const il_cut *c, uint32_t owner, double length)
{
    uint32_t last = UINT32_MAX;
    for (size_t k = 0; k < c->n; k++) {
        double at[2];
        point_of(c, k, length, at);
        uint32_t node = il_arrangement_node(&p->a, at[0], at[1], 0);
        if (node == UINT32_MAX || (last != UINT32_MAX && node != last && !il_arrangement_edge(&p->a, last, node, owner, 0)))
            return false;
        last = node;
    }
    return true;
}

/* Contours and cuts that make sense meet seldom; n that all cross would make n^2 nodes. */
enum { MEETINGS_MOST = 64, MEETINGS_LEAST = 100000 };

static il_status check_meetings(const il_arrangement *a, il_error *err)
{
    uint32_t *pair = NULL;
    size_t n = 0;
    double *box = il_alloc(a->n_edges, 4 * sizeof *box);
    if (!box)
        return il_fail_nomem(err);
    for (size_t i = 0; i < a->n_edges; i++) {
        const double *p = a->xy + 2 * a->edge[2 * i], *q = a->xy + 2 * a->edge[2 * i + 1];
        for (int k = 0; k < 2; k++) {
            box[4 * i + (size_t)k] = fmin(p[k], q[k]);
            box[4 * i + 2 + (size_t)k] = fmax(p[k], q[k]);
        }
    }
    il_status st = il_box_pairs(box, a->n_edges, MEETINGS_LEAST + MEETINGS_MOST * a->n_edges, &pair, &n, err);
    il_free(pair);
    il_free(box);
    return st;
}

static il_status arrange(plan *p, const il_slice *s, const il_cut *cut, size_t n, bool upper, il_error *err)
{
    double length = BEYOND * extent(s);
    size_t crossings, touches;
    il_status st = il_arrangement_from_slice(&p->a, s, il_slice_cell(s, false), err);
    for (size_t i = 0; i < n && st == IL_OK; i++)
        if (cut[i].upper == upper && cut[i].n > 1 && !add_cut(p, &cut[i], (uint32_t)s->n, length))
            st = il_fail_nomem(err);
    if (st == IL_OK)
        st = check_meetings(&p->a, err);
    return st == IL_OK ? il_arrangement_settle(&p->a, &crossings, &touches, err) : st;
}

/* ---- triangles, and on which side of the walls they lie -------------------------- */

/* Of a ring in disorder some edges end where they begin. */
static void drop_points(il_arrangement *a)
{
    size_t n = 0;
    for (size_t i = 0; i < a->n_edges; i++) {
        if (a->edge[2 * i] == a->edge[2 * i + 1])
            continue;
        a->edge[2 * n] = a->edge[2 * i];
        a->edge[2 * n + 1] = a->edge[2 * i + 1];
        a->owner[n++] = a->owner[i];
    }
    a->n_edges = n;
}

static il_status build_walls(plan *p, uint32_t n_rings, il_error *err)
{
    for (size_t i = 0; i < p->a.n_edges; i++) {
        const uint32_t *e = p->a.edge + 2 * i;
        uint32_t *wall = il_keymap_put(&p->wall, IL_KEYMAP_EDGE(e[0], e[1]), 0);
        if (!wall)
            return il_fail_nomem(err);
        *wall = p->a.owner[i] < n_rings ? (*wall | RING) ^ ODD : *wall | CUT;
    }
    return IL_OK;
}

static uint32_t wall_at(const plan *p, size_t t, int k)
{
    uint32_t a = p->corner[3 * t + (size_t)k], b = p->corner[3 * t + (size_t)(k + 1) % 3];
    return il_keymap_get(&p->wall, IL_KEYMAP_EDGE(a, b), 0);
}

/* *CROSSES: the arrangement is none, and there are no triangles. */
static il_status triangulate(plan *p, bool *crosses, il_error *err)
{
    il_triangulation *t = NULL;
    il_status st = il_triangulation_try(&t, p->a.xy, p->a.n_nodes, p->a.edge, p->a.n_edges, crosses, err);
    if (st == IL_OK && t)
        st = il_triangulation_export(t, &p->corner, &p->across, &p->n, err);
    il_triangulation_free(t);
    p->inside = il_alloc(p->n, 1);
    p->done = il_calloc(3 * p->n, 1);
    p->region = il_alloc(p->n, sizeof *p->region);
    p->face = il_alloc(p->n, sizeof *p->face);
    return st != IL_OK || (p->inside && p->done && p->region && p->face) ? st : il_fail_nomem(err);
}

/* From the hull inwards, across each odd number of rings to the other side. */
static il_status find_inside(plan *p, il_error *err)
{
    enum { UNKNOWN = 2 };
    uint32_t *todo = il_alloc(p->n, sizeof *todo);
    size_t n = 0;
    if (!todo)
        return il_fail_nomem(err);
    for (size_t t = 0; t < p->n; t++)
        p->inside[t] = UNKNOWN;
    for (uint32_t t = 0; t < p->n; t++) {
        for (int k = 0; k < 3; k++) {
            if (p->across[3 * t + (size_t)k] != UINT32_MAX || p->inside[t] != UNKNOWN)
                continue;
            p->inside[t] = (wall_at(p, t, k) & ODD) != 0;
            todo[n++] = t;
        }
    }
    while (n > 0) {
        uint32_t t = todo[--n];
        for (int k = 0; k < 3; k++) {
            uint32_t other = p->across[3 * t + (size_t)k];
            if (other == UINT32_MAX || p->inside[other] != UNKNOWN)
                continue;
            p->inside[other] = p->inside[t] ^ ((wall_at(p, t, k) & ODD) != 0);
            todo[n++] = other;
        }
    }
    il_free(todo);
    return IL_OK;
}

static void join_triangles(plan *p)
{
    il_forest_plant(p->region, p->n);
    il_forest_plant(p->face, p->n);
    for (uint32_t t = 0; t < p->n; t++) {
        for (int k = 0; k < 3; k++) {
            uint32_t other = p->across[3 * t + (size_t)k], wall = wall_at(p, t, k);
            if (other == UINT32_MAX || (wall & RING))
                continue;
            il_forest_join(p->region, t, other);
            if (!(wall & CUT))
                il_forest_join(p->face, t, other);
        }
    }
}

/* ---- what the pieces are bounded by ---------------------------------------------- */

/* NUMBER[leader] of each face inside whose region has another: by its least triangle. */
static void number_faces(plan *p, uint32_t *number, size_t *n_faces)
{
    *n_faces = 0;
    for (uint32_t t = 0; t < p->n; t++)
        number[t] = UINT32_MAX;
    for (uint32_t t = 0; t < p->n; t++) { /* a face whose leader is not its region's: so there are two */
        uint32_t face = il_forest_leader(p->face, t), region = il_forest_leader(p->region, t);
        if (p->inside[t] == 1 && face != region)
            number[face] = number[region] = 0;
    }
    for (uint32_t t = 0; t < p->n; t++)
        if (number[t] == 0)
            number[t] = (uint32_t)(*n_faces)++;
}

static bool same_face(plan *p, uint32_t t, uint32_t other)
{
    return other != UINT32_MAX && il_forest_leader(p->face, t) == il_forest_leader(p->face, other);
}

static bool add_point(il_cut_faces *f, const double *xy)
{
    if (!il_grow(&f->xy, &f->cap_points, f->n_points + 1, 2 * sizeof *f->xy))
        return false;
    f->xy[2 * f->n_points] = xy[0];
    f->xy[2 * f->n_points++ + 1] = xy[1];
    return true;
}

/* Along the edges that bound the face of T, from its edge K on, the face on the left. */
static bool walk(plan *p, uint32_t t, int k, il_cut_faces *f)
{
    while (!p->done[3 * t + (size_t)k]) {
        p->done[3 * t + (size_t)k] = 1;
        if (!add_point(f, p->a.xy + 2 * p->corner[3 * t + (size_t)k]))
            return false;
        k = (k + 1) % 3;
        for (uint32_t other = p->across[3 * t + (size_t)k]; same_face(p, t, other); other = p->across[3 * t + (size_t)k]) {
            int back = 0;
            while (p->across[3 * other + (size_t)back] != t)
                back++;
            t = other;
            k = (back + 1) % 3;
        }
    }
    return true;
}

static bool trace(plan *p, const uint32_t *number, il_cut_faces *f)
{
    bool ok = il_grow(&f->first, &f->cap_first, 1, sizeof *f->first);
    for (uint32_t t = 0; t < p->n && ok; t++) {
        uint32_t face = number[il_forest_leader(p->face, t)];
        for (int k = 0; k < 3 && ok && face != UINT32_MAX; k++) {
            if (p->done[3 * t + (size_t)k] || same_face(p, t, p->across[3 * t + (size_t)k]))
                continue;
            ok = il_grow(&f->first, &f->cap_first, f->n_loops + 2, sizeof *f->first) &&
                 il_grow(&f->face, &f->cap_face, f->n_loops + 1, sizeof *f->face);
            if (!ok)
                break;
            f->first[f->n_loops] = f->n_points;
            f->face[f->n_loops++] = face;
            ok = walk(p, t, k, f);
        }
    }
    if (ok)
        f->first[f->n_loops] = f->n_points;
    return ok;
}

static il_status find_faces(plan *p, uint32_t n_rings, il_cut_faces *f, il_error *err)
{
    bool crosses = false;
    drop_points(&p->a);
    il_status st = build_walls(p, n_rings, err);
    if (st == IL_OK)
        st = triangulate(p, &crosses, err);
    if (st == IL_OK)
        st = find_inside(p, err);
    uint32_t *number = st == IL_OK ? il_alloc(p->n, sizeof *number) : NULL;
    if (st == IL_OK && !number)
        st = il_fail_nomem(err);
    if (st == IL_OK) {
        join_triangles(p);
        number_faces(p, number, &f->n_faces);
        st = trace(p, number, f) ? IL_OK : il_fail_nomem(err);
    }
    il_free(number);
    return st;
}

static bool has_cuts(const il_cut *cut, size_t n, bool upper)
{
    for (size_t i = 0; i < n; i++)
        if (cut[i].upper == upper)
            return true;
    return false;
}

il_status il_cut_faces_find(il_cut_faces *f, const il_slice *s, const il_cut *cut, size_t n, bool upper, il_error *err)
{
    plan p = { .a = IL_ARRANGEMENT_INIT, .wall = IL_KEYMAP_INIT };
    il_error why = IL_ERROR_INIT;
    *f = (il_cut_faces)IL_CUT_FACES_INIT;
    if (s->n == 0 || !has_cuts(cut, n, upper))
        return IL_OK;
    il_status st = arrange(&p, s, cut, n, upper, &why);
    if (st == IL_OK)
        st = find_faces(&p, (uint32_t)s->n, f, &why);
    plan_free(&p);
    if (st == IL_E_NOMEM)
        return il_fail_nomem(err);
    if (st != IL_OK) /* rings in disorder, which a picture does without */
        il_cut_faces_free(f);
    return IL_OK;
}
