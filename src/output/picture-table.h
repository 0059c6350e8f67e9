/* picture-table.h - how the deformation of each group came out, in a table. */
#ifndef IL_OUTPUT_PICTURE_TABLE_H
#define IL_OUTPUT_PICTURE_TABLE_H

#include "output/picture-parts.h"

/* A row for each fitted group of P, as far as a page likes, from page->y on,
 * which moves, and how many groups are on one side only. */
void il_picture_fit_table(il_svg_page *page, const il_pair *p, il_unit unit);

#endif
