/* map-xml.h - what the readers of maps in XML share: the elements around, and an
 * element whose text is wanted. */
#ifndef IL_INPUT_MAP_XML_H
#define IL_INPUT_MAP_XML_H

#include "input/map-set.h"
#include "input/xml-push.h"

/* open[depth]: the elements around, as the reader calls them, less the n_skipped
 * innermost, which mean nothing to it.
 * has_text: an element is open whose text is asked for; keeps: and wanted, so that
 * text[n_text] gathers it.  name[n_name]: the attribute that has not been told yet. */
typedef struct il_map_xml {
    il_map_set *set;            /* borrowed */
    size_t max_depth, max_text;
    unsigned char *open;
    size_t depth, cap_open, n_skipped;
    bool has_text, keeps;
    char *text, *name;
    size_t n_text, cap_text, n_name, cap_name;
} il_map_xml;

/* Both formats are of WGS 84, which SET is told. */
il_status il_map_xml_init(il_map_xml *x, il_map_set *set, const il_read_options *options, il_error *err);
void il_map_xml_free(il_map_xml *x);

/* The element E is open, and called KIND.  IL_E_INPUT: nested too deep. */
il_status il_map_xml_push(il_map_xml *x, int kind, const il_xml_element *e, il_error *err);

/* What the innermost element is called; 0 outside of all. */
static inline int il_map_xml_in(const il_map_xml *x)
{
    return x->depth > 0 ? x->open[x->depth - 1] : 0;
}

/* From here on text is kept, in x->text, of which nothing is left. */
void il_map_xml_keep(il_map_xml *x);
/* IL_E_INPUT: longer than the limit of a line. */
il_status il_map_xml_add(il_map_xml *x, const char *s, size_t n, long line, il_error *err);

/* An attribute NAME[0..N) of the feature comes up. */
il_status il_map_xml_name(il_map_xml *x, const char *name, size_t n, il_error *err);
/* The text that follows is its value.  It ends with the innermost such element: what
 * has others inside has no value of its own. */
void il_map_xml_begin_value(il_map_xml *x);
il_status il_map_xml_end_value(il_map_xml *x, il_error *err);

/* The text kept is of the place NAME (il_map_place). */
il_status il_map_xml_end_place(il_map_xml *x, const char *name, il_error *err);

/* The file ends at LINE.  IL_E_INPUT: inside an element. */
il_status il_map_xml_finish(const il_map_xml *x, long line, il_error *err);

/* Is S[0..N) white space?  *LINE, its first line, becomes that of what is none. */
bool il_map_xml_is_blank(const char *s, size_t n, long *line);

#endif
