/* charset.c - DICOM's character sets (PS3.3, C.12.1.1.2; PS3.5, 6.1).
 *
 * Text is decoded a character at a time: where it begins, the sets in force say
 * how many bytes it has and what iconv calls their encoding.  The sets without
 * code extensions need no second way: their escape sequences just do not occur,
 * and where one does all the same, nothing else can be meant by it. */
#include "config.h"
#include "input/charset.h"
#include "base/alloc.h"
#include "base/text.h"

#include <ctype.h>
#include <errno.h>
#include <iconv.h>
#include <string.h>

/* ---- the sets --------------------------------------------------------------------- */

/* How many bytes a character has, and where the bits of the code table go. */
typedef enum shape {
    SHAPE_94,       /* one byte, 21 to 7E of the table */
    SHAPE_96,       /* one byte, 20 to 7F */
    SHAPE_94_94,    /* two bytes, each 21 to 7E */
    SHAPE_WHOLE     /* no part of ISO 2022: the bytes of all other characters too */
} shape;

/* final: the last byte of the escape sequences that designate it.  encoding: for
 * iconv, of characters with the high bits set and PREFIX before them; null where
 * decode_plain knows the characters. */
typedef struct set {
    shape shape;
    char final;
    const char *encoding;
    char prefix;
} set;

enum {
    NONE, ASCII, ROMAJI, KATAKANA, LATIN1, LATIN2, LATIN3, LATIN4, LATIN5, LATIN9, CYRILLIC, ARABIC, GREEK, HEBREW,
    THAI, KANJI, KANJI_MORE, HANGUL, HANZI, UTF8, GBK, GB18030, N_SETS
};

static const set sets[N_SETS] = {
    [ASCII] = { SHAPE_94, 'B', NULL, 0 },
    [ROMAJI] = { SHAPE_94, 'J', NULL, 0 },
    [KATAKANA] = { SHAPE_94, 'I', NULL, 0 },
    [LATIN1] = { SHAPE_96, 'A', NULL, 0 },
    [LATIN2] = { SHAPE_96, 'B', "ISO-8859-2", 0 },
    [LATIN3] = { SHAPE_96, 'C', "ISO-8859-3", 0 },
    [LATIN4] = { SHAPE_96, 'D', "ISO-8859-4", 0 },
    [LATIN5] = { SHAPE_96, 'M', "ISO-8859-9", 0 },
    [LATIN9] = { SHAPE_96, 'b', "ISO-8859-15", 0 },
    [CYRILLIC] = { SHAPE_96, 'L', "ISO-8859-5", 0 },
    [ARABIC] = { SHAPE_96, 'G', "ISO-8859-6", 0 },
    [GREEK] = { SHAPE_96, 'F', "ISO-8859-7", 0 },
    [HEBREW] = { SHAPE_96, 'H', "ISO-8859-8", 0 },
    [THAI] = { SHAPE_96, 'T', "TIS-620", 0 },
    [KANJI] = { SHAPE_94_94, 'B', "EUC-JP", 0 },
    [KANJI_MORE] = { SHAPE_94_94, 'D', "EUC-JP", '\x8F' },
    [HANGUL] = { SHAPE_94_94, 'C', "EUC-KR", 0 },
    [HANZI] = { SHAPE_94_94, 'A', "EUC-CN", 0 },
    [UTF8] = { SHAPE_WHOLE, 0, NULL, 0 },
    [GBK] = { SHAPE_WHOLE, 0, "GBK", 0 },
    [GB18030] = { SHAPE_WHOLE, 0, "GB18030", 0 },
};

/* ---- what a file calls them ---------------------------------------------------------- */

/* The names of PS3.3 without blanks, '_' and '-', all of which stand for one
 * another in files, and what else occurs.  g0, g1: the sets in force at the
 * beginning of a text when this is the first value. */
