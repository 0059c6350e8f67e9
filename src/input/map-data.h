/* map-data.h - what a map set holds, for the files that make a stack of it.
 *
 * They work on it one after the other, in place (map-set.c, il_map_read):
 *     map-set      parsers fill it, map-spots the points by themselves
 *     map-outline  instead of all that follows but map-degrees and map-stack, where the
 *                  edge of a map is asked for
 *     map-heights  where the heights stand, and each line's height
 *     map-degrees  whether x and y are degrees; one run of longitudes
 *     map-borders  polygons become the lines between them
 *     map-units    heights in the unit of the stack, levels that are one made one
 *     map-trim     ends that lie on an edge of another line
 *     map-plane    which projection
 *     map-project  degrees to metres
 *     map-stack    by level, to the sink */
#ifndef IL_INPUT_MAP_DATA_H
#define IL_INPUT_MAP_DATA_H

#include "input/map-crs.h"
#include "input/map-set.h"

#include <stdint.h>

/* A line or the outline of a polygon: points begin..begin+n of the map, the first not
 * repeated at the end where it is closed.  z_low, z_high: of its points' z; n_z of
 * them had one.  feature, file: indices; line: in the file, 0 unknown.
 * height: as decided, NAN until then and for lines that are left out; upper: for bands,
 * whose height is their lower one, NAN for others. */
typedef struct il_map_line {
    size_t begin, n, n_z;
    double z_low, z_high;
    double height, upper;
    long line;
    uint32_t feature, file;
    unsigned char kind;         /* il_map_part */
    bool closed;
} il_map_line;

/* An attribute that features have.  value: a number a feature, NAN where it has
 * none, n of them, kept only if it is wanted.  n_numbers, n_texts: features with a
 * number, and with another text.  has_unit: numbers came with one ("10 ft");
 * mixed_units: not all with the same.  file: the last in which it was spelt like this. */
typedef struct il_map_column {
    char *name;
    bool is_place, wanted, has_unit, mixed_units;
    il_unit unit;
    uint32_t file;
    double *value;
    size_t n, cap, n_numbers, n_texts;
} il_map_column;

/* Where the heights stand: an attribute, the two of a band, or z.  Indices of columns. */
typedef struct il_map_where {
    enum { IL_MAP_NOWHERE, IL_MAP_COLUMN, IL_MAP_BAND, IL_MAP_Z } kind;
    size_t low, high;           /* COLUMN has low only */
} il_map_where;

typedef struct il_map {
    const char *format;         /* its name for people */
    const il_read_options *options;
    il_report *report;
    double *xy;
    size_t n, cap;              /* points */
    il_map_line *line;
    size_t n_lines, cap_lines;
    il_spot *spot;              /* points by themselves; in the file's terms until map-units */
    size_t n_spots, cap_spots;
    il_map_column *column;
    size_t n_columns, cap_columns, n_wanted;
    bool more_columns;          /* than are kept */
    size_t n_features, n_files;
    const char **file;          /* borrowed names */
    size_t *first_feature;      /* of each file */
    char *crs;                  /* as the first file that says has it; null when none does */
    il_crs meaning;             /* of crs */
    bool degrees;               /* x and y are; until map-degrees: the format or the columns' names say so */
    bool has_unit;
    il_unit unit;               /* of x, y and z; since map-units: of the stack */
    il_map_where place;      /* since map-heights */
    bool is_projected;
    il_projection projection;   /* what made metres of degrees, if anything did */
    unsigned char *mark;        /* a point each, IL_VERTEX_...; null: none has one */
    double box[4];              /* since map-degrees: least x, y, greatest x, y of lines with a height */
} il_map;

/* Where LINE stands, for errors and reports. */
static inline const char *il_map_file_of(const il_map *m, const il_map_line *l)
{
    return m->file[l->file];
}

/* Which of its file's features L is of, from 1. */
static inline long il_map_feature_of(const il_map *m, const il_map_line *l)
{
    return (long)(l->feature - m->first_feature[l->file]) + 1;
}

/* Has L a height, so that it takes part? */
static inline bool il_map_takes_part(const il_map_line *l)
{
    return l->height == l->height;
}

/* Leave line L out, counted as skipped with these words. */
void il_map_drop(il_map *m, il_map_line *l, const char *what, const char *why);

#endif
