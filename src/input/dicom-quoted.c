#include "config.h"
#include "input/dicom-quoted.h"
#include "base/alloc.h"
#include "input/charset.h"

#include <string.h>

/* The sets that dcm2xml knows, so that it never quotes them. */
static bool is_converted(const char *charset)
{
    static const char *const known[] = { "", "ISO_IR 6", "ISO_IR 100", "ISO_IR 101", "ISO_IR 109", "ISO_IR 110", "ISO_IR 126",
        "ISO_IR 127", "ISO_IR 138", "ISO_IR 144", "ISO_IR 148", "ISO_IR 192" };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(charset, known[i]) == 0)
            return true;
    return false;
}

/* The control character that stands at S[I], NUL for none. */
static char control_at(const char *s, size_t n, size_t i)
{
    unsigned char c = (unsigned char)(i + 2 < n ? s[i + 2] : '\0');
    return c > 0x80 && c < 0xA0 && memcmp(s + i, "\xEF\x80", 2) == 0 ? (char)(c & 0x1F) : '\0';
}

/* The text S[0..N) in TO, which has room for N, with its control characters; its
 * length. */
static size_t restore_controls(const char *s, size_t n, char *to)
{
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        char control = control_at(s, n, i);
        to[m++] = control ? control : s[i];
        i += control ? 2 : 0;
    }
    return m;
}

/* The bytes that the text S[0..N) quotes, in TO, which has room for N.  False when
 * it has characters that no byte is, or nothing but ASCII. */
static bool find_bytes(const char *s, size_t n, char *to, size_t *n_to)
{
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        unsigned char c = (unsigned char)s[i];
        char control = control_at(s, n, i);
        if (c < 0x80) {
            to[m++] = s[i];
        } else if ((c == 0xC2 || c == 0xC3) && i + 1 < n) {
            to[m++] = (char)((c & 3) << 6 | ((unsigned char)s[++i] & 0x3F));
        } else if (control) {
            to[m++] = control;
            i += 2;
        } else {
            return false;
        }
    }
    *n_to = m;
    return m < n;
}

il_status il_dicom_unquote(const char *charset, const char *text, size_t n, char **out, size_t *n_out, il_error *err)
{
    char *bytes = il_alloc(n + 1, 1);
    size_t n_bytes = 0, n_bad = 0;
    bool known = false;
    il_status st = bytes ? IL_OK : il_fail_nomem(err);
    *out = NULL;
    *n_out = 0;
    if (st == IL_OK && charset && !is_converted(charset) && find_bytes(text, n, bytes, &n_bytes))
        st = il_charset_to_utf8(charset, strlen(charset), bytes, n_bytes, out, n_out, &n_bad, &known, err);
    if (st != IL_OK || (*out && known && n_bad == 0)) {
        il_free(bytes);
        return st;
    }
    il_free(*out);
    *out = bytes;
    *n_out = restore_controls(text, n, bytes);
    return IL_OK;
}
