#include "config.h"
#include "input/wkt.h"
#include "base/number.h"
#include "base/text.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* What is inside of the brackets behind a type: points; one point; lists of points;
 * lists of such lists; geometries.  CURVE and SURFACE: something that is left out. */
typedef enum form { POINTS, ONE_POINT, MULTI_POINTS, LISTS, LISTS_OF_LISTS, GEOMETRIES, CURVE, SURFACE } form;

typedef struct type {
    const char *name;
    form form;
    il_map_part part;
} type;

static const type types[] = {
    { "LINESTRING", POINTS, IL_MAP_LINE }, { "MULTILINESTRING", LISTS, IL_MAP_LINE },
    { "POLYGON", LISTS, IL_MAP_RING }, { "MULTIPOLYGON", LISTS_OF_LISTS, IL_MAP_RING },
    { "GEOMETRYCOLLECTION", GEOMETRIES, IL_MAP_LINE }, { "POINT", ONE_POINT, IL_MAP_POINT },
    { "MULTIPOINT", MULTI_POINTS, IL_MAP_POINT }, { "LINEARRING", POINTS, IL_MAP_RING },
    { "CIRCULARSTRING", CURVE, IL_MAP_LINE }, { "COMPOUNDCURVE", CURVE, IL_MAP_LINE },
    { "CURVEPOLYGON", CURVE, IL_MAP_LINE }, { "MULTICURVE", CURVE, IL_MAP_LINE },
    { "MULTISURFACE", CURVE, IL_MAP_LINE }, { "TRIANGLE", SURFACE, IL_MAP_LINE },
    { "TIN", SURFACE, IL_MAP_LINE }, { "POLYHEDRALSURFACE", SURFACE, IL_MAP_LINE } };

static const char EMPTY[] = "EMPTY";

/* p: the byte at hand, in line `line`.  has_z, has_m: the words Z and M; is_said: they
 * were there, or there was one point without them. */
typedef struct scan {
    const char *p, *end;
    long line;
    il_map_set *set;
    size_t depth;
    bool is_said, has_z, has_m;
    il_error *err;
} scan;

/* ---- words --------------------------------------------------------------------- */

