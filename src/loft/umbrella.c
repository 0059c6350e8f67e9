/* umbrella.c - nodes that become several vertices, one for each fan of triangles.
 *
 * The certificate says that each contour edge bounds one triangle below and one
 * above the section.  So a node that one ring passes once has one fan of
 * triangles on either side, and they close to an umbrella; only where rings
 * touch can there be several, or at an edge that more than two triangles shared,
 * and only such nodes are walked. */
#include "config.h"
#include "loft/pinch.h"
#include "base/alloc.h"
#include "base/forest.h"

#include <string.h>

/* A corner at a touching node. */
typedef struct fan_corner {
    uint32_t node, corner;
    int collar;
} fan_corner;

typedef struct finder {
    il_umbrellas *u;
    const il_section *section;
    const il_collar *collar;
    unsigned char *touching;
    fan_corner *list;     size_t n, cap;
    uint32_t *fan;        /* [n] corners that belong together (base/forest.h) */
    il_keymap leaving;    /* (node, other end of the half-edge that leaves it) -> corner in list */
} finder;

static uint32_t next_corner(uint32_t e)
{
    return e % 3 == 2 ? e - 2 : e + 1;
}

static bool find_touching(finder *f, bool *any)
{
    const il_section *s = f->section;
    f->touching = il_calloc(s->n_nodes, 1);
    *any = false;
    for (size_t i = 0; f->touching && i < s->n_stations; i++) {
        unsigned char *n = &f->touching[s->node_at[i]];
        *any |= *n == 1;
        *n = (unsigned char)(*n < 2 ? *n + 1 : 2);
    }
    for (int c = 0; f->touching && c < 2; c++) {
        const il_surface *surface = f->collar[c].surface;
        for (size_t i = 0; surface && i < surface->n_pinched; i++)
            if (IL_CODE_WHERE(surface->pinched[i]) == (uint32_t)f->collar[c].side) {
                f->touching[IL_CODE_INDEX(surface->pinched[i])] = 2;
                *any = true;
            }
    }
    return f->touching != NULL;
}

static bool collect(finder *f)
{
    for (int c = 0; c < 2; c++) {
        const il_surface *s = f->collar[c].surface;
        for (uint32_t e = 0; s && e < 3 * s->n_triangles; e++) {
            uint32_t node = IL_CODE_INDEX(s->tri[e]);
            if (IL_CODE_WHERE(s->tri[e]) != (uint32_t)f->collar[c].side || f->touching[node] < 2)
                continue;
            if (!il_grow(&f->list, &f->cap, f->n + 1, sizeof *f->list))
                return false;
            f->list[f->n] = (fan_corner){ node, e, c };
            f->n++;
        }
    }
    return true;
}

/* A name for the far end of an edge at a node: nodes of the section are the
 * same seen from either collar, all else is a collar's own. */
static uint64_t far_end(const finder *f, int collar, uint32_t code)
{
    if (IL_CODE_WHERE(code) == (uint32_t)f->collar[collar].side)
        return IL_CODE_INDEX(code);
    return (uint64_t)(collar + 1) << 32 | code;
}

/* Join corners over the edges that they share. */
static bool join(finder *f)
{
    f->fan = il_alloc(f->n, sizeof *f->fan);
    if (!f->fan)
        return false;
    il_forest_plant(f->fan, f->n);
    for (uint32_t i = 0; i < f->n; i++) {
        const fan_corner *c = &f->list[i];
        const uint32_t *tri = f->collar[c->collar].surface->tri;
        if (!il_keymap_put(&f->leaving, c->node, far_end(f, c->collar, tri[next_corner(c->corner)]), i))
            return false;
    }
    for (uint32_t i = 0; i < f->n; i++) {
        const fan_corner *c = &f->list[i];
        const uint32_t *tri = f->collar[c->collar].surface->tri;
        uint64_t far = far_end(f, c->collar, tri[next_corner(next_corner(c->corner))]);
        uint32_t other = il_keymap_get(&f->leaving, c->node, far, UINT32_MAX);
        if (other != UINT32_MAX)
            il_forest_join(f->fan, i, other);
    }
    return true;
}

static bool add_vertex(il_umbrellas *u, uint32_t node)
{
    if (!il_grow(&u->node_of, &u->cap, u->n_vertices + 1, sizeof *u->node_of))
        return false;
    u->node_of[u->n_vertices++] = node;
    return true;
}

/* The first fan of a node keeps its vertex, each further one gets a new one. */
static bool number(finder *f)
{
    uint32_t *vertex = il_alloc(f->n, sizeof *vertex);
    bool ok = vertex != NULL;
    for (uint32_t i = 0; ok && i < f->n; i++) {
        uint32_t r = il_forest_leader(f->fan, i), node = f->list[i].node;
        if (r == i) {
            vertex[i] = f->touching[node] == 2 ? node : (uint32_t)f->u->n_vertices;
            if (f->touching[node] == 3) {
                ok = add_vertex(f->u, node);
                f->u->n_pinches++;
            }
            f->touching[node] = 3;
        } else {
            vertex[i] = vertex[r];
        }
        if (ok && vertex[i] != node)
            ok = il_keymap_put(&f->u->other, (uint64_t)f->list[i].collar, f->list[i].corner, vertex[i]);
    }
    il_free(vertex);
    return ok;
}

il_status il_umbrellas_find(il_umbrellas *u, const il_section *section, const il_collar collar[2], il_error *err)
{
    finder f = { .u = u, .section = section, .collar = collar };
    bool any = false, ok = find_touching(&f, &any);
    *u = (il_umbrellas)IL_UMBRELLAS_INIT;
    for (uint32_t i = 0; ok && i < section->n_nodes; i++)
        ok = add_vertex(u, i);
    if (ok && any)
        ok = collect(&f) && join(&f) && number(&f);
    il_free(f.touching);
    il_free(f.list);
    il_free(f.fan);
    il_keymap_free(&f.leaving);
    if (ok)
        return IL_OK;
    il_umbrellas_free(u);
    return il_fail_nomem(err);
}

void il_umbrellas_free(il_umbrellas *u)
{
    il_keymap_free(&u->other);
    il_free(u->node_of);
    *u = (il_umbrellas)IL_UMBRELLAS_INIT;
}

uint32_t il_umbrellas_vertex(const il_umbrellas *u, int collar, size_t corner, uint32_t node)
{
    return u->other.n > 0 ? il_keymap_get(&u->other, (uint64_t)collar, corner, node) : node;
}
