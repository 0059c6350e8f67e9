#include "config.h"
#include "match/linkage.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "base/nearest.h"
#include "bridge/boxes.h"
#include "match/complement.h"
#include "match/link.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An outer ring and its holes: area, unit^2; box of the ring. */
typedef struct region {
    uint32_t slice, ring;
    double area, box[4];
} region;

/* Regions A of slice k and B of slice k + 1, gap / height apart, 0 where they overlap. */
typedef struct candidate {
    uint32_t slab, a, b;
    double gap;
} candidate;

/* region[first[k]] .. region[first[k + 1]] are those of slice k; of[ring_first[k] + ring]: a
 * ring's; region_at: of one slice's outer rings, while they are numbered.  parts: forest over the
 * regions; groups: the same per slab, region r as the lower one of its slab at 2 r, as the upper one
 * at 2 r + 1.  volume: of the parts, at their leaders.
 * waiting[leader], next[2 * candidate + side]: candidates that were refused as their part was then, in lists;
 * who is in none is its own next. */
typedef struct linking {
    const il_slice *slice;
    size_t n;
    const il_pair *const *known;
    const il_linkage_options *o;
    region *region;          size_t n_regions;
    size_t *first, *ring_first;
    uint32_t *of, *region_at;
    candidate *candidate;    size_t n_candidates, cap_candidates;
    unsigned char *taken;
    uint32_t *parts, *groups;
    double *volume, total;
    uint32_t *heap;          size_t n_heap;
    uint32_t *waiting, *next;
} linking;

il_linkage_options il_linkage_options_for(il_pieces_mode pieces)
{
    il_linkage_options o = IL_LINKAGE_OPTIONS_INIT;
    if (pieces == IL_PIECES_FEW)
        o = (il_linkage_options){ 0, 4, 0.1, INFINITY, true };
    else if (pieces == IL_PIECES_OVERLAP)
        o.free = o.reach = 0;
    return o;
}

void il_linkage_free(il_linkage *l)
{
    il_free(l->link);
    il_free(l->first);
    *l = (il_linkage)IL_LINKAGE_INIT;
}

static double height(const linking *l, size_t slab)
{
    return l->slice[slab + 1].z - l->slice[slab].z;
}

/* ---- regions ----------------------------------------------------------------- */

static void add_region(linking *l, uint32_t k, uint32_t ring)
{
    const il_ring *r = &l->slice[k].ring[ring];
    region *to = &l->region[l->n_regions++];
    *to = (region){ k, ring, 0, { INFINITY, INFINITY, -INFINITY, -INFINITY } };
    for (size_t i = 0; i < 2 * r->n; i++) {
        to->box[i % 2] = fmin(to->box[i % 2], r->xy[i]);
        to->box[2 + i % 2] = fmax(to->box[2 + i % 2], r->xy[i]);
    }
}

/* The regions of slice K, whose rings are of[at] and on: first each ring's outer ring, then its region. */
static il_status add_regions(linking *l, size_t k, size_t at, il_error *err)
{
    const il_slice *s = &l->slice[k];
    uint32_t *of = l->of + at;
    l->first[k] = l->n_regions;
    l->ring_first[k] = at;
    il_status st = il_link_outers(s, of, err);
    if (st != IL_OK)
        return st;
    for (uint32_t i = 0; i < s->n; i++) {
        l->region_at[i] = (uint32_t)l->n_regions;
        if (of[i] == i)
            add_region(l, (uint32_t)k, i);
    }
    for (uint32_t i = 0; i < s->n; i++) {
        of[i] = l->region_at[of[i]];
        l->region[of[i]].area += il_ring_area2(&s->ring[i]) / 2;
    }
    return IL_OK;
}

