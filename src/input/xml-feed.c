#include "config.h"
#include "input/xml-feed.h"
#include "base/alloc.h"
#include "base/text.h"

#include <string.h>

enum { BLOCK = 65536 };

void il_xml_feed_init(il_xml_feed *f, il_source *source, size_t max_token)
{
    *f = (il_xml_feed){ .source = source, .max_token = max_token, .line = 1, .at_start = true };
}

void il_xml_feed_free(il_xml_feed *f)
{
    il_free(f->buf);
    il_xml_feed_init(f, f->source, f->max_token);
}

/* ---- the buffer -------------------------------------------------------------- */

/* Get more bytes behind those at hand.  What is left is moved to the front
 * first, which is less than a block except inside a long token, which stays at
 * the front: so every byte is moved once or twice. */
static il_status fill(il_xml_feed *f, il_error *err)
{
    if (f->end - f->begin > f->max_token)
        return il_fail(err, IL_E_INPUT, f->line, "more than %zu bytes between '<' and its end", f->max_token);
    if (f->begin > 0) {
        memmove(f->buf, f->buf + f->begin, f->end - f->begin);
        f->end -= f->begin;
        f->begin = 0;
    }
    if (!il_grow(&f->buf, &f->cap, f->end + BLOCK, 1))
        return il_fail_nomem(err);
    size_t got = 0;
    il_status st = il_source_read(f->source, f->buf + f->end, BLOCK, &got, err);
    f->end += got;
    f->at_end = st == IL_OK && got == 0;
    return st;
}

static const char *unread(const il_xml_feed *f, size_t *n)
{
    *n = f->end - f->begin;
    return f->buf + f->begin;
}

/* Make at least N bytes ready unless the input ends before. */
static il_status need(il_xml_feed *f, size_t n, il_error *err)
{
    il_status st = IL_OK;
    while (st == IL_OK && !f->at_end && f->end - f->begin < n)
        st = fill(f, err);
    return st;
}

/* ---- where tokens end --------------------------------------------------------- */

/* Each finds the end of the token at S[0..N), going on at f->scanned: its
 * length, or 0 when it is not there yet. */
typedef size_t find_end(il_xml_feed *f, const char *s, size_t n);

static size_t find_after(il_xml_feed *f, const char *s, size_t n, size_t from, const char *mark)
{
    size_t len = strlen(mark);
    for (size_t i = f->scanned > from ? f->scanned : from; i + len <= n; i++) {
        if (memcmp(s + i, mark, len) == 0)
            return i + len;
        f->scanned = i;
    }
    return 0;
}

static size_t comment_end(il_xml_feed *f, const char *s, size_t n) { return find_after(f, s, n, 4, "-->"); }
static size_t cdata_end(il_xml_feed *f, const char *s, size_t n) { return find_after(f, s, n, 9, "]]>"); }
static size_t instruction_end(il_xml_feed *f, const char *s, size_t n) { return find_after(f, s, n, 2, "?>"); }

/* The end of a quoted value that goes on at S[I..N): behind its quote, at a '<'
 * before that, or N.  Values are nearly all of a file, hence memchr. */
static size_t value_end(il_xml_feed *f, const char *s, size_t n, size_t i)
{
    const char *quote = memchr(s + i, f->quote, n - i);
    size_t end = quote ? (size_t)(quote - s) : n;
    const char *mark = memchr(s + i, '<', end - i);
    if (mark)
        return (size_t)(mark - s);
    if (quote)
        f->quote = '\0';
    return quote ? end + 1 : n;
}

/* A tag ends at the first '>' outside quotes.  '<' cannot stand in one: it ends
 * there, for the caller to refuse. */
static size_t tag_end(il_xml_feed *f, const char *s, size_t n)
{
    size_t i = f->scanned > 1 ? f->scanned : 1;
    while (i < n) {
        char c = s[i];
        if (c == '<')
            return i;
        if (f->quote) {
            i = value_end(f, s, n, i);
            continue;
        }
        i++;
        if (c == '>')
            return i;
        if (c == '"' || c == '\'') {
            f->quote = c;
            f->n_attributes++;
        }
    }
    f->scanned = i;
    return 0;
}

/* A document type ends at the '>' outside its quotes, its comments and its
 * subset in brackets. */
