/* geojson-crs.c - the member "crs" of GeoJSON 2008, which files in use still have. */
#include "config.h"
#include "input/geojson.h"
#include "base/alloc.h"

#include <stdio.h>
#include <string.h>

/* What the object says; name is owned, null for none. */
typedef struct said {
    char *name;
    size_t n;
    long line;
    bool has_link;
} said;

static il_status keep(il_geojson *g, said *s, const char *before)
{
    const il_json_scan *j = &g->json;
    size_t n_before = strlen(before), n = n_before + j->n;
    char *name = il_alloc(n + 1, 1);
    if (!name)
        return il_fail_nomem(g->err);
    memcpy(name, before, n_before);
    memcpy(name + n_before, j->text, j->n);
    il_free(s->name);
    s->name = name;
    s->n = n;
    return IL_OK;
}

/* A member of the object's properties: the name, or the number of an EPSG code. */
static il_status take_property(il_geojson *g, said *s)
{
    il_json_event event = IL_JSON_NULL;
    bool is_name = il_geojson_is(g, "name"), is_code = il_geojson_is(g, "code");
    s->has_link |= il_geojson_is(g, "href");
    il_status st = il_geojson_next(g, &event);
    if (st == IL_OK && is_name && event == IL_JSON_STRING)
        st = keep(g, s, "");
    else if (st == IL_OK && is_code && !s->name && (event == IL_JSON_NUMBER || event == IL_JSON_STRING))
        st = keep(g, s, "EPSG:");
    return st == IL_OK ? il_geojson_skip(g, event) : st;
}

/* Of what the members of the object hold, only objects are looked into; "type" says
 * no more than they do. */
static il_status take_object(il_geojson *g, said *s)
{
    il_json_event event;
    il_status st;
    size_t outside = g->json.depth - 1;
    while ((st = il_geojson_next(g, &event)) == IL_OK && g->json.depth > outside) {
        if (event == IL_JSON_KEY && g->json.depth == outside + 2)
            st = take_property(g, s);
        else if (event == IL_JSON_KEY && !il_geojson_is(g, "properties"))
            st = il_geojson_skip(g, event);
        if (st != IL_OK)
            return st;
    }
    return st;
}

static il_status hand_on(il_geojson *g, const said *s)
{
    if (s->name)
        return il_map_crs(g->set, s->name, s->n, s->line, g->err);
    il_report_note(il_map_report(g->set), "%.200s:%ld: %s", il_map_file(g->set), s->line,
                   s->has_link ? "the coordinate system is a link, which is not followed"
                               : "the member crs names no coordinate system");
    return IL_OK;
}

/* A string in place of the object is the name; null says that there is no system. */
il_status il_geojson_crs(il_geojson *g)
{
    said s = { .line = g->json.line };
    il_json_event event;
    il_status st = il_geojson_next(g, &event);
    if (st != IL_OK || event == IL_JSON_NULL)
        return st;
    if (event == IL_JSON_STRING)
        st = keep(g, &s, "");
    else
        st = event == IL_JSON_OBJECT ? take_object(g, &s) : il_geojson_skip(g, event);
    if (st == IL_OK)
        st = hand_on(g, &s);
    il_free(s.name);
    return st;
}
