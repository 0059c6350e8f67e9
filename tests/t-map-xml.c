/* KML and GPX: how they are told from other XML, what their limits are, and texts that
 * lie across the ends of blocks.  What they mean is in formats/kml and formats/gpx. */
#include "config.h"
#include "base/alloc.h"
#include "input/reader.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- texts ------------------------------------------------------------------------- */

typedef struct text {
    char *s;
    size_t n, cap;
} text;

static void say(text *t, const char *s)
{
    size_t n = strlen(s);
    if (t->n + n + 1 > t->cap) {
        t->cap = 2 * (t->n + n + 1);
        t->s = realloc(t->s, t->cap);
        assert_non_null(t->s);
    }
    memcpy(t->s + t->n, s, n + 1);
    t->n += n;
}

static void repeat(text *t, const char *s, size_t times)
{
    for (size_t i = 0; i < times; i++)
        say(t, s);
}

/* ---- a sink that keeps the points ----------------------------------------------------- */

enum { MOST_POINTS = 20000 };

typedef struct keeper {
    il_sink sink;
    double xyz[3 * MOST_POINTS];
    size_t n, n_lines, n_closed;
} keeper;

static il_status on_stack(il_sink *self, const il_stack_head *head, il_error *err)
{
    (void)self, (void)head, (void)err;
    return IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    keeper *k = (keeper *)self;
    (void)err;
    for (size_t i = 0; i < s->n; i++) {
        k->n_lines++;
        k->n_closed += s->ring[i].open ? 0 : 1;
        for (size_t v = 0; v < s->ring[i].n && k->n < MOST_POINTS; v++, k->n++) {
            memcpy(k->xyz + 3 * k->n, s->ring[i].xy + 2 * v, 2 * sizeof *k->xyz);
            k->xyz[3 * k->n + 2] = s->z;
        }
    }
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *p, il_error *err)
{
    (void)self, (void)p, (void)err;
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    (void)self, (void)err;
    return IL_OK;
}

static il_read_options as_they_are(void)
{
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.map.project = IL_PROJECT_NONE;
    return o;
}

static il_status read_text(const il_reader *r, const text *t, const il_read_options *o, keeper *k, il_report *report, il_error *err)
{
    il_source *source = NULL;
    *k = (keeper){ .sink = { on_stack, on_slice, on_pair, on_end, on_end } };
    il_status st = il_source_from_memory(&source, t->s, t->n, "t.xml", err);
    if (st == IL_OK)
        st = r->read(&source, 1, o, &k->sink, report, err);
    il_source_close(source);
    return st;
}

static keeper kept; /* large */

static void assert_refused(const il_reader *r, const text *t, const il_read_options *o, long line, const char *why)
{
    il_error err = IL_ERROR_INIT;
    assert_int_equal(read_text(r, t, o, &kept, NULL, &err), IL_E_INPUT);
    if (!strstr(err.text, why))
        fail_msg("expected '%s', but got '%s'", why, err.text);
    assert_int_equal(err.line, line);
}

/* ---- the probe ------------------------------------------------------------------------- */

static const il_reader *detect(const char *s, size_t n, il_error *err)
{
    const il_reader *r = NULL;
    il_source *source = NULL;
    assert_int_equal(il_source_from_memory(&source, s, n, "x", err), IL_OK);
    il_status st = il_reader_detect(source, &r, err);
    il_source_close(source);
    assert_int_equal(st == IL_OK, r != NULL);
    return r;
}

static void files_are_known_by_their_first_element(void **state)
{
    static const struct { const char *text; const il_reader *reader; } files[] = {
        { "<kml/>", &il_reader_kml },
        { "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!-- <svg> -->\n<kml xmlns=\"k\">", &il_reader_kml },
        { "<k:kml xmlns:k=\"k\">", &il_reader_kml },
        { "<!DOCTYPE kml SYSTEM \"k.dtd\"><kml>", &il_reader_kml },
        { "<Placemark>", &il_reader_kml },
        { "<Document><name>a</name><Placemark>", &il_reader_kml },
        { "<Folder xmlns=\"http://earth.google.com/kml/2.1\">", &il_reader_kml },
        { "<kml><svg/>", &il_reader_kml },
        { "<gpx version='1.1'>", &il_reader_gpx },
        { "<?xml version=\"1.0\"?><g:gpx>", &il_reader_gpx },
        { "<svg><kml/>", &il_reader_svg },
        { "<svg><Placemark>", &il_reader_svg },
        { "<gpx-file><NativeDicomModel>", &il_reader_dicom_xml },
        { "<Document><NativeDicomModel>", &il_reader_dicom_xml },
        { "<Document><p>a page</p>", NULL }, { "<agpx>", NULL }, { "<kmlx>", NULL }, { "<html><kml>", NULL },
        { "<!DOCTYPE html><kml>", NULL }, { "kml", NULL }, { "<kml", &il_reader_kml } };
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        il_error err = IL_ERROR_INIT;
        const il_reader *r = detect(files[i].text, strlen(files[i].text), &err);
        if (r != files[i].reader)
            fail_msg("%s is %s", files[i].text, r ? r->name : "nothing");
    }
}

