/* t-tables.c - text with rows of numbers: how GMT, CSV and BLN are told apart, that they
 * say the same, where rows without marks are divided, what is counted, and what happens
 * without memory. */
#include "config.h"
#include "base/alloc.h"
#include "input/reader.h"
#include "test.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- what comes out -------------------------------------------------------------- */

typedef struct buffer {
    char *s;
    size_t n, cap;
} buffer;

static void put(buffer *b, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(buffer *b, const char *format, ...)
{
    va_list args;
    if (b->cap - b->n < 1000) {
        b->cap = 2 * b->cap + 100000;
        b->s = realloc(b->s, b->cap);
        assert_non_null(b->s);
    }
    va_start(args, format);
    b->n += (size_t)vsnprintf(b->s + b->n, b->cap - b->n, format, args);
    va_end(args);
}

/* Everything handed on, as text; lines: how many. */
typedef struct recorder {
    il_sink sink;
    buffer out;
    size_t lines;
} recorder;

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self, (void)head, (void)err;
    return IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    recorder *r = (recorder *)self;
    (void)err;
    put(&r->out, "%.17g:", s->z);
    for (size_t i = 0; i < s->n; i++) {
        put(&r->out, s->ring[i].open ? " line" : " ring");
        for (size_t v = 0; v < 2 * s->ring[i].n; v++)
            put(&r->out, " %.17g", s->ring[i].xy[v]);
    }
    r->lines += s->n;
    put(&r->out, "\n");
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *pair, il_error *err)
{
    (void)self, (void)pair, (void)err;
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    (void)self, (void)err;
    return IL_OK;
}

static const recorder nothing = { .sink = { on_stack, on_slice, on_pair, on_end, on_end } };

static il_status read_with(const il_reader *reader, const char *text, size_t n, const il_read_options *o, recorder *r,
                           il_report *report, il_error *err)
{
    il_source *source = NULL;
    *r = nothing;
    assert_int_equal(il_source_from_memory(&source, text, n, "m", NULL), IL_OK);
    il_status st = reader->read(&source, 1, o, &r->sink, report, err);
    il_source_close(source);
    return st;
}

static il_status read_text(const il_reader *reader, const char *text, recorder *r, il_report *report, il_error *err)
{
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.map.project = IL_PROJECT_NONE;
    return read_with(reader, text, strlen(text), &o, r, report, err);
}

static void assert_read(const il_reader *reader, const char *text, const char *expected)
{
    recorder r;
    il_error err = IL_ERROR_INIT;
    if (read_text(reader, text, &r, NULL, &err) != IL_OK)
        fail_msg("%s: %s", text, err.text);
    assert_string_equal(r.out.s, expected);
    free(r.out.s);
}

static void assert_refused(const il_reader *reader, const char *text, long line, const char *words)
{
    recorder r;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(read_text(reader, text, &r, NULL, &err), IL_E_INPUT);
    assert_string_equal(err.text, words);
    assert_int_equal(err.line, line);
    free(r.out.s);
}

/* ---- telling them apart ------------------------------------------------------------ */

static const char *format_of(const char *text, size_t n)
{
    const il_reader *reader = NULL;
    il_source *source;
    assert_int_equal(il_source_from_memory(&source, text, n, "m", NULL), IL_OK);
    il_status st = il_reader_detect(source, &reader, NULL);
    il_source_close(source);
    return st == IL_OK ? reader->name : "";
}

