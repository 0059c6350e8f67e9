#include "config.h"
#include "output/names.h"
#include "base/text.h"

#include <string.h>

void il_name_safe(char to[IL_NAME_SAFE_MAX + 1], const char *name)
{
    static const char good[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
    size_t n = 0;
    if (!*name)
        name = "stack";
    for (; name[n] && n < IL_NAME_SAFE_MAX; n++)
        to[n] = strchr(good, name[n]) ? name[n] : '_';
    to[n] = '\0';
}

void il_output_comment(il_output *o, const char *prefix, const char *text)
{
    char line[400];
    size_t n = il_text_printable(line, sizeof line, text, strlen(text));
    il_output_string(o, prefix);
    il_output_write(o, line, n);
    if (n > 0 && line[n - 1] == '\\')
        il_output_char(o, ' '); /* a backslash at the end would join the next line in OBJ */
    il_output_char(o, '\n');
}
