#include "config.h"
#include "input/csv-names.h"
#include "base/text.h"
#include "input/map-value.h"

#include <string.h>

enum { NAME_MOST = 64 };

static const struct { const char *word; il_csv_pair pair; bool is_y; } axes[] = {
    { "x", IL_CSV_XY, false }, { "y", IL_CSV_XY, true },
    { "xcoord", IL_CSV_XY, false }, { "ycoord", IL_CSV_XY, true },
    { "coordx", IL_CSV_XY, false }, { "coordy", IL_CSV_XY, true },
    { "easting", IL_CSV_EASTING, false }, { "northing", IL_CSV_EASTING, true },
    { "eastings", IL_CSV_EASTING, false }, { "northings", IL_CSV_EASTING, true },
    { "east", IL_CSV_EASTING, false }, { "north", IL_CSV_EASTING, true },
    { "e", IL_CSV_EASTING, false }, { "n", IL_CSV_EASTING, true },
    { "rechtswert", IL_CSV_EASTING, false }, { "hochwert", IL_CSV_EASTING, true },
    { "lon", IL_CSV_DEGREES, false }, { "lat", IL_CSV_DEGREES, true },
    { "long", IL_CSV_DEGREES, false }, { "lng", IL_CSV_DEGREES, false },
    { "longitude", IL_CSV_DEGREES, false }, { "latitude", IL_CSV_DEGREES, true } };

static const char *const fillers[] = { "coord", "coordinate", "point", "pt", "vertex", "utm", "wgs84", "dd", "deg", "degrees" };

static const char *const line_numbers[] = {
    "line_id", "lineid", "line", "line_no", "lineno", "contour_id", "contourid", "contour_no", "isoline", "isoline_id",
    "polyline", "polyline_id", "segment", "segment_id", "seg", "seg_id", "part", "part_id", "vertex_part", "ring", "ring_id",
    "vertex_part_ring", "shape", "shape_id", "shapeid", "path", "path_id", "track", "track_id", "feature", "feature_id",
    "featureid", "group", "group_id", "id", "fid", "gid", "objectid", "orig_fid", "object_id", "ogc_fid", "oid" };

static const char *const geometries[] = { "wkt", "geom", "the_geom", "geometry", "wkt_geom", "geom_wkt", "geometry_wkt",
    "wkb_geometry", "wkt_geometry", "shape_wkt", "ewkt", "geo_shape", "way" };

static bool is_one_of(const char *name, size_t n, const char *const *words, size_t n_words)
{
    for (size_t k = 0; k < n_words; k++)
        if (il_text_is_word(name, n, words[k]))
            return true;
    return false;
}

/* A word of a name; *FOUND: the coordinate was there. */
static bool take_word(const char *s, size_t n, il_csv_axis *out, bool *found)
{
    for (size_t k = 0; k < sizeof axes / sizeof *axes && !*found; k++) {
        if (il_text_is_word(s, n, axes[k].word)) {
            out->pair = axes[k].pair;
            out->is_y = axes[k].is_y;
            *found = true;
            return true;
        }
    }
    if (il_map_unit_word(s, n, &out->unit)) {
        out->has_unit = true;
        return true;
    }
    return is_one_of(s, n, fillers, sizeof fillers / sizeof *fillers);
}

static bool is_joint(char c)
{
    return c != '\0' && strchr("_-. ()[]", c) != NULL;
}

bool il_csv_name_axis(const char *name, size_t n, il_csv_axis *out)
{
    bool found = false;
    *out = (il_csv_axis){ .pair = IL_CSV_XY };
    if (n > NAME_MOST)
        return false;
    for (size_t begin = 0, end; begin < n; begin = end + 1) {
        for (end = begin; end < n && !is_joint(name[end]);)
            end++;
        if (end > begin && !take_word(name + begin, end - begin, out, &found))
            return false;
    }
    return found;
}

bool il_csv_name_numbers_lines(const char *name, size_t n)
{
    return is_one_of(name, n, line_numbers, sizeof line_numbers / sizeof *line_numbers);
}

bool il_csv_name_is_geometry(const char *name, size_t n)
{
    return is_one_of(name, n, geometries, sizeof geometries / sizeof *geometries);
}
