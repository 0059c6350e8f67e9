#include "config.h"
#include "input/map-data.h"
#include "base/alloc.h"
#include "base/text.h"
#include "input/map-borders.h"
#include "input/map-degrees.h"
#include "input/map-heights.h"
#include "input/map-outline.h"
#include "input/map-project.h"
#include "input/map-spots.h"
#include "input/map-stack.h"
#include "input/map-trim.h"
#include "input/map-units.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* Names of attributes that are kept for the refusal that lists them, and, of others, those
 * that may be heights; files of more columns are tables of something else. */
enum { COLUMNS_MOST = 200 };

/* guess: the column that likely comes next, as features have the same attributes in the
 * same order.  n_degrees: files that say that they hold degrees, is_degrees: the one at
 * hand does. */
struct il_map_set {
    il_map map;
    uint32_t file;
    size_t guess, n_degrees;
    bool is_degrees;
    bool has_told_crs;          /* that two files state theirs in different words */
};

/* ---- points ------------------------------------------------------------------ */

il_status il_map_begin_feature(il_map_set *s, long line, il_error *err)
{
    if (s->map.n_features == UINT32_MAX)
        return il_fail(err, IL_E_INPUT, line, "more than %u features", UINT32_MAX);
    s->guess = 0;
    return IL_OK;
}

il_status il_map_end_feature(il_map_set *s, il_error *err)
{
    (void)err;
    s->map.n_features++;
    return IL_OK;
}

void il_map_count_from_here(il_map_set *s)
{
    s->map.first_feature[s->file] = s->map.n_features;
}

il_status il_map_begin_part(il_map_set *s, il_map_part kind, long line, il_error *err)
{
    il_map *m = &s->map;
    if (!il_grow(&m->line, &m->cap_lines, m->n_lines + 1, sizeof *m->line))
        return il_fail_nomem(err);
    m->line[m->n_lines++] = (il_map_line){
        .begin = m->n, .z_low = INFINITY, .z_high = -INFINITY, .height = NAN, .line = line,
        .feature = (uint32_t)m->n_features, .file = s->file, .kind = (unsigned char)kind };
    return IL_OK;
}

static il_status fail_point(const il_map *m, double x, double y, double z, long line, il_error *err)
{
    if (m->n + m->n_spots >= m->options->max_points)
        return il_fail(err, IL_E_INPUT, line, "more than %zu points (--max-points)", m->options->max_points);
    double bad = !(fabs(x) < IL_COORDINATE_BOUND) ? x : !(fabs(y) < IL_COORDINATE_BOUND) ? y : z;
    if (isfinite(bad))
        return il_fail(err, IL_E_INPUT, line, "a coordinate is not below 1e15");
    return il_fail(err, IL_E_INPUT, line, "a coordinate is no finite number");
}

il_status il_map_point(il_map_set *s, double x, double y, double z, long line, il_error *err)
{
    il_map *m = &s->map;
    il_map_line *l = &m->line[m->n_lines - 1];
    bool fits = fabs(x) < IL_COORDINATE_BOUND && fabs(y) < IL_COORDINATE_BOUND && !(fabs(z) >= IL_COORDINATE_BOUND);
    if (!fits || m->n + m->n_spots >= m->options->max_points)
        return fail_point(m, x, y, z, line, err);
    if (l->kind == IL_MAP_POINT) {
        l->n++;
        return il_map_spots_add(m, l, x, y, z, line, err);
    }
    if (m->n == m->cap && !il_grow(&m->xy, &m->cap, m->n + 1, 2 * sizeof *m->xy))
        return il_fail_nomem(err);
    m->xy[2 * m->n] = x + 0.0; /* -0 is 0 */
    m->xy[2 * m->n + 1] = y + 0.0;
    m->n++;
    l->n++;
    l->n_z += isnan(z) ? 0 : 1;
    l->z_low = z < l->z_low ? z : l->z_low;
    l->z_high = z > l->z_high ? z : l->z_high;
    return IL_OK;
}

/* A line that comes back to its first point is closed, and an outline always is.  Points
 * are no lines, and kept elsewhere. */
il_status il_map_end_part(il_map_set *s, il_error *err)
{
    il_map *m = &s->map;
    il_map_line *l = &m->line[m->n_lines - 1];
    (void)err;
    if (l->n == 0)
        il_map_skip(s, l->line, "line", "has no points");
    if (l->kind == IL_MAP_POINT || l->n == 0) {
        m->n_lines--;
        return IL_OK;
    }
    const double *first = m->xy + 2 * l->begin, *last = first + 2 * (l->n - 1);
    bool meets = l->n > 2 && first[0] == last[0] && first[1] == last[1];
    if (meets) {
        m->n--;
        l->n--;
        l->n_z -= l->n_z > l->n;
    }
    l->closed = meets || l->kind == IL_MAP_RING;
    return IL_OK;
}

/* ---- attributes -------------------------------------------------------------- */