static const struct { const char *format, *text; } heads[] = {
    { "gmt", "> -Z100\n0 0\n1 0\n" }, { "gmt", ">\n0,0\n1,0\n" }, { "gmt", "# a\nx y\n> 5\n1\t2\t5\n" },
    { "gmt", "1 2 5\n3 4 5\n" }, { "gmt", "1\t2\t5\r\n3\t4\t5\r\n" }, { "gmt", "0 0\nNaN NaN\n1 1\n" }, { "gmt", "0 0 5\n1 1 5\n> -Z5\n" },
    { "gmt", "# @VGMT1.0 @GMULTIPOLYGON\n# @Nelev\n" }, { "gmt", ">\n3:00:00E 45:30N\n" }, { "gmt", "\xef\xbb\xbf> a\n1 2\n" },
    { "csv", "WKT,elev\n\"LINESTRING (0 0,1 1)\",5\n" }, { "csv", "LINESTRING Z (0 0 5, 1 1 5)\n" }, { "csv", "elev;geom\n5;\n" },
    { "csv", "a\tb\n5\tPOLYGON ((0 0,1 1,1 0))\n" }, { "csv", "x,y,z\n0,0,5\n" }, { "csv", "x y z\n0 0 5\n1 0 5\n" },
    { "csv", "id;LAT;LONG;ALT\n1;2,5;3,5;10\n" }, { "csv", "0,0,5\n1,0,5\n" }, { "csv", "0,5;0,5;5\n1;0;5\n" },
    { "csv", "# x y z\n0 0 5\n1 0 5\n" },
    { "csv", "1,5\t2,5\t5\n3\t4\t5\n" }, { "csv", "sep=;\nx;y;z\n1;2;3\n" }, { "csv", "SRID=4326;LINESTRING (0 0,1 1)\n" },
    { "csv", "\"Point_X\",\"Point_Y\",\"Elev\"\n1,2,3\n" }, { "csv", "5,0,7\n6,0,7\n8,0,7\n" },
    { "bln", "2,1\n0,0\n1,1\n" }, { "bln", "2 1\n0 0\n1 1\n" }, { "bln", "2,1,\"5\"\n0,0\n1,1\n2,1,\"6\"\n0,0\n1,1\n" },
    { "bln", "2,0,5\n0,0\n1,1\n" }, { "bln", "3,1,\"5\"\n0,0\n1,1\n" }, { "bln", "\n2,1\n\n0,0,5\n1,1,5\n" },
    { "dxf", "  0\nSECTION\n  2\nHEADER\n" }, { "", "solid a\nfacet normal 0 0 1\n" }, { "", "v 0 0 0\nv 1 0 0\nf 1 2 3\n" },
    { "", "ply\nformat ascii 1.0\nelement vertex 3\n" }, { "", "OFF\n8 6 12\n0 0 0\n" }, { "", "" }, { "", "\n\n" }, { "", "12\n13\n14\n" },
    { "", ">sp|P1 a protein\nMKVL\n" }, { "", "name,elev\na,10\nb,20\n" }, { "", "1,2,3,4\n5,6,7,8\n" },
    { "", "> quoted\n> text\nof mail\n" },
    { "", "ncols 4\nnrows 4\nxllcorner 0\n1 2 3 4\n" }, { "", "a sentence, and another one; with | and more\nthe end\n" },
    { "", "[1,2],[3,4]\n" }, { "", "0 0\n" }, { "", "0,0\n\x01,5\n" }, { "", "2007-05-09 1\n2007-05-10 2\n" },
    { "loft", "isoloft 1\nunit mm\n" }, { "geojson", "{\"type\":\"LineString\"}" }, { "svg", "<svg>" } };

static void forms_are_told_apart(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++)
        if (strcmp(format_of(heads[i].text, strlen(heads[i].text)), heads[i].format) != 0)
            fail_msg("'%s' is '%s'", heads[i].text, format_of(heads[i].text, strlen(heads[i].text)));
}

static void no_two_of_them_take_the_same_head(void **state)
{
    (void)state;
    static const il_reader *const readers[] = { &il_reader_gmt, &il_reader_csv, &il_reader_bln };
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) {
        size_t n = 0;
        for (size_t k = 0; k < 3; k++)
            n += readers[k]->probe((const unsigned char *)heads[i].text, strlen(heads[i].text));
        if (n > 1)
            fail_msg("'%s' is taken by %zu", heads[i].text, n);
    }
}

/* ---- the same lines in every form ----------------------------------------------------- */

enum { LINES = 60, POINTS = 200 };

static double wave(int line, int k)
{
    return 1000 * line + 123.456789012345 * ((k * 7919) % POINTS) / 7.0;
}

static void put_forms(buffer form[5])
{
    put(&form[1], "WKT;elev\n");
    put(&form[2], "line,x,y,elev\n");
    put(&form[3], "line\tx\ty\telev\n");
    for (int i = 0; i < LINES; i++) {
        put(&form[0], "> %d -Z%d.5\n", i, i / 3);
        put(&form[1], i % 2 ? "\"LINESTRING (" : "LINESTRING(");
        put(&form[4], "%d,1,\"%d.5\"\n", POINTS, i / 3);
        for (int k = 0; k < POINTS; k++) {
            double x = wave(i, k), y = wave(i, k + 31);
            char comma[100];
            put(&form[0], k % 2 ? "%.17g %.17g\n" : "%.17g,%.17g\n", x, y);
            put(&form[1], "%s%.17g %.17g", k > 0 ? k % 50 == 7 ? ",\n" : "," : "", x, y);
            put(&form[2], "%d,%.17g,%.17g,%d.5\n", i, x, y, i / 3);
            snprintf(comma, sizeof comma, "%d\t%.17g\t\"%.17g\"\t%d.5\n", i, x, y, i / 3);
            for (char *p = comma; (p = strchr(p, '.')) != NULL;)
                *p = ',';
            put(&form[3], "%s", comma);
            put(&form[4], "%.17g %.17g\n", x, y);
        }
        put(&form[1], ")%s;%d.5\n", i % 2 ? "\"" : "", i / 3);
    }
}

