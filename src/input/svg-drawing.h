/* svg-drawing.h - an SVG file as a sequence of start tags, end tags and text:
 * which groups are open, what they say about place and height, what is drawn. */
#ifndef IL_INPUT_SVG_DRAWING_H
#define IL_INPUT_SVG_DRAWING_H

#include "input/reader.h"
#include "input/svg-attr.h"
#include "input/svg-level.h"
#include "input/svg-slices.h"
#include "input/svg-transform.h"
#include "input/svg-view.h"

/* What an open element hands down to those inside it.  given, named: the
 * heights of the nearest elements that have one as an attribute, or in their
 * name.  own_level: it has one of them itself.  slot: of which slice by document
 * order.  holds: something was drawn or left out inside, so it is not empty. */
typedef struct il_svg_frame {
    il_affine matrix;
    il_svg_viewport viewport;
    il_svg_level given, named;
    size_t slot;
    long line;
    bool is_svg, own_level, is_slot, holds;
} il_svg_frame;

/* One set of files while it is read.  The fields down to `name` belong to the
 * set, the others to the file FILE called FILE_NAME.
 * n_ignored: depth inside an element that draws nothing, 0 outside. */
typedef struct il_svg_drawing {
    const il_read_options *options;
    il_report *report;
    il_svg_slices slices;
    size_t n_points;
    size_t n_unscaled;          /* files whose user units were taken as mm */
    bool has_title;
    char *title;                /* n_title bytes */
    size_t n_title, cap_title;

    size_t file;
    const char *file_name;
    il_svg_frame *frame;
    size_t n_frames, cap_frames, n_ignored, n_slots;
    long n_owners, ignored_line;
    bool is_slic3r, is_plate, is_physical, is_seen, in_title;
    il_svg_text at;             /* the attribute that a failure was in; name null for none */
} il_svg_drawing;

void il_svg_drawing_init(il_svg_drawing *d, const il_read_options *options, il_report *report);
void il_svg_drawing_free(il_svg_drawing *d);

void il_svg_drawing_begin_file(il_svg_drawing *d, size_t file, const char *name);
il_status il_svg_drawing_start(il_svg_drawing *d, const il_svg_element *e, il_error *err);
il_status il_svg_drawing_end(il_svg_drawing *d, il_error *err);
/* Text between tags, N bytes of UTF-8 in any number of pieces. */
il_status il_svg_drawing_text(il_svg_drawing *d, const char *s, size_t n, il_error *err);
/* IL_E_INPUT when an element is still open. */
il_status il_svg_drawing_end_file(il_svg_drawing *d, il_error *err);

/* The depth of open elements. */
size_t il_svg_drawing_depth(const il_svg_drawing *d);

#endif
