#include "config.h"
#include "input/charset.h"
#include "base/alloc.h"
#include "base/text.h"

#include <string.h>

il_status il_charset_to_utf8(const char *defined, size_t n_defined, const char *text, size_t n,
                             char **out, size_t *n_out, size_t *n_bad, bool *known, il_error *err)
{
    (void)defined;
    *known = n_defined == 0;
    *n_bad = *n_out = 0;
    *out = il_alloc(3 * n + 1, 1);
    if (!*out)
        return il_fail_nomem(err);
    bool is_utf8 = il_utf8_valid(text, n);
    for (size_t i = 0; i < n; i++) {
        unsigned char c = (unsigned char)text[i];
        if (c == 0) {
            memcpy(*out + *n_out, "\xEF\xBF\xBD", 3);
            *n_out += 3;
            ++*n_bad;
        } else if (c < 0x80 || is_utf8) {
            (*out)[(*n_out)++] = (char)c;
        } else {
            (*out)[(*n_out)++] = (char)(0xC0 | c >> 6);
            (*out)[(*n_out)++] = (char)(0x80 | (c & 0x3F));
        }
    }
    (*out)[*n_out] = '\0';
    return IL_OK;
}
