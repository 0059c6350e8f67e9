#include "config.h"
#include "input/xml-push.h"
#include "base/alloc.h"
#include "base/text.h"

#include <libxml/parser.h>
#include <libxml/xmlerror.h>

#include <limits.h>
#include <string.h>

/* All is put inside an element of our own, so that a fragment with several
 * outermost elements is a document too.  Its tag has no line end. */
#define WRAPPER "isoloft-input"

/* Namespaces in scope: every prefix is looked up among them one by one. */
enum { MAX_NAMESPACES = 256 };

/* n_bound[depth]: namespaces declared at each depth, n_in_scope their sum. */
typedef struct driver {
    const il_xml_client *client;
    void *self;
    il_xml_feed feed;
    il_xml_token token;         /* what the parser is being fed */
    xmlParserCtxtPtr xml;
    bool in_wrapper, has_encoding;
    size_t n_tags;              /* start and end tags parsed, <a/> being both */
    long text_line;             /* where the next piece of text begins */
    int *n_bound, n_in_scope;
    size_t cap_bound, depth;
    char *scratch;              size_t cap_scratch;
    il_status status;
    il_error *err;
} driver;

/* ---- calls from libxml2 --------------------------------------------------------- */

/* Text comes late and in pieces, so its lines are counted from the last tag on. */
static void end_tag(driver *d)
{
    d->n_tags++;
    d->text_line = d->token.line + d->token.n_lines;
}

/* Keep the failure ST with its place.  Nothing more is done from here on; the
 * parser itself is not stopped, it has at most this token to end.
 * In text a reference to a line end looks like one, and so does a carriage return by
 * itself, which ends no line here: no line behind the token is meant. */
static void stop(driver *d, il_status st)
{
    long last = d->token.line + d->token.n_lines;
    if (st == IL_OK || d->status != IL_OK)
        return;
    d->status = st;
    if (!d->err || st != IL_E_INPUT)
        return;
    if (d->err->line == 0)
        d->err->line = d->client->place ? d->client->place(d->self, &d->token) : d->token.line;
    d->err->line = d->err->line < last ? d->err->line : last;
}

static il_status bind_namespaces(driver *d, int n)
{
    if (!il_grow(&d->n_bound, &d->cap_bound, d->depth + 1, sizeof *d->n_bound))
        return il_fail_nomem(d->err);
    d->n_bound[d->depth++] = n;
    d->n_in_scope += n;
    if (d->n_in_scope > MAX_NAMESPACES)
        return il_fail(d->err, IL_E_INPUT, d->token.line, "more than %d namespaces", MAX_NAMESPACES);
    return IL_OK;
}

static void on_start(void *self, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri,
                     int n_namespaces, const xmlChar **namespaces, int n_attributes, int n_defaulted,
                     const xmlChar **attributes)
{
    driver *d = self;
    (void)n_defaulted;
    end_tag(d);
    if (d->status != IL_OK)
        return;
    if (!d->in_wrapper) {
        d->in_wrapper = true;
        return;
    }
    il_xml_element e = { (const char *)name, (const char *)prefix, (const char *)uri, attributes, namespaces,
                         (size_t)n_attributes, (size_t)n_namespaces, d->token.line };
    il_status st = bind_namespaces(d, n_namespaces);
    stop(d, st == IL_OK ? d->client->start(d->self, &e, d->err) : st);
}

static void on_end(void *self, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri)
{
    driver *d = self;
    (void)name, (void)prefix, (void)uri;
    end_tag(d);
    if (d->status != IL_OK)
        return;
    if (d->depth == 0) { /* the file's own end tag of that name */
        stop(d, il_fail(d->err, IL_E_INPUT, d->token.line, "an end tag without its start tag"));
        return;
    }
    d->n_in_scope -= d->n_bound[--d->depth];
    stop(d, d->client->end(d->self, d->token.line, d->err));
}

static void on_text(void *self, const xmlChar *s, int n)
{
    driver *d = self;
    long line = d->text_line;
    for (const xmlChar *p = s, *end = s + n; (p = memchr(p, '\n', (size_t)(end - p))) != NULL; p++)
        d->text_line++;
    if (d->status == IL_OK)
        stop(d, d->client->text(d->self, (const char *)s, (size_t)n, line, d->err));
}

/* Called for what the parser finds, and for what libxml2 finds without one
 * (bytes that the encoding does not have), which it would print.
 * Unknown prefixes are no matter (the client sees them); whatever else libxml2
 * finds wrong ends the file.  The last end tag too many would close our element,
 * which is not to be named. */
