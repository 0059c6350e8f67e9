/* map-rows.h - rows x, y, z that nothing divides into lines, as tables have them.
 *
 * A line ends
 *     where the file says so (IL_MAP_ROWS_BREAK),
 *     where a column changes that numbers lines,
 * and, when no column numbers lines,
 *     where the height changes,
 *     where it is back at its first point,
 *     at a gap: a step longer than 10 times the median and 5 times the ninth decile of
 *     all steps that are not 0 between rows of one height, if there are 20 or more.
 * The bounds are those of steps that are spread as 2^-t, t in medians: of these one in
 * 100000 is taken for a gap, and where all steps are much alike 10 of them are one.
 * A column numbers lines when it changes, but at no more than half of the rows; else it
 * says nothing (1 in all rows) or numbers the rows.
 *
 * Rows are held until the end, as the median is known only then: 16 bytes a row, and
 * 40 where something changes. */
#ifndef IL_INPUT_MAP_ROWS_H
#define IL_INPUT_MAP_ROWS_H

#include "input/map-set.h"

#include <stdint.h>

/* What is new in a row, against the row before: bits.  HEIGHT: what z does not tell, its
 * unit.  COLUMN << k: the value of the k-th column that may number lines, k below
 * IL_MAP_ROWS_COLUMNS. */
enum { IL_MAP_ROWS_COLUMNS = 8 };
enum { IL_MAP_ROWS_BREAK = 1, IL_MAP_ROWS_HEIGHT = 2, IL_MAP_ROWS_COLUMN = 4 };

/* Rows from begin on, in which only x and y change, in lines of the file that follow
 * one another.  text, n_text: the height as it is written, in the pool. */
typedef struct il_map_run {
    size_t begin, text;
    long line;
    double z;
    uint32_t n_text, news;
} il_map_run;

typedef struct il_map_rows {
    double *xy;         size_t n, cap;
    il_map_run *run;    size_t n_runs, cap_runs;
    char *pool;         size_t n_pool, cap_pool;
    long line;                  /* of the last row */
    size_t most;                /* rows */
} il_map_rows;

void il_map_rows_init(il_map_rows *r, const il_read_options *options);
void il_map_rows_free(il_map_rows *r);

/* Add a row of height Z, NAN for none, which TEXT[0..N) says; null where nothing but
 * the number matters.  IL_E_INPUT: more rows than points are allowed. */
il_status il_map_rows_add(il_map_rows *r, double x, double y, double z, const char *text, size_t n,
                          unsigned news, long line, il_error *err);

/* Is TEXT[0..N) the height of the last row, as it is written? */
bool il_map_rows_same(const il_map_rows *r, const char *text, size_t n);

/* What the columns are called, for what is told: that of the height, null when z is
 * it, and those that may number lines, column[k] of n_column[k] bytes. */
typedef struct il_map_rows_names {
    const char *height;         size_t n_height;
    const char *column[IL_MAP_ROWS_COLUMNS];
    size_t n_column[IL_MAP_ROWS_COLUMNS], n_columns;
} il_map_rows_names;

/* Give the lines to SET, a feature each, and tell how they were found.  IL_E_INPUT: no
 * column numbers lines, and the height changes at more than half of the rows. */
il_status il_map_rows_emit(const il_map_rows *r, const il_map_rows_names *names, il_map_set *set, il_error *err);

/* Give all rows as one line. */
il_status il_map_rows_emit_one(const il_map_rows *r, il_map_set *set, il_error *err);

#endif
