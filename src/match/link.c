#include "config.h"
#include "match/link.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "bridge/boxes.h"
#include "bridge/predicates.h"
#include "match/complement.h"
#include "match/patch.h"
#include "match/under.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The edges of a slice in one row: edge e runs from a[e] to b[e]; those of ring i
 * are first[i] .. first[i + 1].  outer[i]: the outer ring of i's region. */
typedef struct edges {
    const il_slice *slice;
    const double **a, **b;
    uint32_t *ring_of;
    double *box;          /* [4*n] */
    size_t *first;        /* [rings + 1] */
    uint32_t *outer;      /* [rings] */
    size_t n;
    il_under under;
} edges;

static void edges_free(edges *e)
{
    il_free(e->a);
    il_free(e->b);
    il_free(e->ring_of);
    il_free(e->box);
    il_free(e->first);
    il_free(e->outer);
    il_under_free(&e->under);
}

static void add_edge(edges *e, const double *a, const double *b, uint32_t ring)
{
    double *box = e->box + 4 * e->n;
    e->a[e->n] = a;
    e->b[e->n] = b;
    e->ring_of[e->n] = ring;
    box[0] = fmin(a[0], b[0]), box[1] = fmin(a[1], b[1]);
    box[2] = fmax(a[0], b[0]), box[3] = fmax(a[1], b[1]);
    e->n++;
}

static il_status edges_take(edges *e, const il_slice *s, il_error *err)
{
    size_t n = il_slice_points(s);
    *e = (edges){ .slice = s };
    e->a = il_alloc(n, sizeof *e->a);
    e->b = il_alloc(n, sizeof *e->b);
    e->ring_of = il_alloc(n, sizeof *e->ring_of);
    e->box = il_alloc(n, 4 * sizeof *e->box);
    e->first = il_alloc(s->n + 1, sizeof *e->first);
    e->outer = il_alloc(s->n, sizeof *e->outer);
    if (!e->a || !e->b || !e->ring_of || !e->box || !e->first || !e->outer)
        return il_fail_nomem(err);
    for (uint32_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        e->first[i] = e->n;
        for (size_t k = 0; k < r->n; k++)
            add_edge(e, r->xy + 2 * k, r->xy + 2 * (k + 1 < r->n ? k + 1 : 0), i);
    }
    e->first[s->n] = e->n;
    return il_under_make(&e->under, (const double *const *)e->a, (const double *const *)e->b, e->box, e->n, err);
}

/* ---- which rings bound one region ---- */

static int compare_hits(const void *p, const void *q)
{
    const uint32_t *a = p, *b = q;
    if (a[0] != b[0])
        return a[0] < b[0] ? -1 : 1;
    return a[1] < b[1] ? -1 : a[1] > b[1];
}

/* The region is on the left of edge F: above it, when it runs to the right. */
static bool has_region_above(const edges *e, size_t f)
{
    return e->a[f][0] < e->b[f][0];
}

/* The edge next below hole I, straight below the lowest vertex: there the hole runs
 * to the left, with its region below.  e->n when there is none. */
static size_t edge_under_hole(const edges *e, uint32_t i)
{
    size_t first = e->first[i], end = e->first[i + 1], lowest = first;
    for (size_t k = first; k < end; k++)
        if (e->a[k][1] < e->a[lowest][1] || (e->a[k][1] == e->a[lowest][1] && e->a[k][0] < e->a[lowest][0]))
            lowest = k;
    size_t before = lowest > first ? lowest - 1 : end - 1;
    bool from_right = e->a[before][0] > e->a[lowest][0];
    return il_under_edge(&e->under, from_right ? before : lowest, !from_right);
}

/* What bounds a region from below is a part of its outline: its outer ring, or
 * another hole, that lies lower. */
