#include "config.h"
#include "base/pattern.h"
#include "base/text.h"

#include <stddef.h>
#include <string.h>

/* Bytes that are no UTF-8 lie behind all characters. */
enum { BYTES_FROM = 0x110000 };

/* The character at *S, which is not at its end; *S goes behind it. */
static unsigned long next_character(const char **s)
{
    unsigned long code = 0;
    size_t n = il_utf8_char(*s, strnlen(*s, 4), &code);
    if (n == 0)
        code = BYTES_FROM + (unsigned char)**s;
    *s += n > 0 ? n : 1;
    return code;
}

/* As in a set: a backslash takes away what the next character means. */
static unsigned long next_plain(const char **s)
{
    if (**s == '\\' && (*s)[1])
        (*s)++;
    return next_character(s);
}

/* The set that begins behind a [ at *P, which goes behind its ].  0 or 1: C is
 * out of it, or in it; -1: it has no end, and *P is as it was.  A ] that comes
 * first is one of the set. */
static int match_set(const char **p, unsigned long c)
{
    const char *s = *p;
    bool others = *s == '!' || *s == '^', in = false;
    s += others;
    for (bool first = true; *s && (first || *s != ']'); first = false) {
        unsigned long from = next_plain(&s), to = from;
        if (s[0] == '-' && s[1] && s[1] != ']') {
            s++;
            to = next_plain(&s);
        }
        in |= c >= from && c <= to;
    }
    if (*s != ']')
        return -1;
    *p = s + 1;
    return in != others;
}

/* Does the part of the pattern at *P that stands for one character match that at
 * *NAME?  Both go behind it if so. */
static bool match_one(const char **p, const char **name)
{
    const char *q = *p, *rest = *name;
    if (!*q || !*rest)
        return false;
    unsigned long c = next_character(&rest);
    bool same;
    if (*q == '?') {
        q++;
        same = true;
    } else if (*q == '[') {
        q++;
        int in = match_set(&q, c);
        same = in == 1 || (in < 0 && c == '[');
    } else {
        same = next_plain(&q) == c;
    }
    if (same) {
        *p = q;
        *name = rest;
    }
    return same;
}

/* Behind the last * so far all is tried again one character later: what an
 * earlier * took need never change. */
bool il_pattern_matches(const char *pattern, const char *name)
{
    const char *star = NULL, *again = NULL;
    for (;;) {
        if (*pattern == '*') {
            star = ++pattern;
            again = name;
        } else if (!*pattern && !*name) {
            return true;
        } else if (!match_one(&pattern, &name)) {
            if (!star || !*again)
                return false;
            next_character(&again);
            pattern = star;
            name = again;
        }
    }
}

bool il_pattern_choose(const char *const *pattern, size_t n, const char *name, bool *matched)
{
    bool wanted = false, any = false, unwanted = false;
    for (size_t k = 0; k < n; k++) {
        const char *p = pattern[k];
        bool negated = *p == '!', matches = il_pattern_matches(p + negated, name);
        any |= !negated;
        wanted |= !negated && matches;
        unwanted |= negated && matches;
        if (matched)
            matched[k] |= matches;
    }
    return !unwanted && (wanted || !any);
}
