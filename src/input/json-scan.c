/* json-scan.c - a pull parser for JSON: blanks, then one token, by what may stand there.
 *
 * The bytes at hand are followed by a zero, which no scan goes over, so that
 * the loops look at one table and no bound.  Where a scan stops at that zero and
 * not at one of the file, more is read, and it goes on where it was. */
#include "config.h"
#include "input/json-scan.h"
#include "base/alloc.h"
#include "base/text.h"
#include "base/number.h"

#include <string.h>

/* What may come next. */
enum { NOTHING, VALUE = 1, KEY = 2, COLON = 4, COMMA = 8, CLOSE = 16 };

/* What a byte is.  PLAIN: it stands for itself in a string.  WORD: part of a
 * number, of true, false and null, and of what is none of them, so that an error
 * can show it whole. */
enum { BLANK = 1, PLAIN = 2, WORD = 4 };

#define B BLANK
#define P PLAIN
#define W (PLAIN | WORD)
#define ROW W, W, W, W, W, W, W, W, W, W, W, W, W, W, W, W
static const unsigned char kind[256] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, B | P, B, 0, 0, B, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    B | P, W, 0, W, W, W, W, W, W, W, W, W, P, W, W, W, /* " , */
    W, W, W, W, W, W, W, W, W, W, P, W, W, W, W, W,     /* : */
    ROW,
    W, W, W, W, W, W, W, W, W, W, W, P, 0, P, W, W,     /* [ \ ] */
    W, W, W, W, W, W, W, W, W, W, W, W, W, W, W, W,
    W, W, W, W, W, W, W, W, W, W, W, P, W, P, W, W,     /* { } */
    ROW, ROW, ROW, ROW, ROW, ROW, ROW, ROW
};
#undef B
#undef P
#undef W
#undef ROW

void il_json_scan_init(il_json_scan *j, il_source *source, const il_read_options *options)
{
    *j = (il_json_scan){ .source = source, .max_token = options->max_line, .max_depth = options->max_depth,
                    .line = 1, .between = "", .expected = VALUE };
}

void il_json_scan_free(il_json_scan *j)
{
    il_free(j->buf);
    il_free(j->level);
    *j = (il_json_scan){ 0 };
}

/* ---- bytes ------------------------------------------------------------------ */

/* Append what the source gives next behind the bytes begin..end. */
static il_status read_more(il_json_scan *j, il_error *err)
{
    enum { LEAST = 65536 };
    j->after_lf = j->begin > 0 ? j->buf[j->begin - 1] == '\n' : j->after_lf;
    if (j->begin > 0 && (j->begin == j->end || j->end + 1 == j->cap)) {
        memmove(j->buf, j->buf + j->begin, j->end - j->begin);
        j->end -= j->begin;
        j->begin = 0;
    }
    if (!il_grow(&j->buf, &j->cap, j->cap == 0 ? LEAST : j->end + 2, 1))
        return il_fail_nomem(err);
    size_t got = 0;
    il_status st = il_source_read(j->source, j->buf + j->end, j->cap - 1 - j->end, &got, err);
    j->end += got;
    j->at_end = st == IL_OK && got == 0;
    j->buf[j->end] = '\0';
    return st;
}

/* Is the byte at P the zero behind the bytes at hand, with more to come? */
static bool needs_more(const il_json_scan *j, const char *p)
{
    return p == j->buf + j->end && !j->at_end;
}

/* Of a token that has N bytes by now. */
static il_status check_length(const il_json_scan *j, size_t n, il_error *err)
{
    if (n <= j->max_token)
        return IL_OK;
    return il_fail(err, IL_E_INPUT, j->line, "a string or number of more than %zu bytes", j->max_token);
}

static il_status read_token(il_json_scan *j, size_t n, il_error *err)
{
    il_status st = check_length(j, n, err);
    return st == IL_OK ? read_more(j, err) : st;
}

