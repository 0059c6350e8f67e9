#include "config.h"
#include "region/separate.h"
#include "base/keymap.h"
#include "base/number.h"
#include "model/order.h"
#include "model/arrange.h"
#include "region/boundary.h"
#include "model/near.h"

/* The first step of a copy towards the middle of its neighbours, as a part of
 * that way; doubled until rounding keeps the copies apart.  Less than 1/256
 * was seen to cross again when a later stage rounds to 32-bit floats. */
static const double FIRST_STEP = 1.0 / 256, LAST_STEP = 1.0 / 8;

static bool is_inserted(const il_ring *r, size_t i)
{
    return r->mark && r->mark[i] & IL_VERTEX_INSERTED;
}

static uint32_t *visits_at(il_keymap *visits, const double *p, uint32_t first)
{
    return il_keymap_put(visits, il_keymap_double(p[0]), il_keymap_double(p[1]), first);
}

/* How often the rings of S pass each inserted vertex; *SHARED: how many are
 * passed more than once. */
static bool count_visits(il_keymap *visits, const il_slice *s, size_t *shared)
{
    *shared = 0;
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->ring[i].n; k++) {
            if (!is_inserted(&s->ring[i], k))
                continue;
            uint32_t *n = visits_at(visits, s->ring[i].xy + 2 * k, 0);
            if (!n)
                return false;
            *shared += ++*n == 2;
        }
    return true;
}

static double rounded(double v, bool round_float)
{
    return (round_float ? il_number_round_float(v) : v) + 0.0; /* no -0 */
}

/* The place of vertex K of R, drawn between its neighbours. */
static void draw_in(const il_ring *r, size_t k, bool round_float, double to[2])
{
    const double *p = r->xy + 2 * k, *a = r->xy + 2 * ((k + r->n - 1) % r->n), *b = r->xy + 2 * ((k + 1) % r->n);
    for (double step = FIRST_STEP; step <= LAST_STEP; step *= 2) {
        for (int i = 0; i < 2; i++)
            to[i] = rounded(p[i] + step * ((a[i] - p[i]) / 2 + (b[i] - p[i]) / 2), round_float);
        if (to[0] != p[0] || to[1] != p[1])
            return;
    }
}

/* All moves are taken from S as it was and put into TO, its copy. */
static void move_all(il_slice *to, const il_slice *s, il_keymap *visits, bool round_float)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->ring[i].n; k++) {
            const double *p = s->ring[i].xy + 2 * k;
            if (is_inserted(&s->ring[i], k) && *visits_at(visits, p, 0) > 1)
                draw_in(&s->ring[i], k, round_float, to->ring[i].xy + 2 * k);
        }
}

/* Is S the clean boundary of its own region, with N_PINCHES pinches: does it
 * stay as it is when it is made anew?  May change S if not. */
static il_status is_clean(il_slice *s, bool round_float, size_t n_pinches, bool *clean, il_error *err)
{
    il_arrangement a = IL_ARRANGEMENT_INIT;
    il_slice anew = IL_SLICE_INIT;
    size_t moved = 0, joined = 0, crossings = 0, touches = 0, cancelled = 0, pinches = 0;
    double cell = il_slice_cell(s, round_float);
    *clean = false;
    il_status st = il_slice_gather(s, cell, &moved, &joined, err);
    if (st == IL_OK && moved > 0)
        return IL_OK;
    if (st == IL_OK)
        st = il_arrangement_from_slice(&a, s, cell, err);
    if (st == IL_OK)
        st = il_arrangement_settle(&a, &crossings, &touches, err);
    if (st == IL_OK && crossings + touches == 0)
        st = il_boundary_extract(&a, &anew, &cancelled, &pinches, err);
    *clean = st == IL_OK && crossings + touches == 0 && pinches == n_pinches && il_slice_equal_rings(s, &anew);
    il_slice_free(&anew);
    il_arrangement_free(&a);
    return st;
}

il_status il_slice_separate(il_slice *s, bool round_float, size_t *pinches, il_error *err)
{
    il_keymap visits = IL_KEYMAP_INIT;
    il_slice apart = IL_SLICE_INIT;
    size_t shared = 0;
    bool clean = false;
    il_status st = count_visits(&visits, s, &shared) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK && shared > 0) {
        st = il_slice_copy(&apart, s, err);
        if (st == IL_OK) {
            move_all(&apart, s, &visits, round_float);
            il_slice_put_in_order(&apart);
            st = is_clean(&apart, round_float, *pinches - shared, &clean, err);
        }
        if (st == IL_OK && clean) {
            il_slice swap = *s;
            *s = apart;
            apart = swap;
            *pinches -= shared;
        }
    }
    il_slice_free(&apart);
    il_keymap_free(&visits);
    return st;
}