static void on_error(void *self, xmlErrorPtr e)
{
    driver *d = self;
    if (!d->xml || e->level < XML_ERR_ERROR || e->domain == XML_FROM_NAMESPACE)
        return;
    const char *text = e->message ? e->message : "unknown error";
    long line = e->line > 0 ? e->line : d->token.line;
    if (e->code == XML_ERR_NO_MEMORY)
        stop(d, il_fail_nomem(d->err));
    else if (e->code == XML_ERR_TAG_NAME_MISMATCH && d->depth == 0)
        stop(d, il_fail(d->err, IL_E_INPUT, line, "an end tag without its start tag"));
    else
        stop(d, il_fail(d->err, IL_E_INPUT, line, "not well-formed: %.*s", (int)strcspn(text, "\n"), text));
}

/* ---- one file --------------------------------------------------------------------- */

static il_status new_parser(driver *d)
{
    xmlSAXHandler sax = { .initialized = XML_SAX2_MAGIC, .startElementNs = on_start, .endElementNs = on_end,
                          .characters = on_text, .ignorableWhitespace = on_text, .serror = on_error };
    d->xml = xmlCreatePushParserCtxt(&sax, d, NULL, 0, NULL);
    if (!d->xml)
        return il_fail_nomem(d->err);
    /* HUGE lifts libxml2's limits on depth and length, for which there are our
     * own.  Nothing loads a DTD, substitutes an entity or opens a connection:
     * the feed lets no document type through. */
    xmlCtxtUseOptions(d->xml, XML_PARSE_HUGE | XML_PARSE_NONET);
    return IL_OK;
}

static void push(driver *d, const char *s, size_t n)
{
    if (n > 0 && d->status == IL_OK && xmlParseChunk(d->xml, s, (int)n, 0) != 0 && d->status == IL_OK &&
        !d->xml->wellFormed)
        stop(d, il_fail(d->err, IL_E_INPUT, d->token.line, "not well-formed"));
}

/* As an instruction, which parts no text and gives no blanks. */
static void push_line_ends(driver *d, long n)
{
    if (n == 0)
        return;
    push(d, "<?x", 3);
    for (long k = 0; k < n; k++)
        push(d, "\n", 1);
    push(d, "?>", 2);
    d->text_line += n;
}

/* Text outside all elements is none of the format's, and would be lost. */
static il_status check_outside(const driver *d)
{
    const il_xml_token *t = &d->token;
    bool is_text = t->kind == IL_XML_TOKEN_TEXT || (t->kind == IL_XML_TOKEN_TAG && t->s[1] == '!');
    long line = t->line;
    for (size_t i = 0; is_text && d->depth == 0 && i < t->n; i++) {
        line += t->s[i] == '\n' ? 1 : 0;
        if (!il_xml_is_blank(t->s[i]))
            return il_fail(d->err, IL_E_INPUT, line, "text outside all elements: this is no %s", d->client->what);
    }
    return IL_OK;
}

/* A decimal reference to a control character at S[0..N), which XML allows for
 * tab, line feed and carriage return only: its number, and *USED bytes; else 0. */
static unsigned control_reference(const char *s, size_t n, size_t *used)
{
    unsigned code = 0;
    size_t i = 2;
    if (n < 4 || s[0] != '&' || s[1] != '#')
        return 0;
    for (; i < n && i < 5 && s[i] >= '0' && s[i] <= '9'; i++)
        code = 10 * code + (unsigned)(s[i] - '0');
    *used = i + 1;
    return i < n && s[i] == ';' && code < ' ' && code != '\t' && code != '\n' && code != '\r' ? code : 0;
}

/* As il_xml_client tells under quotes_controls. */
static void push_quoted(driver *d, const char *s, size_t n)
{
    size_t m = 0, used = 1;
    if (!il_grow(&d->scratch, &d->cap_scratch, n + 1, 2)) { /* "&#1;", the shortest, becomes 8 bytes */
        stop(d, il_fail_nomem(d->err));
        return;
    }
    for (size_t i = 0; i < n; i += used) {
        unsigned code = control_reference(s + i, n - i, &used);
        if (code > 0) {
            static const char digits[] = "0123456789ABCDEF";
            const char reference[] = { '&', '#', 'x', 'F', '0', digits[code / 16], digits[code % 16], ';' };
            memcpy(d->scratch + m, reference, sizeof reference);
            m += sizeof reference;
        } else {
            used = 1;
            d->scratch[m++] = s[i];
        }
    }
    push(d, d->scratch, m);
}

/* Whatever stands first in the file, our element opens before it, but after
 * the XML declaration, which tells the encoding. */
