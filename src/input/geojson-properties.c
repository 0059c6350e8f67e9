/* geojson-properties.c - the members of "properties" as attributes.
 *
 * Values that are no height are passed over where they stand; of one that may be,
 * its text goes to the set as it is written. */
#include "config.h"
#include "input/geojson.h"
#include "base/alloc.h"

#include <string.h>

/* Names that are compared with one another; a feature with more of them is nobody's. */
enum { COMPARED_MOST = 64 };

/* Is the name at hand among those that the feature has already?  It is from now on. */
static il_status is_repeated(il_geojson *g, size_t n_compared, bool *repeated)
{
    size_t n = g->n_name;
    *repeated = false;
    for (size_t at = 0, length; at < g->n_wanted && !*repeated; at += sizeof length + length) {
        memcpy(&length, g->wanted + at, sizeof length);
        *repeated = length == n && memcmp(g->wanted + at + sizeof length, g->name, n) == 0;
    }
    if (*repeated || n_compared >= COMPARED_MOST)
        return IL_OK;
    if (!il_grow(&g->wanted, &g->cap_wanted, g->n_wanted + sizeof n + n, 1))
        return il_fail_nomem(g->err);
    memcpy(g->wanted + g->n_wanted, &n, sizeof n);
    memcpy(g->wanted + g->n_wanted + sizeof n, g->name, n);
    g->n_wanted += sizeof n + n;
    return IL_OK;
}

/* The key is gone when its value comes. */
static il_status keep_name(il_geojson *g)
{
    if (!il_grow(&g->name, &g->cap_name, g->json.n + 1, 1))
        return il_fail_nomem(g->err);
    memcpy(g->name, g->json.text, g->json.n);
    g->n_name = g->json.n;
    return IL_OK;
}

/* The value that EVENT begins, of the property whose name is kept. */
static il_status take_value(il_geojson *g, il_json_event event)
{
    const il_json_scan *j = &g->json;
    const char *text = NULL;
    size_t n = 0;
    if (event == IL_JSON_STRING || (event == IL_JSON_NUMBER && !il_geojson_is(g, "NaN"))) {
        text = j->text;
        n = j->n;
    } else if (event == IL_JSON_TRUE || event == IL_JSON_FALSE) {
        text = event == IL_JSON_TRUE ? "true" : "false";
        n = strlen(text);
    }
    il_status st = il_map_attribute(g->set, g->name, g->n_name, text, n, g->err);
    return st == IL_OK ? il_geojson_skip(g, event) : st;
}

static il_status take_wanted(il_geojson *g, size_t n_compared)
{
    il_json_event event;
    bool repeated = false;
    long line = g->json.line;
    il_status st = keep_name(g);
    if (st == IL_OK)
        st = is_repeated(g, n_compared, &repeated);
    if (st == IL_OK && repeated)
        return il_fail(g->err, IL_E_INPUT, line, "the property '%.*s' comes twice in one feature",
                       (int)(g->n_name < 60 ? g->n_name : 60), g->name);
    if (st == IL_OK)
        st = il_geojson_next(g, &event);
    return st == IL_OK ? take_value(g, event) : st;
}

static il_status take_members(il_geojson *g)
{
    il_json_event event;
    il_status st;
    size_t n_compared = 0;
    g->n_wanted = 0;
    while ((st = il_geojson_next(g, &event)) == IL_OK && event != IL_JSON_OBJECT_END) {
        if (il_map_wants(g->set, g->json.text, g->json.n))
            st = take_wanted(g, n_compared++);
        else if ((st = il_map_attribute(g->set, g->json.text, g->json.n, NULL, 0, g->err)) == IL_OK)
            st = il_geojson_skip(g, event);
        if (st != IL_OK)
            return st;
    }
    return st;
}

/* An empty array is what PHP writes for no members. */
il_status il_geojson_properties(il_geojson *g)
{
    il_json_event event;
    il_status st = il_geojson_next(g, &event);
    if (st != IL_OK || event == IL_JSON_NULL)
        return st;
    if (event == IL_JSON_OBJECT)
        return take_members(g);
    if (event == IL_JSON_ARRAY && (st = il_geojson_next(g, &event)) == IL_OK && event == IL_JSON_ARRAY_END)
        return IL_OK;
    return st == IL_OK ? il_fail(g->err, IL_E_INPUT, g->json.line, "the properties are no object") : st;
}
