#include "config.h"
#include "input/svg-level.h"
#include "base/number.h"
#include "input/svg-pen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- heights in attributes --------------------------------------------------- */

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

size_t il_svg_parse_millionths(const char *s, size_t n, double *value)
{
    enum { MANTISSA = 100 };
    size_t used = il_number_parse(s, n, value), m = 0;
    if (used == 0)
        return 0;
    while (m < used && s[m] != 'e' && s[m] != 'E')
        m++;
    long exponent = 0;
    bool negative = m + 1 < used && s[m + 1] == '-';
    for (size_t i = m; i < used; i++)
        if (is_digit(s[i]) && exponent < 10000)
            exponent = 10 * exponent + (s[i] - '0');
    char text[MANTISSA + 16];
    int length = snprintf(text, sizeof text, "%.*se%ld", (int)(m < MANTISSA ? m : MANTISSA), s,
                          (negative ? -exponent : exponent) + 6);
    if (m > MANTISSA || il_number_parse(text, (size_t)length, value) == 0)
        *value *= 1e6; /* nobody writes heights so; 1e6 times too large is refused later */
    return used;
}

typedef size_t number_parser(const char *s, size_t n, double *value);

static il_status read_height(il_svg_text *t, number_parser *parse, double *value, il_error *err)
{
    il_svg_text_more(t);
    size_t used = parse(t->s + t->at, t->n - t->at, value);
    il_svg_text rest = { t->name, t->s, t->n, t->at + used };
    if (used == 0 || il_svg_text_more(&rest))
        return il_svg_text_fail(t, err, "a height, one finite number, is expected");
    if (!(fabs(*value) < IL_SVG_COORDINATE_LIMIT))
        return il_fail(err, IL_E_INPUT, 0, "%s: a height must be below 1e15", t->name);
    *value += 0.0; /* no -0 */
    return IL_OK;
}

il_status il_svg_level_read(const il_svg_element *e, il_svg_level *level, bool *plate, il_error *err)
{
    static const struct { il_svg_namespace ns; const char *name; } plain[] = {
        { IL_SVG_NS_NONE, "data-z" }, { IL_SVG_NS_NONE, "z" }, { IL_SVG_NS_SLIC3R, "slice-z" } };
    il_svg_text t;
    *plate = il_svg_attr(e, IL_SVG_NS_SLIC3R, "slice-z", &t);
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
        if (il_svg_attr(e, plain[i].ns, plain[i].name, &t)) {
            level->kind = IL_SVG_LEVEL_HEIGHT;
            return read_height(&t, il_number_parse, &level->value, err);
        }
    }
    if (!il_svg_attr(e, IL_SVG_NS_SLIC3R, "z", &t))
        return IL_OK;
    t.name = "slic3r:z";
    level->kind = IL_SVG_LEVEL_SLIC3R;
    il_status st = read_height(&t, il_number_parse, &level->raw, err);
    if (st == IL_OK)
        il_svg_parse_millionths(t.s + t.at, t.n - t.at, &level->value);
    return st;
}

/* ---- heights and numbers in names --------------------------------------------- */

enum { LONGEST_NAME = 256 }; /* a name, not a text to search at length */

static const struct { const char *word; il_svg_level_kind kind; } words[] = {
    { "z", IL_SVG_LEVEL_HEIGHT },       { "height", IL_SVG_LEVEL_HEIGHT },
    { "elevation", IL_SVG_LEVEL_HEIGHT }, { "layer", IL_SVG_LEVEL_ORDINAL },
    { "slice", IL_SVG_LEVEL_ORDINAL },  { "section", IL_SVG_LEVEL_ORDINAL },
    { "level", IL_SVG_LEVEL_ORDINAL },  { "plane", IL_SVG_LEVEL_ORDINAL },
};

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool is_word_char(char c)
{
    return (lower(c) >= 'a' && lower(c) <= 'z') || is_digit(c) || (unsigned char)c >= 0x80;
}

static bool starts_with(const char *s, size_t n, const char *word)
{
    size_t len = strlen(word);
    for (size_t i = 0; i < len; i++)
        if (i >= n || lower(s[i]) != word[i])
            return false;
    return true;
}

/* The number at S[0..N), and nothing of a word or number behind it but "mm". */
static bool number_alone(const char *s, size_t n, double *value)
{
    double v;
    size_t used = il_number_parse(s, n, &v);
    if (used > 0 && used < n && s[used] == ' ')
        used += starts_with(s + used + 1, n - used - 1, "mm") ? 1 : 0;
    if (used > 0 && starts_with(s + used, n - used, "mm"))
        used += 2;
    if (used == 0 || (used < n && (is_word_char(s[used]) || s[used] == '.')))
        return false;
    *value = v;
    return fabs(v) < IL_SVG_COORDINATE_LIMIT;
}

/* Between a word and its number may stand blanks, "_", ":", "=", and for
 * ordinals also "-" and "#", which before a height would be its sign. */
static size_t skip_separators(const char *s, size_t n, il_svg_level_kind kind)
{
    size_t i = 0;
    while (i < n && s[i] != '\0' && strchr(kind == IL_SVG_LEVEL_ORDINAL ? " _:=-#" : " _:=", s[i]))
        i++;
    return i;
}

static il_svg_level_kind match_at(const char *s, size_t n, double *value)
{
    for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
        if (starts_with(s, n, words[w].word)) {
            size_t i = strlen(words[w].word);
            i += skip_separators(s + i, n - i, words[w].kind);
            if (number_alone(s + i, n - i, value))
                return words[w].kind;
        }
    }
    return IL_SVG_LEVEL_NONE;
}

il_svg_level_kind il_svg_level_of_name(const char *s, size_t n, bool bare, double *value)
{
    il_svg_level_kind best = IL_SVG_LEVEL_NONE;
    if (n > LONGEST_NAME)
        return best;
    if (bare && n > 0 && il_number_parse(s, n, value) == n && fabs(*value) < IL_SVG_COORDINATE_LIMIT)
        return IL_SVG_LEVEL_HEIGHT;
    for (size_t i = 0; i < n && best != IL_SVG_LEVEL_HEIGHT; i++) {
        double v;
        il_svg_level_kind kind = i > 0 && is_word_char(s[i - 1]) ? IL_SVG_LEVEL_NONE : match_at(s + i, n - i, &v);
        if (kind == IL_SVG_LEVEL_HEIGHT || (kind == IL_SVG_LEVEL_ORDINAL && best == IL_SVG_LEVEL_NONE)) {
            best = kind;
            *value = v;
        }
    }
    return best;
}

/* A height beats a number of slice; Inkscape's label, which people see, beats
 * the id, which programs make. */
void il_svg_level_read_name(const il_svg_element *e, il_svg_level *level)
{
    il_svg_text label, id;
    double of_label = 0, of_id = 0;
    il_svg_level_kind k = IL_SVG_LEVEL_NONE, i = IL_SVG_LEVEL_NONE;
    if (il_svg_attr(e, IL_SVG_NS_INKSCAPE, "label", &label))
        k = il_svg_level_of_name(label.s, label.n, true, &of_label);
    if (il_svg_attr(e, IL_SVG_NS_NONE, "id", &id))
        i = il_svg_level_of_name(id.s, id.n, strcmp(e->name, "g") == 0, &of_id);
    level->kind = i > k ? i : k;
    level->value = (i > k ? of_id : of_label) + 0.0;
    level->by_name = true;
}
