/* Path data, curves and transforms against closed forms. */
#include "config.h"
#include "base/number.h"
#include "input/svg-path.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static il_svg_pen pen_for(il_slice *slice, double flatness)
{
    return (il_svg_pen){ .matrix = IL_AFFINE_IDENTITY, .flatness = flatness, .max_points = 100000, .slice = slice };
}

static il_status draw_with(il_svg_pen *pen, const char *data, il_error *err)
{
    il_svg_text d = { "d", data, strlen(data), 0 };
    return il_svg_path_draw(&d, pen, err);
}

static il_slice draw(const char *data, double flatness)
{
    il_slice s = IL_SLICE_INIT;
    il_error err = IL_ERROR_INIT;
    il_svg_pen pen = pen_for(&s, flatness);
    if (draw_with(&pen, data, &err) != IL_OK)
        fail_msg("%s: %s", data, err.text);
    return s;
}

/* The rings as "x y,x y,... z" for closed ones, without the z for open ones,
 * separated by bars. */
static const char *text_of(const il_slice *s)
{
    static char text[4096];
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        if (i > 0)
            text[n++] = '|';
        for (size_t v = 0; v < 2 * r->n; v++) {
            if (v > 0)
                text[n++] = v % 2 ? ' ' : ',';
            n += il_number_format(text + n, r->xy[v]);
            assert_true(n < sizeof text - 64);
        }
        if (!r->open)
            text[n++] = 'z';
    }
    text[n] = '\0';
    return text;
}

static void straight_commands_draw_what_they_say(void **state)
{
    (void)state;
    static const struct { const char *d, *rings; } c[] = {
        { "M0 0L10 0L10 5Z", "0 0,10 0,10 5z" },
        { "m1 2l10 0l0 5z", "1 2,11 2,11 7z" },
        { "M0,0H10V5H0Z", "0 0,10 0,10 5,0 5z" },
        { "m1 1h10v5h-10z", "1 1,11 1,11 6,1 6z" },
        { "M0 0 10 0 10 5", "0 0,10 0,10 5" },                           /* implicit lineto */
        { "m1 1 10 0 0 5z", "1 1,11 1,11 6z" },                          /* relative too */
        { "M1-2.5.5-4L-5-6Z", "1 -2.5,0.5 -4,-5 -6z" },
        { "M0 0 1 0 1 1 0 0", "0 0,1 0,1 1z" },                          /* the ends meet */
        { "M0 0 1 0 1 1 0 0Z", "0 0,1 0,1 1z" },
        { "M0 0L1 0L1 1ZL5 5L5 6Z", "0 0,1 0,1 1z|0 0,5 5,5 6z" },       /* Z returns to the start */
        { "M0 0L1 0L1 1Zm5 5l1 0 0 1z", "0 0,1 0,1 1z|5 5,6 5,6 6z" },
        { "M0 0L1 0L1 1M9 9M5 5L6 5L6 6Z", "0 0,1 0,1 1|5 5,6 5,6 6z" }, /* a lone moveto draws nothing */
        { "M 0 , 0 \n L\t1e1 , 0 , 1.e1 5. Z", "0 0,10 0,10 5z" },
        { "M+1+2L.5.25.125.0625Z", "1 2,0.5 0.25,0.125 0.0625z" },
        { "M0 0H1 2 3V1 2Z", "0 0,1 0,2 0,3 0,3 1,3 2z" },
        { "M-0-0L-0 1L1-0Z", "0 0,0 1,1 0z" },
        { "  ", "" },
        { "M3 4", "" },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_slice s = draw(c[i].d, 0.01);
        assert_string_equal(text_of(&s), c[i].rings);
        il_slice_free(&s);
    }
}