static bool same_name(const char *a, const char *b, size_t n)
{
    return strlen(a) == n && memcmp(a, b, n) == 0; /* B may hold zero bytes */
}

/* The column of an earlier file that NAME is but for its case: sheets of one map are not
 * always spelt alike.  Within a file two spellings are two attributes. */
static size_t find_spelt_otherwise(const il_map_set *s, const char *name, size_t n)
{
    const il_map *m = &s->map;
    for (size_t k = 0; k < m->n_columns; k++) {
        const il_map_column *c = &m->column[k];
        if (c->wanted && !c->is_place && c->file < s->file && strlen(c->name) == n && strncasecmp(c->name, name, n) == 0)
            return k;
    }
    return m->n_columns;
}

static il_status make_column(il_map *m, const char *name, size_t n, bool is_place, bool wanted, il_error *err)
{
    char *copy = il_strndup(name, n);
    if (!copy || !il_grow(&m->column, &m->cap_columns, m->n_columns + 1, sizeof *m->column)) {
        il_free(copy);
        return il_fail_nomem(err);
    }
    m->column[m->n_columns++] = (il_map_column){ .name = copy, .is_place = is_place, .wanted = wanted };
    m->n_wanted += wanted;
    return IL_OK;
}

/* *AT: the index of the column NAME, made when it is new; n_columns when there are too
 * many. */
static il_status find_column(il_map_set *s, const char *name, size_t n, bool is_place, size_t *at, il_error *err)
{
    il_map *m = &s->map;
    for (size_t k = 0; k < m->n_columns; k++) {
        *at = (s->guess + k) % m->n_columns;
        if (m->column[*at].is_place == is_place && same_name(m->column[*at].name, name, n))
            return IL_OK;
    }
    bool wanted = is_place || il_map_heights_wants(m->options, name, n);
    *at = wanted && !is_place && s->file > 0 ? find_spelt_otherwise(s, name, n) : m->n_columns;
    if (*at < m->n_columns)
        return IL_OK;
    bool full = (wanted ? m->n_wanted : m->n_columns - m->n_wanted) >= COLUMNS_MOST;
    m->more_columns |= full;
    return full ? IL_OK : make_column(m, name, n, is_place, wanted, err);
}

/* Give COLUMN the value of the feature at hand. */
static bool set_value(il_map_column *c, size_t feature, double value)
{
    if (!il_grow(&c->value, &c->cap, feature + 1, sizeof *c->value))
        return false;
    while (c->n < feature)
        c->value[c->n++] = NAN;
    c->value[feature] = value;
    c->n = feature + 1;
    return true;
}

static il_status take_value(il_map *m, il_map_column *c, const char *text, size_t n, il_error *err)
{
    il_map_value v;
    if (!il_map_heights_value(m->options, text, n, &v)) {
        c->n_texts++;
        return IL_OK;
    }
    if (c->n_numbers++ == 0) {
        c->has_unit = v.has_unit;
        c->unit = v.unit;
    }
    c->mixed_units |= c->has_unit != v.has_unit || (v.has_unit && c->unit != v.unit);
    return set_value(c, m->n_features, v.number) ? IL_OK : il_fail_nomem(err);
}

static il_status take(il_map_set *s, const char *name, size_t n_name, const char *text, size_t n, bool is_place, il_error *err)
{
    il_map *m = &s->map;
    size_t k;
    il_status st = find_column(s, name, n_name, is_place, &k, err);
    if (st != IL_OK || k == m->n_columns)
        return st;
    s->guess = k + 1;
    m->column[k].file = same_name(m->column[k].name, name, n_name) ? s->file : m->column[k].file;
    return text && m->column[k].wanted ? take_value(m, &m->column[k], text, n, err) : IL_OK;
}

il_status il_map_attribute(il_map_set *s, const char *name, size_t n_name, const char *text, size_t n, il_error *err)
{
    return take(s, name, n_name, text, n, false, err);
}

il_status il_map_place(il_map_set *s, const char *name, const char *text, size_t n, il_error *err)
{
    return take(s, name, strlen(name), text, n, true, err);
}

bool il_map_wants(const il_map_set *s, const char *name, size_t n_name)
{
    return il_map_heights_wants(s->map.options, name, n_name);
}

/* ---- what the file says ------------------------------------------------------ */

/* The N bytes at TEXT, made printable where they are no text; null when there is no
 * memory. */
static char *copy_words(const char *text, size_t n)
{
    enum { WORDS_MOST = 4096 };
    char shown[WORDS_MOST];
    if (il_utf8_valid(text, n) && !memchr(text, '\0', n))
        return il_strndup(text, n);
    return il_strndup(shown, il_text_printable(shown, sizeof shown, text, n));
}

/* The system WORDS may be the one that is known, which nothing here can tell for sure. */
static void tell_other_words(il_map_set *s, const char *words)
{
    if (!s->has_told_crs)
        il_report_note(s->map.report, "%.200s: its coordinate system, '%.80s', is taken for the same as '%.80s' before it",
                       il_map_file(s), words, s->map.crs);
    s->has_told_crs = true;
}

