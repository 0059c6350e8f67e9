/* rt-set.h - a DICOM-RT structure set, filled element by element in file order.
 *
 * The text forms of a DICOM file (dcmdump text, JSON, XML) differ in syntax
 * only.  Each parser calls these functions, in this order:
 *     dataset   = begin_dataset (element | sequence)* end_dataset
 *     sequence  = begin_sequence item* end_sequence
 *     item      = begin_item (element | sequence)* end_item
 * and the set finds the ROIs and contours in it (DICOM PS3.3, C.8.8.5 and C.8.8.6),
 * in whichever order its sequences come.
 * A dataset becomes stacks, one an ROI, when it ends. */
#ifndef IL_INPUT_RT_SET_H
#define IL_INPUT_RT_SET_H

#include "input/reader.h"

#include <stdint.h>

/* group << 16 | element */
#define IL_TAG(group, element) ((uint32_t)(group) << 16 | (uint32_t)(element))

/* Is S[0..N) a tag as FORM has it, each x in FORM a hexadecimal digit in either
 * case and the rest as it stands ("(xxxx,xxxx)")?  *TAG is set only then. */
bool il_rt_parse_tag(const char *s, size_t n, const char *form, uint32_t *tag);

typedef struct il_rt_set il_rt_set;

/* LINE is where it stands in the file, for errors.  IL_E_INPUT when the brackets
 * do not match, or are deeper than the options allow; IL_E_NOMEM. */
il_status il_rt_set_begin_dataset(il_rt_set *s, long line, il_error *err);
il_status il_rt_set_begin_sequence(il_rt_set *s, uint32_t tag, long line, il_error *err);
il_status il_rt_set_begin_item(il_rt_set *s, long line, il_error *err);
il_status il_rt_set_end_item(il_rt_set *s, long line, il_error *err);
il_status il_rt_set_end_sequence(il_rt_set *s, long line, il_error *err);

/* The dataset is whole: its ROIs go to the sink.  IL_E_INPUT when it is no
 * structure set, or whatever the sink answers. */
il_status il_rt_set_end_dataset(il_rt_set *s, long line, il_error *err);

/* Does the set make use of element TAG where it is now?  If not, the parser
 * need not put a value together. */
bool il_rt_set_wants(const il_rt_set *s, uint32_t tag);

/* Would anything be lost without TAG where the set is now?  It is an element that
 * the set wants, or one of the sequences that they are in. */
bool il_rt_set_needs(const il_rt_set *s, uint32_t tag);

/* Element TAG has the value TEXT[0..N), several values with a backslash between
 * two.  IS_UTF8: the bytes are UTF-8; else they are in the character set that
 * the file names in (0008,0005).  Elements that the set does not want pass. */
il_status il_rt_set_element(il_rt_set *s, uint32_t tag, const char *text, size_t n, bool is_utf8,
                            long line, il_error *err);

/* How many values the text of an element has: one more than backslashes, none
 * without bytes. */
size_t il_rt_count_values(const char *text, size_t n);

/* What the readers of the three forms share: parse every SOURCE by PARSE into
 * one set after the other, then end SINK. */
typedef il_status il_rt_parse(il_source *source, il_rt_set *set, const il_read_options *options, il_error *err);
il_status il_rt_read(il_rt_parse *parse, il_source *const *source, size_t n, const il_read_options *options,
                     il_sink *sink, il_report *report, il_error *err);

#endif
