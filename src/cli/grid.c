#include "config.h"
#include "cli/grid.h"
#include "base/alloc.h"
#include "base/text.h"

#include <string.h>

enum { GAP = 2 };

/* Ranges of Unicode: those of East Asian Width W and F in outline, and the marks
 * that names are likely to have (decomposed letters, joiners, variations). */
static size_t columns_of(unsigned long c)
{
    static const struct { unsigned long first, last; size_t columns; } ranges[] = {
        { 0x0300, 0x036F, 0 }, { 0x1100, 0x115F, 2 }, { 0x1AB0, 0x1AFF, 0 }, { 0x1DC0, 0x1DFF, 0 },
        { 0x200B, 0x200D, 0 }, { 0x20D0, 0x20FF, 0 }, { 0x2E80, 0x303E, 2 }, { 0x3041, 0xA4CF, 2 },
        { 0xA960, 0xA97F, 2 }, { 0xAC00, 0xD7A3, 2 }, { 0xF900, 0xFAFF, 2 }, { 0xFE00, 0xFE0F, 0 },
        { 0xFE30, 0xFE6F, 2 }, { 0xFF01, 0xFF60, 2 }, { 0xFFE0, 0xFFE6, 2 }, { 0x1F300, 0x1FAFF, 2 },
        { 0x20000, 0x3FFFD, 2 } };
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges && c >= ranges[k].first; k++)
        if (c <= ranges[k].last)
            return ranges[k].columns;
    return 1;
}

/* The bytes of S that take at most MOST columns; *COLUMNS are those they take. */
static size_t fitting(const char *s, size_t n, size_t most, size_t *columns)
{
    size_t i = 0;
    *columns = 0;
    while (i < n) {
        unsigned long code = 0;
        size_t length = il_utf8_char(s + i, n - i, &code), wide = length > 0 ? columns_of(code) : 1;
        if (*columns + wide > most)
            break;
        *columns += wide;
        i += length > 0 ? length : 1;
    }
    return i;
}

size_t il_text_columns(const char *s)
{
    size_t columns;
    fitting(s, strlen(s), (size_t)-1, &columns);
    return columns;
}

bool il_grid_add(il_grid *g, const char *text, size_t most)
{
    size_t n = strlen(text), columns;
    if (n > (size_t)-1 / 4 - 4 || !il_grow(&g->cell, &g->cap, g->n + 1, sizeof *g->cell))
        return false;
    char *to = il_alloc(4 * n + 4, 1);
    if (!to)
        return false;
    n = il_text_printable(to, 4 * n + 1, text, n);
    if (most > 3 && il_text_columns(to) > most) {
        n = fitting(to, n, most - 3, &columns);
        memcpy(to + n, "...", 4);
    }
    g->cell[g->n++] = to;
    return true;
}

void il_grid_free(il_grid *g)
{
    for (size_t i = 0; i < g->n; i++)
        il_free(g->cell[i]);
    il_free(g->cell);
    g->cell = NULL;
    g->n = g->cap = 0;
}

static void put_blanks(il_output *out, size_t n)
{
    for (; n > 0; n--)
        il_output_char(out, ' ');
}

static size_t widest(const il_grid *g, size_t column)
{
    size_t most = 0;
    for (size_t i = column; i < g->n; i += g->columns) {
        size_t columns = il_text_columns(g->cell[i]);
        most = columns > most ? columns : most;
    }
    return most;
}

void il_grid_write(const il_grid *g, const char *right, il_output *out)
{
    enum { MOST = 16 };
    size_t width[MOST];
    size_t n = g->columns < MOST ? g->columns : MOST;
    for (size_t k = 0; k < n; k++)
        width[k] = widest(g, k);
    for (size_t row = 0; row < g->n; row += g->columns) {
        size_t owed = 0; /* blanks that a next text has before it; none at the end of a line */
        for (size_t k = 0; k < n; k++) {
            const char *text = g->cell[row + k];
            size_t blanks = width[k] - il_text_columns(text);
            if (*text)
                put_blanks(out, owed + (right[k] == '1' ? blanks : 0));
            il_output_string(out, text);
            owed = (*text ? 0 : owed + width[k]) + (*text && right[k] != '1' ? blanks : 0) + GAP;
        }
        il_output_char(out, '\n');
    }
}
