/* charset.h - text in the character sets of DICOM files, made UTF-8. */
#ifndef IL_INPUT_CHARSET_H
#define IL_INPUT_CHARSET_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* All sets together have names of some 400 bytes; what goes on behind these says
 * nothing new, and every text would look through it again. */
enum { IL_CHARSET_MOST = 1000 };

/* The N bytes at TEXT in the Specific Character Set (0008,0005) DEFINED[0..N_DEFINED)
 * ("ISO_IR 100", "\\ISO 2022 IR 87", ...; empty: ISO_IR 6) as UTF-8 in *OUT, terminated,
 * to be freed by il_free; *N_OUT is its length.  With code extensions (DICOM
 * PS3.3 C.12.1.1.2, PS3.5 6.1.2.5; ISO/IEC 2022) escape sequences switch sets.
 * A byte that the set has no character for becomes U+FFFD, and so does NUL;
 * *N_BAD (may be null) counts these.  An unknown set, or one that iconv does not
 * have on this system: *KNOWN is false, and the bytes are taken as
 * UTF-8 where they are that, else as ISO-8859-1.  IL_E_NOMEM. */
il_status il_charset_to_utf8(const char *defined, size_t n_defined, const char *text, size_t n,
                             char **out, size_t *n_out, size_t *n_bad, bool *known, il_error *err);

#endif
