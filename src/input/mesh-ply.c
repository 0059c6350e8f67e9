/* mesh-ply.c - PLY: the rows behind the header, in text or in bytes of either order. */
#include "config.h"
#include "input/mesh-ply.h"

#include <string.h>

/* Either words or bytes is in use. */
typedef struct ply_body {
    const ply_header *header;
    il_words *words;
    il_bytes bytes;
    il_mesh *mesh;
    size_t polygons;
} ply_body;

/* ---- one number ------------------------------------------------------------- */

static const unsigned char size_of[] = { [PLY_NONE] = 0, [PLY_INT8] = 1, [PLY_UINT8] = 1, [PLY_INT16] = 2,
    [PLY_UINT16] = 2, [PLY_INT32] = 4, [PLY_UINT32] = 4, [PLY_FLOAT32] = 4, [PLY_FLOAT64] = 8 };

static double decode(const unsigned char *p, ply_type type, bool big_endian)
{
    uint64_t bits = 0;
    size_t n = size_of[type];
    for (size_t i = 0; i < n; i++)
        bits |= (uint64_t)p[i] << 8 * (big_endian ? n - 1 - i : i);
    uint32_t bits32 = (uint32_t)bits;
    float f;
    double d;
    switch (type) {
    case PLY_INT8:    return bits < 0x80 ? (double)bits : (double)bits - 0x100;
    case PLY_INT16:   return bits < 0x8000 ? (double)bits : (double)bits - 0x10000;
    case PLY_INT32:   return bits < 0x80000000 ? (double)bits : (double)bits - 4294967296.0;
    case PLY_FLOAT32: memcpy(&f, &bits32, sizeof f); return (double)f;
    case PLY_FLOAT64: memcpy(&d, &bits, sizeof d); return d;
    default:          return (double)bits;
    }
}

/* Where the last number stood, for errors: a line, or 0 and words. */
static il_status fail(const ply_body *b, const char *what, il_error *err)
{
    if (b->words)
        return il_fail(err, IL_E_INPUT, b->words->lines.line, "%s", what);
    return il_fail(err, IL_E_INPUT, 0, "before byte %llu: %s", (unsigned long long)b->bytes.offset, what);
}

static il_status read_number(ply_body *b, ply_type type, double *value, il_error *err)
{
    if (b->words) {
        il_word word;
        il_status st = il_words_next(b->words, &word, err);
        if (st == IL_OK && word.n == 0)
            return fail(b, "the file ends before its last element does", err);
        return st == IL_OK && !il_word_number(word, value) ? il_fail_number(word, b->words->lines.line, err) : st;
    }
    const unsigned char *p;
    il_status st = il_bytes_take(&b->bytes, size_of[type], &p, err);
    if (st == IL_OK && !p)
        return fail(b, "the file ends before its last element does", err);
    if (st == IL_OK)
        *value = decode(p, type, b->header->format == PLY_BIG_ENDIAN);
    return st;
}

/* A whole number from 0 to N - 1. */
static il_status read_index(ply_body *b, ply_type type, double n, const char *otherwise, uint32_t *value, il_error *err)
{
    double d;
    il_status st = read_number(b, type, &d, err);
    if (st != IL_OK)
        return st;
    if (!(d >= 0 && d < n) || d != (double)(uint32_t)d)
        return fail(b, otherwise, err);
    *value = (uint32_t)d;
    return IL_OK;
}

/* ---- rows --------------------------------------------------------------------- */

static il_status read_corners(ply_body *b, const ply_property *p, uint32_t n, il_error *err)
{
    il_fan fan = { 0, 0, 0 };
    if (n < 3)
        return fail(b, "a face of fewer than 3 corners", err);
    b->polygons += n > 3;
    for (; n > 0; n--) {
        uint32_t corner = 0;
        il_status st = read_index(b, p->type, (double)b->header->n_vertices, "a corner names no vertex", &corner, err);
        if (st == IL_OK)
            st = il_fan_add(&fan, corner, b->mesh, err);
        if (st != IL_OK)
            return st;
    }
    return IL_OK;
}

