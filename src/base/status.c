#include "config.h"
#include "base/status.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

il_status il_fail(il_error *err, il_status code, long line, const char *format, ...)
{
    if (!err || err->code != IL_OK)
        return code;
    char raw[sizeof err->text];
    va_list args;
    va_start(args, format);
    int n = vsnprintf(raw, sizeof raw, format, args);
    va_end(args);
    err->code = code;
    err->line = line;
    size_t used = n < 0 ? 0 : (size_t)n < sizeof raw ? (size_t)n : sizeof raw - 1;
    il_text_printable(err->text, sizeof err->text, raw, used);
    return code;
}

il_status il_fail_nomem(il_error *err)
{
    return il_fail(err, IL_E_NOMEM, 0, "out of memory");
}

void il_error_set_file(il_error *err, const char *file)
{
    if (err && err->code != IL_OK && !err->file[0] && file)
        il_text_printable(err->file, sizeof err->file, file, strlen(file));
}

void il_error_clear(il_error *err)
{
    *err = (il_error)IL_ERROR_INIT;
}

void il_error_message(const il_error *err, char *to, size_t size)
{
    char line[32] = "";
    if (err->line > 0)
        snprintf(line, sizeof line, "%s%ld", err->file[0] ? ":" : "line ", err->line);
    const char *after_place = err->file[0] || line[0] ? ": " : "";
    snprintf(to, size, "%s%s%s%s%s%s", err->file, line, after_place,
             err->path, err->path[0] ? ": " : "", err->text);
}
