/* t-svg-page.c - the page that pictures are written on: numbers, text, outlines. */
#include "config.h"
#include "base/alloc.h"
#include "output/label.h"
#include "output/picture-arcs.h"
#include "output/svg-page.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct sheet {
    il_output *out;
    il_svg_page page;
} sheet;

static void open_sheet(sheet *s)
{
    assert_int_equal(il_output_to_memory(&s->out, NULL), IL_OK);
    assert_int_equal(il_svg_page_begin(&s->page, s->out, 100, NULL), IL_OK);
}

/* What is on the page, from START on, as a string of the caller's. */
static char *close_sheet(sheet *s, const char *start)
{
    assert_int_equal(il_svg_page_finish(&s->page, "t", NULL), IL_OK);
    size_t n;
    const unsigned char *bytes = il_output_memory(s->out, &n);
    char *text = il_strndup((const char *)bytes, n), *from;
    assert_non_null(text);
    from = strstr(text, start);
    if (!from)
        fail_msg("no '%s' in %s", start, text);
    memmove(text, from, strlen(from) + 1);
    il_svg_page_free(&s->page);
    il_output_discard(s->out);
    return text;
}

static void numbers_are_short_and_do_not_drift(void **state)
{
    (void)state;
    sheet s;
    open_sheet(&s);
    il_svg_path_begin(&s.page, "id=\"p\"");
    il_svg_segment(&s.page, 0.004, -0.004, -12.345678, 1e7 / 3);
    il_svg_path_end(&s.page);
    char *text = close_sheet(&s, "<path");
    assert_non_null(strstr(text, "d=\"M0 0l-12.35 3333333.33\" id=\"p\"/>"));
    il_free(text);
    /* A thousand steps of a third end where they should, to a hundredth. */
    open_sheet(&s);
    const il_svg_view v = { 0, 0, 0, 0, 1 };
    double xy[2002];
    for (int k = 0; k <= 1000; k++) {
        xy[2 * k] = k / 3.0;
        xy[2 * k + 1] = k % 2;
    }
    il_svg_path_begin(&s.page, "");
    il_svg_outline(&s.page, &v, xy, 1001, false);
    il_svg_path_end(&s.page);
    text = close_sheet(&s, "M0 0l");
    double x = 0, step = 0;
    int used = 0;
    const char *p = text + 5;
    for (int k = 0; sscanf(p, "%lf%n", &step, &used) == 1; k++, p += used)
        x += k % 2 == 0 ? step : 0;
    assert_true(fabs(x - 1000 / 3.0) < 0.006);
    il_free(text);
}

static void text_is_escaped(void **state)
{
    (void)state;
    sheet s;
    open_sheet(&s);
    il_svg_text(&s.page, 1, 2, "", "<&>\"' \x01\xff\xEF\xBF\xBE \xC3\xA9");
    char *text = close_sheet(&s, "<text");
    const char *want = "<text x=\"1\" y=\"2\">&lt;&amp;&gt;&quot;' \xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD \xC3\xA9</text>";
    assert_memory_equal(text, want, strlen(want));
    il_free(text);
}

static void an_empty_path_is_none(void **state)
{
    (void)state;
    sheet s;
    open_sheet(&s);
    il_svg_path_begin(&s.page, "");
    il_svg_outline(&s.page, &(il_svg_view){ 0, 0, 0, 0, 1 }, NULL, 0, true);
    il_svg_path_end(&s.page);
    char *text = close_sheet(&s, "<svg");
    assert_null(strstr(text, "<path"));
    il_free(text);
}

static void what_is_no_number_or_far_off_stays_near_the_page(void **state)
{
    (void)state;
    const il_svg_view v = { 0, 0, 0, 0, 1e300 };
    const double odd[] = { 0, 1, -1, 1e300, -1e300, INFINITY, -INFINITY, NAN };
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        double at[2];
        il_svg_view_point(&v, odd[i], odd[i], at);
        assert_true(fabs(at[0]) <= 20000 && fabs(at[1]) <= 20000);
    }
}

