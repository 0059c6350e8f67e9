/* geojson.c - GeoJSON (RFC 7946), one value or many (RFC 8142, or one a line).
 *
 * Members may come in any order, so what an object is follows from its type or from
 * the first member that only one kind of object has, whichever comes first; the other
 * must agree.  Members of no kind, and those of another kind, are passed over. */
#include "config.h"
#include "input/geojson.h"
#include "base/alloc.h"

#include <stdio.h>
#include <string.h>

/* Collections in collections. */
enum { NESTED_MOST = 100 };

const char *const il_geojson_type_name[IL_GEOJSON_N_TYPES] = {
    "", "FeatureCollection", "Feature", "GeometryCollection", "Point", "MultiPoint", "LineString", "MultiLineString",
    "Polygon", "MultiPolygon" };

/* The kinds of objects: by their types, and by the members that are theirs. */
typedef enum kind { UNKNOWN, COLLECTION, FEATURE, GEOMETRIES, GEOMETRY, N_KINDS } kind;

typedef enum member { TYPE, CRS, FEATURES, GEOMETRY_OF, PROPERTIES, GEOMETRIES_OF, COORDINATES, ESRI, FOREIGN } member;

/* In the order of what features have most.  ESRI: those of Esri's own JSON. */
static const struct { const char *name; member member; } members[] = {
    { "type", TYPE }, { "properties", PROPERTIES }, { "geometry", GEOMETRY_OF }, { "coordinates", COORDINATES },
    { "features", FEATURES }, { "geometries", GEOMETRIES_OF }, { "crs", CRS },
    { "paths", ESRI }, { "rings", ESRI }, { "curvePaths", ESRI }, { "attributes", ESRI }, { "spatialReference", ESRI },
    { "geometryType", ESRI } };

static const kind kind_of_member[] = {
    [FEATURES] = COLLECTION, [GEOMETRY_OF] = FEATURE, [PROPERTIES] = FEATURE, [GEOMETRIES_OF] = GEOMETRIES,
    [COORDINATES] = GEOMETRY, [FOREIGN] = UNKNOWN };

/* line: where it begins.  begun: the feature is this object's.  kept: its coordinates
 * wait for its type.  names: of its members, for an object that is none of GeoJSON. */
typedef struct object {
    il_geojson_type type;
    kind kind;
    unsigned seen;              /* bits 1 << member */
    long line;
    bool begun, kept;
    bool has_more;
    char names[160];
} object;

bool il_geojson_is(const il_geojson *g, const char *word)
{
    size_t n = strlen(word);
    return g->json.n == n && memcmp(g->json.text, word, n) == 0;
}

/* ---- what it is instead ------------------------------------------------------- */

static const char ogr[] = "ogr2ogr -f GeoJSONSeq makes what isoloft reads";

/* Keep the key at hand, for fail_object. */
static void remember(const il_geojson *g, object *o)
{
    enum { SHOWN = 40, FRAME = sizeof ", ''" - 1, MORE = sizeof ", ..." - 1 };
    size_t n = strlen(o->names), shown = g->json.n < SHOWN ? g->json.n : SHOWN;
    bool fits = n + shown + FRAME + MORE < sizeof o->names;
    if (fits)
        snprintf(o->names + n, sizeof o->names - n, "%s'%.*s'", n > 0 ? ", " : "", (int)shown, g->json.text);
    else if (!o->has_more)
        snprintf(o->names + n, sizeof o->names - n, ", ...");
    o->has_more |= !fits;
}