static void broken_path_data_is_refused_at_its_place(void **state)
{
    (void)state;
    static const struct { const char *d; size_t at; } c[] = {
        { "L0 0", 0 }, { "0 0", 0 }, { "zM0 0", 0 }, { "M0", 2 }, { "M", 1 }, { "M0 0L", 5 }, { "M0 0L1", 6 },
        { "M0 0X1 1", 4 }, { "M0 0L1,,2", 7 }, { "M,0 0", 1 }, { "M0 0L1 1,", 9 }, { "M0 0Z1 1", 5 },
        { "M0 0A1 1 0 2 0 1 1", 11 }, { "M0 0A1 1 0 1 x 1 1", 13 }, { "M0 0C1 1 2 2 3", 14 }, { "M0 0Lnan 1", 5 },
        { "M0 0Linf 1", 5 }, { "M0 0L1e999 1", 5 }, { "M0 0L1 1#", 8 }, { "M0 0L1 1\x01", 8 },
        { "M0 0L0x1 1", 6 },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_slice s = IL_SLICE_INIT;
        il_error err = IL_ERROR_INIT;
        il_svg_pen pen = pen_for(&s, 0.01);
        il_svg_text d = { "d", c[i].d, strlen(c[i].d), 0 };
        if (il_svg_path_draw(&d, &pen, &err) != IL_E_INPUT || d.at != c[i].at)
            fail_msg("%s: stopped at %zu, not %zu (%s)", c[i].d, d.at, c[i].at, err.text);
        il_slice_free(&s);
    }
}

static void coordinates_at_the_limit_are_refused(void **state)
{
    (void)state;
    static const char *const c[] = { "M1e15 0L1 1", "M0 0L-1e15 1", "M0 0l9e14 0l9e14 0", "M0 0C1e15 0 1 1 2 2",
                                     "M0 0A9e15 9e15 0 0 0 1 1", "M0 0h1e308h1e308",
                                     "M-9e14 0A9e14 9e14 0 1 1 9e14 1" };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_slice s = IL_SLICE_INIT;
        il_error err = IL_ERROR_INIT;
        il_svg_pen pen = pen_for(&s, 0.01);
        assert_int_equal(draw_with(&pen, c[i], &err), i == 6 ? IL_OK : IL_E_INPUT);
        il_slice_free(&s);
    }
}

static void the_number_of_vertices_is_limited(void **state)
{
    (void)state;
    il_slice s = IL_SLICE_INIT;
    il_error err = IL_ERROR_INIT;
    il_svg_pen pen = pen_for(&s, 1e-9);
    pen.max_points = 100;
    assert_int_equal(draw_with(&pen, "M0 0A50 50 0 0 1 100 0", &err), IL_E_INPUT);
    assert_string_equal(err.text, "more than 100 vertices");
    il_slice_free(&s);
}

/* ---- curves --------------------------------------------------------------------- */


static double distance_to_segment(double px, double py, const double *a, const double *b)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], l = dx * dx + dy * dy;
    double t = l > 0 ? ((px - a[0]) * dx + (py - a[1]) * dy) / l : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(px - a[0] - t * dx, py - a[1] - t * dy);
}

static double distance_to_line(double x, double y, const il_ring *r)
{
    double least = INFINITY;
    for (size_t v = 0; v + 1 < r->n; v++)
        least = fmin(least, distance_to_segment(x, y, &r->xy[2 * v], &r->xy[2 * v + 2]));
    return least;
}

typedef struct cubic { double p[8]; } cubic;

static void cubic_at(const cubic *c, double t, double *x, double *y)
{
    double s = 1 - t, w[4] = { s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t };
    *x = *y = 0;
    for (int i = 0; i < 4; i++) {
        *x += w[i] * c->p[2 * i];
        *y += w[i] * c->p[2 * i + 1];
    }
}

/* Farthest of 5000 points of the curve from the polyline. */
static double cubic_error(const cubic *c, const il_ring *r)
{
    double most = 0;
    for (int i = 0; i <= 5000; i++) {
        double x, y;
        cubic_at(c, i / 5000.0, &x, &y);
        most = fmax(most, distance_to_line(x, y, r));
    }
    return most;
}

