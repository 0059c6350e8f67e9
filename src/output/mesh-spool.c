/* mesh-spool.c - the sink: pieces in, records into spools. */
#include "config.h"
#include "output/mesh-spool.h"
#include "base/alloc.h"
#include "base/number.h"
#include "output/mesh-settle.h"

#include <math.h>
#include <string.h>

uint64_t il_mesh_spool_n_vertices(const il_mesh_spool *m)
{
    if (m->n_stacks == 0)
        return 0;
    const il_spooled_stack *s = &m->stack[m->n_stacks - 1];
    return s->first_vertex + s->n_vertices;
}

uint64_t il_mesh_spool_n_triangles(const il_mesh_spool *m)
{
    if (m->n_stacks == 0)
        return 0;
    const il_spooled_stack *s = &m->stack[m->n_stacks - 1];
    return s->first_triangle + s->n_triangles;
}

static il_status begin(il_mesh_sink *self, const il_stack_head *head, il_error *err)
{
    il_mesh_spool *m = (il_mesh_spool *)self;
    if (m->open)
        return il_fail(err, IL_E_INTERNAL, 0, "a stack's mesh begins inside another");
    il_spooled_stack s = { .first_vertex = il_mesh_spool_n_vertices(m),
                           .first_triangle = il_mesh_spool_n_triangles(m) };
    if (!il_grow(&m->stack, &m->cap_stacks, m->n_stacks + 1, sizeof *m->stack))
        return il_fail_nomem(err);
    il_status st = il_stack_head_copy(&s.head, head, err);
    if (st != IL_OK)
        return st;
    s.left_handed = il_stack_head_mirrors(head);
    s.rounds = head->has_frame && !il_frame_is_exact(head->frame);
    s.index = m->n_begun;
    m->n_begun += m->n_begun < INT32_MAX;
    m->stack[m->n_stacks++] = s;
    m->open = true;
    return IL_OK;
}

static il_status spool_vertices(il_mesh_spool *m, il_spooled_stack *s, const il_mesh *piece, il_error *err)
{
    for (size_t i = 0; i < piece->n_vertices; i++) {
        il_spooled_vertex v;
        memset(&v, 0, sizeof v);
        il_stack_head_place(&s->head, piece->xyz + 3 * i, v.xyz);
        v.origin = piece->origin[i];
        if (!isfinite(v.xyz[0]) || !isfinite(v.xyz[1]) || !isfinite(v.xyz[2]))
            return il_fail(err, IL_E_INPUT, s->head.line, "the frame of stack '%.80s' takes points beyond all numbers",
                           il_stack_head_name(&s->head));
        if (!s->index_known && v.origin.stack >= 0) {
            s->index = v.origin.stack;
            s->index_known = true;
        }
        if (s->rounds)
            memcpy(v.xyz, piece->xyz + 3 * i, sizeof v.xyz);
        il_output_write(m->vertices, &v, sizeof v);
    }
    s->n_vertices += piece->n_vertices;
    return IL_OK;
}

static il_status spool_triangles(il_mesh_spool *m, il_spooled_stack *s, const il_mesh *piece, il_error *err)
{
    for (size_t i = 0; i < piece->n_triangles; i++) {
        const uint32_t *v = piece->tri + 3 * i;
        if (v[0] >= s->n_vertices || v[1] >= s->n_vertices || v[2] >= s->n_vertices)
            return il_fail(err, IL_E_INTERNAL, 0, "a triangle of stack '%.80s' has a vertex that was never given",
                           il_stack_head_name(&s->head));
        il_spooled_triangle t = { { v[0], v[1], v[2] }, piece->slab };
        if (s->left_handed)
            t.v[1] = v[2], t.v[2] = v[1];
        il_output_write(m->triangles, &t, sizeof t);
    }
    s->n_triangles += piece->n_triangles;
    return IL_OK;
}

static il_status spool_status(const il_mesh_spool *m, il_error *err)
{
    il_status st = il_output_status(m->vertices, err);
    return st == IL_OK ? il_output_status(m->triangles, err) : st;
}

static il_status piece(il_mesh_sink *self, const il_mesh *p, il_error *err)
{
    il_mesh_spool *m = (il_mesh_spool *)self;
    if (!m->open)
        return il_fail(err, IL_E_INTERNAL, 0, "a piece of mesh belongs to no stack");
    il_spooled_stack *s = &m->stack[m->n_stacks - 1];
    il_status st = spool_vertices(m, s, p, err);
    if (st == IL_OK)
        st = spool_triangles(m, s, p, err);
    return st == IL_OK ? spool_status(m, err) : st;
}

/* A spool that cannot be shortened keeps its failure, and `finish` tells it. */
static void abandon(il_mesh_sink *self)
{
    il_mesh_spool *m = (il_mesh_spool *)self;
    if (!m->open)
        return;
    m->open = false;
    il_spooled_stack *s = &m->stack[--m->n_stacks];
    il_output_rewind(m->vertices, s->first_vertex * sizeof(il_spooled_vertex), NULL);
    il_output_rewind(m->triangles, s->first_triangle * sizeof(il_spooled_triangle), NULL);
    il_stack_head_free(&s->head);
}

/* ---- the end of a stack whose frame rounds ------------------------------------ */

/* vertex[n], xyz[3*n], tri[3*n_tri]: of the stack, as far as they are gathered;
 * to[3*n]: the vertices placed by its frame. */