static void a_zip_archive_is_called_one(void **state)
{
    static const char zip[] = "PK\003\004\024\0\0\0\b\0", empty[] = "PK\005\006\0\0\0\0";
    (void)state;
    for (int i = 0; i < 2; i++) {
        il_error err = IL_ERROR_INIT;
        assert_null(i == 0 ? detect(zip, sizeof zip - 1, &err) : detect(empty, sizeof empty - 1, &err));
        assert_int_equal(err.code, IL_E_INPUT);
        assert_non_null(strstr(err.text, "unzip it first"));
    }
    il_error err = IL_ERROR_INIT;
    assert_null(detect("PKZIP was here", 14, &err));
    assert_null(strstr(err.text, "zip archive"));
}

/* ---- blocks --------------------------------------------------------------------------------- */

#define KML_LINE(z) "<Placemark><name>" #z "</name><LineString><coordinates>"
#define KML_END "</coordinates></LineString></Placemark>"

/* A line of N places: x = i / 8, y = -i / 16, one in four followed by a line end. */
static void places(text *t, int n)
{
    char s[100];
    for (int i = 0; i < n; i++) {
        snprintf(s, sizeof s, "%.3f,%.4f%s", (double)i / 8, (double)-i / 16, i % 4 == 3 ? "\n" : " ");
        say(t, s);
    }
}

static void assert_places(const keeper *k, int n)
{
    for (int i = 0; i < n; i++)
        if (k->xyz[3 * i] != (double)i / 8 || k->xyz[3 * i + 1] != (double)-i / 16)
            fail_msg("place %d is %g %g", i, k->xyz[3 * i], k->xyz[3 * i + 1]);
}

/* Whatever byte of them the end of a block falls on. */
static void coordinates_do_not_depend_on_blocks(void **state)
{
    enum { N = 9000, SHIFTS = 40 };
    const il_read_options o = as_they_are();
    (void)state;
    for (size_t shift = 0; shift < SHIFTS; shift++) {
        text t = { NULL, 0, 0 };
        il_error err = IL_ERROR_INIT;
        say(&t, "<kml>");
        repeat(&t, " ", shift);
        say(&t, KML_LINE(1));
        places(&t, N);
        say(&t, KML_END KML_LINE(2) "1,2,7 3,4,7" KML_END "</kml>");
        assert_int_equal(read_text(&il_reader_kml, &t, &o, &kept, NULL, &err), IL_OK);
        assert_int_equal(kept.n, N + 2);
        assert_places(&kept, N);
        free(t.s);
    }
}

static void comments_do_not_part_numbers(void **state)
{
    const il_read_options o = as_they_are();
    text t = { NULL, 0, 0 };
    il_error err = IL_ERROR_INIT;
    (void)state;
    say(&t, KML_LINE(1) "0.0");
    for (int i = 0; i < 3000; i++)
        say(&t, i % 2 ? "0<!--\n-->0" : "0<![CDATA[0]]>");
    say(&t, ",-0 .125,-.0625" KML_END KML_LINE(2) "1,2 3,4" KML_END);
    assert_int_equal(read_text(&il_reader_kml, &t, &o, &kept, NULL, &err), IL_OK);
    assert_places(&kept, 2);
    free(t.s);
}

static void errors_in_long_coordinates_tell_their_line(void **state)
{
    const il_read_options o = as_they_are();
    (void)state;
    for (int n = 4; n < 40000; n = 3 * n + 4) {
        text t = { NULL, 0, 0 };
        say(&t, "<kml\n>" KML_LINE(1) "\n<!--\n-->");
        places(&t, n - n % 4);
        say(&t, "1,2 x,4\n5,6" KML_END "\n\n</kml>");
        assert_refused(&il_reader_kml, &t, &o, 4 + n / 4, "'x' is not a finite number");
        free(t.s);
    }
}