/* Before the first token: no byte order mark, and a word for the other UTFs. */
static il_status begin(il_json_scan *j, il_error *err)
{
    static const char mark[] = "\xef\xbb\xbf";
    il_status st = IL_OK;
    j->begun = true;
    while (st == IL_OK && j->end < 3 && !j->at_end)
        st = read_more(j, err);
    if (st != IL_OK)
        return st;
    const unsigned char *b = (const unsigned char *)j->buf;
    if (j->end >= 2 && (b[0] == 0 || b[1] == 0 || (b[0] >= 0xfe && b[1] >= 0xfe)))
        return il_fail(err, IL_E_INPUT, j->line, "the text is UTF-16 or UTF-32; JSON is UTF-8");
    if (j->end >= 3 && memcmp(j->buf, mark, 3) == 0)
        j->begin = 3;
    return IL_OK;
}

/* To the next byte that is no blank; *P is null when there is none. */
static il_status skip_blanks(il_json_scan *j, const char **p, il_error *err)
{
    long line = j->line;
    for (;;) {
        const char *at = j->buf + j->begin;
        for (; kind[(unsigned char)*at] & BLANK; at++)
            line += *at == '\n';
        j->begin = (size_t)(at - j->buf);
        j->line = line;
        if (!needs_more(j, at)) {
            *p = j->begin < j->end ? at : NULL;
            return IL_OK;
        }
        il_status st = read_more(j, err);
        if (st != IL_OK)
            return st;
    }
}

/* ---- numbers and words -------------------------------------------------------- */

static size_t skip_digits(const char *s, size_t n, size_t i)
{
    while (i < n && s[i] >= '0' && s[i] <= '9')
        i++;
    return i;
}

static size_t skip_sign(const char *s, size_t n, size_t i)
{
    return i < n && (s[i] == '-' || s[i] == '+') ? i + 1 : i;
}

static bool is_number(const char *s, size_t n)
{
    size_t from = skip_sign(s, n, 0), i = skip_digits(s, n, from), digits = i - from;
    if (i < n && s[i] == '.') {
        from = i + 1;
        i = skip_digits(s, n, from);
        digits += i - from;
    }
    if (i < n && (s[i] == 'e' || s[i] == 'E')) {
        from = skip_sign(s, n, i + 1);
        i = skip_digits(s, n, from);
        digits = i > from ? digits : 0;
    }
    return digits > 0 && i == n;
}

static bool is_without_value(const char *s, size_t n)
{
    return il_text_is(s, n, "NaN") || il_text_is(s, n, "Infinity") || il_text_is(s, n, "-Infinity");
}

static il_status take_word(il_json_scan *j, il_json_event *event, il_error *err)
{
    size_t n = 0;
    for (;;) {
        const char *at = j->buf + j->begin + n;
        while (kind[(unsigned char)*at] & WORD)
            at++;
        n = (size_t)(at - j->buf) - j->begin;
        if (!needs_more(j, at))
            break;
        il_status st = read_token(j, n, err);
        if (st != IL_OK)
            return st;
    }
    const char *s = j->buf + j->begin;
    j->text = s;
    j->n = n;
    j->begin += n;
    if (n > j->max_token)
        return check_length(j, n, err);
    if (is_number(s, n) || is_without_value(s, n))
        *event = IL_JSON_NUMBER;
    else if (il_text_is(s, n, "true"))
        *event = IL_JSON_TRUE;
    else if (il_text_is(s, n, "false"))
        *event = IL_JSON_FALSE;
    else if (il_text_is(s, n, "null"))
        *event = IL_JSON_NULL;
    else
        return il_fail(err, IL_E_INPUT, j->line, "'%.*s' is no value in JSON", (int)(n < 40 ? n : 40), s);
    return IL_OK;
}

bool il_json_scan_value(const il_json_scan *j, double *value)
{
    return il_number_parse(j->text, j->n, value) == j->n;
}