/* ---- thinning ------------------------------------------------------------ */

static double to_piece(const double *p, const double *a, const double *b)
{
    double d[2] = { b[0] - a[0], b[1] - a[1] }, l = d[0] * d[0] + d[1] * d[1];
    double t = l > 0 ? ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / l : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(a[0] + t * d[0] - p[0], a[1] + t * d[1] - p[1]);
}

/* The points of a path with one subpath; returns their number. */
static size_t parse_path(const char *text, double *xy, size_t most)
{
    double x = 0, y = 0, dx, dy;
    int used;
    size_t n = 0;
    const char *p = strchr(text, 'M');
    assert_non_null(p);
    while (*p && *p != '"' && *p != 'z') {
        if (*p == 'M' || *p == 'l')
            p++;
        assert_int_equal(sscanf(p, "%lf %lf%n", &dx, &dy, &used), 2);
        p += used;
        x += dx;
        y += dy;
        assert_true(n < most);
        xy[2 * n] = x;
        xy[2 * n++ + 1] = y;
    }
    return n;
}

enum { WALK = 3000 };

/* How far any of the N points lies from the line M through THIN. */
static double farthest(const double *xy, size_t n, const double *thin, size_t m)
{
    double worst = 0;
    for (size_t i = 0; i < n; i++) {
        double least = INFINITY;
        for (size_t k = 0; k + 1 < m; k++)
            least = fmin(least, to_piece(xy + 2 * i, thin + 2 * k, thin + 2 * k + 2));
        worst = fmax(worst, least);
    }
    return worst;
}

static size_t thin_of(const double *xy, size_t n, double *thin)
{
    sheet s;
    open_sheet(&s);
    il_svg_path_begin(&s.page, "");
    il_svg_outline(&s.page, &(il_svg_view){ 0, 0, 0, 0, 1 }, xy, n, false);
    il_svg_path_end(&s.page);
    char *text = close_sheet(&s, "<path");
    size_t m = parse_path(text, thin, WALK);
    il_free(text);
    for (size_t k = 0; k < m; k++)
        thin[2 * k + 1] = -thin[2 * k + 1]; /* up is up */
    return m;
}

static void thinned_outlines_stay_within_the_tolerance(void **state)
{
    (void)state;
    static double xy[2 * WALK], thin[2 * WALK];
    unsigned seed = 1;
    for (int turn = 0; turn < 60; turn++) {
        double step = pow(10, turn % 6 - 4), x = 50, y = 50, course = 0;
        for (size_t k = 0; k < WALK; k++) {
            seed = seed * 1103515245u + 12345u;
            double r = (seed >> 8) / 16777216.0 - 0.5;
            course += turn < 30 ? r : r > 0.49 ? 3.14159265 : 0; /* wandering, or there and back again */
            xy[2 * k] = x += step * cos(course);
            xy[2 * k + 1] = y += step * sin(course);
        }
        size_t m = thin_of(xy, WALK, thin);
        /* Tolerance a tenth; turning back may cost another, rounding a hundredth. */
        if (m > 1)
            assert_true(farthest(xy, WALK, thin, m) < 0.22);
    }
}

static void smooth_outlines_become_short(void **state)
{
    (void)state;
    static double xy[2 * WALK], thin[2 * WALK];
    for (size_t k = 0; k < WALK; k++) {
        double t = 6.283185307179586 * (double)k / WALK;
        xy[2 * k] = 200 * cos(t);
        xy[2 * k + 1] = 100 * sin(t);
    }
    assert_true(thin_of(xy, WALK, thin) < 150);
}

/* ---- labels -------------------------------------------------------------- */

static void numbers_in_labels_have_so_many_digits(void **state)
{
    (void)state;
    const struct { double v; int digits; const char *text; } c[] = {
        { 0, 3, "0" }, { 1, 1, "1" }, { 0.001, 1, "0.001" }, { 123456, 3, "123000" }, { 0.0123456, 2, "0.012" },
        { -2.5551, 3, "-2.56" }, { 99.99, 2, "100" }, { 5e-7, 1, "5e-07" }, { 1e15, 3, "1e+15" }, { 2e14, 1, "2e+14" } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        il_label l = IL_LABEL_INIT;
        il_label_number(&l, c[k].v, c[k].digits);
        assert_string_equal(l.text, c[k].text);
    }
}

