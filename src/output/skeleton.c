#include "config.h"
#include "output/skeleton.h"
#include "base/alloc.h"
#include "base/forest.h"

#include <stdlib.h>
#include <string.h>

void il_skeleton_free(il_skeleton *s)
{
    il_free(s->joint);
    il_free(s->bone);
    il_free(s->piece);
    il_free(s->first);
    il_free(s->piece_of);
    il_free(s->joint_of);
    *s = (il_skeleton)IL_SKELETON_INIT;
}

/* ---- joints --------------------------------------------------------------- */

/* The area centroid of ring R, summed about vertex 0. */
static void find_centre(const il_ring *r, double *x, double *y)
{
    const double *o = r->xy;
    double area2 = 0, sum[2] = { 0, 0 };
    for (size_t k = 1; k + 1 < r->n; k++) {
        double a[2] = { o[2 * k] - o[0], o[2 * k + 1] - o[1] }, b[2] = { o[2 * k + 2] - o[0], o[2 * k + 3] - o[1] };
        double cross = a[0] * b[1] - a[1] * b[0];
        area2 += cross;
        sum[0] += cross * (a[0] + b[0]);
        sum[1] += cross * (a[1] + b[1]);
    }
    *x = o[0] + (area2 > 0 ? sum[0] / area2 / 3 : 0);
    *y = o[1] + (area2 > 0 ? sum[1] / area2 / 3 : 0);
}

static bool is_outer(const il_ring *r)
{
    return !r->open && r->n > 2 && il_ring_area2(r) > 0;
}

static il_status find_joints(il_skeleton *s, const il_figure *f, il_error *err)
{
    size_t rings = 0;
    s->first = il_alloc(f->n + 1, sizeof *s->first);
    for (size_t k = 0; s->first && k < f->n; k++) {
        s->first[k] = rings;
        rings += f->level[k].slice.n;
    }
    s->joint = il_alloc(rings, sizeof *s->joint);
    s->joint_of = il_alloc(rings, sizeof *s->joint_of);
    s->piece_of = il_alloc(rings, sizeof *s->piece_of);
    if (!s->first || !s->joint || !s->joint_of || !s->piece_of)
        return il_fail_nomem(err);
    s->first[f->n] = rings;
    for (uint32_t k = 0; k < f->n; k++) {
        for (uint32_t i = 0; i < f->level[k].slice.n; i++) {
            const il_ring *r = &f->level[k].slice.ring[i];
            s->joint_of[s->first[k] + i] = UINT32_MAX;
            if (!is_outer(r))
                continue;
            s->joint_of[s->first[k] + i] = (uint32_t)s->n_joints;
            il_joint *j = &s->joint[s->n_joints++];
            *j = (il_joint){ .level = k, .ring = i };
            find_centre(r, &j->x, &j->y);
        }
    }
    return IL_OK;
}

/* ---- bones ---------------------------------------------------------------- */

/* Ring LOWER of the level below K and ring UPPER of level K; holes have no joints. */
static bool add_bone(il_skeleton *s, const il_figure *f, size_t k, uint32_t lower, uint32_t upper, il_bond bond)
{
    if (lower >= f->level[k - 1].slice.n || upper >= f->level[k].slice.n)
        return true;
    il_bone b = { s->joint_of[s->first[k - 1] + lower], s->joint_of[s->first[k] + upper], bond };
    if (b.a == UINT32_MAX || b.b == UINT32_MAX)
        return true;
    if (!il_grow(&s->bone, &s->cap_bones, s->n_bones + 1, sizeof *s->bone))
        return false;
    s->bone[s->n_bones++] = b;
    return true;
}

static il_bond bond_of(const il_link *l, double height)
{
    static const il_bond bond[] = { [IL_LINK_OVERLAP] = IL_BOND_OVERLAP,
                                    [IL_LINK_SLANT] = IL_BOND_OVERLAP, [IL_LINK_NEAR] = IL_BOND_NEAR,
                                    [IL_LINK_JOIN] = IL_BOND_JOIN, [IL_LINK_GIVEN] = IL_BOND_GIVEN };
    return l->reason == IL_LINK_JOIN && l->reach > height ? IL_BOND_GUESS : bond[l->reason];
}

