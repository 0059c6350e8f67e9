/* svg-attr.h - an element as the XML parser gives it, and its attributes. */
#ifndef IL_INPUT_SVG_ATTR_H
#define IL_INPUT_SVG_ATTR_H

#include "input/svg-text.h"

/* Namespaces are told by their URI, or by their usual prefix in a fragment
 * that declares none. */
typedef enum il_svg_namespace {
    IL_SVG_NS_NONE, IL_SVG_NS_SVG, IL_SVG_NS_SLIC3R, IL_SVG_NS_INKSCAPE, IL_SVG_NS_OTHER
} il_svg_namespace;

il_svg_namespace il_svg_namespace_of(const char *prefix, const char *uri);

/* A start tag, borrowed from the parser for the time of its call.  attribute
 * holds 5 pointers each: name, prefix, URI, value, value's end.  A root
 * without a namespace counts as SVG. */
typedef struct il_svg_element {
    const char *name;
    il_svg_namespace ns;
    const unsigned char *const *attribute;
    size_t n_attributes;
    bool declares_slic3r;
    long line;
} il_svg_element;

/* Is the element SVG's (or in no namespace)? */
bool il_svg_element_is_svg(const il_svg_element *e);

/* The attribute NAME of namespace NS (IL_SVG_NS_NONE for plain ones), with the
 * cursor at its start; false when there is none. */
bool il_svg_attr(const il_svg_element *e, il_svg_namespace ns, const char *name, il_svg_text *value);

/* The CSS property NAME, from the style attribute or else the attribute of that
 * name; style sheets are not read. */
bool il_svg_property(const il_svg_element *e, const char *name, il_svg_text *value);

#endif
