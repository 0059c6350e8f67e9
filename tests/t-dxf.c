/* t-dxf.c - what DXF drawings become: curves against closed forms, blocks, reports. */
#include "config.h"
#include "base/number.h"
#include "maps.h"

#include <math.h>
#include <stdlib.h>

static map m;
static char text[20000];
static size_t n_text;

/* "0 LINE,8 A" as the lines of a file behind what is there. */
static void add(const char *pairs)
{
    for (const char *p = pairs; *p; p += strspn(p, ",")) {
        size_t code = strcspn(p, " "), all = strcspn(p, ",");
        assert_true(n_text + all + 3 < sizeof text);
        n_text += (size_t)snprintf(text + n_text, sizeof text - n_text, "%.*s\n%.*s\n", (int)code, p,
                                   (int)(all > code ? all - code - 1 : 0), p + code + (all > code));
        p += all;
    }
}

static void begin(const char *pairs)
{
    n_text = 0;
    add(pairs);
}

/* A line at the height 0 in front, so that there are two levels. */
static void begin_entities(void)
{
    begin("0 SECTION,2 ENTITIES,0 LINE,8 0,10 0,20 0,11 1,21 7");
}

static il_status read_text(const il_read_options *o)
{
    return map_read(&m, &il_reader_dxf, text, n_text, "a.dxf", o);
}

static void read_entities(const char *pairs, double flatness)
{
    il_read_options o = IL_READ_OPTIONS_INIT;
    o.flatness = flatness;
    begin_entities();
    add(pairs);
    add("0 ENDSEC,0 EOF");
    if (read_text(&o) != IL_OK)
        fail_msg("%ld: %s", m.err.line, m.err.text);
    assert_int_equal(m.n, 2);
}

/* ---- curves ----------------------------------------------------------------------- */

/* The vertices of R lie on the circle, and its edges' middles within FLATNESS of it. */
static void assert_on_circle(const il_ring *r, double x, double y, double radius, double flatness)
{
    double farthest = 0;
    for (size_t k = 0; k + r->open < r->n; k++) {
        const double *p = r->xy + 2 * k, *q = r->xy + 2 * ((k + 1) % r->n);
        assert_true(fabs(hypot(p[0] - x, p[1] - y) - radius) < 1e-9 * radius);
        farthest = fmax(farthest, radius - hypot((p[0] + q[0]) / 2 - x, (p[1] + q[1]) / 2 - y));
    }
    assert_true(farthest <= flatness * (1 + 1e-9) && farthest > flatness / 5);
}

static void arcs_lie_within_the_flatness(void **state)
{
    static const double flatness[] = { 10, 1, 0.1, 0.003 };
    (void)state;
    for (size_t k = 0; k < sizeof flatness / sizeof *flatness; k++) {
        read_entities("0 CIRCLE,10 200,20 300,30 5,40 150", flatness[k]);
        assert_false(m.line[1].open);
        assert_on_circle(&m.line[1], 200, 300, 150, flatness[k]);
        read_entities("0 ARC,10 200,20 300,30 5,40 150,50 300,51 100", flatness[k]);
        assert_true(m.line[1].open);
        assert_on_circle(&m.line[1], 200, 300, 150, flatness[k]);
        read_entities("0 LWPOLYLINE,70 0,38 5,10 0,20 0,42 0.6,10 160,20 120", flatness[k]);
        /* the radius is chord (1 + b^2) / (4 b), the centre (1 - b^2) / (4 b) chords to the left */
        assert_on_circle(&m.line[1], 80 - 120 * 0.64 / 2.4, 60 + 160 * 0.64 / 2.4, 200 * 1.36 / 2.4, flatness[k]);
    }
}

static void without_a_flatness_curves_are_cut_by_their_size(void **state)
{
    (void)state;
    read_entities("0 CIRCLE,10 0,20 0,30 5,40 1", 0);
    assert_on_circle(&m.line[1], 0, 0, 1, 0.002);
    read_entities("0 CIRCLE,10 0,20 0,30 5,40 1000", 0);
    assert_on_circle(&m.line[1], 0, 0, 1000, 0.01);
    assert_noted(&m, "points were put on arcs and curves");
}

