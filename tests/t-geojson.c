/* t-geojson.c - how GeoJSON is told from other texts, what is counted and told, and
 * input that is large, or for which there is no memory. */
#include "config.h"
#include "base/alloc.h"
#include "input/reader.h"
#include "test.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- what comes out -------------------------------------------------------------- */

/* Points and lines, and the sum of all coordinates. */
typedef struct counter {
    il_sink sink;
    size_t points, lines, levels;
    double sum;
} counter;

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self, (void)head, (void)err;
    return IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    counter *c = (counter *)self;
    (void)err;
    c->levels++;
    c->lines += s->n;
    for (size_t i = 0; i < s->n; i++) {
        c->points += s->ring[i].n;
        for (size_t v = 0; v < 2 * s->ring[i].n; v++)
            c->sum += s->ring[i].xy[v];
    }
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

static il_status read_bytes(const char *text, size_t n, counter *c, il_report *report, il_error *err)
{
    const il_read_options options = IL_READ_OPTIONS_INIT;
    il_source *source;
    *c = (counter){ .sink = { on_stack, on_slice, on_pair, on_end, on_end } };
    assert_int_equal(il_source_from_memory(&source, text, n, "m", NULL), IL_OK);
    il_status st = il_reader_geojson.read(&source, 1, &options, &c->sink, report, err);
    il_source_close(source);
    return st;
}

static void assert_refused(const char *text, long line, const char *words)
{
    counter c;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(read_bytes(text, strlen(text), &c, NULL, &err), IL_E_INPUT);
    assert_string_equal(err.text, words);
    assert_int_equal(err.line, line);
}

/* ---- texts that are too long to be written here -------------------------------------- */

typedef struct buffer {
    char *s;
    size_t n, cap;
} buffer;

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

static const char two[] = "{\"type\":\"MultiLineString\",\"coordinates\":["
                          "[[0,0,10],[900,0,10],[0,900,10]],[[0,0,20],[800,0,20],[0,800,20]]]}";

/* ---- telling it apart ------------------------------------------------------------------ */

static const char *format_of(const char *text, size_t n)
{
    const il_reader *reader = NULL;
    il_source *source;
    assert_int_equal(il_source_from_memory(&source, text, n, "m", NULL), IL_OK);
    il_status st = il_reader_detect(source, &reader, NULL);
    il_source_close(source);
    return st == IL_OK ? reader->name : "";
}

static void geojson_is_told_from_other_texts(void **state)
{
    (void)state;
    static const char *const yes[] = {
        "{\"type\":\"FeatureCollection\"}", "{}", " \n{ }", "\xef\xbb\xbf{\"a\":", "[{\"type\":", "{\"a\\\"b\" :",
        "var x = {\"a\":1}", "let x={ \"a\" : 1", "const x = [ {\"a\":1", "x = {\"a\":", "a.b.c={\"a\":", "show({\"a\":1})",
        "var x = { type: 1 }", "export const x = {", "{\"type\":\"Feature\"}\n", "{\"type\":\"Feature\"}{\"type\":\"Feature\"}",
        "{\"type\":\n\"Feature\"}\n{\"type\":\"Feature\"}", "{\"00080005\":[]}" };
    static const char *const no[] = {
        "", "{", "[", "[]", "[1,2]", "{a:1}", "{'a':1}", "{\"a\"", "{\"a\" 1", "\"type\"", "var x", "var x = 1", "x = { a }",
        "show(1)", "f(x) = {\"a\":1}", "var x({\"a\":1})", "x,y,z\n1,2,3\n", "> -Z100\n0 0\n", "LINESTRING (0 0, 1 1)",
        "{\"00080005\":{\"vr\":\"CS\"}}", "id;{\"a\":1}", "= {\"a\":1}", "1 2 3\n{\"a\":1}" };
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++)
        if (strcmp(format_of(yes[i], strlen(yes[i])), "geojson") != 0)
            fail_msg("%s", yes[i]);
    for (size_t i = 0; i < sizeof no / sizeof *no; i++)
        if (strncmp(format_of(no[i], strlen(no[i])), "geojson", 7) == 0)
            fail_msg("%s", no[i]);
}

