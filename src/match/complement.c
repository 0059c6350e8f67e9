#include "config.h"
#include "match/complement.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "bridge/predicates.h"
#include "match/link.h"
#include "match/shift.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Shares of a hole's area that must lie outside for it to open there, without and with a hole
 * that it goes on to; measured on sliced solids, with the rule of linkage.h. */
static const double OPENS = 0.02, OPENS_BESIDE = 0.51;

/* Things by what they belong to: those of k are list[first[k]] .. list[first[k + 1]]. */
typedef struct roll { uint32_t *first, *list; } roll;

/* turned: the slice's complement, its rings turned round in a frame about both slices, ring n,
 * which stands for the outside.  outer[i]: the outer ring of ring i's region; about[i]: the
 * hole that ring i is or lies in, n outside; rings by both.  links: of outer rings.
 * reaches[i]: hole i overlaps the outside of the other slice; goes_on[i]: one of its holes.
 * region[i]: that of outer ring i, once it was asked for.  ring: trees over the outer rings, a
 * class each. */
typedef struct side {
    const il_slice *slice;
    il_slice turned;
    uint32_t n, *outer, *about;
    roll of_region, of_hole, links;
    bool *reaches, *goes_on;
    il_patch *region;
    il_nearest ring;
} side;

/* Forests over the rings and the frame of the lower slice, then of the upper one: which regions
 * hang together, and which parts of the complement.  link[n_given]: those of outer rings. */
typedef struct complement {
    side side[2];
    uint32_t *solid, *about;
    il_link *link;           size_t n_given, n_links, cap_links;
    il_scan scan;
} complement;

static uint32_t node(const complement *c, int k, uint32_t ring)
{
    return k == 0 ? ring : c->side[0].n + 1 + ring;
}

static bool is_hole(const side *s, uint32_t i)
{
    return i < s->n && s->outer[i] != i;
}

/* ---- the two slices ---------------------------------------------------------------- */

static void roll_free(roll *r)
{
    il_free(r->first);
    il_free(r->list);
}

/* Number I of N belongs to of[I], below N_OF. */
static bool roll_make(roll *r, const uint32_t *of, size_t n, size_t n_of)
{
    r->first = il_calloc(n_of + 2, sizeof *r->first);
    r->list = il_alloc(n, sizeof *r->list);
    if (!r->first || !r->list)
        return false;
    for (size_t i = 0; i < n; i++)
        r->first[of[i] + 2]++;
    for (size_t k = 2; k < n_of + 2; k++)
        r->first[k] += r->first[k - 1];
    for (uint32_t i = 0; i < n; i++)
        r->list[r->first[of[i] + 1]++] = i;
    return true;
}

static void side_free(side *s)
{
    il_slice_free(&s->turned);
    il_free(s->outer);
    il_free(s->about);
    roll_free(&s->of_region);
    roll_free(&s->of_hole);
    roll_free(&s->links);
    il_free(s->reaches);
    il_free(s->goes_on);
    for (uint32_t i = 0; s->region && i < s->n; i++)
        il_patch_free(&s->region[i]);
    il_free(s->region);
    il_nearest_free(&s->ring);
}

static void grow_box(double box[4], const il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < 2 * s->ring[i].n; k++) {
            box[k % 2] = fmin(box[k % 2], s->ring[i].xy[k]);
            box[2 + k % 2] = fmax(box[2 + k % 2], s->ring[i].xy[k]);
        }
}

static il_status turn(side *s, const double box[4], il_error *err)
{
    double by = box[2] - box[0] + (box[3] - box[1]);
    double x0 = box[0] - by, y0 = box[1] - by, x1 = box[2] + by, y1 = box[3] + by;
    il_status st = il_slice_copy(&s->turned, s->slice, err);
    for (size_t i = 0; st == IL_OK && i < s->turned.n; i++)
        il_ring_reverse(&s->turned.ring[i]);
    il_ring *frame = st == IL_OK ? il_slice_add_ring(&s->turned) : NULL;
    if (st == IL_OK && !(frame && il_ring_add(frame, x0, y0, 0) && il_ring_add(frame, x1, y0, 0) && il_ring_add(frame, x1, y1, 0) &&
                         il_ring_add(frame, x0, y1, 0)))
        st = il_fail_nomem(err);
    return st;
}

