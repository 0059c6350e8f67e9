/* geojson-lead.c - how texts in JSON begin: what stands before the first value, and
 * whether one may be GeoJSON at all.
 *
 * Any object of JSON is taken for GeoJSON when no other reader knows it: that reader
 * can say what it is instead. */
#include "config.h"
#include "input/geojson.h"

#include <string.h>

/* ---- JavaScript ---------------------------------------------------------------- */

static bool in_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '$' || c == '.' ||
           (unsigned char)c >= 0x80;
}

static size_t skip_name(const char *s, size_t n, size_t i)
{
    while (i < n && in_name(s[i]))
        i++;
    return i;
}

static size_t skip_mark(const char *s, size_t n)
{
    return n >= 3 && memcmp(s, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

static bool declares(const char *s, size_t n)
{
    static const char *const words[] = { "var", "let", "const", "export" };
    for (size_t k = 0; k < sizeof words / sizeof *words; k++)
        if (strlen(words[k]) == n && memcmp(words[k], s, n) == 0)
            return true;
    return false;
}

/* Names, the words of a declaration but for the last, then = or an opening bracket,
 * and behind it a value. */
size_t il_geojson_lead(const char *s, size_t n, bool *is_call)
{
    size_t i = il_json_skip_blanks(s, n, skip_mark(s, n)), begin = i, end = skip_name(s, n, i);
    *is_call = false;
    while (end > begin && declares(s + begin, end - begin)) {
        begin = il_json_skip_blanks(s, n, end);
        end = skip_name(s, n, begin);
    }
    bool is_plain = begin == i;
    i = il_json_skip_blanks(s, n, end);
    if (end == begin || i == n || (s[i] != '=' && !(is_plain && s[i] == '(')))
        return 0;
    *is_call = s[i++] == '(';
    return il_json_behind(s, n, i, '{') || il_json_behind(s, n, i, '[') ? i : 0;
}

/* ---- telling it apart ------------------------------------------------------------ */

/* Behind the string that begins behind the quote at S[I - 1]; 0 when it does not end. */
static size_t behind_string(const char *s, size_t n, size_t i)
{
    for (; i < n && s[i] != '"'; i++)
        i += s[i] == '\\';
    return i < n ? i + 1 : 0;
}

/* An object at S[I..N), with a key or empty, or an array that begins with one. */
static bool begins_object(const char *s, size_t n, size_t i)
{
    size_t list = il_json_behind(s, n, i, '['), object = il_json_behind(s, n, list ? list : i, '{');
    size_t key = object ? il_json_behind(s, n, object, '"') : 0, end = key ? behind_string(s, n, key) : 0;
    return object && ((end && il_json_behind(s, n, end, ':')) || il_json_behind(s, n, object, '}'));
}

/* Behind blanks and RS. */
static size_t skip_separators(const char *s, size_t n, size_t i)
{
    do
        i = il_json_skip_blanks(s, n, i);
    while (i < n && s[i] == '\x1e' && i++ < n);
    return i;
}

bool il_geojson_probe(const unsigned char *head, size_t n)
{
    const char *s = (const char *)head;
    bool is_call;
    size_t lead = il_geojson_lead(s, n, &is_call), first = skip_separators(s, n, skip_mark(s, n));
    bool declared = lead && declares(s + first, skip_name(s, n, first) - first); /* the reader says what is wrong with it */
    return declared || begins_object(s, n, lead ? lead : first);
}

/* Behind the value that S[I] opens; 0 when it does not end in this line. */
static size_t behind_value(const char *s, size_t n, size_t i)
{
    size_t depth = 0;
    do {
        char c = s[i++];
        if (c == '\n' || (c == '"' && (i = behind_string(s, n, i)) == 0))
            return 0;
        depth += c == '{' || c == '[';
        depth -= c == '}' || c == ']';
    } while (depth > 0 && i < n);
    return depth == 0 ? i : 0;
}

bool il_geojson_probe_sequence(const unsigned char *head, size_t n)
{
    const char *s = (const char *)head;
    size_t mark = skip_mark(s, n), i = skip_separators(s, n, mark);
    if (i == n || s[i] != '{' || !begins_object(s, n, i))
        return false;
    if (memchr(s + mark, '\x1e', i - mark))
        return true;
    size_t end = behind_value(s, n, i), next = end ? il_json_behind(s, n, end, '{') : 0;
    return next > 0 && memchr(s + end, '\n', next - end);
}