static il_status find_regions(linking *l, il_error *err)
{
    size_t n_rings = 0, most = 0, at = 0;
    for (size_t k = 0; k < l->n; k++) {
        n_rings += l->slice[k].n;
        most = l->slice[k].n > most ? l->slice[k].n : most;
    }
    l->region = il_alloc(n_rings, sizeof *l->region);
    l->of = il_alloc(n_rings, sizeof *l->of);
    l->region_at = il_alloc(most, sizeof *l->region_at);
    l->first = il_alloc(l->n + 1, sizeof *l->first);
    l->ring_first = il_alloc(l->n + 1, sizeof *l->ring_first);
    if (!l->region || !l->of || !l->region_at || !l->first || !l->ring_first)
        return il_fail_nomem(err);
    il_status st = IL_OK;
    for (size_t k = 0; k < l->n && st == IL_OK; k++) {
        st = add_regions(l, k, at, err);
        at += l->slice[k].n;
    }
    l->first[l->n] = l->n_regions;
    l->ring_first[l->n] = at;
    return st;
}

/* ---- candidates ---------------------------------------------------------------- */

static bool add_candidate(linking *l, size_t slab, uint32_t a, uint32_t b, double gap)
{
    if (!il_grow(&l->candidate, &l->cap_candidates, l->n_candidates + 1, sizeof *l->candidate))
        return false;
    l->candidate[l->n_candidates++] = (candidate){ (uint32_t)slab, a, b, gap };
    return true;
}

static il_status find_overlaps(linking *l, size_t slab, il_error *err)
{
    uint32_t *link = NULL;
    size_t n = 0;
    il_status st = il_link_overlaps(&l->slice[slab], &l->slice[slab + 1], &link, &n, err);
    for (size_t i = 0; i < n && st == IL_OK; i++)
        if (!add_candidate(l, slab, l->of[l->ring_first[slab] + link[2 * i]], l->of[l->ring_first[slab + 1] + link[2 * i + 1]], 0))
            st = il_fail_nomem(err);
    il_free(link);
    return st;
}

/* The outer rings of slice K, a class each. */
static il_status plant_tree(const linking *l, size_t k, il_nearest *t, il_error *err)
{
    size_t n = 0, at = 0;
    for (size_t r = l->first[k]; r < l->first[k + 1]; r++)
        n += l->slice[k].ring[l->region[r].ring].n;
    il_segment *s = il_alloc(n, sizeof *s);
    if (!s)
        return il_fail_nomem(err);
    for (size_t r = l->first[k]; r < l->first[k + 1]; r++) {
        const il_ring *ring = &l->slice[k].ring[l->region[r].ring];
        for (size_t i = 0; i < ring->n; i++) {
            const double *p = ring->xy + 2 * i, *q = ring->xy + 2 * (i + 1 < ring->n ? i + 1 : 0);
            s[at++] = (il_segment){ p[0], p[1], q[0], q[1], r - l->first[k], i };
        }
    }
    return il_nearest_build(t, s, n, l->first[k + 1] - l->first[k], err);
}

/* The least distance so far, and from what: class CLASS of TREE. */
typedef struct approach {
    const il_nearest *tree;
    size_t class;
    double least;
} approach;

static bool approach_segment(void *context, const il_segment *s)
{
    approach *to = context;
    to->least = fmin(to->least, il_nearest_distance(to->tree, to->class, s->ax, s->ay));
    return false;
}

/* Of outlines that do not cross one end of the least distance is a vertex: one of the shorter outline, or else one
 * of the longer no farther from the box of the shorter than those are. */
static double distance(const linking *l, const il_nearest t[2], const region *a, const region *b)
{
    size_t n_a = l->slice[a->slice].ring[a->ring].n, n_b = l->slice[b->slice].ring[b->ring].n;
    const region *few = n_a <= n_b ? a : b, *many = n_a <= n_b ? b : a;
    const il_ring *r = &l->slice[few->slice].ring[few->ring];
    const il_nearest *tree = &t[many == b];
    size_t class = (size_t)(many - l->region) - l->first[many->slice];
    approach to = { &t[few == b], (size_t)(few - l->region) - l->first[few->slice], INFINITY };
    for (size_t i = 0; i < r->n; i++)
        to.least = fmin(to.least, il_nearest_distance(tree, class, r->xy[2 * i], r->xy[2 * i + 1]));
    const double box[4] = { few->box[0] - to.least, few->box[1] - to.least, few->box[2] + to.least, few->box[3] + to.least };
    (void)il_nearest_visit(tree, class, box, approach_segment, &to);
    return to.least;
}

