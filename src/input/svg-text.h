/* svg-text.h - a cursor over an attribute's text: blanks, commas, numbers. */
#ifndef IL_INPUT_SVG_TEXT_H
#define IL_INPUT_SVG_TEXT_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* name: the attribute, for errors.  s[n]: its value, not terminated, borrowed.
 * at: the next byte to read; after a failure, the byte that was refused. */
typedef struct il_svg_text {
    const char *name, *s;
    size_t n, at;
} il_svg_text;

/* White space of SVG's grammars: space, tab, LF, FF, CR. */
bool il_svg_is_blank(char c);

/* Skip blanks; is anything left? */
bool il_svg_text_more(il_svg_text *t);

/* Skip blanks, then C if it stands there. */
bool il_svg_text_take(il_svg_text *t, char c);

/* The number at the cursor, blanks before it allowed. */
il_status il_svg_text_number(il_svg_text *t, double *value, il_error *err);

/* A number that follows another: blanks and one comma may stand before it, and
 * neither need ("1-2.5.5" is 1, -2.5, .5). */
il_status il_svg_text_next_number(il_svg_text *t, double *value, il_error *err);

/* Is the rest of T, less blanks at its end, WORD? */
bool il_svg_text_is_word(const il_svg_text *t, const char *word);

/* "NAME: WHAT at 'rest'", IL_E_INPUT; the line is the caller's to find. */
il_status il_svg_text_fail(const il_svg_text *t, il_error *err, const char *what);

#endif
