#include "config.h"
#include "loft/overlay.h"
#include "base/alloc.h"
#include "base/parity.h"

#include <string.h>

/* ---- passes: which real points stand at a contour point ---- */

/* Parameter of grid point J on the reference edge I of SIDE by projection; in
 * cells, so that squares of small lengths do not vanish. */
static double project(const il_overlay *o, int side, size_t i, uint32_t j)
{
    const il_ref_side *s = &o->reference->side[side];
    const il_ref_vertex *a = &s->vertex[i], *b = &s->vertex[s->next[i]];
    double p[2], cell = o->snapped->cell;
    il_snapped_point(o->snapped, j, p);
    double dx = (b->x - a->x) / cell, dy = (b->y - a->y) / cell;
    return ((p[0] - a->x) / cell * dx + (p[1] - a->y) / cell * dy) / (dx * dx + dy * dy);
}

/* Note the passes of reference edge I.  Points on it keep their order. */
static bool note_run(il_overlay *o, int side, size_t i)
{
    const il_ref_side *s = &o->reference->side[side];
    const uint32_t *run = o->snapped->run[side], *point = o->snapped->point[side];
    const il_ref_vertex *a = &s->vertex[i], *b = &s->vertex[s->next[i]];
    double t_end = b->t > 0 && b->station == a->station ? b->t : 1, before = a->t;
    for (uint32_t j = run[i]; j < run[i + 1]; j++) {
        il_pass *pass = &o->pass[side][point[j]];
        pass->station = a->station;
        pass->vertex = (uint32_t)i;
        if (j == run[i]) {
            pass->t = a->t;
            pass->node = a->t == 0 ? (int32_t)o->reference->section[side]->node_at[a->station] : -1;
            continue;
        }
        double t = a->t + project(o, side, i, point[j]) * (t_end - a->t);
        if (!(t > before))
            t = before + (t_end - before) * 1e-6;
        if (!(t > before && t < t_end))
            return false;
        pass->t = before = t;
        pass->node = -1;
    }
    return true;
}

static bool note_passes(il_overlay *o, bool *sound)
{
    for (int k = 0; k < 2; k++) {
        o->pass[k] = il_alloc(o->n_contour, sizeof *o->pass[k]);
        if (!o->pass[k])
            return false;
        for (size_t i = 0; i < o->n_contour; i++)
            o->pass[k][i] = (il_pass){ -1, IL_NONE, IL_NONE, 0 };
        for (size_t i = 0; i < o->reference->side[k].n; i++)
            if (!note_run(o, k, i))
                *sound = false;
    }
    return true;
}

/* ---- edges ---- */

static bool note_edge(il_overlay *o, int side, uint32_t a, uint32_t b)
{
    unsigned present = side == IL_LOWER ? IL_EDGE_LOWER : IL_EDGE_UPPER;
    unsigned back = side == IL_LOWER ? IL_EDGE_LOWER_BACK : IL_EDGE_UPPER_BACK;
    size_t known = o->edge_at.n;
    uint32_t *flags = il_keymap_put(&o->edge_at, IL_KEYMAP_EDGE(a, b), 0);
    if (!flags)
        return false;
    if (o->edge_at.n > known) {
        o->rim[2 * o->n_edges] = a;
        o->rim[2 * o->n_edges + 1] = b;
        o->n_edges++;
    }
    *flags ^= present; /* parity: what is run through twice bounds nothing */
    *flags = a < b ? *flags & ~back : *flags | back;
    return true;
}

static bool note_edges(il_overlay *o)
{
    size_t n = o->snapped->n_points[0] + o->snapped->n_points[1];
    o->rim = il_alloc(n, 2 * sizeof *o->rim);
    if (!o->rim || !il_keymap_reserve(&o->edge_at, n))
        return false;
    for (int k = 0; k < 2; k++) {
        const il_ref_side *s = &o->reference->side[k];
        const uint32_t *run = o->snapped->run[k], *point = o->snapped->point[k];
        for (size_t i = 0; i < s->n; i++)
            for (uint32_t j = run[i]; j < run[i + 1]; j++)
                if (!note_edge(o, k, point[j], j + 1 < run[i + 1] ? point[j + 1] : point[run[s->next[i]]]))
                    return false;
    }
    return true;
}

/* ---- triangles ---- */

unsigned char il_overlay_edge(const il_overlay *o, uint32_t a, uint32_t b)
{
    uint32_t f = il_keymap_get(&o->edge_at, IL_KEYMAP_EDGE(a, b), 0);
    if (!(f & IL_EDGE_CONTOUR))
        return 0;
    if (a > b)
        f ^= IL_EDGE_LOWER_BACK | IL_EDGE_UPPER_BACK;
    return (unsigned char)(f & ((f & IL_EDGE_LOWER ? IL_EDGE_LOWER | IL_EDGE_LOWER_BACK : 0u) |
                                (f & IL_EDGE_UPPER ? IL_EDGE_UPPER | IL_EDGE_UPPER_BACK : 0u)));
}

