/* relief.c - the stage of relief.h: a map's lines in, its certified mesh out. */
#include "config.h"
#include "terrain/relief.h"
#include "base/alloc.h"
#include "base/forest.h"
#include "terrain/cliff.h"
#include "terrain/complaint.h"
#include "terrain/crossing.h"
#include "terrain/missing.h"
#include "terrain/proof.h"
#include "terrain/ridge.h"

#include <math.h>
#include <string.h>

/* slice[n]: the levels of the terrain at hand; the head's placement is chosen on the way. */
typedef struct relief {
    il_sink sink;
    il_relief_options options;
    il_mesh_sink *next;
    il_sink *solids;
    il_report *report;
    bool is_terrain;
    il_stack_head head;
    il_slice *slice;         size_t n, cap;
    int32_t stack;
} relief;

/* What is made on the way from the lines to the mesh. */
typedef struct work {
    relief *r;
    il_chart_line *line;     size_t n_lines;
    double *level_z;
    il_frame frame;
    il_chart chart;
    il_tin tin;
    il_border *border;       size_t n_borders;
    il_bands bands;
    il_law law;
    il_skin skin;
    double floor;
} work;

static void free_work(work *w)
{
    il_free(w->line);
    il_free(w->level_z);
    il_frame_free(&w->frame);
    il_chart_free(&w->chart);
    il_tin_free(&w->tin);
    il_free(w->border);
    il_bands_free(&w->bands);
    il_law_free(&w->law);
    il_skin_free(&w->skin);
}

static const il_ring *ring_of(const work *w, size_t l)
{
    return &w->r->slice[w->line[l].level].ring[w->line[l].ring];
}

static il_complaint complaint_of(const work *w)
{
    return (il_complaint){ &w->r->head, w->r->slice, w->line, w->n_lines, w->r->report };
}

/* ---- lines -------------------------------------------------------------------- */

static il_status list_lines(work *w, il_error *err)
{
    relief *r = w->r;
    size_t n = 0;
    for (size_t k = 0; k < r->n; k++)
        n += r->slice[k].n;
    w->line = il_alloc(n, sizeof *w->line);
    w->level_z = il_alloc(r->n, sizeof *w->level_z);
    if (!w->line || !w->level_z)
        return il_fail_nomem(err);
    for (size_t k = 0; k < r->n; k++) {
        w->level_z[k] = r->slice[k].z;
        for (size_t i = 0; i < r->slice[k].n; i++)
            w->line[w->n_lines++] = (il_chart_line){ (int32_t)k, (int32_t)i, false };
    }
    return IL_OK;
}

/* Open lines that end inside the frame part nothing. */
static void leave_out_loose(work *w)
{
    il_complaint c = complaint_of(w);
    size_t e = 0;
    for (size_t l = 0; l < w->n_lines; l++) {
        const il_ring *r = ring_of(w, l);
        const il_frame_end *end = NULL;
        for (; e < w->frame.n_inside && w->frame.inside[e].level == (uint32_t)w->line[l].level &&
               w->frame.inside[e].ring == (uint32_t)w->line[l].ring; e++)
            end = end ? end : &w->frame.inside[e];
        if (!end)
            continue;
        w->line[l].left_out = true;
        il_complaint_left_out(&c, (uint32_t)l, r->xy + (end->last ? 2 * (r->n - 1) : 0), "it ends inside the map");
    }
}

/* A place of the mesh on the map. */
static void put_back(const relief *r, const double from[2], double to[2])
{
    const il_placement *p = &r->head.placement;
    for (int i = 0; i < 2; i++)
        to[i] = r->head.has_placement ? from[i] * p->scale[i] + p->offset[i] : from[i];
}

/* ---- faces and their bands ------------------------------------------------------ */

static void forget_chart(work *w)
{
    il_chart_free(&w->chart);
    il_tin_free(&w->tin);
}

