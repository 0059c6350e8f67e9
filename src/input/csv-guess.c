#include "config.h"
#include "input/csv-guess.h"
#include "base/number.h"
#include "input/csv-names.h"
#include "input/csv-record.h"
#include "input/wkt.h"

#include <string.h>
#include <strings.h>

enum { RECORDS_MOST = 50, LINE_MOST = 1 << 20 };

bool il_csv_number(const char *text, size_t n, char *mark, double *value)
{
    enum { LONGEST = 64 };
    char copy[LONGEST];
    size_t used = *mark == ',' ? 0 : il_number_parse(text, n, value);
    if (used == n && n > 0) {
        if (*mark == 0 && memchr(text, '.', n))
            *mark = '.';
        return true;
    }
    if (*mark == '.' || n == 0 || n > sizeof copy || memchr(text, '.', n))
        return false;
    memcpy(copy, text, n);
    char *comma = memchr(copy, ',', n);
    if (comma)
        *comma = '.';
    bool is_number = il_number_parse(copy, n, value) == n;
    if (is_number && comma)
        *mark = ',';
    return is_number;
}

/* ---- separators --------------------------------------------------------------- */

/* The first records of a text. */
typedef struct sample {
    il_source *source;
    il_csv csv;
    size_t n;
    bool is_whole;              /* so is the last record */
} sample;

static il_status open_sample(sample *s, const void *head, size_t n, bool is_whole, char separator, il_error *err)
{
    *s = (sample){ .is_whole = is_whole };
    il_status st = il_source_from_memory(&s->source, head, n, "", err);
    il_csv_init(&s->csv, s->source, separator, LINE_MOST);
    s->csv.takes_cut = true;
    return st;
}

static void close_sample(sample *s)
{
    il_csv_free(&s->csv);
    il_source_close(s->source);
}

/* The next record; what is no such table has none.  A last line that may be cut is one
 * only when it is the first as well, or cut inside of a cell that shows what it is. */
static bool next_of_sample(sample *s, il_status *st)
{
    bool more;
    il_error ignored = IL_ERROR_INIT;
    *st = s->n < RECORDS_MOST ? il_csv_next(&s->csv, &more, &ignored) : IL_OK;
    if (*st != IL_OK || s->n >= RECORDS_MOST || !more)
        return false;
    bool ends_here = s->csv.lines.at_end && s->csv.lines.begin == s->csv.lines.end;
    return s->n++ == 0 || s->is_whole || s->csv.is_cut || !ends_here;
}

/* How many of *N records have as many cells as most of them, *MODE. */
static size_t count_agreeing(const size_t *count, size_t n, size_t *mode)
{
    size_t best = 0;
    for (size_t i = 0; i < n; i++) {
        size_t same = 0;
        for (size_t k = 0; k < n; k++)
            same += count[k] == count[i];
        if (same > best) {
            best = same;
            *mode = count[i];
        }
    }
    return best;
}

/* What a separator is worth by which a record is not well-formed. */
static const double broken_counts = 0.5;

/* The part of the records that SEPARATOR cuts into the same number of cells; 0 when
 * it cuts nothing. */
static il_status try_separator(const void *head, size_t n, bool is_whole, char separator, double *part, il_csv_guess *g,
                               il_error *err)
{
    size_t count[RECORDS_MOST], mode = 0;
    sample s;
    il_status st = open_sample(&s, head, n, is_whole, separator, err), ended = IL_OK;
    g->n_records = 0;
    while (st == IL_OK && next_of_sample(&s, &ended))
        if (s.n == 1 || !s.csv.is_cut)
            count[g->n_records++] = s.csv.n;
    close_sample(&s);
    *part = 0;
    if (st != IL_OK || ended == IL_E_NOMEM)
        return st == IL_OK ? il_fail_nomem(err) : st;
    if (g->n_records == 0)
        return IL_OK;
    double agreeing = (double)count_agreeing(count, g->n_records, &mode) / (double)g->n_records;
    *part = ended == IL_OK ? agreeing : broken_counts * agreeing;
    g->n_columns = mode;
    if (mode < 2 && separator != '\n')
        *part = 0;
    return IL_OK;
}

/* "sep=;" and the end of the line: how many bytes; 0 when it is not there. */
static size_t said_separator(const char *head, size_t n, char *separator)
{
    static const char key[] = "sep=";
    enum { KEY = sizeof key - 1 };
    if (n < KEY + 2 || strncasecmp(head, key, KEY) != 0 || (head[KEY + 1] != '\n' && head[KEY + 1] != '\r'))
        return 0;
    *separator = head[KEY];
    const char *lf = memchr(head, '\n', n);
    return lf ? (size_t)(lf - head) + 1 : 0;
}

static il_status find_separator(const char *head, size_t n, bool is_whole, il_csv_guess *out, il_error *err)
{
    static const char separators[] = "\t;|, ";
    double best = 0;
    il_status st = IL_OK;
    for (const char *s = out->says_separator ? "" : separators; *s && st == IL_OK; s++) {
        il_csv_guess g = *out;
        double part;
        st = try_separator(head, n, is_whole, *s, &part, &g, err);
        if (st == IL_OK && part > best) {
            best = part;
            *out = g;
            out->separator = *s;
        }
    }
    double part;
    return st == IL_OK && best == 0 ? try_separator(head, n, is_whole, out->separator, &part, out, err) : st;
}

