#include "config.h"
#include "input/map-value.h"
#include "base/number.h"
#include "base/text.h"

#include <math.h>
#include <string.h>

static const struct { const char *word; il_unit unit; } units[] = {
    { "m", IL_UNIT_M }, { "m.", IL_UNIT_M }, { "metre", IL_UNIT_M }, { "metres", IL_UNIT_M }, { "meter", IL_UNIT_M },
    { "meters", IL_UNIT_M }, { "ft", IL_UNIT_FT }, { "ft.", IL_UNIT_FT }, { "foot", IL_UNIT_FT }, { "feet", IL_UNIT_FT },
    { "'", IL_UNIT_FT }, { "km", IL_UNIT_KM }, { "mm", IL_UNIT_MM }, { "cm", IL_UNIT_CM } };

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool il_map_unit_word(const char *s, size_t n, il_unit *unit)
{
    for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
        if (il_text_is_word(s, n, units[k].word)) {
            *unit = units[k].unit;
            return true;
        }
    }
    return false;
}

/* The number at S[0..N), which may have a comma for its point; bytes read. */
static size_t parse_number(const char *s, size_t n, double *value)
{
    char copy[64];
    size_t used = il_number_parse(s, n, value);
    if (used == 0 || used >= n || s[used] != ',' || memchr(s, '.', used) || n > sizeof copy)
        return used;
    memcpy(copy, s, n);
    copy[used] = '.';
    return il_number_parse(copy, n, value);
}

bool il_map_value_parse(const char *s, size_t n, il_map_value *out)
{
    while (n > 0 && is_blank(*s))
        s++, n--;
    while (n > 0 && is_blank(s[n - 1]))
        n--;
    *out = (il_map_value){ 0, false, IL_UNIT_M };
    size_t used = parse_number(s, n, &out->number);
    if (used == 0 || !(fabs(out->number) < IL_COORDINATE_BOUND))
        return false;
    for (s += used, n -= used; n > 0 && is_blank(*s); n--)
        s++;
    out->has_unit = il_map_unit_word(s, n, &out->unit);
    return out->has_unit || n == 0;
}

/* Does a number start at S[K]?  A minus is a sign behind a blank only: "L-100". */
static bool starts_number(const char *s, size_t n, size_t k)
{
    bool sign = (s[k] == '-' || s[k] == '+') && k + 1 < n && (k == 0 || is_blank(s[k - 1]));
    return s[k + sign] >= '0' && s[k + sign] <= '9';
}

bool il_map_value_find(const char *s, size_t n, il_map_value *out)
{
    size_t found = 0;
    if (il_map_value_parse(s, n, out))
        return true;
    for (size_t k = 0, used; k < n; k += used > 0 ? used : 1) {
        used = starts_number(s, n, k) ? parse_number(s + k, n - k, &out->number) : 0;
        found += used > 0;
    }
    return found == 1 && fabs(out->number) < IL_COORDINATE_BOUND;
}