/* Boxes of the regions of slice K, box[4*n], wider by MARGIN on all sides. */
static double *boxes_about(const linking *l, size_t k, double margin)
{
    size_t n = l->first[k + 1] - l->first[k];
    double *box = il_alloc(n, 4 * sizeof *box);
    for (size_t i = 0; box && i < 4 * n; i++) {
        double v = l->region[l->first[k] + i / 4].box[i % 4];
        box[i] = i % 4 < 2 ? v - margin : v + margin;
    }
    return box;
}

/* Pairs of regions whose boxes are within MARGIN of each other, as seen along x and y; more than LIMIT: IL_E_INPUT. */
static il_status near_boxes(const linking *l, size_t slab, double margin, size_t limit, uint32_t **pair, size_t *n, il_error *err)
{
    double *a = boxes_about(l, slab, margin), *b = boxes_about(l, slab + 1, 0);
    il_status st = a && b ? il_box_pairs_between(a, l->first[slab + 1] - l->first[slab], b,
                                                 l->first[slab + 2] - l->first[slab + 1], limit, pair, n, err)
                          : il_fail_nomem(err);
    il_free(a);
    il_free(b);
    return st;
}

/* Those within *MOST, which is halved until there are no more than IL_LINKAGE_NEAR for each region; of slices that
 * are denser still there are none. */
static il_status near_few(const linking *l, size_t slab, double *most, uint32_t **pair, size_t *n, il_error *err)
{
    size_t limit = IL_LINKAGE_NEAR * (l->first[slab + 2] - l->first[slab]);
    for (int halved = 0; halved < 60; halved++, *most /= 2) {
        il_status st = near_boxes(l, slab, *most, limit, pair, n, NULL);
        if (st != IL_E_INPUT)
            return st == IL_OK ? IL_OK : il_fail_nomem(err);
    }
    *n = 0;
    return IL_OK;
}

/* Both sorted: step over the overlaps, candidates from *AT to END, that come before (A, B). */
static bool overlaps(const linking *l, size_t *at, size_t end, uint32_t a, uint32_t b)
{
    while (*at < end && (l->candidate[*at].a < a || (l->candidate[*at].a == a && l->candidate[*at].b < b)))
        ++*at;
    return *at < end && l->candidate[*at].a == a && l->candidate[*at].b == b;
}

/* Behind the slab's overlaps, which begin at FROM. */
static il_status find_gaps(linking *l, size_t slab, size_t from, il_error *err)
{
    il_nearest t[2] = { { 0 }, { 0 } };
    double most = fmax(l->o->reach, l->o->free) * height(l, slab);
    size_t end = l->n_candidates, n = 0;
    uint32_t *pair = NULL;
    il_status st = near_few(l, slab, &most, &pair, &n, err);
    if (n == end - from) /* they all overlap */
        n = 0;
    for (size_t k = 0; k < 2 && st == IL_OK && n > 0; k++)
        st = plant_tree(l, slab + k, &t[k], err);
    for (size_t i = 0; i < n && st == IL_OK; i++) {
        uint32_t a = (uint32_t)l->first[slab] + pair[2 * i], b = (uint32_t)l->first[slab + 1] + pair[2 * i + 1];
        if (overlaps(l, &from, end, a, b))
            continue;
        double gap = distance(l, t, &l->region[a], &l->region[b]);
        if (gap <= most && !add_candidate(l, slab, a, b, gap / height(l, slab)))
            st = il_fail_nomem(err);
    }
    il_free(pair);
    il_nearest_free(&t[0]);
    il_nearest_free(&t[1]);
    return st;
}

