/* picture-tiles.h - small drawings in rows, all of one size and scale. */
#ifndef IL_OUTPUT_PICTURE_TILES_H
#define IL_OUTPUT_PICTURE_TILES_H

#include "output/picture-parts.h"

/* n drawings, columns of them in a row; lines of words under each.  scale:
 * pixels a unit.  width, height: of a drawing. */
typedef struct il_tiles {
    size_t n, columns;
    int lines;
    double width, height, scale;
} il_tiles;

/* For N > 0 windows of that width and height in the stack's unit, with LINES of
 * words of at most CAPTION pixels. */
il_tiles il_tiles_arrange(size_t n, double width, double height, int lines, double caption);
/* The panel of drawing K, with page->y at the top of all. */
il_panel il_tiles_panel(const il_tiles *t, const il_svg_page *page, size_t k);
/* Move page->y below them. */
void il_tiles_end(const il_tiles *t, il_svg_page *page);

/* NUMBER and WORDS under a drawing, MORE on a second line unless null; and how
 * wide that is, about. */
void il_picture_tile_caption(il_svg_page *page, const il_panel *at, size_t number, const char *words, const char *more);
double il_picture_caption_width(size_t number, const char *words, const char *more);

#endif
