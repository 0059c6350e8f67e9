/* csv-guess.h - how the first bytes of a table look: what separates cells, whether
 * there is a header, which column holds geometries. */
#ifndef IL_INPUT_CSV_GUESS_H
#define IL_INPUT_CSV_GUESS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define IL_CSV_NONE SIZE_MAX

/* separator: as csv-record.h has it.  says_separator: the first line is Excel's
 * "sep=;".  n_columns: what most records have.
 * header: where the names of columns stand: in the first record, in a comment before it.
 * geometry, hex: the columns that hold well-known text, and binary in hexadecimals;
 * IL_CSV_NONE for none.  only_points: the texts are of points only.
 * names_xy, names_geometry: so does the header.  numbers: every cell is a number; commas:
 * some have a comma for their point.
 * marks: a row begins with >, as GMT marks segments. */
typedef struct il_csv_guess {
    char separator;
    bool says_separator;
    size_t n_columns, n_records;
    enum { IL_CSV_NO_HEADER, IL_CSV_HEADER, IL_CSV_COMMENT } header;
    size_t geometry, hex;
    bool only_points, names_xy, names_geometry, numbers, commas, marks;
} il_csv_guess;

/* Look at HEAD[0..N); is_whole: it is all of the file.  Of the separators that which cuts
 * most records into as many cells, two or more, is taken; of several the first of tab,
 * semicolon, bar, comma, blanks.  IL_E_NOMEM. */
il_status il_csv_look(const void *head, size_t n, bool is_whole, il_csv_guess *out, il_error *err);

/* Can a table that looks like this be one of isolines? */
bool il_csv_guess_is_map(const il_csv_guess *g);

/* A number as tables have it: MARK is its decimal mark, '.' or ',', or 0 while it is not
 * known, and is set by the first number that has one.  False when it is anything else. */
bool il_csv_number(const char *text, size_t n, char *mark, double *value);

#endif
