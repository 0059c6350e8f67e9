/* ply.c - the polygon file format: positions in full, and where each came from.
 *
 * Vertex properties: double x y z; uchar red green blue when any stack of the
 * file has a colour (the others are light grey then); int stack slice ring
 * vertex, the vertex of the input, -1 where isoloft inserted one (slice is then
 * the plane it lies in, or -1).  Faces: the corners.  An element of its own,
 * face_origin, has for each face in the same order int slab, the lower slice of
 * its slab: small readers that do not skip a face's other properties exist, and
 * all leave elements behind the faces alone.  Stacks follow one another;
 * comments tell which vertices and triangles are whose. */
#include "config.h"
#include "output/mesh-spool.h"
#include "output/names.h"

enum { GREY = 204 };

typedef struct ply_writer {
    const il_spooled_stack *stack;
    il_output *to;
    bool colors;
} ply_writer;

static bool has_colors(const il_mesh_spool *m)
{
    bool any = false;
    for (size_t k = 0; k < m->n_stacks; k++)
        any = any || m->stack[k].head.has_color;
    return any;
}

static void write_element(il_output *to, const char *name, uint64_t n)
{
    il_output_string(to, "element ");
    il_output_string(to, name);
    il_output_char(to, ' ');
    il_output_integer(to, (long long)n);
    il_output_char(to, '\n');
}

