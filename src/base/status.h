/* status.h - filling the error record that names file, line and reason.
 *
 * Every function that can fail returns an il_status and takes an il_error that
 * it fills once, through il_fail.  The codes are the program's exit codes
 * (isoloft(1), EXIT STATUS), so that nothing is translated on the way out. */
#ifndef IL_BASE_STATUS_H
#define IL_BASE_STATUS_H

#include "isoloft.h" /* il_status, il_error, il_error_message */

#ifdef __cplusplus
extern "C" {
#endif

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

#ifdef __cplusplus
}
#endif
#endif
