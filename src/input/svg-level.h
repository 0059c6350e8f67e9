/* svg-level.h - the height of an element: from attributes, or from its name. */
#ifndef IL_INPUT_SVG_LEVEL_H
#define IL_INPUT_SVG_LEVEL_H

#include "input/svg-attr.h"

/* NONE: by document order.  ORDINAL: VALUE is a number of slice ("layer12").
 * SLIC3R: VALUE is 1e6 times the slic3r:z that stands there, rounded once, and
 * RAW is slic3r:z itself: which of them is the height shows when the file's
 * largest is known (formats/svg.txt, section 4).  HEIGHT: VALUE is the height. */
typedef enum il_svg_level_kind { IL_SVG_LEVEL_NONE, IL_SVG_LEVEL_ORDINAL, IL_SVG_LEVEL_SLIC3R,
                                 IL_SVG_LEVEL_HEIGHT } il_svg_level_kind;

/* owner: number of the element it stands on; equal heights of two groups are
 * two slices made one, those of one group are one slice.  by_name: read from
 * id or label. */
typedef struct il_svg_level {
    il_svg_level_kind kind;
    double value, raw;
    long owner;
    bool by_name;
} il_svg_level;

#define IL_SVG_LEVEL_INIT { IL_SVG_LEVEL_NONE, 0, 0, 0, false }

/* The height that stands on E itself as an attribute: data-z, else z, else
 * slic3r:slice-z, else slic3r:z.  IL_E_INPUT when it is no number below 1e15.
 * *PLATE: E has slic3r:slice-z, so its file is of the kind that has y down. */
il_status il_svg_level_read(const il_svg_element *e, il_svg_level *level, bool *plate, il_error *err);

/* The height or number that stands in E's inkscape:label or id. */
void il_svg_level_read_name(const il_svg_element *e, il_svg_level *level);

/* The same for a name S[0..N): "z=3.5" is HEIGHT, "layer12" ORDINAL, a name of
 * which neither can be made NONE.  BARE: a name that is a number is a height. */
il_svg_level_kind il_svg_level_of_name(const char *s, size_t n, bool bare, double *value);

/* S[0..N) as a number times 1e6, rounded once (the decimal point is moved, so
 * "2e-07" is exactly .2); 0 as il_number_parse. */
size_t il_svg_parse_millionths(const char *s, size_t n, double *value);

#endif
