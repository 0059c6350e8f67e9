#include "config.h"
#include "match/link.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "bridge/boxes.h"
#include "bridge/predicates.h"

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
    double *area2;        /* [rings] */
    size_t n;
    double right;         /* greatest x */
} edges;

static void edges_free(edges *e)
{
    il_free(e->a);
    il_free(e->b);
    il_free(e->ring_of);
    il_free(e->box);
    il_free(e->first);
    il_free(e->outer);
    il_free(e->area2);
}

static void add_edge(edges *e, const double *a, const double *b, uint32_t ring)
{
    double *box = e->box + 4 * e->n;
    e->a[e->n] = a;
    e->b[e->n] = b;
    e->ring_of[e->n] = ring;
    box[0] = fmin(a[0], b[0]), box[1] = fmin(a[1], b[1]);
    box[2] = fmax(a[0], b[0]), box[3] = fmax(a[1], b[1]);
    e->right = fmax(e->right, box[2]);
    e->n++;
}

static bool edges_take(edges *e, const il_slice *s)
{
    size_t n = il_slice_points(s);
    *e = (edges){ .slice = s, .right = -INFINITY };
    e->a = il_alloc(n, sizeof *e->a);
    e->b = il_alloc(n, sizeof *e->b);
    e->ring_of = il_alloc(n, sizeof *e->ring_of);
    e->box = il_alloc(n, 4 * sizeof *e->box);
    e->first = il_alloc(s->n + 1, sizeof *e->first);
    e->outer = il_alloc(s->n, sizeof *e->outer);
    e->area2 = il_alloc(s->n, sizeof *e->area2);
    if (!e->a || !e->b || !e->ring_of || !e->box || !e->first || !e->outer || !e->area2)
        return false;
    for (uint32_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        e->first[i] = e->n;
        e->area2[i] = il_ring_area2(r);
        for (size_t k = 0; k < r->n; k++)
            add_edge(e, r->xy + 2 * k, r->xy + 2 * (k + 1 < r->n ? k + 1 : 0), i);
    }
    e->first[s->n] = e->n;
    return true;
}

/* ---- which rings hold a point ---- */

/* A point of a ring that is no vertex, for rings of a slice may share these. */
typedef struct probe {
    double xy[2];
    uint32_t ring;
} probe;

static int compare_hits(const void *p, const void *q)
{
    const uint32_t *a = p, *b = q;
    if (a[0] != b[0])
        return a[0] < b[0] ? -1 : 1;
    return a[1] < b[1] ? -1 : a[1] > b[1];
}

/* Does edge E cross the ray from P to the right? */
static bool crosses_ray(const edges *e, uint32_t i, const double p[2])
{
    const double *a = e->a[i], *b = e->b[i];
    if ((a[1] > p[1]) == (b[1] > p[1]))
        return false;
    return il_orientation(a, b, p) == (b[1] > a[1] ? 1 : -1);
}

/* All (probe, ring) with the probe inside of the ring: hit[2*n_hits], sorted. */
static il_status rings_about(const edges *e, const probe *p, size_t n, uint32_t **hit, size_t *n_hits, il_error *err)
{
    double *ray = il_alloc(n, 4 * sizeof *ray);
    uint32_t *pair = NULL;
    size_t n_pairs = 0, kept = 0;
    *hit = NULL;
    *n_hits = 0;
    if (!ray)
        return il_fail_nomem(err);
    for (size_t i = 0; i < n; i++) {
        ray[4 * i] = p[i].xy[0], ray[4 * i + 1] = ray[4 * i + 3] = p[i].xy[1];
        ray[4 * i + 2] = fmax(p[i].xy[0], e->right);
    }
    il_status st = il_box_pairs_between(ray, n, e->box, e->n, SIZE_MAX, &pair, &n_pairs, err);
    il_free(ray);
    if (st != IL_OK)
        return st;
    for (size_t i = 0; i < n_pairs; i++)
        if (crosses_ray(e, pair[2 * i + 1], p[pair[2 * i]].xy)) {
            pair[2 * kept] = pair[2 * i];
            pair[2 * kept + 1] = e->ring_of[pair[2 * i + 1]];
            kept++;
        }
    if (kept > 0)
        qsort(pair, kept, 2 * sizeof *pair, compare_hits);
    for (size_t i = 0; i < kept;) { /* an odd number of crossings is inside */
        size_t k = i;
        while (k < kept && compare_hits(pair + 2 * i, pair + 2 * k) == 0)
            k++;
        if ((k - i) % 2 == 1)
            memmove(pair + 2 * (*n_hits)++, pair + 2 * i, 2 * sizeof *pair);
        i = k;
    }
    *hit = pair;
    return IL_OK;
}

static probe probe_of(const edges *e, uint32_t ring)
{
    const double *a = e->a[e->first[ring]], *b = e->b[e->first[ring]];
    return (probe){ { a[0] / 2 + b[0] / 2, a[1] / 2 + b[1] / 2 }, ring };
}

/* A hole's region is that of the least outer ring that holds it. */
static il_status find_outers(edges *e, il_error *err)
{
    size_t rings = e->slice->n, n = 0, n_hits = 0;
    uint32_t *hit = NULL;
    probe *p = il_alloc(rings, sizeof *p);
    if (!p)
        return il_fail_nomem(err);
    for (uint32_t i = 0; i < rings; i++) {
        e->outer[i] = i;
        if (e->area2[i] < 0)
            p[n++] = probe_of(e, i);
    }
    il_status st = n > 0 ? rings_about(e, p, n, &hit, &n_hits, err) : IL_OK;
    for (size_t i = 0; i < n_hits; i++) {
        uint32_t hole = p[hit[2 * i]].ring, about = hit[2 * i + 1], *outer = &e->outer[hole];
        if (e->area2[about] > 0 && (*outer == hole || e->area2[about] < e->area2[*outer]))
            *outer = about;
    }
    il_free(hit);
    il_free(p);
    return st;
}

