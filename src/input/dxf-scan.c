#include "config.h"
#include "input/dxf-scan.h"
#include "base/number.h"

#include <string.h>

void il_dxf_scan_init(il_dxf_scan *s, il_source *source, size_t max_line)
{
    *s = (il_dxf_scan){ .code = -1 };
    il_lines_init(&s->lines, source, max_line);
}

void il_dxf_scan_free(il_dxf_scan *s)
{
    il_lines_free(&s->lines);
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* The next line without the blanks around it. */
static il_status next_line(il_dxf_scan *s, const char **text, size_t *n, il_error *err)
{
    il_status st = il_lines_next(&s->lines, text, n, err);
    if (st != IL_OK || !*text)
        return st;
    if (s->lines.line == 1 && *n >= 3 && memcmp(*text, "\xEF\xBB\xBF", 3) == 0)
        *text += 3, *n -= 3;
    while (*n > 0 && is_blank(**text))
        ++*text, --*n;
    while (*n > 0 && is_blank((*text)[*n - 1]))
        --*n;
    return IL_OK;
}

static il_status fail_cut(const il_dxf_scan *s, il_error *err)
{
    return il_fail(err, IL_E_INPUT, s->lines.line, "the file is cut short: it ends without EOF");
}

/* A whole number of up to four digits. */
static bool parse_code(const char *s, size_t n, int *code)
{
    bool is_negative = n > 0 && *s == '-';
    int value = 0;
    s += is_negative, n -= is_negative;
    if (n < 1 || n > 4)
        return false;
    for (size_t i = 0; i < n; i++) {
        if (s[i] < '0' || s[i] > '9')
            return false;
        value = 10 * value + s[i] - '0';
    }
    *code = is_negative ? -value : value;
    return true;
}

static il_status next_pair(il_dxf_scan *s, il_error *err)
{
    const char *text;
    size_t n;
    il_status st = next_line(s, &text, &n, err);
    if (st != IL_OK || !text)
        return st == IL_OK ? fail_cut(s, err) : st;
    s->line = s->lines.line;
    if (!parse_code(text, n, &s->code))
        return il_fail(err, IL_E_INPUT, s->line, "'%.*s' is no group code", n < 40 ? (int)n : 40, text);
    st = next_line(s, &s->value, &s->n, err);
    return st == IL_OK && !s->value ? fail_cut(s, err) : st;
}

il_status il_dxf_next(il_dxf_scan *s, il_error *err)
{
    enum { COMMENT = 999 };
    il_status st;
    while ((st = next_pair(s, err)) == IL_OK && s->code == COMMENT)
        continue;
    return st;
}

bool il_dxf_is(const il_dxf_scan *s, int code, const char *text)
{
    return s->code == code && strlen(text) == s->n && memcmp(s->value, text, s->n) == 0;
}

il_status il_dxf_number(const il_dxf_scan *s, double *value, il_error *err)
{
    if (s->n > 0 && il_number_parse(s->value, s->n, value) == s->n)
        return IL_OK;
    return il_fail(err, IL_E_INPUT, s->line + 1, "'%.*s' is no finite number (group %d)",
                   s->n < 40 ? (int)s->n : 40, s->value, s->code);
}

il_status il_dxf_expect_end(il_dxf_scan *s, il_error *err)
{
    const char *text;
    size_t n;
    il_status st;
    while ((st = next_line(s, &text, &n, err)) == IL_OK && text)
        if (n > 1 || (n == 1 && *text != '\x1A'))
            return il_fail(err, IL_E_INPUT, s->lines.line, "something follows the EOF");
    return st;
}
