/* gmt.c - GMT's tables of points (formats/gmt.txt): rows of numbers in segments, each
 * behind a line that begins with >. */
#include "config.h"
#include "input/gmt.h"
#include "base/number.h"
#include "base/text.h"
#include "input/csv-guess.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* ---- numbers ------------------------------------------------------------------- */

/* "12:30:15.5W", "12.5E", "-12:30": degrees, minutes, seconds and the side.  *SIDE is one
 * of EWNS, or 0. */
static bool take_degrees(il_map_text *t, bool behind, double *value, char *side)
{
    il_map_text at = *t;
    double whole = 0, scale = 1, field;
    il_map_text_pass(&at, behind);
    bool negative = at.p < at.end && *at.p == '-';
    at.p += negative;
    for (int k = 0; k < 3; k++) {
        size_t n = at.p < at.end && *at.p >= '0' && *at.p <= '9' ? il_number_parse(at.p, (size_t)(at.end - at.p), &field) : 0;
        if (n == 0 || (k > 0 && field >= 60))
            return false;
        whole = 60 * whole + field;
        scale *= k > 0 ? 60 : 1;
        at.p += n;
        if (at.p == at.end || *at.p != ':')
            break;
        if (field != floor(field))
            return false;
        at.p += k < 2;
    }
    *side = at.p < at.end && strchr("EWNSewns", *at.p) ? (char)(*at.p & ~0x20) : '\0';
    at.p += *side != '\0';
    if ((scale == 1 && *side == '\0') || (negative && *side != '\0') || !il_map_text_ends(&at))
        return false;
    *value = (negative || *side == 'W' || *side == 'S' ? -whole : whole) / scale;
    *t = at;
    return true;
}

static bool take_nan(il_map_text *t, bool behind)
{
    il_map_text at = *t;
    il_map_text_pass(&at, behind);
    if (at.end - at.p < 3 || strncasecmp(at.p, "nan", 3) != 0)
        return false;
    at.p += 3;
    if (!il_map_text_ends(&at))
        return false;
    *t = at;
    return true;
}

/* One of the two coordinates, IS_Y the second; NaN as such. */
static bool take_coordinate(il_gmt *g, il_map_text *t, bool is_y, double *value)
{
    char side;
    if (il_map_text_number(t, is_y, value))
        return true;
    if (take_nan(t, is_y)) {
        *value = NAN;
        return true;
    }
    if (!take_degrees(t, is_y, value, &side) || (side != '\0' && (side == 'N' || side == 'S') != is_y))
        return false;
    il_map_degrees(g->set);
    return true;
}

/* ---- features and segments -------------------------------------------------------- */

static il_status end_part(il_gmt *g)
{
    bool was_in_part = g->in_part;
    g->in_part = false;
    return was_in_part ? il_map_end_part(g->set, g->err) : IL_OK;
}

il_status il_gmt_next_feature(il_gmt *g, long line)
{
    il_status st = end_part(g);
    if (st == IL_OK && g->in_feature)
        st = il_map_end_feature(g->set, g->err);
    g->in_feature = g->fresh = true;
    return st == IL_OK ? il_map_begin_feature(g->set, line, g->err) : st;
}

/* What stands before the first segment: the coordinate system, and rows that are one
 * segment, as others follow. */
il_status il_gmt_begin_segments(il_gmt *g)
{
    if (g->begun)
        return IL_OK;
    g->begun = true;
    il_status st = il_gmt_settle_crs(g);
    if (st == IL_OK)
        st = il_map_rows_emit_one(&g->rows, g->set, g->err);
    il_map_rows_free(&g->rows);
    return st;
}

/* A segment begins.  In OGR's files it is one more part of the feature at hand, unless
 * its values follow. */
static il_status take_segment(il_gmt *g, il_map_text t)
{
    il_gmt_header header;
    il_status st = il_gmt_begin_segments(g);
    if (st == IL_OK)
        st = end_part(g);
    bool has_any = il_gmt_header_read(t, &header), continues = g->ogr.heads.n > 0 && g->in_feature && !has_any;
    if (st != IL_OK || continues)
        return st;
    st = il_gmt_next_feature(g, g->lines.line);
    return st == IL_OK ? il_gmt_header_tell(&header, g->set, g->err) : st;
}

static il_status add_point(il_gmt *g, double x, double y, double z)
{
    il_status st = IL_OK;
    bool is_point = g->ogr.part == IL_MAP_POINT;
    if (!g->in_feature)
        st = il_gmt_next_feature(g, g->lines.line);
    g->fresh = false;
    if (st == IL_OK && !g->in_part)
        st = il_map_begin_part(g->set, g->ogr.part, g->lines.line, g->err);
    g->in_part = true;
    if (st == IL_OK)
        st = il_map_point(g->set, x, y, z, g->lines.line, g->err);
    return st == IL_OK && is_point ? end_part(g) : st;
}

static il_status take_row(il_gmt *g, double x, double y, double z)
{
    g->has_rows = true;
    if (isnan(x) || isnan(y)) {
        g->broken = true;
        return g->begun ? end_part(g) : IL_OK;
    }
    unsigned news = g->broken ? IL_MAP_ROWS_BREAK : 0;
    g->broken = false;
    if (g->begun)
        return add_point(g, x, y, z);
    return il_map_rows_add(&g->rows, x, y, z, NULL, 0, news, g->lines.line, g->err);
}

