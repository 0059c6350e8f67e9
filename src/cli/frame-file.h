/* frame-file.h - the edge of a map, from a file (--frame FILE). */
#ifndef IL_CLI_FRAME_FILE_H
#define IL_CLI_FRAME_FILE_H

#include "input/map-crs.h"
#include "input/reader.h"
#include "terrain/frame.h"

/* rings: clean, the map on their left.  unit: of them; native: the file says it, and no
 * words of the map's unit count for it.  crs: what the file says of its coordinates, or null. */
typedef struct il_frame_file {
    il_slice rings;
    il_unit unit;
    bool native, is_labelled;
    char *crs;
} il_frame_file;

#define IL_FRAME_FILE_INIT { IL_SLICE_INIT, IL_UNIT_M, false, false, NULL }
void il_frame_file_free(il_frame_file *o); /* safe twice */

/* Read the polygons and closed lines of FILE, of any format for maps or native, whose
 * numbers the user says mean what those of the map do (READ).  Holes are told by even-odd
 * parity.  What is left out goes to REPORT.  IL_E_INPUT when they enclose nothing. */
il_status il_frame_file_read(il_frame_file *o, const char *file, const il_read_options *read, il_report *report, il_error *err);

/* O as what a frame is made of: borrowed. */
il_frame_options il_frame_file_frame(const il_frame_file *o);

/* A sink that passes all on to NEXT (borrowed), but IL_E_INPUT where a stack and O
 * (borrowed) state coordinate systems that contradict each other. */
il_status il_frame_file_guard_new(il_sink **out, const il_frame_file *o, il_sink *next, il_error *err);
void il_frame_file_guard_free(il_sink *s); /* null is fine */

#endif