static int compare_candidates(const void *pa, const void *pb)
{
    const candidate *a = pa, *b = pb;
    if (a->gap != b->gap)
        return a->gap < b->gap ? -1 : 1;
    if (a->a != b->a)
        return a->a < b->a ? -1 : 1;
    return (a->b > b->b) - (a->b < b->b);
}

static il_status find_candidates(linking *l, il_error *err)
{
    il_status st = IL_OK;
    for (size_t k = 0; k + 1 < l->n && st == IL_OK; k++) {
        size_t from = l->n_candidates;
        if (l->known[k])
            continue;
        st = find_overlaps(l, k, err);
        if (st == IL_OK && l->o->reach > 0)
            st = find_gaps(l, k, from, err);
    }
    if (st == IL_OK && l->n_candidates > 0)
        qsort(l->candidate, l->n_candidates, sizeof *l->candidate, compare_candidates);
    return st;
}

/* ---- which of them are links ------------------------------------------------------ */

static void join_parts(linking *l, uint32_t a, uint32_t b)
{
    uint32_t p = il_forest_leader(l->parts, a), q = il_forest_leader(l->parts, b);
    if (p == q)
        return;
    il_forest_join(l->parts, p, q);
    uint32_t leader = il_forest_leader(l->parts, p), other = leader == p ? q : p;
    l->volume[leader] += l->volume[other];
}

static void join(linking *l, uint32_t i)
{
    const candidate *c = &l->candidate[i];
    l->taken[i] = 1;
    il_forest_join(l->groups, 2 * c->a, 2 * c->b + 1);
    join_parts(l, c->a, c->b);
}

/* What a group of the record of SLAB names is one part. */
static void join_group(linking *l, size_t slab, const il_group *g)
{
    const uint32_t *lower = l->of + l->ring_first[slab], *upper = l->of + l->ring_first[slab + 1];
    uint32_t one = g->n_lower > 0 ? lower[g->lower[0]] : upper[g->upper[0]];
    for (size_t i = 0; i < g->n_lower; i++)
        join_parts(l, one, lower[g->lower[i]]);
    for (size_t i = 0; i < g->n_upper; i++)
        join_parts(l, one, upper[g->upper[i]]);
}

/* A record without groups leaves it to the overlaps what belongs together. */
static il_status join_overlapping(linking *l, size_t slab, il_error *err)
{
    uint32_t *link = NULL;
    size_t n = 0;
    il_status st = il_link_overlaps(&l->slice[slab], &l->slice[slab + 1], &link, &n, err);
    for (size_t i = 0; i < n && st == IL_OK; i++)
        join_parts(l, l->of[l->ring_first[slab] + link[2 * i]], l->of[l->ring_first[slab + 1] + link[2 * i + 1]]);
    il_free(link);
    return st;
}

/* What records join is joined before any link is chosen. */
static il_status join_known(linking *l, il_error *err)
{
    il_status st = IL_OK;
    for (size_t k = 0; k + 1 < l->n && st == IL_OK; k++) {
        const il_pair *p = l->known[k];
        for (size_t i = 0; p && i < p->n_groups; i++)
            join_group(l, k, &p->group[i]);
        if (p && !p->gap && p->n_groups == 0)
            st = join_overlapping(l, k, err);
    }
    return st;
}

static void measure_parts(linking *l)
{
    for (size_t r = 0; r < l->n_regions; r++) {
        size_t k = l->region[r].slice;
        double below = k > 0 ? height(l, k - 1) : 0, above = k + 1 < l->n ? height(l, k) : 0;
        l->volume[r] = l->region[r].area * (below + above) / 2;
        l->total += l->volume[r];
    }
}