/* The ends of the given links on this side, to s->links. */
static bool roll_links(complement *c, int k)
{
    uint32_t *of = il_alloc(c->n_given, sizeof *of);
    for (size_t i = 0; of && i < c->n_given; i++)
        of[i] = k == 0 ? c->link[i].lower : c->link[i].upper;
    bool ok = of && roll_make(&c->side[k].links, of, c->n_given, c->side[k].n);
    il_free(of);
    return ok;
}

/* The outer rings of S, a class each. */
static il_status plant_rings(side *s, il_error *err)
{
    size_t n = 0;
    il_segment *e = il_alloc(il_slice_points(s->slice), sizeof *e);
    if (!e)
        return il_fail_nomem(err);
    for (uint32_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->slice->ring[i];
        for (size_t k = 0; k < r->n && !is_hole(s, i); k++) {
            const double *p = r->xy + 2 * k, *q = r->xy + 2 * (k + 1 < r->n ? k + 1 : 0);
            e[n++] = (il_segment){ p[0], p[1], q[0], q[1], i, k };
        }
    }
    return il_nearest_build(&s->ring, e, n, s->n, err);
}

static il_status take_side(complement *c, int k, const double box[4], il_error *err)
{
    side *s = &c->side[k];
    il_status st = turn(s, box, err);
    s->outer = il_alloc(s->n, sizeof *s->outer);
    s->about = il_alloc(s->n + 1, sizeof *s->about);
    s->reaches = il_calloc(s->n, sizeof *s->reaches);
    s->goes_on = il_calloc(s->n, sizeof *s->goes_on);
    s->region = il_calloc(s->n, sizeof *s->region);
    if (st == IL_OK && (!s->outer || !s->about || !s->reaches || !s->goes_on || !s->region))
        st = il_fail_nomem(err);
    if (st == IL_OK)
        st = il_link_outers(s->slice, s->outer, err);
    if (st == IL_OK)
        st = il_link_outers(&s->turned, s->about, err);
    if (st == IL_OK && !(roll_make(&s->of_region, s->outer, s->n, s->n) && roll_make(&s->of_hole, s->about, s->n, s->n + 1) &&
                         roll_links(c, k)))
        st = il_fail_nomem(err);
    return st == IL_OK ? plant_rings(s, err) : st;
}

/* ---- parts of the complement ------------------------------------------------------------ */

static bool add_link(complement *c, uint32_t lower, uint32_t upper, il_link_reason why, double reach)
{
    if (!il_grow(&c->link, &c->cap_links, c->n_links + 1, sizeof *c->link))
        return false;
    c->link[c->n_links++] = (il_link){ lower, upper, why, reach };
    return true;
}

static bool same_solid(const complement *c, uint32_t lower, uint32_t upper)
{
    return il_forest_leader(c->solid, node(c, 0, lower)) == il_forest_leader(c->solid, node(c, 1, upper));
}

static void plant_forests(complement *c)
{
    size_t all = (size_t)c->side[0].n + c->side[1].n + 2;
    il_forest_plant(c->solid, all);
    il_forest_plant(c->about, all);
    for (int k = 0; k < 2; k++)
        for (uint32_t i = 0; i < c->side[k].n; i++) {
            il_forest_join(c->solid, node(c, k, i), node(c, k, c->side[k].outer[i]));
            il_forest_join(c->about, node(c, k, i), node(c, k, c->side[k].about[i]));
        }
    for (size_t i = 0; i < c->n_given; i++)
        il_forest_join(c->solid, node(c, 0, c->link[i].lower), node(c, 1, c->link[i].upper));
    il_forest_join(c->about, node(c, 0, c->side[0].n), node(c, 1, c->side[1].n)); /* the outside is one */
}