/* Cox and de Boor's basis functions, as they are defined. */
static double basis(const double *t, int i, int p, double u)
{
    if (p == 0)
        return t[i] <= u && u < t[i + 1] ? 1 : 0;
    double a = t[i + p] > t[i] ? (u - t[i]) / (t[i + p] - t[i]) * basis(t, i, p - 1, u) : 0;
    double b = t[i + p + 1] > t[i + 1] ? (t[i + p + 1] - u) / (t[i + p + 1] - t[i + 1]) * basis(t, i + 1, p - 1, u) : 0;
    return a + b;
}

static double distance_to(const il_ring *r, double x, double y)
{
    double nearest = INFINITY;
    for (size_t k = 0; k + r->open < r->n; k++) {
        const double *p = r->xy + 2 * k, *q = r->xy + 2 * ((k + 1) % r->n);
        double dx = q[0] - p[0], dy = q[1] - p[1], t = ((x - p[0]) * dx + (y - p[1]) * dy) / (dx * dx + dy * dy);
        t = fmin(fmax(t, 0), 1);
        nearest = fmin(nearest, hypot(x - p[0] - t * dx, y - p[1] - t * dy));
    }
    return nearest;
}

typedef struct bspline {
    int degree, n;
    double knot[20], x[12], y[12], w[12];
} bspline;

static void read_spline(const bspline *b, double flatness)
{
    char pairs[4000];
    int at = snprintf(pairs, sizeof pairs, "0 SPLINE,70 0,71 %d,72 %d,73 %d", b->degree, b->n + b->degree + 1, b->n);
    for (int i = 0; i <= b->n + b->degree; i++)
        at += snprintf(pairs + at, sizeof pairs - (size_t)at, ",40 %.17g", b->knot[i]);
    for (int i = 0; i < b->n; i++)
        at += snprintf(pairs + at, sizeof pairs - (size_t)at, ",41 %.17g", b->w[i]);
    for (int i = 0; i < b->n; i++)
        at += snprintf(pairs + at, sizeof pairs - (size_t)at, ",10 %.17g,20 %.17g,30 5.1", b->x[i], b->y[i]);
    read_entities(pairs, flatness);
}

/* All of the curve is near the polyline, and the polyline's vertices are near the curve. */
static void check_spline(const bspline *b, double flatness)
{
    enum { STEPS = 3000 };
    double low = b->knot[b->degree], high = b->knot[b->n], *curve = malloc(2 * STEPS * sizeof *curve);
    assert_non_null(curve);
    read_spline(b, flatness);
    assert_true(m.z[1] == 5.1);
    for (int k = 0; k < STEPS; k++) {
        double u = low + (high - low) * k / STEPS, x = 0, y = 0, w = 0;
        for (int i = 0; i < b->n; i++) {
            double f = b->w[i] * basis(b->knot, i, b->degree, u);
            x += f * b->x[i], y += f * b->y[i], w += f;
        }
        curve[2 * k] = x / w, curve[2 * k + 1] = y / w;
        assert_true(distance_to(&m.line[1], x / w, y / w) <= flatness);
    }
    il_ring fine = { .xy = curve, .n = STEPS, .open = true };
    for (size_t k = 0; k + 1 < m.line[1].n; k++)
        assert_true(distance_to(&fine, m.line[1].xy[2 * k], m.line[1].xy[2 * k + 1]) < 1e-3);
    free(curve);
}

