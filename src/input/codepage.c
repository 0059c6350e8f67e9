/* codepage.c - iconv behind the names that DXF files, dBASE files and .cpg files use.
 *
 * Only names of the tables here reach iconv: what else a file may say is no name of
 * a module to load. */
#include "config.h"
#include "input/codepage.h"
#include "base/alloc.h"
#include "base/text.h"
#include "input/charset.h"

#include <errno.h>
#include <iconv.h>
#include <stdint.h>
#include <string.h>

/* word: the name in small letters and digits alone, without the words before the
 * number of a page. */
static const struct page { const char *word, *encoding; } pages[] = {
    { "437", "CP437" },       { "737", "CP737" },       { "775", "CP775" },       { "850", "CP850" },
    { "852", "CP852" },       { "855", "CP855" },       { "857", "CP857" },       { "858", "CP858" },
    { "860", "CP860" },       { "861", "CP861" },       { "862", "CP862" },       { "863", "CP863" },
    { "864", "CP864" },       { "865", "CP865" },       { "866", "CP866" },       { "869", "CP869" },
    { "874", "CP874" },       { "932", "CP932" },       { "936", "CP936" },       { "949", "CP949" },
    { "950", "CP950" },       { "1250", "CP1250" },     { "1251", "CP1251" },     { "1252", "CP1252" },
    { "1253", "CP1253" },     { "1254", "CP1254" },     { "1255", "CP1255" },     { "1256", "CP1256" },
    { "1257", "CP1257" },     { "1258", "CP1258" },     { "1361", "JOHAB" },      { "johab", "JOHAB" },
    { "big5", "BIG5" },       { "gb2312", "CP936" },    { "gbk", "CP936" },       { "gb18030", "GB18030" },
    { "sjis", "CP932" },      { "shiftjis", "CP932" },  { "ksc5601", "CP949" },   { "euckr", "CP949" },
    { "eucjp", "EUC-JP" },    { "koi8r", "KOI8-R" },    { "mac", "MACINTOSH" },   { "macintosh", "MACINTOSH" },
    { "macroman", "MACINTOSH" }, { "latin1", "ISO-8859-1" },
    { "88591", "ISO-8859-1" }, { "88592", "ISO-8859-2" }, { "88593", "ISO-8859-3" }, { "88594", "ISO-8859-4" },
    { "88595", "ISO-8859-5" }, { "88596", "ISO-8859-6" }, { "88597", "ISO-8859-7" }, { "88598", "ISO-8859-8" },
    { "88599", "ISO-8859-9" }, { "885910", "ISO-8859-10" }, { "885913", "ISO-8859-13" }, { "885915", "ISO-8859-15" },
    { "utf8", "UTF-8" },      { "65001", "UTF-8" },
};

/* The language drivers of dBASE and of the products that followed it. */
static const struct driver { unsigned char driver; const char *page; } drivers[] = {
    { 0x01, "437" },  { 0x02, "850" },  { 0x03, "1252" }, { 0x04, "mac" },  { 0x08, "865" },  { 0x09, "437" },
    { 0x0A, "850" },  { 0x0B, "437" },  { 0x0D, "437" },  { 0x0E, "850" },  { 0x0F, "437" },  { 0x10, "850" },
    { 0x11, "437" },  { 0x12, "850" },  { 0x13, "932" },  { 0x14, "850" },  { 0x15, "437" },  { 0x16, "850" },
    { 0x17, "865" },  { 0x18, "437" },  { 0x19, "437" },  { 0x1A, "850" },  { 0x1B, "437" },  { 0x1C, "863" },
    { 0x1D, "850" },  { 0x1F, "852" },  { 0x22, "852" },  { 0x23, "852" },  { 0x24, "860" },  { 0x25, "850" },
    { 0x26, "866" },  { 0x37, "850" },  { 0x40, "852" },  { 0x4D, "936" },  { 0x4E, "949" },  { 0x4F, "950" },
    { 0x50, "874" },  { 0x57, "1252" }, { 0x58, "1252" }, { 0x59, "1252" }, { 0x64, "852" },  { 0x65, "866" },
    { 0x66, "865" },  { 0x67, "861" },  { 0x6A, "737" },  { 0x6B, "857" },  { 0x6C, "863" },  { 0x78, "950" },
    { 0x79, "949" },  { 0x7A, "936" },  { 0x7B, "932" },  { 0x7C, "874" },  { 0x86, "737" },  { 0x87, "852" },
    { 0x88, "857" },  { 0xC8, "1250" }, { 0xC9, "1251" }, { 0xCA, "1254" }, { 0xCB, "1253" }, { 0xCC, "1257" },
};

