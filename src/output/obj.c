/* obj.c - Wavefront OBJ: text, one object a stack; colours in an MTL beside it.
 *
 * Vertices are counted over the whole file from 1.  The MTL is a file of its
 * own, written only when a stack has a colour and the OBJ is a regular file;
 * materials are named by their colour, so equal colours share one. */
#include "config.h"
#include "base/alloc.h"
#include "base/text.h"
#include "output/mesh-spool.h"
#include "output/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- materials ------------------------------------------------------------ */

enum { NO_COLOR = 1 << 24 };

/* 0xRRGGBB, or NO_COLOR. */
static long color_of(const il_stack_head *h)
{
    return h->has_color ? (long)h->color[0] << 16 | (long)h->color[1] << 8 | (long)h->color[2] : NO_COLOR;
}

static void write_material(il_output *to, const char *keyword, long color)
{
    char line[64];
    if (color == NO_COLOR)
        snprintf(line, sizeof line, "%s plain\n", keyword);
    else
        snprintf(line, sizeof line, "%s rgb_%06lx\n", keyword, color);
    il_output_string(to, line);
}

static int compare_colors(const void *a, const void *b)
{
    long x = *(const long *)a, y = *(const long *)b;
    return (x > y) - (x < y);
}

/* All colours of the file, each once, rising; *COLOR is owned by the caller. */
static il_status list_colors(const il_mesh_spool *m, long **color, size_t *n, il_error *err)
{
    *n = 0;
    *color = il_alloc(m->n_stacks, sizeof **color);
    if (!*color)
        return il_fail_nomem(err);
    for (size_t k = 0; k < m->n_stacks; k++)
        (*color)[k] = color_of(&m->stack[k].head);
    qsort(*color, m->n_stacks, sizeof **color, compare_colors);
    for (size_t k = 0; k < m->n_stacks; k++)
        if (*n == 0 || (*color)[*n - 1] != (*color)[k])
            (*color)[(*n)++] = (*color)[k];
    return IL_OK;
}

static void write_mtl(il_output *to, const long *color, size_t n)
{
    il_output_string(to, "# isoloft\n");
    for (size_t i = 0; i < n; i++) {
        long c = color[i] == NO_COLOR ? 0xcccccc : color[i];
        write_material(to, "newmtl", color[i]);
        il_output_string(to, "Kd");
        for (int shift = 16; shift >= 0; shift -= 8) {
            il_output_char(to, ' ');
            il_output_number(to, (double)(c >> shift & 255) / 255);
        }
        il_output_string(to, "\nillum 1\n");
    }
}

/* part.obj has its colours in part.mtl; a name without .obj gets .mtl behind it,
 * so that it is never the OBJ itself.  Owned; null without memory. */
static char *mtl_path(const char *path)
{
    size_t n = strlen(path), stem = n > 4 && strcasecmp(path + n - 4, ".obj") == 0 ? n - 4 : n;
    char *s = il_alloc(stem + 5, 1);
    if (s) {
        memcpy(s, path, stem);
        memcpy(s + stem, ".mtl", 5);
    }
    return s;
}

/* Can NAME stand on an mtllib line?  Blanks can: readers take the whole line. */
static bool fits_a_line(const char *name)
{
    char shown[1200];
    size_t n = strlen(name), k = il_text_printable(shown, sizeof shown, name, n);
    return k == n && memcmp(shown, name, n) == 0;
}

/* Write the MTL beside TO and name it; *USED says whether there is one. */
static il_status write_colors(il_mesh_spool *m, il_output *to, bool *used, il_error *err)
{
    long *color = NULL;
    size_t n = 0;
    il_output *mtl = NULL;
    const char *path = il_output_file_path(to);
    char *beside = NULL;
    *used = false;
    il_status st = list_colors(m, &color, &n, err);
    if (st != IL_OK || !path || n == 0 || color[0] == NO_COLOR)
        goto done;
    st = (beside = mtl_path(path)) ? IL_OK : il_fail_nomem(err);
    if (st != IL_OK)
        goto done;
    const char *name = strrchr(beside, '/') ? strrchr(beside, '/') + 1 : beside;
    if (!fits_a_line(name)) {
        il_output_string(to, "# without colours: the file's name cannot be written here\n");
        goto done;
    }
    st = il_output_open(&mtl, beside, err);
    if (st != IL_OK)
        goto done;
    write_mtl(mtl, color, n);
    il_output_also(to, mtl);
    il_output_string(to, "mtllib ");
    il_output_string(to, name);
    il_output_char(to, '\n');
    *used = true;
done:
    il_free(beside);
    il_free(color);
    return st;
}

