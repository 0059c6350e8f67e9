/* gmt-ogr.c - the comments by which GDAL and GMT write features in GMT's tables
 * (OGR/GMT): "# @KEYvalue", several a line. */
#include "config.h"
#include "input/gmt.h"
#include "base/alloc.h"
#include "input/map-crs.h"

#include <string.h>
#include <strings.h>

/* The forms of a coordinate system. */
enum { WKT, CODE, PROJ };

void il_gmt_ogr_free(il_gmt_ogr *o)
{
    il_map_heads_free(&o->heads);
    for (size_t k = 0; k < sizeof o->crs / sizeof *o->crs; k++)
        il_free(o->crs[k]);
    il_free(o->text);
}

static bool is_letter(char c)
{
    return (c | 0x20) >= 'a' && (c | 0x20) <= 'z';
}

/* The next "@KEYvalue" of T: its key, and the value in *VALUE, up to the next one
 * outside of quotes; the values of attributes (D) take the rest of the line. */
static char next_item(il_map_text *t, il_map_text *value)
{
    while (t->p < t->end && !(*t->p == '@' && t->p + 1 < t->end && is_letter(t->p[1])))
        t->p++;
    if (t->p == t->end)
        return '\0';
    char key = t->p[1];
    bool in_quotes = false;
    value->p = t->p += 2;
    for (; t->p < t->end; t->p++) {
        if (*t->p == '\\' && t->p + 1 < t->end)
            t->p++;
        else if (*t->p == '"')
            in_quotes = !in_quotes;
        else if (*t->p == '@' && !in_quotes && key != 'D' && il_map_text_is_blank(t->p[-1]))
            break;
    }
    value->end = t->p;
    while (value->end > value->p && il_map_text_is_blank(value->end[-1]))
        value->end--;
    return key;
}

/* The next of the values that bars divide, without its quotes and backslashes, in
 * o->text[0..*n); false when there are no more. */
static bool next_value(il_gmt_ogr *o, il_map_text *t, bool *begun, size_t *n)
{
    bool in_quotes = false;
    *n = 0;
    if (*begun && t->p == t->end)
        return false;
    t->p += *begun;
    *begun = true;
    for (; t->p < t->end && (in_quotes || *t->p != '|'); t->p++) {
        bool is_escape = *t->p == '\\' && t->p + 1 < t->end && strchr("\"\\|", t->p[1]);
        if (*t->p == '"') {
            in_quotes = !in_quotes;
            continue;
        }
        t->p += is_escape;
        o->text[(*n)++] = *t->p;
    }
    return true;
}

/* Room for a value of T. */
static il_status make_room(il_gmt *g, const il_map_text *t)
{
    return il_grow(&g->ogr.text, &g->ogr.cap, (size_t)(t->end - t->p) + 1, 1) ? IL_OK : il_fail_nomem(g->err);
}

/* @N: the names of the attributes. */
static il_status take_names(il_gmt *g, il_map_text t)
{
    bool begun = false;
    size_t n;
    il_status st = make_room(g, &t);
    if (g->ogr.heads.n > 0)
        return il_fail(g->err, IL_E_INPUT, g->lines.line, "the attributes are named a second time (@N)");
    while (st == IL_OK && next_value(&g->ogr, &t, &begun, &n))
        st = il_map_heads_add(&g->ogr.heads, g->ogr.text, n, g->err);
    return st == IL_OK ? il_map_heads_choose(&g->ogr.heads, g->set, g->err) : st;
}

static il_status tell_value(il_gmt *g, size_t k, size_t n)
{
    const il_map_heads *h = &g->ogr.heads;
    for (size_t i = 0; i < h->n_wanted; i++)
        if (h->wanted[i] == k)
            return il_map_attribute(g->set, h->head[k].name, h->head[k].n, n > 0 ? g->ogr.text : NULL, n, g->err);
    return IL_OK;
}

/* @D: the values of a feature's attributes.  The feature is that of the segment at hand,
 * unless that has rows or values already. */
static il_status take_values(il_gmt *g, il_map_text t)
{
    const il_map_heads *h = &g->ogr.heads;
    bool begun = false;
    size_t n;
    il_status st = make_room(g, &t);
    if (st == IL_OK)
        st = il_gmt_begin_segments(g);
    if (st == IL_OK && !g->fresh)
        st = il_gmt_next_feature(g, g->lines.line);
    if (st == IL_OK && !g->ogr.has_told)
        st = il_map_heads_tell(h, g->set, g->err);
    g->ogr.has_told = true;
    g->fresh = false;
    for (size_t k = 0; st == IL_OK && next_value(&g->ogr, &t, &begun, &n); k++) {
        if (k >= h->n)
            return il_fail(g->err, IL_E_INPUT, g->lines.line, "more than the %zu values that have names (@N)", h->n);
        st = tell_value(g, k, n);
    }
    return st;
}