static il_status link_holes(complement *c, il_error *err)
{
    uint32_t *pair = NULL;
    size_t n = 0;
    il_status st = il_link_overlaps(&c->side[0].turned, &c->side[1].turned, &pair, &n, err);
    for (size_t i = 0; i < n && st == IL_OK; i++) {
        uint32_t a = pair[2 * i], b = pair[2 * i + 1];
        bool hole_a = is_hole(&c->side[0], a), hole_b = is_hole(&c->side[1], b);
        if (hole_a && !hole_b)
            c->side[0].reaches[a] = true;
        if (hole_b && !hole_a)
            c->side[1].reaches[b] = true;
        if (!hole_a || !hole_b)
            continue;
        c->side[0].goes_on[a] = c->side[1].goes_on[b] = true;
        il_forest_join(c->about, node(c, 0, a), node(c, 1, b));
        if (same_solid(c, a, b) && !add_link(c, a, b, IL_LINK_OVERLAP, 0))
            st = il_fail_nomem(err);
    }
    il_free(pair);
    return st;
}

/* ---- holes that open ---------------------------------------------------------------------- */

/* Of the rings of OF (a region, or a hole, then TURNED), moved BY. */
static il_status make_patch(il_patch *p, const side *s, const roll *rings, uint32_t of, bool turned, const double by[2], il_error *err)
{
    bool ok = true;
    for (uint32_t i = rings->first[of]; i < rings->first[of + 1] && ok; i++)
        ok = il_patch_add(p, &s->slice->ring[rings->list[i]], turned);
    if (!ok)
        return il_fail_nomem(err);
    il_patch_move(p, by);
    return il_patch_plant(p, err);
}

static il_status need_region(side *s, uint32_t r, il_error *err)
{
    static const double nowhere[2] = { 0, 0 };
    return s->region[r].n > 0 ? IL_OK : make_patch(&s->region[r], s, &s->of_region, r, false, nowhere, err);
}

/* Where the links of region R of side K would take it, in the mean. */
static il_status mean_shift(complement *c, int k, uint32_t r, double mean[2], il_error *err)
{
    side *s = &c->side[k], *other = &c->side[1 - k];
    uint32_t begin = s->links.first[r], end = s->links.first[r + 1];
    il_status st = need_region(s, r, err);
    mean[0] = mean[1] = 0;
    for (uint32_t i = begin; i < end && st == IL_OK; i++) {
        const il_link *l = &c->link[s->links.list[i]];
        uint32_t there = k == 0 ? l->upper : l->lower;
        double shift[2] = { 0, 0 };
        st = need_region(other, there, err);
        if (st == IL_OK)
            st = il_link_shift(&s->region[r], &other->region[there], &c->scan, shift, err);
        mean[0] += shift[0] / (end - begin);
        mean[1] += shift[1] / (end - begin);
    }
    return st;
}

typedef struct scanned { il_scan *scan; int side; } scanned;

static bool scan_edge(void *context, const il_segment *e)
{
    scanned *s = context;
    il_scan_add(s->scan, s->side, e);
    return false;
}

/* Figure 1: the inside of the outer rings that lie in no hole, as far as it matters. */
static void scan_outer_rings(const side *s, il_scan *scan)
{
    const double box[4] = { -INFINITY, scan->box[1], scan->box[2], scan->box[3] };
    scanned to = { scan, 1 };
    for (uint32_t i = 0; i < s->n; i++) {
        const double *about = s->ring.box + 4 * s->ring.root[i];
        if (!is_hole(s, i) && s->about[i] == s->n && about[0] <= scan->box[2] && about[2] >= scan->box[0])
            il_nearest_visit(&s->ring, i, box, scan_edge, &to);
    }
}

