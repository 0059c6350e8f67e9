/* map-text.h - rows of numbers as text, which GMT, BLN and tables share. */
#ifndef IL_INPUT_MAP_TEXT_H
#define IL_INPUT_MAP_TEXT_H

#include "base/source.h"

#include <stdbool.h>

/* What probes are given at least, unless the file is shorter. */
enum { IL_MAP_TEXT_HEAD = 4096 };

/* What is left of a line. */
typedef struct il_map_text {
    const char *p, *end;
} il_map_text;

/* The next line of L, with neither a byte order mark in front nor blanks at either end;
 * *MORE is false at the end of the input. */
il_status il_map_text_line(il_lines *l, il_map_text *t, bool *more, il_error *err);

/* Pass blanks, and one comma or semicolon among them when BEHIND another number. */
void il_map_text_pass(il_map_text *t, bool behind);

/* At the end, or before a separator? */
bool il_map_text_ends(const il_map_text *t);

/* Does a number stand behind what il_map_text_pass passes, and end there or before a
 * separator?  Then take it. */
bool il_map_text_number(il_map_text *t, bool behind, double *value);

/* Pass blanks; is anything left? */
bool il_map_text_more(il_map_text *t);

/* What is left as an argument of "%.*s": at most 40 bytes. */
int il_map_text_shown(const il_map_text *t);

static inline bool il_map_text_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Is HEAD[0..N), the first bytes of a file, text: no control characters but those
 * between words and lines? */
bool il_map_text_is_plain(const unsigned char *head, size_t n);

/* The next of the lines in HEAD for a probe, as il_map_text_line gives it, from *AT on,
 * which starts as 0; false when there are no more.  *WHOLE: its end is in HEAD. */
bool il_map_text_head(const unsigned char *head, size_t n, size_t *at, il_map_text *t, bool *whole);

#endif
