#include "config.h"
#include "cli/table.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { TEXT = 600 };

void il_table_row(il_output *out, const char *key, const char *format, ...)
{
    char line[TEXT + 40], text[TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    snprintf(line, sizeof line, "  %-11s %s\n", key, text);
    il_output_string(out, line);
}

void il_table_heading(il_output *out, const char *format, ...)
{
    char text[TEXT], line[TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    il_text_printable(line, sizeof line, text, strlen(text));
    il_output_string(out, line);
    il_output_char(out, '\n');
}