static bool may_join(linking *l, uint32_t i)
{
    double a = l->volume[il_forest_leader(l->parts, l->candidate[i].a)], b = l->volume[il_forest_leader(l->parts, l->candidate[i].b)];
    return fmax(a, b) >= l->o->dominant * l->total && fmin(a, b) < l->o->small * fmax(a, b);
}

/* The least number first: candidates are sorted by gap. */
static void push(linking *l, uint32_t i)
{
    size_t at = l->n_heap++;
    while (at > 0 && l->heap[(at - 1) / 2] > i) {
        l->heap[at] = l->heap[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    l->heap[at] = i;
}

static uint32_t pop(linking *l)
{
    uint32_t least = l->heap[0], last = l->heap[--l->n_heap];
    size_t at = 0;
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= l->n_heap)
            break;
        if (child + 1 < l->n_heap && l->heap[child + 1] < l->heap[child])
            child++;
        if (l->heap[child] >= last)
            break;
        l->heap[at] = l->heap[child];
        at = child;
    }
    l->heap[at] = last;
    return least;
}

/* Candidate I waits for either of its parts to grow; on one side it may still do so, when the other woke it. */
static void wait_for(linking *l, uint32_t i, int side)
{
    uint32_t p = il_forest_leader(l->parts, side == 0 ? l->candidate[i].a : l->candidate[i].b), w = 2 * i + (uint32_t)side;
    if (l->next[w] != w)
        return;
    l->next[w] = l->waiting[p];
    l->waiting[p] = w;
}

static void wake(linking *l, uint32_t part)
{
    uint32_t w = l->waiting[part], then;
    l->waiting[part] = UINT32_MAX;
    for (; w != UINT32_MAX; w = then) {
        then = l->next[w];
        l->next[w] = w;
        push(l, w / 2);
    }
}

static void take_overlaps_and_free(linking *l)
{
    for (uint32_t i = 0; i < l->n_candidates && l->candidate[i].gap <= l->o->free; i++) {
        const candidate *c = &l->candidate[i];
        if (c->gap == 0 || il_forest_leader(l->groups, 2 * c->a) != il_forest_leader(l->groups, 2 * c->b + 1))
            join(l, i);
    }
}

static void take_joins(linking *l)
{
    for (uint32_t i = 0; i < l->n_candidates; i++)
        if (!l->taken[i])
            push(l, i);
    while (l->n_heap > 0) {
        uint32_t i = pop(l);
        uint32_t p = il_forest_leader(l->parts, l->candidate[i].a), q = il_forest_leader(l->parts, l->candidate[i].b);
        if (l->taken[i] || p == q)
            continue;
        if (!may_join(l, i)) {
            wait_for(l, i, 0);
            wait_for(l, i, 1);
            continue;
        }
        join(l, i);
        wake(l, p);
        wake(l, q);
    }
}

/* ---- out ---------------------------------------------------------------------------- */

static int compare_places(const void *pa, const void *pb)
{
    const candidate *a = pa, *b = pb;
    if (a->a != b->a)
        return a->a < b->a ? -1 : 1;
    return (a->b > b->b) - (a->b < b->b);
}

static bool write_links(linking *l, il_linkage *out)
{
    size_t n = 0;
    for (size_t i = 0; i < l->n_candidates; i++)
        if (l->taken[i])
            l->candidate[n++] = l->candidate[i];
    out->link = il_alloc(n, sizeof *out->link);
    out->first = il_calloc(l->n + 1, sizeof *out->first);
    if (!out->link || !out->first)
        return false;
    if (n > 0)
        qsort(l->candidate, n, sizeof *l->candidate, compare_places);
    for (size_t i = 0; i < n; i++) {
        const candidate *c = &l->candidate[i];
        il_link_reason why = c->gap == 0 ? IL_LINK_OVERLAP : c->gap <= l->o->free ? IL_LINK_NEAR : IL_LINK_JOIN;
        out->link[i] = (il_link){ l->region[c->a].ring, l->region[c->b].ring, why, c->gap * height(l, c->slab) };
        out->first[c->slab + 1] = i + 1;
    }
    for (size_t k = 1; k <= l->n; k++)
        out->first[k] = out->first[k] > out->first[k - 1] ? out->first[k] : out->first[k - 1];
    return true;
}

