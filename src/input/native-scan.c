#include "config.h"
#include "input/native-scan.h"
#include "base/alloc.h"
#include "base/number.h"
#include "base/text.h"

#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static bool is_control(unsigned long c)
{
    return (c < 0x20 && c != '\t') || (c >= 0x7F && c < 0xA0);
}

/* The bytes of almost every line are these. */
static bool is_plain(char c)
{
    return c >= ' ' && c <= '~';
}

il_status il_scan_check(const il_scan *s, il_error *err)
{
    for (const char *p = s->p; p < s->end;) {
        if (is_plain(*p)) {
            p++;
            continue;
        }
        unsigned long c;
        size_t n = il_utf8_char(p, (size_t)(s->end - p), &c);
        if (n == 0)
            return il_fail(err, IL_E_INPUT, s->line, "the line is not UTF-8 (at byte %zu)", (size_t)(p - s->p) + 1);
        if (is_control(c))
            return il_fail(err, IL_E_INPUT, s->line, "the line has the control character U+%04lX", c);
        p += n;
    }
    return IL_OK;
}

static void skip_blanks(il_scan *s)
{
    while (s->p < s->end && is_blank(*s->p))
        s->p++;
}

bool il_scan_at_end(il_scan *s)
{
    skip_blanks(s);
    return s->p == s->end || *s->p == '#';
}

const char *il_scan_peek(il_scan *s, size_t *n)
{
    *n = 0;
    if (!il_scan_at_end(s))
        while (s->p + *n < s->end && !is_blank(s->p[*n]))
            ++*n;
    return s->p;
}

int il_scan_shown(size_t n)
{
    enum { MOST = 40 };
    return n < MOST ? (int)n : MOST;
}

il_status il_scan_choice(il_scan *s, const char *const *words, const char *what, int *choice, il_error *err)
{
    size_t n;
    const char *word = il_scan_peek(s, &n);
    if (n == 0)
        return il_fail(err, IL_E_INPUT, s->line, "%s is missing", what);
    for (int i = 0; words[i]; i++) {
        if (strlen(words[i]) == n && memcmp(words[i], word, n) == 0) {
            s->p += n;
            *choice = i;
            return IL_OK;
        }
    }
    return il_fail(err, IL_E_INPUT, s->line, "'%.*s' is not %s", il_scan_shown(n), word, what);
}

/* Why the next word is no number. */
static il_status no_number(il_scan *s, il_error *err)
{
    size_t n;
    const char *word = il_scan_peek(s, &n);
    if (n == 0)
        return il_fail(err, IL_E_INPUT, s->line, "a number is missing");
    return il_fail(err, IL_E_INPUT, s->line, "'%.*s' is not a finite number", il_scan_shown(n), word);
}

il_status il_scan_number(il_scan *s, double *value, il_error *err)
{
    skip_blanks(s);
    double v;
    size_t n = il_number_parse(s->p, (size_t)(s->end - s->p), &v);
    const char *after = s->p + n;
    if (n == 0 || (after < s->end && !is_blank(*after)))
        return no_number(s, err);
    if (!(v > -IL_NATIVE_BOUND && v < IL_NATIVE_BOUND))
        return il_fail(err, IL_E_INPUT, s->line, "%.*s is too large: magnitudes stay below 1e15",
                       il_scan_shown(n), s->p);
    s->p = after;
    *value = v;
    return IL_OK;
}

il_status il_scan_numbers(il_scan *s, double *to, size_t n, il_error *err)
{
    il_status st = IL_OK;
    for (size_t i = 0; st == IL_OK && i < n; i++)
        st = il_scan_number(s, &to[i], err);
    return st;
}

/* The N digits at P, or false when others are among them or MOST is exceeded. */
static bool digits_value(const char *p, size_t n, unsigned long most, unsigned long *value)
{
    unsigned long v = 0;
    for (size_t i = 0; i < n; i++) {
        if (p[i] < '0' || p[i] > '9')
            return false;
        unsigned long digit = (unsigned long)(p[i] - '0');
        if (v > (most - digit) / 10)
            return false;
        v = 10 * v + digit;
    }
    *value = v;
    return n > 0;
}