static void the_same_lines_come_out_of_every_form(void **state)
{
    (void)state;
    static const il_reader *const reader[] = { &il_reader_gmt, &il_reader_csv, &il_reader_csv, &il_reader_csv, &il_reader_bln };
    buffer form[5] = { { NULL, 0, 0 } };
    recorder first, r;
    put_forms(form);
    for (size_t k = 0; k < 5; k++) {
        assert_string_equal(format_of(form[k].s, form[k].n), reader[k]->name);
        assert_int_equal(read_text(reader[k], form[k].s, k == 0 ? &first : &r, NULL, NULL), IL_OK);
        assert_int_equal(k == 0 ? first.lines : r.lines, LINES);
        if (k > 0) {
            assert_string_equal(first.out.s, r.out.s);
            free(r.out.s);
        }
        free(form[k].s);
    }
    free(first.out.s);
}

/* ---- where rows are divided ------------------------------------------------------------ */

static size_t lines_of(const buffer *b)
{
    recorder r;
    il_error err = IL_ERROR_INIT;
    if (read_text(&il_reader_csv, b->s, &r, NULL, &err) != IL_OK)
        fail_msg("%s", err.text);
    free(r.out.s);
    return r.lines;
}

/* Two open lines of one height with steps of 1, JUMP apart, and one of another. */
static size_t lines_apart(double jump, double scale)
{
    buffer b = { NULL, 0, 0 };
    put(&b, "x,y,z\n");
    for (int line = 0; line < 3; line++)
        for (int k = 0; k < 15; k++)
            put(&b, "%.17g,%.17g,%d\n", scale * (k + (line == 1) * (14 + jump)), scale * line / 1024, line / 2);
    size_t n = lines_of(&b);
    free(b.s);
    return n;
}

static void a_gap_is_ten_usual_steps(void **state)
{
    (void)state;
    static const double scales[] = { 1, 0x1p-100, 0x1p40, 0x1p-20 };
    for (size_t k = 0; k < sizeof scales / sizeof *scales; k++) {
        assert_int_equal(lines_apart(9.9, scales[k]), 2);
        assert_int_equal(lines_apart(10.2, scales[k]), 3);
        assert_int_equal(lines_apart(500, scales[k]), 3);
    }
}

/* Steps spread as 2^-t, as simplified lines have them: none of 1000 is a gap. */
static void long_steps_of_simplified_lines_are_no_gaps(void **state)
{
    (void)state;
    buffer b = { NULL, 0, 0 };
    double x = 0;
    put(&b, "x,y,z\n");
    for (int k = 0; k < 1000; k++) {
        x -= log((((k * 7919) % 1000) + 0.5) / 1000);
        put(&b, "%.17g,0,5\n", x);
    }
    put(&b, "0,0,6\n1,0,6\n");
    assert_int_equal(lines_of(&b), 2);
    free(b.s);
}

static void few_rows_have_no_gaps(void **state)
{
    (void)state;
    assert_read(&il_reader_csv, "x,y,z\n0,0,5\n1,0,5\n2,0,5\n900,0,5\n901,0,5\n0,0,6\n1,0,6\n",
                "5: line 0 0 1 0 2 0 900 0 901 0\n6: line 0 0 1 0\n");
}

static void a_line_ends_where_it_is_closed(void **state)
{
    (void)state;
    assert_read(&il_reader_csv, "x,y,z\n0,0,5\n9,0,5\n9,9,5\n0,0,5\n1,1,5\n2,1,5\n0,0,6\n0,0,6\n0,9,6\n9,9,6\n0,0,6\n",
                "5: ring 0 0 9 0 9 9 line 1 1 2 1\n6: ring 0 0 0 0 0 9 9 9\n");
    assert_read(&il_reader_csv, "x,y,z\n0,0,5\n9,0,5\n0,0,5\n9,9,5\n9,8,5\n0,0,6\n1,0,6\n",
                "5: line 0 0 9 0 0 0 9 9 9 8\n6: line 0 0 1 0\n");
}