static void curves_stay_within_the_tolerance(void **state)
{
    (void)state;
    static const cubic c[] = { { { 0, 0, 0, 10, 10, 10, 10, 0 } }, { { 0, 0, 30, 10, -20, 10, 10, 0 } },
                               { { 0, 0, 1, 1, 2, 2, 3, 3 } },     { { 5, 5, 5, 5, 50, 5, 5, 50 } },
                               { { 0, 0, 100, 0, 0, 100, 100, 100 } } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        const double *p = c[i].p;
        for (double flatness = 1; flatness > 2e-4; flatness /= 10) {
            char d[256];
            snprintf(d, sizeof d, "M%g %gC%g %g %g %g %g %g", p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]);
            il_slice s = draw(d, flatness);
            double error = cubic_error(&c[i], &s.ring[0]);
            if (!(error <= flatness * (1 + 1e-9) + 1e-12))
                fail_msg("%s: %g > %g", d, error, flatness);
            assert_true((double)s.ring[0].n < 2 + 14 / sqrt(flatness)); /* and does not waste points */
            assert_true(s.ring[0].xy[2 * s.ring[0].n - 2] == p[6]);
            assert_true(s.ring[0].xy[2 * s.ring[0].n - 1] == p[7]);
            il_slice_free(&s);
        }
    }
}

static void a_huge_curve_costs_few_vertices(void **state)
{
    (void)state;
    static const char *const d[] = { "M0 0C0 9e14 9e14 9e14 9e14 0", "M0 0Q0 9e14 9e14 0",
        "M0 0A4e14 4e14 0 1 1 1e14 0" };
    for (size_t i = 0; i < 3; i++) {
        il_slice s = draw(d[i], 1e-6);
        assert_in_range(s.ring[0].n, 100, 4200);
        il_slice_free(&s);
    }
}

/* A quadratic is the cubic with control points two thirds of the way; drawn
 * from either, all vertices lie on the same curve. */
static void a_quadratic_is_its_cubic(void **state)
{
    (void)state;
    cubic c = { { 0, 0, 4, 8, 8, 8, 12, 0 } }; /* of Q 6 12 12 0 */
    il_slice s = draw("M0 0Q6 12 12 0", 0.001);
    assert_true(cubic_error(&c, &s.ring[0]) <= 0.001);
    il_slice_free(&s);
}

static void smooth_commands_mirror_the_control_point(void **state)
{
    (void)state;
    static const struct { const char *a, *b; } same[] = {
        { "M0 0C0 4 4 4 4 0S8-4 8 0", "M0 0C0 4 4 4 4 0C4-4 8-4 8 0" },
        { "m1 1c0 4 4 4 4 0s4-4 4 0", "M1 1C1 5 5 5 5 1C5-3 9-3 9 1" },
        { "M0 0S8-4 8 0", "M0 0C0 0 8-4 8 0" },                      /* nothing to mirror */
        { "M0 0Q1 1 2 0S8-4 8 0", "M0 0Q1 1 2 0C2 0 8-4 8 0" },      /* not of its kind */
        { "M0 0Q2 4 4 0T8 0", "M0 0Q2 4 4 0Q6-4 8 0" },
        { "M0 0Q2 4 4 0T8 0T12 0", "M0 0Q2 4 4 0Q6-4 8 0Q10 4 12 0" },
        { "m1 0q2 4 4 0t4 0", "M1 0Q3 4 5 0Q7-4 9 0" },
        { "M0 0T8 0T12 4", "M0 0Q0 0 8 0Q16 0 12 4" },
        { "M0 0C0 4 4 4 4 0 5 1 6 1 7 0", "M0 0C0 4 4 4 4 0C5 1 6 1 7 0" },
        { "m1 1c0 4 4 4 4 0 0 4 4 4 4 0z", "M1 1C1 5 5 5 5 1C5 5 9 5 9 1Z" },
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        char a[4096];
        il_slice s = draw(same[i].a, 0.2);
        snprintf(a, sizeof a, "%s", text_of(&s));
        il_slice_free(&s);
        s = draw(same[i].b, 0.2);
        assert_string_equal(a, text_of(&s));
        il_slice_free(&s);
    }
}