static void splines_are_the_curves_of_their_definition(void **state)
{
    static const bspline splines[] = {
        { 3, 7, { 0, 0, 0, 0, 1, 1.5, 4, 5, 5, 5, 5 }, { 0, 30, 80, 90, 40, 60, 100 }, { 0, 50, 20, 90, 70, 10, 0 },
          { 1, 1, 1, 1, 1, 1, 1 } },
        { 3, 7, { 0, 0, 0, 0, 1, 1, 4, 5, 5, 5, 5 }, { 0, 30, 80, 90, 40, 60, 100 }, { 0, 50, 20, 90, 70, 10, 0 },
          { 1, 2, 0.3, 1, 5, 0.01, 1 } },
        { 2, 6, { -2, -1, 0, 1, 2, 3, 4, 9, 10 }, { 0, 30, 80, 90, 40, 60 }, { 0, 50, 20, 90, 70, 10 }, { 1, 1, 2, 1, 1, 1 } },
        { 5, 8, { 0, 0, 0, 0, 0, 0, 2, 3, 7, 7, 7, 7, 7, 7 }, { 0, 30, 80, 90, 40, 60, 20, 5 }, { 0, 50, 20, 90, 70, 10, 33, 9 },
          { 1, 1, 1, 1, 1, 1, 1, 1 } },
        { 1, 4, { 0, 0, 1, 2, 3, 3 }, { 0, 30, 80, 90 }, { 0, 50, 20, 90 }, { 1, 1, 1, 1 } },
    };
    (void)state;
    for (size_t k = 0; k < sizeof splines / sizeof *splines; k++) {
        check_spline(&splines[k], 2);
        check_spline(&splines[k], 0.01);
    }
}

/* ---- blocks -------------------------------------------------------------------------- */

/* A point through blocks within blocks, and by hand. */
static void places_are_put_together_from_the_inside_out(void **state)
{
    const double pi = 3.14159265358979323846;
    (void)state;
    begin("0 SECTION,2 BLOCKS,0 BLOCK,2 A,10 3,20 4,30 1,0 LINE,8 0,10 10,20 20,30 2,11 10,21 25,31 2,0 ENDBLK,"
          "0 BLOCK,2 B,10 -5,20 0,30 0,0 INSERT,2 A,10 7,20 8,30 9,41 2,42 -3,43 4,50 30,0 ENDBLK,0 ENDSEC,"
          "0 SECTION,2 ENTITIES,0 INSERT,2 B,10 100,20 200,30 300,50 -75,41 0.5,42 0.5,43 0.5,210 0,220 0,230 -1,"
          "0 LINE,8 0,10 0,20 0,11 1,21 1,0 ENDSEC,0 EOF");
    assert_int_equal(read_text(NULL), IL_OK);
    assert_int_equal(m.n, 2);
    double x = (10 - 3) * 2, y = (20 - 4) * -3, z = (2 - 1) * 4 + 9, s = sin(pi / 6), c = cos(pi / 6);
    double x2 = c * x - s * y + 7 + 5, y2 = s * x + c * y + 8;
    s = sin(-75 * pi / 180), c = cos(-75 * pi / 180);
    double x3 = c * x2 / 2 - s * y2 / 2 + 100, y3 = s * x2 / 2 + c * y2 / 2 + 200;
    assert_true(fabs(m.z[0] + z / 2 + 300) < 1e-9);
    assert_true(fabs(m.line[0].xy[0] + x3) < 1e-9 && fabs(m.line[0].xy[1] - y3) < 1e-9);
}

/* ---- what is told ---------------------------------------------------------------------- */

static void what_is_left_out_is_counted_by_its_name(void **state)
{
    (void)state;
    begin("0 SECTION,2 BLOCKS,0 BLOCK,2 A,0 TEXT,1 x,0 ENDBLK,0 ENDSEC");
    add("0 SECTION,2 ENTITIES,0 LINE,8 0,10 0,20 0,11 1,21 7,0 LINE,8 0,10 0,20 0,30 5,11 1,21 7,31 5,"
        "0 TEXT,1 x,0 TEXT,1 y,0 HATCH,10 a,0 POINT,10 1,20 2,0 LINE,67 1,10 0,0 LINE,60 1,10 0,0 POLYLINE,70 64,0 SEQEND,"
        "0 INSERT,2 A,0 INSERT,2 A,0 INSERT,2 GONE,0 CIRCLE,40 0,0 LWPOLYLINE,10 0,20 0,210 1,220 0,230 1,0 LWPOLYLINE,70 0,"
        "0 ENDSEC,0 EOF");
    assert_int_equal(read_text(NULL), IL_OK);
    assert_skipped(&m, 4, "TEXT", "is no line", 49); /* two of them by INSERT */
    assert_skipped(&m, 1, "HATCH", "is no line", 57);
    assert_skipped(&m, 1, "point", "a point by itself is no isoline", 61);
    assert_skipped(&m, 1, "LINE", "is in paper space", 67);
    assert_skipped(&m, 1, "LINE", "is hidden", 73);
    assert_skipped(&m, 1, "POLYLINE", "is a mesh", 79);
    assert_skipped(&m, 1, "INSERT", "its block is not in the file", 93);
    assert_skipped(&m, 1, "CIRCLE", "has no radius above 0", 97);
    assert_skipped(&m, 1, "LWPOLYLINE", "lies in a tilted plane", 101);
    assert_skipped(&m, 1, "line", "has no points", 113);
    assert_int_equal(m.report.n_skipped, 13);
}

