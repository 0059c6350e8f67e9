/* picture-bonds.h - what links of each kind look like, and what they are called. */
#ifndef IL_OUTPUT_PICTURE_BONDS_H
#define IL_OUTPUT_PICTURE_BONDS_H

#include "output/skeleton.h"

/* What is a guess has this colour whatever it joins. */
#define IL_GUESS_COLOR "#d00000"

/* Attributes of lines of BOND that are COLOR otherwise, and WIDTH wide. */
il_label il_bond_attributes(il_bond bond, const char *color, double width);
/* An entry in the colour of ink for each kind that S has, with how many. */
void il_legend_add_bonds(il_legend *l, const il_skeleton *s, double width);

#endif