/* ---- arcs ------------------------------------------------------------------------ */

/* Angle that the polyline turns through about (CX, CY), radians, signed. */
static double swept_angle(const il_ring *r, double cx, double cy)
{
    double sum = 0;
    for (size_t v = 0; v + 1 < r->n; v++) {
        double ax = r->xy[2 * v] - cx, ay = r->xy[2 * v + 1] - cy;
        double bx = r->xy[2 * v + 2] - cx, by = r->xy[2 * v + 3] - cy;
        sum += atan2(ax * by - ay * bx, ax * bx + ay * by);
    }
    return sum;
}

/* The four arcs of radius 5 between (0, 0) and (8, 0): centres (4, -3) and
 * (4, 3); sweep 1 is towards positive angles, from x to y. */
static void flags_choose_one_of_four_arcs(void **state)
{
    (void)state;
    const double small = 2 * asin(0.8), large = 2 * pi - small;
    const struct { const char *d; double cy, angle; } c[] = {
        { "M0 0A5 5 0 0 0 8 0", -3, -small }, { "M0 0A5 5 0 0 1 8 0", 3, small },
        { "M0 0A5 5 0 1 0 8 0", 3, -large },  { "M0 0A5 5 0 1 1 8 0", -3, large },
        { "M0 0a5 5 0 118 0", -3, large },    { "M0 0a5,5,0,0,0,8,0", -3, -small }, { "M0 0A-5-5 0 018 0", 3, small } };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_slice s = draw(c[i].d, 0.001);
        const il_ring *r = &s.ring[0];
        for (size_t v = 0; v < r->n; v++)
            assert_true(fabs(hypot(r->xy[2 * v] - 4, r->xy[2 * v + 1] - c[i].cy) - 5) < 1e-12);
        assert_true(fabs(swept_angle(r, 4, c[i].cy) - c[i].angle) < 1e-9);
        assert_true(r->xy[2 * r->n - 2] == 8 && r->xy[2 * r->n - 1] == 0);
        il_slice_free(&s);
    }
}

/* Semicircles, full turns but a hair, quarters: where a tiny cross product
 * could send an arc once more round. */
static void arcs_sweep_their_angle_and_no_more(void **state)
{
    (void)state;
    for (int large = 0; large < 2; large++) {
        for (int i = 0; i <= 720; i++) {
            double angle = i * pi / 720;                    /* up to half a turn */
            double turn = large ? 2 * pi - angle : angle;
            for (int k = 0; k < 16; k++) {
                double from = k * pi / 8 + 1e-3 * k, to = from + turn;
                char d[256], n[4][IL_NUMBER_MAX];
                il_number_format(n[0], 7 * cos(from)), il_number_format(n[1], 7 * sin(from));
                il_number_format(n[2], 7 * cos(to)), il_number_format(n[3], 7 * sin(to));
                snprintf(d, sizeof d, "M%s %sA7 7 0 %d 1 %s %s", n[0], n[1], large, n[2], n[3]);
                if (i == 0)
                    continue;
                il_slice s = draw(d, 0.05);
                double cx = 0, cy = 0;
                if (!(fabs(swept_angle(&s.ring[0], cx, cy) - turn) < 1e-5))
                    fail_msg("%s: %g, not %g", d, swept_angle(&s.ring[0], cx, cy), turn);
                il_slice_free(&s);
            }
        }
    }
}

