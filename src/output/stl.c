/* stl.c - stereolithography: triangles as 32-bit floats, each with its normal.
 *
 * Binary: 80 bytes of header, a 32-bit count, and for each triangle 12 floats
 * and 16 bits of "attribute", all little-endian.  ASCII: solid NAME, facets,
 * endsolid NAME, one solid a stack.  Neither names a unit nor a colour. */
#include "config.h"
#include "base/number.h"
#include "base/text.h"
#include "output/mesh-spool.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct facet { float normal[3], corner[3][3]; } facet;

static void cross(const float p[3][3], double n[3])
{
    double a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)p[1][i] - (double)p[0][i];
        b[i] = (double)p[2][i] - (double)p[0][i];
    }
    n[0] = a[1] * b[2] - a[2] * b[1];
    n[1] = a[2] * b[0] - a[0] * b[2];
    n[2] = a[0] * b[1] - a[1] * b[0];
}

/* Of the corners as written.  Products of floats neither overflow nor vanish in
 * a double.  Without area: 0 0 0, which asks the reader to compute it. */
static void set_normal(facet *f)
{
    double n[3];
    cross((const float (*)[3])f->corner, n);
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; i++)
        f->normal[i] = length > 0 ? (float)(n[i] / length) + 0.0f : 0.0f;
}

static il_status make_facet(il_mesh_spool *m, const il_spooled_stack *s, const il_spooled_triangle *t,
                            facet *f, il_error *err)
{
    for (int k = 0; k < 3; k++) {
        double p[3];
        il_status st = il_mesh_spool_position(m, s->first_vertex + t->v[k], p, err);
        if (st != IL_OK)
            return st;
        for (int i = 0; i < 3; i++) {
            f->corner[k][i] = (float)p[i];
            if (!isfinite(f->corner[k][i]))
                return il_fail(err, IL_E_INPUT, 0, "stack '%.80s' is too large for the 32-bit numbers of STL",
                               il_stack_head_name(&s->head));
            f->corner[k][i] += 0.0f; /* a tiny negative number may have become -0 */
        }
    }
    set_normal(f);
    return IL_OK;
}

/* ---- binary --------------------------------------------------------------- */

typedef struct stl_writer {
    il_mesh_spool *m;
    const il_spooled_stack *stack;
    il_output *to;
} stl_writer;

static il_status write_binary_facet(void *self, const il_spooled_triangle *t, il_error *err)
{
    stl_writer *w = self;
    facet f;
    il_status st = make_facet(w->m, w->stack, t, &f, err);
    if (st != IL_OK)
        return st;
    for (int i = 0; i < 3; i++)
        il_output_f32le(w->to, f.normal[i]);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            il_output_f32le(w->to, f.corner[k][i]);
    il_output_write(w->to, "\0", 2);
    return IL_OK;
}

enum { HEADER = 80 };
typedef struct stl_header { char text[HEADER + 1]; size_t n; } stl_header;

/* Whole or not at all: half a number would be another. */
static bool add_words(stl_header *h, const char *words)
{
    size_t n = strlen(words);
    if (h->n + n > HEADER)
        return false;
    memcpy(h->text + h->n, words, n);
    h->n += n;
    return true;
}

/* " offset X Y Z scale S", and " z S" where that of z is another; of offset and scale
 * what fits. */
static void add_placement(stl_header *h, const il_placement *p)
{
    char number[3][IL_NUMBER_MAX], words[4 * IL_NUMBER_MAX];
    for (int k = 0; k < 3; k++)
        il_number_format(number[k], p->offset[k]);
    snprintf(words, sizeof words, " offset %s %s %s", number[0], number[1], number[2]);
    bool fits = add_words(h, words);
    il_number_format(number[0], p->scale[0]);
    il_number_format(number[2], p->scale[2]);
    bool same = p->scale[0] == p->scale[2];
    snprintf(words, sizeof words, same ? " scale %s" : " scale %s z %s", number[0], number[2]);
    if (fits && (p->scale[0] != 1 || p->scale[2] != 1))
        add_words(h, words);
}

/* "EPSG:32629"; what does not fit is left out. */
static void add_crs(stl_header *h, const char *crs)
{
    char shown[HEADER], words[HEADER + 2];
    if (!crs || strlen(crs) >= sizeof shown)
        return;
    il_text_printable(shown, sizeof shown, crs, strlen(crs));
    snprintf(words, sizeof words, " %s", shown);
    add_words(h, words);
}

