/* csv-geometries.c - tables with a geometry a row: each is a feature, and the other
 * columns are its attributes. */
#include "config.h"
#include "input/csv.h"
#include "base/text.h"
#include "input/wkt.h"

static il_status tell_values(il_csv_table *t)
{
    il_status st = IL_OK;
    for (size_t k = 0; k < t->heads.n_wanted && st == IL_OK; k++) {
        const il_map_head *h = &t->heads.head[t->heads.wanted[k]];
        il_csv_cell cell = il_csv_cell_of(t, t->heads.wanted[k]);
        st = il_map_attribute(t->set, h->name, h->n, cell.n > 0 ? cell.text : NULL, cell.n, t->err);
    }
    return st;
}

/* No geometry, in the words of databases. */
static bool is_null(const il_csv_cell *c)
{
    static const char *const words[] = { "", "NULL", "\\N", "None", "NaN", "NA" };
    for (size_t k = 0; k < sizeof words / sizeof *words; k++)
        if (il_text_is_word(c->text, c->n, words[k]))
            return true;
    return false;
}

static il_status read_geometry(il_csv_table *t)
{
    il_csv_cell cell = il_csv_cell_of(t, t->geometry);
    if (is_null(&cell)) {
        il_map_skip(t->set, cell.line, "row", "has no geometry");
        return IL_OK;
    }
    return il_wkt_read(t->set, cell.text, cell.n, cell.line, t->options->max_depth, t->err);
}

il_status il_csv_read_geometries(il_csv_table *t)
{
    bool more, is_first = true;
    il_status st;
    while ((st = il_csv_next_row(t, &more)) == IL_OK && more) {
        st = il_map_begin_feature(t->set, t->csv.line, t->err);
        if (st == IL_OK && is_first)
            st = il_map_heads_tell(&t->heads, t->set, t->err);
        if (st == IL_OK)
            st = tell_values(t);
        if (st == IL_OK)
            st = read_geometry(t);
        if (st == IL_OK)
            st = il_map_end_feature(t->set, t->err);
        if (st != IL_OK)
            break;
        is_first = false;
    }
    return st;
}
