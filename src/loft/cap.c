#include "config.h"
#include "loft/cap.h"
#include "base/alloc.h"
#include "base/parity.h"
#include "bridge/triangulation.h"

typedef struct lid {
    uint32_t *edge;           /* [2*n_stations] */
    il_keymap edge_at;        /* undirected contour edges */
    uint32_t *corner, *across;
    size_t n;
    unsigned char *inside;
} lid;

static bool note_edges(lid *l, const il_section *s)
{
    l->edge = il_alloc(s->n_stations, 2 * sizeof *l->edge);
    if (!l->edge || !il_keymap_reserve(&l->edge_at, s->n_stations))
        return false;
    for (size_t i = 0; i < s->n_stations; i++) {
        uint32_t a = s->node_at[i], b = s->node_at[s->next[i]];
        l->edge[2 * i] = a, l->edge[2 * i + 1] = b;
        il_keymap_put(&l->edge_at, IL_KEYMAP_EDGE(a, b), 1);
    }
    return true;
}

static bool find_inside(lid *l)
{
    unsigned char *bound = il_alloc(l->n, 3);
    l->inside = il_alloc(l->n, 1);
    bool ok = bound && l->inside;
    for (size_t e = 0; ok && e < 3 * l->n; e++) {
        uint32_t a = l->corner[e], b = l->corner[e % 3 == 2 ? e - 2 : e + 1];
        bound[e] = (unsigned char)il_keymap_get(&l->edge_at, IL_KEYMAP_EDGE(a, b), 0);
    }
    ok = ok && il_parity_flood(l->across, bound, 1, l->n, l->inside);
    il_free(bound);
    return ok;
}

static bool emit(const lid *l, il_surface *out, int side)
{
    for (size_t t = 0; t < l->n; t++) {
        if (!l->inside[t])
            continue;
        uint32_t a = IL_CODE(side, l->corner[3 * t]), b = IL_CODE(side, l->corner[3 * t + 1]), c = IL_CODE(side, l->corner[3 * t + 2]);
        if (!il_surface_add_triangle(out, a, side == 0 ? b : c, side == 0 ? c : b))
            return false;
    }
    return true;
}

/* Append the lid of SECTION to OUT. */
static il_status add_lid(il_surface *out, const il_section *section, int side, il_error *err)
{
    lid l = { 0 };
    il_triangulation *t = NULL;
    if (section->n_stations == 0)
        return IL_OK;
    il_status st = note_edges(&l, section) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_triangulation_new(&t, section->xy, section->n_nodes, l.edge, section->n_stations, err);
    if (st == IL_OK)
        st = il_triangulation_export(t, &l.corner, &l.across, &l.n, err);
    if (st == IL_OK && (!find_inside(&l) || !emit(&l, out, side)))
        st = il_fail_nomem(err);
    il_triangulation_free(t);
    il_free(l.edge);
    il_keymap_free(&l.edge_at);
    il_free(l.corner);
    il_free(l.across);
    il_free(l.inside);
    return st;
}

il_status il_cap_flat(il_surface *out, const il_section *section, int side, il_error *err)
{
    *out = (il_surface)IL_SURFACE_INIT;
    il_status st = add_lid(out, section, side, err);
    if (st != IL_OK)
        il_surface_free(out);
    return st;
}

il_status il_cap_gap(il_surface *out, const il_section *lower, const il_section *upper, il_error *err)
{
    *out = (il_surface)IL_SURFACE_INIT;
    il_status st = add_lid(out, lower, IL_LOWER, err);
    if (st == IL_OK)
        st = add_lid(out, upper, IL_UPPER, err);
    if (st != IL_OK)
        il_surface_free(out);
    return st;
}