/* ---- names ------------------------------------------------------------------------ */

static const char *without(const char *s, const char *prefix)
{
    size_t n = strlen(prefix);
    return strncmp(s, prefix, n) == 0 && s[n] >= '0' && s[n] <= '9' ? s + n : s;
}

/* NAME in small letters and digits in KEY[SIZE]; false when no page's name is so long. */
static bool reduce(const char *name, size_t n, char *key, size_t size)
{
    size_t used = 0;
    for (size_t i = 0; i < n; i++) {
        char c = name[i] >= 'A' && name[i] <= 'Z' ? (char)(name[i] - 'A' + 'a') : name[i];
        if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')))
            continue;
        if (used + 1 >= size)
            return false;
        key[used++] = c;
    }
    key[used] = '\0';
    return true;
}

static const char *find_encoding(const char *name, size_t n)
{
    static const char *const prefixes[] = { "ansi", "windows", "cp", "ms", "dos", "oem", "ibm", "iso" };
    char key[24];
    if (!reduce(name, n, key, sizeof key))
        return NULL;
    const char *word = key;
    for (size_t k = 0; k < sizeof prefixes / sizeof *prefixes && word == key; k++)
        word = without(key, prefixes[k]);
    for (size_t k = 0; k < sizeof pages / sizeof *pages; k++)
        if (strcmp(pages[k].word, word) == 0)
            return pages[k].encoding;
    return NULL;
}

bool il_codepage_set(il_codepage *c, const char *name, size_t n)
{
    const char *encoding = find_encoding(name, n);
    if (!encoding)
        return false;
    bool is_utf8 = strcmp(encoding, "UTF-8") == 0;
    iconv_t converter = is_utf8 ? NULL : iconv_open("UTF-8", encoding);
    if (converter == (iconv_t)-1)
        return false;
    il_codepage_free(c);
    c->kind = is_utf8 ? IL_CODEPAGE_UTF8 : IL_CODEPAGE_ICONV;
    c->converter = converter;
    return true;
}

bool il_codepage_set_dbase(il_codepage *c, unsigned driver)
{
    for (size_t k = 0; k < sizeof drivers / sizeof *drivers; k++)
        if (drivers[k].driver == driver)
            return il_codepage_set(c, drivers[k].page, strlen(drivers[k].page));
    return false;
}

void il_codepage_free(il_codepage *c)
{
    if (c->kind == IL_CODEPAGE_ICONV)
        iconv_close(c->converter);
    *c = (il_codepage)IL_CODEPAGE_INIT;
}

/* ---- texts ------------------------------------------------------------------------- */

typedef struct text { char *s; size_t n, cap; } text;

/* Room behind what is there for a character in UTF-8, several of which a byte may be. */
enum { ROOM = 64 };

/* Convert on: what is left at *IN.  Stops where something is no character, or at the end. */
static bool convert_some(iconv_t converter, char **in, size_t *left, text *to)
{
    size_t done = 0;
    do {
        if (!il_grow(&to->s, &to->cap, to->n + *left + ROOM, 1))
            return false;
        char *out = to->s + to->n;
        size_t room = to->cap - to->n - 4;
        done = iconv(converter, *left > 0 ? in : NULL, left, &out, &room);
        to->n = (size_t)(out - to->s);
    } while (done == (size_t)-1 && errno == E2BIG);
    return true;
}

static bool convert(iconv_t converter, const char *s, size_t n, text *to)
{
    char *in = (char *)(uintptr_t)s; /* iconv(3) takes no const */
    iconv(converter, NULL, NULL, NULL, NULL);
    while (n > 0) {
        if (!convert_some(converter, &in, &n, to))
            return false;
        if (n > 0) {
            memcpy(to->s + to->n, "\xEF\xBF\xBD", 3);
            to->n += 3;
            in++, n--;
            iconv(converter, NULL, NULL, NULL, NULL);
        }
    }
    return convert_some(converter, &in, &n, to);
}

il_status il_codepage_text(il_codepage *c, const char *s, size_t n, char **out, size_t *n_out, il_error *err)
{
    text to = { NULL, 0, 0 };
    bool known;
    if (c->kind != IL_CODEPAGE_ICONV)
        return il_charset_to_utf8(c->kind == IL_CODEPAGE_UTF8 ? "UTF8" : "unknown", c->kind == IL_CODEPAGE_UTF8 ? 4 : 7,
                                  s, n, out, n_out, NULL, &known, err);
    if (!convert(c->converter, s, n, &to)) {
        il_free(to.s);
        return il_fail_nomem(err);
    }
    to.s[to.n] = '\0';
    *out = to.s;
    *n_out = to.n;
    return IL_OK;
}
