/* grid.h - a table of aligned columns for people. */
#ifndef IL_CLI_GRID_H
#define IL_CLI_GRID_H

#include "base/output.h"

#include <stdbool.h>
#include <stddef.h>

/* Columns that the UTF-8 text S takes on a terminal: two for the wide letters of
 * East Asia and for pictures, none for marks that stand over another letter. */
size_t il_text_columns(const char *s);

/* cell[n]: row by row, each with `columns` cells; owned, printable. */
typedef struct il_grid {
    size_t columns;
    char **cell;
    size_t n, cap;
} il_grid;

/* Append TEXT, made printable, and where MOST is not 0 and it takes more columns
 * than that, cut with "..." at its end.  False when there is no memory. */
bool il_grid_add(il_grid *g, const char *text, size_t most);
void il_grid_free(il_grid *g);

/* All rows to OUT, a line each; two blanks part the columns, those K for which
 * RIGHT[K] is '1' end on one line.  RIGHT has a character for each column. */
void il_grid_write(const il_grid *g, const char *right, il_output *out);

#endif