static il_status find_outers(edges *e, il_error *err)
{
    uint32_t rings = (uint32_t)e->slice->n, *up = il_alloc(rings, sizeof *up), *outer_of = il_alloc(rings, sizeof *outer_of);
    bool ok = up && outer_of;
    if (ok)
        il_forest_plant(up, rings);
    for (uint32_t i = 0; ok && i < rings; i++) {
        size_t f = il_ring_area2(&e->slice->ring[i]) < 0 ? edge_under_hole(e, i) : e->n;
        if (f < e->n && has_region_above(e, f))
            il_forest_join(up, i, e->ring_of[f]);
        outer_of[i] = UINT32_MAX;
    }
    for (uint32_t i = 0; ok && i < rings; i++)
        if (il_ring_area2(&e->slice->ring[i]) > 0)
            outer_of[il_forest_leader(up, i)] = i;
    for (uint32_t i = 0; ok && i < rings; i++) {
        uint32_t outer = outer_of[il_forest_leader(up, i)];
        e->outer[i] = outer != UINT32_MAX ? outer : i;
    }
    il_free(up);
    il_free(outer_of);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* ---- which regions overlap ---- */

typedef struct linker {
    edges side[2];
    uint32_t *link;           /* [2*n_links] (lower ring, upper ring), outer ones */
    size_t n_links, cap_links;
} linker;

static bool note_link(linker *l, uint32_t lower, uint32_t upper)
{
    if (!il_grow(&l->link, &l->cap_links, 2 * (l->n_links + 1), sizeof *l->link))
        return false;
    l->link[2 * l->n_links] = l->side[0].outer[lower];
    l->link[2 * l->n_links + 1] = l->side[1].outer[upper];
    l->n_links++;
    return true;
}

static il_status link_meeting(linker *l, il_error *err)
{
    const edges *e = l->side;
    uint32_t *pair = NULL;
    size_t n = 0;
    il_status st = il_box_pairs_between(e[0].box, e[0].n, e[1].box, e[1].n, SIZE_MAX, &pair, &n, err);
    uint32_t last[2] = { UINT32_MAX, UINT32_MAX };
    for (size_t i = 0; st == IL_OK && i < n; i++) {
        uint32_t p = pair[2 * i], q = pair[2 * i + 1], ring[2] = { e[0].ring_of[p], e[1].ring_of[q] };
        if ((ring[0] == last[0] && ring[1] == last[1]) || !il_edges_meet(e[0].a[p], e[0].b[p], e[1].a[q], e[1].b[q]))
            continue;
        memcpy(last, ring, sizeof last);
        if (!note_link(l, ring[0], ring[1]))
            st = il_fail_nomem(err);
    }
    il_free(pair);
    return st;
}

/* Regions whose outlines do not meet overlap when a ring of one lies in the other:
 * any of its vertices, and then that is what bounds the other next below. */
static il_status link_nested(linker *l, int inner, il_error *err)
{
    const edges *in = &l->side[inner], *about = &l->side[1 - inner];
    for (uint32_t i = 0; i < in->slice->n; i++) {
        size_t f = il_under_point(&about->under, in->a[in->first[i]]);
        if (f == about->n || !has_region_above(about, f))
            continue;
        uint32_t ring = about->ring_of[f];
        if (!note_link(l, inner == 0 ? i : ring, inner == 0 ? ring : i))
            return il_fail_nomem(err);
    }
    return IL_OK;
}

static void linker_free(linker *l)
{
    edges_free(&l->side[0]);
    edges_free(&l->side[1]);
    il_free(l->link);
}

/* Sorted, each once. */
static void sort_links(linker *l)
{
    size_t n = 0;
    if (l->n_links > 0)
        qsort(l->link, l->n_links, 2 * sizeof *l->link, compare_hits);
    for (size_t i = 0; i < l->n_links; i++)
        if (i == 0 || compare_hits(l->link + 2 * i, l->link + 2 * (n - 1)) != 0)
            memmove(l->link + 2 * n++, l->link + 2 * i, 2 * sizeof *l->link);
    l->n_links = n;
}

il_status il_link_outers(const il_slice *s, uint32_t *outer, il_error *err)
{
    edges e;
    il_status st = edges_take(&e, s, err);
    if (st == IL_OK)
        st = find_outers(&e, err);
    if (st == IL_OK)
        memcpy(outer, e.outer, s->n * sizeof *outer);
    edges_free(&e);
    return st;
}

il_status il_link_overlaps(const il_slice *lower, const il_slice *upper, uint32_t **link, size_t *n, il_error *err)
{
    linker l = { 0 };
    *link = NULL;
    *n = 0;
    if (lower->n == 0 || upper->n == 0)
        return IL_OK;
    il_status st = edges_take(&l.side[0], lower, err);
    if (st == IL_OK)
        st = edges_take(&l.side[1], upper, err);
    for (int k = 0; st == IL_OK && k < 2; k++)
        st = find_outers(&l.side[k], err);
    if (st == IL_OK)
        st = link_meeting(&l, err);
    for (int k = 0; st == IL_OK && k < 2; k++)
        st = link_nested(&l, k, err);
    if (st == IL_OK) {
        sort_links(&l);
        *link = l.link;
        *n = l.n_links;
        l.link = NULL;
    }
    linker_free(&l);
    return st;
}

/* ---- groups ---- */

/* A forest over the lower rings and then the upper. */
static void join_rings(uint32_t *up, const uint32_t *outer, uint32_t n_lower, uint32_t n_upper, const il_link *link, size_t n)
{
    il_forest_plant(up, n_lower + n_upper);
    for (uint32_t i = 0; i < n_lower + n_upper; i++)
        il_forest_join(up, i, i < n_lower ? outer[i] : n_lower + outer[i]);
    for (size_t i = 0; i < n; i++)
        il_forest_join(up, link[i].lower, n_lower + link[i].upper);
}

static bool add_ring(uint32_t **list, size_t *n, size_t *cap, uint32_t ring)
{
    if (!il_grow(list, cap, *n + 1, sizeof **list))
        return false;
    (*list)[(*n)++] = ring;
    return true;
}

/* Leaders are the least of their sets, so they come in the order of groups. */
static bool make_groups(il_pair *p, uint32_t *up, uint32_t *group_of, uint32_t n_lower, uint32_t n, const il_link *link, size_t n_links)
{
    bool ok = true;
    for (uint32_t i = 0; ok && i < n; i++) {
        uint32_t leader = il_forest_leader(up, i);
        if (leader == i) {
            ok = il_grow(&p->group, &p->cap_groups, p->n_groups + 1, sizeof *p->group);
            if (!ok)
                break;
            memset(&p->group[p->n_groups], 0, sizeof *p->group);
            group_of[i] = (uint32_t)p->n_groups++;
        }
        il_group *g = &p->group[group_of[leader]];
        ok = i < n_lower ? add_ring(&g->lower, &g->n_lower, &g->cap_lower, i)
                         : add_ring(&g->upper, &g->n_upper, &g->cap_upper, i - n_lower);
    }
    for (size_t i = 0; ok && i < n_links; i++) {
        il_group *g = &p->group[group_of[il_forest_leader(up, link[i].lower)]];
        ok = il_grow(&g->link, &g->cap_links, g->n_links + 1, sizeof *g->link);
        if (ok)
            g->link[g->n_links++] = link[i];
    }
    return ok;
}

/* Outer rings as patches, once they were asked for: the lower slice's, then the upper's. */
typedef struct slants {
    const il_slice *slice[2];
    il_patch *patch;
    il_scan scan;
} slants;

static il_status need_patch(slants *s, int side, uint32_t ring, il_patch **p, il_error *err)
{
    *p = &s->patch[(side == 0 ? 0 : s->slice[0]->n) + ring];
    if ((*p)->n > 0)
        return IL_OK;
    return il_patch_add(*p, &s->slice[side]->ring[ring], false) ? il_patch_plant(*p, err) : il_fail_nomem(err);
}

/* Do the rings of L, whose regions overlap, lie on each other, by what they have in common? */
static il_status lie_on_each_other(slants *s, const il_link *l, bool *yes, il_error *err)
{
    static const double LIES_ON = 0.3;
    il_patch *a, *b = NULL;
    double common = 0;
    il_status st = need_patch(s, 0, l->lower, &a, err);
    if (st == IL_OK)
        st = need_patch(s, 1, l->upper, &b, err);
    if (st == IL_OK)
        st = il_patch_common(a, b, &s->scan, &common, err);
    *yes = st != IL_OK || common > LIES_ON * fmin(a->area, b->area);
    return st;
}

static bool is_of_hole(const il_link *l, const il_slice *lower, const il_slice *upper)
{
    return il_ring_area2(&lower->ring[l->lower]) < 0 || il_ring_area2(&upper->ring[l->upper]) < 0;
}

/* Is a link of G to a region that lies apart? */
static bool leads_away(const il_group *g)
{
    for (size_t i = 0; i < g->n_links; i++)
        if (g->link[i].reason != IL_LINK_OVERLAP && g->link[i].reason != IL_LINK_OPENING)
            return true;
    return false;
}

il_status il_link_slants(il_pair *pair, const il_slice *lower, const il_slice *upper, il_error *err)
{
    slants s = { { lower, upper }, il_calloc(lower->n + upper->n, sizeof *s.patch), IL_SCAN_INIT };
    il_status st = s.patch ? IL_OK : il_fail_nomem(err);
    for (size_t g = 0; g < pair->n_groups; g++) {
        bool away = leads_away(&pair->group[g]);
        for (size_t i = 0; i < pair->group[g].n_links && st == IL_OK; i++) {
            il_link *l = &pair->group[g].link[i];
            bool yes = true;
            if (l->reason != IL_LINK_OVERLAP || is_of_hole(l, lower, upper))
                continue;
            if (!away)
                st = lie_on_each_other(&s, l, &yes, err);
            if (away || !yes)
                l->reason = IL_LINK_SLANT;
        }
    }
    for (size_t i = 0; s.patch && i < lower->n + upper->n; i++)
        il_patch_free(&s.patch[i]);
    il_free(s.patch);
    il_scan_free(&s.scan);
    return st;
}

il_status il_link_group(il_pair *pair, const il_slice *lower, const il_slice *upper, const il_link *link, size_t n, il_error *err)
{
    uint32_t n_rings = (uint32_t)(lower->n + upper->n);
    uint32_t *outer = il_alloc(n_rings, sizeof *outer), *up = il_alloc(n_rings, sizeof *up);
    uint32_t *group_of = il_alloc(n_rings, sizeof *group_of);
    il_status st = outer && up && group_of ? il_link_outers(lower, outer, err) : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_link_outers(upper, outer + lower->n, err);
    if (st == IL_OK) {
        join_rings(up, outer, (uint32_t)lower->n, (uint32_t)upper->n, link, n);
        if (!make_groups(pair, up, group_of, (uint32_t)lower->n, n_rings, link, n))
            st = il_fail_nomem(err);
    }
    il_free(outer);
    il_free(up);
    il_free(group_of);
    return st;
}

il_status il_link_slices(il_pair *pair, const il_slice *lower, const il_slice *upper, il_error *err)
{
    uint32_t *at = NULL;
    size_t n = 0;
    il_status st = il_link_overlaps(lower, upper, &at, &n, err);
    il_link *link = st == IL_OK ? il_alloc(n, sizeof *link) : NULL;
    if (st == IL_OK && !link)
        st = il_fail_nomem(err);
    for (size_t i = 0; st == IL_OK && i < n; i++)
        link[i] = (il_link){ at[2 * i], at[2 * i + 1], IL_LINK_OVERLAP, 0 };
    if (st == IL_OK)
        st = il_complement_link(&link, &n, lower, upper, err);
    if (st == IL_OK)
        st = il_link_group(pair, lower, upper, link, n, err);
    il_free(at);
    il_free(link);
    return st;
}