/* The chart as a planar graph, in triangles. */
static il_status triangulate(work *w, il_error *err)
{
    bool crosses = false;
    il_tin_free(&w->tin);
    il_status st = il_tin_build(&w->tin, &w->chart, &crosses, err);
    if (st != IL_OK || !crosses)
        return st;
    st = il_chart_divide(&w->chart, w->r->options.placement.round_float, err);
    if (st == IL_OK)
        st = il_tin_build(&w->tin, &w->chart, &crosses, err);
    return st == IL_OK && crosses ? il_fail(err, IL_E_INTERNAL, 0, "a map's lines cross though they were divided") : st;
}

static il_status draw_chart(work *w, il_error *err)
{
    relief *r = w->r;
    forget_chart(w);
    w->chart.level_z = w->level_z;
    w->chart.n_levels = r->n;
    il_status st = il_chart_build(&w->chart, r->slice, w->line, w->n_lines, &w->frame, &r->head, &r->options.placement, err);
    return st == IL_OK ? triangulate(w, err) : st;
}

static il_status label(work *w, size_t n_lines, il_error *err)
{
    il_free(w->border);
    il_bands_free(&w->bands);
    size_t n_faces = 0;
    il_status st = il_tin_borders(&w->tin, &w->chart, &w->border, &w->n_borders, &n_faces, err);
    if (st == IL_OK)
        st = il_bands_label(&w->bands, w->border, w->n_borders, n_faces, n_lines, w->r->n, w->r->options.high, err);
    if (st == IL_OK && w->tin.n_cliffs > 0)
        st = il_cliff_label(&w->tin, &w->chart, w->bands.band, err);
    return st;
}

static void tell_discord(work *w, const il_discord *d)
{
    il_complaint c = complaint_of(w);
    double at[2];
    put_back(w->r, d->at, at);
    if (d->kind == IL_DISCORD_SIDES)
        il_complaint_against(&c, d->line[0], at, d->is_below ? "both of its sides lie below it" : "both of its sides lie above it", d->line[1]);
    else
        il_complaint_missing(&c, d->line[0], d->line[1], at);
}

/* The bands of all faces; lines that contradict the others are left out, and what the rest
 * parts is looked at anew. */
static il_status find_bands(work *w, il_error *err)
{
    il_status st = IL_OK;
    do {
        st = draw_chart(w, err);
        if (st == IL_OK)
            st = label(w, w->n_lines, err);
        for (size_t k = 0; k < w->bands.n_discords && st == IL_OK; k++)
            if (w->bands.n_left_out == 0 || w->bands.discord[k].kind == IL_DISCORD_SIDES)
                tell_discord(w, &w->bands.discord[k]);
        for (size_t l = 0; l < w->n_lines && st == IL_OK && w->bands.n_left_out > 0; l++)
            w->line[l].left_out |= w->bands.left_out[l];
    } while (st == IL_OK && w->bands.n_left_out > 0);
    return st;
}

/* ---- heights --------------------------------------------------------------------- */

static il_status build_law(work *w, il_error *err)
{
    il_law_free(&w->law);
    return il_law_build(&w->law, &w->tin, &w->chart, w->bands.band, err);
}

static il_status draw_missing(work *w, il_error *err)
{
    size_t n = 0;
    il_status st = il_missing_draw(&w->chart, &w->tin, &w->law, w->n_lines, &w->r->options.placement, &n, err);
    if (st != IL_OK || n == 0)
        return st;
    il_report_repair(w->r->report, IL_REPAIR_MISSING_LINE, n);
    st = triangulate(w, err);
    if (st == IL_OK)
        st = label(w, w->n_lines + w->r->n, err);
    return st == IL_OK ? build_law(w, err) : st;
}

/* Of the nodes that still have none, which are the frame's. */
static void raise_rest(work *w)
{
    il_chart *c = &w->chart;
    for (size_t k = 0; k < 3 * w->tin.n; k++) {
        uint32_t v = w->tin.corner[k], f = w->tin.face[k / 3];
        if (f != IL_CHART_NONE && isnan(c->node[v].z))
            c->node[v].z = il_law_height(&w->law, f, c->xy[2 * (size_t)v], c->xy[2 * (size_t)v + 1]);
    }
}

