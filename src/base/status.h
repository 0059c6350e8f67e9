/* status.h - result codes, and one error record that names file, line and reason.
 *
 * Every function that can fail returns an il_status and takes an il_error that
 * it fills once, through il_fail.  The codes are the program's exit codes
 * (isoloft(1), EXIT STATUS), so that nothing is translated on the way out. */
#ifndef IL_BASE_STATUS_H
#define IL_BASE_STATUS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum il_status {
    IL_OK         = 0,
    IL_E_UNSOUND  = 1,  /* `check` only: readable, but not sound */
    IL_E_USAGE    = 2,  /* the command line */
    IL_E_INPUT    = 3,  /* the input is not what its format allows */
    IL_E_IO       = 4,  /* the system could not read or write */
    IL_E_NOMEM    = 5,
    IL_E_SURFACE  = 6,  /* no surface passes the certificate */
    IL_E_INTERNAL = 70  /* a bug of ours */
} il_status;

/* file: as the user named it, "" when unknown.  line: from 1, 0 when unknown.
 * path: where a format has no lines that help (JSON, XML), else "".
 * text: one sentence without a full stop.  All of it is printable UTF-8. */
typedef struct il_error {
    il_status code;
    char file[256];
    long line;
    char path[128];
    char text[400];
} il_error;

#define IL_ERROR_INIT { IL_OK, "", 0, "", "" }

/* Record CODE, LINE and a printf-formatted sentence in *ERR and return CODE.
 * The first failure wins: a later call leaves an error that is set as it is.
 * Bytes from files pass as arguments, never as the format; what is not
 * printable in them is made so here (il_text_printable).  ERR may be null. */
il_status il_fail(il_error *err, il_status code, long line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The one sentence for memory, so that it needs none: code IL_E_NOMEM. */
il_status il_fail_nomem(il_error *err);

/* Name the file of an error that has none yet. */
void il_error_set_file(il_error *err, const char *file);

void il_error_clear(il_error *err);

/* The whole message, "FILE:LINE: TEXT" with the parts that are known, into
 * TO[SIZE]; always terminated. */
void il_error_message(const il_error *err, char *to, size_t size);

#ifdef __cplusplus
}
#endif
#endif