/* ---- geometry ------------------------------------------------------------- */

typedef struct obj_writer {
    const il_spooled_stack *stack;
    il_output *to;
    const char *name;
    bool by_slab, any_slab;
    int32_t slab;            /* of the group that is open, if any_slab */
} obj_writer;

static il_status write_vertex(void *self, const il_spooled_vertex *v, il_error *err)
{
    (void)err;
    obj_writer *w = self;
    il_output_char(w->to, 'v');
    for (int i = 0; i < 3; i++) {
        il_output_char(w->to, ' ');
        il_output_number(w->to, v->xyz[i]);
    }
    il_output_char(w->to, '\n');
    return IL_OK;
}

static void write_named(il_output *to, const char *keyword, const char *name)
{
    il_output_string(to, keyword);
    il_output_string(to, name);
    il_output_char(to, '\n');
}

static void open_slab_group(obj_writer *w, int32_t slab)
{
    char name[IL_STACK_NAME_MAX + 32];
    snprintf(name, sizeof name, "%s_slab%ld", w->name, (long)slab);
    write_named(w->to, "g ", name);
    w->slab = slab;
    w->any_slab = true;
}

static il_status write_face(void *self, const il_spooled_triangle *t, il_error *err)
{
    (void)err;
    obj_writer *w = self;
    if (w->by_slab && (!w->any_slab || w->slab != t->slab))
        open_slab_group(w, t->slab);
    il_output_char(w->to, 'f');
    for (int k = 0; k < 3; k++) {
        il_output_char(w->to, ' ');
        il_output_integer(w->to, (long long)(w->stack->first_vertex + t->v[k] + 1));
    }
    il_output_char(w->to, '\n');
    return IL_OK;
}

static il_status write_stack(il_mesh_spool *m, size_t k, obj_writer *w, bool colors, il_error *err)
{
    il_mesh_spool_describe(m, k, w->to, "# ");
    write_named(w->to, "o ", w->name);
    il_status st = il_mesh_spool_each_vertex(m, k, w, write_vertex, err);
    if (!w->by_slab)
        write_named(w->to, "g ", w->name);
    if (colors)
        write_material(w->to, "usemtl", color_of(&w->stack->head));
    return st == IL_OK ? il_mesh_spool_each_triangle(m, k, w, write_face, err) : st;
}

static il_status write_obj(il_mesh_spool *m, il_output *to, const il_write_options *o, il_error *err)
{
    il_output_string(to, "# isoloft\n");
    for (const char *const *c = o->comment; c && *c; c++)
        il_output_comment(to, "# ", *c);
    bool colors = false, differ = true;
    il_status st = write_colors(m, to, &colors, err);
    if (st == IL_OK)
        st = il_mesh_spool_names_differ(m, &differ, err);
    for (size_t k = 0; k < m->n_stacks && st == IL_OK; k++) {
        char name[IL_STACK_NAME_MAX];
        il_mesh_spool_name(m, k, differ, name);
        obj_writer w = { &m->stack[k], to, name, o->groups_by_slab, false, 0 };
        st = write_stack(m, k, &w, colors, err);
    }
    return st;
}

static il_status new_obj(il_mesh_sink **out, il_output *to, const il_write_options *o, il_error *err)
{
    return il_mesh_spool_new(out, to, o, false, write_obj, err);
}

const il_writer il_writer_obj = {
    .name = "obj", .extension = "obj", .words = "Wavefront OBJ, colours in an MTL beside it", .binary = false,
    .round_float = false, .mesh_new = new_obj, .mesh_free = il_mesh_spool_free,
};
