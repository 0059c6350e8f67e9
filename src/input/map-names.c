#include "config.h"
#include "input/map-names.h"
#include "base/text.h"
#include "input/map-value.h"

#include <string.h>

enum { NAME_MOST = 64 };

/* In order of rank.  DRVAL1 and DRVAL2, VALDCO: depths in charts of the IHO's S-57;
 * contourele: as much of contourelevation as has room in a .dbf; propvalue: Ordnance Survey. */
static const struct { const char *word; bool is_depth; } usual[] = {
    { "elev", false }, { "elevation", false }, { "ele", false }, { "height", false }, { "contour", false },
    { "contourelevation", false }, { "contourele", false }, { "level", false }, { "z", false }, { "alt", false },
    { "altitude", false },
    { "hoogte", false }, { "hoehe", false }, { "h\xC3\xB6he", false }, { "h\xC3\x96he", false }, { "cota", false },
    { "quota", false }, { "kote", false }, { "altitud", false }, { "propvalue", false }, { "propertyvalue", false },
    { "depth", true }, { "isobath", true }, { "valdco", true }, { "drval", true } };

static const struct { const char *word; il_map_end end; } ends[] = {
    { "min", IL_MAP_END_LOW }, { "low", IL_MAP_END_LOW }, { "lower", IL_MAP_END_LOW }, { "from", IL_MAP_END_LOW },
    { "max", IL_MAP_END_HIGH }, { "high", IL_MAP_END_HIGH }, { "upper", IL_MAP_END_HIGH }, { "to", IL_MAP_END_HIGH },
    { "1", IL_MAP_END_LOW }, { "2", IL_MAP_END_HIGH }, { "emin", IL_MAP_END_LOW }, { "emax", IL_MAP_END_HIGH },
    { "amin", IL_MAP_END_LOW }, { "amax", IL_MAP_END_HIGH }, { "hmin", IL_MAP_END_LOW }, { "hmax", IL_MAP_END_HIGH } };

static bool take_usual(const char *s, size_t n, il_map_name *out)
{
    for (size_t k = 0; k < sizeof usual / sizeof *usual; k++) {
        if (il_text_is(s, n, usual[k].word)) {
            out->rank = out->rank < 0 || (int)k < out->rank ? (int)k : out->rank;
            out->is_depth |= usual[k].is_depth;
            return true;
        }
    }
    return false;
}

static bool take_unit(const char *s, size_t n, il_map_name *out)
{
    bool is_unit = il_map_unit_word(s, n, &out->unit);
    out->has_unit |= is_unit;
    return is_unit;
}

static bool take_end(const char *s, size_t n, il_map_name *out)
{
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
        if (il_text_is(s, n, ends[k].word)) {
            out->end = ends[k].end;
            return true;
        }
    }
    return false;
}

/* One word, or two without anything between them: ELEVMIN, DRVAL1. */
static bool take_word(const char *s, size_t n, il_map_name *out)
{
    if (take_usual(s, n, out) || take_unit(s, n, out) || take_end(s, n, out))
        return true;
    for (size_t k = 1; k < n; k++) {
        il_map_name both = *out;
        if (take_usual(s, k, &both) && take_end(s + k, n - k, &both)) {
            *out = both;
            return true;
        }
    }
    return false;
}

static bool is_joint(char c)
{
    return c == '_' || c == '-' || c == '.' || c == ' ' || c == '(' || c == ')' || c == '[' || c == ']';
}

/* The two heights of a band may be called just that: min, max. */
bool il_map_name_read(const char *name, size_t n, il_map_name *out)
{
    char s[NAME_MOST];
    const int least_rank = sizeof usual / sizeof *usual;
    *out = (il_map_name){ .rank = -1 };
    if (n == 0 || n > sizeof s)
        return false;
    for (size_t k = 0; k < n; k++)
        s[k] = name[k] >= 'A' && name[k] <= 'Z' ? (char)(name[k] - 'A' + 'a') : name[k];
    for (size_t begin = 0, end; begin < n; begin = end + 1) {
        for (end = begin; end < n && !is_joint(s[end]);)
            end++;
        if (end > begin && !take_word(s + begin, end - begin, out))
            return false;
    }
    if (out->rank < 0 && out->end != IL_MAP_END_NONE)
        out->rank = least_rank;
    return out->rank >= 0;
}
