/* shp-table.c - the attributes of a shapefile: a dBASE table, a row a record. */
#include "config.h"
#include "base/alloc.h"
#include "input/shp.h"

#include <string.h>

enum { TABLE_HEADER = 32, FIELD = 32, LAST_FIELD = 0x0D };

/* ---- what the header says --------------------------------------------------------- */

static uint32_t little_16(const unsigned char *p)
{
    return (uint32_t)p[1] << 8 | p[0];
}

static il_status fail(const il_shp_bytes *f, il_error *err, const char *what)
{
    il_status st = il_fail(err, IL_E_INPUT, 0, "the table %s", what);
    il_error_set_file(err, f->name);
    return st;
}

/* Rows lie inside the file, and fields inside rows: shapelib looks where the header
 * says.  The first byte of a row is the mark of deletion. */
static il_status check_table(const il_shp_bytes *f, size_t *n_rows, il_error *err)
{
    const unsigned char *p = f->data;
    if (f->n < TABLE_HEADER)
        return fail(f, err, "is cut short: its header is not whole");
    uint64_t rows = il_shp_little(p + 4), header = little_16(p + 8), row = little_16(p + 10), used = 1;
    if (header < TABLE_HEADER + 1 || header > f->n || row < 1)
        return fail(f, err, "has a header that is none");
    for (size_t at = TABLE_HEADER; at + FIELD <= header && p[at] != LAST_FIELD; at += FIELD)
        used += p[at + 16];
    if (used > row)
        return fail(f, err, "has fields that are wider than its rows");
    if (rows > INT32_MAX || rows * row > f->n - header)
        return fail(f, err, "is cut short: it has fewer rows than its header says");
    *n_rows = (size_t)rows;
    return IL_OK;
}

/* ---- opening ------------------------------------------------------------------------- */

/* The .cpg says more than the byte in the table; both may say nothing. */
static void find_page(il_shp_table *t, const il_shp_files *f, il_map_set *set)
{
    const il_shp_bytes *cpg = &f->cpg;
    size_t n = 0;
    while (cpg->data && n < cpg->n && n < 60 && cpg->data[n] > ' ')
        n++;
    if (n > 0 && il_codepage_set(&t->page, (const char *)cpg->data, n))
        return;
    if (n > 0)
        il_report_note(il_map_report(set), "the code page '%.*s' of the .cpg is not known", (int)n, (const char *)cpg->data);
    il_codepage_set_dbase(&t->page, f->dbf.data[29]);
}

static il_status add_field(il_shp_table *t, int k, il_map_set *set, il_error *err)
{
    char name[12];
    il_shp_field *to = &t->field[t->n_fields];
    DBFGetFieldInfo(t->dbf, k, name, NULL, NULL);
    il_status st = il_codepage_text(&t->page, name, strlen(name), &to->name, &to->n_name, err);
    if (st != IL_OK)
        return st;
    to->is_text = strchr("CNFDL", DBFGetNativeFieldType(t->dbf, k)) != NULL;
    to->is_wanted = to->is_text && il_map_wants(set, to->name, to->n_name);
    t->n_fields++;
    return IL_OK;
}

il_status il_shp_table_open(il_shp_table *t, const il_shp_files *f, il_shp_memory *m, il_map_set *set, il_error *err)
{
    *t = (il_shp_table){ .page = IL_CODEPAGE_INIT };
    if (!f->dbf.data)
        return IL_OK;
    il_status st = check_table(&f->dbf, &t->n_rows, err);
    if (st != IL_OK)
        return st;
    t->dbf = il_shp_open_table(m);
    if (!t->dbf)
        return fail(&f->dbf, err, "is none that can be read");
    find_page(t, f, set);
    int n = DBFGetFieldCount(t->dbf);
    t->field = il_calloc((size_t)n, sizeof *t->field);
    st = t->field ? IL_OK : il_fail_nomem(err);
    for (int k = 0; k < n && st == IL_OK; k++)
        st = add_field(t, k, set, err);
    return st;
}

void il_shp_table_close(il_shp_table *t)
{
    for (size_t k = 0; k < t->n_fields; k++)
        il_free(t->field[k].name);
    il_free(t->field);
    il_codepage_free(&t->page);
    if (t->dbf)
        DBFClose(t->dbf);
    *t = (il_shp_table){ .page = IL_CODEPAGE_INIT };
}

/* ---- rows ------------------------------------------------------------------------------ */

bool il_shp_row_is_deleted(il_shp_table *t, size_t row)
{
    return t->dbf && DBFIsRecordDeleted(t->dbf, (int)row);
}

static bool is_ascii(const char *s)
{
    while (*s > 0)
        s++;
    return *s == '\0';
}

/* Asterisks are for numbers that were too long for their field. */
static bool is_overflow(const char *s)
{
    return *s == '*' && s[strspn(s, "*")] == '\0';
}

static il_status tell_value(il_shp_table *t, size_t row, size_t k, il_map_set *set, il_error *err)
{
    const il_shp_field *f = &t->field[k];
    bool is_null = DBFIsAttributeNULL(t->dbf, (int)row, (int)k);
    const char *value = is_null ? NULL : DBFReadStringAttribute(t->dbf, (int)row, (int)k);
    if (!value || !*value || is_overflow(value))
        return il_map_attribute(set, f->name, f->n_name, NULL, 0, err);
    if (is_ascii(value))
        return il_map_attribute(set, f->name, f->n_name, value, strlen(value), err);
    char *text = NULL;
    size_t n = 0;
    il_status st = il_codepage_text(&t->page, value, strlen(value), &text, &n, err);
    if (st == IL_OK)
        st = il_map_attribute(set, f->name, f->n_name, text, n, err);
    il_free(text);
    return st;
}

/* Names of fields that are not wanted are told once, for the refusal that lists them. */
il_status il_shp_tell_row(il_shp_table *t, size_t row, il_map_set *set, il_error *err)
{
    il_status st = IL_OK;
    for (size_t k = 0; k < t->n_fields && st == IL_OK; k++) {
        if (t->field[k].is_wanted)
            st = tell_value(t, row, k, set, err);
        else if (!t->has_told)
            st = il_map_attribute(set, t->field[k].name, t->field[k].n_name, NULL, 0, err);
    }
    t->has_told = true;
    return st;
}
