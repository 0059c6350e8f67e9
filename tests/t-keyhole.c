#include "config.h"
#include "base/alloc.h"
#include "contours.h"
#include "region/clean.h"
#include "region/keyhole.h"

static const double T = 0.05;

/* The rings that OPEN makes of IN, in order (clean), and how many were opened. */
typedef struct opening_case {
    const char *in, *out;
    size_t n;
} opening_case;

static void open_and_clean(il_slice *s, double tolerance, il_report *report)
{
    assert_int_equal(il_slice_open_keyholes(s, tolerance, report, NULL), IL_OK);
    assert_int_equal(il_slice_clean(s, &(il_clean_options){ 0 }, report, NULL, NULL), IL_OK);
}

static void assert_opens(const opening_case *c)
{
    char text[CONTOURS_TEXT];
    il_slice s = slice_of(c->in);
    il_report report = IL_REPORT_INIT;
    open_and_clean(&s, T, &report);
    assert_string_equal(slice_text(&s, text), c->out);
    assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], c->n);
    assert_int_equal(report.repair[IL_REPAIR_KEYHOLE_EDGE], 0);
    il_slice_free(&s);
}

static void assert_all_open(const opening_case *c, size_t n)
{
    for (size_t i = 0; i < n; i++)
        assert_opens(&c[i]);
}

#define OPENS(cases) assert_all_open(cases, sizeof cases / sizeof *cases)

/* Nothing is cut, not a bit is touched. */
static void assert_stays(const char *in)
{
    il_slice s = slice_of(in), as_it_was = slice_of(in);
    il_report report = IL_REPORT_INIT;
    assert_int_equal(il_slice_open_keyholes(&s, T, &report, NULL), IL_OK);
    assert_same_bits(&s, &as_it_was);
    assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], 0);
    il_slice_free(&s);
    il_slice_free(&as_it_was);
}

/* ---- what is opened ---- */

static void exact_channels_are_cut_out(void **state)
{
    (void)state;
    static const opening_case c[] = {
        /* mouth and end are vertices of the loops */
        { "0 0, 2 2, 2 4, 4 4, 4 2, 2 2, 0 0, 6 0, 6 6, 0 6", "0 0, 6 0, 6 6, 0 6; 2 2, 2 4, 4 4, 4 2", 1 },
        /* with bends, and vertices on one side only */
        { "0 0, 9 0, 9 9, 0 9, 0 0, 1 3, 3 3, 3 6, 6 6, 6 3, 3 3, 2 3, 1 3", "0 0, 9 0, 9 9, 0 9; 3 3, 3 6, 6 6, 6 3", 1 },
        /* hung on the middle of an edge */
        { "3 0, 9 0, 9 9, 0 9, 0 0, 3 0, 3 3, 3 6, 6 6, 6 3, 3 3", "0 0, 3 0, 9 0, 9 9, 0 9; 3 3, 3 6, 6 6, 6 3", 1 },
        /* repeated points everywhere */
        { "0 0, 0 0, 2 2, 2 2, 2 4, 4 4, 4 4, 4 2, 2 2, 0 0, 0 0, 6 0, 6 6, 0 6", "0 0, 6 0, 6 6, 0 6; 2 2, 2 4, 4 4, 4 2", 1 },
    };
    OPENS(c);
}