il_status il_map_crs(il_map_set *s, const char *text, size_t n, long line, il_error *err)
{
    il_map *m = &s->map;
    if (n == 0 || (m->crs && same_name(m->crs, text, n)))
        return IL_OK;
    char *copy = copy_words(text, n);
    il_status st = copy ? IL_OK : il_fail_nomem(err);
    il_crs meaning;
    il_crs_parse(copy, &meaning);
    if (copy && m->crs && !il_crs_agree(&meaning, &m->meaning))
        st = il_fail(err, IL_E_INPUT, line, "its coordinate system is '%.80s', and '%.60s' before it", copy, m->crs);
    else if (copy && m->crs && (meaning.epsg == 0 || meaning.epsg != m->meaning.epsg))
        tell_other_words(s, copy);
    if (st != IL_OK || m->crs) {
        il_free(copy);
        return st;
    }
    m->crs = copy;
    m->meaning = meaning;
    return IL_OK;
}

void il_map_degrees(il_map_set *s)
{
    s->n_degrees += !s->is_degrees;
    s->is_degrees = s->map.degrees = true;
}

il_status il_map_unit(il_map_set *s, il_unit unit, long line, il_error *err)
{
    il_map *m = &s->map;
    if (m->has_unit && m->unit != unit && !m->options->has_unit)
        return il_fail(err, IL_E_INPUT, line, "its unit is %s, and %s before it (--unit says what both are)",
                       il_unit_name(unit), il_unit_name(m->unit));
    m->has_unit = true;
    m->unit = unit;
    return IL_OK;
}

il_report *il_map_report(il_map_set *s)
{
    return s->map.report;
}

const char *il_map_file(const il_map_set *s)
{
    return s->map.file[s->file];
}

void il_map_skip(il_map_set *s, long line, const char *what, const char *why)
{
    il_report_skip(s->map.report, il_map_file(s), line, what, why);
}

void il_map_drop(il_map *m, il_map_line *l, const char *what, const char *why)
{
    il_report_skip(m->report, il_map_file_of(m, l), l->line, what, why);
    l->height = NAN;
    l->n = 0;
}

/* ---- from files to a stack ----------------------------------------------------- */

static void free_set(il_map_set *s)
{
    il_map *m = &s->map;
    for (size_t k = 0; k < m->n_columns; k++) {
        il_free(m->column[k].name);
        il_free(m->column[k].value);
    }
    il_free(m->column);
    il_free(m->line);
    il_free(m->spot);
    il_free(m->xy);
    il_free(m->crs);
    il_free(m->mark);
    il_free(m->file);
    il_free(m->first_feature);
}

static il_status parse_all(il_map_set *s, il_map_parse *parse, il_source *const *source, size_t n, il_error *err)
{
    il_status st = IL_OK;
    for (size_t k = 0; k < n && st == IL_OK; k++) {
        s->file = (uint32_t)k;
        s->is_degrees = false;
        s->map.file[k] = il_source_name(source[k]);
        il_map_count_from_here(s);
        st = parse(source[k], s, s->map.options, err);
        if (st != IL_OK)
            il_error_set_file(err, il_source_name(source[k]));
    }
    if (s->n_degrees > 0 && s->n_degrees < n)
        il_report_note(s->map.report, "%zu of %zu files say that they are in degrees; all are taken so", s->n_degrees, n);
    return st;
}

/* What the set turns out to be is said of the first file, if no place is known. */
static il_status make_stack(il_map *m, il_sink *sink, il_error *err)
{
    static il_status (*const outline[])(il_map *, il_error *) = { il_map_take_outline, NULL };
    static il_status (*const isolines[])(il_map *, il_error *) = {
        il_map_find_heights, il_map_find_degrees, il_map_find_borders, il_map_settle_units, il_map_trim, il_map_project, NULL };
    il_status st = IL_OK;
    for (il_status (*const *step)(il_map *, il_error *) = m->options->map.outline ? outline : isolines; *step && st == IL_OK; step++)
        st = (*step)(m, err);
    if (st != IL_OK)
        il_error_set_file(err, m->file[0]);
    return st == IL_OK ? il_map_emit(m, sink, err) : st;
}

il_status il_map_read(const char *format, il_map_parse *parse, il_source *const *source, size_t n,
                      const il_read_options *options, il_sink *sink, il_report *report, il_error *err)
{
    il_map_set s = { .map = { .format = format, .options = options, .report = report, .n_files = n } };
    il_crs_parse(NULL, &s.map.meaning);
    s.map.file = il_calloc(n, sizeof *s.map.file);
    s.map.first_feature = il_calloc(n, sizeof *s.map.first_feature);
    il_status st = s.map.file && s.map.first_feature ? parse_all(&s, parse, source, n, err) : il_fail_nomem(err);
    if (st == IL_OK)
        st = make_stack(&s.map, sink, err);
    free_set(&s);
    return st == IL_OK ? sink->end(sink, err) : st;
}