static il_status find_heights(work *w, il_error *err)
{
    il_status st = build_law(w, err);
    if (st == IL_OK)
        st = draw_missing(w, err);
    if (st == IL_OK)
        st = il_ridge_insert(&w->tin, &w->chart, &w->law, &w->r->options.placement, err);
    if (st == IL_OK)
        raise_rest(w);
    return st;
}

/* ---- the mesh -------------------------------------------------------------------- */

static il_status settle_heights(work *w, il_error *err)
{
    double lowest = INFINITY, highest = -INFINITY, floor = 0;
    relief *r = w->r;
    for (size_t k = 0; k < 3 * w->tin.n; k++) {
        if (w->tin.face[k / 3] == IL_CHART_NONE)
            continue;
        double z = il_cliff_z(&w->tin, &w->chart, w->bands.band, k);
        lowest = fmin(lowest, z);
        highest = fmax(highest, z);
    }
    il_status st = il_placement_settle(&r->head, &r->options.placement, w->frame.box, lowest, highest, &floor, err);
    w->floor = r->options.placement.solid ? il_placement_height(&r->head, &r->options.placement, floor) : NAN;
    return st;
}

static il_status make_mesh(work *w, il_error *err)
{
    relief *r = w->r;
    il_status st = settle_heights(w, err);
    if (st == IL_OK)
        st = il_skin_lay(&w->skin, &w->tin, &w->chart, w->bands.band, &r->head, &r->options.placement, err);
    if (st == IL_OK && r->options.placement.solid)
        st = il_skin_close(&w->skin, &w->tin, &w->chart, w->floor, err);
    if (st == IL_OK && w->skin.n_surface == 0)
        st = il_fail(err, IL_E_INPUT, r->head.line, "no line of the map lies inside the frame");
    return st == IL_OK ? il_skin_prove(&w->skin, &w->tin, &w->chart, &r->head, &r->options.placement, w->floor, err) : st;
}

/* ---- handing on --------------------------------------------------------------------- */

