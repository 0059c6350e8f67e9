#include "config.h"
#include "base/alloc.h"
#include "input/mesh-ply.h"

static const struct { const char *name; ply_type type; } types[] = {
    { "char", PLY_INT8 }, { "int8", PLY_INT8 }, { "uchar", PLY_UINT8 }, { "uint8", PLY_UINT8 },
    { "short", PLY_INT16 }, { "int16", PLY_INT16 }, { "ushort", PLY_UINT16 }, { "uint16", PLY_UINT16 },
    { "int", PLY_INT32 }, { "int32", PLY_INT32 }, { "uint", PLY_UINT32 }, { "uint32", PLY_UINT32 },
    { "float", PLY_FLOAT32 }, { "float32", PLY_FLOAT32 }, { "double", PLY_FLOAT64 }, { "float64", PLY_FLOAT64 } };

static bool find_type(il_word word, ply_type *type)
{
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (il_word_is(word, types[i].name)) {
            *type = types[i].type;
            return true;
        }
    }
    return false;
}

static bool is_integer(ply_type t)
{
    return t != PLY_FLOAT32 && t != PLY_FLOAT64;
}

static il_status fail(const il_words *w, const char *what, il_word word, il_error *err)
{
    return il_fail(err, IL_E_INPUT, w->lines.line, "%s: '%.*s'", what, IL_WORD_SHOWN(word));
}

static il_status read_format(ply_header *h, il_words *w, il_error *err)
{
    il_word word = il_words_in_line(w);
    h->has_format = true;
    if (il_word_is(word, "ascii"))
        h->format = PLY_ASCII;
    else if (il_word_is(word, "binary_little_endian"))
        h->format = PLY_LITTLE_ENDIAN;
    else if (il_word_is(word, "binary_big_endian"))
        h->format = PLY_BIG_ENDIAN;
    else
        return fail(w, "not a format of PLY", word, err);
    word = il_words_in_line(w);
    return il_word_is(word, "1.0") ? IL_OK : fail(w, "not version 1.0", word, err);
}

static bool read_count(il_word word, uint64_t *n)
{
    *n = 0;
    for (size_t i = 0; i < word.n; i++) {
        if (word.s[i] < '0' || word.s[i] > '9' || *n > UINT64_MAX / 10 - 1)
            return false;
        *n = 10 * *n + (uint64_t)(word.s[i] - '0');
    }
    return word.n > 0;
}

/* An element without properties takes no room: rows of it would cost the file
 * nothing and us time. */
static il_status end_element(const ply_header *h, const il_words *w, il_error *err)
{
    if (h->n_elements > 0 && h->element[h->n_elements - 1].n_properties == 0)
        return il_fail(err, IL_E_INPUT, w->lines.line, "the element before this line has no property");
    return IL_OK;
}

static il_status read_element(ply_header *h, il_words *w, il_error *err)
{
    il_status st = end_element(h, w, err);
    if (st != IL_OK)
        return st;
    if (!il_grow(&h->element, &h->cap_elements, h->n_elements + 1, sizeof *h->element))
        return il_fail_nomem(err);
    ply_element e = { PLY_OTHER, 0, h->n_properties, 0 };
    il_word name = il_words_in_line(w);
    bool *seen = NULL;
    if (il_word_is(name, "vertex")) {
        e.kind = PLY_VERTEX;
        seen = &h->has_vertices;
    } else if (il_word_is(name, "face")) {
        e.kind = PLY_FACE;
        seen = &h->has_faces;
    }
    if (seen && *seen)
        return fail(w, "an element that stands twice", name, err);
    il_word count = il_words_in_line(w);
    if (!read_count(count, &e.n) || (e.kind == PLY_VERTEX && e.n >= UINT32_MAX))
        return fail(w, "not a number of rows", count, err);
    if (seen)
        *seen = true;
    if (e.kind == PLY_VERTEX)
        h->n_vertices = e.n;
    h->element[h->n_elements++] = e;
    return IL_OK;
}

static ply_role role_of(ply_kind kind, il_word name)
{
    static const struct { ply_kind kind; const char *name; ply_role role; } roles[] = {
        { PLY_VERTEX, "x", PLY_X }, { PLY_VERTEX, "y", PLY_Y }, { PLY_VERTEX, "z", PLY_Z },
        { PLY_FACE, "vertex_indices", PLY_CORNERS }, { PLY_FACE, "vertex_index", PLY_CORNERS } };
    for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
        if (roles[i].kind == kind && il_word_is(name, roles[i].name))
            return roles[i].role;
    return PLY_IGNORED;
}

