#include "config.h"
#include "input/csv-record.h"
#include "base/alloc.h"
#include "input/wkt.h"

#include <string.h>

static const char byte_order_mark[] = "\xEF\xBB\xBF";
enum { BOM = sizeof byte_order_mark - 1 };

void il_csv_init(il_csv *c, il_source *source, char separator, size_t max_line)
{
    *c = (il_csv){ .separator = separator };
    il_lines_init(&c->lines, source, max_line);
}

void il_csv_free(il_csv *c)
{
    il_lines_free(&c->lines);
    il_free(c->cell);
    il_free(c->buf);
    il_free(c->kept);
    *c = (il_csv){ 0 };
}

/* ---- lines -------------------------------------------------------------------- */

static bool is_blank(char ch)
{
    return ch == ' ' || ch == '\t' || ch == '\r';
}

/* Blanks around a cell; a tab that separates is none. */
static bool is_padding(const il_csv *c, char ch)
{
    return is_blank(ch) && (ch != c->separator || ch == ' ');
}

static bool is_letter(char ch)
{
    return (ch | 0x20) >= 'a' && (ch | 0x20) <= 'z';
}

static bool is_separator(const il_csv *c, char ch)
{
    return ch == c->separator || (c->separator == ' ' && ch == '\t');
}

static bool keep_comment(il_csv *c, const char *p, const char *end)
{
    size_t n = (size_t)(end - p);
    if (!il_grow(&c->kept, &c->cap_kept, n, 1))
        return false;
    memcpy(c->kept, p, n);
    c->comment = c->kept;
    c->n_comment = n;
    return true;
}

/* The first line of a record into c->text. */
static il_status first_line(il_csv *c, bool *more, il_error *err)
{
    for (c->comment = NULL, c->n_comment = 0;;) {
        il_status st = il_lines_next(&c->lines, &c->text, &c->n_text, err);
        *more = st == IL_OK && c->text;
        if (!*more)
            return st;
        if (c->lines.line == 1 && c->n_text >= BOM && memcmp(c->text, byte_order_mark, BOM) == 0) {
            c->text += BOM;
            c->n_text -= BOM;
        }
        const char *p = c->text, *end = c->text + c->n_text;
        while (p < end && is_blank(*p))
            p++;
        if (p < end && *p != '#')
            break;
        if (p < end && !keep_comment(c, p + 1, end))
            return il_fail_nomem(err);
    }
    c->line = c->lines.line;
    c->n_lines = 1;
    return IL_OK;
}

/* The record in memory of its own. */
static bool own(il_csv *c, size_t n)
{
    bool is_own = c->text == c->buf;
    if (!il_grow(&c->buf, &c->cap_buf, n, 1))
        return false;
    if (!is_own && c->n_text > 0)
        memcpy(c->buf, c->text, c->n_text);
    c->text = c->buf;
    return true;
}

/* The next line behind those that the record has already; *MORE is false when there is none. */
static il_status next_line(il_csv *c, bool *more, il_error *err)
{
    const char *p;
    size_t n;
    if (!own(c, c->n_text + 1))
        return il_fail_nomem(err);
    il_status st = il_lines_next(&c->lines, &p, &n, err);
    *more = st == IL_OK && p;
    if (!*more)
        return st;
    if (c->n_text + n + 1 > c->lines.max_line)
        return il_fail(err, IL_E_INPUT, c->line, "a record of more than %zu bytes: a quote or a bracket in it may not be closed",
                       c->lines.max_line);
    if (!own(c, c->n_text + n + 1))
        return il_fail_nomem(err);
    c->buf[c->n_text] = '\n';
    memcpy(c->buf + c->n_text + 1, p, n);
    c->n_text += n + 1;
    c->n_lines++;
    return IL_OK;
}

/* ---- cells --------------------------------------------------------------------- */

static il_status add_cell(il_csv *c, size_t begin, size_t n, long line, il_error *err)
{
    if (c->n == c->cap_cells && !il_grow(&c->cell, &c->cap_cells, c->n + 1, sizeof *c->cell))
        return il_fail_nomem(err);
    c->cell[c->n++] = (il_csv_cell){ .n = n, .begin = begin, .line = line };
    return IL_OK;
}

/* The input has ended inside of a cell. */
static il_status fail_cut(il_csv *c, const char *what, long line, il_error *err)
{
    c->is_cut = true;
    return c->takes_cut ? IL_OK : il_fail(err, IL_E_INPUT, line, "the file ends inside of %s that begin here", what);
}

/* Append the next line to the record, as the cell that begins in line BEGUN with WHAT
 * has not ended yet. */
static il_status need_line(il_csv *c, const char *what, long begun, bool *more, il_error *err)
{
    il_status st = next_line(c, more, err);
    return st == IL_OK && !*more ? fail_cut(c, what, begun, err) : st;
}

/* Find the quote that ends the cell from FROM on, and make one quote of two: *END is
 * the place of the last one, *N the length of the cell. */