static void sides_that_are_a_little_apart_are_cut_out(void **state)
{
    (void)state;
    static const opening_case c[] = {
        { "0 0, 3 0, 3 3, 3 6, 6 6, 6 3, 3.03 3, 3.03 0, 9 0, 9 9, 0 9",
          "0 0, 3 0, 3.03 0, 9 0, 9 9, 0 9; 3 3, 3 6, 6 6, 6 3, 3.03 3", 1 },
        /* the tolerance itself */
        { "0 0, 3 0, 3 3, 3 6, 6 6, 6 3, 3.05 3, 3.05 0, 9 0, 9 9, 0 9",
          "0 0, 3 0, 3.05 0, 9 0, 9 9, 0 9; 3 3, 3 6, 6 6, 6 3, 3.05 3", 1 },
        /* other vertices on either side */
        { "0 0, 3 0, 3.01 0.9, 2.99 1.7, 3 3, 3 6, 6 6, 6 3, 3.03 3, 3.02 2, 3.03 1, 3.01 0.5, 3.03 0, 9 0, 9 9, 0 9",
          "0 0, 3 0, 3.03 0, 9 0, 9 9, 0 9; 3 3, 3 6, 6 6, 6 3, 3.03 3", 1 },
        /* with a bend */
        { "0 0, 3 0, 3 2, 5 2, 5 6, 7 6, 7 1.97, 3.03 1.97, 3.03 0, 9 0, 9 9, 0 9",
          "0 0, 3 0, 3.03 0, 9 0, 9 9, 0 9; 5 2, 5 6, 7 6, 7 1.97", 1 },
    };
    OPENS(c);
}

static void sides_that_cross_are_cut_out(void **state)
{
    (void)state;
    static const char in[] = "0 0, 3.02 0, 2.98 1, 3.02 2, 2.99 3, 3 6, 6 6, 6 3, 3.01 3.01, 2.98 2, 3.01 1, 2.99 0, 9 0, 9 9, 0 9";
    il_slice s = slice_of(in);
    il_report report = IL_REPORT_INIT;
    assert_int_equal(il_slice_open_keyholes(&s, T, &report, NULL), IL_OK);
    assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], 1);
    assert_int_equal(s.n, 2);
    il_slice_clean(&s, &(il_clean_options){ 0 }, NULL, NULL, NULL);
    assert_true(fabs(il_slice_area(&s) - 72) < 0.1);
    il_slice_free(&s);
}

static void the_loops_need_no_vertex_where_the_channel_goes_on_straight(void **state)
{
    (void)state;
    static const opening_case c[] = {
        /* the outline comes up along the channel's line, and the hole goes on along it */
        { "3 -5, 3 3, 0 3, 0 6, 3.02 6, 3.02 0, 9 0, 9 9, -3 9, -3 -5",
          "-3 -5, 3 -5, 3.02 0, 9 0, 9 9, -3 9; 0 3, 0 6, 3.02 6, 3 3", 1 },
    };
    OPENS(c);
}

static void many_channels_of_a_ring_are_cut_out(void **state)
{
    (void)state;
    static const opening_case c[] = {
        /* two on one outline */
        { "0 0, 3 0, 3 3, 3 6, 6 6, 6 3, 3.03 3, 3.03 0, 20 0, 20 9, 15 9, 15 6, 16 3, 12 3, 12 6, 14.98 6, 14.97 9, 0 9",
          "0 0, 3 0, 3.03 0, 20 0, 20 9, 15 9, 14.97 9, 0 9; 3 3, 3 6, 6 6, 6 3, 3.03 3; 12 3, 12 6, 14.98 6, 15 6, 16 3", 2 },
        /* an island in the hole, hung on its keyhole */
        { "0 0, 9 0, 9 9, 0 9, 0 0, 2 2, 2 7, 7 7, 7 2, 2 2, 3 3, 6 3, 6 6, 3 6, 3 3, 2 2, 0 0",
          "0 0, 9 0, 9 9, 0 9; 2 2, 2 7, 7 7, 7 2; 3 3, 6 3, 6 6, 3 6", 2 },
        /* from hole to hole */
        { "0 0, 3 0, 3 3, 1 3, 1 6, 6 6, 6 5, 8 5, 8 8, 11 8, 11 4.97, 8 4.97, 6 4.97, 6 3, 3.03 3, 3.03 0, 20 0, 20 9, 0 9",
          "0 0, 3 0, 3.03 0, 20 0, 20 9, 0 9; 1 3, 1 6, 6 6, 6 5, 6 4.97, 6 3, 3.03 3, 3 3; 8 4.97, 8 5, 8 8, 11 8, 11 4.97", 2 },
        /* one way in for two holes */
        { "0 0, 4 0, 4 3, 1 3, 1 6, 4 6, 4 3, 4 0, 4 3, 4.1 5, 7 6, 7 3, 4 3, 4 0, 9 0, 9 9, 0 9",
          "0 0, 4 0, 9 0, 9 9, 0 9; 1 3, 1 6, 4 6, 4 3; 4 3, 4.1 5, 7 6, 7 3", 2 },
    };
    OPENS(c);
}

