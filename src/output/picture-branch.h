/* picture-branch.h - how regions go over into each other: in what pieces, and why. */
#ifndef IL_OUTPUT_PICTURE_BRANCH_H
#define IL_OUTPUT_PICTURE_BRANCH_H

#include "output/skeleton.h"

/* Tints for the pieces into which S, the upper or lower slice of P, is cut.  IL_E_NOMEM. */
il_status il_picture_pieces(il_svg_page *page, const il_svg_view *v, const il_slice *s, const il_pair *p, bool upper, il_error *err);
/* The cuts of both slices of P, WIDTH pixels wide. */
void il_picture_cuts(il_svg_page *page, const il_svg_view *v, const il_pair *p, double width);

/* S, the skeleton of a pair, seen from above: of each link a line, but for regions that overlap
 * each other and nothing else.  How many lines. */
size_t il_picture_links(il_svg_page *page, const il_svg_view *v, const il_skeleton *s);
/* Words on links that reach over gaps, HEIGHT being that of the slab, and on openings. */
void il_picture_tell_links(il_label *l, const il_pair *p, double height, il_unit unit);

/* The attributes of a legend's lines and boxes. */
extern const char il_cut_attributes[], il_piece_attributes[];

#endif
