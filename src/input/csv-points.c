/* csv-points.c - tables with a point a row, which lines are made of (map-rows.h). */
#include "config.h"
#include "input/csv.h"
#include "base/alloc.h"
#include "input/map-heights.h"
#include "input/map-names.h"
#include "input/map-rows.h"

#include <math.h>
#include <string.h>

/* The value of a column that may number lines, in the row before. */
typedef struct number {
    size_t column;
    char *text;
    size_t n, cap;
} number;

/* height: the column with the heights; IL_CSV_NONE when there is none.  has_value: of
 * the row before, so is value.  mark: the decimal mark, 0 while unknown. */
typedef struct points {
    il_csv_table *table;
    il_map_rows rows;
    il_map_rows_names names;
    number number[IL_MAP_ROWS_COLUMNS];
    size_t n_numbers, height;
    il_map_value value;
    char mark;
    bool has_value;
} points;

/* ---- columns --------------------------------------------------------------------- */

/* Of the columns that may be heights the one with the usual name of the lowest rank; the
 * two of a band only where there is no other. */
static size_t find_height(const il_csv_table *t)
{
    enum { BAND = 1000 };
    size_t best = IL_CSV_NONE;
    int best_rank = 0;
    for (size_t k = 0; k < t->heads.n_wanted; k++) {
        il_map_name name;
        const il_map_head *c = &t->heads.head[t->heads.wanted[k]];
        bool is_usual = il_map_name_read(c->name, c->n, &name);
        int rank = !is_usual ? 0 : name.rank + (name.end == IL_MAP_END_NONE ? 0 : BAND);
        if (best == IL_CSV_NONE || rank < best_rank) {
            best = t->heads.wanted[k];
            best_rank = rank;
        }
    }
    return best;
}

static void find_columns(points *p)
{
    const il_csv_table *t = p->table;
    p->height = t->z == IL_CSV_NONE ? find_height(t) : t->z;
    if (p->height != IL_CSV_NONE && t->z == IL_CSV_NONE) {
        p->names.height = t->heads.head[p->height].name;
        p->names.n_height = t->heads.head[p->height].n;
    }
    for (size_t k = 0; k < t->heads.n && p->n_numbers < IL_MAP_ROWS_COLUMNS && t->z == IL_CSV_NONE; k++) {
        const il_map_head *c = &t->heads.head[k];
        if (k == t->x || k == t->y || k == p->height || !il_csv_name_numbers_lines(c->name, c->n))
            continue;
        p->names.column[p->n_numbers] = c->name;
        p->names.n_column[p->n_numbers] = c->n;
        p->number[p->n_numbers++].column = k;
    }
    p->names.n_columns = p->n_numbers;
}

/* ---- rows -------------------------------------------------------------------------- */

/* Which columns that may number lines have another value than before? */
static il_status compare_numbers(points *p, unsigned *news)
{
    for (size_t k = 0; k < p->n_numbers; k++) {
        number *m = &p->number[k];
        il_csv_cell c = il_csv_cell_of(p->table, m->column);
        if (m->n == c.n && (c.n == 0 || memcmp(m->text, c.text, c.n) == 0))
            continue;
        if (!il_grow(&m->text, &m->cap, c.n, 1))
            return il_fail_nomem(p->table->err);
        if (c.n > 0)
            memcpy(m->text, c.text, c.n);
        m->n = c.n;
        *news |= (unsigned)IL_MAP_ROWS_COLUMN << k;
    }
    return IL_OK;
}

static bool take_coordinate(points *p, size_t column, double *value)
{
    il_csv_cell c = il_csv_cell_of(p->table, column);
    return il_csv_number(c.text, c.n, &p->mark, value);
}

/* The height of the row: mostly that of the row before, in the same words. */
static bool take_height(points *p, const il_csv_cell *c, unsigned *news)
{
    il_map_value before = p->value;
    if (p->height == IL_CSV_NONE || (p->has_value && il_map_rows_same(&p->rows, c->text, c->n)))
        return true;
    if (!il_map_heights_value(p->table->options, c->text, c->n, &p->value)) {
        p->value = before;
        return false;
    }
    if (p->has_value && (before.has_unit != p->value.has_unit || before.unit != p->value.unit))
        *news |= IL_MAP_ROWS_HEIGHT;
    p->has_value = true;
    return true;
}

static il_status take_row(points *p)
{
    const il_csv_table *t = p->table;
    double x, y;
    unsigned news = 0;
    if (!take_coordinate(p, t->x, &x) || !take_coordinate(p, t->y, &y)) {
        il_map_skip(t->set, t->csv.line, "row", "x or y is no number");
        return IL_OK;
    }
    il_csv_cell height = il_csv_cell_of(t, p->height);
    if (!take_height(p, &height, &news)) {
        il_map_skip(t->set, t->csv.line, "row", "the height is no number");
        return IL_OK;
    }
    il_status st = compare_numbers(p, &news);
    double z = p->height == IL_CSV_NONE ? NAN : p->value.number;
    return st == IL_OK ? il_map_rows_add(&p->rows, x, y, z, height.text, height.n, news, t->csv.line, t->err) : st;
}

/* ---- the table ----------------------------------------------------------------------- */

/* Which columns were read, as the reader was not told. */
static void tell_columns(const points *p)
{
    const il_csv_table *t = p->table;
    bool has_height = p->height != IL_CSV_NONE;
    il_report_note(il_map_report(t->set), "%.200s: x is '%.40s', y is '%.40s'%s%.40s%s%s", il_map_file(t->set),
                   t->heads.head[t->x].name, t->heads.head[t->y].name, has_height ? " and the height '" : "",
                   has_height ? t->heads.head[p->height].name : "", has_height ? "'" : "",
                   p->mark == ',' ? "; numbers have decimal commas" : "");
}

/* The names of all columns in a feature without lines. */
static il_status tell_names(il_csv_table *t)
{
    il_status st = il_map_begin_feature(t->set, t->csv.line, t->err);
    if (st == IL_OK && t->z == IL_CSV_NONE)
        st = il_map_heads_tell(&t->heads, t->set, t->err);
    return st == IL_OK ? il_map_end_feature(t->set, t->err) : st;
}

static void free_points(points *p)
{
    il_map_rows_free(&p->rows);
    for (size_t k = 0; k < p->n_numbers; k++)
        il_free(p->number[k].text);
}

il_status il_csv_read_points(il_csv_table *t)
{
    points p = { .table = t, .mark = t->csv.separator == ',' ? '.' : 0 };
    bool more;
    il_status st = IL_OK;
    il_map_rows_init(&p.rows, t->options);
    find_columns(&p);
    if (t->is_degrees)
        il_map_degrees(t->set);
    else if (t->has_unit)
        st = il_map_unit(t->set, t->unit, t->csv.line, t->err);
    while (st == IL_OK && (st = il_csv_next_row(t, &more)) == IL_OK && more)
        if ((st = take_row(&p)) != IL_OK)
            break;
    if (st == IL_OK)
        st = tell_names(t);
    if (st == IL_OK)
        st = il_map_rows_emit(&p.rows, &p.names, t->set, t->err);
    if (st == IL_OK)
        tell_columns(&p);
    free_points(&p);
    return st;
}
