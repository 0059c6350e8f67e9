/* map-data.h - what a map set holds, for the files that make a stack of it.
 *
 * They work on it one after the other, in place (map-set.c, il_map_read):
 *     map-set      parsers fill it
 *     map-heights  where the heights stand, and each part's height
 *     map-stack    by level, to the sink */
#ifndef IL_INPUT_MAP_DATA_H
#define IL_INPUT_MAP_DATA_H

#include "input/map-set.h"

#include <stdint.h>

/* A line or the outline of a polygon: points begin..begin+n of the map, the first not
 * repeated at the end where it is closed.  z_low, z_high: of its points' z; n_z of
 * them had one.  feature, file: indices; line: in the file, 0 unknown.
 * height: as decided, in the unit of the stack, NAN until then and for parts that are
 * left out.  ends_meet: the last point was the first. */
typedef struct il_map_line {
    size_t begin, n, n_z;
    double z_low, z_high;
    double height;
    long line;
    uint32_t feature, file;
    unsigned char kind;         /* il_map_part */
    bool closed;
} il_map_line;

/* An attribute that features have.  value: a number a feature, NAN where it has
 * none, n of them, kept only if it is wanted.  n_numbers, n_texts: features with a
 * number, and with another text.  has_unit: numbers came with one ("10 ft");
 * mixed_units: not all with the same. */
typedef struct il_map_column {
    char *name;
    bool is_place, wanted, has_unit, mixed_units;
    il_unit unit;
    double *value;
    size_t n, cap, n_numbers, n_texts;
} il_map_column;

typedef struct il_map {
    const char *format;         /* its name for people */
    const il_read_options *options;
    il_report *report;
    double *xy;
    size_t n, cap;              /* points */
    il_map_line *line;
    size_t n_lines, cap_lines;
    il_map_column *column;
    size_t n_columns, cap_columns, n_columns_dropped;
    size_t n_features, n_files;
    const char **file;          /* borrowed names */
    char *crs;                  /* null when no file says */
    bool degrees;               /* the format or the columns' names say so */
    bool has_unit;
    il_unit unit;
} il_map;

/* Where LINE stands, for errors and reports. */
static inline const char *il_map_file_of(const il_map *m, const il_map_line *l)
{
    return m->file[l->file];
}

/* Leave line L out, counted as skipped with these words. */
void il_map_drop(il_map *m, il_map_line *l, const char *what, const char *why);

#endif