/* Does hole I of side K open, once moved BY? */
static il_status test_hole(complement *c, int k, uint32_t i, const double by[2], il_error *err)
{
    const side *s = &c->side[k];
    il_patch hole = IL_PATCH_INIT;
    double own, inside;
    if (by[0] == 0 && by[1] == 0 && !s->reaches[i])
        return IL_OK;
    il_status st = make_patch(&hole, s, &s->of_hole, i, true, by, err);
    if (st == IL_OK) {
        il_scan_begin(&c->scan, hole.box);
        il_patch_scan(&hole, &c->scan, 0);
        scan_outer_rings(&c->side[1 - k], &c->scan);
        st = il_scan_measure(&c->scan, &own, &inside, err);
    }
    if (st == IL_OK && own - inside > (s->goes_on[i] ? OPENS_BESIDE : OPENS) * own)
        il_forest_join(c->about, node(c, k, i), node(c, k, s->n));
    il_patch_free(&hole);
    return st;
}

static il_status open_holes(complement *c, int k, il_error *err)
{
    const side *s = &c->side[k];
    il_status st = IL_OK;
    for (uint32_t r = 0; r < s->n && st == IL_OK; r++) {
        uint32_t begin = s->of_region.first[r], end = s->of_region.first[r + 1];
        double by[2];
        if (end - begin < 2 || s->links.first[r] == s->links.first[r + 1])
            continue;
        st = mean_shift(c, k, r, by, err);
        for (uint32_t i = begin; i < end && st == IL_OK; i++)
            if (s->of_region.list[i] != r)
                st = test_hole(c, k, s->of_region.list[i], by, err);
    }
    return st;
}

/* ---- which outer ring a hole opens to ----------------------------------------------------- */

/* The least distance so far of edge A B from others. */
typedef struct gap { const double *a, *b; double least; } gap;

static double distance_from(const double a[2], const double b[2], double x, double y)
{
    double ux = b[0] - a[0], uy = b[1] - a[1], length2 = ux * ux + uy * uy;
    double t = length2 > 0 ? fmin(fmax(((x - a[0]) * ux + (y - a[1]) * uy) / length2, 0), 1) : 0;
    return hypot(a[0] + t * ux - x, a[1] + t * uy - y);
}

static bool narrow(void *context, const il_segment *f)
{
    gap *g = context;
    const double c[2] = { f->ax, f->ay }, d[2] = { f->bx, f->by };
    if (il_orientation(g->a, g->b, c) * il_orientation(g->a, g->b, d) <= 0 && il_orientation(c, d, g->a) * il_orientation(c, d, g->b) <= 0)
        g->least = 0;
    g->least = fmin(g->least, fmin(distance_from(g->a, g->b, c[0], c[1]), distance_from(g->a, g->b, d[0], d[1])));
    return g->least == 0;
}

/* Of ring R from ring `to` of S, 0 where they cross: of edges that do not, one end of the least
 * distance is a vertex; first those of R, then those of the other that are nearer. */
static double distance(const il_ring *r, const side *s, uint32_t to)
{
    gap g = { NULL, NULL, INFINITY };
    for (size_t i = 0; i < r->n; i++)
        g.least = fmin(g.least, il_nearest_distance(&s->ring, to, r->xy[2 * i], r->xy[2 * i + 1]));
    for (size_t i = 0; i < r->n && g.least > 0; i++) {
        const double *a = g.a = r->xy + 2 * i, *b = g.b = r->xy + 2 * (i + 1 < r->n ? i + 1 : 0);
        const double box[4] = { fmin(a[0], b[0]) - g.least, fmin(a[1], b[1]) - g.least,
                                fmax(a[0], b[0]) + g.least, fmax(a[1], b[1]) + g.least };
        il_nearest_visit(&s->ring, to, box, narrow, &g);
    }
    return g.least;
}

/* Do hole I of side K and outer ring R of the other bound one piece of the surface? */
static bool opens_to(const complement *c, int k, uint32_t i, uint32_t r)
{
    return !is_hole(&c->side[1 - k], r) &&
           il_forest_leader(c->about, node(c, k, i)) == il_forest_leader(c->about, node(c, 1 - k, r)) &&
           il_forest_leader(c->solid, node(c, k, i)) == il_forest_leader(c->solid, node(c, 1 - k, r));
}

