/* message.h - all words to people: standard error, a line at a time, nothing
 * in it that a terminal would obey. */
#ifndef IL_CLI_MESSAGE_H
#define IL_CLI_MESSAGE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* How the program speaks.  shown: bytes of the progress line that stands on the
 * terminal now; it is wiped before anything else is said. */
typedef struct il_voice {
    bool quiet, verbose, progress;
    size_t shown;
    double last_shown;      /* seconds, monotonic clock */
} il_voice;

/* "isoloft: FILE:LINE: sentence"; said even when quiet. */
void il_message_error(il_voice *v, const il_error *err);

/* "isoloft: sentence" unless quiet. */
void il_message_note(il_voice *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* "isoloft: sentence" only when verbose. */
void il_message_detail(il_voice *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The N bytes at S as they are, for the JSON account. */
void il_message_raw(il_voice *v, const void *s, size_t n);

#endif