static void turned_ellipses_lie_on_their_ellipse(void **state)
{
    (void)state;
    for (int rotation = -400; rotation <= 400; rotation += 35) {
        char d[128];
        snprintf(d, sizeof d, "M0 0A6 2 %d 1 0 1 .5", rotation);
        il_slice s = draw(d, 0.001);
        const il_ring *r = &s.ring[0];
        double co = cos(rotation * pi / 180), si = sin(rotation * pi / 180), u[3], v[3];
        size_t pick[3] = { 0, r->n / 3, 2 * r->n / 3 };
        /* three of its points, in the ellipse's own axes and radii, determine a unit circle */
        for (int k = 0; k < 3; k++) {
            double x = r->xy[2 * pick[k]], y = r->xy[2 * pick[k] + 1];
            u[k] = (co * x + si * y) / 6;
            v[k] = (co * y - si * x) / 2;
        }
        double bx = u[1] - u[0], by = v[1] - v[0], cx = u[2] - u[0], cy = v[2] - v[0], det = 2 * (bx * cy - by * cx);
        double mx = u[0] + (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / det;
        double my = v[0] + (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / det;
        for (size_t k = 0; k < r->n; k++) {
            double x = r->xy[2 * k], y = r->xy[2 * k + 1];
            assert_true(fabs(hypot((co * x + si * y) / 6 - mx, (co * y - si * x) / 2 - my) - 1) < 1e-9);
        }
        il_slice_free(&s);
    }
}

/* F.6.2 and F.6.6: a radius of 0 is a line, equal ends are nothing, and radii
 * too small grow until the chord is a diameter. */
static void degenerate_arcs_are_what_the_appendix_says(void **state)
{
    (void)state;
    il_slice s = draw("M0 0A0 5 0 0 1 4 4Z", 0.01);
    assert_string_equal(text_of(&s), "0 0,4 4z");
    il_slice_free(&s);
    s = draw("M1 1A5 5 0 1 1 1 1L2 2L3 1Z", 0.01);
    assert_string_equal(text_of(&s), "1 1,2 2,3 1z");
    il_slice_free(&s);
    s = draw("M0 0A1 1 0 0 1 8 0", 0.001);
    for (size_t v = 0; v < s.ring[0].n; v++)
        assert_true(fabs(hypot(s.ring[0].xy[2 * v] - 4, s.ring[0].xy[2 * v + 1]) - 4) < 1e-12);
    assert_true(fabs(swept_angle(&s.ring[0], 4, 0) - pi) < 1e-9);
    il_slice_free(&s);
    s = draw("M0 0A1e-200 1e-200 0 0 1 8 0", 0.001); /* though the ratio's square is beyond doubles */
    assert_true(fabs(swept_angle(&s.ring[0], 4, 0) - pi) < 1e-9);
    il_slice_free(&s);
}

static double circle_error(const il_ring *r, double radius)
{
    double most = 0;
    for (size_t v = 0; v < r->n; v++) {
        size_t w = (v + 1) % r->n;
        double x = (r->xy[2 * v] + r->xy[2 * w]) / 2, y = (r->xy[2 * v + 1] + r->xy[2 * w + 1]) / 2;
        most = fmax(most, radius - hypot(x, y));
    }
    return most;
}

static void circles_stay_within_the_tolerance_and_keep_their_extremes(void **state)
{
    (void)state;
    for (double radius = 0.01; radius < 2e4; radius *= 3.7) {
        for (double flatness = 1; flatness > 1e-4; flatness /= 10) {
            il_slice s = IL_SLICE_INIT;
            il_error err = IL_ERROR_INIT;
            il_svg_pen pen = pen_for(&s, flatness);
            assert_int_equal(il_svg_pen_ellipse(&pen, 0, 0, radius, radius, &err), IL_OK);
            const il_ring *r = &s.ring[0];
            double allowed = fmax(flatness, 2e-6 * radius);
            assert_true(circle_error(r, radius) <= allowed * (1 + 1e-9));
            assert_true(r->n <= 4 || circle_error(r, radius) > allowed / 4.1); /* halving once less would not do */
            assert_false(r->open);
            assert_true(r->n % 4 == 0);
            const double ends[8] = { radius, 0, 0, radius, -radius, 0, 0, -radius };
            for (size_t q = 0; q < 4; q++)
                assert_memory_equal(&r->xy[q * r->n / 2], &ends[2 * q], 2 * sizeof *ends);
            il_slice_free(&s);
        }
    }
}

/* ---- transforms -------------------------------------------------------------------- */

static il_affine transform(const char *list)
{
    il_affine m = IL_AFFINE_IDENTITY;
    il_error err = IL_ERROR_INIT;
    il_svg_text t = { "transform", list, strlen(list), 0 };
    if (il_svg_transform_parse(&t, &m, &err) != IL_OK)
        fail_msg("%s: %s", list, err.text);
    return m;
}

static void transforms_are_the_matrices_of_the_standard(void **state)
{
    (void)state;
    const double s30 = sin(pi / 6), c30 = cos(pi / 6);
    const struct { const char *list; double m[6]; } c[] = {
        { "", { 1, 0, 0, 1, 0, 0 } },
        { "none", { 1, 0, 0, 1, 0, 0 } },
        { "matrix(1 2 3 4 5 6)", { 1, 2, 3, 4, 5, 6 } },
        { "matrix(1,2,3,4,5,6)", { 1, 2, 3, 4, 5, 6 } },
        { "translate(3)", { 1, 0, 0, 1, 3, 0 } },
        { " translate ( 3 , -4 ) ", { 1, 0, 0, 1, 3, -4 } },
        { "scale(2)", { 2, 0, 0, 2, 0, 0 } },
        { "scale(2-3)", { 2, 0, 0, -3, 0, 0 } },
        { "rotate(30)", { c30, s30, -s30, c30, 0, 0 } },
        { "rotate(90)", { 0, 1, -1, 0, 0, 0 } },
        { "rotate(-90)", { 0, -1, 1, 0, 0, 0 } },
        { "rotate(180)", { -1, 0, 0, -1, 0, 0 } },
        { "rotate(1170)", { 0, 1, -1, 0, 0, 0 } },
        { "rotate(90 1 2)", { 0, 1, -1, 0, 3, 1 } },
        { "skewX(45)", { 1, 0, 1, 1, 0, 0 } },
        { "skewY(-45)", { 1, -1, 0, 1, 0, 0 } },
        { "skewX(30)", { 1, 0, s30 / c30, 1, 0, 0 } },
        { "translate(10,20) scale(2)", { 2, 0, 0, 2, 10, 20 } },
        { "scale(2),translate(10 20)", { 2, 0, 0, 2, 20, 40 } },
        { "translate(1)rotate(90)scale(2 3)", { 0, 2, -3, 0, 1, 0 } },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_affine m = transform(c[i].list);
        const double got[6] = { m.a, m.b, m.c, m.d, m.e, m.f };
        for (int k = 0; k < 6; k++)
            if (!(fabs(got[k] - c[i].m[k]) <= (c[i].m[k] == floor(c[i].m[k]) ? 0 : 1e-15)))
                fail_msg("%s: number %d is %.17g, not %.17g", c[i].list, k, got[k], c[i].m[k]);
    }
}

static void broken_transforms_are_refused(void **state)
{
    (void)state;
    static const char *const c[] = { "rotate", "rotate(", "rotate()", "rotate(1", "rotate(1,2)", "rotate(1 2 3 4)",
        "matrix(1 2 3 4 5)", "matrix(1 2 3 4 5 6 7)", "translate(1 2 3)", "scale()", "skewX(1 2)", "translate(1,)",
        "translate(,1)", "spin(3)", "translate(1)x", "translate(1),,scale(2)", "none none", "scale(nan)", ")" };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_affine m = { 9, 8, 7, 6, 5, 4 };
        il_error err = IL_ERROR_INIT;
        il_svg_text t = { "transform", c[i], strlen(c[i]), 0 };
        if (il_svg_transform_parse(&t, &m, &err) != IL_E_INPUT)
            fail_msg("'%s' was taken", c[i]);
        assert_true(m.a == 9 && m.f == 4);
    }
}

/* Bits survive the identity, a turn by quarters and there and back by 2^k. */
static void exact_transforms_keep_every_bit(void **state)
{
    (void)state;
    static const char *const c[] = { "", "matrix(1 0 0 1 0 0)", "rotate(360)", "rotate(90)rotate(90)rotate(-180)",
                                     "scale(1024)scale(.0009765625)", "scale(-1)scale(-1)", "rotate(270)rotate(90)" };
    static const double values[] = { 0.1, 1.0 / 3, 1.5, -123456.789, 9.87654321e14, 5e-324, 2.2250738585072014e-308 };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        il_affine m = transform(c[i]);
        for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
            double x = values[k], y = -values[k] * 0.7, wanted = y;
            il_affine_apply(&m, &x, &y);
            assert_true(x == values[k] && y == wanted);
        }
    }
}