/* ---- what stands in the cells --------------------------------------------------- */

static bool names_both(const il_csv_cell *cell, size_t n)
{
    unsigned has[IL_CSV_N_PAIRS] = { 0 };
    il_csv_axis axis;
    for (size_t k = 0; k < n; k++)
        if (il_csv_name_axis(cell[k].text, cell[k].n, &axis))
            has[axis.pair] |= axis.is_y ? 2 : 1;
    for (size_t k = 0; k < IL_CSV_N_PAIRS; k++)
        if (has[k] == 3)
            return true;
    return false;
}

static bool names_geometry(const il_csv_cell *cell, size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (il_csv_name_is_geometry(cell[k].text, cell[k].n))
            return true;
    return false;
}

static bool is_number(const il_csv_cell *c, char separator)
{
    char mark = separator == ',' ? '.' : 0;
    double value;
    return il_csv_number(c->text, c->n, &mark, &value);
}

/* Is the first record a header: names that mean something, or no number or geometry
 * among words? */
static bool is_header(const il_csv *c)
{
    bool has_word = false;
    for (size_t k = 0; k < c->n; k++) {
        if (il_wkt_begins(c->cell[k].text, c->cell[k].n) || il_wkt_is_hex(c->cell[k].text, c->cell[k].n))
            return false;
        has_word |= c->cell[k].n > 0;
    }
    if (names_both(c->cell, c->n) || names_geometry(c->cell, c->n))
        return true;
    for (size_t k = 0; k < c->n; k++)
        if (is_number(&c->cell[k], c->separator))
            return false;
    return has_word;
}

static il_status look_at_comment(const il_csv *c, il_csv_guess *out, il_error *err)
{
    sample s;
    il_status ended = IL_OK, st = open_sample(&s, c->comment, c->n_comment, true, c->separator, err);
    if (st == IL_OK && next_of_sample(&s, &ended) && s.csv.n == c->n && names_both(s.csv.cell, s.csv.n)) {
        out->header = IL_CSV_COMMENT;
        out->names_xy = true;
    }
    close_sample(&s);
    return st == IL_OK && ended == IL_E_NOMEM ? il_fail_nomem(err) : st;
}

/* A record that is no header. */
static void look_at_row(const il_csv *c, il_csv_guess *out)
{
    out->numbers &= c->n == out->n_columns;
    out->marks |= c->cell[0].n > 0 && c->cell[0].text[0] == '>';
    for (size_t k = 0; k < c->n; k++) {
        const il_csv_cell *cell = &c->cell[k];
        bool is_wkt = il_wkt_begins(cell->text, cell->n);
        if (is_wkt && out->geometry == IL_CSV_NONE)
            out->geometry = k;
        if (is_wkt && (cell->n < 5 || strncasecmp(cell->text, "POINT", 5) != 0))
            out->only_points = false;
        if (out->hex == IL_CSV_NONE && il_wkt_is_hex(cell->text, cell->n))
            out->hex = k;
        out->numbers = out->numbers && is_number(cell, c->separator);
        out->commas |= cell->n > 0 && c->separator != ',' && memchr(cell->text, ',', cell->n);
    }
}

static il_status look_at_first(const il_csv *c, il_csv_guess *out, il_error *err)
{
    if (!is_header(c)) {
        il_status st = c->comment ? look_at_comment(c, out, err) : IL_OK;
        look_at_row(c, out);
        return st;
    }
    out->header = IL_CSV_HEADER;
    out->names_xy = names_both(c->cell, c->n);
    out->names_geometry = names_geometry(c->cell, c->n);
    return IL_OK;
}

il_status il_csv_look(const void *head, size_t n, bool is_whole, il_csv_guess *out, il_error *err)
{
    static const char byte_order_mark[] = "\xEF\xBB\xBF";
    enum { BOM = sizeof byte_order_mark - 1 };
    const char *p = head;
    size_t bom = n >= BOM && memcmp(p, byte_order_mark, BOM) == 0 ? BOM : 0;
    *out = (il_csv_guess){ .separator = '\n', .geometry = IL_CSV_NONE, .hex = IL_CSV_NONE, .only_points = true, .numbers = true };
    size_t length = said_separator(p + bom, n - bom, &out->separator);
    out->says_separator = length > 0;
    p += bom + length;
    n -= bom + length;
    sample s;
    il_status ended = IL_OK, st = find_separator(p, n, is_whole, out, err);
    if (st != IL_OK)
        return st;
    st = open_sample(&s, p, n, is_whole, out->separator, err);
    while (st == IL_OK && next_of_sample(&s, &ended)) {
        if (s.n == 1)
            st = look_at_first(&s.csv, out, err);
        else
            look_at_row(&s.csv, out);
    }
    close_sample(&s);
    return st == IL_OK && ended == IL_E_NOMEM ? il_fail_nomem(err) : st;
}

/* Numbers without names are a table of two or three columns; when only blanks are
 * between them, they are GMT's. */
bool il_csv_guess_is_map(const il_csv_guess *g)
{
    bool is_gmt = (g->separator == ' ' || g->separator == '\t') && !g->commas;
    bool is_plain = g->header == IL_CSV_NO_HEADER && g->numbers && g->n_records > 1 && !is_gmt && g->n_columns >= 2 && g->n_columns <= 3;
    return !g->marks && (g->names_xy || g->names_geometry || g->geometry != IL_CSV_NONE || is_plain);
}