/* The links of holes, slab by slab, into the row of all. */
static il_status add_holes(const linking *l, il_linkage *out, il_error *err)
{
    il_link *all = NULL;
    size_t n_all = 0, cap = 0;
    il_status st = IL_OK;
    for (size_t k = 0; k + 1 < l->n && st == IL_OK; k++) {
        size_t n = out->first[k + 1] - out->first[k];
        il_link *link = il_alloc(n, sizeof *link);
        if (link && n > 0)
            memcpy(link, out->link + out->first[k], n * sizeof *link);
        out->first[k] = n_all;
        st = link ? il_complement_link(&link, &n, &l->slice[k], &l->slice[k + 1], err) : il_fail_nomem(err);
        if (st == IL_OK && !il_grow(&all, &cap, n_all + n, sizeof *all))
            st = il_fail_nomem(err);
        if (st == IL_OK && n > 0)
            memcpy(all + n_all, link, n * sizeof *link);
        n_all += n;
        il_free(link);
    }
    for (size_t k = l->n > 0 ? l->n - 1 : 0; k <= l->n; k++)
        out->first[k] = n_all;
    il_free(out->link);
    out->link = all;
    return st;
}

static il_status choose(linking *l, il_error *err)
{
    l->taken = il_calloc(l->n_candidates, 1);
    l->parts = il_alloc(l->n_regions, sizeof *l->parts);
    l->groups = il_alloc(2 * l->n_regions, sizeof *l->groups);
    l->volume = il_alloc(l->n_regions, sizeof *l->volume);
    l->heap = il_alloc(3 * l->n_candidates, sizeof *l->heap);
    l->waiting = il_alloc(l->n_regions, sizeof *l->waiting);
    l->next = il_alloc(2 * l->n_candidates, sizeof *l->next);
    if (!l->taken || !l->parts || !l->groups || !l->volume || !l->heap || !l->waiting || !l->next)
        return il_fail_nomem(err);
    il_forest_plant(l->parts, l->n_regions);
    il_forest_plant(l->groups, 2 * l->n_regions);
    for (size_t r = 0; r < l->n_regions; r++)
        l->waiting[r] = UINT32_MAX;
    for (uint32_t w = 0; w < 2 * l->n_candidates; w++)
        l->next[w] = w;
    measure_parts(l);
    il_status st = join_known(l, err);
    if (st != IL_OK)
        return st;
    take_overlaps_and_free(l);
    take_joins(l);
    return IL_OK;
}

il_status il_linkage_find(il_linkage *out, const il_slice *slice, size_t n, const il_pair *const *known,
                          const il_linkage_options *o, il_error *err)
{
    linking l = { .slice = slice, .n = n, .known = known, .o = o };
    *out = (il_linkage)IL_LINKAGE_INIT;
    il_status st = find_regions(&l, err);
    if (st == IL_OK)
        st = find_candidates(&l, err);
    if (st == IL_OK)
        st = choose(&l, err);
    if (st == IL_OK && !write_links(&l, out))
        st = il_fail_nomem(err);
    if (st == IL_OK)
        st = add_holes(&l, out, err);
    if (st != IL_OK)
        il_linkage_free(out);
    il_free(l.region);
    il_free(l.first);
    il_free(l.ring_first);
    il_free(l.of);
    il_free(l.region_at);
    il_free(l.candidate);
    il_free(l.taken);
    il_free(l.parts);
    il_free(l.groups);
    il_free(l.volume);
    il_free(l.heap);
    il_free(l.waiting);
    il_free(l.next);
    return st;
}
