/* names.h - names from files, made fit for the formats that carry them. */
#ifndef IL_OUTPUT_NAMES_H
#define IL_OUTPUT_NAMES_H

#include "base/output.h"

enum { IL_NAME_SAFE_MAX = 64 };

/* NAME for formats that end a word at a blank: bytes outside [A-Za-z0-9_-]
 * become _, at most IL_NAME_SAFE_MAX of them; "stack" for an empty one.  Never
 * a path, an option of its own or a line's end. */
void il_name_safe(char to[IL_NAME_SAFE_MAX + 1], const char *name);

/* The line PREFIX TEXT, with TEXT made printable and cut at 400 bytes. */
void il_output_comment(il_output *o, const char *prefix, const char *text);

#endif