static void add_name(stl_header *h, const char *name, const char *joint)
{
    if (*name && h->n + strlen(joint) < HEADER && add_words(h, joint))
        h->n += il_text_printable(h->text + h->n, sizeof h->text - h->n, name, strlen(name));
}

/* "STL isoloft NAME, NAME", zeros behind; a map's name follows on where its mesh was put,
 * and its coordinate system.
 * It begins neither with "solid", which announces ASCII, nor with "isoloft ", the native
 * format's magic; no '=', because some readers take "COLOR=" in a header for a command. */
static void write_header(const il_mesh_spool *m, il_output *to)
{
    stl_header h = { "", 0 };
    add_words(&h, "STL isoloft");
    for (size_t k = 0, n = h.n; k < m->n_stacks; k++) {
        const il_stack_head *head = &m->stack[k].head;
        const char *joint = h.n == n ? " " : ", ";
        if (head->has_placement) {
            add_placement(&h, &head->placement);
            add_crs(&h, head->crs);
            joint = " ";
        }
        add_name(&h, il_stack_head_name(head), joint);
    }
    for (size_t i = 0; i < h.n; i++)
        h.text[i] = h.text[i] == '=' ? '_' : h.text[i];
    memset(h.text + h.n, 0, HEADER - h.n);
    il_output_write(to, h.text, HEADER);
}

static il_status write_binary(il_mesh_spool *m, il_output *to, const il_write_options *o, il_error *err)
{
    (void)o;
    uint64_t n = il_mesh_spool_n_triangles(m);
    if (n > UINT32_MAX)
        return il_fail(err, IL_E_INPUT, 0, "%llu triangles are more than binary STL can count (ply and obj can)",
                       (unsigned long long)n);
    write_header(m, to);
    il_output_u32le(to, (uint32_t)n);
    il_status st = IL_OK;
    for (size_t k = 0; k < m->n_stacks && st == IL_OK; k++) {
        stl_writer w = { m, &m->stack[k], to };
        st = il_mesh_spool_each_triangle(m, k, &w, write_binary_facet, err);
    }
    return st;
}

static il_status new_binary(il_mesh_sink **out, il_output *to, const il_write_options *o, il_error *err)
{
    return il_mesh_spool_new(out, to, o, true, write_binary, err);
}

const il_writer il_writer_stl = {
    .name = "stl", .extension = "stl", .words = "STL, binary", .binary = true, .round_float = true,
    .mesh_new = new_binary, .mesh_free = il_mesh_spool_free,
};

/* ---- ASCII ---------------------------------------------------------------- */

static void write_triple(il_output *to, const char *before, const float v[3])
{
    il_output_string(to, before);
    for (int i = 0; i < 3; i++) {
        il_output_char(to, ' ');
        il_output_float(to, v[i]);
    }
    il_output_char(to, '\n');
}

static il_status write_ascii_facet(void *self, const il_spooled_triangle *t, il_error *err)
{
    stl_writer *w = self;
    facet f;
    il_status st = make_facet(w->m, w->stack, t, &f, err);
    if (st != IL_OK)
        return st;
    write_triple(w->to, "facet normal", f.normal);
    il_output_string(w->to, "outer loop\n");
    for (int k = 0; k < 3; k++)
        write_triple(w->to, "vertex", f.corner[k]);
    il_output_string(w->to, "endloop\nendfacet\n");
    return IL_OK;
}

static void write_solid(il_output *to, const char *word, const char *name)
{
    il_output_string(to, word);
    il_output_string(to, name);
    il_output_char(to, '\n');
}

static il_status write_ascii(il_mesh_spool *m, il_output *to, const il_write_options *o, il_error *err)
{
    (void)o;
    bool differ = true;
    il_status st = il_mesh_spool_names_differ(m, &differ, err);
    for (size_t k = 0; k < m->n_stacks && st == IL_OK; k++) {
        char name[IL_STACK_NAME_MAX];
        il_mesh_spool_name(m, k, differ, name);
        stl_writer w = { m, &m->stack[k], to };
        write_solid(to, "solid ", name);
        st = il_mesh_spool_each_triangle(m, k, &w, write_ascii_facet, err);
        write_solid(to, "endsolid ", name);
    }
    return st;
}

static il_status new_ascii(il_mesh_sink **out, il_output *to, const il_write_options *o, il_error *err)
{
    return il_mesh_spool_new(out, to, o, true, write_ascii, err);
}

const il_writer il_writer_stl_ascii = {
    .name = "stl-ascii", .extension = "", .words = "STL, text", .binary = false, .round_float = true,
    .mesh_new = new_ascii, .mesh_free = il_mesh_spool_free,
};