/* ---- lines --------------------------------------------------------------------------- */

/* Rows have two coordinates, and behind them a height or whatever else.  Text before all
 * rows and segments is the head of the table. */
static il_status take_numbers(il_gmt *g, il_map_text t)
{
    double x, y, z = NAN;
    il_map_text at = t;
    if (!take_coordinate(g, &at, false, &x) || !take_coordinate(g, &at, true, &y)) {
        if (!g->begun && !g->has_rows)
            return IL_OK;
        return il_fail(g->err, IL_E_INPUT, g->lines.line, "'%.*s' is no row: it begins with two numbers, x and y",
                       il_map_text_shown(&t), t.p);
    }
    if (!il_map_text_number(&at, true, &z))
        z = NAN;
    return take_row(g, x, y, z);
}

static il_status take_line(il_gmt *g, il_map_text t)
{
    if (t.p == t.end)
        return IL_OK;
    char mark = *t.p;
    if (mark != '>' && mark != '#')
        return take_numbers(g, t);
    t.p++;
    return mark == '>' ? take_segment(g, t) : il_gmt_comment(g, t);
}

/* A table without segments: rows in lines by what they say themselves. */
static il_status end_table(il_gmt *g)
{
    static const il_map_rows_names none = { .height = NULL };
    il_status st = end_part(g);
    if (st == IL_OK && g->in_feature)
        st = il_map_end_feature(g->set, g->err);
    if (st == IL_OK)
        st = il_gmt_settle_crs(g);
    return st == IL_OK && !g->begun ? il_map_rows_emit(&g->rows, &none, g->set, g->err) : st;
}

static il_status parse(il_source *source, il_map_set *set, const il_read_options *options, il_error *err)
{
    il_gmt g = { .set = set, .ogr = { .part = IL_MAP_LINE }, .err = err };
    il_map_text t;
    bool more = true;
    il_status st = IL_OK;
    il_lines_init(&g.lines, source, options->max_line);
    il_map_rows_init(&g.rows, options);
    while (st == IL_OK && (st = il_map_text_line(&g.lines, &t, &more, err)) == IL_OK && more)
        st = take_line(&g, t);
    if (st == IL_OK)
        st = end_table(&g);
    il_lines_free(&g.lines);
    il_map_rows_free(&g.rows);
    il_gmt_ogr_free(&g.ogr);
    return st;
}

static il_status read_all(il_source *const *source, size_t n, const il_read_options *options,
                          il_sink *sink, il_report *report, il_error *err)
{
    return il_map_read("GMT", parse, source, n, options, sink, report, err);
}

/* ---- telling it apart ------------------------------------------------------------------ */

static bool is_row(il_map_text t, bool *has_mark)
{
    double v;
    char side;
    const char *p = t.p;
    for (int k = 0; k < 2; k++)
        if (!il_map_text_number(&t, k > 0, &v) && !take_nan(&t, k > 0) && !take_degrees(&t, k > 0, &v, &side))
            return false;
    *has_mark |= memchr(p, ',', (size_t)(t.p - p)) || memchr(p, ';', (size_t)(t.p - p));
    return true;
}

/* A table of rows only is GMT's unless something else shows that it is not. */
typedef enum answer { NO, YES, ROWS_ONLY } answer;

/* OGR's first line; or a row behind a mark of segments, with no line before it that is of
 * another kind than a few of text; or rows only, with nothing but blanks between their
 * numbers. */
static answer look_at_lines(const unsigned char *head, size_t n)
{
    enum { TEXTS_MOST = 10 };
    size_t at = 0, texts = 0, rows = 0;
    bool whole, marked = false, has_mark = false;
    il_map_text t;
    while (il_map_text_head(head, n, &at, &t, &whole)) {
        if (t.p == t.end || (!whole && n >= IL_MAP_TEXT_HEAD))
            continue;
        size_t length = (size_t)(t.end - t.p);
        if (*t.p == '#' && length >= 7 && il_text_contains(t.p, length, "@VGMT"))
            return YES;
        if (*t.p == '>')
            marked = true;
        else if (*t.p == '#')
            continue;
        else if (is_row(t, &has_mark))
            rows++;
        else if (marked || rows > 0 || ++texts > TEXTS_MOST)
            return NO;
        if (marked && rows > 0)
            return YES;
    }
    return !marked && texts == 0 && rows > 1 && !has_mark ? ROWS_ONLY : NO;
}

/* Of rows only, no comment may say that it is another table, nor the first row that they
 * are counted. */
static il_status look(const unsigned char *head, size_t n, bool *is, il_error *err)
{
    answer a = il_map_text_is_plain(head, n) ? look_at_lines(head, n) : NO;
    il_csv_guess g;
    *is = a == YES;
    if (a != ROWS_ONLY || il_reader_bln.probe(head, n))
        return IL_OK;
    il_status st = il_csv_look(head, n, n < IL_MAP_TEXT_HEAD, &g, err);
    *is = st == IL_OK && !g.names_xy;
    return st;
}

static bool probe(const unsigned char *head, size_t n)
{
    bool is;
    return look(head, n, &is, NULL) == IL_OK && is;
}

const il_reader il_reader_gmt = {
    .name = "gmt",
    .extensions = "gmt xy xyz",
    .words = "isolines as GMT's multi-segment tables, OGR/GMT",
    .is_map = true,
    .probe = probe,
    .look = look,
    .read = read_all,
};