typedef struct settler {
    const il_stack_head *head;
    il_spooled_vertex *vertex;
    double *xyz, *to;
    uint32_t *tri;
    size_t n, n_tri;
} settler;

static il_status gather_vertex(void *self, const il_spooled_vertex *v, il_error *err)
{
    (void)err;
    settler *s = self;
    s->vertex[s->n] = *v;
    memcpy(s->xyz + 3 * s->n, v->xyz, sizeof v->xyz);
    il_stack_head_place(s->head, v->xyz, s->to + 3 * s->n++);
    return IL_OK;
}

static il_status gather_triangle(void *self, const il_spooled_triangle *t, il_error *err)
{
    (void)err;
    settler *s = self;
    memcpy(s->tri + 3 * s->n_tri++, t->v, sizeof t->v);
    return IL_OK;
}

static il_status fail_unsettled(const settler *s, size_t at, const il_error *why, il_error *err)
{
    char where[3][IL_NUMBER_MAX];
    for (size_t i = 0; i < 3; i++)
        il_number_format(where[i], s->to[3 * at + i]);
    return il_fail(err, why->code, s->head->line, "stack '%.80s' near (%s, %s, %s): %s", il_stack_head_name(s->head),
                   where[0], where[1], where[2], why->text);
}

static void put_back(il_mesh_spool *m, const il_spooled_stack *stack, const settler *s)
{
    il_output_rewind(m->vertices, stack->first_vertex * sizeof(il_spooled_vertex), NULL);
    for (size_t i = 0; i < s->n; i++) {
        for (size_t k = 0; k < 3; k++)
            s->vertex[i].xyz[k] = s->to[3 * i + k] + 0.0; /* no -0, as in place */
        il_output_write(m->vertices, &s->vertex[i], sizeof s->vertex[i]);
    }
}

static il_status settle_stack(il_mesh_spool *m, size_t k, il_error *err)
{
    const il_spooled_stack *stack = &m->stack[k];
    size_t nv = (size_t)stack->n_vertices, nt = (size_t)stack->n_triangles, at = 0;
    il_error why = IL_ERROR_INIT;
    settler s = { .head = &stack->head, .vertex = il_alloc(nv, sizeof *s.vertex), .xyz = il_alloc(nv, 3 * sizeof *s.xyz),
                  .to = il_alloc(nv, 3 * sizeof *s.to), .tri = il_alloc(nt, 3 * sizeof *s.tri) };
    il_status st = s.vertex && s.xyz && s.to && s.tri ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK)
        st = il_mesh_spool_each_vertex(m, k, &s, gather_vertex, err);
    if (st == IL_OK)
        st = il_mesh_spool_each_triangle(m, k, &s, gather_triangle, err);
    if (st == IL_OK) {
        st = il_mesh_settle(s.xyz, s.to, nv, s.tri, nt, m->floats, &at, &why);
        if (st == IL_OK)
            put_back(m, stack, &s);
        else if (st == IL_E_SURFACE || st == IL_E_INPUT)
            fail_unsettled(&s, at, &why, err);
        else
            il_fail(err, st, 0, "%s", why.text);
    }
    il_free(s.vertex);
    il_free(s.xyz);
    il_free(s.to);
    il_free(s.tri);
    return st;
}

static il_status end(il_mesh_sink *self, const il_mesh_facts *facts, il_error *err)
{
    (void)facts;
    il_mesh_spool *m = (il_mesh_spool *)self;
    if (!m->open)
        return il_fail(err, IL_E_INTERNAL, 0, "a stack's mesh ends that never began");
    il_status st = spool_status(m, err);
    if (st == IL_OK && m->stack[m->n_stacks - 1].rounds)
        st = settle_stack(m, m->n_stacks - 1, err);
    if (st != IL_OK) {
        abandon(self);
        return st;
    }
    m->open = false;
    return spool_status(m, err);
}

/* ---- the end of all ------------------------------------------------------------- */

static il_status finish(il_mesh_sink *self, il_error *err)
{
    il_mesh_spool *m = (il_mesh_spool *)self;
    if (m->open)
        return il_fail(err, IL_E_INTERNAL, 0, "the mesh ends inside a stack");
    il_status st = spool_status(m, err);
    if (st == IL_OK)
        st = m->write(m, m->to, &m->options, err);
    return st == IL_OK ? il_output_status(m->to, err) : st;
}

il_status il_mesh_spool_new(il_mesh_sink **out, il_output *to, const il_write_options *o,
                            bool floats, il_mesh_format write, il_error *err)
{
    *out = NULL;
    il_mesh_spool *m = il_calloc(1, sizeof *m);
    if (!m)
        return il_fail_nomem(err);
    m->sink = (il_mesh_sink){ begin, piece, end, abandon, finish };
    m->to = to;
    if (o)
        m->options = *o;
    m->floats = floats;
    m->write = write;
    il_status st = il_output_spool(&m->vertices, err);
    if (st == IL_OK)
        st = il_output_spool(&m->triangles, err);
    if (st == IL_OK)
        *out = &m->sink;
    else
        il_mesh_spool_free(&m->sink);
    return st;
}

void il_mesh_spool_free(il_mesh_sink *s)
{
    if (!s)
        return;
    il_mesh_spool *m = (il_mesh_spool *)s;
    for (size_t i = 0; i < m->n_stacks; i++)
        il_stack_head_free(&m->stack[i].head);
    il_free(m->stack);
    il_free(m->cache);
    il_output_discard(m->vertices);
    il_output_discard(m->triangles);
    il_free(m);
}
