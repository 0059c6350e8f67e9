/* dicom-quoted.h - names that dcm2xml could not convert, read from XML.
 *
 * dcm2xml writes the bytes of character sets that it does not know as references
 * to the characters of those numbers (&#200; for a byte C8), and then declares
 * no encoding. */
#ifndef IL_INPUT_DICOM_QUOTED_H
#define IL_INPUT_DICOM_QUOTED_H

#include "base/status.h"

#include <stddef.h>

/* The N bytes of UTF-8 at TEXT, from a file that declares no encoding, with its
 * control characters at U+F000 and on (il_xml_client, quotes_controls), in *OUT,
 * to be freed by il_free; *N_OUT bytes.  They are quoted bytes when dcm2xml does
 * not know CHARSET, the value of (0008,0005) or null, and all of them are
 * characters of it; else the control characters alone are put back.  IL_E_NOMEM. */
il_status il_dicom_unquote(const char *charset, const char *text, size_t n, char **out, size_t *n_out, il_error *err);

#endif