/* Without links all that is known is that the rings belong together: the first of
 * each side stands for its side. */
static bool join_group(il_skeleton *s, const il_figure *f, size_t k, const il_group *g)
{
    bool ok = true;
    for (size_t i = 0; i < g->n_upper && g->n_lower > 0 && ok; i++)
        ok = add_bone(s, f, k, g->lower[0], g->upper[i], IL_BOND_GROUP);
    for (size_t i = 1; i < g->n_lower && g->n_upper > 0 && ok; i++)
        ok = add_bone(s, f, k, g->lower[i], g->upper[0], IL_BOND_GROUP);
    return ok;
}

/* An opening links a hole with what lies outside: no solid goes through it. */
static bool add_links(il_skeleton *s, const il_figure *f, size_t k, const il_group *g)
{
    double height = f->level[k].slice.z - f->level[k - 1].slice.z;
    bool ok = g->n_links > 0 || join_group(s, f, k, g);
    for (size_t i = 0; i < g->n_links && ok; i++)
        if (g->link[i].reason != IL_LINK_OPENING)
            ok = add_bone(s, f, k, g->link[i].lower, g->link[i].upper, bond_of(&g->link[i], height));
    return ok;
}

static int compare_bones(const void *pa, const void *pb)
{
    const il_bone *a = pa, *b = pb;
    if (a->a != b->a)
        return a->a < b->a ? -1 : 1;
    if (a->b != b->b)
        return a->b < b->b ? -1 : 1;
    return (int)a->bond - (int)b->bond;
}

/* Sorted, and of several between the same two the first. */
static void settle_bones(il_skeleton *s)
{
    size_t n = 0;
    if (s->n_bones > 0)
        qsort(s->bone, s->n_bones, sizeof *s->bone, compare_bones);
    for (size_t i = 0; i < s->n_bones; i++)
        if (n == 0 || s->bone[i].a != s->bone[n - 1].a || s->bone[i].b != s->bone[n - 1].b)
            s->bone[n++] = s->bone[i];
    s->n_bones = n;
    for (size_t i = 0; i < n; i++) {
        s->bonds[s->bone[i].bond]++;
        s->joint[s->bone[i].a].n_up++;
        s->joint[s->bone[i].b].n_down++;
    }
}

static il_status find_bones(il_skeleton *s, const il_figure *f, il_error *err)
{
    bool ok = true;
    for (size_t k = 1; k < f->n; k++) {
        const il_pair *p = &f->level[k].below;
        for (size_t i = 0; i < p->n_groups && ok; i++)
            ok = add_links(s, f, k, &p->group[i]);
    }
    if (!ok)
        return il_fail_nomem(err);
    settle_bones(s);
    return IL_OK;
}

/* ---- pieces --------------------------------------------------------------- */

/* A piece is known by its least joint until they are put in order. */
typedef struct ranked { il_piece piece; uint32_t leader; } ranked;

static int compare_ranked(const void *pa, const void *pb)
{
    const ranked *a = pa, *b = pb;
    if (a->piece.volume != b->piece.volume)
        return a->piece.volume > b->piece.volume ? -1 : 1;
    return (a->leader > b->leader) - (a->leader < b->leader);
}

/* What slice K stands for: half the way to its neighbours; 1 for a slice alone. */
static double thickness(const il_figure *f, size_t k)
{
    double below = k > 0 ? f->level[k].slice.z - f->level[k - 1].slice.z : 0;
    double above = k + 1 < f->n ? f->level[k + 1].slice.z - f->level[k].slice.z : 0;
    return f->n > 1 ? (below + above) / 2 : 1;
}

static void take_joint(il_piece *p, const il_figure *f, const il_joint *j)
{
    if (p->n_joints++ == 0)
        p->low = j->level;
    p->high = j->level;
    p->volume += il_ring_area2(&f->level[j->level].slice.ring[j->ring]) / 2 * thickness(f, j->level);
}

