/* reader.h - one reader a format; all fill the same model through a sink. */
#ifndef IL_INPUT_READER_H
#define IL_INPUT_READER_H

#include "base/source.h"
#include "base/status.h"
#include "model/report.h"
#include "model/sink.h"

#include <stdbool.h>

/* How depths are counted; what becomes of degrees. */
typedef enum il_depth { IL_DEPTH_AUTO, IL_DEPTH_DOWN, IL_DEPTH_UP } il_depth;
typedef enum il_project { IL_PROJECT_AUTO, IL_PROJECT_UTM, IL_PROJECT_TM, IL_PROJECT_NONE } il_project;

/* What the user may say about a map (formats with is_map).  Texts are borrowed.
 * height: the attribute that holds the heights, without regard to case, "z" for the
 * z coordinates, "LOW,HIGH" for the two of a band; null when not given.  z_unit: of
 * the heights.  layer: the patterns of --layer (base/pattern.h).  high: on which
 * side of the lines the ground is higher, for maps of one level.  outline: what is read
 * is no map but the edge of one: all closed lines, as one slice at 0; degrees stay. */
typedef struct il_map_options {
    const char *height;
    il_depth depth;
    bool has_z_unit;
    il_unit z_unit;
    il_project project;
    const char **layer;
    size_t n_layers, cap_layers;
    il_side high;
    bool outline;
} il_map_options;

/* What the user may say about the input.  spacing: distance of slices that
 * carry no height, in the input's unit, 0 when not given.  The limits are
 * generous guards against hostile files; their defaults are IL_LIMIT_…. */
typedef struct il_read_options {
    double spacing;
    bool has_spacing;
    bool no_flip;               /* SVG: take y as pointing up */
    bool has_unit;
    il_unit unit;               /* what the input's numbers mean */
    double flatness;            /* largest distance of a flattened curve from the true one, unit; 0: default */
    size_t max_line;            /* bytes */
    size_t max_depth;           /* nested elements */
    size_t max_points;          /* vertices a stack */
    il_map_options map;
    int threads;                /* to work with at most, 0: 1 */
} il_read_options;

enum {
    IL_LIMIT_LINE = 64 * 1024 * 1024,
    IL_LIMIT_DEPTH = 1000,
    IL_LIMIT_POINTS = 500 * 1000 * 1000
};

#define IL_READ_OPTIONS_INIT { 0, false, false, false, IL_UNIT_MM, 0, IL_LIMIT_LINE, IL_LIMIT_DEPTH, IL_LIMIT_POINTS, \
    { NULL, IL_DEPTH_AUTO, false, IL_UNIT_M, IL_PROJECT_AUTO, NULL, 0, 0, IL_SIDE_UNKNOWN, false }, 0 }

/* name: as after -f.  extensions: space-separated, without the point.
 * words: for --formats.  is_patient: structures that a person drew in a patient;
 * coordinates are LPS, slices may be missing, and an empty one says nothing.
 * is_map: isolines; options.map is for them.
 * probe: do the first N bytes look like this format?
 * look: the same into *IS for formats of which only a try at reading tells, so that want
 * of memory (IL_E_NOMEM) is not taken for another format; null for the others.
 * read: read all of the N sources, in the order given, as one set into SINK
 * (many for formats whose files are slices; native streams follow one another).
 * A failure is reported in *ERR with the source's name and the line. */
typedef struct il_reader {
    const char *name, *extensions, *words;
    bool is_patient, is_map;
    bool (*probe)(const unsigned char *head, size_t n);
    il_status (*look)(const unsigned char *head, size_t n, bool *is, il_error *err);
    il_status (*read)(il_source *const *source, size_t n, const il_read_options *options,
                      il_sink *sink, il_report *report, il_error *err);
} il_reader;

/* Null-terminated, in order of probing. */
extern const il_reader *const il_readers[];

/* The reader called NAME, or null. */
const il_reader *il_reader_named(const char *name);

/* The reader for SOURCE by its first bytes; IL_E_INPUT when none fits. */
il_status il_reader_detect(il_source *source, const il_reader **out, il_error *err);

extern const il_reader il_reader_loft, il_reader_svg, il_reader_dcmdump, il_reader_dicom_json,
    il_reader_dicom_xml;
extern const il_reader il_reader_geojson, il_reader_geojsonseq;
extern const il_reader il_reader_bln, il_reader_csv, il_reader_gmt;
extern const il_reader il_reader_gpx, il_reader_kml;
extern const il_reader il_reader_dxf, il_reader_shp;

#endif