static size_t doctype_end(il_xml_feed *f, const char *s, size_t n)
{
    size_t i = f->scanned > 2 ? f->scanned : 2;
    for (; i < n; i++) {
        char c = s[i];
        if (f->quote == '-')
            f->quote = c == '>' && s[i - 1] == '-' && s[i - 2] == '-' ? '\0' : '-';
        else if (f->quote)
            f->quote = c == f->quote ? '\0' : f->quote;
        else if (c == '"' || c == '\'')
            f->quote = c;
        else if (c == '-' && i > 2 && memcmp(s + i - 3, "<!--", 4) == 0)
            f->quote = '-';
        else if (c == '[' || c == ']')
            f->depth += c == '[' ? 1 : -1;
        else if (c == '>' && f->depth <= 0)
            return i + 1;
    }
    f->scanned = i;
    return 0;
}

/* ---- tokens -------------------------------------------------------------------- */

static long count_lines(const char *s, size_t n)
{
    long lines = 0;
    for (const char *p = s, *end = s + n; (p = memchr(p, '\n', (size_t)(end - p))) != NULL; p++)
        lines++;
    return lines;
}

/* The N bytes at hand as a token. */
static void take(il_xml_feed *f, il_xml_token *t, il_xml_token_kind kind, size_t n)
{
    *t = (il_xml_token){ kind, f->buf + f->begin, n, f->line, count_lines(f->buf + f->begin, n) };
    f->begin += n;
    f->line += t->n_lines;
    f->at_start = false;
    f->scanned = f->n_attributes = 0;
    f->depth = 0;
    f->quote = '\0';
}

typedef struct markup {
    const char *begin;
    find_end *end;
    il_xml_token_kind kind;
} markup;

/* What begins with '<' there; the most general last. */
static const markup markups[] = {
    { "<!--", comment_end, IL_XML_TOKEN_SKIPPED },
    { "<![CDATA[", cdata_end, IL_XML_TOKEN_TAG },
    { "<!DOCTYPE", doctype_end, IL_XML_TOKEN_SKIPPED },
    { "<?", instruction_end, IL_XML_TOKEN_SKIPPED },
    { "<", tag_end, IL_XML_TOKEN_TAG },
};

static const markup *markup_at(const char *s, size_t n)
{
    const markup *m = markups, *tag = markups + sizeof markups / sizeof *markups - 1;
    if (n > 1 && s[1] != '!' && s[1] != '?') /* nearly all */
        return tag;
    while (!il_text_begins(s, n, m->begin))
        m++;
    return m;
}

static il_status check_markup(const il_xml_feed *f, const markup *m, const char *s, size_t n, il_error *err)
{
    long line = f->line + count_lines(s, n);
    if (m->end == tag_end && s[n - 1] != '>')
        return il_fail(err, IL_E_INPUT, line, "'<' inside a tag");
    if (m->end == tag_end && f->n_attributes > IL_XML_MAX_ATTRIBUTES)
        return il_fail(err, IL_E_INPUT, f->line, "a tag with more than %d attributes", IL_XML_MAX_ATTRIBUTES);
    if (m->end == doctype_end && il_text_contains(s, n, "<!ENTITY"))
        return il_fail(err, IL_E_INPUT, f->line, "the document type declares entities, which are not taken: remove it");
    return IL_OK;
}

static il_status next_markup(il_xml_feed *f, il_xml_token *t, il_error *err)
{
    size_t n, length = 0;
    const char *s = unread(f, &n);
    const markup *m = markup_at(s, n);
    il_status st = IL_OK;
    while ((length = m->end(f, s, n)) == 0) {
        if (f->at_end)
            return il_fail(err, IL_E_INPUT, f->line, "the file ends inside what begins with '%.*s'",
                           (int)(n < 20 ? n : 20), s);
        st = fill(f, err);
        if (st != IL_OK)
            return st;
        s = unread(f, &n);
    }
    st = check_markup(f, m, s, length, err);
    bool declares = f->at_start && m->end == instruction_end && il_text_begins(s, length, "<?xml") &&
                    length > 5 && il_xml_is_blank(s[5]);
    if (st == IL_OK)
        take(f, t, declares ? IL_XML_TOKEN_DECLARATION : m->kind, length);
    return st;
}

/* How much of the text S[0..N) can go while there is more to come: up to a
 * reference that may go on.  (A character may be cut, libxml2 waits for the rest.) */
static size_t whole_text(const char *s, size_t n)
{
    enum { LONGEST_REFERENCE = 12 };
    size_t end = n, from = n > LONGEST_REFERENCE ? n - LONGEST_REFERENCE : 0;
    while (end > from && s[end - 1] != '&' && s[end - 1] != ';')
        end--;
    return end > from && s[end - 1] == '&' ? end - 1 : n;
}

