#include "config.h"
#include "match/refit.h"
#include "base/alloc.h"
#include "base/keymap.h"
#include "base/number.h"
#include "match/carry.h"
#include "match/ffd.h"
#include "match/link.h"

#include <stdlib.h>
#include <string.h>

/* was, is: the last two slices, lower and upper, before and behind the cleaning.
 * is_terrain: of this stack, which no cleaning touches, so that nothing is held. */
struct il_refit {
    il_sink before, behind;
    il_sink *cleaning, *next;
    il_slice was[2], is[2];
    il_pair *pair;            /* the record on its way round the cleaning */
    il_ffd *solver;           /* made when it is needed */
    bool is_terrain;
};

static il_refit *from_before(il_sink *s)
{
    return (il_refit *)((char *)s - offsetof(il_refit, before));
}

static il_refit *from_behind(il_sink *s)
{
    return (il_refit *)((char *)s - offsetof(il_refit, behind));
}

/* ---- which ring and vertex became which ---- */

/* Of one slice: ring i is now ring[i], and its vertex 0 is vertex first[i]. */
typedef struct renumbering {
    uint32_t *ring, *first;
} renumbering;

static void renumbering_free(renumbering *r)
{
    il_free(r->ring);
    il_free(r->first);
}

static double rounded(double x)
{
    return il_number_round_float(x);
}

/* Are the rings A, rounded, and B the same from vertex FIRST of B on? */
static bool same_ring(const il_ring *a, const il_ring *b, uint32_t first)
{
    if (a->n != b->n)
        return false;
    for (size_t k = 0; k < a->n; k++) {
        size_t v = (first + k) % b->n;
        if (rounded(a->xy[2 * k]) != b->xy[2 * v] || rounded(a->xy[2 * k + 1]) != b->xy[2 * v + 1])
            return false;
    }
    return true;
}

/* *SAME is false when WAS, rounded, is not IS but for the order and the first
 * vertices of its rings, or when its rings touch, which would leave a choice. */
static il_status renumber(renumbering *r, const il_slice *was, const il_slice *is, bool *same, il_error *err)
{
    il_keymap at = IL_KEYMAP_INIT;
    size_t n = 0;
    *same = was->n == is->n;
    r->ring = il_alloc(was->n, sizeof *r->ring);
    r->first = il_alloc(was->n, sizeof *r->first);
    bool ok = r->ring && r->first && il_keymap_reserve(&at, is->n);
    for (uint32_t i = 0; ok && i < is->n; i++) { /* canonical rings begin at their least vertex */
        const double *p = is->ring[i].xy;
        ok = il_keymap_put(&at, il_keymap_double(p[0]), il_keymap_double(p[1]), i) != NULL;
    }
    *same &= at.n == is->n;
    for (uint32_t i = 0; ok && *same && i < was->n; i++) {
        const il_ring *ring = &was->ring[i];
        r->ring[i] = UINT32_MAX;
        for (uint32_t k = 0; k < ring->n && r->ring[i] == UINT32_MAX; k++) {
            const double *p = ring->xy + 2 * k;
            uint32_t to = il_keymap_get(&at, il_keymap_double(rounded(p[0])), il_keymap_double(rounded(p[1])), UINT32_MAX);
            uint32_t first = (uint32_t)(k > 0 ? ring->n - k : 0);
            if (to != UINT32_MAX && same_ring(ring, &is->ring[to], first)) {
                r->ring[i] = to;
                r->first[i] = first;
                n++;
            }
        }
        *same = r->ring[i] != UINT32_MAX;
    }
    *same &= n == was->n;
    il_keymap_free(&at);
    return ok ? IL_OK : il_fail_nomem(err);
}

/* ---- carrying a record over ---- */

static void move_place(const renumbering *r, const il_slice *is, il_place *p)
{
    uint32_t ring = r->ring[p->ring];
    p->vertex = (uint32_t)((p->vertex + r->first[p->ring]) % is->ring[ring].n);
    p->ring = ring;
}