static void numbers_of_lines_divide_and_nothing_else_does(void **state)
{
    (void)state;
    assert_read(&il_reader_csv, "part,x,y,z\na,0,0,5\na,9,0,5\na,0,0,5\na,9,9,5\nb,9,8,5\nb,0,0,5\nb,0,0,5\nb,1,2,5\nc,1,2,6\nc,1,3,6\n",
                "5: line 0 0 9 0 0 0 9 9 line 9 8 0 0 0 0 1 2\n6: line 1 2 1 3\n");
}

/* ---- counted and told --------------------------------------------------------------------- */

static void assert_skip(const il_report *r, size_t k, long line, size_t count, const char *words)
{
    char got[200];
    assert_true(k < r->n_skips);
    snprintf(got, sizeof got, "%s: %s", r->skip[k].what, r->skip[k].why);
    assert_string_equal(got, words);
    assert_int_equal(r->skip[k].line, line);
    assert_int_equal(r->skip[k].count, count);
}

static void rows_that_are_left_out_are_counted_with_their_lines(void **state)
{
    (void)state;
    static const char text[] = "note,x,y,z\n\"two\nlines\",0,0,5\n,9,0,5\n,No Data,0,5\n,1,1,5,6\n\n# a comment\n,9,9,\n,9,9,5\n"
                               ",inf,9,5\n,nan,9,5\n,1 1,9,5\n,0,0,6\n,9,0,6\n";
    recorder r;
    il_report report = IL_REPORT_INIT;
    assert_int_equal(read_text(&il_reader_csv, text, &r, &report, NULL), IL_OK);
    assert_string_equal(r.out.s, "5: line 0 0 9 0 9 9\n6: line 0 0 9 0\n");
    assert_skip(&report, 0, 5, 4, "row: x or y is no number");
    assert_skip(&report, 1, 6, 1, "row: has more cells than there are columns");
    assert_skip(&report, 2, 9, 1, "row: the height is no number");
    assert_int_equal(report.n_skipped, 6);
    il_report_free(&report);
    free(r.out.s);
}

static void lines_of_text_are_those_of_the_file(void **state)
{
    (void)state;
    assert_refused(&il_reader_csv, "# a\n\nWKT,elev\n\"LINESTRING (0 0,\n1 1,\n2 x)\",5\n", 6,
                   "'x)' stands in the WKT where a number should be");
    assert_refused(&il_reader_csv, "a,WKT\n\"b\nc\n\",\"LINESTRING (0 0,\n1e15 1)\"\n", 5, "a coordinate is not below 1e15");
    assert_refused(&il_reader_csv, "x,y,z\n0,0,5\nNo,0,5\n\n1,0,5\n1e16,0,5\n0,0,6\n1,1,6\n", 6, "a coordinate is not below 1e15");
    assert_refused(&il_reader_gmt, "0 0 5\n\n1 1 5\nNaN NaN\n1e16 0 5\n", 5, "a coordinate is not below 1e15");
    assert_refused(&il_reader_gmt, "\n# a\n> -Z5\n1 1\nb\n", 5, "'b' is no row: it begins with two numbers, x and y");
    assert_refused(&il_reader_bln, "\n2,1\n1,1\n\n2\n", 5,
                   "'2' is no point, x,y or x,y,z; it should be number 2 of the 2 points that line 2 says");
}

static void limits_hold(void **state)
{
    (void)state;
    static const char text[] = "x,y,z\n0,0,5\n1,0,5\n2,0,5\n";
    il_read_options o = IL_READ_OPTIONS_INIT;
    recorder r;
    il_error err = IL_ERROR_INIT;
    o.max_points = 2;
    assert_int_equal(read_with(&il_reader_csv, text, strlen(text), &o, &r, NULL, &err), IL_E_INPUT);
    assert_string_equal(err.text, "more than 2 points (--max-points)");
    assert_int_equal(err.line, 4);
    o.max_line = 20;
    il_error_clear(&err);
    static const char cells[] = "WKT,z\n\"LINESTRING (0 0,\n1 1)\",5\n";
    assert_int_equal(read_with(&il_reader_csv, cells, strlen(cells), &o, &r, NULL, &err), IL_E_INPUT);
    assert_string_equal(err.text, "a record of more than 20 bytes: a quote or a bracket in it may not be closed");
    assert_int_equal(err.line, 2);
}

