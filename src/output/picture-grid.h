/* picture-grid.h - a grid of the upper plane, carried through phi. */
#ifndef IL_OUTPUT_PICTURE_GRID_H
#define IL_OUTPUT_PICTURE_GRID_H

#include "output/picture-parts.h"

/* Of so many fitted groups so many have a grid; whole: under phi, with so many
 * lattice steps in all.  The others show the global step alone, dotted, because
 * the record has not all of their lattices.  divided: groups beside those whose regions are
 * cut, each piece with a phi of its own, which no one grid can show. */
typedef struct il_grid_facts {
    size_t groups, drawn, whole, steps, divided;
} il_grid_facts;

/* For each fitted group of P a grid round its rings in UPPER. */
il_status il_picture_grid(il_svg_page *page, const il_svg_view *v, const il_slice *upper, const il_pair *p,
                          il_grid_facts *facts, il_error *err);

#endif
