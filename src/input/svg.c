/* svg.c - SVG-like polylines (formats/svg.txt): libxml2's push parser between
 * the feed, which cuts the bytes, and the drawing, which knows what they mean. */
#include "config.h"
#include "base/alloc.h"
#include "input/reader.h"
#include "input/svg-drawing.h"
#include "input/svg-feed.h"

#include <libxml/parser.h>
#include <libxml/xmlerror.h>

#include <limits.h>
#include <math.h>
#include <string.h>

/* All is put inside an element of our own, so that a fragment with several
 * outermost elements is a document too.  Its tag has no line end. */
#define WRAPPER "isoloft-input"

/* Namespaces in scope: every prefix is looked up among them one by one. */
enum { MAX_NAMESPACES = 256 };

/* n_bound[depth]: namespaces declared at each depth, n_in_scope their sum. */
typedef struct driver {
    il_svg_drawing *drawing;
    il_svg_feed feed;
    il_svg_token token;         /* what the parser is being fed */
    xmlParserCtxtPtr xml;
    bool in_wrapper;
    size_t n_tags;              /* start and end tags parsed, <a/> being both */
    int *n_bound, n_in_scope;
    size_t cap_bound, depth;
    il_status status;
    il_error *err;
} driver;

/* ---- calls from libxml2 --------------------------------------------------------- */

/* Keep the failure ST with its place.  Nothing more is done from here on; the
 * parser itself is not stopped, it has at most this tag to end. */
