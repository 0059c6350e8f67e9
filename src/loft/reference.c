#include "config.h"
#include "loft/reference.h"
#include "base/alloc.h"

#include <math.h>
#include <stdlib.h>

/* ---- as they lie ---- */

static bool build_side(il_ref_side *side, const il_section *s)
{
    side->vertex = il_alloc(s->n_stations, sizeof *side->vertex);
    side->next = il_alloc(s->n_stations, sizeof *side->next);
    if (!side->vertex || !side->next)
        return false;
    for (uint32_t i = 0; i < s->n_stations; i++) {
        const double *xy = s->xy + 2 * s->node_at[i];
        side->vertex[i] = (il_ref_vertex){ xy[0], xy[1], i, 0, { xy[0], xy[1] }, false };
        side->next[i] = s->next[i];
    }
    side->n = s->n_stations;
    return true;
}

il_status il_reference_build(il_reference *r, const il_section *lower, const il_section *upper, il_error *err)
{
    *r = (il_reference){ .section = { lower, upper } };
    if (build_side(&r->side[IL_LOWER], lower) && build_side(&r->side[IL_UPPER], upper))
        return IL_OK;
    il_reference_free(r);
    return il_fail_nomem(err);
}

void il_reference_free(il_reference *r)
{
    for (int k = 0; k < 2; k++) {
        il_free(r->side[k].vertex);
        il_free(r->side[k].next);
        r->side[k] = (il_ref_side){ 0 };
    }
}

/* ---- deformed ---- */

/* What a vertex comes from; of several at one place the least stays. */
typedef enum source { SEAM, STATION, BEND } source;

typedef struct item {
    il_ref_vertex v;
    source from;
} item;

typedef struct gathering {
    item *list; size_t n, cap;
} gathering;

static bool add(gathering *g, double x, double y, uint32_t station, double t, source from)
{
    if (!il_grow(&g->list, &g->cap, g->n + 1, sizeof *g->list))
        return false;
    g->list[g->n++] = (item){ { x, y, station, t, { x, y }, false }, from };
    return true;
}

static bool add_lower(gathering *g, const il_section *s)
{
    for (uint32_t i = 0; i < s->n_stations; i++) {
        const double *xy = s->xy + 2 * s->node_at[i];
        if (!add(g, xy[0], xy[1], i, 0, STATION))
            return false;
    }
    return true;
}

static bool add_upper(gathering *g, const il_section *s, const il_phi *phi)
{
    const il_phi_point *row = phi->pair->phi;
    for (uint32_t i = 0; i < s->n_stations; i++) {
        il_place at = { s->ring_at[i], s->vertex_at[i], s->t_at[i] };
        double xy[2], end = il_section_end_t(s, i);
        il_phi_at(phi, at, xy);
        if (!add(g, xy[0], xy[1], i, 0, STATION))
            return false;
        for (size_t k = il_phi_row_after(phi, at);
             k < phi->first[at.ring + 1] && row[k].at.vertex == at.vertex && row[k].at.t < end; k++)
            if (!add(g, row[k].x, row[k].y, i, (row[k].at.t - at.t) / (end - at.t), BEND))
                return false;
    }
    return true;
}

static bool add_seam(gathering *g, const il_seam *s, int side)
{
    for (size_t i = 0; i < s->n; i++) {
        const il_seam_vertex *v = &s->v[i];
        if (!add(g, v->xy[0], v->xy[1], v->station[side], v->t[side], SEAM))
            return false;
        il_ref_vertex *last = &g->list[g->n - 1].v;
        last->at[0] = v->at[side][0], last->at[1] = v->at[side][1];
        last->matched = i + 1 < s->n;
    }
    return true;
}

static int compare_items(const void *p, const void *q)
{
    const item *a = p, *b = q;
    if (a->v.station != b->v.station)
        return a->v.station < b->v.station ? -1 : 1;
    if (a->v.t != b->v.t)
        return a->v.t < b->v.t ? -1 : 1;
    if (a->from != b->from)
        return a->from < b->from ? -1 : 1;
    return (int)b->v.matched - (int)a->v.matched; /* where one seam ends and the next begins */
}

static double distance(const il_ref_vertex *a, const il_ref_vertex *b)
{
    return fmax(fabs(a->x - b->x), fabs(a->y - b->y));
}

/* Does item I stay behind the vertices V[N] of its side?  Not what is there
 * already, not bends of a matched edge or next to a neighbour. */
static bool stays(const gathering *g, size_t i, const il_ref_vertex *v, size_t n, double near)
{
    const item *it = &g->list[i];
    const il_ref_vertex *before = n > 0 ? &v[n - 1] : NULL;
    if (before && before->station == it->v.station && before->t == it->v.t)
        return false;
    if (it->from != BEND)
        return true;
    if (!before || before->matched || distance(before, &it->v) < near)
        return false;
    return i + 1 == g->n || g->list[i + 1].v.station != it->v.station || distance(&g->list[i + 1].v, &it->v) >= near;
}

/* The vertices of SIDE in order from what was gathered. */
static bool fill_side(il_ref_side *side, const il_section *s, gathering *g, double near)
{
    if (g->n > 0)
        qsort(g->list, g->n, sizeof *g->list, compare_items);
    side->vertex = il_alloc(g->n, sizeof *side->vertex);
    side->next = il_alloc(g->n, sizeof *side->next);
    if (!side->vertex || !side->next)
        return false;
    for (size_t i = 0; i < g->n; i++)
        if (stays(g, i, side->vertex, side->n, near))
            side->vertex[side->n++] = g->list[i].v;
    for (uint32_t i = 0, first = 0; i < side->n; i++) {
        uint32_t ring = s->ring_at[side->vertex[i].station];
        bool last = i + 1 == side->n || s->ring_at[side->vertex[i + 1].station] != ring;
        side->next[i] = last ? first : i + 1;
        if (last)
            first = i + 1;
    }
    return true;
}

static bool gather(il_reference *r, const il_phi *phi, const il_seam *seam, size_t n, double near)
{
    bool ok = true;
    for (int k = 0; ok && k < 2; k++) {
        gathering g = { NULL, 0, 0 };
        ok = k == IL_LOWER ? add_lower(&g, r->section[k]) : add_upper(&g, r->section[k], phi);
        for (size_t i = 0; ok && i < n; i++)
            ok = add_seam(&g, &seam[i], k);
        ok = ok && fill_side(&r->side[k], r->section[k], &g, near);
        il_free(g.list);
    }
    return ok;
}

il_status il_reference_deform(il_reference *r, const il_section *lower, const il_section *upper, const il_phi *phi,
                              const il_seam *seam, size_t n, double near, il_error *err)
{
    *r = (il_reference){ .section = { lower, upper }, .deformed = true };
    if (gather(r, phi, seam, n, near))
        return IL_OK;
    il_reference_free(r);
    return il_fail_nomem(err);
}