static il_status pass_over(ply_body *b, ply_type type, uint32_t n, il_error *err)
{
    il_status st = IL_OK;
    for (double ignored; n > 0 && st == IL_OK; n--) {
        if (b->words) {
            il_word word; /* "nan" is fine in what nobody reads */
            st = il_words_next(b->words, &word, err);
            if (st == IL_OK && word.n == 0)
                st = fail(b, "the file ends before its last element does", err);
        } else {
            st = read_number(b, type, &ignored, err);
        }
    }
    return st;
}

static il_status read_list(ply_body *b, const ply_property *p, il_error *err)
{
    uint32_t n = 0;
    il_status st = read_index(b, p->count_type, 4294967296.0, "a list of an impossible length", &n, err);
    if (st != IL_OK)
        return st;
    return p->role == PLY_CORNERS ? read_corners(b, p, n, err) : pass_over(b, p->type, n, err);
}

static il_status read_row(ply_body *b, const ply_element *e, il_error *err)
{
    double xyz[3] = { 0, 0, 0 };
    il_status st = IL_OK;
    for (size_t i = 0; i < e->n_properties && st == IL_OK; i++) {
        const ply_property *p = &b->header->property[e->first + i];
        if (p->count_type != PLY_NONE)
            st = read_list(b, p, err);
        else if (p->role == PLY_IGNORED)
            st = pass_over(b, p->type, 1, err);
        else
            st = read_number(b, p->type, &xyz[p->role - PLY_X], err);
    }
    if (st != IL_OK || e->kind != PLY_VERTEX)
        return st;
    for (int k = 0; k < 3; k++)
        if (!il_coordinate_fits(xyz[k]))
            return fail(b, "a coordinate is not finite or not below 1e15", err);
    return il_mesh_file_add_vertex(b->mesh, xyz, err);
}

static il_status read_rows(ply_body *b, il_error *err)
{
    for (size_t i = 0; i < b->header->n_elements; i++)
        for (uint64_t k = 0; k < b->header->element[i].n; k++) {
            il_status st = read_row(b, &b->header->element[i], err);
            if (st != IL_OK)
                return st;
        }
    return IL_OK;
}

static il_status expect_end(ply_body *b, il_error *err)
{
    il_word word = { NULL, 0 };
    const unsigned char *p = NULL;
    il_status st = b->words ? il_words_next(b->words, &word, err) : il_bytes_take(&b->bytes, 1, &p, err);
    if (st == IL_OK && (word.n > 0 || p))
        st = fail(b, "something follows the last element", err);
    return st;
}

static il_status read_body(const ply_header *h, il_words *w, il_mesh *out, size_t *polygons, il_error *err)
{
    ply_body b = { .header = h, .mesh = out };
    il_lines *l = &w->lines;
    il_status st = IL_OK;
    if (h->format == PLY_ASCII) {
        b.words = w;
        w->at = w->end;
    } else {
        st = il_bytes_init(&b.bytes, l->source, h->n_bytes, l->buf + l->begin, l->end - l->begin, err);
    }
    if (st == IL_OK)
        st = read_rows(&b, err);
    if (st == IL_OK)
        st = expect_end(&b, err);
    il_bytes_free(&b.bytes);
    *polygons = b.polygons;
    return st;
}

il_status il_mesh_read_ply(il_source *source, il_mesh *out, size_t *polygons, il_error *err)
{
    ply_header h = { 0 };
    il_words w;
    il_words_init(&w, source);
    il_status st = il_ply_header_read(&h, &w, err);
    if (st == IL_OK)
        st = read_body(&h, &w, out, polygons, err);
    il_ply_header_free(&h);
    il_words_free(&w);
    return st;
}