/* Squares in one another, from LOW to HIGH in x and y, each hung on the one around it by a
 * channel with sides GAP apart, by turns from the left and from the right.  The levels
 * run as they should for TWIST 30, else some run the other way, and the sides cross. */
static void add_nested(il_ring *r, int level, int depth, double low, double high, double gap, int twist)
{
    double middle = (low + high) / 2, away = level % 2 ? high : low, other = level % 2 ? low : high, up = level >> twist & 1 ? -1 : 1;
    double first[6] = { away, middle, away, middle - up * (high - low) / 2, other, middle - up * (high - low) / 2 };
    double last[6] = { other, middle + up * (high - low) / 2, away, middle + up * (high - low) / 2, away, middle + up * gap };
    for (int k = 0; k < 3; k++)
        assert_true(il_ring_add(r, first[2 * k], first[2 * k + 1], 0));
    if (level < depth) {
        assert_true(il_ring_add(r, other, middle, 0));
        add_nested(r, level + 1, depth, low + 2, high - 2, gap, twist);
        assert_true(il_ring_add(r, other, middle + up * gap, 0));
    }
    for (int k = 0; k < 3; k++)
        assert_true(il_ring_add(r, last[2 * k], last[2 * k + 1], 0));
}

static void nested_keyholes_come_apart_level_by_level(void **state)
{
    (void)state;
    for (int depth = 0; depth < 12; depth++)
        for (int g = 0; g < 9; g++) {
            static const int twists[] = { 30, 0, 1 };
            il_slice s = IL_SLICE_INIT;
            il_report report = IL_REPORT_INIT;
            double area = 0;
            for (int k = 0; k <= depth; k++)
                area += (k % 2 ? -1 : 1) * pow(60 - 4 * k, 2);
            add_nested(il_slice_add_ring(&s), 0, depth, 0, 60, 0.02 * (g % 3), twists[g / 3]);
            open_and_clean(&s, T, &report);
            assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], depth);
            assert_int_equal(s.n, depth + 1);
            assert_true(fabs(il_slice_area(&s) - area) < (twists[g / 3] == 30 ? 1e-9 : 1e-3));
            il_slice_free(&s);
        }
}

static void a_ring_drawn_as_a_band_that_is_closed_by_a_keyhole_comes_apart(void **state)
{
    (void)state;
    static const opening_case c[] = {
        { "0 0, 20 0, 20 20, 0 20, 0 0, 0.5 0.5, 0.5 19.5, 19.5 19.5, 19.5 0.5, 0.5 0.5",
          "0 0, 20 0, 20 20, 0 20; 0.5 0.5, 0.5 19.5, 19.5 19.5, 19.5 0.5", 1 },
        { "0 10, 0 0, 20 0, 20 20, 0 20, 0 10.02, 0.5 10.02, 0.5 19.5, 19.5 19.5, 19.5 0.5, 0.5 0.5, 0.5 10",
          "0 0, 20 0, 20 20, 0 20, 0 10.02, 0 10; 0.5 0.5, 0.5 10, 0.5 10.02, 0.5 19.5, 19.5 19.5, 19.5 0.5", 1 },
    };
    OPENS(c);
}

/* ---- what stays ---- */

static void sides_that_are_too_far_apart_stay(void **state)
{
    (void)state;
    assert_stays("0 0, 3 0, 3 3, 3 6, 6 6, 6 3, 3.06 3, 3.06 0, 9 0, 9 9, 0 9");
}

