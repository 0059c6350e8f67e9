/* text.h - bytes from files: what they are as UTF-8, and made fit to be shown. */
#ifndef IL_BASE_TEXT_H
#define IL_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Copy N bytes of S to TO[SIZE] so that a terminal shows them and obeys none:
 * control characters (C0, DEL, C1), bytes that are not UTF-8 and the Unicode
 * direction overrides become \xHH.  Cuts between characters; always
 * terminated.  Returns the bytes written without the terminator. */
size_t il_text_printable(char *to, size_t size, const char *s, size_t n);

/* Length in bytes (1 to 4) of the UTF-8 character at S[0..N), or 0 when it is
 * malformed, overlong, a surrogate or above U+10FFFF (RFC 3629).  *CODE, if
 * not null, gets the code point. */
size_t il_utf8_char(const char *s, size_t n, unsigned long *code);

/* CODE, up to U+10FFFF, as UTF-8 at TO; its length in bytes. */
size_t il_utf8_encode(char to[4], unsigned long code);

bool il_utf8_valid(const char *s, size_t n);

/* Are the N bytes at S the text WORD; without regard to the case of ASCII letters? */
bool il_text_is(const char *s, size_t n, const char *word);
bool il_text_is_word(const char *s, size_t n, const char *word);

/* Do the N bytes at S begin with the text WITH, and do they contain the text WHAT? */
bool il_text_begins(const char *s, size_t n, const char *with);
bool il_text_contains(const char *s, size_t n, const char *what);

/* Add printf-formatted words to the text at TO[SIZE], as much as fits. */
void il_text_append(char *to, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The value of the hexadecimal digit C, in either case; -1 when it is none. */
int il_hex_digit(char c);

#endif
