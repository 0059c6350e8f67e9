/* WKT is a tree: KEYWORD[argument, ...], where an argument is a string, a number or
 * a node again.  One pass with the path of open keywords is enough, as each fact
 * stands at one place of the tree. */
#include "config.h"
#include "input/map-wkt.h"
#include "base/number.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { DEPTH_MOST = 32, WORD_MOST = 24 };

/* What keywords mean here.  A METRE node is a unit whose number is metres. */
typedef enum node {
    NODE_OTHER, NODE_GEOGRAPHIC, NODE_PROJECTED, NODE_LOCAL, NODE_VERTICAL, NODE_ELLIPSOID, NODE_UNIT, NODE_AXIS,
    NODE_CODE, NODE_PARAMETER
} node;

static const struct { const char *word; node means; } keywords[] = {
    { "GEOGCS", NODE_GEOGRAPHIC }, { "GEOGCRS", NODE_GEOGRAPHIC }, { "GEODCRS", NODE_GEOGRAPHIC },
    { "GEODETICCRS", NODE_GEOGRAPHIC }, { "GEOGRAPHICCRS", NODE_GEOGRAPHIC }, { "BASEGEOGCRS", NODE_GEOGRAPHIC },
    { "BASEGEODCRS", NODE_GEOGRAPHIC }, { "PROJCS", NODE_PROJECTED }, { "PROJCRS", NODE_PROJECTED },
    { "PROJECTEDCRS", NODE_PROJECTED }, { "LOCAL_CS", NODE_LOCAL }, { "ENGCRS", NODE_LOCAL },
    { "ENGINEERINGCRS", NODE_LOCAL }, { "VERT_CS", NODE_VERTICAL }, { "VERTCS", NODE_VERTICAL },
    { "VERTCRS", NODE_VERTICAL }, { "VERTICALCRS", NODE_VERTICAL }, { "SPHEROID", NODE_ELLIPSOID },
    { "ELLIPSOID", NODE_ELLIPSOID }, { "UNIT", NODE_UNIT }, { "LENGTHUNIT", NODE_UNIT }, { "AXIS", NODE_AXIS },
    { "AUTHORITY", NODE_CODE }, { "ID", NODE_CODE }, { "PARAMETER", NODE_PARAMETER } };

/* open: the nodes that are open, with their first string and their numbers so far. */
typedef struct level {
    node means;
    char word[WORD_MOST];       /* the first string */
    double number[2];
    size_t n_strings, n_numbers;
} level;

typedef struct wkt {
    const char *s;
    level open[DEPTH_MOST];
    size_t depth;
    il_crs *out;
} wkt;

static node meaning(const char *s, size_t n)
{
    for (size_t k = 0; k < sizeof keywords / sizeof *keywords; k++)
        if (il_text_is_word(s, n, keywords[k].word))
            return keywords[k].means;
    return NODE_OTHER;
}

/* The nearest node around the one that closes that is a system of coordinates. */
static node system_around(const wkt *w, size_t depth)
{
    for (size_t k = depth; k-- > 0;)
        if (w->open[k].means >= NODE_GEOGRAPHIC && w->open[k].means <= NODE_VERTICAL)
            return w->open[k].means;
    return NODE_OTHER;
}

static void set_unit(double metres, il_unit *unit, bool *has, il_crs *c)
{
    static const struct { double metres; il_unit unit; } known[] = {
        { 1, IL_UNIT_M }, { 0.3048, IL_UNIT_FT }, { 1200.0 / 3937, IL_UNIT_FT }, { 1000, IL_UNIT_KM },
        { 0.01, IL_UNIT_CM }, { 0.001, IL_UNIT_MM }, { 0.0254, IL_UNIT_IN } };
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        if (fabs(metres / known[k].metres - 1) < 2e-7) {
            *has = true;
            *unit = known[k].unit;
            c->us_foot |= k == 2;
            return;
        }
    }
    c->odd_unit = true;
}

/* Degrees too have a UNIT, in radians: those stand in geographic systems. */
static void take_unit(wkt *w, const level *l)
{
    node around = system_around(w, w->depth);
    bool direct = w->depth > 0 && (w->open[w->depth - 1].means == around || w->open[w->depth - 1].means == NODE_AXIS);
    if (l->n_numbers == 0 || !direct || !(l->number[0] > 0))
        return;
    if (around == NODE_PROJECTED || around == NODE_LOCAL)
        set_unit(l->number[0], &w->out->unit, &w->out->has_unit, w->out);
    else if (around == NODE_GEOGRAPHIC && w->out->kind == IL_CRS_GEOGRAPHIC && l->means == NODE_UNIT)
        w->out->odd_unit |= fabs(l->number[0] * 180 / acos(-1) - 1) > 1e-6;
    else if (around == NODE_VERTICAL)
        set_unit(l->number[0], &w->out->z_unit, &w->out->has_z_unit, w->out);
}

/* A sphere has inverse flattening 0.  The first ellipsoid is that of the system; those
 * of datums it is shifted to come later. */
static void take_ellipsoid(wkt *w, const level *l)
{
    il_crs *c = w->out;
    if (c->has_ellipsoid || l->n_numbers < 2 || !(l->number[0] > 1e6 && l->number[0] < 1e7))
        return;
    if (l->number[1] != 0 && !(fabs(l->number[1]) > 100))
        return;
    c->has_ellipsoid = true;
    c->ellipsoid = (il_ellipsoid){ l->number[0], l->number[1] == 0 ? 0 : 1 / l->number[1] };
}

