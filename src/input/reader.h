/* reader.h - one reader a format; all fill the same model through a sink. */
#ifndef IL_INPUT_READER_H
#define IL_INPUT_READER_H

#include "base/source.h"
#include "base/status.h"
#include "model/report.h"
#include "model/sink.h"

#include <stdbool.h>

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
} il_read_options;

enum {
    IL_LIMIT_LINE = 64 * 1024 * 1024,
    IL_LIMIT_DEPTH = 1000,
    IL_LIMIT_POINTS = 500 * 1000 * 1000
};

#define IL_READ_OPTIONS_INIT { 0, false, false, false, IL_UNIT_MM, 0, IL_LIMIT_LINE, IL_LIMIT_DEPTH, IL_LIMIT_POINTS }

/* name: as after -f.  extensions: space-separated, without the point.
 * words: for --formats.  is_patient: structures that a person drew in a patient;
 * coordinates are LPS, slices may be missing, and an empty one says nothing.
 * probe: do the first N bytes look like this format?
 * read: read all of the N sources, in the order given, as one set into SINK
 * (many for formats whose files are slices; native streams follow one another).
 * A failure is reported in *ERR with the source's name and the line. */
typedef struct il_reader {
    const char *name, *extensions, *words;
    bool is_patient;
    bool (*probe)(const unsigned char *head, size_t n);
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

#endif
