/* mesh-stl.c - STL, binary and text.  Corners are gathered, then those of equal
 * position made one; by sorting, so that no choice of coordinates is slow. */
#include "config.h"
#include "base/alloc.h"
#include "input/mesh-parts.h"

#include <stdlib.h>
#include <string.h>

/* Corner i of triangle i / 3. */
typedef struct corner { double xyz[3]; size_t i; } corner;
typedef struct corners { corner *at; size_t n, cap; } corners;

static il_status add_corner(corners *c, const double xyz[3], il_error *err)
{
    if (c->n >= UINT32_MAX - 1)
        return il_fail(err, IL_E_INPUT, 0, "more than %lu triangles", (unsigned long)(UINT32_MAX / 3));
    if (!il_grow(&c->at, &c->cap, c->n + 1, sizeof *c->at))
        return il_fail_nomem(err);
    c->at[c->n] = (corner){ { xyz[0], xyz[1], xyz[2] }, c->n };
    c->n++;
    return IL_OK;
}

/* ---- equal positions -------------------------------------------------------- */

static int by_position(const void *pa, const void *pb)
{
    const corner *a = pa, *b = pb;
    for (int k = 0; k < 3; k++)
        if (a->xyz[k] != b->xyz[k])
            return a->xyz[k] < b->xyz[k] ? -1 : 1;
    return (a->i > b->i) - (a->i < b->i);
}

static bool same_position(const corner *a, const corner *b)
{
    return a->xyz[0] == b->xyz[0] && a->xyz[1] == b->xyz[1] && a->xyz[2] == b->xyz[2];
}

/* first[i]: the first corner at the position of corner i. */
static void find_first(const corners *c, uint32_t *first)
{
    for (size_t k = 0; k < c->n; k++) {
        bool same = k > 0 && same_position(&c->at[k], &c->at[k - 1]);
        first[c->at[k].i] = same ? first[c->at[k - 1].i] : (uint32_t)c->at[k].i;
    }
}

/* Corners to triangles, each position one vertex in order of first appearance.
 * C is left sorted by position. */
static il_status merge_corners(corners *c, il_mesh *out, il_error *err)
{
    const double nowhere[3] = { 0, 0, 0 };
    uint32_t *vertex = il_alloc(c->n, sizeof *vertex);
    il_status st = vertex ? IL_OK : il_fail_nomem(err);
    if (st == IL_OK && c->n > 0) {
        qsort(c->at, c->n, sizeof *c->at, by_position);
        find_first(c, vertex);
    }
    for (size_t i = 0; st == IL_OK && i < c->n; i++) {
        bool is_first = vertex[i] == i;
        vertex[i] = is_first ? (uint32_t)out->n_vertices : vertex[vertex[i]];
        if (is_first)
            st = il_mesh_file_add_vertex(out, nowhere, err);
    }
    for (size_t k = 0; st == IL_OK && k < c->n; k++)
        memcpy(out->xyz + 3 * (size_t)vertex[c->at[k].i], c->at[k].xyz, sizeof c->at[k].xyz);
    for (size_t i = 0; st == IL_OK && i + 2 < c->n; i += 3)
        if (!il_mesh_add_triangle(out, vertex[i], vertex[i + 1], vertex[i + 2]))
            st = il_fail_nomem(err);
    il_free(vertex);
    return st;
}

/* ---- binary: 80 bytes, a count, 50 bytes a triangle --------------------------- */

enum { HEADER = 84, RECORD = 50, NORMAL = 12 };

static il_status read_record(il_bytes *b, const unsigned char *p, corners *c, il_error *err)
{
    il_status st = IL_OK;
    for (int i = 0; i < 3 && st == IL_OK; i++) {
        double xyz[3];
        for (int k = 0; k < 3; k++) {
            size_t at = NORMAL + 4 * (size_t)(3 * i + k);
            xyz[k] = il_f32le_at(p + at);
            if (!il_coordinate_fits(xyz[k]))
                return il_fail(err, IL_E_INPUT, 0, "byte %llu: a coordinate is not finite or not below 1e15",
                               (unsigned long long)(b->offset - RECORD + at));
        }
        st = add_corner(c, xyz, err);
    }
    return st;
}

