/* meshes.h - small meshes for the writers, and what they made of them. */
#ifndef IL_TESTS_MESHES_H
#define IL_TESTS_MESHES_H

#include "base/alloc.h"
#include "files.h"
#include "output/writer.h"

static const il_writer *const mesh_writers[] = {
    &il_writer_stl, &il_writer_stl_ascii, &il_writer_obj, &il_writer_ply, &il_writer_ply_ascii };
enum { N_WRITERS = sizeof mesh_writers / sizeof *mesh_writers };

static inline il_stack_head head_called(const char *name)
{
    il_stack_head h = IL_STACK_HEAD_INIT;
    assert_true(il_stack_head_set_name(&h, name, strlen(name)));
    return h;
}

static inline void set_color(il_stack_head *h, unsigned char r, unsigned char g, unsigned char b)
{
    h->has_color = true;
    h->color[0] = r, h->color[1] = g, h->color[2] = b;
}

static const il_mesh_facts no_facts;

/* The corner tetrahedron, its top an inserted vertex, in two pieces; AT is added
 * to x.  Stops at the first failure, as the lofter would. */
static inline il_status send_tetrahedron(il_mesh_sink *s, const il_stack_head *head, double at, int32_t stack,
                                         il_error *err)
{
    double low[9] = { at, 0, 0, at + 1, 0, -0.0, at, 1, 0 }, top[3] = { at, 0, 1 };
    il_origin low_origin[3] = { { stack, 0, 0, 0 }, { stack, 0, 0, 1 }, { stack, 0, 0, 2 } };
    il_origin inserted = { -1, 1, -1, -1 };
    uint32_t bottom[3] = { 0, 2, 1 }, sides[9] = { 0, 1, 3, 0, 3, 2, 1, 2, 3 };
    il_mesh one = { .xyz = low, .n_vertices = 3, .origin = low_origin, .tri = bottom, .n_triangles = 1, .slab = 0 };
    il_mesh two = { .xyz = top, .n_vertices = 1, .origin = &inserted, .tri = sides, .n_triangles = 3, .slab = 0 };
    il_status st = s->begin(s, head, err);
    if (st == IL_OK)
        st = s->piece(s, &one, err);
    return st == IL_OK ? s->piece(s, &two, err) : st;
}

static inline il_status send_whole(il_mesh_sink *s, const il_stack_head *head, double at, int32_t stack, il_error *err)
{
    il_status st = send_tetrahedron(s, head, at, stack, err);
    return st == IL_OK ? s->end(s, &no_facts, err) : st;
}

/* A writer of kind W into memory. */
static inline il_mesh_sink *started(const il_writer *w, il_output **o)
{
    il_mesh_sink *s;
    assert_int_equal(il_output_to_memory(o, NULL), IL_OK);
    assert_int_equal(w->mesh_new(&s, *o, NULL, NULL), IL_OK);
    return s;
}

static inline void finished(const il_writer *w, il_mesh_sink *s, il_output *o)
{
    size_t n;
    (void)il_output_memory(o, &n);
    assert_int_equal(n, 0); /* nothing leaves before */
    il_error err = IL_ERROR_INIT;
    assert_int_equal(s->finish(s, &err), IL_OK);
    w->mesh_free(s);
}

static inline void assert_text(il_output *o, const char *expected)
{
    size_t n;
    const unsigned char *data = il_output_memory(o, &n);
    char *text = il_strndup((const char *)data, n);
    assert_string_equal(text, expected);
    il_free(text);
    il_output_discard(o);
}

static inline bool output_contains(il_output *o, const char *what)
{
    size_t n, m = strlen(what);
    const unsigned char *data = il_output_memory(o, &n);
    for (size_t i = 0; i + m <= n; i++)
        if (memcmp(data + i, what, m) == 0)
            return true;
    return false;
}

#endif