/* ---- strings ------------------------------------------------------------------- */

/* The four hex digits of "\uXXXX" at S; -1 when that is not what stands there. */
static long unicode_escape(const char *s, size_t n)
{
    long code = 0;
    if (n < 6 || s[0] != '\\' || s[1] != 'u')
        return -1;
    for (size_t i = 2; i < 6; i++) {
        int digit = il_hex_digit(s[i]);
        if (digit < 0)
            return -1;
        code = code << 4 | digit;
    }
    return code;
}

/* The character of the escape at S[0..N) to *CODE, for the halves of a surrogate
 * pair both of them; half a pair alone is U+FFFD.  Its length, 0 for no escape. */
static size_t parse_escape(const char *s, size_t n, unsigned long *code)
{
    static const char letters[] = "\"\\/bfnrt", meaning[] = "\"\\/\b\f\n\r\t";
    const char *letter = n >= 2 && s[1] ? strchr(letters, s[1]) : NULL;
    if (letter) {
        *code = (unsigned char)meaning[letter - letters];
        return 2;
    }
    long high = unicode_escape(s, n);
    if (high < 0)
        return 0;
    *code = (unsigned long)high;
    if (high < 0xd800 || high > 0xdfff)
        return 6;
    long low = high < 0xdc00 ? unicode_escape(s + 6, n - 6) : -1;
    bool is_pair = low >= 0xdc00 && low <= 0xdfff;
    *code = is_pair ? (unsigned long)(0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00)) : 0xfffd;
    return is_pair ? 12 : 6;
}

/* S[0..*N) without its escapes, in place: none is shorter than what it stands for. */
static il_status unescape(char *s, size_t *n, long line, il_error *err)
{
    char *to = s, *end = s + *n;
    for (char *from = s; from < end;) {
        if (*from != '\\') {
            *to++ = *from++;
            continue;
        }
        unsigned long code = 0;
        size_t left = (size_t)(end - from), used = parse_escape(from, left, &code);
        if (used == 0)
            return il_fail(err, IL_E_INPUT, line, "'%.*s' is no escape in JSON", (int)(left < 6 ? left : 6), from);
        from += used;
        to += il_utf8_encode(to, code);
    }
    *n = (size_t)(to - s);
    return IL_OK;
}

/* Length of the string that begins at j->begin, with both quotes. */
static il_status find_quote(il_json_scan *j, size_t *n, bool *has_escapes, il_error *err)
{
    *has_escapes = false;
    for (*n = 1;;) {
        const char *at = j->buf + j->begin + *n;
        while (kind[(unsigned char)*at] & PLAIN)
            at++;
        *n = (size_t)(at - j->buf) - j->begin;
        bool is_cut = *at == '\\' && at + 1 == j->buf + j->end && !j->at_end;
        if (needs_more(j, at) || is_cut) {
            il_status st = read_token(j, *n, err);
            if (st != IL_OK)
                return st;
        } else if (*at == '"') {
            return check_length(j, ++*n, err);
        } else if (*at == '\\' && at + 1 < j->buf + j->end) {
            *has_escapes = true;
            *n += 2;
        } else if (*at == '\n' || *at == '\r') {
            return il_fail(err, IL_E_INPUT, j->line, "the line ends inside a string");
        } else if (j->begin + *n < j->end && *at != '\\') {
            return il_fail(err, IL_E_INPUT, j->line, "a control character inside a string");
        } else {
            return il_fail(err, IL_E_INPUT, j->line, "the file ends inside a string: it was cut");
        }
    }
}

static il_status take_string(il_json_scan *j, il_error *err)
{
    size_t n;
    bool has_escapes;
    il_status st = find_quote(j, &n, &has_escapes, err);
    if (st != IL_OK)
        return st;
    char *s = j->buf + j->begin + 1;
    j->begin += n;
    n -= 2;
    if (has_escapes)
        st = unescape(s, &n, j->line, err);
    j->text = s;
    j->n = n;
    return st;
}