static void tongues_without_a_loop_stay(void **state)
{
    (void)state;
    assert_stays("0 0, 9 0, 9 9, 5.03 9, 5.02 15, 5 15, 5 9, 0 9");                      /* of tissue */
    assert_stays("0 0, 9 0, 9 9, 5.03 9, 5.02 3, 5 3, 5 9, 0 9");                        /* a cleft */
    assert_stays("0 0, 9 0, 9 9, 5.03 9, 5.02 15, 5.01 15.3, 5 15, 5 9, 0 9");
    assert_stays("0 0, 9 0, 9 9, 5.03 9, 5.03 15, 5.09 15.1, 4.94 15.1, 5 15, 5 9, 0 9");  /* with a knob */
    assert_stays("0 0, 9 0, 9 9, 5.03 9, 5.03 12, 5.06 13, 5.06 22, 5 22, 5 13, 5 12, 5 9, 0 9"); /* that gets a little wider */
}

static void loops_without_a_channel_stay(void **state)
{
    (void)state;
    assert_stays("0 0, 9 0, 9 9, 0 9");
    assert_stays("0 0, 2 2, 2 4, 4 2, 0 0, 6 0, 6 6, 0 6");                               /* a hole that touches the outside */
    assert_stays("0 0, 4 0, 4.01 0.1, 4 0.2, 2 4, 6 4, 4.03 0.2, 4.04 0.1, 4.05 0, 8 0, 8 8, 0 8"); /* a short one */
    assert_stays("0 0, 2 4, 6 4, 0.01 0, 8 0, 8 8, 0 8");                                  /* a funnel */
    assert_stays("0 0, 0.03 0, 0.03 0.02, 0 0.02");                                          /* all within the tolerance */
    assert_stays("0 0, 9 0");
    assert_stays("");
}

/* Two discs of radius R in one ring, joined by a waist of width W. */
static il_slice waist(double radius, double w, size_t n)
{
    il_slice s = IL_SLICE_INIT;
    il_ring *r = il_slice_add_ring(&s);
    double opening = 3 * sqrt(w / radius);
    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k <= n; k++) {
            double t = -3.14159265358979 + opening / 2 + (6.28318530717959 - opening) * (double)k / (double)n;
            double x = radius * (1 + cos(t)) - sqrt(w * radius), y = radius * sin(t);
            assert_true(il_ring_add(r, side ? -x : x, side ? -y : y, 0));
        }
    return s;
}

static void waists_between_round_parts_stay(void **state)
{
    (void)state;
    for (double radius = 0.5; radius < 400; radius *= 2.5)
        for (double w = 0.01; w < 0.2; w *= 2)
            for (size_t n = 40; n < 2000; n *= 6) {
                il_slice s = waist(radius, w, n);
                il_report report = IL_REPORT_INIT;
                assert_int_equal(il_slice_open_keyholes(&s, T, &report, NULL), IL_OK);
                assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], 0);
                assert_int_equal(s.n, 1);
                il_slice_free(&s);
            }
}

static void without_a_tolerance_and_of_open_lines_nothing_is_cut(void **state)
{
    (void)state;
    static const char in[] = "0 0, 2 2, 2 4, 4 4, 4 2, 2 2, 0 0, 6 0, 6 6, 0 6";
    il_slice s = slice_of(in), as_it_was = slice_of(in);
    assert_int_equal(il_slice_open_keyholes(&s, 0, NULL, NULL), IL_OK);
    assert_same_bits(&s, &as_it_was);
    s.ring[0].open = true;
    assert_int_equal(il_slice_open_keyholes(&s, T, NULL, NULL), IL_OK);
    assert_same_bits(&s, &as_it_was);
    il_slice_free(&s);
    il_slice_free(&as_it_was);
}

/* ---- made from their parts ---- */