static double corner6(const il_skin *s, size_t t, double *area)
{
    const double *p = s->xyz + 3 * (size_t)s->tri[3 * t], *q = s->xyz + 3 * (size_t)s->tri[3 * t + 1];
    const double *r = s->xyz + 3 * (size_t)s->tri[3 * t + 2], *o = s->xyz;
    double a[3], b[3], d[3];
    for (int i = 0; i < 3; i++)
        a[i] = q[i] - p[i], b[i] = r[i] - p[i], d[i] = p[i] - o[i];
    double n[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
    *area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    return n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
}

/* Pieces of the surface hang together over edges; solids are closed (Euler). */
static il_status gather_facts(const work *w, il_mesh_facts *f, il_error *err)
{
    const il_skin *s = &w->skin;
    double volume6 = 0;
    uint32_t *up = il_alloc(s->n_vertices, sizeof *up);
    if (!up)
        return il_fail_nomem(err);
    il_forest_plant(up, s->n_vertices);
    for (size_t t = 0; t < s->n_triangles; t++) {
        il_forest_join(up, s->tri[3 * t], s->tri[3 * t + 1]);
        il_forest_join(up, s->tri[3 * t], s->tri[3 * t + 2]);
        volume6 += corner6(s, t, &f->area);
    }
    for (size_t v = 0; v < s->n_vertices; v++)
        f->components += up[v] == v;
    il_free(up);
    f->vertices = s->n_vertices;
    f->triangles = s->n_triangles;
    f->is_open = isnan(w->floor);
    f->faces = w->tin.n_faces;
    f->slices = w->r->n;
    f->rings = w->n_lines;
    for (size_t k = 0; k < w->r->n; k++)
        f->points += il_slice_points(&w->r->slice[k]);
    if (!f->is_open) {
        f->volume = volume6 / 6;
        f->genus = (2 * f->components - ((long)s->n_vertices - (long)(s->n_triangles / 2))) / 2;
    }
    return IL_OK;
}

static il_origin origin_of(const work *w, size_t v)
{
    const il_chart_node *n = &w->chart.node[w->skin.node[v]];
    int32_t level = w->skin.level[v];
    if (n->vertex < 0 || level != n->slice)
        return (il_origin){ w->r->stack, level, -1, -1 };
    return (il_origin){ w->r->stack, n->slice, n->ring, n->vertex };
}

/* All vertices, then the triangles slab by slab. */
static il_status hand_on(work *w, il_error *err)
{
    il_mesh_sink *next = w->r->next;
    il_mesh_facts facts = { 0 };
    il_mesh m = IL_MESH_INIT;
    const il_skin *s = &w->skin;
    bool ok = true;
    il_status st = gather_facts(w, &facts, err);
    if (st == IL_OK)
        st = next->begin(next, &w->r->head, err);
    for (size_t v = 0; v < s->n_vertices && ok; v++)
        ok = il_mesh_add_vertex(&m, s->xyz + 3 * v, origin_of(w, v));
    for (int32_t slab = -1; slab < (int32_t)w->r->n && st == IL_OK && ok; slab++) {
        m.slab = slab;
        for (size_t t = 0; t < s->n_triangles && ok; t++)
            ok = s->slab[t] != slab || il_mesh_add_triangle(&m, s->tri[3 * t], s->tri[3 * t + 1], s->tri[3 * t + 2]);
        st = ok ? next->piece(next, &m, err) : st;
        m.n_vertices = m.n_triangles = 0;
    }
    il_mesh_free(&m);
    st = st == IL_OK && !ok ? il_fail_nomem(err) : st;
    return st == IL_OK ? next->end(next, &facts, err) : st;
}

/* longest[v]: of the lines through node V, where several levels meet, the longest. */
static void find_longest(const work *w, uint32_t *longest)
{
    const il_chart *c = &w->chart;
    for (size_t v = 0; v < c->n_nodes; v++)
        longest[v] = IL_CHART_NONE;
    for (size_t k = 0; k < 2 * c->n_edges; k++) {
        uint32_t v = c->edge[k], l = c->owner[k / 2];
        if (c->node[v].level == c->node[v].top || l >= w->n_lines)
            continue;
        if (longest[v] == IL_CHART_NONE || il_ring_length(ring_of(w, l)) > il_ring_length(ring_of(w, longest[v])))
            longest[v] = l;
    }
}

/* Lines that run together with others so that no ground can stand there: of those that meet,
 * the longest stays. */
static il_status leave_out_meeting(work *w, il_error *err)
{
    const il_chart *c = &w->chart;
    il_complaint complaint = complaint_of(w);
    uint32_t *longest = il_alloc(c->n_nodes, sizeof *longest);
    if (!longest)
        return il_fail_nomem(err);
    find_longest(w, longest);
    for (size_t k = 0; k < 2 * c->n_edges; k++) {
        uint32_t v = c->edge[k], l = c->owner[k / 2], other = longest[v];
        double at[2];
        if (other == IL_CHART_NONE || l >= w->n_lines || w->line[l].left_out || w->line[l].level == w->line[other].level)
            continue;
        put_back(w->r, c->xy + 2 * (size_t)v, at);
        w->line[l].left_out = true;
        il_complaint_against(&complaint, l, at, "it meets another level", other);
    }
    il_free(longest);
    return IL_OK;
}

/* From the lines that are not left out to a mesh that is proved. */
static il_status make_ground(work *w, il_error *err)
{
    il_status st = find_bands(w, err);
    if (st == IL_OK)
        st = find_heights(w, err);
    return st == IL_OK ? make_mesh(w, err) : st;
}

static il_status build(relief *r, il_error *err)
{
    work w = { .r = r, .floor = NAN };
    il_status st = list_lines(&w, err);
    if (st == IL_OK && w.n_lines == 0)
        st = il_fail(err, IL_E_INPUT, r->head.line, "stack \"%.60s\" has no isolines", il_stack_head_name(&r->head));
    if (st == IL_OK)
        st = il_frame_make(&w.frame, &r->options.frame, &r->head, r->slice, r->n, err);
    if (w.frame.took_degrees)
        il_report_note(r->report, "the outline's numbers are taken as degrees: the map was in degrees there, and has no lines "
                       "where they would lie as lengths");
    if (st == IL_OK)
        st = il_placement_choose(&r->head, &r->options.placement, w.frame.box, err);
    if (st == IL_OK) {
        leave_out_loose(&w);
        st = make_ground(&w, err);
    }
    if (st == IL_E_SURFACE && w.tin.n_cliffs > 0) {
        il_error_clear(err);
        st = leave_out_meeting(&w, err);
        il_skin_free(&w.skin);
        st = st == IL_OK ? make_ground(&w, err) : st;
    }
    if (st == IL_OK && w.skin.n_cliff > 0)
        il_report_note(r->report, "isolines of different heights run together: %zu triangles stand upright", w.skin.n_cliff);
    if (st == IL_OK)
        st = hand_on(&w, err);
    free_work(&w);
    return st;
}

/* ---- the sink -------------------------------------------------------------------------- */

static void forget_slices(relief *r)
{
    for (size_t k = 0; k < r->n; k++)
        il_slice_free(&r->slice[k]);
    r->n = 0;
}

static il_status stack_begin(il_sink *self, const il_stack_head *head, il_error *err)
{
    relief *r = (relief *)self;
    forget_slices(r);
    r->is_terrain = head->kind == IL_KIND_TERRAIN;
    if (!r->is_terrain && !r->solids)
        return il_fail(err, IL_E_INPUT, head->line, "stack \"%.60s\" is no terrain", il_stack_head_name(head));
    r->stack++;
    if (!r->is_terrain)
        return r->solids->stack_begin(r->solids, head, err);
    il_stack_head_free(&r->head);
    il_status st = il_stack_head_refuse_fault(head, err);
    return st == IL_OK ? il_stack_head_copy(&r->head, head, err) : st;
}

static il_status slice(il_sink *self, il_slice *s, il_error *err)
{
    relief *r = (relief *)self;
    if (!r->is_terrain)
        return r->solids->slice(r->solids, s, err);
    if (!il_grow(&r->slice, &r->cap, r->n + 1, sizeof *r->slice))
        return il_fail_nomem(err);
    r->slice[r->n++] = *s;
    *s = (il_slice)IL_SLICE_INIT;
    return IL_OK;
}

/* Nothing that joins the levels of a map is needed here. */
static il_status pair(il_sink *self, il_pair *p, il_error *err)
{
    relief *r = (relief *)self;
    return r->is_terrain ? IL_OK : r->solids->pair(r->solids, p, err);
}

static il_status stack_end(il_sink *self, il_error *err)
{
    relief *r = (relief *)self;
    if (!r->is_terrain)
        return r->solids->stack_end(r->solids, err);
    il_status st = build(r, err);
    forget_slices(r);
    return st;
}

static il_status end(il_sink *self, il_error *err)
{
    relief *r = (relief *)self;
    return r->solids ? r->solids->end(r->solids, err) : r->next->finish(r->next, err);
}

il_status il_relief_new(il_sink **out, const il_relief_options *o, il_mesh_sink *next, il_sink *solids,
                        il_report *report, il_error *err)
{
    relief *r = il_calloc(1, sizeof *r);
    *out = r ? &r->sink : NULL;
    if (!r)
        return il_fail_nomem(err);
    *r = (relief){ .sink = { stack_begin, slice, pair, stack_end, end }, .options = *o, .next = next, .solids = solids,
                   .report = report, .stack = -1 };
    return IL_OK;
}

const int32_t *il_relief_stack(const il_sink *s)
{
    return &((const relief *)s)->stack;
}

void il_relief_free(il_sink *s)
{
    relief *r = (relief *)s;
    if (!r)
        return;
    forget_slices(r);
    il_free(r->slice);
    il_stack_head_free(&r->head);
    il_free(r);
}