/* ---- brackets ---------------------------------------------------------------------- */

static bool in_object(const il_json_scan *j)
{
    return j->depth > 0 && j->level[j->depth - 1].close == '}';
}

static il_status open_level(il_json_scan *j, char close, il_error *err)
{
    if (j->depth >= j->max_depth)
        return il_fail(err, IL_E_INPUT, j->line, "objects and arrays nested more than %zu deep", j->max_depth);
    if (!il_grow(&j->level, &j->cap_levels, j->depth + 1, sizeof *j->level))
        return il_fail_nomem(err);
    j->level[j->depth++] = (struct il_json_scan_level){ j->line, close };
    j->expected = (close == '}' ? KEY : VALUE) | CLOSE;
    return IL_OK;
}

/* What follows a value that is complete. */
static unsigned after_value(const il_json_scan *j)
{
    return j->depth > 0 ? COMMA | CLOSE : VALUE;
}

/* ---- tokens ------------------------------------------------------------------------ */

static const char *words_for(const il_json_scan *j)
{
    bool object = in_object(j);
    switch (j->expected) {
    case VALUE | CLOSE: return "a value or ']'";
    case KEY | CLOSE:   return "a key in quotes or '}'";
    case KEY:           return "a key in quotes";
    case COLON:         return "':'";
    case COMMA | CLOSE: return object ? "',' or '}'" : "',' or ']'";
    default:            return "a value";
    }
}

/* Shows as much of what stands there however the input comes in. */
static il_status fail_unexpected(il_json_scan *j, il_error *err)
{
    enum { SHOWN = 20 };
    il_status st = IL_OK;
    while (st == IL_OK && j->end - j->begin < SHOWN && !j->at_end)
        st = read_more(j, err);
    if (st != IL_OK)
        return st;
    const char *p = j->buf + j->begin;
    size_t n = 0, left = j->end - j->begin;
    if (*p == '\0')
        return il_fail(err, IL_E_INPUT, j->line, "%s is expected, not a zero byte", words_for(j));
    while (n < left && n < SHOWN && p[n] != '\n' && p[n] != '\r')
        n++;
    return il_fail(err, IL_E_INPUT, j->line, "%s is expected, not '%.*s'", words_for(j), (int)n, p);
}

/* An LF at the very end ends the last line and begins no other. */
static il_status at_end(il_json_scan *j, il_json_event *event, il_error *err)
{
    bool after_lf = j->begin > 0 ? j->buf[j->begin - 1] == '\n' : j->after_lf;
    if (j->expected != NOTHING && after_lf)
        j->line--;
    *event = IL_JSON_END;
    if (j->depth == 0) {
        j->expected = NOTHING;
        return IL_OK;
    }
    return il_fail(err, IL_E_INPUT, j->line, "the file ends inside the %s that begins in line %ld: it was cut",
                   in_object(j) ? "object" : "array", j->level[j->depth - 1].line);
}

/* A value or key begins at P. */
static il_status take_value(il_json_scan *j, const char *p, il_json_event *event, il_error *err)
{
    bool is_key = j->expected & KEY;
    il_status st;
    if (*p == '{' || *p == '[') {
        *event = *p == '{' ? IL_JSON_OBJECT : IL_JSON_ARRAY;
        j->begin++;
        return open_level(j, *p == '{' ? '}' : ']', err);
    }
    if (*p == '"') {
        *event = is_key ? IL_JSON_KEY : IL_JSON_STRING;
        st = take_string(j, err);
    } else {
        st = take_word(j, event, err);
    }
    j->expected = is_key ? COLON : after_value(j);
    return st;
}