/* O has ended without a type. */
static il_status fail_object(const il_geojson *g, const object *o)
{
    static const char *const by[N_KINDS] = { "", "features", "properties", "geometries", "coordinates" };
    bool has_geometry = o->seen & 1u << GEOMETRY_OF;
    if (o->seen & 1u << ESRI)
        return il_fail(g->err, IL_E_INPUT, o->line, "Esri JSON, not GeoJSON (its members are %s); %s", o->names, ogr);
    if (o->kind != UNKNOWN)
        return il_fail(g->err, IL_E_INPUT, o->line, "an object of GeoJSON has no type (it has '%s')",
                       has_geometry ? "geometry" : by[o->kind]);
    if (!*o->names)
        return il_fail(g->err, IL_E_INPUT, o->line, "JSON, but not GeoJSON: an object without members");
    return il_fail(g->err, IL_E_INPUT, o->line, "JSON, but not GeoJSON: no type, and the members are %s", o->names);
}

static il_status fail_type(const il_geojson *g)
{
    const il_json_scan *j = &g->json;
    if (il_geojson_is(g, "Topology"))
        return il_fail(g->err, IL_E_INPUT, j->line, "TopoJSON, not GeoJSON; %s", ogr);
    return il_fail(g->err, IL_E_INPUT, j->line, "'%.*s' is no type of GeoJSON", (int)(j->n < 40 ? j->n : 40), j->text);
}

/* ---- objects ---------------------------------------------------------------------- */

static il_status read_object(il_geojson *g, size_t nested);

static kind kind_of(il_geojson_type type)
{
    switch (type) {
    case IL_GEOJSON_NONE:                return UNKNOWN;
    case IL_GEOJSON_FEATURE_COLLECTION:  return COLLECTION;
    case IL_GEOJSON_FEATURE:             return FEATURE;
    case IL_GEOJSON_GEOMETRY_COLLECTION: return GEOMETRIES;
    default:                             return GEOMETRY;
    }
}

/* O is known to be of kind K.  A geometry that no feature is around is one. */
static il_status set_kind(il_geojson *g, object *o, kind k)
{
    o->kind = k;
    if (g->in_feature && (k == COLLECTION || k == FEATURE))
        return il_fail(g->err, IL_E_INPUT, g->json.line, "a %s stands where a geometry belongs",
                       k == FEATURE ? "Feature" : "FeatureCollection");
    if (g->in_feature || k == COLLECTION)
        return IL_OK;
    o->begun = g->in_feature = true;
    return il_map_begin_feature(g->set, o->line, g->err);
}

static il_status read_type(il_geojson *g, object *o)
{
    il_json_event event;
    il_status st = il_geojson_next(g, &event);
    if (st != IL_OK)
        return st;
    if (event != IL_JSON_STRING)
        return il_fail(g->err, IL_E_INPUT, g->json.line, "a type is no string");
    for (il_geojson_type t = 1; t < IL_GEOJSON_N_TYPES && o->type == IL_GEOJSON_NONE; t++)
        if (il_geojson_is(g, il_geojson_type_name[t]))
            o->type = t;
    if (o->type == IL_GEOJSON_NONE)
        return fail_type(g);
    kind k = kind_of(o->type);
    if (o->kind == UNKNOWN)
        return set_kind(g, o, k);
    return k == o->kind ? IL_OK
        : il_fail(g->err, IL_E_INPUT, g->json.line, "the type is %s, but the members before it are those of another",
                  il_geojson_type_name[o->type]);
}

/* The objects of the array that EVENT begins, each called WHAT. */
static il_status read_list(il_geojson *g, il_json_event event, const char *what, size_t nested)
{
    il_status st = IL_OK;
    long line = g->json.line;
    size_t n = 0;
    if (event != IL_JSON_ARRAY)
        return il_fail(g->err, IL_E_INPUT, line, "an array is expected, each element a %s", what);
    for (; st == IL_OK && (st = il_geojson_next(g, &event)) == IL_OK && event != IL_JSON_ARRAY_END; n++) {
        if (event == IL_JSON_OBJECT)
            st = read_object(g, nested + 1);
        else if (event == IL_JSON_NULL)
            il_map_skip(g->set, g->json.line, what, "is null");
        else
            st = il_fail(g->err, IL_E_INPUT, g->json.line, "a %s is no object", what);
    }
    if (st == IL_OK && n == 0 && g->in_feature)
        il_map_skip(g->set, line, what, "is an empty collection");
    return st;
}