/* @J: one form of the coordinate system: e and a code of EPSG, p and a PROJ string, w
 * and WKT; g is GMT's own, which is not read. */
static il_status take_crs(il_gmt *g, il_map_text t)
{
    static const char prefix[] = "EPSG:";
    char form = t.p < t.end ? *t.p++ : '\0';
    size_t which = form == 'e' ? CODE : form == 'p' ? PROJ : WKT, n;
    bool begun = false;
    if (form != 'e' && form != 'p' && form != 'w')
        return IL_OK;
    il_status st = make_room(g, &t);
    if (st != IL_OK || !next_value(&g->ogr, &t, &begun, &n) || n == 0)
        return st;
    char *text = il_alloc(sizeof prefix + n, 1);
    if (!text)
        return il_fail_nomem(g->err);
    size_t from = which == CODE && strncasecmp(g->ogr.text, prefix, n < 5 ? n : 5) != 0 ? sizeof prefix - 1 : 0;
    memcpy(text, prefix, from);
    memcpy(text + from, g->ogr.text, n);
    text[from + n] = '\0';
    il_free(g->ogr.crs[which]);
    g->ogr.crs[which] = text;
    g->ogr.crs_line = g->lines.line;
    return IL_OK;
}

/* How much is the form WHICH to be believed?  A code that is known says all in a few
 * letters; WKT says the unit, which other codes do not. */
static int worth_of(size_t which, const char *text)
{
    static const int worth[] = { [WKT] = 1, [CODE] = 3, [PROJ] = 2 };
    il_crs c;
    il_crs_parse(text, &c);
    bool is_known = c.kind != IL_CRS_UNKNOWN;
    if (which == CODE)
        return is_known && (c.kind == IL_CRS_GEOGRAPHIC || c.has_unit) ? 6 : worth[CODE];
    return is_known ? (which == WKT ? 5 : 4) : worth[which];
}

il_status il_gmt_settle_crs(il_gmt *g)
{
    il_gmt_ogr *o = &g->ogr;
    const size_t n = sizeof o->crs / sizeof *o->crs;
    size_t best = n;
    il_status st = IL_OK;
    for (size_t k = 0; k < n; k++)
        if (o->crs[k] && (best == n || worth_of(k, o->crs[k]) > worth_of(best, o->crs[best])))
            best = k;
    if (best < n)
        st = il_map_crs(g->set, o->crs[best], strlen(o->crs[best]), o->crs_line, g->err);
    for (size_t k = 0; k < n; k++) {
        il_free(o->crs[k]);
        o->crs[k] = NULL;
    }
    return st;
}

/* @G: POINT, LINESTRING, POLYGON, or MULTI and one of these. */
static void take_geometry(il_gmt *g, const il_map_text *t)
{
    size_t n = (size_t)(t->end - t->p), multi = n > 5 && strncasecmp(t->p, "MULTI", 5) == 0 ? 5 : 0;
    const char *name = t->p + multi;
    n -= multi;
    if (n >= 7 && strncasecmp(name, "POLYGON", 7) == 0)
        g->ogr.part = IL_MAP_RING;
    else if (n >= 5 && strncasecmp(name, "POINT", 5) == 0)
        g->ogr.part = IL_MAP_POINT;
}

/* A comment is read as OGR's from @VGMT on. */
il_status il_gmt_comment(il_gmt *g, il_map_text t)
{
    il_map_text value;
    il_status st = IL_OK;
    for (char key; st == IL_OK && (key = next_item(&t, &value)) != '\0';) {
        if (key == 'V')
            g->ogr.is_ogr |= value.end - value.p >= 3 && memcmp(value.p, "GMT", 3) == 0;
        if (!g->ogr.is_ogr)
            return IL_OK;
        if (key == 'N')
            st = take_names(g, value);
        else if (key == 'D')
            st = take_values(g, value);
        else if (key == 'J')
            st = take_crs(g, value);
        else if (key == 'G')
            take_geometry(g, &value);
    }
    return st;
}