static il_status next_text(il_xml_feed *f, il_xml_token *t, il_error *err)
{
    size_t n;
    const char *s = unread(f, &n), *mark = memchr(s, '<', n);
    size_t length = mark ? (size_t)(mark - s) : f->at_end ? n : whole_text(s, n);
    if (length == 0) { /* nothing but that: get more, and take it as it is */
        il_status st = need(f, n + 1, err);
        if (st != IL_OK)
            return st;
        s = unread(f, &n);
        mark = memchr(s, '<', n);
        length = mark ? (size_t)(mark - s) : n;
    }
    take(f, t, IL_XML_TOKEN_TEXT, length);
    return IL_OK;
}

/* A byte order mark is dropped; wide characters would look like text. */
static il_status begin(il_xml_feed *f, il_error *err)
{
    size_t n;
    il_status st = need(f, 4, err);
    if (st != IL_OK)
        return st;
    const char *s = unread(f, &n);
    if (il_text_begins(s, n, "\xEF\xBB\xBF"))
        f->begin += 3;
    else if (n >= 2 && (il_text_begins(s, n, "\xFE\xFF") || il_text_begins(s, n, "\xFF\xFE") || s[0] == '\0' || s[1] == '\0'))
        return il_fail(err, IL_E_INPUT, 1, "UTF-16 or binary data; XML is read as UTF-8");
    return IL_OK;
}

il_status il_xml_feed_next(il_xml_feed *f, il_xml_token *t, il_error *err)
{
    enum { LONGEST_MARK = 9 }; /* <![CDATA[ and <!DOCTYPE */
    il_status st = f->at_start ? begin(f, err) : IL_OK;
    if (st == IL_OK)
        st = need(f, LONGEST_MARK, err);
    if (st != IL_OK)
        return st;
    size_t n;
    const char *s = unread(f, &n);
    if (n == 0) {
        *t = (il_xml_token){ IL_XML_TOKEN_END, NULL, 0, f->line, 0 };
        return IL_OK;
    }
    return s[0] == '<' ? next_markup(f, t, err) : next_text(f, t, err);
}

/* ---- places inside a tag ---------------------------------------------------------- */

/* The next attribute at S[*AT..N): its name without prefix, its value; false at
 * the tag's end or where it is malformed. */
static bool next_attribute(const char *s, size_t n, size_t *at, const char **name, size_t *n_name,
                           const char **value, size_t *n_value)
{
    size_t i = *at;
    while (i < n && il_xml_is_blank(s[i]))
        i++;
    *name = s + i;
    for (; i < n && s[i] != '=' && !il_xml_is_blank(s[i]) && s[i] != '>' && s[i] != '/'; i++)
        if (s[i] == ':')
            *name = s + i + 1;
    *n_name = (size_t)(s + i - *name);
    while (i < n && (s[i] == '=' || il_xml_is_blank(s[i])))
        i++;
    if (i >= n || (s[i] != '"' && s[i] != '\''))
        return false;
    const char *end = memchr(s + i + 1, s[i], n - i - 1);
    if (!end)
        return false;
    *value = s + i + 1;
    *n_value = (size_t)(end - *value);
    *at = (size_t)(end - s) + 1;
    return true;
}

/* Line ends before byte OFFSET of the parsed value whose raw text is S[0..N). */
static long lines_before(const char *s, size_t n, size_t offset)
{
    long lines = 0;
    for (size_t i = 0; i < n && offset > 0; offset--) {
        if (s[i] == '\r' && i + 1 < n && s[i + 1] == '\n')
            i++;
        lines += s[i] == '\n' ? 1 : 0;
        const char *reference = s[i] == '&' ? memchr(s + i, ';', n - i) : NULL;
        i = reference ? (size_t)(reference - s) + 1 : i + 1;
    }
    return lines;
}

long il_xml_token_line(const il_xml_token *t, const char *wanted, size_t offset)
{
    const char *name, *value;
    size_t at = 1, n_name, n_value;
    while (at < t->n && !il_xml_is_blank(t->s[at]))
        at++;
    while (next_attribute(t->s, t->n, &at, &name, &n_name, &value, &n_value))
        if (n_name == strlen(wanted) && memcmp(name, wanted, n_name) == 0)
            return t->line + count_lines(t->s, (size_t)(value - t->s)) + lines_before(value, n_value, offset);
    return t->line;
}