static il_status read_geometry(il_geojson *g, size_t nested)
{
    il_json_event event;
    il_status st = il_geojson_next(g, &event);
    if (st == IL_OK && event == IL_JSON_OBJECT)
        return read_object(g, nested + 1);
    if (st == IL_OK && event == IL_JSON_NULL)
        il_map_skip(g->set, g->json.line, "feature", "has no geometry");
    else if (st == IL_OK)
        st = il_fail(g->err, IL_E_INPUT, g->json.line, "the geometry is no object");
    return st;
}

/* The value of member M, one of O's kind. */
static il_status read_value(il_geojson *g, object *o, member m, size_t nested)
{
    il_json_event event = IL_JSON_NULL;
    il_status st;
    switch (m) {
    case TYPE:        return read_type(g, o);
    case CRS:         return il_geojson_crs(g);
    case PROPERTIES:  return il_geojson_properties(g);
    case GEOMETRY_OF: return read_geometry(g, nested);
    case COORDINATES:
        o->kept = o->type == IL_GEOJSON_NONE;
        return il_geojson_coordinates(g, o->type);
    default:
        st = il_geojson_next(g, &event);
        return st == IL_OK ? read_list(g, event, m == FEATURES ? "feature" : "geometry", nested) : st;
    }
}

static member find_member(const il_geojson *g)
{
    for (size_t k = 0; k < sizeof members / sizeof *members; k++)
        if (il_geojson_is(g, members[k].name))
            return members[k].member;
    return FOREIGN;
}

/* Is M looked into in O, whose kind may not be known yet? */
static bool is_own(const object *o, member m)
{
    bool in_any = m == TYPE || m == CRS, in_none = kind_of_member[m] == UNKNOWN;
    return in_any || (!in_none && (o->kind == UNKNOWN || o->kind == kind_of_member[m]));
}

static il_status pass_over(il_geojson *g, object *o, member m)
{
    if (o->type == IL_GEOJSON_NONE && (o->kind == UNKNOWN || m == ESRI))
        remember(g, o);
    if (m == ESRI)
        o->seen |= 1u << m;
    return il_geojson_skip(g, IL_JSON_KEY);
}

/* The member whose key is at hand. */
static il_status take_member(il_geojson *g, object *o, size_t nested)
{
    member m = find_member(g);
    il_status st = IL_OK;
    if (!is_own(o, m))
        return pass_over(g, o, m);
    if (o->seen & 1u << m)
        return il_fail(g->err, IL_E_INPUT, g->json.line, "'%.*s' comes twice in one object", (int)g->json.n, g->json.text);
    o->seen |= 1u << m;
    if (o->kind == UNKNOWN && kind_of_member[m] != UNKNOWN)
        st = set_kind(g, o, kind_of_member[m]);
    return st == IL_OK ? read_value(g, o, m, nested) : st;
}

/* O is whole. */
static il_status end_object(il_geojson *g, object *o)
{
    static const struct { member member; const char *name; } needs[N_KINDS] = {
        [COLLECTION] = { FEATURES, "features" }, [FEATURE] = { GEOMETRY_OF, "geometry" },
        [GEOMETRIES] = { GEOMETRIES_OF, "geometries" }, [GEOMETRY] = { COORDINATES, "coordinates" } };
    il_status st = IL_OK;
    bool has_all = o->seen & 1u << needs[o->kind].member;
    if (o->type == IL_GEOJSON_NONE)
        return fail_object(g, o);
    if (!has_all && o->kind == FEATURE)
        il_map_skip(g->set, o->line, "feature", "has no geometry");
    else if (!has_all)
        return il_fail(g->err, IL_E_INPUT, o->line, "a %s has no '%s'", il_geojson_type_name[o->type], needs[o->kind].name);
    if (o->kept)
        st = il_geojson_coordinates_settle(g, o->type);
    if (!o->begun || st != IL_OK)
        return st;
    g->in_feature = false;
    return il_map_end_feature(g->set, g->err);
}