static void what_looks_like_a_line_end_leads_no_farther_than_the_file(void **state)
{
    static const char *const ends[] = { "&#10;", "&#xA;", "\r" };
    const il_read_options o = as_they_are();
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        text t = { NULL, 0, 0 }, u = { NULL, 0, 0 };
        say(&t, KML_LINE(1));
        repeat(&t, ends[i], 100);
        say(&t, "1,2\n1,x" KML_END);
        assert_refused(&il_reader_kml, &t, &o, 2, "'x' is not");
        say(&u, "<gpx><trk><name>");
        repeat(&u, ends[i], 100);
        say(&u, "</name>\n</gpx>");
        assert_refused(&il_reader_gpx, &u, &o, 2, "not well-formed");
        free(t.s), free(u.s);
    }
}

static void track_points_do_not_depend_on_blocks(void **state)
{
    enum { N = 2000 };
    const il_read_options o = as_they_are();
    text t = { NULL, 0, 0 };
    il_error err = IL_ERROR_INIT;
    char s[200];
    (void)state;
    say(&t, "<gpx><trk><trkseg>");
    for (int i = 0; i < N; i++) {
        snprintf(s, sizeof s, "<trkpt lat='%.4f' lon='%.3f'>\n<ele>%s100</ele></trkpt>\n", (double)-i / 16, (double)i / 8,
                 i % 2 ? "<!-- --> " : "");
        say(&t, s);
    }
    say(&t, "</trkseg></trk><rte><name>9</name><rtept lat='1' lon='2'><ele>110</ele></rtept>"
            "<rtept lat='1' lon='3'><ele>110</ele></rtept></rte></gpx>");
    assert_int_equal(read_text(&il_reader_gpx, &t, &o, &kept, NULL, &err), IL_OK);
    assert_int_equal(kept.n, N + 2);
    assert_places(&kept, N);
    free(t.s);
}

/* ---- limits -------------------------------------------------------------------------------------- */

static void nesting_is_limited(void **state)
{
    il_read_options o = as_they_are();
    (void)state;
    for (int i = 0; i < 2; i++) {
        text t = { NULL, 0, 0 };
        say(&t, i == 0 ? "<kml>\n" : "<gpx>\n");
        repeat(&t, "<a>", 100000);
        assert_refused(i == 0 ? &il_reader_kml : &il_reader_gpx, &t, &o, 2, "nested more than 1000 deep");
        free(t.s);
    }
}

static void texts_are_limited(void **state)
{
    static const char *const before[] = { "<kml><Placemark><name>", "<kml><Placemark><description>",
        "<kml><Placemark><LineString><coordinates>", "<gpx><trk><name>", "<gpx><rte><rtept lat='1' lon='1'><ele>" };
    il_read_options o = as_they_are();
    o.max_line = 70000;
    (void)state;
    for (size_t i = 0; i < sizeof before / sizeof *before; i++) {
        text t = { NULL, 0, 0 };
        say(&t, before[i]);
        repeat(&t, "1234567890", 20000);
        assert_refused(before[i][1] == 'k' ? &il_reader_kml : &il_reader_gpx, &t, &o, 1, "of more than 70000 bytes");
        free(t.s);
    }
}

static void points_are_limited(void **state)
{
    il_read_options o = as_they_are();
    text t = { NULL, 0, 0 };
    o.max_points = 3;
    (void)state;
    say(&t, KML_LINE(1) "1,2 3,4\n5,6\n7,8" KML_END);
    assert_refused(&il_reader_kml, &t, &o, 3, "more than 3 points");
    free(t.s);
}

/* A description of nothing but beginnings of tags has no end of one to look for. */
static void half_tags_are_text(void **state)
{
    const il_read_options o = as_they_are();
    text t = { NULL, 0, 0 };
    il_error err = IL_ERROR_INIT;
    (void)state;
    say(&t, "<kml><Placemark><description><![CDATA[");
    repeat(&t, "<a", 500000);
    say(&t, "]]></description><LineString><coordinates>1,2,3 4,5,3" KML_END KML_LINE(2) "1,2,4 3,4,4" KML_END "</kml>");
    assert_int_equal(read_text(&il_reader_kml, &t, &o, &kept, NULL, &err), IL_OK);
    assert_int_equal(kept.n_lines, 2);
    free(t.s);
}