/* Take ',' and ':', which are no events, and bytes between values. */
static bool take_separator(il_json_scan *j, char c)
{
    if (c == ',' && j->expected & COMMA)
        j->expected = in_object(j) ? KEY : VALUE;
    else if (c == ':' && j->expected & COLON)
        j->expected = VALUE;
    else if (j->depth > 0 || !c || !strchr(j->between, c))
        return false;
    j->begin++;
    return true;
}

static bool may_begin(const il_json_scan *j, char c)
{
    if (j->expected & VALUE)
        return c == '{' || c == '[' || c == '"' || kind[(unsigned char)c] & WORD;
    return j->expected & KEY && c == '"';
}

/* To the next event. */
static il_status step(il_json_scan *j, il_json_event *event, il_error *err)
{
    for (;;) {
        const char *p;
        il_status st = skip_blanks(j, &p, err);
        if (st != IL_OK)
            return st;
        if (!p)
            return at_end(j, event, err);
        if (take_separator(j, *p))
            continue;
        if (may_begin(j, *p))
            return take_value(j, p, event, err);
        if (!(j->expected & CLOSE) || *p != j->level[j->depth - 1].close)
            return fail_unexpected(j, err);
        *event = *p == '}' ? IL_JSON_OBJECT_END : IL_JSON_ARRAY_END;
        j->begin++;
        j->depth--;
        j->expected = after_value(j);
        return IL_OK;
    }
}

/* Behind the number at S, whose bytes end in a zero; null where none is. */
static const char *pass_number(const char *s)
{
    s += *s == '-' || *s == '+';
    const char *from = s;
    while (*s >= '0' && *s <= '9')
        s++;
    ptrdiff_t digits = s - from;
    if (*s == '.') {
        from = ++s;
        while (*s >= '0' && *s <= '9')
            s++;
        digits += s - from;
    }
    return digits > 0 ? s : NULL;
}

/* A comma and one more number in an array, which is most of a file of coordinates:
 * 763 MB/s, where the long way has 248.  That has the rest: exponents, words, the
 * end of the bytes at hand.  False, and nothing is taken, when it is for that. */
static bool take_next_number(il_json_scan *j)
{
    const char *s = j->buf + j->begin;
    long line = j->line;
    if (j->expected != (COMMA | CLOSE) || *s != ',' || in_object(j))
        return false;
    for (s++; kind[(unsigned char)*s] & BLANK; s++)
        line += *s == '\n';
    const char *end = pass_number(s);
    if (!end || kind[(unsigned char)*end] & WORD || end == j->buf + j->end || (size_t)(end - s) > j->max_token)
        return false;
    j->text = s;
    j->n = (size_t)(end - s);
    j->line = line;
    j->begin = (size_t)(end - j->buf);
    return true;
}

il_status il_json_scan_next(il_json_scan *j, il_json_event *event, il_error *err)
{
    if (j->begun && take_next_number(j)) {
        *event = IL_JSON_NUMBER;
        return IL_OK;
    }
    il_status st = j->begun ? IL_OK : begin(j, err);
    if (st == IL_OK)
        st = step(j, event, err);
    if (st == IL_E_INPUT)
        il_error_set_file(err, il_source_name(j->source));
    return st;
}

il_status il_json_scan_skip(il_json_scan *j, il_json_event event, il_error *err)
{
    il_status st = event == IL_JSON_KEY ? il_json_scan_next(j, &event, err) : IL_OK;
    if (st != IL_OK || (event != IL_JSON_OBJECT && event != IL_JSON_ARRAY))
        return st;
    for (size_t outside = j->depth - 1; st == IL_OK && j->depth > outside;)
        st = il_json_scan_next(j, &event, err);
    return st;
}

size_t il_json_skip_blanks(const char *s, size_t n, size_t i)
{
    while (i < n && kind[(unsigned char)s[i]] & BLANK)
        i++;
    return i;
}

size_t il_json_behind(const char *s, size_t n, size_t i, char c)
{
    i = il_json_skip_blanks(s, n, i);
    return i < n && s[i] == c ? i + 1 : 0;
}
