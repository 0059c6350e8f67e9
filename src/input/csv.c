/* csv.c - tables of separated values (formats/csv.txt): a geometry a row as WKT, or a
 * point a row. */
#include "config.h"
#include "input/csv.h"
#include "base/alloc.h"
#include "input/map-text.h"

#include <stdio.h>
#include <string.h>

/* ---- columns ------------------------------------------------------------------- */

/* Names of the columns from the cells of C, or as GDAL makes them where no names stand. */
static il_status name_columns(il_csv_table *t, const il_csv *c, bool has_names)
{
    char made[40];
    il_status st = IL_OK;
    for (size_t k = 0; k < c->n && st == IL_OK; k++) {
        if (!has_names)
            snprintf(made, sizeof made, "field_%zu", k + 1);
        st = has_names ? il_map_heads_add(&t->heads, c->cell[k].text, c->cell[k].n, t->err)
                       : il_map_heads_add(&t->heads, made, strlen(made), t->err);
    }
    il_map_heads *h = &t->heads;
    while (has_names && h->n > 1 && h->head[h->n - 1].n == 0)
        il_free(h->head[--h->n].name);
    return st;
}

/* Names that stand in the comment before the record at hand. */
static il_status name_by_comment(il_csv_table *t)
{
    il_source *source = NULL;
    il_csv names;
    bool more;
    il_status st = il_source_from_memory(&source, t->csv.comment, t->csv.n_comment, "", t->err);
    il_csv_init(&names, source, t->csv.separator, t->csv.n_comment);
    if (st == IL_OK)
        st = il_csv_next(&names, &more, t->err);
    if (st == IL_OK)
        st = name_columns(t, &names, true);
    il_csv_free(&names);
    il_source_close(source);
    return st;
}

/* The first column for x and the first for y of a pair, of the most preferred. */
static bool find_axes(il_csv_table *t)
{
    size_t at[IL_CSV_N_PAIRS][2];
    il_csv_axis axis, said[IL_CSV_N_PAIRS][2];
    bool found[IL_CSV_N_PAIRS][2] = { { false } };
    for (size_t k = 0; k < t->heads.n; k++) {
        if (!il_csv_name_axis(t->heads.head[k].name, t->heads.head[k].n, &axis) || found[axis.pair][axis.is_y])
            continue;
        found[axis.pair][axis.is_y] = true;
        at[axis.pair][axis.is_y] = k;
        said[axis.pair][axis.is_y] = axis;
    }
    for (size_t p = 0; p < IL_CSV_N_PAIRS; p++) {
        if (!found[p][0] || !found[p][1])
            continue;
        t->x = at[p][0];
        t->y = at[p][1];
        t->is_degrees = p == IL_CSV_DEGREES;
        t->has_unit = said[p][0].has_unit && said[p][1].has_unit && said[p][0].unit == said[p][1].unit;
        t->unit = said[p][0].unit;
        return true;
    }
    return false;
}

static bool find_named_geometry(il_csv_table *t)
{
    for (size_t k = 0; k < t->heads.n; k++) {
        if (il_csv_name_is_geometry(t->heads.head[k].name, t->heads.head[k].n)) {
            t->geometry = k;
            return true;
        }
    }
    return false;
}

/* ---- what kind of table ----------------------------------------------------------- */

static il_status fail_hex(const il_csv_table *t, size_t column)
{
    const char *name = column < t->heads.n ? t->heads.head[column].name : "";
    return il_fail(t->err, IL_E_INPUT, t->csv.line, "the geometries in column '%.40s' are binary (EWKB in hexadecimals), not text; "
                   "ST_AsText(%.40s) makes WKT of them", name, name);
}

static il_status fail_columns(const il_csv_table *t)
{
    char list[300] = "";
    size_t n = 0, shown = 0;
    for (; shown < t->heads.n && n + 50 < sizeof list; shown++)
        n += (size_t)snprintf(list + n, sizeof list - n, "%s'%.40s'", shown > 0 ? ", " : "", t->heads.head[shown].name);
    return il_fail(t->err, IL_E_INPUT, t->csv.line, "no column holds WKT, and none are called x and y; the columns are %s%s",
                   list, shown < t->heads.n ? ", ..." : "");
}

/* Numbers without names: x, y or x, y, z. */
static il_status take_unnamed(il_csv_table *t)
{
    if (t->heads.n < 2 || t->heads.n > 3)
        return il_fail(t->err, IL_E_INPUT, t->csv.line, "no header names the columns, and there are %zu; without one they are x, y, z",
                       t->heads.n);
    t->x = 0;
    t->y = 1;
    t->z = t->heads.n > 2 ? 2 : IL_CSV_NONE;
    return IL_OK;
}

