#include "config.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

size_t il_utf8_char(const char *s, size_t n, unsigned long *code)
{
    const unsigned char *u = (const unsigned char *)s;
    static const unsigned long least[5] = { 0, 0, 0x80, 0x800, 0x10000 };
    if (n == 0)
        return 0;
    size_t len = u[0] < 0x80 ? 1 : u[0] < 0xC2 ? 0 : u[0] < 0xE0 ? 2 : u[0] < 0xF0 ? 3 : u[0] < 0xF5 ? 4 : 0;
    if (len == 0 || len > n)
        return 0;
    unsigned long c = len == 1 ? u[0] : u[0] & (0x7Fu >> len);
    for (size_t i = 1; i < len; i++) {
        if ((u[i] & 0xC0) != 0x80)
            return 0;
        c = c << 6 | (u[i] & 0x3F);
    }
    if (c < least[len] || c > 0x10FFFF || (c >= 0xD800 && c < 0xE000))
        return 0;
    if (code)
        *code = c;
    return len;
}

size_t il_utf8_encode(char to[4], unsigned long code)
{
    static const unsigned char lead[] = { 0, 0, 0xC0, 0xE0, 0xF0 };
    size_t n = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t i = n - 1; i > 0; i--, code >>= 6)
        to[i] = (char)(unsigned char)(0x80 | (code & 0x3F));
    to[0] = (char)(unsigned char)(lead[n] | code);
    return n;
}

bool il_utf8_valid(const char *s, size_t n)
{
    for (size_t i = 0; i < n;) {
        size_t len = il_utf8_char(s + i, n - i, NULL);
        if (len == 0)
            return false;
        i += len;
    }
    return true;
}

/* Characters that move or hide what follows: controls, and the direction
 * marks and overrides with which a name can be made to read as another. */
static bool is_harmful(unsigned long c)
{
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x200E && c <= 0x200F) ||
           (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || c == 0xFEFF;
}

size_t il_text_printable(char *to, size_t size, const char *s, size_t n)
{
    static const char hex[] = "0123456789abcdef";
    size_t used = 0;
    for (size_t i = 0; i < n;) {
        unsigned long c = 0;
        size_t len = il_utf8_char(s + i, n - i, &c);
        bool raw = len > 0 && !is_harmful(c);
        size_t bytes = len > 0 ? len : 1, need = raw ? bytes : 4 * bytes;
        if (used + need + 1 > size)
            break;
        for (size_t k = 0; k < bytes; k++) {
            unsigned char b = (unsigned char)s[i + k];
            if (raw) {
                to[used++] = s[i + k];
            } else {
                to[used++] = '\\', to[used++] = 'x';
                to[used++] = hex[b >> 4], to[used++] = hex[b & 15];
            }
        }
        i += bytes;
    }
    if (size > 0)
        to[used] = '\0';
    return used;
}

bool il_text_is(const char *s, size_t n, const char *word)
{
    return strlen(word) == n && memcmp(s, word, n) == 0;
}

bool il_text_is_word(const char *s, size_t n, const char *word)
{
    return strlen(word) == n && strncasecmp(s, word, n) == 0;
}

bool il_text_begins(const char *s, size_t n, const char *with)
{
    size_t len = strlen(with);
    return n >= len && memcmp(s, with, len) == 0;
}

bool il_text_contains(const char *s, size_t n, const char *what)
{
    for (size_t i = 0; i < n; i++)
        if (il_text_begins(s + i, n - i, what))
            return true;
    return false;
}

int il_hex_digit(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

void il_text_append(char *to, size_t size, const char *format, ...)
{
    size_t n = strlen(to);
    va_list args;
    va_start(args, format);
    vsnprintf(to + n, size - n, format, args);
    va_end(args);
}
