/* csv-record.h - records of separated values (RFC 4180), and what else is called CSV.
 *
 * More lenient than the RFC where files in use need it: other separators; blanks
 * around cells and quotes; lines that end in LF.  A geometry (wkt.h) that is not
 * quoted is one cell up to its last bracket, whatever is inside.  A cell in quotes and
 * a geometry may go over several lines.  Empty lines and lines that begin with # are
 * passed over. */
#ifndef IL_INPUT_CSV_RECORD_H
#define IL_INPUT_CSV_RECORD_H

#include "input/reader.h"

/* text[0..n): without quotes and blanks around it.  line: where it begins.  begin: its
 * place in the record, which may move until it is whole. */
typedef struct il_csv_cell {
    const char *text;
    size_t n, begin;
    long line;
} il_csv_cell;

/* separator: ' ' for blanks and tabs, as many as there are; '\n' when a record is one
 * cell.
 * Of the record last given: cell[0..n), good until the next call; line: its first.
 * comment[0..n_comment): the comment line right before it, without its #. */
typedef struct il_csv {
    char separator;
    il_csv_cell *cell;
    size_t n;
    long line;
    const char *comment;
    size_t n_comment;
    bool is_cut;                /* the input ended inside of a cell */

    /* The reader's own. */
    il_lines lines;
    bool takes_cut;             /* this is no failure, but is_cut */
    size_t cap_cells;
    const char *text;           /* the record */
    size_t n_text, n_lines;
    char *buf;                  size_t cap_buf;
    char *kept;                 size_t cap_kept;
} il_csv;

/* SOURCE is borrowed.  takes_cut may be set next. */
void il_csv_init(il_csv *c, il_source *source, char separator, size_t max_line);
void il_csv_free(il_csv *c);

/* The next record; *MORE is false at the end.  IL_E_INPUT: quotes or brackets that do
 * not end, or text behind quotes; a record beyond the limit of a line. */
il_status il_csv_next(il_csv *c, bool *more, il_error *err);

#endif