/* RANK[n_joints] is room, NUMBER[n_joints] will be the piece of each joint's leader. */
static il_status rank_pieces(il_skeleton *s, const il_figure *f, uint32_t *up, ranked *rank, uint32_t *number, il_error *err)
{
    for (uint32_t i = 0; i < s->n_joints; i++) {
        uint32_t leader = il_forest_leader(up, i); /* the least of its piece: it came first */
        if (leader == i) {
            number[i] = (uint32_t)s->n_pieces;
            rank[s->n_pieces++] = (ranked){ .leader = i };
        }
        take_joint(&rank[number[leader]].piece, f, &s->joint[i]);
    }
    if (s->n_pieces > 0)
        qsort(rank, s->n_pieces, sizeof *rank, compare_ranked);
    s->piece = il_alloc(s->n_pieces, sizeof *s->piece);
    if (!s->piece)
        return il_fail_nomem(err);
    for (uint32_t k = 0; k < s->n_pieces; k++) {
        s->piece[k] = rank[k].piece;
        number[rank[k].leader] = k;
    }
    for (uint32_t i = 0; i < s->n_joints; i++)
        s->joint[i].piece = number[il_forest_leader(up, i)];
    return IL_OK;
}

static il_status find_pieces(il_skeleton *s, const il_figure *f, il_error *err)
{
    uint32_t *up = il_alloc(s->n_joints, sizeof *up), *number = il_alloc(s->n_joints, sizeof *number);
    ranked *rank = il_alloc(s->n_joints, sizeof *rank);
    il_status st = up && number && rank ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK) {
        il_forest_plant(up, s->n_joints);
        for (size_t i = 0; i < s->n_bones; i++)
            il_forest_join(up, s->bone[i].a, s->bone[i].b);
        st = rank_pieces(s, f, up, rank, number, err);
    }
    il_free(up);
    il_free(number);
    il_free(rank);
    return st;
}

/* The rings RING[n] of a group in level K: holes go with its first outer ring. */
static void color_rings(il_skeleton *s, size_t k, const il_slice *slice, const uint32_t *ring, size_t n)
{
    uint32_t piece = UINT32_MAX;
    for (size_t i = 0; i < n; i++)
        if (ring[i] < slice->n && piece == UINT32_MAX)
            piece = s->piece_of[s->first[k] + ring[i]];
    for (size_t i = 0; i < n; i++)
        if (ring[i] < slice->n && s->joint_of[s->first[k] + ring[i]] == UINT32_MAX)
            s->piece_of[s->first[k] + ring[i]] = piece;
}

static void color_holes(il_skeleton *s, const il_figure *f)
{
    for (size_t i = 0; i < s->first[f->n]; i++)
        s->piece_of[i] = s->joint_of[i] == UINT32_MAX ? UINT32_MAX : s->joint[s->joint_of[i]].piece;
    for (size_t k = 1; k < f->n; k++) {
        const il_pair *p = &f->level[k].below;
        for (size_t i = 0; i < p->n_groups; i++) {
            color_rings(s, k - 1, &f->level[k - 1].slice, p->group[i].lower, p->group[i].n_lower);
            color_rings(s, k, &f->level[k].slice, p->group[i].upper, p->group[i].n_upper);
        }
    }
}

/* ---- all together ---------------------------------------------------------- */

/* Could what is at level K go on to level K + 1? */
static bool goes_on(const il_figure *f, size_t k)
{
    return k + 1 < f->n && !f->level[k + 1].below.gap;
}

static void count(il_skeleton *s, const il_figure *f)
{
    for (size_t i = 0; i < s->n_joints; i++) {
        il_joint *j = &s->joint[i];
        j->ends = (j->n_up == 0 && goes_on(f, j->level)) || (j->n_down == 0 && j->level > 0 && goes_on(f, j->level - 1));
        s->ends += j->ends;
        s->branches += j->n_up > 1 || j->n_down > 1;
    }
    s->loops = s->n_bones + s->n_pieces - s->n_joints;
}

il_status il_skeleton_find(il_skeleton *s, const il_figure *f, il_error *err)
{
    *s = (il_skeleton)IL_SKELETON_INIT;
    il_status st = find_joints(s, f, err);
    if (st == IL_OK)
        st = find_bones(s, f, err);
    if (st == IL_OK)
        st = find_pieces(s, f, err);
    if (st != IL_OK)
        return st;
    color_holes(s, f);
    count(s, f);
    return IL_OK;
}