static void move_arc(const renumbering *r, const il_slice *is, il_arc *a)
{
    move_place(r, is, &a->from);
    move_place(r, is, &a->to);
}

static int compare_indices(const void *p, const void *q)
{
    uint32_t a = *(const uint32_t *)p, b = *(const uint32_t *)q;
    return a < b ? -1 : a > b;
}

static void move_rings(const renumbering *r, uint32_t *ring, size_t n)
{
    for (size_t i = 0; i < n; i++)
        ring[i] = r->ring[ring[i]];
    if (n > 1)
        qsort(ring, n, sizeof *ring, compare_indices);
}

static int compare_phi(const void *p, const void *q)
{
    return il_place_compare(&((const il_phi_point *)p)->at, &((const il_phi_point *)q)->at);
}

static void carry_over(il_pair *p, const renumbering r[2], const il_slice *is)
{
    for (size_t i = 0; i < p->n_groups; i++) {
        il_group *g = &p->group[i];
        move_rings(&r[0], g->lower, g->n_lower);
        move_rings(&r[1], g->upper, g->n_upper);
        for (size_t k = 0; k < g->n_links; k++) {
            g->link[k].lower = r[0].ring[g->link[k].lower];
            g->link[k].upper = r[1].ring[g->link[k].upper];
        }
    }
    for (size_t i = 0; i < p->n_matches; i++) {
        move_arc(&r[0], &is[0], &p->match[i].lower);
        move_arc(&r[1], &is[1], &p->match[i].upper);
    }
    for (size_t i = 0; i < p->n_unmatched; i++)
        move_arc(&r[p->unmatched[i].upper], &is[p->unmatched[i].upper], &p->unmatched[i].arc);
    for (size_t i = 0; i < p->n_insertions; i++)
        move_place(&r[p->insertion[i].upper], &is[p->insertion[i].upper], &p->insertion[i].at);
    for (size_t i = 0; i < p->n_cuts; i++)
        p->cut[i].ring = r[p->cut[i].upper].ring[p->cut[i].ring];
    for (size_t i = 0; i < p->n_phi; i++)
        move_place(&r[1], &is[1], &p->phi[i].at);
    if (p->n_phi > 0)
        qsort(p->phi, p->n_phi, sizeof *p->phi, compare_phi);
}

/* What belonged together still does: who has linked over the whole stack, or by hand, has seen
 * more than these two slices. */
static il_status link_again(il_refit *r, il_pair *p, il_error *err)
{
    il_link *link = NULL;
    size_t n = 0;
    bool linked = p->matcher == IL_MATCHER_FFD && p->n_groups > 0;
    il_status st = linked ? il_links_carry(p, r->was, r->is, &link, &n, err) : IL_OK;
    il_pair_free(p);
    p->linked = linked;
    if (st == IL_OK && linked)
        st = il_link_group(p, &r->is[0], &r->is[1], link, n, err);
    il_free(link);
    return st;
}

static il_status match_again(il_refit *r, il_pair *p, il_error *err)
{
    il_match_options o = { p->matcher, false, 1 };
    il_status st = r->solver || o.matcher == IL_MATCHER_NONE ? IL_OK : il_ffd_new(&r->solver, err);
    if (st == IL_OK)
        st = link_again(r, p, err);
    return st == IL_OK ? il_match_slices(&r->is[0], &r->is[1], &o, r->solver, p, err) : st;
}

static il_status refit(il_refit *r, il_pair *p, il_error *err)
{
    renumbering side[2] = { { NULL, NULL }, { NULL, NULL } };
    bool same = true;
    il_status st = IL_OK;
    for (int k = 0; st == IL_OK && same && k < 2; k++)
        st = renumber(&side[k], &r->was[k], &r->is[k], &same, err);
    if (st == IL_OK && same)
        carry_over(p, side, r->is);
    else if (st == IL_OK)
        st = match_again(r, p, err);
    renumbering_free(&side[0]);
    renumbering_free(&side[1]);
    return st;
}

