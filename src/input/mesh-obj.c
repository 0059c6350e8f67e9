/* mesh-obj.c - Wavefront OBJ: positions and faces; the rest is passed over. */
#include "config.h"
#include "input/mesh-parts.h"

/* Statements of the format that say nothing about the triangles. */
static const char *const passed_over[] = {
    "vn", "vt", "vp", "o", "g", "s", "mg", "p", "l", "usemtl", "mtllib", "usemap", "maplib", "lod", "bevel",
    "c_interp", "d_interp", "shadow_obj", "trace_obj", NULL };

/* Curves and free-form surfaces: a mesh with these left out would be another. */
static const char *const refused[] = { "cstype", "deg", "curv", "curv2", "surf", "bmat", "step", "call", "csh", NULL };

static bool is_listed(il_word word, const char *const *list)
{
    for (; *list; list++)
        if (il_word_is(word, *list))
            return true;
    return false;
}

static bool is_keyword(il_word word)
{
    return il_word_is(word, "v") || il_word_is(word, "f") || is_listed(word, passed_over) || is_listed(word, refused);
}

/* ---- telling it from others --------------------------------------------------- */

static bool is_blank(unsigned char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

bool il_mesh_obj_starts(const unsigned char *head, size_t n)
{
    size_t i = 0;
    for (;;) {
        while (i < n && is_blank(head[i]))
            i++;
        if (i == n || head[i] != '#')
            break;
        while (i < n && head[i] != '\n')
            i++;
    }
    size_t begin = i;
    while (i < n && !is_blank(head[i]))
        i++;
    return i < n && is_keyword((il_word){ (const char *)head + begin, i - begin });
}

/* ---- statements ------------------------------------------------------------------ */

/* A corner may name a vertex that comes later; the greatest such number, from
 * 1, and where it stands, are checked at the end. */
typedef struct obj {
    il_words words;
    il_mesh *mesh;
    size_t polygons;
    uint64_t greatest;
    long greatest_line;
} obj;

/* The next word of the statement, which a backslash carries on to the next line. */
static il_status next_word(obj *o, il_word *word, il_error *err)
{
    bool more = true;
    il_status st = IL_OK;
    *word = il_words_in_line(&o->words);
    while (st == IL_OK && more && word->n == 1 && *word->s == '\\') {
        st = il_words_next_line(&o->words, &more, err);
        *word = il_words_in_line(&o->words);
    }
    return st;
}

static il_status read_position(obj *o, il_error *err)
{
    double xyz[3];
    for (int k = 0; k < 3; k++) {
        il_word word;
        il_status st = next_word(o, &word, err);
        if (st != IL_OK)
            return st;
        if (!il_word_number(word, &xyz[k]))
            return il_fail_number(word, o->words.lines.line, err);
    }
    return il_mesh_file_add_vertex(o->mesh, xyz, err);
}

/* "I", "I/T", "I/T/N" or "I//N": the number I; 0 when it is none. */
static int64_t corner_number(il_word word)
{
    bool negative = word.n > 0 && word.s[0] == '-';
    int64_t number = 0;
    size_t i = negative;
    for (; i < word.n && word.s[i] >= '0' && word.s[i] <= '9'; i++)
        number = number < UINT32_MAX ? 10 * number + (word.s[i] - '0') : INT64_MAX / 2;
    for (size_t k = i; k < word.n; k++)
        if (word.s[i] != '/' || !(word.s[k] == '/' || word.s[k] == '-' || (word.s[k] >= '0' && word.s[k] <= '9')))
            return 0;
    return negative ? -number : number;
}

static il_status read_corner(obj *o, il_word word, il_fan *fan, il_error *err)
{
    int64_t n = (int64_t)o->mesh->n_vertices, number = corner_number(word);
    if (number < 0)
        number = n + 1 + number;
    if (number <= 0 || number >= UINT32_MAX)
        return il_fail(err, IL_E_INPUT, o->words.lines.line, "'%.*s' names no vertex", IL_WORD_SHOWN(word));
    if ((uint64_t)number > o->greatest) {
        o->greatest = (uint64_t)number;
        o->greatest_line = o->words.lines.line;
    }
    return il_fan_add(fan, (uint32_t)(number - 1), o->mesh, err);
}

static il_status read_face(obj *o, il_error *err)
{
    il_fan fan = { 0, 0, 0 };
    long line = o->words.lines.line;
    for (;;) {
        il_word word;
        il_status st = next_word(o, &word, err);
        if (st == IL_OK && word.n > 0)
            st = read_corner(o, word, &fan, err);
        if (st != IL_OK)
            return st;
        if (word.n == 0)
            break;
    }
    o->polygons += fan.n > 3;
    return fan.n < 3 ? il_fail(err, IL_E_INPUT, line, "a face of fewer than 3 corners") : IL_OK;
}

static il_status pass_over(obj *o, il_error *err)
{
    for (;;) {
        il_word word;
        il_status st = next_word(o, &word, err);
        if (st != IL_OK || word.n == 0)
            return st;
    }
}

static il_status read_statement(obj *o, il_error *err)
{
    il_word word = il_words_in_line(&o->words);
    if (word.n == 0 || *word.s == '#')
        return IL_OK;
    if (il_word_is(word, "v"))
        return read_position(o, err);
    if (il_word_is(word, "f"))
        return read_face(o, err);
    if (is_listed(word, passed_over))
        return pass_over(o, err);
    if (is_listed(word, refused))
        return il_fail(err, IL_E_INPUT, o->words.lines.line, "'%.*s': curves and free-form surfaces are not read",
                       IL_WORD_SHOWN(word));
    return il_fail(err, IL_E_INPUT, o->words.lines.line, "'%.*s' is no OBJ statement", IL_WORD_SHOWN(word));
}

il_status il_mesh_read_obj(il_source *source, il_mesh *out, size_t *polygons, il_error *err)
{
    obj o = { .mesh = out };
    bool more = true;
    il_words_init(&o.words, source);
    il_status st = il_words_next_line(&o.words, &more, err);
    while (st == IL_OK && more) {
        st = read_statement(&o, err);
        if (st == IL_OK)
            st = il_words_next_line(&o.words, &more, err);
    }
    if (st == IL_OK && o.greatest > out->n_vertices)
        st = il_fail(err, IL_E_INPUT, o.greatest_line, "a face names vertex %llu of %zu",
                     (unsigned long long)o.greatest, out->n_vertices);
    il_words_free(&o.words);
    *polygons = o.polygons;
    return st;
}
