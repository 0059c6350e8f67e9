#include "config.h"
#include "base/source.h"
#include "base/alloc.h"

#include <string.h>

void il_lines_init(il_lines *l, il_source *source, size_t max_line)
{
    *l = (il_lines){ .source = source, .max_line = max_line };
}

void il_lines_free(il_lines *l)
{
    il_free(l->buf);
    *l = (il_lines){ 0 };
}

/* Append what the source gives next behind the bytes begin..end. */
static il_status read_more(il_lines *l, il_error *err)
{
    enum { LEAST = 65536 };
    if (l->begin > 0 && l->end == l->cap) {
        memmove(l->buf, l->buf + l->begin, l->end - l->begin);
        l->end -= l->begin;
        l->begin = 0;
    }
    size_t need = l->cap == 0 ? LEAST : l->end + 1;
    if (!il_grow(&l->buf, &l->cap, need, 1))
        return il_fail_nomem(err);
    size_t got;
    il_status st = il_source_read(l->source, l->buf + l->end, l->cap - l->end, &got, err);
    if (st == IL_OK) {
        l->end += got;
        l->at_end = got == 0;
    }
    return st;
}

/* Find the LF that ends the line at begin: *N bytes come before it.  At the end
 * of the input *N is all that is left.  Each byte is looked at once. */
static il_status find_end(il_lines *l, size_t *n, il_error *err)
{
    size_t seen = 0;
    for (;;) {
        size_t there = l->end - l->begin;
        const char *lf = there > seen ? memchr(l->buf + l->begin + seen, '\n', there - seen) : NULL;
        *n = lf ? (size_t)(lf - l->buf) - l->begin : there;
        if (lf || l->at_end)
            return IL_OK;
        seen = there;
        if (seen > l->max_line && seen - l->max_line > 1) /* one more may be the CR */
            return IL_OK;
        il_status st = read_more(l, err);
        if (st != IL_OK)
            return st;
    }
}

il_status il_lines_next(il_lines *l, const char **line, size_t *n, il_error *err)
{
    *line = NULL;
    *n = 0;
    size_t length;
    il_status st = find_end(l, &length, err);
    if (st != IL_OK)
        return st;
    if (length == 0 && l->begin == l->end)
        return IL_OK;
    const char *start = l->buf + l->begin;
    size_t ended = l->begin + length < l->end; /* there is an LF */
    l->had_cr = ended && length > 0 && start[length - 1] == '\r';
    size_t text = length - (l->had_cr ? 1 : 0);
    if (text > l->max_line) {
        st = il_fail(err, IL_E_INPUT, l->line + 1, "a line of more than %zu bytes", l->max_line);
        il_error_set_file(err, il_source_name(l->source));
        return st;
    }
    l->begin += length + ended;
    l->line++;
    *line = start;
    *n = text;
    return IL_OK;
}