static void a_sequence_is_told_by_its_second_line_or_its_separator(void **state)
{
    (void)state;
    static const char *const yes[] = {
        "{\"type\":\"Feature\"}\n{", "\n {\"a}\":\"}\\\"\"} \r\n\n  {\"a", "\x1e{\"a\":\n1}", "\xef\xbb\xbf\n\x1e\x1e {\"a\":",
        "{\"a\":[{},[]]}\n{\"b\"" };
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++)
        if (strcmp(format_of(yes[i], strlen(yes[i])), "geojsonseq") != 0)
            fail_msg("%s", yes[i]);
}

/* Then it may be taken for one text, and is read whole as well. */
static void a_sequence_with_a_long_first_line_is_read_whole(void **state)
{
    (void)state;
    buffer b = { 0 };
    counter c;
    for (int level = 0; level < 3; level++) {
        put(&b, "{\"type\":\"LineString\",\"coordinates\":[");
        for (int k = 0; k < 1000; k++)
            put(&b, "%s[%d,%d,%d]", k ? "," : "", 100 * k, 5000, 10 * level);
        put(&b, "]}\n");
    }
    assert_int_equal(strncmp(format_of(b.s, b.n), "geojson", 7), 0);
    assert_int_equal(read_bytes(b.s, b.n, &c, NULL, NULL), IL_OK);
    assert_int_equal(c.levels, 3);
    assert_int_equal(c.points, 3000);
    free(b.s);
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

static void what_is_left_out_is_counted_with_its_line(void **state)
{
    (void)state;
    static const char text[] =
        "{\"type\":\"FeatureCollection\",\"features\":[\n"
        "{\"type\":\"Feature\",\"geometry\":null},\n"
        "{\"type\":\"Feature\"},\n"
        "null,\n"
        "{\"type\":\"GeometryCollection\",\"geometries\":[]},\n"
        "{\"type\":\"GeometryCollection\",\"geometries\":[null]},\n"
        "{\"type\":\"LineString\",\"coordinates\":[]},{\"coordinates\":[[]],\"type\":\"Polygon\"},\n"
        "{\"type\":\"Polygon\",\"coordinates\":[[]]},\n"
        "{\"type\":\"MultiPolygon\",\"coordinates\":[[]]},\n"
        "{\"type\":\"MultiPoint\",\"coordinates\":[[1,2],[3,4]]},\n"
        "{\"type\":\"MultiLineString\",\"coordinates\":[[[0,0,10],[9,0,10]],[[0,0,20],[9,0,20]]]}\n"
        "]}\n";
    il_report r = IL_REPORT_INIT;
    counter c;
    assert_int_equal(read_bytes(text, strlen(text), &c, &r, NULL), IL_OK);
    assert_skip(&r, 0, 2, 2, "feature: has no geometry");
    assert_skip(&r, 1, 4, 1, "feature: is null");
    assert_skip(&r, 2, 5, 1, "geometry: is an empty collection");
    assert_skip(&r, 3, 6, 1, "geometry: is null");
    assert_skip(&r, 4, 7, 2, "geometry: has no coordinates");
    assert_skip(&r, 5, 8, 1, "line: has no coordinates");
    assert_skip(&r, 6, 9, 1, "polygon: has no coordinates");
    assert_skip(&r, 7, 10, 2, "point: a point by itself is no isoline");
    assert_int_equal(r.n_skips, 8);
    assert_int_equal(r.n_skipped, 11);
    assert_int_equal(c.lines, 2);
    il_report_free(&r);
}

static bool is_told(const char *text, const char *words)
{
    il_report r = IL_REPORT_INIT;
    counter c;
    size_t n = 0;
    assert_int_equal(read_bytes(text, strlen(text), &c, &r, NULL), IL_OK);
    for (size_t k = 0; k < r.n_notes; k++)
        n += strcmp(r.note[k], words) == 0;
    il_report_free(&r);
    assert_true(n <= 1);
    return n == 1;
}

static void what_is_passed_over_is_told_once(void **state)
{
    (void)state;
    static const char m[] = "{\"type\":\"MultiLineString\",\"coordinates\":[[[0,0,10,1],[9,0,10,2]],[[0,0,20,3],[9,0,20,4]]]}";
    char text[1000];
    snprintf(text, sizeof text, "%s%s", m, m);
    assert_true(is_told(text, "m: positions of more than three numbers; those behind the third are passed over"));
    snprintf(text, sizeof text, "\n var\nx =\n%s;", two);
    assert_true(is_told(text, "m: the JavaScript around the JSON ('var\\x0ax =') is passed over"));
    snprintf(text, sizeof text, "%.*s,\n\"crs\":{\"type\":\"link\",\"properties\":{\"href\":\"x\"}}}", (int)strlen(two) - 1, two);
    assert_true(is_told(text, "m:2: the coordinate system is a link, which is not followed"));
    snprintf(text, sizeof text, "%.*s,\n\"crs\":[{\"name\":\"EPSG:1\"}]}", (int)strlen(two) - 1, two);
    assert_true(is_told(text, "m:2: the member crs names no coordinate system"));
}

/* ---- lines ----------------------------------------------------------------------------------- */

static void lines_count_on_behind_javascript_and_texts(void **state)
{
    (void)state;
    char text[1000];
    snprintf(text, sizeof text, "\n\nvar x\n=\n%s\n;\n", "{\"type\":\n5}");
    assert_refused(text, 6, "a type is no string");
    snprintf(text, sizeof text, "%s\n\x1e%s\n\n%s", two, two, "{\"type\":\"Line\"}");
    assert_refused(text, 4, "'Line' is no type of GeoJSON");
    snprintf(text, sizeof text, "%s", "{\"coordinates\":[\n[0,0],\n[1,1e15]\n],\n\"type\":\"LineString\"}");
    assert_refused(text, 3, "a coordinate is not below 1e15");
}

static void an_object_without_a_type_is_refused_by_what_it_has(void **state)
{
    (void)state;
    assert_refused("{\"properties\":{}}", 1, "an object of GeoJSON has no type (it has 'properties')");
    assert_refused("{\"properties\":{},\"geometry\":null}", 1, "an object of GeoJSON has no type (it has 'geometry')");
    assert_refused("{\"features\":[],\n\"spatialReference\":1}", 1,
                   "Esri JSON, not GeoJSON (its members are 'spatialReference'); ogr2ogr -f GeoJSONSeq makes what isoloft reads");
    assert_refused("{\"type\":\"FeatureCollection\",\"features\":[],\"rings\":1}", 0, "has no lines and no polygons, so no isolines");
}

static void zero_bytes_are_bytes(void **state)
{
    (void)state;
    static const char zero[] = "{\"type\":\"LineString\",\0\"coordinates\":[]}";
    counter c;
    il_error err = IL_ERROR_INIT;
    assert_int_equal(read_bytes(zero, sizeof zero - 1, &c, NULL, &err), IL_E_INPUT);
    assert_string_equal(err.text, "a key in quotes is expected, not a zero byte");
    assert_refused("{\"type\":\"Feature\\u0000\"}", 1, "'Feature' is no type of GeoJSON"); /* messages end there */
    assert_refused("{\"type\\u0000\":\"Feature\"}", 1, "JSON, but not GeoJSON: no type, and the members are 'type'");
}

/* ---- much of it ---------------------------------------------------------------------------------- */

/* Blocks of the source end everywhere in the text. */
static void many_positions_come_out_as_they_are_written(void **state)
{
    (void)state;
    enum { LEVELS = 7, POINTS = 30000 };
    buffer b = { 0 };
    counter c;
    double sum = 0;
    put(&b, "{\"type\":\"MultiLineString\",\"coordinates\":[");
    for (int level = 0; level < LEVELS; level++) {
        put(&b, "%s[", level ? " ,\n" : "");
        for (int k = 0; k < POINTS; k++) {
            put(&b, "%s[%d.5,%d,%d]", k ? ",  " : "", k * 1000, -k, level);
            sum += k * 1000 + 0.5 - k;
        }
        put(&b, "]");
    }
    put(&b, "],\"type_\":0}");
    assert_int_equal(read_bytes(b.s, b.n, &c, NULL, NULL), IL_OK);
    assert_int_equal(c.lines, LEVELS);
    assert_int_equal(c.points, LEVELS * POINTS);
    assert_true(c.sum == sum);
    free(b.s);
}

static void hostile_amounts_end_in_linear_time(void **state)
{
    (void)state;
    enum { MANY = 300000 };
    buffer b = { 0 };
    counter c;
    put(&b, "{\"type\":\"FeatureCollection\",\"features\":[%s,{\"type\":\"Feature\",\"geometry\":null,\"properties\":{", two);
    for (int k = 0; k < MANY; k++) /* names that are not wanted, and in all mixtures of cases one that is */
        put(&b, "%s\"p%d\":%d", k ? "," : "", k, k);
    for (int k = 0; k < 1 << 15; k++) {
        char name[] = "elevation_metres";
        for (int i = 0, bit = 0; name[i]; i++)
            name[i] = (char)(name[i] >= 'a' && k >> bit++ & 1 ? name[i] - 32 : name[i]);
        put(&b, ",\"%s\":%d", name, k);
    }
    put(&b, "}}");
    for (int k = 0; k < MANY; k++)
        put(&b, ",{\"type\":\"Feature\",\"geometry\":null}");
    put(&b, "]}");
    il_report r = IL_REPORT_INIT;
    assert_int_equal(read_bytes(b.s, b.n, &c, &r, NULL), IL_OK);
    assert_int_equal(r.n_skipped, MANY + 1);
    assert_int_equal(c.points, 6);
    il_report_free(&r);
    free(b.s);
}

static void every_failing_allocation_is_survived(void **state)
{
    (void)state;
    static const char text[] =
        "var x = {\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:27700\"}},\"features\":[\n"
        "{\"properties\":{\"elev\":10,\"height\":1},\n"
        "\"geometry\":{\"coordinates\":[[[0,0],[900,0],[0,900]]],\"type\":\"Polygon\"},\"type\":\"Feature\"},\n"
        "{\"type\":\"Feature\",\"properties\":{\"elev\":20},\n"
        "\"geometry\":{\"type\":\"LineString\",\"coordinates\":[[0,0],[800,0],[0,800]]}}\n"
        "],\"type\":\"FeatureCollection\"};";
    il_status st = IL_E_NOMEM;
    long k = 0;
    for (; st == IL_E_NOMEM && k < 500; k++) {
        const il_read_options options = IL_READ_OPTIONS_INIT;
        counter c = { .sink = { on_stack, on_slice, on_pair, on_end, on_end } };
        il_source *source = NULL;
        assert_int_equal(il_source_from_memory(&source, text, strlen(text), "m", NULL), IL_OK);
        il_alloc_test_fail_after(k);
        st = il_reader_geojson.read(&source, 1, &options, &c.sink, NULL, NULL);
        il_alloc_test_fail_after(-1);
        il_source_close(source);
    }
    assert_int_equal(st, IL_OK);
    assert_true(k > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(geojson_is_told_from_other_texts),
        cmocka_unit_test(a_sequence_is_told_by_its_second_line_or_its_separator),
        cmocka_unit_test(a_sequence_with_a_long_first_line_is_read_whole),
        cmocka_unit_test(what_is_left_out_is_counted_with_its_line),
        cmocka_unit_test(what_is_passed_over_is_told_once),
        cmocka_unit_test(lines_count_on_behind_javascript_and_texts),
        cmocka_unit_test(an_object_without_a_type_is_refused_by_what_it_has),
        cmocka_unit_test(zero_bytes_are_bytes),
        cmocka_unit_test(many_positions_come_out_as_they_are_written),
        cmocka_unit_test(hostile_amounts_end_in_linear_time),
        cmocka_unit_test(every_failing_allocation_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
