#include "config.h"
#include "api/solids.h"
#include "base/alloc.h"
#include "output/mesh-settle.h"

#include <string.h>

static void free_solid(il_solid *s)
{
    il_free(s->name);
    il_free(s->xyz);
    il_free(s->contour_vertex);
    il_free(s->triangle);
    *s = (il_solid){ 0 };
}

void il_solids_free(il_solids *s)
{
    for (size_t i = 0; i < s->n; i++)
        free_solid(&s->solid[i]);
    il_free(s->solid);
    *s = (il_solids)IL_SOLIDS_INIT;
}

static void drop_open(il_mesh_sink *self)
{
    il_solids_sink *s = (il_solids_sink *)self;
    free_solid(&s->open);
    s->cap_vertices = s->cap_contour_vertices = s->cap_triangles = 0;
}

static il_status begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    il_solids_sink *s = (il_solids_sink *)self;
    const char *name = il_stack_head_name(head);
    drop_open(self);
    il_stack_head_free(&s->head);
    s->open.name = il_strndup(name, strlen(name));
    return s->open.name ? il_stack_head_copy(&s->head, head, err) : il_fail_nomem(err);
}

static il_status piece(il_mesh_sink *self, const il_mesh *m, il_error *err)
{
    il_solids_sink *s = (il_solids_sink *)self;
    il_solid *o = &s->open;
    if (!il_grow(&o->xyz, &s->cap_vertices, o->n_vertices + m->n_vertices, 3 * sizeof *o->xyz) ||
        !il_grow(&o->contour_vertex, &s->cap_contour_vertices, o->n_vertices + m->n_vertices, 1) ||
        !il_grow(&o->triangle, &s->cap_triangles, o->n_triangles + m->n_triangles, 3 * sizeof *o->triangle))
        return il_fail_nomem(err);
    if (m->n_vertices > 0)
        memcpy(o->xyz + 3 * o->n_vertices, m->xyz, m->n_vertices * 3 * sizeof *o->xyz);
    for (size_t i = 0; i < m->n_vertices; i++)
        o->contour_vertex[o->n_vertices + i] = m->origin[i].vertex >= 0;
    bool mirrors = il_stack_head_mirrors(&s->head);
    for (size_t i = 0; i < m->n_triangles; i++) {
        uint32_t *to = o->triangle + 3 * (o->n_triangles + i);
        memcpy(to, m->tri + 3 * i, 3 * sizeof *to);
        if (mirrors)
            to[1] = m->tri[3 * i + 2], to[2] = m->tri[3 * i + 1];
    }
    o->n_vertices += m->n_vertices;
    o->n_triangles += m->n_triangles;
    return IL_OK;
}

/* The open solid in world coordinates, and still sound there. */
static il_status place(il_solids_sink *s, il_error *err)
{
    il_solid *o = &s->open;
    double *to = il_alloc(o->n_vertices, 3 * sizeof *to);
    il_status st = to ? IL_OK : il_fail_nomem(err);
    size_t where = 0;
    for (size_t i = 0; st == IL_OK && i < o->n_vertices; i++)
        il_stack_head_place(&s->head, o->xyz + 3 * i, to + 3 * i);
    if (st == IL_OK && s->head.has_frame && !il_frame_is_exact(s->head.frame)) {
        il_error why = IL_ERROR_INIT;
        st = il_mesh_settle(o->xyz, to, o->n_vertices, o->triangle, o->n_triangles, false, &where, &why);
        if (st != IL_OK)
            il_fail(err, st, s->head.line, "stack '%.80s': %s", il_stack_head_name(&s->head), why.text);
    }
    il_free(st == IL_OK ? o->xyz : to);
    if (st == IL_OK)
        o->xyz = to;
    return st;
}

static il_status end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    il_solids_sink *s = (il_solids_sink *)self;
    il_status st = place(s, err);
    if (st != IL_OK)
        return st;
    if (!il_grow(&s->list->solid, &s->cap, s->list->n + 1, sizeof *s->list->solid))
        return il_fail_nomem(err);
    s->open.components = facts->components;
    s->open.genus = facts->genus;
    s->open.volume = facts->volume;
    s->open.area = facts->area;
    s->open.is_open = facts->is_open;
    const il_placement as_is = { { 0, 0, 0 }, { 1, 1, 1 }, IL_UNIT_MM };
    const il_placement *p = s->head.has_placement ? &s->head.placement : &as_is;
    memcpy(s->open.offset, p->offset, sizeof p->offset);
    memcpy(s->open.scale, p->scale, sizeof p->scale);
    s->list->solid[s->list->n++] = s->open;
    s->open = (il_solid){ 0 };
    drop_open(self);
    return IL_OK;
}

static il_status finish(il_mesh_sink *self, il_error *err)
{
    (void)self;
    (void)err;
    return IL_OK;
}

void il_solids_sink_init(il_solids_sink *s, il_solids *list)
{
    *s = (il_solids_sink){ .sink = { begin, piece, end, drop_open, finish }, .list = list };
}

void il_solids_sink_free(il_solids_sink *s)
{
    drop_open(&s->sink);
    il_stack_head_free(&s->head);
}