static void push_token(driver *d, bool *opened)
{
    const il_xml_token *t = &d->token;
    if (!*opened && t->kind != IL_XML_TOKEN_DECLARATION) {
        *opened = true;
        push(d, "<" WRAPPER ">", strlen("<" WRAPPER ">"));
        if (d->client->declaration)
            d->client->declaration(d->self, d->has_encoding);
    }
    size_t n_tags = d->n_tags;
    if (t->kind == IL_XML_TOKEN_SKIPPED)
        push_line_ends(d, t->n_lines);
    else if (t->kind == IL_XML_TOKEN_TEXT && d->client->quotes_controls && !d->has_encoding && memchr(t->s, '&', t->n))
        push_quoted(d, t->s, t->n);
    else
        push(d, t->s, t->n);
    /* A whole tag is parsed at once, unless the bytes before it wait for more
     * in an encoding they do not belong to: some say nothing then. */
    if (t->kind == IL_XML_TOKEN_TAG && t->s[1] != '!' && d->n_tags == n_tags)
        stop(d, il_fail(d->err, IL_E_INPUT, t->line, "not well-formed: bytes that the encoding does not have"));
}

static il_status read_tokens(driver *d)
{
    bool opened = false;
    while (d->status == IL_OK) {
        il_status st = il_xml_feed_next(&d->feed, &d->token, d->err);
        if (st != IL_OK)
            return st;
        if (d->token.kind == IL_XML_TOKEN_END)
            break;
        if (d->token.kind == IL_XML_TOKEN_DECLARATION)
            d->has_encoding = il_text_contains(d->token.s, d->token.n, "encoding");
        stop(d, check_outside(d));
        push_token(d, &opened);
    }
    return d->status == IL_OK ? d->client->finish(d->self, d->token.line, d->err) : d->status;
}

il_status il_xml_read(il_source *source, const il_xml_client *client, void *self, size_t max_token, il_error *err)
{
    driver d = { .client = client, .self = self, .err = err };
    xmlStructuredErrorFunc handler = xmlStructuredError; /* this thread's, given back below */
    void *handler_self = xmlStructuredErrorContext;
    xmlSetStructuredErrorFunc(&d, on_error);
    il_xml_feed_init(&d.feed, source, max_token < INT_MAX / 2 ? max_token : INT_MAX / 2);
    il_status st = new_parser(&d);
    if (st == IL_OK)
        st = read_tokens(&d);
    if (d.xml)
        xmlFreeParserCtxt(d.xml);
    xmlSetStructuredErrorFunc(handler_self, handler);
    il_free(d.n_bound);
    il_free(d.scratch);
    il_xml_feed_free(&d.feed);
    return st;
}

/* ---- elements ----------------------------------------------------------------------- */

const char *il_xml_attribute(const il_xml_element *e, const char *name, size_t *n)
{
    for (size_t i = 0; i < e->n_attributes; i++) {
        const unsigned char *const *a = e->attribute + 5 * i;
        if (strcmp((const char *)a[0], name) == 0) {
            *n = (size_t)(a[4] - a[3]);
            return (const char *)a[3];
        }
    }
    *n = 0;
    return NULL;
}

/* ---- the probe ------------------------------------------------------------------------- */

static size_t find(const char *s, size_t n, size_t from, const char *mark)
{
    size_t len = strlen(mark);
    for (size_t i = from; i + len <= n; i++)
        if (memcmp(s + i, mark, len) == 0)
            return i + len;
    return n;
}

/* Behind any byte order mark, declaration, comments and white space. */
static size_t skip_prolog(const char *s, size_t n)
{
    size_t i = il_text_begins(s, n, "\xEF\xBB\xBF") ? 3 : 0;
    for (;;) {
        while (i < n && il_xml_is_blank(s[i]))
            i++;
        if (il_text_begins(s + i, n - i, "<?"))
            i = find(s, n, i, "?>");
        else if (il_text_begins(s + i, n - i, "<!--"))
            i = find(s, n, i + 4, "-->");
        else
            return i;
    }
}

const char *il_xml_first_name(const char *head, size_t n, size_t *n_name, bool *is_type)
{
    static const char type[] = "<!DOCTYPE";
    size_t i = skip_prolog(head, n);
    *is_type = il_text_begins(head + i, n - i, type);
    i += *is_type ? sizeof type - 1 : i < n && head[i] == '<' ? 1 : n - i;
    while (*is_type && i < n && il_xml_is_blank(head[i]))
        i++;
    size_t from = i;
    while (i < n && !il_xml_is_blank(head[i]) && head[i] != '>' && head[i] != '/' && head[i] != '[')
        i++;
    *n_name = i - from;
    return head + from;
}