static void the_tolerance_is_of_the_stack_not_of_the_drawing(void **state)
{
    (void)state;
    il_slice a = IL_SLICE_INIT, b = IL_SLICE_INIT;
    il_error err = IL_ERROR_INIT;
    il_svg_pen pa = pen_for(&a, 0.01), pb = pen_for(&b, 0.01);
    pb.matrix = (il_affine){ 1000, 0, 0, 1000, 0, 0 };
    assert_int_equal(il_svg_pen_ellipse(&pa, 0, 0, 5, 5, &err), IL_OK);
    assert_int_equal(il_svg_pen_ellipse(&pb, 0, 0, 0.005, 0.005, &err), IL_OK);
    assert_int_equal(a.ring[0].n, b.ring[0].n);
    il_slice_free(&a);
    il_slice_free(&b);
}

static void sines_of_quarter_turns_are_exact(void **state)
{
    (void)state;
    static const double expected[4][2] = { { 0, 1 }, { 1, 0 }, { 0, -1 }, { -1, 0 } };
    for (int k = -1000; k <= 1000; k++) {
        double s, c;
        il_sincos_deg(90.0 * k, &s, &c);
        assert_true(s == expected[(k + 1000) % 4][0] && c == expected[(k + 1000) % 4][1]);
        il_sincos_deg(k, &s, &c);
        assert_true(fabs(s - sin(k * pi / 180)) < 1e-14 && fabs(c - cos(k * pi / 180)) < 1e-14);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(straight_commands_draw_what_they_say),
        cmocka_unit_test(broken_path_data_is_refused_at_its_place),
        cmocka_unit_test(coordinates_at_the_limit_are_refused),
        cmocka_unit_test(the_number_of_vertices_is_limited),
        cmocka_unit_test(curves_stay_within_the_tolerance),
        cmocka_unit_test(a_huge_curve_costs_few_vertices),
        cmocka_unit_test(a_quadratic_is_its_cubic),
        cmocka_unit_test(smooth_commands_mirror_the_control_point),
        cmocka_unit_test(flags_choose_one_of_four_arcs),
        cmocka_unit_test(arcs_sweep_their_angle_and_no_more),
        cmocka_unit_test(turned_ellipses_lie_on_their_ellipse),
        cmocka_unit_test(degenerate_arcs_are_what_the_appendix_says),
        cmocka_unit_test(circles_stay_within_the_tolerance_and_keep_their_extremes),
        cmocka_unit_test(transforms_are_the_matrices_of_the_standard),
        cmocka_unit_test(broken_transforms_are_refused),
        cmocka_unit_test(exact_transforms_keep_every_bit),
        cmocka_unit_test(the_tolerance_is_of_the_stack_not_of_the_drawing),
        cmocka_unit_test(sines_of_quarter_turns_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