/* An outline with up to 5 holes, each hung on it by a channel that starts from a
 * corner of a comb; what it is made of is known. */
typedef struct drawing {
    il_slice ring;      /* the one ring */
    il_slice loops;     /* what it should come to, clean */
    size_t n_holes;
    double channels;    /* area within which that is to hold */
} drawing;

static double shake(uint64_t *seed, double by)
{
    return by * (2 * stack_uniform(seed) - 1);
}

/* Points of the side X, from Y0 to Y1, shaken by BY but at its ends. */
static void add_side(il_ring *r, uint64_t *seed, double x, double y0, double y1, double by)
{
    size_t n = (size_t)(stack_random(seed) % 6);
    for (size_t k = 0; k <= n + 1; k++) {
        bool is_end = k == 0 || k == n + 1;
        double y = k > n ? y1 : y0 + (y1 - y0) * (double)k / (double)(n + 1);
        assert_true(il_ring_add(r, x + (is_end ? 0 : shake(seed, by)), y, 0));
    }
}

static drawing draw(uint64_t seed, double gap, double by)
{
    drawing d = { IL_SLICE_INIT, IL_SLICE_INIT, 1 + stack_random(&seed) % 5, 0 };
    il_ring *r = il_slice_add_ring(&d.ring);
    for (size_t k = 0; k <= d.n_holes; k++)
        il_slice_add_ring(&d.loops);
    il_ring *outer = &d.loops.ring[0];
    double width = 10 * (double)d.n_holes, corner[6] = { width, 0, width, 12, 0, 12 };
    il_ring_add(r, 0, 0, 0);
    il_ring_add(outer, 0, 0, 0);
    for (size_t h = 0; h < d.n_holes; h++) {
        double x = 10 * (double)h + 4 + stack_uniform(&seed), end = 2 + 3 * stack_uniform(&seed), top = end + 1 + 4 * stack_uniform(&seed);
        double loop[8] = { x - 3, end, x - 2 - stack_uniform(&seed), top, x + 2 + stack_uniform(&seed), top, x + 3, end };
        add_side(r, &seed, x, 0, end, by);
        il_ring_add(outer, x, 0, 0);
        il_ring_add(&d.loops.ring[h + 1], x, end, 0);
        for (int k = 0; k < 4; k++) {
            il_ring_add(r, loop[2 * k], loop[2 * k + 1], 0);
            il_ring_add(&d.loops.ring[h + 1], loop[2 * k], loop[2 * k + 1], 0);
        }
        add_side(r, &seed, x + gap, end, 0, by);
        if (gap > 0) {
            il_ring_add(&d.loops.ring[h + 1], x + gap, end, 0);
            il_ring_add(outer, x + gap, 0, 0);
        }
        d.channels += end * (gap + 2 * by);
    }
    for (int k = 0; k < 3; k++) {
        il_ring_add(r, corner[2 * k], corner[2 * k + 1], 0);
        il_ring_add(outer, corner[2 * k], corner[2 * k + 1], 0);
    }
    return d;
}

/* The same ring from another start, the other way round, or moved by a turn. */
static void vary(il_slice *s, uint64_t variant)
{
    il_ring *r = &s->ring[0];
    if (variant & 1)
        il_ring_reverse(r);
    il_ring_rotate(r, (size_t)(variant >> 1) % r->n);
}

static void drawings_come_to_the_loops_they_are_made_of(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 600; seed++) {
        double gap = seed % 3 == 0 ? 0 : seed % 3 == 1 ? 0.01 : 0.03, by = seed % 4 < 2 ? 0 : 0.008;
        drawing d = draw(seed, gap, by);
        il_report report = IL_REPORT_INIT;
        vary(&d.ring, seed * 7);
        open_and_clean(&d.ring, T, &report);
        open_and_clean(&d.loops, 0, NULL);
        assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], d.n_holes);
        assert_same_bits(&d.ring, &d.loops);
        il_slice_free(&d.ring);
        il_slice_free(&d.loops);
    }
}

