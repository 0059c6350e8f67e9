#include "config.h"
#include "match/given.h"
#include "base/alloc.h"
#include "base/nearest.h"
#include "base/number.h"
#include "bridge/predicates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* How far off a slab's z may be, in its heights, and a link's reach, in itself: who edits a
 * file by hand rounds. */
static const double slab_leeway = 1e-3, reach_leeway = 1e-6;

/* slab_of[n - 1]: what is said of slab k, or null.  overlaps: all there are. */
typedef struct giving {
    const il_slice *slice;
    size_t n;
    const il_given *given;
    const il_given_stack *stack;
    const il_pair *const *known;
    const il_given_slab **slab_of;
    il_linkage overlaps;
    il_given_link *row;      size_t cap_rows; /* of one slab */
} giving;

/* ---- which slab is which ----------------------------------------------------------- */

static size_t nearest_slice(const giving *g, double z)
{
    size_t low = 0, high = g->n - 1; /* slice[low] is the last at or below z, if any is */
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (g->slice[middle].z <= z)
            low = middle;
        else
            high = middle - 1;
    }
    return low + 1 < g->n && g->slice[low + 1].z - z < z - g->slice[low].z ? low + 1 : low;
}

/* "z = Z0 and Z1", as the file has them. */
typedef struct heights { char words[2 * IL_NUMBER_MAX + 16]; } heights;

static heights heights_of(const il_given_slab *s)
{
    char below[IL_NUMBER_MAX], above[IL_NUMBER_MAX];
    heights h;
    il_number_format(below, s->below);
    il_number_format(above, s->above);
    snprintf(h.words, sizeof h.words, "z = %s and %s", below, above);
    return h;
}

static il_status place_slab(giving *g, const il_given_slab *s, il_error *err)
{
    size_t k = nearest_slice(g, s->below);
    double h = k + 1 < g->n ? g->slice[k + 1].z - g->slice[k].z : -1;
    if (!(fabs(g->slice[k].z - s->below) <= slab_leeway * h && fabs(g->slice[k + 1].z - s->above) <= slab_leeway * h))
        return il_fail(err, IL_E_INPUT, s->line, "no two neighbouring slices of stack %ld '%.80s' lie at %s",
                       g->stack->number, g->stack->name, heights_of(s).words);
    if (g->slab_of[k])
        return il_fail(err, IL_E_INPUT, s->line, "the slab between %s stands at line %ld already",
                       heights_of(s).words, g->slab_of[k]->line);
    if (g->known[k] && s->n > 0)
        return il_fail(err, IL_E_INPUT, g->given->link[s->first].line, "between %s there is a gap, across which nothing is linked",
                       heights_of(s).words);
    g->slab_of[k] = s;
    return IL_OK;
}

static il_status place_slabs(giving *g, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0; i < g->stack->n && st == IL_OK; i++)
        st = place_slab(g, &g->given->slab[g->stack->first + i], err);
    return st;
}

/* ---- the links of a slab ------------------------------------------------------------- */

static int compare_links(const void *pa, const void *pb)
{
    const il_given_link *a = pa, *b = pb;
    if (a->link.lower != b->link.lower)
        return a->link.lower < b->link.lower ? -1 : 1;
    if (a->link.upper != b->link.upper)
        return a->link.upper < b->link.upper ? -1 : 1;
    return (a->line > b->line) - (a->line < b->line);
}

static il_status check_ring(const il_slice *s, uint32_t ring, long line, il_error *err)
{
    char z[IL_NUMBER_MAX];
    if (ring < s->n)
        return IL_OK;
    il_number_format(z, s->z);
    return il_fail(err, IL_E_INPUT, line, "the slice at z = %s has %zu ring%s, from 0 on, and no ring %lu", z, s->n,
                   s->n == 1 ? "" : "s", (unsigned long)ring);
}

/* The links of slab K into row[], rising. */
static il_status take_rows(giving *g, size_t k, il_error *err)
{
    const il_given_slab *s = g->slab_of[k];
    il_status st = il_grow(&g->row, &g->cap_rows, s->n, sizeof *g->row) ? IL_OK : il_fail_nomem(err);
    for (size_t i = 0; i < s->n && st == IL_OK; i++) {
        const il_given_link *l = g->row + i;
        g->row[i] = g->given->link[s->first + i];
        st = check_ring(&g->slice[k], l->link.lower, l->line, err);
        if (st == IL_OK)
            st = check_ring(&g->slice[k + 1], l->link.upper, l->line, err);
    }
    if (st == IL_OK && s->n > 1)
        qsort(g->row, s->n, sizeof *g->row, compare_links);
    for (size_t i = 1; i < s->n && st == IL_OK; i++) {
        const il_given_link *l = g->row + i;
        if (l[-1].link.lower == l->link.lower && l[-1].link.upper == l->link.upper)
            st = il_fail(err, IL_E_INPUT, l->line, "this link stands at line %ld already", l[-1].line);
    }
    return st;
}

/* ---- what is true of a link ------------------------------------------------------------- */

/* The rings of S, a class each. */
static il_status plant_tree(const il_slice *s, il_nearest *t, il_error *err)
{
    size_t n = il_slice_points(s), at = 0;
    il_segment *segment = il_alloc(n, sizeof *segment);
    if (!segment)
        return il_fail_nomem(err);
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        for (size_t v = 0; v < r->n; v++) {
            const double *p = r->xy + 2 * v, *q = r->xy + 2 * (v + 1 < r->n ? v + 1 : 0);
            segment[at++] = (il_segment){ p[0], p[1], q[0], q[1], i, v };
        }
    }
    return il_nearest_build(t, segment, n, s->n, err);
}

