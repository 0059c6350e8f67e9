#include "config.h"
#include "api/solids.h"
#include "base/alloc.h"

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
    s->open.name = il_strndup(name, strlen(name));
    return s->open.name ? IL_OK : il_fail_nomem(err);
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
    if (m->n_triangles > 0)
        memcpy(o->triangle + 3 * o->n_triangles, m->tri, m->n_triangles * 3 * sizeof *o->triangle);
    o->n_vertices += m->n_vertices;
    o->n_triangles += m->n_triangles;
    return IL_OK;
}

static il_status end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    il_solids_sink *s = (il_solids_sink *)self;
    if (!il_grow(&s->list->solid, &s->cap, s->list->n + 1, sizeof *s->list->solid))
        return il_fail_nomem(err);
    s->open.components = facts->components;
    s->open.genus = facts->genus;
    s->open.volume = facts->volume;
    s->open.area = facts->area;
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
}