static il_status read_triangles(il_overlay *o, il_error *err)
{
    il_free(o->corner);
    il_free(o->across);
    il_free(o->inside);
    il_free(o->edge);
    o->inside = o->edge = NULL;
    il_status st = il_triangulation_export(o->triangulation, &o->corner, &o->across, &o->n_triangles, err);
    if (st != IL_OK)
        return st;
    o->inside = il_alloc(o->n_triangles, 1);
    o->edge = il_alloc(o->n_triangles, 3);
    if (!o->inside || !o->edge)
        return il_fail_nomem(err);
    for (size_t t = 0; t < o->n_triangles; t++)
        for (size_t k = 0; k < 3; k++)
            o->edge[3 * t + k] = il_overlay_edge(o, o->corner[3 * t + k], o->corner[3 * t + (k + 1) % 3]);
    if (!il_parity_flood(o->across, o->edge, IL_EDGE_CONTOUR, o->n_triangles, o->inside))
        return il_fail_nomem(err);
    for (size_t t = 0; t < o->n_triangles; t++)
        o->inside[t] ^= o->reference->outside;
    return IL_OK;
}

/* The contour edges as constraints: those of an odd parity bound regions, and
 * the others are not needed. */
static il_status triangulate(il_overlay *o, il_error *err)
{
    uint32_t *edge = il_alloc(o->n_edges, 2 * sizeof *edge);
    if (!edge)
        return il_fail_nomem(err);
    size_t n = 0;
    for (size_t i = 0; i < o->n_edges; i++)
        if (il_overlay_edge(o, o->rim[2 * i], o->rim[2 * i + 1]) != 0) {
            memcpy(edge + 2 * n, o->rim + 2 * i, 2 * sizeof *edge);
            n++;
        }
    il_status st = il_triangulation_new(&o->triangulation, o->xy, o->n_points, edge, n, err);
    il_free(edge);
    return st == IL_OK ? read_triangles(o, err) : st;
}

static bool take_points(il_overlay *o)
{
    o->n_contour = o->n_points = o->snapped->n;
    if (!il_grow(&o->xy, &o->cap_points, 2 * o->n_points, sizeof *o->xy))
        return false;
    for (size_t i = 0; i < o->n_points; i++) {
        o->xy[2 * i] = (double)o->snapped->x[i];
        o->xy[2 * i + 1] = (double)o->snapped->y[i];
    }
    return true;
}

il_status il_overlay_build(il_overlay *o, const il_reference *r, const il_snapped *s, bool *sound, il_error *err)
{
    memset(o, 0, sizeof *o);
    o->reference = r;
    o->snapped = s;
    *sound = true;
    il_status st = take_points(o) && note_passes(o, sound) && note_edges(o) ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK && *sound)
        st = triangulate(o, err);
    if (st != IL_OK)
        il_overlay_free(o);
    return st;
}

il_status il_overlay_add_points(il_overlay *o, const double *xy, size_t n, il_error *err)
{
    if (!il_grow(&o->xy, &o->cap_points, 2 * (o->n_points + n), sizeof *o->xy))
        return il_fail_nomem(err);
    memcpy(o->xy + 2 * o->n_points, xy, 2 * n * sizeof *xy);
    o->n_points += n;
    il_status st = il_triangulation_insert(o->triangulation, xy, n, err);
    return st == IL_OK ? read_triangles(o, err) : st;
}

void il_overlay_free(il_overlay *o)
{
    il_free(o->xy);
    il_free(o->pass[0]);
    il_free(o->pass[1]);
    il_free(o->rim);
    il_keymap_free(&o->edge_at);
    il_triangulation_free(o->triangulation);
    il_free(o->corner);
    il_free(o->across);
    il_free(o->inside);
    il_free(o->edge);
    memset(o, 0, sizeof *o);
}

void il_overlay_upper_point(const il_overlay *o, uint32_t p, double out[2])
{
    const il_pass *pass = &o->pass[IL_UPPER][p];
    const il_section *s = o->reference->section[IL_UPPER];
    if (pass->node >= 0) {
        memcpy(out, s->xy + 2 * pass->node, 2 * sizeof *out);
        return;
    }
    const double *a = s->xy + 2 * s->node_at[pass->station], *b = s->xy + 2 * s->node_at[s->next[pass->station]];
    out[0] = a[0] + pass->t * (b[0] - a[0]);
    out[1] = a[1] + pass->t * (b[1] - a[1]);
}
