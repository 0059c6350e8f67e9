#include "config.h"
#include "cli/message.h"
#include "base/text.h"
#include "cli/progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LINE_MAX_BYTES = 1200 };

/* One fwrite a line, so that lines of several processes do not mix. */
static void say(il_voice *v, const char *text)
{
    char line[LINE_MAX_BYTES];
    static const char prefix[] = "isoloft: ";
    memcpy(line, prefix, sizeof prefix - 1);
    size_t n = sizeof prefix - 1;
    n += il_text_printable(line + n, sizeof line - n - 1, text, strlen(text));
    line[n++] = '\n';
    il_message_raw(v, line, n);
}

void il_message_raw(il_voice *v, const void *s, size_t n)
{
    il_progress_clear(v);
    fwrite(s, 1, n, stderr);
    fflush(stderr);
}

void il_message_error(il_voice *v, const il_error *err)
{
    char text[LINE_MAX_BYTES];
    il_error_message(err, text, sizeof text);
    say(v, text);
}

static void say_formatted(il_voice *v, const char *format, va_list args)
{
    char text[LINE_MAX_BYTES];
    vsnprintf(text, sizeof text, format, args);
    say(v, text);
}

void il_message_note(il_voice *v, const char *format, ...)
{
    if (v->quiet)
        return;
    va_list args;
    va_start(args, format);
    say_formatted(v, format, args);
    va_end(args);
}

void il_message_detail(il_voice *v, const char *format, ...)
{
    if (v->quiet || !v->verbose)
        return;
    va_list args;
    va_start(args, format);
    say_formatted(v, format, args);
    va_end(args);
}