/* A line without a height is left out before degrees are looked at. */
static void what_is_left_out_needs_no_place(void **state)
{
    const il_read_options o = IL_READ_OPTIONS_INIT;
    text t = { NULL, 0, 0 };
    il_error err = IL_ERROR_INIT;
    (void)state;
    say(&t, "<kml>" KML_LINE(a) "7,100 8,100" KML_END KML_LINE(b) "7,50,100 7.01,50,100" KML_END);
    say(&t, KML_LINE(c) "7,50.1,110 7.01,50.1,110" KML_END "</kml>");
    assert_int_equal(read_text(&il_reader_kml, &t, &o, &kept, NULL, &err), IL_OK);
    assert_int_equal(kept.n_lines, 2);
    free(t.s);
}

/* ---- what is told ----------------------------------------------------------------------------------- */

static void assert_skipped(const il_report *r, size_t k, long line, const char *what)
{
    assert_true(k < r->n_skips);
    assert_string_equal(r->skip[k].what, what);
    assert_int_equal(r->skip[k].line, line);
}

static void what_is_left_out_is_counted(void **state)
{
    const il_read_options o = as_they_are();
    il_report report = IL_REPORT_INIT;
    il_error err = IL_ERROR_INIT;
    text t = { NULL, 0, 0 };
    (void)state;
    say(&t, "<kml>\n<NetworkLink><Placemark><LineString/></Placemark></NetworkLink>\n<Placemark><Model/>\n<Point/><LineString/>\n");
    say(&t, "<gx:Track xmlns:gx='g'>\n<gx:coord/></gx:Track></Placemark>");
    say(&t, KML_LINE(1) "1,2,3 4,5,3" KML_END KML_LINE(2) "1,2,4" KML_END "</kml>");
    assert_int_equal(read_text(&il_reader_kml, &t, &o, &kept, &report, &err), IL_OK);
    assert_int_equal(report.n_skipped, 6);
    assert_skipped(&report, 0, 2, "NetworkLink");
    assert_skipped(&report, 1, 3, "Model");
    assert_skipped(&report, 2, 4, "line");
    assert_skipped(&report, 3, 6, "gx:coord");
    il_report_free(&report);
    free(t.s);
}

static void any_failing_allocation_is_told(void **state)
{
    static const char *const maps[] = {
        "<kml><Folder><name>f</name><Placemark><name>1</name><description>a: b</description><ExtendedData><Data name='elev'>"
        "<value>7</value></Data></ExtendedData><LineString><coordinates>1,2 3<!-- -->1,4</coordinates></LineString></Placemark>"
        "<Placemark><Data name='elev'><value>8</value></Data><LinearRing><coordinates>1,2 3,4 5,7</coordinates></LinearRing>"
        "</Placemark></Folder></kml>",
        "<gpx><trk><name>n</name><extensions><elev>7</elev></extensions><trkseg><trkpt lat='1' lon='2'><ele>3</ele></trkpt>"
        "<trkpt lat='1' lon='3'/></trkseg></trk><rte><elev>8</elev><rtept lat='1' lon='3'/><rtept lat='1' lon='4'/></rte></gpx>" };
    const il_read_options o = as_they_are();
    (void)state;
    for (int i = 0; i < 2; i++) {
        il_status st = IL_E_NOMEM;
        text t = { NULL, 0, 0 };
        say(&t, maps[i]);
        for (long n = 0; st != IL_OK && n < 1000; n++) {
            il_error err = IL_ERROR_INIT;
            il_alloc_test_fail_after(n);
            st = read_text(i == 0 ? &il_reader_kml : &il_reader_gpx, &t, &o, &kept, NULL, &err);
            il_alloc_test_fail_after(-1);
            assert_int_equal(st, st == IL_OK && n > 10 ? IL_OK : IL_E_NOMEM);
        }
        assert_int_equal(st, IL_OK);
        assert_int_equal(kept.n_lines, 2);
        free(t.s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_known_by_their_first_element),
        cmocka_unit_test(a_zip_archive_is_called_one),
        cmocka_unit_test(coordinates_do_not_depend_on_blocks),
        cmocka_unit_test(comments_do_not_part_numbers),
        cmocka_unit_test(errors_in_long_coordinates_tell_their_line),
        cmocka_unit_test(what_looks_like_a_line_end_leads_no_farther_than_the_file),
        cmocka_unit_test(track_points_do_not_depend_on_blocks),
        cmocka_unit_test(nesting_is_limited),
        cmocka_unit_test(texts_are_limited),
        cmocka_unit_test(points_are_limited),
        cmocka_unit_test(half_tags_are_text),
        cmocka_unit_test(what_is_left_out_needs_no_place),
        cmocka_unit_test(what_is_left_out_is_counted),
        cmocka_unit_test(any_failing_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
