#include "config.h"
#include "loft/slab.h"
#include "base/alloc.h"
#include "loft/cap.h"
#include "loft/crowd.h"

#include <string.h>

void il_slab_free(il_slab *s)
{
    il_surface_free(&s->surface);
    il_free(s->lean[0].slope);
    il_free(s->lean[1].slope);
    memset(s, 0, sizeof *s);
}

il_status il_slab_loft(il_slab *out, il_section *lower, il_section *upper, const il_pair *pair, bool round_float, il_error *err)
{
    *out = (il_slab)IL_SLAB_INIT;
    out->gap = pair && pair->gap;
    if (out->gap)
        return IL_OK;
    il_crowd crowd;
    il_status st = il_crowd_gather(&crowd, lower, upper, pair, round_float, err);
    if (st == IL_OK)
        st = il_crowd_settle(&crowd, &out->surface, &out->verdict, err);
    if (st == IL_OK && out->verdict.flaw != IL_FLAW_NONE)
        st = IL_E_SURFACE;
    if (st == IL_OK)
        il_crowd_measure(&crowd, out->length_by, &out->length_alone);
    if (st == IL_OK)
        st = il_section_insert(lower, out->surface.insertion[0], out->surface.n_insertions[0], err);
    if (st == IL_OK)
        st = il_section_insert(upper, out->surface.insertion[1], out->surface.n_insertions[1], err);
    il_crowd_free(&crowd);
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
    if (s->gap)
        return il_cap_gap(&s->surface, lower, upper, err);
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