/* The nearest of those that its own region is linked to, or, out in the open, of all. */
static bool link_opening(complement *c, int k, uint32_t i)
{
    const side *s = &c->side[k], *other = &c->side[1 - k];
    uint32_t begin = s->links.first[s->outer[i]], end = s->links.first[s->outer[i] + 1], best = other->n;
    double least = INFINITY;
    bool in_the_open = il_forest_leader(c->about, node(c, k, i)) == il_forest_leader(c->about, node(c, k, s->n));
    for (int direct = 1; direct >= !in_the_open && best == other->n; direct--)
        for (uint32_t j = direct ? begin : 0; j < (direct ? end : other->n); j++) {
            const il_link *l = &c->link[direct ? s->links.list[j] : 0];
            uint32_t r = !direct ? j : k == 0 ? l->upper : l->lower;
            double d = opens_to(c, k, i, r) ? distance(&s->slice->ring[i], other, r) : INFINITY;
            if (d < least)
                least = d, best = r;
        }
    if (best == other->n)
        return true; /* its piece of the surface turns back */
    return add_link(c, k == 0 ? i : best, k == 0 ? best : i, IL_LINK_OPENING, least);
}

static il_status link_openings(complement *c, il_error *err)
{
    il_status st = IL_OK;
    for (int k = 0; k < 2 && st == IL_OK; k++) {
        const side *s = &c->side[k];
        for (uint32_t i = 0; i < s->n && st == IL_OK; i++)
            if (is_hole(s, i) && s->links.first[s->outer[i]] < s->links.first[s->outer[i] + 1] && !link_opening(c, k, i))
                st = il_fail_nomem(err);
    }
    return st;
}

/* ---- the whole --------------------------------------------------------------------------- */

static bool has_holes(const il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        if (il_ring_area2(&s->ring[i]) < 0)
            return true;
    return false;
}

static il_status begin(complement *c, const il_link *link, size_t n, il_error *err)
{
    double box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    size_t all = (size_t)c->side[0].n + c->side[1].n + 2;
    c->solid = il_alloc(all, sizeof *c->solid);
    c->about = il_alloc(all, sizeof *c->about);
    if (!c->solid || !c->about || !il_grow(&c->link, &c->cap_links, n, sizeof *c->link))
        return il_fail_nomem(err);
    memcpy(c->link, link, n * sizeof *link);
    c->n_given = c->n_links = n;
    for (int k = 0; k < 2; k++)
        grow_box(box, c->side[k].slice);
    il_status st = take_side(c, 0, box, err);
    if (st == IL_OK)
        st = take_side(c, 1, box, err);
    if (st == IL_OK)
        plant_forests(c);
    return st;
}

static il_status link_complement(complement *c, il_error *err)
{
    il_status st = link_holes(c, err);
    for (int k = 0; k < 2 && st == IL_OK; k++)
        st = open_holes(c, k, err);
    return st == IL_OK ? link_openings(c, err) : st;
}

static int compare_links(const void *pa, const void *pb)
{
    const il_link *a = pa, *b = pb;
    if (a->lower != b->lower)
        return a->lower < b->lower ? -1 : 1;
    return (a->upper > b->upper) - (a->upper < b->upper);
}

il_status il_complement_link(il_link **link, size_t *n, const il_slice *lower, const il_slice *upper, il_error *err)
{
    complement c = { .side = { { .slice = lower, .n = (uint32_t)lower->n }, { .slice = upper, .n = (uint32_t)upper->n } } };
    if (*n == 0 || (!has_holes(lower) && !has_holes(upper)))
        return IL_OK;
    il_status st = begin(&c, *link, *n, err);
    if (st == IL_OK)
        st = link_complement(&c, err);
    if (st == IL_OK) {
        qsort(c.link, c.n_links, sizeof *c.link, compare_links);
        il_free(*link);
        *link = c.link;
        *n = c.n_links;
        c.link = NULL;
    }
    for (int k = 0; k < 2; k++)
        side_free(&c.side[k]);
    il_scan_free(&c.scan);
    il_free(c.solid);
    il_free(c.about);
    il_free(c.link);
    return st;
}
