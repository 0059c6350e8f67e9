/* codepage.h - texts in the code pages that files name, made UTF-8. */
#ifndef IL_INPUT_CODEPAGE_H
#define IL_INPUT_CODEPAGE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* What the bytes of a file's texts are.  Where nothing is known of it they are taken
 * as UTF-8 where they are that, else as ISO-8859-1. */
typedef struct il_codepage {
    enum { IL_CODEPAGE_UNKNOWN, IL_CODEPAGE_UTF8, IL_CODEPAGE_ICONV } kind;
    void *converter;            /* iconv_t */
} il_codepage;

#define IL_CODEPAGE_INIT { IL_CODEPAGE_UNKNOWN, NULL }

/* Set *C to what NAME[0..N) calls it: "ANSI_1252", "CP1252", "1252", "windows-1252",
 * "DOS850", "OEM 850", "ISO-8859-1", "8859_1", "88591", "UTF-8", "Big5", "gb2312", ...
 * False when it is none that is known, or iconv does not have it here; *C is as
 * before then. */
bool il_codepage_set(il_codepage *c, const char *name, size_t n);

/* The same for the language driver of a dBASE file (its byte 29); 0 and what is not
 * known say nothing, which is false. */
bool il_codepage_set_dbase(il_codepage *c, unsigned driver);

/* The N bytes at S as UTF-8 in *OUT, terminated, to be freed by il_free; what is no
 * character becomes U+FFFD.  IL_E_NOMEM. */
il_status il_codepage_text(il_codepage *c, const char *s, size_t n, char **out, size_t *n_out, il_error *err);

void il_codepage_free(il_codepage *c);

#endif