static void layers_that_are_not_chosen_are_told(void **state)
{
    static const char *patterns[] = { "?ont*", "ELEV", "!*DRAFT" };
    il_read_options o = IL_READ_OPTIONS_INIT;
    (void)state;
    o.map.layer = patterns;
    o.map.n_layers = 3;
    begin("0 SECTION,2 TABLES,0 TABLE,2 LAYER,0 LAYER,2 contours,70 1,62 7,0 LAYER,2 FRAME,70 0,62 -3,0 ENDTAB,0 ENDSEC");
    add("0 SECTION,2 ENTITIES,0 LINE,8 CONTOURS,10 0,20 0,11 1,21 7,0 LINE,8 Contours2,10 0,20 0,30 5,11 1,21 7,31 5,"
        "0 LINE,8 FRAME,10 0,20 0,30 9,11 1,21 7,31 9,0 TEXT,8 FRAME,1 x,0 LINE,8 contours,10 0,20 1,11 3,21 7,"
        "0 ENDSEC,0 EOF");
    if (read_text(&o) != IL_OK)
        fail_msg("%s", m.err.text);
    assert_int_equal(m.n, 3);
    assert_noted(&m, "2 entities on layers that --layer does not choose are left out");
    assert_noted(&m, "no layer matches 'ELEV'");
    assert_noted(&m, "no layer matches '*DRAFT'");
    assert_noted(&m, "off or frozen are read all the same: 'contours'");
    assert_int_equal(m.report.n_skipped, 0);
}

static void names_of_layers_are_shown_and_never_obeyed(void **state)
{
    static const char *patterns[] = { "none" };
    il_read_options o = IL_READ_OPTIONS_INIT;
    (void)state;
    o.map.layer = patterns;
    o.map.n_layers = 1;
    begin("0 SECTION,2 ENTITIES,0 LINE,8 a\x1b[2Jb,10 0");
    for (int k = 0; k < 20; k++) {
        char pairs[300];
        snprintf(pairs, sizeof pairs, "0 LINE,8 layer %d %0200d", k, k);
        add(pairs);
    }
    add("0 ENDSEC,0 EOF");
    assert_int_equal(read_text(&o), IL_E_INPUT);
    assert_non_null(strstr(m.err.text, "'a\\x1b[2Jb', 'layer 0 0000"));
    assert_non_null(strstr(m.err.text, " and 13 more"));
}

static void units_are_told_and_inches_not_believed(void **state)
{
    static const struct { int number; il_unit unit; const char *words; } units[] = {
        { 0, IL_UNIT_M, NULL }, { 1, IL_UNIT_M, "says inches" }, { 2, IL_UNIT_FT, NULL }, { 3, IL_UNIT_M, "none that isoloft has" },
        { 4, IL_UNIT_MM, NULL }, { 5, IL_UNIT_CM, NULL }, { 6, IL_UNIT_M, NULL }, { 7, IL_UNIT_KM, NULL }, { 13, IL_UNIT_UM, NULL },
        { 21, IL_UNIT_FT, "US survey feet" } };
    (void)state;
    for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
        char pairs[100];
        snprintf(pairs, sizeof pairs, "0 SECTION,2 HEADER,9 $INSUNITS,70 %d,9 $OTHER,70 5,0 ENDSEC,0 SECTION,2 ENTITIES", units[k].number);
        begin(pairs);
        add("0 LINE,8 0,10 0,20 0,11 1,21 7,0 LINE,8 0,10 0,20 0,30 5,11 1,21 7,31 5,0 ENDSEC,0 EOF");
        assert_int_equal(read_text(NULL), IL_OK);
        assert_int_equal(m.unit, units[k].unit);
        if (units[k].words)
            assert_noted(&m, units[k].words);
        else
            assert_not_noted(&m, "INSUNITS");
    }
}