static void write_header(const il_mesh_spool *m, il_output *to, const il_write_options *o,
                         const char *encoding, bool colors)
{
    il_output_string(to, "ply\nformat ");
    il_output_string(to, encoding);
    il_output_string(to, " 1.0\ncomment isoloft\n");
    for (const char *const *c = o->comment; c && *c; c++)
        il_output_comment(to, "comment ", *c);
    for (size_t k = 0; k < m->n_stacks; k++)
        il_mesh_spool_describe(m, k, to, "comment ");
    write_element(to, "vertex", il_mesh_spool_n_vertices(m));
    il_output_string(to, "property double x\nproperty double y\nproperty double z\n");
    if (colors)
        il_output_string(to, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
    il_output_string(to, "property int stack\nproperty int slice\nproperty int ring\nproperty int vertex\n");
    write_element(to, "face", il_mesh_spool_n_triangles(m));
    il_output_string(to, "property list uchar int vertex_indices\n");
    write_element(to, "face_origin", il_mesh_spool_n_triangles(m));
    il_output_string(to, "property int slab\nend_header\n");
}

static unsigned char color_of(const il_spooled_stack *s, int i)
{
    return s->head.has_color ? s->head.color[i] : GREY;
}

/* ---- binary --------------------------------------------------------------- */

static il_status write_binary_vertex(void *self, const il_spooled_vertex *v, il_error *err)
{
    (void)err;
    ply_writer *w = self;
    for (int i = 0; i < 3; i++)
        il_output_f64le(w->to, v->xyz[i]);
    for (int i = 0; i < 3 && w->colors; i++)
        il_output_char(w->to, (char)color_of(w->stack, i));
    il_output_u32le(w->to, (uint32_t)v->origin.stack);
    il_output_u32le(w->to, (uint32_t)v->origin.slice);
    il_output_u32le(w->to, (uint32_t)v->origin.ring);
    il_output_u32le(w->to, (uint32_t)v->origin.vertex);
    return IL_OK;
}

static il_status write_binary_face(void *self, const il_spooled_triangle *t, il_error *err)
{
    (void)err;
    ply_writer *w = self;
    il_output_char(w->to, 3);
    for (int k = 0; k < 3; k++)
        il_output_u32le(w->to, (uint32_t)(w->stack->first_vertex + t->v[k]));
    return IL_OK;
}

static il_status write_binary_slab(void *self, const il_spooled_triangle *t, il_error *err)
{
    (void)err;
    ply_writer *w = self;
    il_output_u32le(w->to, (uint32_t)t->slab);
    return IL_OK;
}

/* ---- text ----------------------------------------------------------------- */

static void write_word(il_output *to, long long v)
{
    il_output_char(to, ' ');
    il_output_integer(to, v);
}

static il_status write_ascii_vertex(void *self, const il_spooled_vertex *v, il_error *err)
{
    (void)err;
    ply_writer *w = self;
    for (int i = 0; i < 3; i++) {
        il_output_number(w->to, v->xyz[i]);
        il_output_write(w->to, " ", i < 2 ? 1 : 0);
    }
    for (int i = 0; i < 3 && w->colors; i++)
        write_word(w->to, color_of(w->stack, i));
    write_word(w->to, v->origin.stack);
    write_word(w->to, v->origin.slice);
    write_word(w->to, v->origin.ring);
    write_word(w->to, v->origin.vertex);
    il_output_char(w->to, '\n');
    return IL_OK;
}

static il_status write_ascii_face(void *self, const il_spooled_triangle *t, il_error *err)
{
    (void)err;
    ply_writer *w = self;
    il_output_char(w->to, '3');
    for (int k = 0; k < 3; k++)
        write_word(w->to, (long long)(w->stack->first_vertex + t->v[k]));
    il_output_char(w->to, '\n');
    return IL_OK;
}

static il_status write_ascii_slab(void *self, const il_spooled_triangle *t, il_error *err)
{
    (void)err;
    ply_writer *w = self;
    il_output_integer(w->to, t->slab);
    il_output_char(w->to, '\n');
    return IL_OK;
}

/* ---- both ----------------------------------------------------------------- */

static il_status write_ply(il_mesh_spool *m, il_output *to, const il_write_options *o, bool binary, il_error *err)
{
    uint64_t n = il_mesh_spool_n_vertices(m);
    if (n > INT32_MAX)
        return il_fail(err, IL_E_INPUT, 0, "%llu vertices are more than PLY can number with 32 bits (obj can)",
                       (unsigned long long)n);
    ply_writer w = { NULL, to, has_colors(m) };
    write_header(m, to, o, binary ? "binary_little_endian" : "ascii", w.colors);
    il_status st = IL_OK;
    for (size_t k = 0; k < m->n_stacks && st == IL_OK; k++) {
        w.stack = &m->stack[k];
        st = il_mesh_spool_each_vertex(m, k, &w, binary ? write_binary_vertex : write_ascii_vertex, err);
    }
    for (size_t k = 0; k < m->n_stacks && st == IL_OK; k++) {
        w.stack = &m->stack[k];
        st = il_mesh_spool_each_triangle(m, k, &w, binary ? write_binary_face : write_ascii_face, err);
    }
    for (size_t k = 0; k < m->n_stacks && st == IL_OK; k++)
        st = il_mesh_spool_each_triangle(m, k, &w, binary ? write_binary_slab : write_ascii_slab, err);
    return st;
}

static il_status write_binary(il_mesh_spool *m, il_output *to, const il_write_options *o, il_error *err)
{
    return write_ply(m, to, o, true, err);
}

static il_status write_ascii(il_mesh_spool *m, il_output *to, const il_write_options *o, il_error *err)
{
    return write_ply(m, to, o, false, err);
}

static il_status new_binary(il_mesh_sink **out, il_output *to, const il_write_options *o, il_error *err)
{
    return il_mesh_spool_new(out, to, o, false, write_binary, err);
}

static il_status new_ascii(il_mesh_sink **out, il_output *to, const il_write_options *o, il_error *err)
{
    return il_mesh_spool_new(out, to, o, false, write_ascii, err);
}

const il_writer il_writer_ply = {
    .name = "ply", .extension = "ply", .words = "PLY, binary, with origins", .binary = true, .round_float = false,
    .mesh_new = new_binary, .mesh_free = il_mesh_spool_free,
};

const il_writer il_writer_ply_ascii = {
    .name = "ply-ascii", .extension = "", .words = "PLY, text, with origins", .binary = false, .round_float = false,
    .mesh_new = new_ascii, .mesh_free = il_mesh_spool_free,
};
