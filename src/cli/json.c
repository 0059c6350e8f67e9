#include "config.h"
#include "cli/json.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void separate(il_json *j)
{
    if (j->comma)
        il_output_char(j->out, ',');
    j->comma = true;
}

void il_json_open(il_json *j, char bracket)
{
    separate(j);
    il_output_char(j->out, bracket);
    j->comma = false;
}

void il_json_close(il_json *j, char bracket)
{
    il_output_char(j->out, bracket);
    j->comma = true;
}

void il_json_key(il_json *j, const char *key)
{
    separate(j);
    il_output_char(j->out, '"');
    il_output_string(j->out, key);
    il_output_string(j->out, "\":");
    j->comma = false;
}

/* One character of LEN bytes; U+007F to U+009F are escaped as well, so that the
 * account may go to a terminal. */
static void put_character(il_output *out, const char *s, size_t len, unsigned long code)
{
    char escape[8];
    if (code == '"' || code == '\\') {
        il_output_char(out, '\\');
        il_output_char(out, (char)code);
    } else if (code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x200E && code <= 0x202E) ||
               (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF) {
        snprintf(escape, sizeof escape, "\\u%04lx", code & 0xFFFF);
        il_output_string(out, escape);
    } else {
        il_output_write(out, s, len);
    }
}

void il_json_string(il_json *j, const char *s)
{
    if (!s) {
        il_json_null(j);
        return;
    }
    separate(j);
    il_output_char(j->out, '"');
    for (size_t n = strlen(s), i = 0; i < n;) {
        unsigned long code = 0;
        size_t len = il_utf8_char(s + i, n - i, &code);
        if (len == 0)
            il_output_string(j->out, "\xEF\xBF\xBD");
        else
            put_character(j->out, s + i, len, code);
        i += len > 0 ? len : 1;
    }
    il_output_char(j->out, '"');
}

void il_json_number(il_json *j, double value)
{
    if (!isfinite(value)) {
        il_json_null(j);
        return;
    }
    separate(j);
    il_output_number(j->out, value);
}

void il_json_integer(il_json *j, long long value)
{
    separate(j);
    il_output_integer(j->out, value);
}

void il_json_bool(il_json *j, bool value)
{
    separate(j);
    il_output_string(j->out, value ? "true" : "false");
}

void il_json_null(il_json *j)
{
    separate(j);
    il_output_string(j->out, "null");
}
