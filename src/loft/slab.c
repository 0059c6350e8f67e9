#include "config.h"
#include "loft/slab.h"
#include "base/alloc.h"

#include <string.h>

void il_slab_free(il_slab *s)
{
    il_surface_free(&s->surface);
    memset(s, 0, sizeof *s);
}

/* One try: a grid and a height of caps. */
typedef struct trial {
    int exponent;
    double rise;
    bool round_float;
} trial;

/* Give the copies BELOW and ABOVE the surface's insertions, and judge it. */
static il_status judge(il_slab *s, il_section *below, il_section *above, il_error *err)
{
    il_status st = il_section_insert(below, s->surface.insertion[0], s->surface.n_insertions[0], err);
    if (st == IL_OK)
        st = il_section_insert(above, s->surface.insertion[1], s->surface.n_insertions[1], err);
    if (st == IL_OK)
        st = il_certify(&s->surface, below, above, &s->verdict, err);
    return st;
}

static void swap(il_section *a, il_section *b)
{
    il_section c = *a;
    *a = *b;
    *b = c;
}

/* Build over the snapped reference and judge; when sound, LOWER and UPPER are
 * exchanged for their successors with the insertions. */
static il_status build_and_judge(il_slab *s, il_section *lower, il_section *upper, const il_reference *r,
                                 const il_snapped *snapped, const trial *t, il_error *err)
{
    il_overlay o;
    il_section below = IL_SECTION_INIT, above = IL_SECTION_INIT;
    il_build_options options = { t->rise, t->round_float };
    bool sound = true;
    il_surface_free(&s->surface);
    s->verdict = (il_verdict){ IL_FLAW_REFERENCE, { 0, 0, 0 }, 0 };
    il_status st = il_overlay_build(&o, r, snapped, &sound, err);
    if (st == IL_OK && sound) {
        st = il_build_surface(&s->surface, &o, &options, err);
        if (st == IL_OK)
            st = il_section_copy(&below, lower, err);
        if (st == IL_OK)
            st = il_section_copy(&above, upper, err);
        if (st == IL_OK)
            st = judge(s, &below, &above, err);
        if (st == IL_OK && s->verdict.flaw == IL_FLAW_NONE) {
            swap(lower, &below);
            swap(upper, &above);
        }
    }
    il_section_free(&below);
    il_section_free(&above);
    il_overlay_free(&o);
    return st;
}

/* Lower caps until they cross nothing; other flaws do not depend on them. */
static il_status try_grid(il_slab *s, il_section *lower, il_section *upper, const il_reference *r,
                          trial t, il_error *err)
{
    il_snapped snapped;
    bool injective;
    il_status st = il_snap(&snapped, r, t.exponent, &injective, err);
    if (st != IL_OK)
        return st;
    s->verdict = (il_verdict){ IL_FLAW_REFERENCE, { 0, 0, 0 }, 0 };
    if (injective) {
        for (t.rise = 0.5; st == IL_OK && t.rise > 0.05; t.rise /= 2) {
            st = build_and_judge(s, lower, upper, r, &snapped, &t, err);
            if (s->verdict.flaw != IL_FLAW_CROSSING)
                break;
        }
    }
    il_snapped_free(&snapped);
    return st;
}

/* The grid to try after EXPONENT: a coarser one once, when triangles crossed on
 * the first (what nearly coincides is one thing there), else ever finer ones,
 * since two vertices of one slice fell on one point. */
static int next_exponent(int exponent, int first, int last, il_flaw flaw)
{
    if (exponent == first && flaw == IL_FLAW_CROSSING)
        return first + 4;
    int finer = (exponent > first ? first : exponent) - 4;
    return finer > last ? finer : last;
}

/* Attempt B: phi is the identity. */
static il_status attempt_identity(il_slab *s, il_section *lower, il_section *upper, bool round_float, il_error *err)
{
    il_reference r;
    il_status st = il_reference_build(&r, lower, upper, err);
    if (st != IL_OK)
        return st;
    int first = il_snap_first_exponent(&r, round_float), last = il_snap_last_exponent(&r);
    trial t = { first, 0.5, round_float };
    for (;;) {
        st = try_grid(s, lower, upper, &r, t, err);
        if (st != IL_OK || s->verdict.flaw == IL_FLAW_NONE || t.exponent <= last)
            break;
        t.exponent = next_exponent(t.exponent, first, last, s->verdict.flaw);
    }
    il_reference_free(&r);
    s->attempt = IL_ATTEMPT_B;
    return st;
}