static void stop(driver *d, il_status st)
{
    if (st == IL_OK || d->status != IL_OK)
        return;
    d->status = st;
    if (d->err && d->err->line == 0 && st == IL_E_INPUT) {
        const il_svg_text *at = &d->drawing->at;
        d->err->line = at->name ? il_svg_token_line(&d->token, at->name, at->at) : d->token.line;
    }
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

static bool declares_slic3r(const xmlChar **namespaces, int n)
{
    for (int i = 0; i < n; i++)
        if (il_svg_namespace_of(NULL, (const char *)namespaces[2 * i + 1]) == IL_SVG_NS_SLIC3R)
            return true;
    return false;
}

static void on_start(void *self, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri,
                     int n_namespaces, const xmlChar **namespaces, int n_attributes, int n_defaulted,
                     const xmlChar **attributes)
{
    driver *d = self;
    (void)n_defaulted;
    d->n_tags++;
    if (d->status != IL_OK)
        return;
    if (!d->in_wrapper) {
        d->in_wrapper = true;
        return;
    }
    il_svg_element e = { (const char *)name, il_svg_namespace_of((const char *)prefix, (const char *)uri),
                         attributes, (size_t)n_attributes, declares_slic3r(namespaces, n_namespaces), d->token.line };
    il_status st = bind_namespaces(d, n_namespaces);
    stop(d, st == IL_OK ? il_svg_drawing_start(d->drawing, &e, d->err) : st);
}

static void on_end(void *self, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri)
{
    driver *d = self;
    (void)name, (void)prefix, (void)uri;
    d->n_tags++;
    d->drawing->at.name = NULL;
    if (d->status != IL_OK)
        return;
    if (d->depth == 0) { /* the file's own end tag of that name */
        stop(d, il_fail(d->err, IL_E_INPUT, d->token.line, "an end tag without its start tag"));
        return;
    }
    d->n_in_scope -= d->n_bound[--d->depth];
    stop(d, il_svg_drawing_end(d->drawing, d->err));
}

static void on_text(void *self, const xmlChar *s, int n)
{
    driver *d = self;
    d->drawing->at.name = NULL;
    if (d->status == IL_OK)
        stop(d, il_svg_drawing_text(d->drawing, (const char *)s, (size_t)n, d->err));
}

/* Called for what the parser finds, and for what libxml2 finds without one
 * (bytes that the encoding does not have), which it would print.
 * Unknown prefixes are no matter (il_svg_namespace_of); whatever else libxml2
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

static void push_line_ends(driver *d, long n)
{
    for (; n > 0; n--)
        push(d, "\n", 1);
}

/* Text outside all elements is no SVG, and would be lost. */
static il_status check_outside(const driver *d)
{
    const il_svg_token *t = &d->token;
    bool is_text = t->kind == IL_SVG_TOKEN_TEXT || (t->kind == IL_SVG_TOKEN_TAG && t->s[1] == '!');
    long line = t->line;
    for (size_t i = 0; is_text && d->depth == 0 && i < t->n; i++) {
        line += t->s[i] == '\n' ? 1 : 0;
        if (!il_svg_is_blank(t->s[i]))
            return il_fail(d->err, IL_E_INPUT, line, "text outside all elements: this is no SVG");
    }
    return IL_OK;
}

/* Whatever stands first in the file, our element opens before it, but after
 * the XML declaration, which tells the encoding. */
static void push_token(driver *d, bool *opened)
{
    const il_svg_token *t = &d->token;
    if (!*opened && t->kind != IL_SVG_TOKEN_DECLARATION) {
        *opened = true;
        push(d, "<" WRAPPER ">", strlen("<" WRAPPER ">"));
    }
    size_t n_tags = d->n_tags;
    if (t->kind == IL_SVG_TOKEN_SKIPPED)
        push_line_ends(d, t->n_lines);
    else
        push(d, t->s, t->n);
    /* A whole tag is parsed at once, unless the bytes before it wait for more
     * in an encoding they do not belong to: some say nothing then. */
    if (t->kind == IL_SVG_TOKEN_TAG && t->s[1] != '!' && d->n_tags == n_tags)
        stop(d, il_fail(d->err, IL_E_INPUT, t->line, "not well-formed: bytes that the encoding does not have"));
}

static il_status read_tokens(driver *d)
{
    bool opened = false;
    while (d->status == IL_OK) {
        il_status st = il_svg_feed_next(&d->feed, &d->token, d->err);
        if (st != IL_OK)
            return st;
        if (d->token.kind == IL_SVG_TOKEN_END)
            break;
        stop(d, check_outside(d));
        push_token(d, &opened);
    }
    return d->status == IL_OK ? il_svg_drawing_end_file(d->drawing, d->err) : d->status;
}

static il_status read_file(il_svg_drawing *drawing, il_source *source, size_t number, il_error *err)
{
    size_t longest = drawing->options->max_line < INT_MAX / 2 ? drawing->options->max_line : INT_MAX / 2;
    driver d = { .drawing = drawing, .err = err };
    xmlStructuredErrorFunc handler = xmlStructuredError; /* this thread's, given back below */
    void *handler_self = xmlStructuredErrorContext;
    xmlSetStructuredErrorFunc(&d, on_error);
    il_svg_feed_init(&d.feed, source, longest);
    il_svg_drawing_begin_file(drawing, number, il_source_name(source));
    il_status st = new_parser(&d);
    if (st == IL_OK)
        st = read_tokens(&d);
    if (d.xml)
        xmlFreeParserCtxt(d.xml);
    xmlSetStructuredErrorFunc(handler_self, handler);
    il_free(d.n_bound);
    il_svg_feed_free(&d.feed);
    if (st != IL_OK)
        il_error_set_file(err, il_source_name(source));
    return st;
}

/* ---- the reader ---------------------------------------------------------------------- */

static il_status send(il_svg_drawing *d, il_source *const *source, size_t n, il_sink *sink, il_error *err)
{
    const il_read_options *o = d->options;
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_status st = IL_OK;
    head.unit = o->has_unit ? o->unit : IL_UNIT_MM;
    if (d->n_unscaled > 0)
        il_report_note(d->report, "user units are taken as mm (--unit tells otherwise)");
    if (!il_stack_head_set_name(&head, d->title ? d->title : "", d->n_title))
        st = il_fail_nomem(err);
    else
        st = il_svg_slices_send(&d->slices, &head, source, n, o, sink, d->report, err);
    il_stack_head_free(&head);
    return st;
}

static il_status read_svg(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    if (options->has_spacing && !(options->spacing > 0 && options->spacing < 1e15))
        return il_fail(err, IL_E_USAGE, 0, "the spacing must be above 0");
    il_svg_drawing d;
    il_status st = IL_OK;
    il_svg_drawing_init(&d, options, report);
    for (size_t i = 0; i < n && st == IL_OK; i++)
        st = read_file(&d, source[i], i, err);
    if (st == IL_OK)
        st = send(&d, source, n, sink, err);
    il_svg_drawing_free(&d);
    return st;
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

static bool has_at(const char *s, size_t n, size_t i, const char *mark)
{
    size_t len = strlen(mark);
    return n - i >= len && memcmp(s + i, mark, len) == 0;
}

static bool is_svg_name(const char *s, size_t n)
{
    static const char *const names[] = { "svg", "g", "polygon", "polyline", "path", "line", "rect", "circle",
        "ellipse" };
    if (has_at(s, n, 0, "svg:"))
        s += 4, n -= 4;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        size_t len = strlen(names[i]);
        if (has_at(s, n, 0, names[i]) && (n == len || il_svg_is_blank(s[len]) || s[len] == '>' || s[len] == '/'))
            return true;
    }
    return false;
}

/* The first element is SVG's, behind any declaration, comments and document
 * type; or all that can be seen is a document type of svg. */
static bool probe(const unsigned char *head, size_t n)
{
    const char *s = (const char *)head;
    size_t i = has_at(s, n, 0, "\xEF\xBB\xBF") ? 3 : 0;
    bool is_type = false;
    for (;;) {
        while (i < n && il_svg_is_blank(s[i]))
            i++;
        if (has_at(s, n, i, "<?"))
            i = find(s, n, i, "?>");
        else if (has_at(s, n, i, "<!--"))
            i = find(s, n, i + 4, "-->");
        else if (has_at(s, n, i, "<!DOCTYPE svg"))
            i = find(s, n, i, ">"), is_type = true;
        else
            break;
    }
    return i < n ? is_type || (s[i] == '<' && is_svg_name(s + i + 1, n - i - 1)) : is_type;
}

const il_reader il_reader_svg = {
    .name = "svg",
    .extensions = "svg",
    .words = "SVG-like polylines, paths and shapes by layer",
    .probe = probe,
    .read = read_svg,
};
