/* xml-feed.h - bytes of XML cut into tags and text, before the parser sees them.
 *
 * libxml2's push parser takes any bytes, but a start tag that arrives in pieces
 * is searched again with every piece, and '>' inside an attribute can fool it.
 * The feed gives it whole tags, knows the line each begins in, and keeps from it
 * what a contour file has no need of: comments, processing instructions, and
 * above all the document type with its entities.  It cuts only; what it cuts
 * need not be well-formed, and the parser says so then. */
#ifndef IL_INPUT_XML_FEED_H
#define IL_INPUT_XML_FEED_H

#include "base/source.h"

#include <stdbool.h>

/* An attribute is compared with all others of its tag: the parser's work grows
 * with the square of their number. */
enum { IL_XML_MAX_ATTRIBUTES = 256 };

/* White space of XML. */
static inline bool il_xml_is_blank(char c)
{
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

typedef enum il_xml_token_kind {
    IL_XML_TOKEN_END,
    IL_XML_TOKEN_DECLARATION,   /* <?xml ...?> at the very beginning */
    IL_XML_TOKEN_TAG,           /* a start or end tag, or CDATA section, whole */
    IL_XML_TOKEN_TEXT,          /* a piece of text, with none but whole references */
    IL_XML_TOKEN_SKIPPED        /* nothing for the parser but its line ends */
} il_xml_token_kind;

/* s[n] is borrowed until the next token; line: where it begins; n_lines: line
 * ends inside. */
typedef struct il_xml_token {
    il_xml_token_kind kind;
    const char *s;
    size_t n;
    long line, n_lines;
} il_xml_token;

typedef struct il_xml_feed {
    il_source *source;          /* borrowed */
    size_t max_token;
    char *buf;
    size_t cap, begin, end;     /* buf[begin..end) is unread */
    long line;                  /* of buf[begin] */
    bool at_start, at_end;
    size_t scanned, n_attributes; /* how far the token at `begin` has been searched, and the state of that */
    int depth;
    char quote;
} il_xml_feed;

/* Tokens above MAX_TOKEN bytes are refused. */
void il_xml_feed_init(il_xml_feed *f, il_source *source, size_t max_token);
void il_xml_feed_free(il_xml_feed *f);

/* IL_E_INPUT: the input ends inside a tag, a tag has '<' inside or too many
 * attributes, a document type declares entities, the encoding is UTF-16. */
il_status il_xml_feed_next(il_xml_feed *f, il_xml_token *t, il_error *err);

/* The line of byte OFFSET of the value of T's attribute NAME, as the parser gave
 * it (a line end is one blank there, a character reference one byte); T's own
 * line when it has no such attribute. */
long il_xml_token_line(const il_xml_token *t, const char *name, size_t offset);

#endif