il_status il_scan_index(il_scan *s, uint32_t *value, il_error *err)
{
    size_t n;
    const char *word = il_scan_peek(s, &n);
    unsigned long v;
    if (n == 0)
        return il_fail(err, IL_E_INPUT, s->line, "an index or count is missing");
    if (!digits_value(word, n, UINT32_MAX, &v))
        return il_fail(err, IL_E_INPUT, s->line, "'%.*s' is not an index or count from 0 to 4294967295",
                       il_scan_shown(n), word);
    s->p += n;
    *value = (uint32_t)v;
    return IL_OK;
}

il_status il_scan_integer(il_scan *s, long least, long most, long *value, il_error *err)
{
    size_t n;
    const char *word = il_scan_peek(s, &n);
    size_t sign = n > 0 && *word == '-';
    unsigned long v, room = sign ? 0ul - (unsigned long)least : (unsigned long)most;
    if (n == 0)
        return il_fail(err, IL_E_INPUT, s->line, "an integer is missing");
    if (!digits_value(word + sign, n - sign, room, &v))
        return il_fail(err, IL_E_INPUT, s->line, "'%.*s' is not an integer from %ld to %ld",
                       il_scan_shown(n), word, least, most);
    s->p += n;
    *value = sign ? -(long)v : (long)v;
    return IL_OK;
}

il_status il_scan_end(il_scan *s, il_error *err)
{
    size_t n;
    const char *word = il_scan_peek(s, &n);
    if (n == 0)
        return IL_OK;
    return il_fail(err, IL_E_INPUT, s->line, "'%.*s' is too much on this line", il_scan_shown(n), word);
}

/* ---- strings --------------------------------------------------------------- */

static int hex_value(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Undo the escape at P, behind its backslash: its byte, and the bytes it takes
 * in *USED; 0 used for what is no escape. */
static char unescape(const char *p, const char *end, size_t *used)
{
    *used = p < end ? 1 : 0;
    if (p < end && (*p == '"' || *p == '\\'))
        return *p;
    if (p < end && *p == 'n')
        return '\n';
    *used = 0;
    if (end - p < 3 || *p != 'x')
        return 0;
    int high = hex_value(p[1]), low = hex_value(p[2]);
    if (high < 0 || low < 0)
        return 0;
    *used = 3;
    return (char)(16 * high + low);
}

/* Copy the string behind the opening quote to TO, which has room for the rest
 * of the line; S ends behind the closing quote. */
static il_status copy_string(il_scan *s, char *to, size_t *n, il_error *err)
{
    *n = 0;
    while (s->p < s->end && *s->p != '"') {
        char c = *s->p++;
        if (c == '\t')
            return il_fail(err, IL_E_INPUT, s->line, "a tab in a string is written \\x09");
        if (c == '\\') {
            size_t used;
            c = unescape(s->p, s->end, &used);
            if (used == 0)
                return il_fail(err, IL_E_INPUT, s->line,
                               "in strings there are the escapes \\\" \\\\ \\n \\xHH and no other");
            if (c == 0)
                return il_fail(err, IL_E_INPUT, s->line, "a string cannot hold NUL");
            s->p += used;
        }
        to[(*n)++] = c;
    }
    if (s->p == s->end)
        return il_fail(err, IL_E_INPUT, s->line, "the string has no closing quote");
    s->p++;
    if (s->p < s->end && !is_blank(*s->p))
        return il_fail(err, IL_E_INPUT, s->line, "a blank is missing behind the string");
    if (!il_utf8_valid(to, *n))
        return il_fail(err, IL_E_INPUT, s->line, "the string is not UTF-8");
    return IL_OK;
}

il_status il_scan_string(il_scan *s, char **text, il_error *err)
{
    *text = NULL;
    if (il_scan_at_end(s) || *s->p != '"')
        return il_fail(err, IL_E_INPUT, s->line, "a string in double quotes is missing");
    s->p++;
    char *to = il_alloc((size_t)(s->end - s->p) + 1, 1);
    if (!to)
        return il_fail_nomem(err);
    size_t n;
    il_status st = copy_string(s, to, &n, err);
    if (st != IL_OK) {
        il_free(to);
        return st;
    }
    to[n] = '\0';
    *text = to;
    return IL_OK;
}