/* ---- the stage before ---- */

static void forget(il_refit *r)
{
    for (int k = 0; k < 2; k++) {
        il_slice_free(&r->was[k]);
        il_slice_free(&r->is[k]);
    }
}

/* The last slice becomes the lower one, and a copy of S the upper. */
static il_status keep(il_slice pair[2], const il_slice *s, il_error *err)
{
    il_slice_free(&pair[0]);
    pair[0] = pair[1];
    pair[1] = (il_slice)IL_SLICE_INIT;
    return il_slice_copy(&pair[1], s, err);
}

static il_status before_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    il_refit *r = from_before(self);
    forget(r);
    r->is_terrain = head->kind == IL_KIND_TERRAIN;
    return r->cleaning->stack_begin(r->cleaning, head, err);
}

static il_status before_slice(il_sink *self, il_slice *s, il_error *err)
{
    il_refit *r = from_before(self);
    il_status st = r->is_terrain ? IL_OK : keep(r->was, s, err);
    return st == IL_OK ? r->cleaning->slice(r->cleaning, s, err) : st;
}

/* A record that names nothing goes through the cleaning in this one's place, and
 * makes it pass its slice on. */
static il_status before_pair(il_sink *self, il_pair *p, il_error *err)
{
    il_refit *r = from_before(self);
    il_pair token = IL_PAIR_INIT;
    token.line = p->line;
    r->pair = p;
    il_status st = r->cleaning->pair(r->cleaning, &token, err);
    r->pair = NULL;
    return st;
}

static il_status before_stack_end(il_sink *self, il_error *err)
{
    il_refit *r = from_before(self);
    return r->cleaning->stack_end(r->cleaning, err);
}

static il_status before_end(il_sink *self, il_error *err)
{
    il_refit *r = from_before(self);
    return r->cleaning->end(r->cleaning, err);
}

/* ---- the stage behind ---- */

static il_status behind_stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    il_refit *r = from_behind(self);
    return r->next->stack_begin(r->next, head, err);
}

static il_status behind_slice(il_sink *self, il_slice *s, il_error *err)
{
    il_refit *r = from_behind(self);
    il_status st = r->is_terrain ? IL_OK : keep(r->is, s, err);
    return st == IL_OK ? r->next->slice(r->next, s, err) : st;
}

static il_status behind_pair(il_sink *self, il_pair *token, il_error *err)
{
    il_refit *r = from_behind(self);
    (void)token;
    il_status st = !r->is_terrain && il_pair_names_rings(r->pair) ? refit(r, r->pair, err) : IL_OK;
    return st == IL_OK ? r->next->pair(r->next, r->pair, err) : st;
}

static il_status behind_stack_end(il_sink *self, il_error *err)
{
    il_refit *r = from_behind(self);
    forget(r);
    return r->next->stack_end(r->next, err);
}

static il_status behind_end(il_sink *self, il_error *err)
{
    il_refit *r = from_behind(self);
    return r->next->end(r->next, err);
}

il_status il_refit_new(il_refit **out, il_sink *next, il_error *err)
{
    il_refit *r = *out = il_calloc(1, sizeof *r);
    if (!r)
        return il_fail_nomem(err);
    r->before = (il_sink){ before_stack_begin, before_slice, before_pair, before_stack_end, before_end };
    r->behind = (il_sink){ behind_stack_begin, behind_slice, behind_pair, behind_stack_end, behind_end };
    r->next = next;
    return IL_OK;
}

void il_refit_free(il_refit *r)
{
    if (!r)
        return;
    forget(r);
    il_ffd_free(r->solver);
    il_free(r);
}

il_sink *il_refit_behind(il_refit *r)
{
    return &r->behind;
}

il_sink *il_refit_before(il_refit *r, il_sink *cleaning)
{
    r->cleaning = cleaning;
    return &r->before;
}
