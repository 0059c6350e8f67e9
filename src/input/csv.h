/* csv.h - what the parts of the reader of tables share. */
#ifndef IL_INPUT_CSV_H
#define IL_INPUT_CSV_H

#include "input/csv-guess.h"
#include "input/csv-names.h"
#include "input/csv-record.h"
#include "input/map-heads.h"

/* heads: of its columns.  geometry: the index of that with WKT; x, y, z: of those with
 * numbers; IL_CSV_NONE for none.  is_degrees, has_unit, unit: of x and y, by their names.
 * has_row: the first row was taken from csv already. */
typedef struct il_csv_table {
    il_csv csv;
    il_map_set *set;
    const il_read_options *options;
    il_map_heads heads;
    size_t geometry, x, y, z;
    bool is_degrees, has_unit, has_row;
    il_unit unit;
    il_error *err;
} il_csv_table;

/* The next row into t->csv; *MORE is false at the end.  It may have fewer cells than there
 * are columns; rows that have more are counted and passed over. */
il_status il_csv_next_row(il_csv_table *t, bool *more);

/* The cell of the row at hand in COLUMN; one that is not there is empty. */
static inline il_csv_cell il_csv_cell_of(const il_csv_table *t, size_t column)
{
    return column < t->csv.n ? t->csv.cell[column] : (il_csv_cell){ "", 0, 0, t->csv.line };
}

/* Read all rows: csv-geometries.c, csv-points.c. */
il_status il_csv_read_geometries(il_csv_table *t);
il_status il_csv_read_points(il_csv_table *t);

#endif
