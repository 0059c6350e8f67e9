#include "config.h"
#include "input/mesh-parts.h"
#include "base/alloc.h"
#include "base/number.h"

#include <math.h>
#include <string.h>
#include <strings.h>

enum { MAX_LINE = 64 * 1024 * 1024, BLOCK = 65536 };

/* ---- words ---------------------------------------------------------------- */

static bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

void il_words_init(il_words *w, il_source *source)
{
    il_lines_init(&w->lines, source, MAX_LINE);
    w->at = w->end = NULL;
}

void il_words_free(il_words *w)
{
    il_lines_free(&w->lines);
}

il_word il_words_in_line(il_words *w)
{
    while (w->at < w->end && is_blank(*w->at))
        w->at++;
    il_word word = { w->at, 0 };
    while (w->at < w->end && !is_blank(*w->at))
        w->at++;
    word.n = (size_t)(w->at - word.s);
    return word;
}

il_status il_words_next_line(il_words *w, bool *more, il_error *err)
{
    const char *line;
    size_t n;
    il_status st = il_lines_next(&w->lines, &line, &n, err);
    *more = st == IL_OK && line;
    w->at = *more ? line : "";
    w->end = w->at + (*more ? n : 0);
    return st;
}

il_status il_words_next(il_words *w, il_word *word, il_error *err)
{
    il_status st = IL_OK;
    bool more = true;
    *word = w->at ? il_words_in_line(w) : (il_word){ "", 0 };
    while (st == IL_OK && more && word->n == 0) {
        st = il_words_next_line(w, &more, err);
        *word = il_words_in_line(w);
    }
    return st;
}

bool il_word_is(il_word word, const char *s)
{
    return strlen(s) == word.n && strncasecmp(word.s, s, word.n) == 0;
}

bool il_coordinate_fits(double c)
{
    return fabs(c) < 1e15; /* false for what is not a number */
}

bool il_word_number(il_word word, double *value)
{
    return word.n > 0 && il_number_parse(word.s, word.n, value) == word.n && il_coordinate_fits(*value);
}

il_status il_fail_number(il_word word, long line, il_error *err)
{
    if (word.n == 0)
        return il_fail(err, IL_E_INPUT, line, "a number is missing");
    return il_fail(err, IL_E_INPUT, line, "'%.*s' is not a finite number below 1e15", IL_WORD_SHOWN(word));
}

/* ---- bytes ---------------------------------------------------------------- */

il_status il_bytes_init(il_bytes *b, il_source *source, uint64_t offset, const void *rest, size_t n, il_error *err)
{
    *b = (il_bytes){ .source = source, .offset = offset };
    b->cap = n > BLOCK ? n : BLOCK;
    b->buf = il_alloc(b->cap, 1);
    if (!b->buf)
        return il_fail_nomem(err);
    if (n > 0)
        memcpy(b->buf, rest, n);
    b->end = n;
    return IL_OK;
}

void il_bytes_free(il_bytes *b)
{
    il_free(b->buf);
    b->buf = NULL;
}

il_status il_bytes_take(il_bytes *b, size_t n, const unsigned char **p, il_error *err)
{
    *p = NULL;
    size_t more = 1;
    while (b->end - b->begin < n && more > 0) {
        memmove(b->buf, b->buf + b->begin, b->end - b->begin);
        b->end -= b->begin;
        b->begin = 0;
        il_status st = il_source_read(b->source, b->buf + b->end, b->cap - b->end, &more, err);
        if (st != IL_OK)
            return st;
        b->end += more;
    }
    if (b->end - b->begin >= n) {
        *p = b->buf + b->begin;
        b->begin += n;
        b->offset += n;
    }
    return IL_OK;
}

uint32_t il_u32le_at(const unsigned char *p)
{
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

double il_f32le_at(const unsigned char *p)
{
    uint32_t bits = il_u32le_at(p);
    float f;
    memcpy(&f, &bits, sizeof f);
    return (double)f;
}

/* ---- meshes --------------------------------------------------------------- */

il_status il_mesh_file_add_vertex(il_mesh *m, const double xyz[3], il_error *err)
{
    if (m->n_vertices >= UINT32_MAX - 1)
        return il_fail(err, IL_E_INPUT, 0, "more than %lu vertices", (unsigned long)(UINT32_MAX - 1));
    if (!il_mesh_add_vertex(m, xyz, (il_origin){ -1, -1, -1, -1 }))
        return il_fail_nomem(err);
    return IL_OK;
}

il_status il_fan_add(il_fan *f, uint32_t corner, il_mesh *m, il_error *err)
{
    if (f->n == 0)
        f->first = corner;
    if (f->n >= 2 && m->n_triangles >= UINT32_MAX / 3)
        return il_fail(err, IL_E_INPUT, 0, "more than %lu triangles", (unsigned long)(UINT32_MAX / 3));
    if (f->n >= 2 && !il_mesh_add_triangle(m, f->first, f->last, corner))
        return il_fail_nomem(err);
    f->last = corner;
    f->n++;
    return IL_OK;
}