/* An edge, from a to b, that others may meet. */
typedef struct crossing { const double *a, *b; } crossing;

static bool meets(void *context, const il_segment *s)
{
    const crossing *e = context;
    const double c[2] = { s->ax, s->ay }, d[2] = { s->bx, s->by };
    return il_orientation(e->a, e->b, c) * il_orientation(e->a, e->b, d) <= 0 &&
           il_orientation(c, d, e->a) * il_orientation(c, d, e->b) <= 0;
}

/* Does outline R meet that of class C of T? */
static bool meet(const il_ring *r, const il_nearest *t, size_t c)
{
    bool found = false;
    for (size_t i = 0; i < r->n && !found; i++) {
        crossing e = { r->xy + 2 * i, r->xy + 2 * (i + 1 < r->n ? i + 1 : 0) };
        found = il_nearest_visit_along(t, c, e.a, e.b, meets, &e);
    }
    return found;
}

/* Of outlines that do not meet one end of the least distance is a vertex. */
static double distance(const il_slice slice[2], const il_nearest t[2], const il_link *l)
{
    const uint32_t ring[2] = { l->lower, l->upper };
    double least = meet(&slice[0].ring[l->lower], &t[1], l->upper) ? 0 : INFINITY;
    for (int side = 0; side < 2; side++) {
        const il_ring *r = &slice[side].ring[ring[side]];
        for (size_t i = 0; i < r->n; i++)
            least = fmin(least, il_nearest_distance(&t[1 - side], ring[1 - side], r->xy[2 * i], r->xy[2 * i + 1]));
    }
    return least;
}

static int compare_ends(const void *pa, const void *pb)
{
    const il_link *a = pa, *b = pb;
    if (a->lower != b->lower)
        return a->lower < b->lower ? -1 : 1;
    return (a->upper > b->upper) - (a->upper < b->upper);
}

static bool is_overlap(const giving *g, size_t k, const il_link *l)
{
    const il_link *from = g->overlaps.link + g->overlaps.first[k];
    size_t n = g->overlaps.first[k + 1] - g->overlaps.first[k];
    return n > 0 && bsearch(l, from, n, sizeof *from, compare_ends);
}

static bool is_of_hole(const giving *g, size_t k, const il_link *l)
{
    return il_ring_area2(&g->slice[k].ring[l->lower]) < 0 || il_ring_area2(&g->slice[k + 1].ring[l->upper]) < 0;
}

static il_link judge(const giving *g, size_t k, const il_nearest t[2], const il_given_link *said)
{
    il_link l = said->link;
    bool overlap = is_overlap(g, k, &l);
    bool lies_on = l.reason == IL_LINK_OVERLAP || l.reason == IL_LINK_SLANT;
    if (said->explained && is_of_hole(g, k, &l))
        return l;
    double apart = overlap ? 0 : distance(g->slice + k, t, &l);
    bool agrees = said->explained && fabs(l.reach - apart) <= reach_leeway * apart;
    if (!agrees || l.reason == IL_LINK_OPENING || lies_on != overlap)
        l.reason = IL_LINK_GIVEN;
    if (!agrees)
        l.reach = apart;
    return l;
}

static il_status judge_slab(giving *g, size_t k, il_linkage *out, il_error *err)
{
    il_nearest t[2] = { { 0 }, { 0 } };
    il_status st = IL_OK;
    size_t n = g->slab_of[k] ? g->slab_of[k]->n : 0, at = out->first[k];
    if (n > 0)
        st = take_rows(g, k, err);
    for (size_t side = 0; side < 2 && n > 0 && st == IL_OK; side++)
        st = plant_tree(&g->slice[k + side], &t[side], err);
    for (size_t i = 0; i < n && st == IL_OK; i++)
        out->link[at++] = judge(g, k, t, &g->row[i]);
    out->first[k + 1] = at;
    il_nearest_free(&t[0]);
    il_nearest_free(&t[1]);
    return st;
}

static il_status give(giving *g, il_linkage *out, il_error *err)
{
    size_t n = 0;
    il_linkage_options overlaps = il_linkage_options_for(IL_PIECES_OVERLAP);
    g->slab_of = il_calloc(g->n, sizeof *g->slab_of);
    il_status st = g->slab_of ? place_slabs(g, err) : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_linkage_find(&g->overlaps, g->slice, g->n, g->known, &overlaps, err);
    for (size_t i = 0; i < g->stack->n; i++)
        n += g->given->slab[g->stack->first + i].n;
    out->link = il_alloc(n, sizeof *out->link);
    out->first = il_calloc(g->n + 1, sizeof *out->first);
    if (st == IL_OK && (!out->link || !out->first))
        st = il_fail_nomem(err);
    for (size_t k = 0; k + 1 < g->n && st == IL_OK; k++)
        st = judge_slab(g, k, out, err);
    if (st == IL_OK)
        out->first[g->n] = out->first[g->n - 1];
    return st;
}

il_status il_linkage_given(il_linkage *out, const il_slice *slice, size_t n, const il_pair *const *known,
                           const il_given *given, const il_given_stack *s, il_error *err)
{
    giving g = { .slice = slice, .n = n, .given = given, .stack = s, .known = known, .overlaps = IL_LINKAGE_INIT };
    *out = (il_linkage)IL_LINKAGE_INIT;
    il_status st = give(&g, out, err);
    if (st != IL_OK) {
        il_error_set_file(err, given->file);
        il_linkage_free(out);
    }
    il_free(g.slab_of);
    il_free(g.row);
    il_linkage_free(&g.overlaps);
    return st;
}