static void with_less_tolerance_than_their_gap_drawings_stay(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 100; seed++) {
        drawing d = draw(seed, 0.03, 0.004);
        il_report report = IL_REPORT_INIT;
        double area = il_slice_area(&d.ring);
        vary(&d.ring, seed * 5);
        open_and_clean(&d.ring, 0.02, &report);
        assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], 0);
        assert_true(fabs(fabs(il_slice_area(&d.ring)) - fabs(area)) < 1e-9);
        il_slice_free(&d.ring);
        il_slice_free(&d.loops);
    }
}

static void every_start_and_direction_and_every_turn_gives_the_same(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 12; seed++) {
        drawing d = draw(seed, 0.02, 0.005);
        size_t n = d.ring.ring[0].n;
        double angle = 0.1 + 0.5 * (double)seed;
        for (uint64_t variant = 0; variant < 2 * n; variant++) {
            drawing v = draw(seed, 0.02, 0.005);
            il_report report = IL_REPORT_INIT;
            vary(&v.ring, variant);
            if (variant % 3 == 0)
                for (size_t k = 0; k < n; k++) {
                    double *p = v.ring.ring[0].xy + 2 * k, x = p[0], y = p[1];
                    p[0] = cos(angle) * x - sin(angle) * y + 300;
                    p[1] = sin(angle) * x + cos(angle) * y - 400;
                }
            assert_int_equal(il_slice_open_keyholes(&v.ring, T, &report, NULL), IL_OK);
            assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], d.n_holes);
            assert_int_equal(v.ring.n, d.n_holes + 1);
            assert_int_equal(il_slice_points(&v.ring), il_slice_points(&d.loops));
            il_slice_free(&v.ring);
            il_slice_free(&v.loops);
        }
        il_slice_free(&d.ring);
        il_slice_free(&d.loops);
    }
}

/* Whatever is cut, the region changes by no more than the channels' area. */
static void no_area_goes_but_that_of_channels(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 300; seed++) {
        uint64_t random = seed;
        il_slice s = random_tangle(&random, 7);
        size_t n = 0;
        double *e = edges_of(&s, &n), before = even_odd_area(e, n), length = 0;
        for (size_t i = 0; i < s.n; i++) {
            il_ring *r = &s.ring[i];
            length += il_ring_length(r);
            for (size_t k = 0; k < 2 * r->n; k++)
                r->xy[k] += shake(&random, 0.01);
        }
        free(e);
        assert_int_equal(il_slice_open_keyholes(&s, T, NULL, NULL), IL_OK);
        e = edges_of(&s, &n);
        assert_true(fabs(even_odd_area(e, n) - before) <= 2 * T * length);
        free(e);
        il_slice_free(&s);
    }
}

/* A ring of many turns back and forth, nearer to one another than the tolerance. */
static void a_ring_too_dense_to_tell_is_left_in_no_time(void **state)
{
    (void)state;
    il_slice s = IL_SLICE_INIT;
    il_ring *r = il_slice_add_ring(&s);
    enum { TURNS = 20000 };
    for (int k = 0; k < TURNS; k++) {
        il_ring_add(r, 1e-5 * k, k % 2 ? 9 : 0, 0);
        il_ring_add(r, 1e-5 * k, k % 2 ? 0 : 9, 0);
    }
    il_ring_add(r, -5, 5, 0);
    assert_int_equal(il_slice_open_keyholes(&s, T, NULL, NULL), IL_OK);
    assert_int_equal(s.n, 1);
    il_slice_free(&s);
}

static void without_memory_nothing_is_lost(void **state)
{
    (void)state;
    il_status st = IL_E_NOMEM;
    for (long k = 0; st != IL_OK; k++) {
        il_error err = IL_ERROR_INIT;
        drawing d = draw(3, 0.02, 0.005), same = draw(3, 0.02, 0.005);
        il_alloc_test_fail_after(k);
        st = il_slice_open_keyholes(&d.ring, T, NULL, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM));
        if (st != IL_OK)
            assert_same_bits(&d.ring, &same.ring);
        il_slice_free(&d.ring);
        il_slice_free(&d.loops);
        il_slice_free(&same.ring);
        il_slice_free(&same.loops);
        assert_true(k < 1000);
    }
}

