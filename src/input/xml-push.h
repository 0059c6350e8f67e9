/* xml-push.h - a file of XML as a sequence of calls: libxml2's push parser behind
 * the feed, which lets no document type through, so that nothing is loaded,
 * substituted or connected to. */
#ifndef IL_INPUT_XML_PUSH_H
#define IL_INPUT_XML_PUSH_H

#include "input/xml-feed.h"

/* A start tag, borrowed from the parser for the time of its call; names are UTF-8.
 * attribute holds 5 pointers each: name, prefix, URI, value, value's end;
 * binding 2 each for the namespaces declared in the tag: prefix, URI. */
typedef struct il_xml_element {
    const char *name, *prefix, *uri;
    const unsigned char *const *attribute, *const *binding;
    size_t n_attributes, n_bindings;
    long line;
} il_xml_element;

/* The value of E's attribute NAME in whatever namespace, N bytes; null when
 * there is none. */
const char *il_xml_attribute(const il_xml_element *e, const char *name, size_t *n);

/* What a reader does with the pieces.  Any number of outermost elements may
 * follow one another; start and end match.  text gives the N bytes of UTF-8
 * between tags in any number of pieces, each with the line that it begins in.  A failure without a line gets that of
 * the token, or what `place` says.  place and declaration may be null.
 * what: the format's name, for errors.
 * quotes_controls: references to control characters, of which XML allows none,
 * become the private characters U+F000 and on, in a file that declares no encoding
 * (that is how dcm2xml writes bytes it cannot translate). */
typedef struct il_xml_client {
    const char *what;
    bool quotes_controls;
    void (*declaration)(void *self, bool has_encoding);
    il_status (*start)(void *self, const il_xml_element *e, il_error *err);
    il_status (*end)(void *self, long line, il_error *err);
    il_status (*text)(void *self, const char *s, size_t n, long line, il_error *err);
    il_status (*finish)(void *self, long line, il_error *err); /* the file ends */
    long (*place)(void *self, const il_xml_token *t);
} il_xml_client;

/* Read all of SOURCE.  Tags above MAX_TOKEN bytes are refused.  IL_E_INPUT when
 * it is not well-formed, or whatever the client says. */
il_status il_xml_read(il_source *source, const il_xml_client *client, void *self, size_t max_token, il_error *err);

/* The name of the document type at HEAD[0..N), or where there is none of the first
 * element, with its prefix; *N_NAME bytes, 0 when this is no XML. */
const char *il_xml_first_name(const char *head, size_t n, size_t *n_name, bool *is_type);

#endif