static il_status find_quote(il_csv *c, size_t from, size_t *end, size_t *n, il_error *err)
{
    const long line = c->line + (long)c->n_lines - 1;
    size_t to = from, at = from;
    bool more = true, ends = false;
    il_status st = IL_OK;
    while (st == IL_OK && more && !ends) {
        const char *quote = at < c->n_text ? memchr(c->text + at, '"', c->n_text - at) : NULL;
        size_t found = quote ? (size_t)(quote - c->text) : c->n_text;
        bool is_two = quote && found + 1 < c->n_text && quote[1] == '"';
        size_t length = found - at + is_two;
        if (is_two && !own(c, c->n_text))
            return il_fail_nomem(err);
        if (to != at)
            memmove(c->buf + to, c->buf + at, length);
        to += length;
        at = found + 2u * is_two;
        ends = quote && !is_two;
        if (!quote)
            st = need_line(c, "quotes", line, &more, err);
    }
    *end = at;
    *n = to - from;
    return st;
}

/* Find the last bracket of the geometry that begins at FROM; *END is behind it. */
static il_status find_bracket(il_csv *c, size_t from, size_t *end, il_error *err)
{
    const long line = c->line + (long)c->n_lines - 1;
    size_t open = 0, at = 0, n;
    bool more = true;
    il_status st = IL_OK;
    while ((n = il_wkt_length(c->text + from, c->n_text - from, &open, &at)) == 0 && st == IL_OK && more)
        st = need_line(c, "brackets", line, &more, err);
    *end = n > 0 ? from + n : c->n_text;
    return st;
}

static size_t find_separator(const il_csv *c, size_t at)
{
    if (c->separator != ' ') {
        const char *p = c->text + at, *end = c->text + c->n_text;
        while (p < end && *p != c->separator)
            p++;
        return (size_t)(p - c->text);
    }
    while (at < c->n_text && !is_separator(c, c->text[at]))
        at++;
    return at;
}

/* Behind quotes and brackets at *AT only blanks may come before the separator. */
static il_status pass_padding(const il_csv *c, size_t *at, il_error *err)
{
    size_t i = *at;
    while (i < c->n_text && is_padding(c, c->text[i]) && !is_separator(c, c->text[i]))
        i++;
    *at = i;
    if (i == c->n_text || is_separator(c, c->text[i]))
        return IL_OK;
    size_t n = c->n_text - i;
    return il_fail(err, IL_E_INPUT, c->line + (long)c->n_lines - 1, "'%.*s' stands behind the end of a cell",
                   n < 30 ? (int)n : 30, c->text + i);
}

static il_status take_plain(il_csv *c, size_t from, size_t *at, il_error *err)
{
    size_t end = find_separator(c, from), last = end;
    *at = end;
    while (last > from && is_padding(c, c->text[last - 1]))
        last--;
    return add_cell(c, from, last - from, c->line + (long)c->n_lines - 1, err);
}

/* The cell from *AT on, which becomes the place behind it. */
static il_status take_cell(il_csv *c, size_t *at, il_error *err)
{
    const long line = c->line + (long)c->n_lines - 1;
    size_t from = *at, end = 0, n = 0;
    il_status st;
    while (from < c->n_text && is_padding(c, c->text[from]))
        from++;
    if (from < c->n_text && c->text[from] == '"') {
        st = find_quote(c, from + 1, &end, &n, err);
        *at = end + (end < c->n_text);
        if (st == IL_OK)
            st = add_cell(c, from + 1, n, line, err);
    } else if (from < c->n_text && is_letter(c->text[from]) && il_wkt_begins(c->text + from, c->n_text - from)) {
        st = find_bracket(c, from, at, err);
        if (st == IL_OK)
            st = add_cell(c, from, *at - from, line, err);
    } else {
        return take_plain(c, from, at, err);
    }
    return st == IL_OK ? pass_padding(c, at, err) : st;
}

static void set_texts(il_csv *c)
{
    for (size_t k = 0; k < c->n; k++)
        c->cell[k].text = c->text + c->cell[k].begin;
}

/* Behind the separator, or all blanks that separate. */
static size_t pass_separator(const il_csv *c, size_t at)
{
    at++;
    while (c->separator == ' ' && at < c->n_text && is_separator(c, c->text[at]))
        at++;
    return at;
}

/* Blanks at the end of a line separate nothing. */
static void trim_end(il_csv *c)
{
    while (c->separator == ' ' && c->n_text > 0 && is_blank(c->text[c->n_text - 1]))
        c->n_text--;
}

il_status il_csv_next(il_csv *c, bool *more, il_error *err)
{
    c->n = 0;
    c->is_cut = false;
    il_status st = first_line(c, more, err);
    if (st != IL_OK || !*more)
        return st;
    trim_end(c);
    for (size_t at = 0;;) {
        st = take_cell(c, &at, err);
        if (st != IL_OK || at >= c->n_text)
            break;
        at = pass_separator(c, at);
    }
    set_texts(c);
    return st;
}