static void splines_with_fit_points_only_are_told(void **state)
{
    (void)state;
    read_entities("0 SPLINE,70 8,71 3,74 3,11 0,21 0,31 5,11 9,21 1,31 5,11 7,21 8,31 5", 0);
    assert_noted(&m, "1 splines without control points");
    assert_int_equal(m.line[1].n, 3);
}

/* ---- robustness --------------------------------------------------------------------------- */

static void only_drawings_are_taken_for_drawings(void **state)
{
    static const struct { const char *head; bool is; } heads[] = {
        { "0\nSECTION\n2\nHEADER\n", true }, { "  0\r\nSECTION\r\n", true }, { "999\nby hand\n999\n\n0\nSECTION\n", true },
        { "\xEF\xBB\xBF" "0\nSECTION\n", true }, { "AutoCAD Binary DXF\r\n\x1a", true }, { "0\nSECTIONS\n", false },
        { "0 SECTION\n", false }, { "0\n", false }, { "", false }, { "999\n", false }, { "999\n0\nSECTION\n", false },
        { "10\nSECTION\n", false }, { "x,y,z\n0,0,0\n", false }, { "0 0\n1 1\n", false } };
    (void)state;
    for (size_t k = 0; k < sizeof heads / sizeof *heads; k++)
        assert_int_equal(il_reader_dxf.probe((const unsigned char *)heads[k].head, strlen(heads[k].head)), heads[k].is);
    assert_true(il_reader_dxf.probe((const unsigned char *)"AC1027\0\0", 8));
    assert_false(il_reader_dxf.probe((const unsigned char *)"AC1027 is a release", 19));
}

static void every_failing_allocation_is_told(void **state)
{
    (void)state;
    begin("0 SECTION,2 HEADER,9 $ACADVER,1 AC1015,9 $DWGCODEPAGE,3 ANSI_1252,0 ENDSEC,0 SECTION,2 BLOCKS,0 BLOCK,2 A,"
          "0 LWPOLYLINE,38 5,8 H\xF6he,10 0,20 0,10 5,20 9,0 ENDBLK,0 ENDSEC,0 SECTION,2 ENTITIES,0 INSERT,2 A,8 B,0 TEXT,1 x,"
          "0 SPLINE,71 1,40 0,40 0,40 1,40 1,10 0,20 0,10 9,20 9,0 ENDSEC,0 EOF");
    long k = 0;
    il_status st;
    do {
        il_alloc_test_fail_after(k++);
        st = read_text(NULL);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || st == IL_E_NOMEM);
    } while (st != IL_OK && k < 10000);
    assert_int_equal(st, IL_OK);
    assert_true(k > 20);
    assert_int_equal(m.n, 2);
}

static int teardown(void **state)
{
    (void)state;
    map_free(&m);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arcs_lie_within_the_flatness),
        cmocka_unit_test(without_a_flatness_curves_are_cut_by_their_size),
        cmocka_unit_test(splines_are_the_curves_of_their_definition),
        cmocka_unit_test(places_are_put_together_from_the_inside_out),
        cmocka_unit_test(what_is_left_out_is_counted_by_its_name),
        cmocka_unit_test(layers_that_are_not_chosen_are_told),
        cmocka_unit_test(names_of_layers_are_shown_and_never_obeyed),
        cmocka_unit_test(units_are_told_and_inches_not_believed),
        cmocka_unit_test(splines_with_fit_points_only_are_told),
        cmocka_unit_test(only_drawings_are_taken_for_drawings),
        cmocka_unit_test(every_failing_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, teardown);
}