static void heights_in_labels_differ(void **state)
{
    (void)state;
    const struct { double v, spacing; const char *text; } c[] = {
        { 7.5, 2.5, "7.5" }, { -0.8754741, 0.05, "-0.875" }, { 100000.0512345, 0.05, "100000.051" }, { 12, 1e-9, "12" },
        { 402.7611, 3.5, "402.8" }, { 0.1, 0, "0.1" }, { 1e-30, 2e-30, "1e-30" }, { 1 / 3.0, 1e-20, "0.3333333333333333" },
        { -9e14, 1.8e15, "-9e+14" } };
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        il_label l = IL_LABEL_INIT;
        il_label_height(&l, c[k].v, c[k].spacing);
        assert_string_equal(l.text, c[k].text);
    }
}

static void names_in_labels_are_cut_and_printable(void **state)
{
    (void)state;
    il_label l = IL_LABEL_INIT;
    il_label_name(&l, "abcdefgh", 5);
    assert_string_equal(l.text, "abcde\xE2\x80\xA6");
    l = (il_label)IL_LABEL_INIT;
    il_label_name(&l, "\x1b[1m", 20);
    assert_string_equal(l.text, "\\x1b[1m");
    l = (il_label)IL_LABEL_INIT;
    il_label_name(&l, "\xE6\xBC\xA2\xE5\xAD\x97", 3);
    assert_string_equal(l.text, "\xE6\xBC\xA2\xE2\x80\xA6");
    l = (il_label)IL_LABEL_INIT;
    for (int k = 0; k < 100; k++)
        il_label_words(&l, "0123456789");
    assert_int_equal(strlen(l.text), l.n);
    assert_true(l.n < sizeof l.text);
}

/* ---- arcs ---------------------------------------------------------------- */

/* Two squares of side 4, the upper one turned round by phi so that its vertex k
 * comes to lie on the lower one's k + 1. */
typedef struct squares {
    il_slice lower, upper;
    il_pair pair;
    il_phi_point phi[5];
    il_match match;
} squares;

static void make_squares(squares *q)
{
    static const double corner[4][2] = { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 } };
    memset(q, 0, sizeof *q);
    for (int s = 0; s < 2; s++) {
        il_ring *r = il_slice_add_ring(s ? &q->upper : &q->lower);
        assert_non_null(r);
        for (int k = 0; k < 4; k++)
            assert_true(il_ring_add(r, corner[k][0], corner[k][1], 0));
    }
    /* A subdivision point in the middle of edge 1, whose image lies off the edge. */
    q->phi[0] = (il_phi_point){ { 0, 0, 0 }, 4, 0 };
    q->phi[1] = (il_phi_point){ { 0, 1, 0 }, 4, 4 };
    q->phi[2] = (il_phi_point){ { 0, 1, 0.5 }, 2, 5 };
    q->phi[3] = (il_phi_point){ { 0, 2, 0 }, 0, 4 };
    q->phi[4] = (il_phi_point){ { 0, 3, 0 }, 0, 0 };
    q->match = (il_match){ { { 0, 1, 0 }, { 0, 1, 0 } }, { { 0, 0, 0 }, { 0, 0, 0 } }, 0, 1, false };
    q->pair = (il_pair){ .matcher = IL_MATCHER_FFD, .phi = q->phi, .n_phi = 5, .match = &q->match, .n_matches = 1 };
}