il_status il_slab_loft(il_slab *out, il_section *lower, il_section *upper, bool round_float, il_error *err)
{
    *out = (il_slab)IL_SLAB_INIT;
    il_status st = attempt_identity(out, lower, upper, round_float, err);
    if (st == IL_OK && out->verdict.flaw != IL_FLAW_NONE)
        st = IL_E_SURFACE;
    out->n_nodes[0] = lower->n_nodes;
    out->n_nodes[1] = upper->n_nodes;
    return st;
}

/* ---- following the neighbours ---- */

/* From the nodes of a contour edge, as the slab knows it, to the station where
 * it starts now: only edges that were split since. */
static bool index_split_edges(il_keymap *at, const il_section *section, size_t n_known)
{
    for (uint32_t i = 0; i < section->n_stations; i++) {
        uint32_t end = section->next[i];
        if (section->node_at[i] >= n_known || section->node_at[end] < n_known)
            continue;
        while (section->node_at[end] >= n_known)
            end = section->next[end];
        if (!il_keymap_put(at, section->node_at[i], section->node_at[end], i))
            return false;
    }
    return true;
}

/* Triangle T of S has contour edge K, which runs from station FIRST through
 * inserted nodes: put a fan in its place, from the corner opposite. */
static bool fan_split(il_surface *s, size_t t, size_t k, const il_section *section, int side, uint32_t first, size_t n_known)
{
    uint32_t apex = s->tri[3 * t + (k + 2) % 3];
    bool is_first = true;
    for (uint32_t i = first;; i = section->next[i]) {
        uint32_t a = IL_CODE(side, section->node_at[i]), b = IL_CODE(side, section->node_at[section->next[i]]);
        uint32_t from = side == 0 ? a : b, to = side == 0 ? b : a;
        if (is_first) {
            uint32_t *tri = s->tri + 3 * t;
            tri[0] = from, tri[1] = to, tri[2] = apex;
            is_first = false;
        } else if (!il_surface_add_triangle(s, from, to, apex)) {
            return false;
        }
        if (section->node_at[section->next[i]] < n_known)
            return true;
    }
}

static bool split_side(il_surface *s, const il_section *section, int side, size_t n_known, unsigned char **touched, size_t *n_touched)
{
    il_keymap at = IL_KEYMAP_INIT;
    bool ok = index_split_edges(&at, section, n_known);
    size_t n = s->n_triangles, cap = *n_touched;
    for (size_t i = 0; ok && at.n > 0 && i < 3 * n; i++) {
        uint32_t a = s->tri[i], b = s->tri[i % 3 == 2 ? i - 2 : i + 1];
        if (IL_CODE_WHERE(a) != (uint32_t)side || IL_CODE_WHERE(b) != (uint32_t)side)
            continue;
        uint32_t from = IL_CODE_INDEX(side == 0 ? a : b), to = IL_CODE_INDEX(side == 0 ? b : a);
        uint32_t first = il_keymap_get(&at, from, to, UINT32_MAX);
        if (first == UINT32_MAX)
            continue;
        size_t before = s->n_triangles, t = i / 3;
        ok = fan_split(s, t, i % 3, section, side, first, n_known) &&
             il_grow(touched, &cap, s->n_triangles, 1);
        if (!ok)
            break;
        memset(*touched + *n_touched, 0, before - *n_touched);
        memset(*touched + before, 1, s->n_triangles - before);
        (*touched)[t] = 1;
        *n_touched = s->n_triangles;
        i = 3 * t + 2; /* its other edges are no contour edges */
    }
    il_keymap_free(&at);
    return ok;
}

il_status il_slab_follow(il_slab *s, const il_section *lower, const il_section *upper, il_error *err)
{
    unsigned char *touched = NULL;
    size_t n_touched = 0;
    il_status st = IL_OK;
    if (!split_side(&s->surface, lower, 0, s->n_nodes[0], &touched, &n_touched) ||
        !split_side(&s->surface, upper, 1, s->n_nodes[1], &touched, &n_touched))
        st = il_fail_nomem(err);
    if (st == IL_OK && n_touched > 0)
        st = il_certify_touched(&s->surface, lower, upper, touched, &s->verdict, err);
    if (st == IL_OK && s->verdict.flaw != IL_FLAW_NONE)
        st = IL_E_SURFACE;
    il_free(touched);
    return st;
}