static bool has_role(const ply_header *h, const ply_element *e, ply_role role)
{
    for (size_t i = 0; i < e->n_properties; i++)
        if (h->property[e->first + i].role == role)
            return true;
    return false;
}

static il_status read_property(ply_header *h, il_words *w, il_error *err)
{
    ply_property p = { PLY_NONE, PLY_NONE, PLY_IGNORED };
    if (h->n_elements == 0)
        return il_fail(err, IL_E_INPUT, w->lines.line, "a property before the first element");
    ply_element *e = &h->element[h->n_elements - 1];
    il_word word = il_words_in_line(w);
    if (il_word_is(word, "list")) {
        word = il_words_in_line(w);
        if (!find_type(word, &p.count_type) || !is_integer(p.count_type))
            return fail(w, "not a type for a count", word, err);
        word = il_words_in_line(w);
    }
    if (!find_type(word, &p.type))
        return fail(w, "not a type of PLY", word, err);
    il_word name = il_words_in_line(w);
    p.role = role_of(e->kind, name);
    bool wants_list = p.role == PLY_CORNERS, is_list = p.count_type != PLY_NONE;
    bool fits = wants_list == is_list && (!wants_list || is_integer(p.type)) && !has_role(h, e, p.role);
    if (p.role != PLY_IGNORED && !fits)
        return fail(w, "a property that stands twice or has the wrong type", name, err);
    if (!il_grow(&h->property, &h->cap_properties, h->n_properties + 1, sizeof *h->property))
        return il_fail_nomem(err);
    h->property[h->n_properties++] = p;
    e->n_properties++;
    return IL_OK;
}

static il_status finish(const ply_header *h, const il_words *w, il_error *err)
{
    il_status st = end_element(h, w, err);
    if (st != IL_OK)
        return st;
    if (!h->has_format)
        return il_fail(err, IL_E_INPUT, w->lines.line, "the header says no format");
    if (!h->has_vertices || !h->has_faces)
        return il_fail(err, IL_E_INPUT, w->lines.line, "the header has no element '%s'",
                       h->has_vertices ? "face" : "vertex");
    for (size_t i = 0; i < h->n_elements; i++) {
        const ply_element *e = &h->element[i];
        if (e->kind == PLY_VERTEX && !(has_role(h, e, PLY_X) && has_role(h, e, PLY_Y) && has_role(h, e, PLY_Z)))
            return il_fail(err, IL_E_INPUT, w->lines.line, "the element 'vertex' lacks x, y or z");
        if (e->kind == PLY_FACE && !has_role(h, e, PLY_CORNERS))
            return il_fail(err, IL_E_INPUT, w->lines.line, "the element 'face' lacks the list 'vertex_indices'");
    }
    return IL_OK;
}

static il_status read_line(ply_header *h, il_words *w, bool *at_end, il_error *err)
{
    il_word word = il_words_in_line(w);
    *at_end = il_word_is(word, "end_header");
    if (*at_end)
        return finish(h, w, err);
    if (il_word_is(word, "format"))
        return read_format(h, w, err);
    if (il_word_is(word, "element"))
        return read_element(h, w, err);
    if (il_word_is(word, "property"))
        return read_property(h, w, err);
    if (il_word_is(word, "comment") || il_word_is(word, "obj_info") || (word.n == 0 && w->at == w->end))
        return IL_OK;
    return fail(w, "not a line of a PLY header", word, err);
}

/* Its first line, "ply", is known to be there. */
il_status il_ply_header_read(ply_header *h, il_words *w, il_error *err)
{
    for (bool at_end = false, first = true; !at_end; first = false) {
        bool more;
        il_status st = il_words_next_line(w, &more, err);
        if (st == IL_OK && !more)
            st = il_fail(err, IL_E_INPUT, w->lines.line, "the file ends in its header");
        if (st != IL_OK)
            return st;
        h->n_bytes += (uint64_t)(w->end - w->at) + 1 + (w->lines.had_cr ? 1 : 0);
        if (!first && (st = read_line(h, w, &at_end, err)) != IL_OK)
            return st;
    }
    return IL_OK;
}

void il_ply_header_free(ply_header *h)
{
    il_free(h->element);
    il_free(h->property);
    *h = (ply_header){ 0 };
}