static void arcs_run_where_they_say(void **state)
{
    (void)state;
    squares q;
    il_arcs a;
    il_trace t = IL_TRACE_INIT;
    make_squares(&q);
    const struct { bool upper; il_arc arc; double length, phi_length; } c[] = {
        { false, { { 0, 0, 0 }, { 0, 0, 0 } }, 16, 16 },                /* all of it */
        { false, { { 0, 2, 0.5 }, { 0, 2, 0.5 } }, 16, 16 },            /* from within an edge */
        { false, { { 0, 2, 0.5 }, { 0, 2, 0.75 } }, 1, 1 },
        { false, { { 0, 2, 0.75 }, { 0, 2, 0.5 } }, 15, 15 },           /* all but a piece */
        { false, { { 0, 3, 0 }, { 0, 1, 0.5 } }, 10, 10 },              /* over the end */
        { true, { { 0, 0, 0.5 }, { 0, 2, 0 } }, 6, 2 + 2 * sqrt(5) },
        { true, { { 0, 1, 0.25 }, { 0, 1, 0.75 } }, 2, sqrt(5) },       /* round the subdivision point */
        { true, { { 0, 3, 0.5 }, { 0, 3, 0.25 } }, 15, 3 + 8 + 2 * sqrt(5) } };
    assert_int_equal(il_arcs_open(&a, &q.lower, &q.upper, &q.pair, NULL), IL_OK);
    for (size_t k = 0; k < sizeof c / sizeof *c; k++) {
        assert_int_equal(il_arcs_trace(&a, c[k].upper, &c[k].arc, &t, NULL), IL_OK);
        assert_true(fabs(il_trace_length(t.xy, t.n) - c[k].length) < 1e-12);
        assert_true(fabs(il_trace_length(t.phi, t.n) - c[k].phi_length) < 1e-12);
    }
    il_trace_free(&t);
    il_arcs_free(&a);
    il_slice_free(&q.lower);
    il_slice_free(&q.upper);
}

static void links_lead_to_where_phi_points(void **state)
{
    (void)state;
    squares q;
    il_arcs a;
    size_t n;
    make_squares(&q);
    q.phi[2].y = 4;
    assert_int_equal(il_arcs_open(&a, &q.lower, &q.upper, &q.pair, NULL), IL_OK);
    assert_int_equal(il_arcs_links(&a, &q.match, 1, 0.01, &n, NULL), IL_OK);
    assert_int_equal(n, 16);
    for (size_t i = 0; i < n; i++) { /* a quarter turn about the middle */
        const double *s = a.sample + 4 * i;
        assert_true(fabs(4 - s[1] - s[2]) < 0.01 && fabs(s[0] - s[3]) < 0.01);
    }
    il_arcs_free(&a);
    il_slice_free(&q.lower);
    il_slice_free(&q.upper);
}

static void arcs_that_overlap_without_end_are_refused(void **state)
{
    (void)state;
    squares q;
    il_arcs a;
    il_trace t = IL_TRACE_INIT;
    il_error err = IL_ERROR_INIT;
    il_status st = IL_OK;
    make_squares(&q);
    assert_int_equal(il_arcs_open(&a, &q.lower, &q.upper, &q.pair, NULL), IL_OK);
    for (int k = 0; k < 100 && st == IL_OK; k++)
        st = il_arcs_trace(&a, true, &q.match.upper, &t, &err);
    assert_int_equal(st, IL_E_INPUT);
    il_trace_free(&t);
    il_arcs_free(&a);
    il_slice_free(&q.lower);
    il_slice_free(&q.upper);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_short_and_do_not_drift),
        cmocka_unit_test(text_is_escaped),
        cmocka_unit_test(an_empty_path_is_none),
        cmocka_unit_test(what_is_no_number_or_far_off_stays_near_the_page),
        cmocka_unit_test(thinned_outlines_stay_within_the_tolerance),
        cmocka_unit_test(smooth_outlines_become_short),
        cmocka_unit_test(numbers_in_labels_have_so_many_digits),
        cmocka_unit_test(heights_in_labels_differ),
        cmocka_unit_test(names_in_labels_are_cut_and_printable),
        cmocka_unit_test(arcs_run_where_they_say),
        cmocka_unit_test(links_lead_to_where_phi_points),
        cmocka_unit_test(arcs_that_overlap_without_end_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