static bool is_letter(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static const char *pass_blanks(const char *p, const char *end)
{
    while (p < end && is_blank(*p))
        p++;
    return p;
}

static size_t letters(const char *p, const char *end)
{
    const char *q = p;
    while (q < end && is_letter(*q))
        q++;
    return (size_t)(q - p);
}

/* The Z, M or ZM that P[0..N) is, as bits 1 and 2; 0 when it is none, also for N 0. */
static unsigned dimensions(const char *p, size_t n)
{
    if (il_text_is_word(p, n, "ZM"))
        return 3;
    return il_text_is_word(p, n, "Z") ? 1 : il_text_is_word(p, n, "M") ? 2 : 0;
}

/* The type P[0..N), with or without Z and M at its end. */
static const type *find_type(const char *p, size_t n, unsigned *zm)
{
    for (size_t k = 0; k < sizeof types / sizeof *types; k++) {
        size_t length = strlen(types[k].name);
        if (length > n || strncasecmp(p, types[k].name, length) != 0)
            continue;
        *zm = dimensions(p + length, n - length);
        if (length == n || *zm)
            return &types[k];
    }
    return NULL;
}

/* Behind "SRID=n;" at P; *CODE its number, of N digits. */
static const char *pass_srid(const char *p, const char *end, const char **code, size_t *n)
{
    static const char key[] = "SRID=";
    *n = 0;
    if ((size_t)(end - p) < sizeof key || strncasecmp(p, key, sizeof key - 1) != 0)
        return p;
    *code = p + sizeof key - 1;
    while (*code + *n < end && (*code)[*n] >= '0' && (*code)[*n] <= '9')
        ++*n;
    return *n > 0 && *code + *n < end && (*code)[*n] == ';' ? pass_blanks(*code + *n + 1, end) : p;
}

/* Behind the type, Z and M of the geometry that TEXT[0..N) begins with; null when it
 * begins with none. */
static const char *behind_type(const char *text, const char *end)
{
    const char *code, *p = pass_blanks(text, end);
    size_t digits;
    unsigned zm;
    if (p == end || !strchr("CGLMPSTcglmpst", *p))
        return NULL;
    p = pass_srid(p, end, &code, &digits);
    size_t length = letters(p, end);
    if (!find_type(p, length, &zm))
        return NULL;
    p = pass_blanks(p + length, end);
    length = letters(p, end);
    return dimensions(p, length) ? pass_blanks(p + length, end) : p;
}

bool il_wkt_begins(const char *text, size_t n)
{
    const char *end = text + n, *p = behind_type(text, end);
    return p && ((p < end && *p == '(') || il_text_is_word(p, letters(p, end), EMPTY));
}

/* Its first byte is the order of bytes, the next four the type. */
bool il_wkt_is_hex(const char *text, size_t n)
{
    enum { LEAST = 18 };
    if (n < LEAST || n % 2 != 0 || text[0] != '0' || (text[1] != '0' && text[1] != '1'))
        return false;
    for (size_t k = 0; k < n; k++)
        if (il_hex_digit(text[k]) < 0)
            return false;
    return true;
}

size_t il_wkt_length(const char *text, size_t n, size_t *open, size_t *at)
{
    if (*at == 0) {
        const char *p = behind_type(text, text + n);
        if (p && il_text_is_word(p, letters(p, text + n), EMPTY))
            return (size_t)(p - text) + sizeof EMPTY - 1;
    }
    for (; *at < n; ++*at) {
        char c = text[*at];
        if (c == '(')
            ++*open;
        else if (c == ')' && *open > 0 && --*open == 0)
            return *at + 1;
    }
    return 0;
}

/* ---- tokens ---------------------------------------------------------------------- */

static void skip_blanks(scan *s)
{
    for (; s->p < s->end && is_blank(*s->p); s->p++)
        s->line += *s->p == '\n';
}

static il_status fail_expected(scan *s, const char *what)
{
    size_t n = (size_t)(s->end - s->p);
    if (n == 0)
        return il_fail(s->err, IL_E_INPUT, s->line, "the WKT ends where %s should be", what);
    return il_fail(s->err, IL_E_INPUT, s->line, "'%.*s' stands in the WKT where %s should be", n < 30 ? (int)n : 30, s->p, what);
}

static bool take(scan *s, char c)
{
    skip_blanks(s);
    bool is_there = s->p < s->end && *s->p == c;
    s->p += is_there;
    return is_there;
}

/* EMPTY stands for what would be in brackets; it is counted. */
static bool take_empty(scan *s)
{
    skip_blanks(s);
    size_t n = letters(s->p, s->end);
    bool is_there = il_text_is_word(s->p, n, EMPTY);
    if (is_there)
        il_map_skip(s->set, s->line, "geometry", "is empty");
    s->p += is_there ? n : 0;
    return is_there;
}

static il_status expect(scan *s, char c, const char *what)
{
    return take(s, c) ? IL_OK : fail_expected(s, what);
}

/* Behind an element: a comma and *MORE, or the bracket that ends the list. */
static il_status next_of_list(scan *s, bool *more)
{
    *more = take(s, ',');
    return *more ? IL_OK : expect(s, ')', "',' or ')'");
}

/* A number at hand?  NaN stands for one that is not there. */
static bool take_number(scan *s, double *value)
{
    skip_blanks(s);
    size_t n = il_number_parse(s->p, (size_t)(s->end - s->p), value);
    if (n == 0 && letters(s->p, s->end) == 3 && strncasecmp(s->p, "nan", 3) == 0) {
        *value = NAN;
        n = 3;
    }
    s->p += n;
    return n > 0;
}

/* ---- points ------------------------------------------------------------------------ */

/* The words that were not there: what the first point's numbers are. */
static void infer(scan *s, size_t n)
{
    s->is_said = true;
    s->has_z = n > 2;
    s->has_m = n > 3;
}

/* One point, handed on. */
static il_status read_point(scan *s)
{
    double v[4] = { 0, 0, NAN, NAN };
    size_t n = 0;
    while (n < 4 && take_number(s, &v[n]))
        n++;
    if (n < 2)
        return fail_expected(s, "a number");
    if (!s->is_said)
        infer(s, n);
    if (n != 2 + (size_t)s->has_z + (size_t)s->has_m)
        return il_fail(s->err, IL_E_INPUT, s->line, "a point of %zu numbers among points of %d in the WKT", n, 2 + s->has_z + s->has_m);
    return il_map_point(s->set, v[0], v[1], s->has_z ? v[2] : NAN, s->line, s->err);
}

/* "(x y, x y, ...)" or EMPTY: a part. */
static il_status read_points(scan *s, il_map_part part)
{
    bool more = !take_empty(s);
    if (!more)
        return IL_OK;
    skip_blanks(s);
    il_status st = il_map_begin_part(s->set, part, s->line, s->err);
    if (st == IL_OK)
        st = expect(s, '(', "'('");
    while (st == IL_OK && more) {
        st = read_point(s);
        if (st == IL_OK)
            st = next_of_list(s, &more);
    }
    return st == IL_OK ? il_map_end_part(s->set, s->err) : st;
}

/* "((x y), (x y))" or "(x y, x y)": each point a part. */
static il_status read_multi_points(scan *s)
{
    il_status st = expect(s, '(', "'('");
    for (bool more = true; more && st == IL_OK;) {
        skip_blanks(s);
        if (s->p < s->end && (*s->p == '(' || is_letter(*s->p))) {
            st = read_points(s, IL_MAP_POINT);
        } else {
            st = il_map_begin_part(s->set, IL_MAP_POINT, s->line, s->err);
            if (st == IL_OK)
                st = read_point(s);
            if (st == IL_OK)
                st = il_map_end_part(s->set, s->err);
        }
        if (st == IL_OK)
            st = next_of_list(s, &more);
    }
    return st;
}

/* ---- geometries --------------------------------------------------------------------- */

static il_status read_geometry(scan *s);

/* The elements of a list of what FORM says. */
static il_status read_list(scan *s, form f, il_map_part part)
{
    il_status st = expect(s, '(', "'('");
    for (bool more = true; more && st == IL_OK;) {
        if (f == GEOMETRIES)
            st = read_geometry(s);
        else if (f == LISTS)
            st = read_points(s, part);
        else
            st = take_empty(s) ? IL_OK : read_list(s, LISTS, part);
        if (st == IL_OK)
            st = next_of_list(s, &more);
    }
    return st;
}

/* Pass all up to the bracket that ends what begins here. */
static il_status leave_out(scan *s, form f)
{
    size_t open = 0;
    il_map_skip(s->set, s->line, f == CURVE ? "curve" : "surface",
                f == CURVE ? "curves of WKT are not read (ogr2ogr -nlt CONVERT_TO_LINEAR makes lines of them)"
                           : "a surface is no isoline");
    skip_blanks(s);
    for (bool begun = false; !begun || open > 0; s->p++) {
        if (s->p == s->end || (!begun && *s->p != '('))
            return fail_expected(s, begun ? "')'" : "'('");
        begun = true;
        open += *s->p == '(';
        open -= *s->p == ')';
        s->line += *s->p == '\n';
    }
    return IL_OK;
}

/* What stands behind the type's name and its Z and M. */
static il_status read_body(scan *s, const type *t)
{
    if (t->form != POINTS && t->form != ONE_POINT && take_empty(s))
        return IL_OK;
    switch (t->form) {
    case POINTS:
    case ONE_POINT:    return read_points(s, t->part);
    case MULTI_POINTS: return read_multi_points(s);
    case CURVE:
    case SURFACE:      return leave_out(s, t->form);
    default:           return read_list(s, t->form, t->part);
    }
}

static il_status read_geometry(scan *s)
{
    unsigned zm = 0;
    skip_blanks(s);
    size_t n = letters(s->p, s->end);
    const type *t = find_type(s->p, n, &zm);
    if (!t)
        return fail_expected(s, "a geometry");
    s->p += n;
    skip_blanks(s);
    n = letters(s->p, s->end);
    if (zm == 0 && (zm = dimensions(s->p, n)) != 0)
        s->p += n;
    s->is_said = zm != 0;
    s->has_z = zm & 1;
    s->has_m = zm & 2;
    if (s->depth-- == 0)
        return il_fail(s->err, IL_E_INPUT, s->line, "the geometries of the WKT are nested too deep");
    il_status st = read_body(s, t);
    s->depth++;
    return st;
}

static il_status read_srid(scan *s)
{
    static const char prefix[] = "EPSG:";
    enum { DIGITS = 9 };
    char name[sizeof prefix + DIGITS];
    const char *code;
    size_t n;
    skip_blanks(s);
    const char *behind = pass_srid(s->p, s->end, &code, &n);
    if (behind == s->p || n > DIGITS || (n == 1 && *code == '0')) {
        s->p = n > DIGITS ? s->p : behind;
        return IL_OK;
    }
    memcpy(name, prefix, sizeof prefix - 1);
    memcpy(name + sizeof prefix - 1, code, n);
    il_status st = il_map_crs(s->set, name, sizeof prefix - 1 + n, s->line, s->err);
    s->p = behind;
    return st;
}

il_status il_wkt_read(il_map_set *set, const char *text, size_t n, long line, size_t max_depth, il_error *err)
{
    scan s = { .p = text, .end = text + n, .line = line, .set = set, .err = err,
               .depth = max_depth < IL_LIMIT_DEPTH ? max_depth : IL_LIMIT_DEPTH };
    il_status st = read_srid(&s);
    if (st == IL_OK)
        st = read_geometry(&s);
    skip_blanks(&s);
    return st == IL_OK && s.p < s.end ? fail_expected(&s, "its end") : st;
}
