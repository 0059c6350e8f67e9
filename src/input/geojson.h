/* geojson.h - what the files of the reader of GeoJSON share (RFC 7946).
 *
 *     geojson              values, objects, features; the two readers
 *     geojson-coordinates  arrays of numbers to lines
 *     geojson-properties   attributes of a feature
 *     geojson-crs          the member crs of GeoJSON before the RFC
 *     geojson-lead         how a text begins: JavaScript around it, and telling it apart
 *
 * Everything goes to the map set as it comes; what is kept are the coordinates of a
 * geometry whose type comes behind them. */
#ifndef IL_INPUT_GEOJSON_H
#define IL_INPUT_GEOJSON_H

#include "input/json-scan.h"
#include "input/map-set.h"

typedef enum il_geojson_type {
    IL_GEOJSON_NONE, IL_GEOJSON_FEATURE_COLLECTION, IL_GEOJSON_FEATURE, IL_GEOJSON_GEOMETRY_COLLECTION,
    IL_GEOJSON_POINT, IL_GEOJSON_MULTI_POINT, IL_GEOJSON_LINE_STRING, IL_GEOJSON_MULTI_LINE_STRING,
    IL_GEOJSON_POLYGON, IL_GEOJSON_MULTI_POLYGON,
    IL_GEOJSON_N_TYPES
} il_geojson_type;

extern const char *const il_geojson_type_name[IL_GEOJSON_N_TYPES];

/* A position and a list of them; z NAN for none. */
typedef struct il_geojson_point { double x, y, z; long line; } il_geojson_point;
typedef struct il_geojson_part { size_t end; long line; } il_geojson_part;

/* point[0..n), part[0..n_parts): coordinates whose type is not known yet.  depth: of
 * the arrays that are their positions, 0 when there is none.  deepest_empty: of the
 * empty arrays among them, and its line.
 * name: of the property at hand.  wanted[0..n_wanted): the names of the feature's
 * properties that may be heights, each behind its length. */
typedef struct il_geojson {
    il_json_scan json;
    il_map_set *set;            /* borrowed, as all that follows */
    il_error *err;
    bool in_feature, told_more;
    il_geojson_point *point;    size_t n, cap;
    il_geojson_part *part;      size_t n_parts, cap_parts;
    size_t depth, deepest_empty;
    long empty_line;
    char *name;                 size_t n_name, cap_name;
    char *wanted;               size_t n_wanted, cap_wanted;
} il_geojson;

static inline il_status il_geojson_next(il_geojson *g, il_json_event *event)
{
    return il_json_scan_next(&g->json, event, g->err);
}

static inline il_status il_geojson_skip(il_geojson *g, il_json_event event)
{
    return il_json_scan_skip(&g->json, event, g->err);
}

/* Is the text of the event last given WORD? */
bool il_geojson_is(const il_geojson *g, const char *word);

/* These read the value of a member whose key was the last event; failures are those
 * of the scanner and the set, and IL_E_INPUT for values that are none of GeoJSON.
 * coordinates: of a geometry of TYPE, handed on as parts, or kept when it is NONE. */
il_status il_geojson_coordinates(il_geojson *g, il_geojson_type type);
il_status il_geojson_properties(il_geojson *g);
il_status il_geojson_crs(il_geojson *g);

/* Hand on the coordinates that were kept, of a geometry of TYPE. */
il_status il_geojson_coordinates_settle(il_geojson *g, il_geojson_type type);

/* The bytes of HEAD[0..N) that are JavaScript before a value: `var lines =`, `show(`;
 * 0 when there are none.  *IS_CALL: it is the latter. */
size_t il_geojson_lead(const char *head, size_t n, bool *is_call);

/* Does HEAD begin as an object of JSON, or several, with or without such a lead? */
bool il_geojson_probe(const unsigned char *head, size_t n);
/* As objects of JSON one a line, or behind RS as in RFC 8142? */
bool il_geojson_probe_sequence(const unsigned char *head, size_t n);

#endif