static il_status read_records(il_bytes *b, corners *c, il_error *err)
{
    const unsigned char *p;
    il_status st = il_bytes_take(b, HEADER, &p, err);
    if (st != IL_OK || !p)
        return st != IL_OK ? st : il_fail(err, IL_E_INPUT, 0, "the file ends in its header");
    uint32_t promised = il_u32le_at(p + 80), n = 0;
    while (st == IL_OK && n < promised) {
        st = il_bytes_take(b, RECORD, &p, err);
        if (st == IL_OK && !p)
            return il_fail(err, IL_E_INPUT, 0, "byte %llu: the file ends after %lu of %lu triangles",
                           (unsigned long long)b->offset, (unsigned long)n, (unsigned long)promised);
        if (st == IL_OK)
            st = read_record(b, p, c, err);
        n++;
    }
    if (st == IL_OK)
        st = il_bytes_take(b, 1, &p, err);
    if (st == IL_OK && p)
        st = il_fail(err, IL_E_INPUT, 0, "byte %llu: something follows the %lu triangles that the header promises",
                     (unsigned long long)b->offset - 1, (unsigned long)promised);
    return st;
}

il_status il_mesh_read_stl(il_source *source, il_mesh *out, il_error *err)
{
    corners c = { NULL, 0, 0 };
    il_bytes b;
    il_status st = il_bytes_init(&b, source, 0, NULL, 0, err);
    if (st == IL_OK)
        st = read_records(&b, &c, err);
    il_bytes_free(&b);
    if (st == IL_OK)
        st = merge_corners(&c, out, err);
    il_free(c.at);
    return st;
}

/* ---- text: solid (facet normal, outer loop, vertex x 3)* endsolid -------------- */

static il_status expect(il_words *w, const char *const *words, il_error *err)
{
    for (; *words; words++) {
        il_word got;
        il_status st = il_words_next(w, &got, err);
        if (st != IL_OK)
            return st;
        if (got.n == 0)
            return il_fail(err, IL_E_INPUT, w->lines.line, "the file ends where '%s' must stand", *words);
        if (**words != '*' && !il_word_is(got, *words))
            return il_fail(err, IL_E_INPUT, w->lines.line, "'%.*s' where '%s' must stand", IL_WORD_SHOWN(got), *words);
    }
    return IL_OK;
}

static il_status read_vertex(il_words *w, corners *c, il_error *err)
{
    static const char *const vertex[] = { "vertex", NULL };
    double xyz[3];
    il_status st = expect(w, vertex, err);
    for (int k = 0; st == IL_OK && k < 3; k++) {
        il_word word;
        st = il_words_next(w, &word, err);
        if (st == IL_OK && !il_word_number(word, &xyz[k]))
            st = il_fail_number(word, w->lines.line, err);
    }
    return st == IL_OK ? add_corner(c, xyz, err) : st;
}

/* What follows the word "facet".  The normal is not looked at: many files have
 * none worth reading, some have "nan". */
static il_status read_facet(il_words *w, corners *c, il_error *err)
{
    static const char *const open[] = { "normal", "*", "*", "*", "outer", "loop", NULL };
    static const char *const close[] = { "endloop", "endfacet", NULL };
    il_status st = expect(w, open, err);
    for (int i = 0; st == IL_OK && i < 3; i++)
        st = read_vertex(w, c, err);
    return st == IL_OK ? expect(w, close, err) : st;
}

/* One solid behind its first word; names end with their line. */
static il_status read_solid(il_words *w, corners *c, il_error *err)
{
    for (w->at = w->end;;) {
        il_word word;
        il_status st = il_words_next(w, &word, err);
        if (st != IL_OK)
            return st;
        if (il_word_is(word, "endsolid")) {
            w->at = w->end;
            return IL_OK;
        }
        if (word.n == 0)
            return il_fail(err, IL_E_INPUT, w->lines.line, "the file ends inside a solid");
        if (!il_word_is(word, "facet"))
            return il_fail(err, IL_E_INPUT, w->lines.line, "'%.*s' where 'facet' or 'endsolid' must stand",
                           IL_WORD_SHOWN(word));
        st = read_facet(w, c, err);
        if (st != IL_OK)
            return st;
    }
}

static il_status read_solids(il_words *w, corners *c, il_error *err)
{
    for (;;) {
        il_word word;
        il_status st = il_words_next(w, &word, err);
        if (st != IL_OK || word.n == 0)
            return st;
        if (!il_word_is(word, "solid"))
            return il_fail(err, IL_E_INPUT, w->lines.line, "'%.*s' behind the end of the solid", IL_WORD_SHOWN(word));
        st = read_solid(w, c, err);
        if (st != IL_OK)
            return st;
    }
}

il_status il_mesh_read_stl_ascii(il_source *source, il_mesh *out, il_error *err)
{
    corners c = { NULL, 0, 0 };
    il_words w;
    il_words_init(&w, source);
    il_status st = read_solids(&w, &c, err);
    il_words_free(&w);
    if (st == IL_OK)
        st = merge_corners(&c, out, err);
    il_free(c.at);
    return st;
}
