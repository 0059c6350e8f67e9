#include "config.h"
#include "output/picture-bonds.h"

static const struct { const char *dashes, *words; } bonds[IL_N_BONDS] = {
    [IL_BOND_OVERLAP] = { "", "overlap: " },
    [IL_BOND_NEAR] = { " stroke-dasharray=\"6 2\"", "close to each other: " },
    [IL_BOND_JOIN] = { " stroke-dasharray=\"4 3\"", "joined over a gap: " },
    [IL_BOND_GUESS] = { " stroke-dasharray=\"4 3\"", "guessed, gap > height: " },
    [IL_BOND_GIVEN] = { " stroke-dasharray=\"7 2.5 1.5 2.5\"", "given by the user: " },
    [IL_BOND_GROUP] = { " stroke-dasharray=\"1 3\"", "in one group: " },
};

il_label il_bond_attributes(il_bond bond, const char *color, double width)
{
    il_label l = IL_LABEL_INIT;
    il_label_words(&l, "stroke=\"");
    il_label_words(&l, bond == IL_BOND_GUESS ? IL_GUESS_COLOR : color);
    il_label_words(&l, "\" stroke-linecap=\"butt\" stroke-width=\"");
    il_label_number(&l, width, 2);
    il_label_words(&l, "\"");
    il_label_words(&l, bonds[bond].dashes);
    return l;
}

void il_legend_add_bonds(il_legend *l, const il_skeleton *s, double width)
{
    for (int k = 0; k < IL_N_BONDS; k++) {
        if (s->bonds[k] == 0)
            continue;
        il_label attributes = il_bond_attributes((il_bond)k, IL_INK, width);
        il_label *words = il_legend_add(l, attributes.text, IL_SWATCH_LINE);
        il_label_words(words, bonds[k].words);
        il_label_counted(words, s->bonds[k], "link");
    }
}
