/* map-set.h - the lines of a map, filled feature by feature in file order.
 *
 * The formats of GIS differ in syntax only.  Each parser calls these functions,
 * in this order:
 *     feature = begin_feature (attribute | place | part)* end_feature
 *     part    = begin_part point* end_part
 * and when all files are read the set decides which of all that a feature says is
 * its height, whether coordinates are degrees and what becomes of them, and hands
 * on one stack of kind terrain: a slice a level, with a ring or open line a part.
 * Files read together are one set.
 *
 * Everything is held until the last file ends: 16 bytes a point of lines, 80 a part, 48 a
 * point by itself, 8 a feature for each attribute that may be a height. */
#ifndef IL_INPUT_MAP_SET_H
#define IL_INPUT_MAP_SET_H

#include "input/reader.h"

typedef struct il_map_set il_map_set;

/* LINE: an isoline, closed when its last point is its first.  RING: the outline of
 * a polygon or of a hole in it, closed in any case; its last point may repeat the
 * first.  The rings of a feature are one polygon or several.  POINT: one or more points
 * by themselves, spot heights if they have a height, else counted as skipped. */
typedef enum il_map_part { IL_MAP_LINE, IL_MAP_RING, IL_MAP_POINT } il_map_part;

/* LINE is where it stands in the file, for reports; 0 in files without lines.
 * Failures: IL_E_INPUT, beyond a limit or no number; IL_E_NOMEM. */
il_status il_map_begin_feature(il_map_set *s, long line, il_error *err);
il_status il_map_end_feature(il_map_set *s, il_error *err);

/* Features of the file so far only told what all have in common: the next is its first. */
void il_map_count_from_here(il_map_set *s);

il_status il_map_begin_part(il_map_set *s, il_map_part kind, long line, il_error *err);
/* z: NAN when the point has none.  Repeated points may come; they are dropped later. */
il_status il_map_point(il_map_set *s, double x, double y, double z, long line, il_error *err);
il_status il_map_end_part(il_map_set *s, il_error *err);

/* The feature's attribute NAME has the value TEXT, as it is written, without quotes;
 * a value that is not there (null, an empty cell) is told with TEXT null, so that its
 * name is known.  Names that differ in case are two attributes; what they mean does not
 * depend on case.  Both are UTF-8, and other bytes are shown as such. */
il_status il_map_attribute(il_map_set *s, const char *name, size_t n_name, const char *text, size_t n, il_error *err);

/* The same for what is no attribute but stands where the format may have put the
 * height: GMT's -Z, the name of a KML placemark.  It is asked after z coordinates.
 * A format has one or two such places, NAME "-Z", "name". */
il_status il_map_place(il_map_set *s, const char *name, const char *text, size_t n, il_error *err);

/* Does an attribute of this name matter, so that its text is worth putting together?
 * Tell of the attribute in any case, if need be with TEXT null. */
bool il_map_wants(const il_map_set *s, const char *name, size_t n_name);

/* What the file says of its coordinates, in its own words: "EPSG:4326", WKT, a
 * URN, a PROJ string.  Two files must not say different things (IL_E_INPUT). */
il_status il_map_crs(il_map_set *s, const char *text, size_t n, long line, il_error *err);

/* x and y are longitudes and latitudes, by the format (KML, GPX) or by the names of
 * their columns. */
void il_map_degrees(il_map_set *s);

/* What one x, y and z of the file is, where the file says so (DXF's $INSUNITS).  Two files
 * must not say different things (IL_E_INPUT), unless the user says what it is. */
il_status il_map_unit(il_map_set *s, il_unit unit, long line, il_error *err);

/* For what the parser leaves out or wonders about: the set's report (may be null)
 * and the name of the file at hand. */
il_report *il_map_report(il_map_set *s);
const char *il_map_file(const il_map_set *s);
/* A part of the file that is left out, counted with WHAT it is and WHY. */
void il_map_skip(il_map_set *s, long line, const char *what, const char *why);

/* What the readers share: parse every SOURCE by PARSE into one set, then hand on its
 * stack and end SINK.  FORMAT names the format in errors ("GeoJSON").  IL_E_INPUT when
 * it is no set of isolines, saying why and what attributes there are. */
typedef il_status il_map_parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err);
il_status il_map_read(const char *format, il_map_parse *parse, il_source *const *source, size_t n,
                      const il_read_options *options, il_sink *sink, il_report *report, il_error *err);

#endif