static const struct term {
    const char *name;
    int g0, g1;
} terms[] = {
    { "", ASCII, NONE }, { "IR6", ASCII, NONE }, { "ISO646", ASCII, NONE }, { "ASCII", ASCII, NONE },
    { "USASCII", ASCII, NONE }, { "IR13", ROMAJI, KATAKANA }, { "IR14", ROMAJI, KATAKANA },
    { "IR100", ASCII, LATIN1 }, { "IR101", ASCII, LATIN2 }, { "IR109", ASCII, LATIN3 }, { "IR110", ASCII, LATIN4 },
    { "IR126", ASCII, GREEK }, { "IR127", ASCII, ARABIC }, { "IR138", ASCII, HEBREW }, { "IR144", ASCII, CYRILLIC },
    { "IR148", ASCII, LATIN5 }, { "IR166", ASCII, THAI }, { "IR203", ASCII, LATIN9 },
    { "IR87", ASCII, NONE }, { "IR159", ASCII, NONE }, { "IR149", ASCII, HANGUL }, { "IR58", ASCII, HANZI },
    { "IR192", ASCII, UTF8 }, { "UTF8", ASCII, UTF8 }, { "GBK", ASCII, GBK }, { "GB18030", ASCII, GB18030 },
    { "88591", ASCII, LATIN1 }, { "88592", ASCII, LATIN2 }, { "88593", ASCII, LATIN3 }, { "88594", ASCII, LATIN4 },
    { "88595", ASCII, CYRILLIC }, { "88596", ASCII, ARABIC }, { "88597", ASCII, GREEK }, { "88598", ASCII, HEBREW },
    { "88599", ASCII, LATIN5 }, { "885911", ASCII, THAI }, { "885915", ASCII, LATIN9 },
};

/* The value S[0..N) reduced to the form in `terms`, in KEY[SIZE]; false when it
 * is too long for any. */
static bool reduce(const char *s, size_t n, char *key, size_t size)
{
    size_t used = 0;
    for (size_t i = 0; i < n; i++) {
        if (s[i] == ' ' || s[i] == '_' || s[i] == '-' || s[i] == '\0')
            continue;
        if (used + 1 >= size)
            return false;
        key[used++] = (char)toupper((unsigned char)s[i]);
    }
    key[used] = '\0';
    return true;
}

static const char *without(const char *s, const char *prefix)
{
    size_t n = strlen(prefix);
    return strncmp(s, prefix, n) == 0 ? s + n : s;
}

static const struct term *find_term(const char *s, size_t n)
{
    char key[24];
    if (!reduce(s, n, key, sizeof key))
        return NULL;
    const char *name = strcmp(key, "ISO646") == 0 ? key : without(key, "ISO");
    name = strncmp(name, "2022IR", 6) == 0 ? name + 4 : name;
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++)
        if (strcmp(terms[i].name, name) == 0 && (*name || !*key))
            return &terms[i];
    return NULL;
}

/* The first value says what a text begins with.  Where that leaves the upper
 * half empty, a set of the other values for which no escape sequence is needed
 * takes it: files that omit the sequence can mean nothing else. */
static const struct term *begin_of(const char *defined, size_t n)
{
    const struct term *first = NULL;
    for (size_t from = 0, k = 0; from <= n; k++) {
        const char *stop = memchr(defined + from, '\\', n - from);
        size_t to = stop ? (size_t)(stop - defined) : n;
        const struct term *t = find_term(defined + from, to - from);
        if (k == 0)
            first = t;
        else if (first && first->g0 == ASCII && first->g1 == NONE && t && t->g1 != NONE && t->g0 == ASCII)
            first = t;
        from = to + 1;
    }
    return first;
}

/* ---- characters ---------------------------------------------------------------------- */

/* g0, g1: in force for bytes below and above 80; begin: at the beginning of a
 * line.  converter: opened when first wanted. */
typedef struct decoder {
    const struct term *begin;
    int g0, g1;
    iconv_t converter[N_SETS];
    bool is_open[N_SETS];
    bool is_missing;            /* this system's iconv lacks an encoding */
    char *out;
    size_t n_out, cap, n_bad;
} decoder;