/* Those that say where points are are known: which of the others matter? */
static il_status take_columns(il_csv_table *t)
{
    const size_t taken[] = { t->geometry, t->x, t->y };
    for (size_t k = 0; k < sizeof taken / sizeof *taken; k++)
        if (taken[k] != IL_CSV_NONE)
            t->heads.head[taken[k]].is_taken = true;
    return il_map_heads_choose(&t->heads, t->set, t->err);
}

/* What the columns are, when the first record, or what stands for it, is at hand. */
static il_status find_roles(il_csv_table *t, const il_csv_guess *g)
{
    bool has_axes = g->header != IL_CSV_NO_HEADER && find_axes(t);
    bool has_wkt = g->geometry != IL_CSV_NONE && g->geometry < t->heads.n;
    if (has_wkt && !(g->only_points && has_axes)) {
        t->geometry = g->geometry;
        t->x = t->y = IL_CSV_NONE;
    }
    if (t->geometry != IL_CSV_NONE || has_axes)
        return take_columns(t);
    if (g->hex != IL_CSV_NONE)
        return fail_hex(t, g->hex);
    if (g->header == IL_CSV_NO_HEADER)
        return take_unnamed(t);
    return find_named_geometry(t) ? take_columns(t) : fail_columns(t);
}

/* ---- reading ------------------------------------------------------------------------- */

il_status il_csv_next_row(il_csv_table *t, bool *more)
{
    for (;;) {
        il_status st = IL_OK;
        if (t->has_row)
            *more = true;
        else
            st = il_csv_next(&t->csv, more, t->err);
        t->has_row = false;
        size_t n = t->csv.n;
        while (n > t->heads.n && t->csv.cell[n - 1].n == 0)
            n--;
        if (st != IL_OK || !*more || n <= t->heads.n)
            return st;
        il_map_skip(t->set, t->csv.line, "row", "has more cells than there are columns");
    }
}

/* The header and what it says; the first row stays for il_csv_next_row when there is none. */
static il_status begin(il_csv_table *t, const il_csv_guess *g)
{
    bool more = true;
    il_status st = il_csv_next(&t->csv, &more, t->err);
    if (st == IL_OK && more && g->says_separator)
        st = il_csv_next(&t->csv, &more, t->err);
    if (st != IL_OK)
        return st;
    if (!more)
        return il_fail(t->err, IL_E_INPUT, 0, "there are no rows in this table");
    t->has_row = g->header != IL_CSV_HEADER;
    if (g->header == IL_CSV_COMMENT && t->csv.comment)
        st = name_by_comment(t);
    else
        st = name_columns(t, &t->csv, g->header == IL_CSV_HEADER);
    return st == IL_OK ? find_roles(t, g) : st;
}

static il_status read_table(il_csv_table *t, const il_csv_guess *g)
{
    il_status st = begin(t, g);
    if (st != IL_OK)
        return st;
    return t->geometry != IL_CSV_NONE ? il_csv_read_geometries(t) : il_csv_read_points(t);
}

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    enum { HEAD = 65536 };
    const unsigned char *head;
    size_t n;
    il_csv_guess g;
    il_csv_table t = { .set = set, .options = options, .err = err, .geometry = IL_CSV_NONE,
                       .x = IL_CSV_NONE, .y = IL_CSV_NONE, .z = IL_CSV_NONE };
    il_status st = il_source_peek(source, HEAD, &head, &n, err);
    if (st == IL_OK)
        st = il_csv_look(head, n, n < HEAD, &g, err);
    if (st != IL_OK)
        return st;
    il_csv_init(&t.csv, source, g.separator, options->max_line);
    st = read_table(&t, &g);
    il_csv_free(&t.csv);
    il_map_heads_free(&t.heads);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_map_read("CSV", parse, source, n, options, sink, report, err);
}

static il_status look(const unsigned char *head, size_t n, bool *is, il_error *err)
{
    il_csv_guess g;
    *is = false;
    if (!il_map_text_is_plain(head, n))
        return IL_OK;
    il_status st = il_csv_look(head, n, n < IL_MAP_TEXT_HEAD, &g, err);
    *is = st == IL_OK && il_csv_guess_is_map(&g) && !il_reader_bln.probe(head, n);
    return st;
}

static bool probe(const unsigned char *head, size_t n)
{
    bool is;
    return look(head, n, &is, NULL) == IL_OK && is;
}

const il_reader il_reader_csv = {
    .name = "csv",
    .extensions = "csv tsv wkt txt",
    .words = "isolines as separated values: WKT, or x, y and height",
    .is_map = true,
    .probe = probe,
    .look = look,
    .read = read_all,
};