/* ---- which regions overlap ---- */

typedef struct linker {
    il_pair *pair;
    edges side[2];
    uint32_t *up;             /* forest over the lower rings and then the upper */
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

/* Do the closed edges have a point in common?  Their boxes do. */
static bool meet(const double *a, const double *b, const double *c, const double *d)
{
    return il_orientation(a, b, c) * il_orientation(a, b, d) <= 0 && il_orientation(c, d, a) * il_orientation(c, d, b) <= 0;
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
        if ((ring[0] == last[0] && ring[1] == last[1]) || !meet(e[0].a[p], e[0].b[p], e[1].a[q], e[1].b[q]))
            continue;
        memcpy(last, ring, sizeof last);
        if (!note_link(l, ring[0], ring[1]))
            st = il_fail_nomem(err);
    }
    il_free(pair);
    return st;
}

/* Regions whose outlines do not meet overlap when a ring of one lies in the other:
 * in its least outer ring and in none of its holes, so the least ring about the
 * probe is an outer one. */
static il_status link_nested(linker *l, int inner, il_error *err)
{
    const edges *in = &l->side[inner], *about = &l->side[1 - inner];
    size_t rings = in->slice->n, n_hits = 0;
    uint32_t *hit = NULL;
    probe *p = il_alloc(rings, sizeof *p);
    if (!p)
        return il_fail_nomem(err);
    for (uint32_t i = 0; i < rings; i++)
        p[i] = probe_of(in, i);
    il_status st = rings_about(about, p, rings, &hit, &n_hits, err);
    for (size_t i = 0, k; st == IL_OK && i < n_hits; i = k) {
        uint32_t least = hit[2 * i + 1], ring = hit[2 * i];
        for (k = i; k < n_hits && hit[2 * k] == ring; k++)
            if (fabs(about->area2[hit[2 * k + 1]]) < fabs(about->area2[least]))
                least = hit[2 * k + 1];
        if (about->area2[least] > 0 && !note_link(l, inner == 0 ? ring : least, inner == 0 ? least : ring))
            st = il_fail_nomem(err);
    }
    il_free(hit);
    il_free(p);
    return st;
}

/* ---- groups ---- */

static void join_rings(linker *l)
{
    uint32_t n_lower = (uint32_t)l->side[0].slice->n;
    il_forest_plant(l->up, n_lower + l->side[1].slice->n);
    for (uint32_t i = 0; i < n_lower; i++)
        il_forest_join(l->up, i, l->side[0].outer[i]);
    for (uint32_t i = 0; i < l->side[1].slice->n; i++)
        il_forest_join(l->up, n_lower + i, n_lower + l->side[1].outer[i]);
    for (size_t i = 0; i < l->n_links; i++)
        il_forest_join(l->up, l->link[2 * i], n_lower + l->link[2 * i + 1]);
}

static bool add_ring(uint32_t **list, size_t *n, size_t *cap, uint32_t ring)
{
    if (!il_grow(list, cap, *n + 1, sizeof **list))
        return false;
    (*list)[(*n)++] = ring;
    return true;
}

/* Leaders are the least of their sets, so they come in the order of groups. */
static bool make_groups(linker *l)
{
    il_pair *p = l->pair;
    uint32_t n_lower = (uint32_t)l->side[0].slice->n, n = n_lower + (uint32_t)l->side[1].slice->n;
    uint32_t *group_of = il_alloc(n, sizeof *group_of);
    bool ok = group_of != NULL;
    for (uint32_t i = 0; ok && i < n; i++) {
        uint32_t leader = il_forest_leader(l->up, i);
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
    if (ok && l->n_links > 0)
        qsort(l->link, l->n_links, 2 * sizeof *l->link, compare_hits);
    for (size_t i = 0; ok && i < l->n_links; i++) {
        const uint32_t *at = l->link + 2 * i;
        il_group *g = &p->group[group_of[il_forest_leader(l->up, at[0])]];
        if (i > 0 && compare_hits(at, at - 2) == 0)
            continue;
        ok = il_grow(&g->link, &g->cap_links, g->n_links + 1, sizeof *g->link);
        if (ok)
            g->link[g->n_links++] = (il_link){ at[0], at[1], IL_LINK_OVERLAP, 0 };
    }
    il_free(group_of);
    return ok;
}

il_status il_link_slices(il_pair *pair, const il_slice *lower, const il_slice *upper, il_error *err)
{
    linker l = { .pair = pair };
    l.up = il_alloc(lower->n + upper->n, sizeof *l.up);
    bool taken = l.up && edges_take(&l.side[0], lower) && edges_take(&l.side[1], upper);
    il_status st = taken ? IL_OK : il_fail_nomem(err);
    for (int k = 0; st == IL_OK && k < 2; k++)
        st = find_outers(&l.side[k], err);
    if (st == IL_OK && lower->n > 0 && upper->n > 0) {
        st = link_meeting(&l, err);
        for (int k = 0; st == IL_OK && k < 2; k++)
            st = link_nested(&l, k, err);
    }
    if (st == IL_OK) {
        join_rings(&l);
        if (!make_groups(&l))
            st = il_fail_nomem(err);
    }
    edges_free(&l.side[0]);
    edges_free(&l.side[1]);
    il_free(l.up);
    il_free(l.link);
    return st;
}