/* Room is made here, in advance, for a terminator. */
static bool put(decoder *d, const char *s, size_t n)
{
    if (!il_grow(&d->out, &d->cap, d->n_out + n + 1, 1))
        return false;
    memcpy(d->out + d->n_out, s, n);
    d->n_out += n;
    return true;
}

static bool put_code(decoder *d, unsigned code)
{
    char s[4];
    return put(d, s, il_utf8_encode(s, code));
}

static bool put_bad(decoder *d)
{
    d->n_bad++;
    return put_code(d, 0xFFFD);
}

/* The N bytes at IN as one character of set K. */
static bool put_converted(decoder *d, int k, char *in, size_t n)
{
    char text[16], *to = text;
    size_t left = sizeof text;
    if (!d->is_open[k]) {
        d->converter[k] = iconv_open("UTF-8", sets[k].encoding);
        d->is_open[k] = d->converter[k] != (iconv_t)-1;
        d->is_missing |= !d->is_open[k] && errno == EINVAL;
        if (!d->is_open[k])
            return d->is_missing;
    }
    if (iconv(d->converter[k], &in, &n, &to, &left) != (size_t)-1)
        return put(d, text, sizeof text - left);
    iconv(d->converter[k], NULL, NULL, NULL, NULL);
    return put_bad(d);
}

/* Byte C, high bit dropped, of a set whose characters need no table. */
static bool put_plain(decoder *d, int k, unsigned c)
{
    if (k == LATIN1)
        return put_code(d, c | 0x80);
    if (c <= ' ' || c == 0x7F || (k == KATAKANA && c > 0x5F))
        return put_bad(d);
    if (k == KATAKANA)
        return put_code(d, 0xFF61 + c - 0x21);
    if (k == ROMAJI && c == 0x5C)
        return put_code(d, 0xA5);
    if (k == ROMAJI && c == 0x7E)
        return put_code(d, 0x203E);
    return put_code(d, c);
}

/* Is the byte C part of a table of 94, in either half? */
static bool is_graphic(char c)
{
    return (c & 0x7F) > ' ' && (c & 0x7F) != 0x7F;
}

/* The character of set K at S[0..N), N at least 1; *USED bytes. */
static bool take_character(decoder *d, int k, const char *s, size_t n, size_t *used)
{
    char in[3];
    size_t length = 0;
    *used = 1;
    if (k == NONE)
        return put_bad(d);
    if (!sets[k].encoding)
        return put_plain(d, k, (unsigned char)*s & 0x7Fu);
    bool is_pair = sets[k].shape == SHAPE_94_94;
    if (is_pair && (n < 2 || ((s[0] ^ s[1]) & 0x80) || !is_graphic(s[0]) || !is_graphic(s[1])))
        return put_bad(d);
    *used = is_pair ? 2 : 1;
    if (sets[k].prefix)
        in[length++] = sets[k].prefix;
    for (size_t i = 0; i < *used; i++)
        in[length++] = (char)(s[i] | 0x80);
    return put_converted(d, k, in, length);
}

/* The same of a set that is no part of ISO 2022; the byte is above 7F. */
static bool take_whole(decoder *d, int k, const char *s, size_t n, size_t *used)
{
    char in[4];
    *used = 1;
    if (k == UTF8) {
        size_t length = il_utf8_char(s, n, NULL);
        *used = length > 0 ? length : 1;
        return length > 0 ? put(d, s, length) : put_bad(d);
    }
    size_t length = n >= 2 && s[1] >= '0' && s[1] <= '9' ? 4 : 2, bad = d->n_bad;
    if (n < length)
        return put_bad(d);
    memcpy(in, s, length);
    if (!put_converted(d, k, in, length))
        return false;
    *used = d->n_bad == bad ? length : 1;
    return true;
}

