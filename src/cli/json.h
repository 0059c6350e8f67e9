/* json.h - a tiny emitter: commas where they belong, strings escaped, numbers
 * that JSON can hold (RFC 8259). */
#ifndef IL_CLI_JSON_H
#define IL_CLI_JSON_H

#include "base/output.h"

#include <stdbool.h>

/* Writes to OUT (borrowed), whose error is kept there.  comma: something stands
 * before the next value on this level. */
typedef struct il_json {
    il_output *out;
    bool comma;
} il_json;

void il_json_open(il_json *j, char bracket);    /* '{' or '[' */
void il_json_close(il_json *j, char bracket);   /* '}' or ']' */
void il_json_key(il_json *j, const char *key);  /* KEY needs no escaping */

/* Bytes of S that are not UTF-8 become U+FFFD; control characters \u00XX.  A
 * null S is null. */
void il_json_string(il_json *j, const char *s);
void il_json_number(il_json *j, double value);  /* null when not finite */
void il_json_integer(il_json *j, long long value);
void il_json_bool(il_json *j, bool value);
void il_json_null(il_json *j);

#endif