/* The code of the outermost system, or of the horizontal one in a compound. */
static void take_code(wkt *w, const level *l)
{
    il_crs *c = w->out;
    node around = w->depth > 0 ? w->open[w->depth - 1].means : NODE_OTHER;
    node wanted = c->kind == IL_CRS_PROJECTED ? NODE_PROJECTED : NODE_GEOGRAPHIC;
    if (around == wanted && strcasecmp(l->word, "EPSG") == 0 && l->n_numbers > 0 && l->number[0] > 0 && l->number[0] < 1e6)
        c->epsg = (long)l->number[0];
}

/* Parameters go by many names; where they begin alike they mean alike. */
static void take_parameter(wkt *w, const level *l)
{
    static const struct { const char *begin; int k; } names[] = {
        { "central_meridian", 0 }, { "longitude", 0 }, { "latitude", 1 }, { "false_easting", 2 }, { "false easting", 2 },
        { "easting at", 2 }, { "false_northing", 3 }, { "false northing", 3 }, { "northing at", 3 } };
    node around = system_around(w, w->depth);
    if (l->n_numbers == 0)
        return;
    if (around == NODE_VERTICAL && strcasecmp(l->word, "Direction") == 0) /* in Esri's WKT */
        w->out->down = l->number[0] < 0;
    for (size_t k = 0; k < sizeof names / sizeof *names && around == NODE_PROJECTED; k++)
        if (strncasecmp(l->word, names[k].begin, strlen(names[k].begin)) == 0)
            w->out->origin[names[k].k] = l->number[0];
}

/* Node L, which stood at this depth, is over. */
static void close_node(wkt *w, const level *l)
{
    switch (l->means) {
    case NODE_UNIT:
        take_unit(w, l);
        break;
    case NODE_ELLIPSOID:
        take_ellipsoid(w, l);
        break;
    case NODE_CODE:
        take_code(w, l);
        break;
    case NODE_PARAMETER:
        take_parameter(w, l);
        break;
    default:
        break;
    }
}

/* A system begins: one on the plane hides the geographic one that it is made from. */
static void begin_node(wkt *w, node means)
{
    il_crs *c = w->out;
    if (means == NODE_PROJECTED)
        c->kind = IL_CRS_PROJECTED;
    else if (means == NODE_LOCAL && c->kind == IL_CRS_UNKNOWN)
        c->kind = IL_CRS_LOCAL;
    else if (means == NODE_GEOGRAPHIC && c->kind == IL_CRS_UNKNOWN)
        c->kind = IL_CRS_GEOGRAPHIC;
    w->open[w->depth++] = (level){ .means = means };
}

static bool is_name_byte(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || (c >= '0' && c <= '9');
}

/* "..." with "" for a quotation mark inside; it may be a number too, as codes are. */
static bool read_string(wkt *w)
{
    const char *begin = ++w->s, *end = strchr(begin, '"');
    while (end && end[1] == '"')
        end = strchr(end + 2, '"');
    if (!end)
        return false;
    if (w->depth > 0) {
        level *l = &w->open[w->depth - 1];
        size_t n = (size_t)(end - begin);
        double value;
        if (l->n_strings++ == 0)
            snprintf(l->word, sizeof l->word, "%.*s", n < WORD_MOST ? (int)n : WORD_MOST - 1, begin);
        else if (l->n_numbers < 2 && il_number_parse(begin, n, &value) == n && n > 0)
            l->number[l->n_numbers++] = value;
    }
    w->s = end + 1;
    return true;
}

/* KEYWORD[ or a bare word, such as an axis' direction. */
static bool read_word(wkt *w)
{
    const char *begin = w->s;
    while (is_name_byte(*w->s))
        w->s++;
    size_t n = (size_t)(w->s - begin);
    w->s += strspn(w->s, " \t\r\n");
    if (*w->s != '[' && *w->s != '(') {
        if (w->depth > 0 && w->open[w->depth - 1].means == NODE_AXIS && system_around(w, w->depth) == NODE_VERTICAL)
            w->out->down |= n == 4 && strncasecmp(begin, "down", 4) == 0;
        return w->depth > 0;
    }
    w->s++;
    if (w->depth == DEPTH_MOST)
        return false;
    begin_node(w, meaning(begin, n));
    return true;
}

static bool read_number(wkt *w)
{
    double value;
    size_t n = il_number_parse(w->s, strlen(w->s) < 64 ? strlen(w->s) : 64, &value);
    if (n == 0 || w->depth == 0)
        return false;
    level *l = &w->open[w->depth - 1];
    if (l->n_numbers < 2)
        l->number[l->n_numbers++] = value;
    w->s += n;
    return true;
}

static bool read_step(wkt *w)
{
    if (*w->s == '"')
        return read_string(w);
    if (*w->s == ']' || *w->s == ')') {
        w->s++;
        if (w->depth-- == 0)
            return false;
        level closed = w->open[w->depth];
        close_node(w, &closed);
        return true;
    }
    if ((*w->s >= 'A' && *w->s <= 'Z') || (*w->s >= 'a' && *w->s <= 'z'))
        return read_word(w);
    return read_number(w);
}

bool il_crs_parse_wkt(const char *text, il_crs *out)
{
    wkt w = { .s = text, .out = out };
    for (;;) {
        w.s += strspn(w.s, " \t\r\n,");
        if (!*w.s)
            return w.depth == 0 && out->kind != IL_CRS_UNKNOWN;
        if (!read_step(&w))
            return false;
    }
}