static void zero_bytes_are_bytes(void **state)
{
    (void)state;
    static const char text[] = "x,y,z\n0,0,5\n\0,0,5\n1,\0001,5\n1,0,5\n0,0,6\n1,1,6\0\n1,2,6\n";
    il_read_options o = IL_READ_OPTIONS_INIT;
    recorder r;
    o.map.project = IL_PROJECT_NONE;
    assert_int_equal(read_with(&il_reader_csv, text, sizeof text - 1, &o, &r, NULL, NULL), IL_OK);
    assert_string_equal(r.out.s, "5: line 0 0 1 0\n6: line 0 0 1 2\n");
    free(r.out.s);
    assert_string_equal(format_of(text, sizeof text - 1), "");
}

/* ---- without memory -------------------------------------------------------------------------- */

static void assert_survives(const il_reader *reader, const char *text)
{
    il_status st = IL_E_NOMEM;
    long k = 0;
    for (; st == IL_E_NOMEM && k < 1000; k++) {
        const il_read_options options = IL_READ_OPTIONS_INIT;
        il_source *source = NULL;
        recorder r = nothing;
        assert_int_equal(il_source_from_memory(&source, text, strlen(text), "m", NULL), IL_OK);
        il_alloc_test_fail_after(k);
        st = reader->read(&source, 1, &options, &r.sink, NULL, NULL);
        il_alloc_test_fail_after(-1);
        il_source_close(source);
        free(r.out.s);
    }
    assert_int_equal(st, IL_OK);
    assert_true(k > 5);
}

static void every_failing_allocation_is_survived(void **state)
{
    (void)state;
    assert_survives(&il_reader_gmt, "# @VGMT1.0 @GPOLYGON @Je27700\n# @Nname|elev\n"
                                    ">\n# @D\"a\"|5\n0 0\n9 0\n9 9\n>\n# @Db|6\n1 1\n2 1\n2 2\n");
    assert_survives(&il_reader_gmt, "0 0 5\n9 0 5\n9 9 5\n0 0 6\n9 0 6\n");
    assert_survives(&il_reader_csv, "elev,geom,note\n5,\"LINESTRING (0 0,\n9 0,9 9)\",\"a\"\"b\"\n6,SRID=27700;POLYGON((0 0,1 1,1 0)),b\n");
    assert_survives(&il_reader_csv, "# line x y elev\na 0 0 5\na 9 0 5\na 9 9 5\nb 0 0 6\nb 9 0 6\n");
    assert_survives(&il_reader_csv, "x;y;z\n0,5;0;5\n9;0;5\n9;9,5;5\n0;0;6\n9;0;6\n");
    assert_survives(&il_reader_bln, "2,1,\"5\"\n0,0\n9,9\n2,1,\"6\"\n0,0\n9,9\n");
}

/* Without memory the probe of tables tells of no format, and look says why. */
static void a_probe_without_memory_says_no(void **state)
{
    (void)state;
    static const char text[] = "x,y,z\n0,0,5\n1,0,5\n";
    for (long k = 0; k < 8; k++) {
        il_alloc_test_fail_after(k);
        bool is = il_reader_csv.probe((const unsigned char *)text, sizeof text - 1), is_now = true;
        il_alloc_test_fail_after(k);
        il_status st = il_reader_csv.look((const unsigned char *)text, sizeof text - 1, &is_now, NULL);
        il_alloc_test_fail_after(-1);
        assert_int_equal(is_now, is);
        assert_int_equal(st, is ? IL_OK : IL_E_NOMEM);
    }
    assert_true(il_reader_csv.probe((const unsigned char *)text, sizeof text - 1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forms_are_told_apart),
        cmocka_unit_test(no_two_of_them_take_the_same_head),
        cmocka_unit_test(the_same_lines_come_out_of_every_form),
        cmocka_unit_test(a_gap_is_ten_usual_steps),
        cmocka_unit_test(long_steps_of_simplified_lines_are_no_gaps),
        cmocka_unit_test(few_rows_have_no_gaps),
        cmocka_unit_test(a_line_ends_where_it_is_closed),
        cmocka_unit_test(numbers_of_lines_divide_and_nothing_else_does),
        cmocka_unit_test(rows_that_are_left_out_are_counted_with_their_lines),
        cmocka_unit_test(lines_of_text_are_those_of_the_file),
        cmocka_unit_test(limits_hold),
        cmocka_unit_test(zero_bytes_are_bytes),
        cmocka_unit_test(every_failing_allocation_is_survived),
        cmocka_unit_test(a_probe_without_memory_says_no),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
