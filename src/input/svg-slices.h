/* svg-slices.h - what was drawn, gathered by height and sent on as one stack.
 *
 * An SVG file can put its slices in any order and leave their heights to be
 * counted, so the whole stack is held until the last file has been read. */
#ifndef IL_INPUT_SVG_SLICES_H
#define IL_INPUT_SVG_SLICES_H

#include "input/reader.h"
#include "input/svg-level.h"

/* A part of a slice: what one group, or several single elements in a row, drew
 * at one level.  slot: number of the slice by document order, for parts
 * without a height; file: its number. */
typedef struct il_svg_part {
    il_svg_level level;
    size_t slot, file, order;
    long line;
    double z;
    il_slice slice;
} il_svg_part;

typedef struct il_svg_slices {
    il_svg_part *part;
    size_t n, cap;
} il_svg_slices;

#define IL_SVG_SLICES_INIT { NULL, 0, 0 }

void il_svg_slices_free(il_svg_slices *s);

/* Add the rings of DRAWN (emptied) at LEVEL, or at SLOT when its kind is NONE,
 * of file FILE.  Without rings it is an empty slice: there is nothing of the
 * solid at that height. */
il_status il_svg_slices_add(il_svg_slices *s, const il_svg_level *level, size_t slot, size_t file, long line,
                            il_slice *drawn, il_error *err);

/* File FILE, called NAME, is complete: settle its slic3r heights, and turn y
 * round if FLIP. */
void il_svg_slices_end_file(il_svg_slices *s, size_t file, const char *name, bool flip, il_report *report);

/* Send all as the stack HEAD into SINK, slices in rising z; N sources, for
 * their names.  IL_E_INPUT when there is no contour, when heights are needed
 * and neither given nor counted, or given for some and not for others. */
il_status il_svg_slices_send(il_svg_slices *s, const il_stack_head *head, il_source *const *source, size_t n,
                             const il_read_options *o, il_sink *sink, il_report *report, il_error *err);

#endif