/* ---- what else a ring has ---- */

static void what_belongs_to_a_ring_stays_with_its_first_loop(void **state)
{
    (void)state;
    il_slice s = slice_of("0 0, 9 0, 9 9, 0 9, 0 0, 2 2, 2 7, 7 7, 7 2, 2 2");
    il_ring *r = &s.ring[0];
    r->line = 17;
    r->mark = il_calloc(r->n, 1);
    r->cap_mark = r->n;
    r->mark[2] = IL_VERTEX_INSERTED;
    r->mark[4] = IL_VERTEX_MAP_EDGE;
    assert_true(il_extra_add(&r->extra, "x-1", 3));
    assert_int_equal(il_slice_open_keyholes(&s, T, NULL, NULL), IL_OK);
    assert_int_equal(s.n, 2);
    assert_int_equal(s.ring[0].line, 17);
    assert_int_equal(s.ring[1].line, 17);
    assert_non_null(s.ring[0].extra);
    assert_null(s.ring[1].extra);
    assert_int_equal(s.ring[0].mark[2], IL_VERTEX_INSERTED);
    for (size_t k = 0; k < s.ring[0].n; k++)
        assert_int_equal(s.ring[0].mark[k] & IL_VERTEX_MAP_EDGE, 0);
    il_slice_free(&s);
}

static void the_next_slices_rings_are_looked_at_too(void **state)
{
    (void)state;
    il_slice s = slice_of("20 0, 22 2, 22 4, 24 4, 24 2, 22 2, 20 0, 26 0, 26 6, 20 6; "
                          "0 0, 2 2, 2 4, 4 4, 4 2, 2 2, 0 0, 6 0, 6 6, 0 6; 40 0, 41 0, 41 1");
    il_report report = IL_REPORT_INIT;
    assert_int_equal(il_slice_open_keyholes(&s, T, &report, NULL), IL_OK);
    assert_int_equal(report.repair[IL_REPAIR_KEYHOLE], 2);
    assert_int_equal(s.n, 5);
    il_slice_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_channels_are_cut_out),
        cmocka_unit_test(sides_that_are_a_little_apart_are_cut_out),
        cmocka_unit_test(sides_that_cross_are_cut_out),
        cmocka_unit_test(the_loops_need_no_vertex_where_the_channel_goes_on_straight),
        cmocka_unit_test(many_channels_of_a_ring_are_cut_out),
        cmocka_unit_test(nested_keyholes_come_apart_level_by_level),
        cmocka_unit_test(a_ring_drawn_as_a_band_that_is_closed_by_a_keyhole_comes_apart),
        cmocka_unit_test(sides_that_are_too_far_apart_stay),
        cmocka_unit_test(tongues_without_a_loop_stay),
        cmocka_unit_test(loops_without_a_channel_stay),
        cmocka_unit_test(waists_between_round_parts_stay),
        cmocka_unit_test(without_a_tolerance_and_of_open_lines_nothing_is_cut),
        cmocka_unit_test(drawings_come_to_the_loops_they_are_made_of),
        cmocka_unit_test(with_less_tolerance_than_their_gap_drawings_stay),
        cmocka_unit_test(every_start_and_direction_and_every_turn_gives_the_same),
        cmocka_unit_test(no_area_goes_but_that_of_channels),
        cmocka_unit_test(a_ring_too_dense_to_tell_is_left_in_no_time),
        cmocka_unit_test(without_memory_nothing_is_lost),
        cmocka_unit_test(what_belongs_to_a_ring_stays_with_its_first_loop),
        cmocka_unit_test(the_next_slices_rings_are_looked_at_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
