/* wkt.h - geometries as well-known text (OGC 06-103r4, ISO 19125), with PostGIS's
 * SRID=n; in front.
 *
 * Points have two to four numbers: x, y, z, m, or x, y, m behind the word M.  Without
 * Z, M or ZM three numbers are x, y, z.  The words are taken in any case, and Z and
 * M may stand at the end of the type's name (LINESTRINGZ). */
#ifndef IL_INPUT_WKT_H
#define IL_INPUT_WKT_H

#include "input/map-set.h"

/* Does TEXT[0..N) begin as a geometry does: its type, and behind it a bracket, EMPTY, Z
 * or M? */
bool il_wkt_begins(const char *text, size_t n);

/* Is TEXT[0..N) hexadecimal well-known binary, which is no text? */
bool il_wkt_is_hex(const char *text, size_t n);

/* How many bytes of TEXT[0..N), which begins as a geometry, it takes up to its last
 * bracket; 0 when that is not there.  *OPEN, *AT: the brackets open and the bytes seen by
 * an earlier call for a shorter TEXT; 0 at first. */
size_t il_wkt_length(const char *text, size_t n, size_t *open, size_t *at);

/* Give the lines and rings of the geometry TEXT[0..N), whose first line is LINE, to SET as
 * parts of the feature at hand, and its SRID.  Curves and surfaces are left out and
 * counted.  IL_E_INPUT: it is no WKT, or nested more than MAX_DEPTH or 1000 deep. */
il_status il_wkt_read(il_map_set *set, const char *text, size_t n, long line, size_t max_depth, il_error *err);

#endif