/* The object that has begun; NESTED others are around it. */
static il_status read_object(il_geojson *g, size_t nested)
{
    object o = { .line = g->json.line };
    il_json_event event;
    il_status st;
    if (nested > NESTED_MOST)
        return il_fail(g->err, IL_E_INPUT, o.line, "collections nested more than %d deep", NESTED_MOST);
    while ((st = il_geojson_next(g, &event)) == IL_OK && event != IL_JSON_OBJECT_END)
        if ((st = take_member(g, &o, nested)) != IL_OK)
            return st;
    return st == IL_OK ? end_object(g, &o) : st;
}

/* ---- texts -------------------------------------------------------------------------- */

/* Take what stands before the JSON from SOURCE, and what may then stand behind it. */
static il_status pass_lead(il_geojson *g, il_source *source)
{
    enum { PEEKED = 4096, SHOWN = 60 };
    const unsigned char *head;
    char taken[PEEKED];
    size_t n, got = 1;
    bool is_call;
    il_status st = il_source_peek(source, PEEKED, &head, &n, g->err);
    n = st == IL_OK ? il_geojson_lead((const char *)head, n < PEEKED ? n : PEEKED, &is_call) : 0;
    g->json.between = "\x1e";
    if (n == 0)
        return st;
    g->json.between = is_call ? ");\x1e" : ";\x1e";
    size_t from = il_json_skip_blanks((const char *)head, n, 0), shown = n - from < SHOWN ? n - from : SHOWN;
    il_report_note(il_map_report(g->set), "%.200s: the JavaScript around the JSON ('%.*s') is passed over", il_map_file(g->set),
                   (int)shown, (const char *)head + from);
    for (size_t k = 0; k < n && got > 0 && st == IL_OK; k += got) {
        st = il_source_read(source, taken, n - k, &got, g->err);
        for (size_t i = 0; i < got; i++)
            g->json.line += taken[i] == '\n';
    }
    return st;
}

/* Objects behind one another, or in an array. */
static il_status read_texts(il_geojson *g)
{
    il_json_event event;
    il_status st;
    bool seen = false;
    while ((st = il_geojson_next(g, &event)) == IL_OK && event != IL_JSON_END) {
        bool is_list = event == IL_JSON_ARRAY_END || (event == IL_JSON_ARRAY && g->json.depth == 1);
        if (event == IL_JSON_OBJECT)
            st = read_object(g, 0);
        else if (!is_list)
            st = il_fail(g->err, IL_E_INPUT, g->json.line, "JSON, but not GeoJSON, which is an object, { ... }");
        if (st != IL_OK)
            return st;
        seen |= !is_list;
    }
    return st == IL_OK && !seen ? il_fail(g->err, IL_E_INPUT, g->json.line, "there is no GeoJSON in this file") : st;
}

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    il_geojson g = { .set = set, .err = err };
    il_json_scan_init(&g.json, source, options);
    il_status st = pass_lead(&g, source);
    if (st == IL_OK)
        st = read_texts(&g);
    il_json_scan_free(&g.json);
    il_free(g.point);
    il_free(g.part);
    il_free(g.name);
    il_free(g.wanted);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_map_read("GeoJSON", parse, source, n, options, sink, report, err);
}

const il_reader il_reader_geojson = {
    .name = "geojson",
    .extensions = "geojson json js",
    .words = "isolines as GeoJSON",
    .is_map = true,
    .probe = il_geojson_probe,
    .read = read_all,
};

const il_reader il_reader_geojsonseq = {
    .name = "geojsonseq",
    .extensions = "geojsonl geojsons ndjson jsonl",
    .words = "isolines as a GeoJSON text sequence, one feature a line",
    .is_map = true,
    .probe = il_geojson_probe_sequence,
    .read = read_all,
};
