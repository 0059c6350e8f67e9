/* picture-parts.h - what the pictures are made of: held stacks, views, and what
 * stands round a drawing. */
#ifndef IL_OUTPUT_PICTURE_PARTS_H
#define IL_OUTPUT_PICTURE_PARTS_H

#include "model/pair.h"
#include "model/stack.h"
#include "output/label.h"
#include "output/svg-page.h"

/* Colours that are told apart by people who see few (Okabe & Ito 2008), and in
 * print by lightness. */
#define IL_LOWER_COLOR "#0072b2"
#define IL_LOWER_PALE "#d9e9f3"
#define IL_LOWER_BAND "#8fc1e0"
#define IL_UPPER_COLOR "#d55e00"
#define IL_UPPER_PALE "#f9e4d4"
#define IL_INK "#222"
#define IL_GRAY "#666"
#define IL_LINK_COLOR "#8a8a8a"
#define IL_GRID_COLOR "#b4b4b4"

/* Parts that are told apart, more than five by turns: none is the red of what stands out. */
enum { IL_N_PART_COLORS = 5 };
extern const char *const il_part_color[IL_N_PART_COLORS];

enum { IL_PAGE_WIDTH = 900, IL_PAGE_MARGIN = 30, IL_PAGE_INNER = IL_PAGE_WIDTH - 2 * IL_PAGE_MARGIN };

/* A slice, and what is known between the one before and it. */
typedef struct il_level {
    il_slice slice;
    il_pair below;
    bool has_pair;
} il_level;

/* The levels of a stack that are kept: level[k] is slice first + k of the
 * n_slices that there are; n_pairs: pair records, without gaps.  index: the
 * stack's place in the stream, from 1.  spacing: the least between two slices, 0
 * with fewer. */
typedef struct il_figure {
    il_stack_head head;
    il_level *level;        size_t n, cap;
    size_t first, n_slices, n_pairs, index;
    double z_least, z_greatest, spacing;
} il_figure;

/* The pictures: append F to PAGE, and move page->y.  A pair is of the slices
 * f->level[0] and [1]. */
il_status il_picture_draw_pair(il_svg_page *page, const il_figure *f, il_error *err);
il_status il_picture_draw_slices(il_svg_page *page, const il_figure *f, il_error *err);
il_status il_picture_draw_pairs(il_svg_page *page, const il_figure *f, il_error *err);
il_status il_picture_draw_skeleton(il_svg_page *page, const il_figure *f, il_error *err);

/* ---- boxes and views ------------------------------------------------------- */

/* Least x and y, greatest x and y. */
typedef struct il_box { double low[2], high[2]; } il_box;
il_box il_box_empty(void);
bool il_box_is_empty(const il_box *b);
void il_box_add(il_box *b, double x, double y);
void il_box_add_slice(il_box *b, const il_slice *s);
/* Side K (0 across, 1 up), at least something; 1 for an empty box. */
double il_box_side(const il_box *b, int k);

/* A rectangle of the page. */
typedef struct il_panel { double x, y, width, height; } il_panel;

/* The view at SCALE whose panel has the middle of B in its middle. */
il_svg_view il_view_centred(const il_panel *panel, const il_box *b, double scale);
/* The greatest scale at which a box of that width and height fits PANEL. */
double il_view_scale(const il_panel *panel, double width, double height);

/* ---- round the drawing ----------------------------------------------------- */

/* The stack's name, cut where it is long; "Stack 1" where it has none. */
void il_picture_name(il_label *l, const il_figure *f);
/* The stack's name with its colour, SUBTITLE under it. */
void il_picture_heading(il_svg_page *page, const il_figure *f, const char *subtitle);
/* "33 slices, z 0 to 64 mm". */
void il_picture_extent(il_label *l, const il_figure *f);
/* The greatest 1, 2 or 5 times a power of ten that is not above MOST. */
double il_picture_round_length(double most);
/* A bar of round length, at most MOST pixels, its left end at (x, y). */
void il_picture_scale_bar(il_svg_page *page, double x, double y, double most, double scale, il_unit unit);
/* Words within WIDTH from page->y on, which moves. */
void il_picture_paragraph(il_svg_page *page, double width, const char *words);

/* One entry of a legend: a line, box or dot with these attributes. */
typedef enum il_swatch { IL_SWATCH_LINE, IL_SWATCH_BOX, IL_SWATCH_DOT } il_swatch;
typedef struct il_legend_entry {
    const char *attributes, *words;
    il_swatch swatch;
} il_legend_entry;
/* The entries in columns from page->y on, which moves. */
void il_picture_legend(il_svg_page *page, const il_legend_entry *entry, size_t n);

/* A legend whose words and attributes are made up as it grows: it holds them itself, and
 * so must not be copied. */
enum { IL_LEGEND_MOST = 28 };
typedef struct il_legend {
    il_legend_entry entry[IL_LEGEND_MOST];
    il_label attributes[IL_LEGEND_MOST], words[IL_LEGEND_MOST];
    size_t n;
} il_legend;
/* Append an entry, of which there are not IL_LEGEND_MOST yet: where its words go. */
il_label *il_legend_add(il_legend *l, const char *attributes, il_swatch swatch);

/* All rings of S as one path with attributes FILL and STROKE; open lines, which
 * bound nothing, without FILL. */
void il_picture_slice(il_svg_page *page, const il_svg_view *v, const il_slice *s, const char *fill, const char *stroke);

#endif