/* ---- texts --------------------------------------------------------------------------- */

enum { ESCAPE = 0x1B };

/* Every line, page and value begins with the sets that the first value names. */
static void reset(decoder *d)
{
    d->g0 = d->begin->g0;
    d->g1 = d->begin->g1;
}

static int find_set(shape s, char final)
{
    if (s == SHAPE_94_94 && final == '@') /* the table of 1978 */
        final = 'B';
    for (int k = 0; k < N_SETS; k++)
        if (sets[k].final == final && final && sets[k].shape == s)
            return k;
    return NONE;
}

/* The escape sequence at S[0..N), if it is one that designates a set: its
 * length, else 0.  ESC $ F is short for ESC $ ( F. */
static size_t take_escape(decoder *d, const char *s, size_t n)
{
    size_t i = 1;
    bool is_pair = i < n && s[i] == '$', is_upper = false, is_96 = false;
    i += is_pair;
    if (i < n && (s[i] == '(' || s[i] == ')' || (s[i] == '-' && !is_pair))) {
        is_upper = s[i] != '(';
        is_96 = s[i] == '-';
        i++;
    } else if (!is_pair) {
        return 0;
    }
    int k = i < n ? find_set(is_pair ? SHAPE_94_94 : is_96 ? SHAPE_96 : SHAPE_94, s[i]) : NONE;
    if (k == NONE)
        return 0;
    *(is_upper ? &d->g1 : &d->g0) = k;
    return i + 1;
}

static bool is_line_end(char c)
{
    return c == '\n' || c == '\r' || c == '\f' || c == '\t';
}

/* Whatever stands at S[0..N): *USED bytes of it. */
static bool take_next(decoder *d, const char *s, size_t n, size_t *used)
{
    unsigned char c = (unsigned char)*s;
    bool is_whole = sets[d->g1].shape == SHAPE_WHOLE;
    *used = 1;
    if (c == ESCAPE && !is_whole && (*used = take_escape(d, s, n)) > 0)
        return true;
    *used = 1;
    if (c == '\0')
        return put_bad(d);
    if (is_line_end(*s))
        reset(d);
    if (c <= ' ' || c == 0x7F)
        return put_code(d, c);
    if (is_whole && c >= 0x80)
        return take_whole(d, d->g1, s, n, used);
    return take_character(d, c < 0x80 ? d->g0 : d->g1, s, n, used);
}

static bool decode(decoder *d, const char *s, size_t n)
{
    size_t used;
    for (reset(d); n > 0 && !d->is_missing; s += used, n -= used)
        if (!take_next(d, s, n, &used))
            return false;
    return true;
}

/* UTF-8 if it is that, else ISO-8859-1. */
static bool decode_unknown(decoder *d, const char *s, size_t n)
{
    d->begin = find_term(il_utf8_valid(s, n) ? "UTF8" : "IR100", il_utf8_valid(s, n) ? 4 : 5);
    d->is_missing = false;
    d->n_out = d->n_bad = 0;
    return decode(d, s, n);
}

il_status il_charset_to_utf8(const char *defined, size_t n_defined, const char *text, size_t n,
                             char **out, size_t *n_out, size_t *n_bad, bool *known, il_error *err)
{
    decoder d = { .begin = begin_of(defined, n_defined) };
    bool ok = !d.begin || decode(&d, text, n);
    *known = d.begin && !d.is_missing;
    if (ok && !*known)
        ok = decode_unknown(&d, text, n);
    ok = ok && put(&d, "", 0);
    for (int k = 0; k < N_SETS; k++)
        if (d.is_open[k])
            iconv_close(d.converter[k]);
    if (ok)
        d.out[d.n_out] = '\0';
    else
        il_free(d.out);
    *out = ok ? d.out : NULL;
    *n_out = ok ? d.n_out : 0;
    if (n_bad)
        *n_bad = ok ? d.n_bad : 0;
    return ok ? IL_OK : il_fail_nomem(err);
}
