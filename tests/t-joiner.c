#include "config.h"
#include "contours.h"
#include "base/alloc.h"
#include "model/order.h"
#include "region/join-gaps.h"
#include "region/joiner.h"

/* ---- lines as text: "0 0, 1 0; o 5 5, 6 5, 6 6" is an open line and a ring ---- */

static il_slice lines_of(const char *s)
{
    il_slice slice = IL_SLICE_INIT;
    while (*s) {
        il_ring *r = il_slice_add_ring(&slice);
        assert_non_null(r);
        s += strspn(s, " ");
        r->open = *s != 'o';
        s += !r->open;
        while (*s && *s != ';') {
            char *end;
            double x = strtod(s, &end), y = strtod(end, &end);
            assert_true(end > s);
            assert_true(il_ring_add(r, x, y, 0));
            s = *end == ',' ? end + 1 : end;
        }
        s += *s == ';';
    }
    return slice;
}

static char *lines_text(const il_slice *s, char *to)
{
    size_t n = 0;
    *to = '\0';
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        n += (size_t)snprintf(to + n, CONTOURS_TEXT - n, "%s%s", i > 0 ? "; " : "", r->open ? "" : "o ");
        for (size_t k = 0; k < r->n && n < CONTOURS_TEXT - 100; k++)
            n += (size_t)snprintf(to + n, CONTOURS_TEXT - n, "%s%.10g %.10g", k > 0 ? ", " : "", r->xy[2 * k], r->xy[2 * k + 1]);
    }
    return to;
}

typedef struct join_case { const char *in, *out, *repairs; } join_case;

static void assert_joined(const char *in, const char *out, const char *repairs, double distance)
{
    char text[CONTOURS_TEXT];
    const il_join_options o = { distance };
    il_slice s = lines_of(in);
    il_report report = IL_REPORT_INIT;
    double largest = 0;
    assert_int_equal(il_slice_join(&s, &o, &report, NULL, &largest, NULL), IL_OK);
    assert_string_equal(lines_text(&s, text), out);
    assert_string_equal(repairs_text(&report, text), repairs);
    il_slice_free(&s);
}

/* In any order of the lines that is as good as another, and once more. */
static void assert_joins(const join_case *c, double distance)
{
    assert_joined(c->in, c->out, c->repairs, distance);
    il_slice s = lines_of(c->in);
    char text[CONTOURS_TEXT];
    const il_join_options o = { distance };
    double largest = 0;
    bool changed = true;
    for (size_t i = 0; i < s.n / 2; i++) {
        il_ring swap = s.ring[i];
        s.ring[i] = s.ring[s.n - 1 - i];
        s.ring[s.n - 1 - i] = swap;
    }
    assert_int_equal(il_slice_join(&s, &o, NULL, &changed, &largest, NULL), IL_OK);
    assert_string_equal(lines_text(&s, text), c->out);
    assert_int_equal(il_slice_join(&s, &o, NULL, &changed, &largest, NULL), IL_OK);
    assert_string_equal(lines_text(&s, text), c->out);
    assert_false(changed);
    il_slice_free(&s);
}

#define JOINS(cases) \
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) \
        assert_joins(&cases[i], 0)

/* ---- one thing at a time ---- */

static void what_is_whole_stays(void **state)
{
    (void)state;
    static const join_case c[] = {
        { "", "", "" },
        { "0 0, 1 0, 2 1", "0 0, 1 0, 2 1", "" },
        { "2 1, 1 0, 0 0", "2 1, 1 0, 0 0", "" },
        { "o 0 0, 1 0, 1 1", "o 0 0, 1 0, 1 1", "" },
        { "o 0 0, 1 1, 1 0", "o 0 0, 1 1, 1 0", "" },
        { "o 1 1, 0 0, 1 0", "o 0 0, 1 0, 1 1", "" },
        { "3 3, 4 4, 5 4; o 0 0, 1 0, 1 1; 0 9, 1 9, 2 9", "o 0 0, 1 0, 1 1; 0 9, 1 9, 2 9; 3 3, 4 4, 5 4", "" },
        { "0 0, 1 1, 2 0; 1 1, 1 2, 1 3", "0 0, 1 1, 2 0; 1 1, 1 2, 1 3", "" }, /* an end on a line is no end of that */
        { "0 0, 2 2, 4 4; 0 4, 2 2, 4 0", "0 0, 2 2, 4 4; 0 4, 2 2, 4 0", "" },
    };
    JOINS(c);
}

static void repeated_points_and_lines_of_one_are_dropped(void **state)
{
    (void)state;
    static const join_case c[] = {
        { "0 0, 0 0, 1 0, 1 0, 1 0, 2 1, 2 1", "0 0, 1 0, 2 1", "repeated_points 4" },
        { "o 0 0, 1 0, 1 1, 0 0, 0 0", "o 0 0, 1 0, 1 1", "repeated_points 2" },
        { "0 0, 1 0, 1 1, 0 0", "o 0 0, 1 0, 1 1", "joined_lines 1" },
        { "0 0, 1 0, 1 1, 0 0, 0 0", "o 0 0, 1 0, 1 1", "repeated_points 1, joined_lines 1" },
        { "5 5; 6 6, 6 6; o 7 7", "", "repeated_points 1, point_lines 3" },
        { "-0 0, 0 -0, 1 0, 2 0", "0 0, 1 0, 2 0", "repeated_points 1" },
    };
    JOINS(c);
}

static void there_and_back_is_no_ring(void **state)
{
    (void)state;
    static const join_case c[] = {
        { "0 0, 1 0, 0 0", "", "degenerate_rings 1, joined_lines 1" },
        { "o 0 0, 1 0", "", "degenerate_rings 1" },
        { "0 0, 1 0; 1 0, 0 0", "0 0, 1 0", "duplicate_lines 1, crumbs 1" },
    };
    JOINS(c);
}

static void two_ends_that_meet_are_joined(void **state)
{
    (void)state;
    static const join_case c[] = {
        { "0 0, 1 0; 1 0, 2 1", "0 0, 1 0, 2 1", "joined_lines 1" },
        { "1 0, 2 1, 3 1; 1 0, 0 0", "0 0, 1 0, 2 1, 3 1", "joined_lines 1, reversed_lines 1" },
        { "0 0, 1 0; 3 1, 2 1, 1 0", "3 1, 2 1, 1 0, 0 0", "joined_lines 1, reversed_lines 1" },
        { "1 0, 0 0; 1 0, 2 0", "0 0, 1 0, 2 0", "joined_lines 1, reversed_lines 1" }, /* a tie: the least sequence */
        { "0 0, 1 0; 2 0, 1 0", "0 0, 1 0, 2 0", "joined_lines 1, reversed_lines 1" },
        { "0 0, 1 0; 1 1, 1 0; 1 1, 0 0", "o 0 0, 1 0, 1 1", "joined_lines 3, reversed_lines 1" },
        { "0 0, 1 0; 1 0, 1 1, 0 0", "o 0 0, 1 0, 1 1", "joined_lines 2" },
        { "1 0, 0 0; 0 0, 1 1, 1 0", "o 0 0, 1 1, 1 0", "joined_lines 2" },
        { "0 0, 1 0; 5 5, 6 6", "0 0, 1 0; 5 5, 6 6", "crumbs 2" },
    };
    JOINS(c);
}

static void knots_stay_apart_but_for_loops(void **state)
{
    (void)state;
    static const join_case c[] = {
        { "0 0, 5 5, 9 9; 9 9, 9 0; 9 9, 20 9", "0 0, 5 5, 9 9; 9 9, 9 0; 9 9, 20 9", "knots 1, crumbs 2" },
        { "0 0, 5 5; 5 5, 9 9; 0 9, 5 5; 5 5, 9 0", "0 0, 5 5; 0 9, 5 5; 5 5, 9 0; 5 5, 9 9", "knots 1, crumbs 4" },
        /* P: the loop closes, one end is left */
        { "0 0, 0 5; 0 5, 4 5; 4 5, 4 9; 4 9, 0 5", "o 0 5, 4 5, 4 9; 0 0, 0 5", "joined_lines 3, crumbs 1" },
        /* a loop on a line: what is left of the line is joined */
        { "0 0, 5 0; 5 0, 9 0; 5 0, 4 4; 4 4, 6 4, 5 0", "o 4 4, 6 4, 5 0; 0 0, 5 0, 9 0", "joined_lines 3" },
        /* 8: two rings */
        { "0 0, 1 1; 1 1, 2 0, 0 0; 1 1, 2 2; 2 2, 0 2, 1 1", "o 0 0, 1 1, 2 0; o 0 2, 1 1, 2 2", "joined_lines 4" },
    };
    JOINS(c);
}

/* ---- what is there twice ---- */

static void copies_are_dropped(void **state)
{
    (void)state;
    static const join_case c[] = {
        { "0 0, 1 0, 2 1; 0 0, 1 0, 2 1", "0 0, 1 0, 2 1", "duplicate_lines 1" },
        { "0 0, 1 0, 2 1; 2 1, 1 0, 0 0; 2 1, 1 0, 0 0", "2 1, 1 0, 0 0", "duplicate_lines 2" },
        { "o 0 0, 1 0, 1 1; o 1 0, 1 1, 0 0; o 1 1, 1 0, 0 0", "o 0 0, 1 0, 1 1", "duplicate_lines 2" },
        { "o 0 0, 1 0, 1 1; 1 0, 1 1, 0 0, 1 0", "o 0 0, 1 0, 1 1", "duplicate_lines 1, joined_lines 1" },
        { "0 0, 1 0, 2 1, 3 1; 1 0, 2 1", "0 0, 1 0, 2 1, 3 1", "duplicate_lines 1" },
        { "o 0 0, 9 0, 9 9, 0 9; 9 0, 9 9", "o 0 0, 9 0, 9 9, 0 9", "duplicate_lines 1" },
    };
    JOINS(c);
}

static void stretches_of_two_lines_are_kept_once(void **state)
{
    (void)state;
    static const join_case c[] = {
        /* sheets that overlap, either way round */
        { "0 0, 1 0, 2 0, 3 0; 2 0, 3 0, 4 0, 5 0", "0 0, 1 0, 2 0, 3 0, 4 0, 5 0", "shared_edges 1, joined_lines 1" },
        { "0 0, 1 0, 2 0, 3 0; 6 0, 5 0, 4 0, 3 0, 2 0", "6 0, 5 0, 4 0, 3 0, 2 0, 1 0, 0 0",
          "shared_edges 1, joined_lines 1, reversed_lines 1" },
        /* halves of a ring that overlap at both ends */
        { "0 0, 1 0, 2 0, 2 1, 2 2; 2 1, 2 2, 1 2, 0 2, 0 1, 0 0, 1 0", "o 0 0, 1 0, 2 0, 2 1, 2 2, 1 2, 0 2, 0 1",
          "shared_edges 2, joined_lines 2" },
        /* two lines that run along each other for a while and part: nobody can say which goes where */
        { "0 0, 1 1, 2 1, 3 0; 0 2, 1 1, 2 1, 3 2", "0 0, 1 1; 0 2, 1 1; 1 1, 2 1; 2 1, 3 0; 2 1, 3 2",
          "shared_edges 1, knots 2, crumbs 5" },
        /* rings with a common border */
        { "o 0 0, 1 0, 1 1, 0 1; o 1 0, 2 0, 2 1, 1 1", "o 0 0, 1 0, 2 0, 2 1, 1 1, 0 1", "shared_edges 2" },
        { "o 0 0, 1 0, 1 1, 0 1; o 1 0, 1 1, 2 1, 2 0", "1 0, 1 1; 1 1, 0 1, 0 0, 1 0; 1 1, 2 1, 2 0, 1 0",
          "shared_edges 1, knots 2, crumbs 1" },
        /* a line that nearly touches a ring, one that nearly touches itself, two that do so at the edge of the map */
        { "0 0, 0.1 1, 0.2 2, 0.3 3, 1 3, 2 3, 2.3 3, 2.2 2, 2.1 1, 2 0; o 2 3, 1 3, 1 4, 2 4",
          "0 0, 0.1 1, 0.2 2, 0.3 3, 1 3, 1 4, 2 4, 2 3, 2.3 3, 2.2 2, 2.1 1, 2 0", "shared_edges 2" },
        { "0 0, 1 0, 2 0, 3 0; o 1 0, 1 1, 2 1, 2 0", "0 0, 1 0; 1 0, 1 1, 2 1, 2 0; 1 0, 2 0; 2 0, 3 0",
          "shared_edges 1, knots 2, crumbs 3" },
        { "0 0, 1 0, 1 1, 1 2, 2 5, 3 5; 3 5, 2 5, 3 6, 4 7, 5 7, 6 7", "0 0, 1 0, 1 1, 1 2, 2 5, 3 6, 4 7, 5 7, 6 7",
          "shared_edges 2, joined_lines 1" },
        { "0 0, 1 0, 2 0, 3 1, 3 -1, 2 0, 1 0, 0 -1", "o 2 0, 3 1, 3 -1; 0 0, 1 0, 0 -1", "shared_edges 2" },
        /* sheets that overlap and whose lines go on beside each other for an edge */
        { "0 0, 1 0, 2 0, 3 0, 3.5 1; 1.5 1, 2 0, 3 0, 4 0, 5 0", "0 0, 1 0, 2 0, 3 0, 4 0, 5 0",
          "spikes 2, shared_edges 1, joined_lines 1" },
        /* three sheets in a row, the middle one all overlapped */
        { "0 0, 1 0, 2 0, 3 0; 2 0, 3 0, 4 0; 3 0, 4 0, 5 0, 6 0", "0 0, 1 0, 2 0, 3 0, 4 0, 5 0, 6 0",
          "duplicate_lines 1, joined_lines 1" },
    };
    JOINS(c);
}

static void what_a_line_has_twice_itself_is_kept_once(void **state)
{
    (void)state;
    static const join_case c[] = {
        /* digitised beyond its beginning, and round twice */
        { "0 0, 1 0, 1 1, 0 1, 0 0, 1 0, 1 1", "o 0 0, 1 0, 1 1, 0 1", "shared_edges 2, joined_lines 1" },
        { "0 0, 1 0, 1 1, 0 1, 0 0, 1 0, 1 1, 0 1, 0 0", "o 0 0, 1 0, 1 1, 0 1", "shared_edges 4, joined_lines 1" },
        { "o 1 1, 0 1, 0 0, 1 0, 1 1, 0 1, 0 0, 1 0; o 1 0, 0 0, 0 1, 1 1", "o 0 0, 1 0, 1 1, 0 1",
          "duplicate_lines 1, shared_edges 4" },
        /* a loop on a stalk */
        { "0 5, 0 0, 1 0, 2 1, 2 -1, 1 0, 0 0, 0 -5", "o 1 0, 2 1, 2 -1; 0 5, 0 0, 0 -5", "shared_edges 2" },
    };
    JOINS(c);
}

static void dead_ends_are_dropped(void **state)
{
    (void)state;
    static const join_case c[] = {
        { "0 0, 1 0, 1 1, 1 0, 2 0", "0 0, 1 0, 2 0", "spikes 1" },
        { "0 0, 1 0, 1 1, 1 2, 1 1, 1 0, 2 0, 3 0, 2 0, 4 0", "0 0, 1 0, 2 0, 4 0", "spikes 3" },
        { "0 0, 1 0, 0 0, 5 0", "0 0, 5 0", "spikes 1, crumbs 1" },
        { "0 0, 1 0, 2 0, 1 0", "0 0, 1 0", "spikes 1, crumbs 1" },
        { "o 0 0, 1 0, 2 0, 1 0, 1 5", "o 0 0, 1 0, 1 5", "spikes 1" },
        { "o 2 0, 1 0, 1 5, 0 0, 1 0", "o 0 0, 1 0, 1 5", "spikes 1" },
        { "o 1 0, 1 5, 0 0, 1 0, 2 0", "o 0 0, 1 0, 1 5", "spikes 1" },
        { "o 3 0, 2 0, 1 0, 1 5, 0 0, 1 0, 2 0", "o 0 0, 1 0, 1 5", "spikes 2" },
        { "o 2 0, 1 0, 1 5, 0 0, 1 0, 2 0, 3 0", "o 0 0, 1 0, 1 5", "spikes 2" },
        { "0 0, 1 0, 2 1, 2 -1, 1 0, 0 0", "o 1 0, 2 1, 2 -1", "spikes 1, joined_lines 1" },
        { "o 0 0, 1 0, 2 0, 1 0", "", "degenerate_rings 1, spikes 1" },
        { "0 0, 1 0, 2 0, 1 0, 0 0", "", "degenerate_rings 1, spikes 1, joined_lines 1" },
    };
    JOINS(c);
}

static void marks_of_dead_ends_go_with_them(void **state)
{
    (void)state;
    il_ring r = IL_RING_INIT;
    static const unsigned char marks[] = { 0, IL_VERTEX_INSERTED, IL_VERTEX_MAP_EDGE, IL_VERTEX_INSERTED | IL_VERTEX_MAP_EDGE, 0 };
    static const double x[] = { 0, 1, 2, 1, 0.5 };
    for (size_t k = 0; k < 5; k++)
        assert_true(il_ring_add(&r, x[k], k < 4 ? 0 : 3, marks[k]));
    assert_int_equal(il_ring_drop_spikes(&r), 1);
    assert_int_equal(r.n, 3);
    assert_int_equal(r.mark[1], IL_VERTEX_INSERTED | IL_VERTEX_MAP_EDGE);
    il_ring_free(&r);
}

/* ---- gaps ---- */

static void ends_that_lie_apart_are_joined_by_rising_distance(void **state)
{
    (void)state;
    static const join_case c[] = {
        { "0 0, 1 0, 2 0; 2.5 0, 3 0, 4 0", "0 0, 1 0, 2 0, 2.5 0, 3 0, 4 0", "bridged_gaps 1" },
        { "0 0, 1 0, 2 0; 4 0, 3 0, 2.5 0", "0 0, 1 0, 2 0, 2.5 0, 3 0, 4 0", "bridged_gaps 1, reversed_lines 1" },
        { "0 0, 1 0, 2 0; 3.5 0, 4 0, 9 0", "0 0, 1 0, 2 0; 3.5 0, 4 0, 9 0", "" },
        { "0 0, 4 0, 4 4, 0 1", "o 0 0, 4 0, 4 4, 0 1", "bridged_gaps 1" },
        { "0 0, 1 0", "0 0, 1 0", "crumbs 1" }, /* an edge is not joined with itself */
        { "0 0, 1 0; 1.5 0, 2.5 0", "0 0, 1 0, 1.5 0, 2.5 0", "bridged_gaps 1" },
        /* 3 to 3.25 first, so that 4 is left though 3 was near it */
        { "0 0, 1 9, 3 0; 3.25 0, 3.25 9, 0 9; 4 0, 9 9, 12 0", "0 0, 1 9, 3 0, 3.25 0, 3.25 9, 0 9; 4 0, 9 9, 12 0",
          "bridged_gaps 1" },
        /* equally near: the least vertices */
        { "0 0, 0 9; 1 0, 5 9; 2 0, 12 9", "0 9, 0 0, 1 0, 5 9; 2 0, 12 9", "bridged_gaps 1, reversed_lines 1, crumbs 1" },
        /* the ends of a knot are no ends that lie apart */
        { "0 0, 5 5, 9 9; 9 9, 9 0; 9 9, 20 9; 9 9.5, 9 20", "0 0, 5 5, 9 9; 9 9, 9 0; 9 9, 20 9; 9 9.5, 9 20",
          "knots 1, crumbs 3" },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++)
        assert_joins(&c[i], 1);
}

static void the_widest_gap_is_told(void **state)
{
    (void)state;
    const il_join_options o = { 3 };
    il_slice s = lines_of("0 0, 1 0; 3 0, 9 0; 11.5 0, 13 0; 20 0, 30 0");
    double largest = 1;
    assert_int_equal(il_slice_join(&s, &o, NULL, NULL, &largest, NULL), IL_OK);
    assert_int_equal(s.n, 2);
    assert_true(largest == 2.5);
    il_slice_free(&s);
}

/* Against all pairs, sorted. */
static void bridges_are_those_of_the_simple_rule(void **state)
{
    (void)state;
    enum { N = 60 };
    for (uint64_t seed = 1; seed <= 200; seed++) {
        uint64_t r = seed;
        double distance = seed % 3 == 0 ? 1e9 : 0.3, scale = seed % 5 == 0 ? 1e-7 : 1, widest, expected_widest = 0;
        il_ends a, b;
        il_keymap edges = IL_KEYMAP_INIT;
        size_t n, expected = 0;
        assert_int_equal(il_ends_init(&a, N, NULL), IL_OK);
        assert_int_equal(il_ends_init(&b, N, NULL), IL_OK);
        for (size_t k = 0; k < 2 * N; k++)
            a.at[k] = b.at[k] = (seed % 2 ? stack_uniform(&r) : (double)(stack_random(&r) % 4000)) * (k < N ? scale : 1);
        assert_int_equal(il_ends_join(&a, NULL), IL_OK);
        assert_int_equal(il_ends_join(&b, NULL), IL_OK);
        assert_int_equal(il_ends_knots(&a), 0);
        for (size_t k = 0; k < N; k += 2 + 2 * (stack_random(&r) % 2))
            assert_non_null(il_keymap_put(&edges, IL_KEYMAP_EDGE(a.place[k], a.place[k + 1]), 1));
        assert_int_equal(il_ends_bridge(&a, distance, &edges, &n, &widest, NULL), IL_OK);
        for (;;) {
            uint32_t best[2] = { IL_NO_END, IL_NO_END };
            double least = INFINITY;
            for (uint32_t i = 0; i < N; i++)
                for (uint32_t j = 0; j < N; j++) {
                    const double *p = b.at + 2 * i, *q = b.at + 2 * j;
                    double square = (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
                    bool fits = b.partner[i] == IL_NO_END && b.partner[j] == IL_NO_END && b.alive[b.place[i]] == 1 &&
                                b.alive[b.place[j]] == 1 && il_vertex_compare(p, q) < 0 && sqrt(square) <= distance &&
                                il_keymap_get(&edges, IL_KEYMAP_EDGE(b.place[i], b.place[j]), 0) == 0;
                    bool better = fits && (square < least || (square == least &&
                                  (il_vertex_compare(p, b.at + 2 * best[0]) < 0 ||
                                   (il_vertex_compare(p, b.at + 2 * best[0]) == 0 && il_vertex_compare(q, b.at + 2 * best[1]) < 0))));
                    if (better)
                        best[0] = i, best[1] = j, least = square;
                }
            if (best[0] == IL_NO_END)
                break;
            il_ends_join_two(&b, best[0], best[1]);
            expected++;
            expected_widest = sqrt(least);
        }
        assert_int_equal(n, expected);
        assert_true(widest == expected_widest);
        assert_memory_equal(a.partner, b.partner, N * sizeof *a.partner);
        il_keymap_free(&edges);
        il_ends_free(&a);
        il_ends_free(&b);
    }
}

/* ---- what goes with the points ---- */

static void marks_go_with_their_vertices_and_edges(void **state)
{
    (void)state;
    const il_join_options o = { 0 };
    double largest = 0;
    il_slice s = lines_of("0 0, 1 0, 2 0; 5 0, 4 0, 3 0, 2 0");
    il_ring *a = &s.ring[0], *b = &s.ring[1];
    unsigned char marks_a[] = { 0, IL_VERTEX_MAP_EDGE, IL_VERTEX_INSERTED };
    unsigned char marks_b[] = { IL_VERTEX_MAP_EDGE, IL_VERTEX_INSERTED, 0, 0 };
    a->n = b->n = 0;
    for (size_t k = 0; k < 3; k++)
        il_ring_add(a, (double)k, 0, marks_a[k]);
    for (size_t k = 0; k < 4; k++)
        il_ring_add(b, 5.0 - (double)k, 0, marks_b[k]);
    assert_int_equal(il_slice_join(&s, &o, NULL, NULL, &largest, NULL), IL_OK);
    assert_int_equal(s.n, 1);
    static const unsigned char expected[] = { IL_VERTEX_MAP_EDGE, IL_VERTEX_INSERTED, 0, IL_VERTEX_MAP_EDGE, 0, 0 };
    assert_int_equal(s.ring[0].n, 6);
    assert_true(s.ring[0].xy[0] == 5); /* 5 4 3 2 1 0: edges 5-4 and 2-1 were marked, and vertex 2 is one of the source's */
    for (size_t k = 0; k < 6; k++)
        assert_int_equal(s.ring[0].mark[k], expected[k]);
    il_slice_free(&s);
}

static size_t count_extra(const il_extra *e)
{
    size_t n = 0;
    for (; e; e = e->next)
        n++;
    return n;
}

static void private_lines_are_kept(void **state)
{
    (void)state;
    const il_join_options o = { 0 };
    double largest = 0;
    il_slice s = lines_of("0 0, 1 0, 2 0; 2 0, 3 0; 5 5; 0 9, 1 9; 1 9, 0 9; 1 0, 2 0");
    for (size_t i = 0; i < s.n; i++)
        assert_true(il_extra_add(&s.ring[i].extra, "x-a", 3));
    assert_true(il_extra_add(&s.extra, "x-b", 3));
    assert_int_equal(il_slice_join(&s, &o, NULL, NULL, &largest, NULL), IL_OK);
    assert_int_equal(s.n, 2);
    assert_int_equal(count_extra(s.ring[0].extra), 2);
    assert_int_equal(count_extra(s.ring[1].extra), 1);
    assert_int_equal(count_extra(s.extra), 4); /* its own, and of the three that are dropped */
    il_slice_free(&s);
}

/* ---- rings and lines cut at random come back ---- */

static void add_points(il_slice *to, const il_ring *from, size_t first, size_t n, bool backwards)
{
    il_ring *r = il_slice_add_ring(to);
    assert_non_null(r);
    r->open = true;
    for (size_t k = 0; k < n; k++) {
        size_t v = (first + k) % from->n;
        assert_true(il_ring_add(r, from->xy[2 * v], from->xy[2 * v + 1], 0));
    }
    if (backwards)
        il_ring_reverse(r);
}

/* N lines, every second a ring, without a vertex in common. */
static il_slice random_lines(uint64_t *random, size_t n)
{
    il_slice s = IL_SLICE_INIT;
    for (size_t i = 0; i < n; i++) {
        il_ring *r = il_slice_add_ring(&s);
        assert_non_null(r);
        r->open = i % 2;
        for (size_t k = 0, m = 8 + stack_random(random) % 40; k < m; k++)
            assert_true(il_ring_add(r, stack_uniform(random), stack_uniform(random), 0));
    }
    return s;
}

/* The pieces of R: from place to place, the next overlapping the one before by up to
 * LAP edges.  At most a third of the length runs backwards. */
static void cut_line(uint64_t *random, il_slice *to, const il_ring *r, size_t lap)
{
    size_t edges = r->open ? r->n - 1 : r->n, first = r->open ? 0 : stack_random(random) % r->n, turned = 0;
    for (size_t at = 0, n; at < edges; at += n) {
        n = 1 + stack_random(random) % (edges - at);
        size_t over = lap > 0 && at + n < edges ? stack_random(random) % (lap + 1) : 0;
        over = over < edges - at - n ? over : edges - at - n;
        bool backwards = lap == 0 && 6 * (turned + n) < edges && stack_random(random) % 2;
        turned += backwards ? n : 0;
        add_points(to, r, first + at, n + over + 1, backwards);
    }
}

static void shuffle(uint64_t *random, il_slice *s)
{
    for (size_t i = s->n; i > 1; i--) {
        size_t k = stack_random(random) % i;
        il_ring swap = s->ring[i - 1];
        s->ring[i - 1] = s->ring[k];
        s->ring[k] = swap;
    }
}

/* Sorted by their points, with both ways of a line told apart: those of A are those of B. */
static void assert_same_lines(il_slice *a, il_slice *b, bool directed)
{
    assert_int_equal(a->n, b->n);
    for (size_t i = 0; i < a->n + b->n && !directed; i++) {
        il_ring *r = i < a->n ? &a->ring[i] : &b->ring[i - a->n];
        if (r->open ? il_vertex_compare(r->xy, r->xy + 2 * (r->n - 1)) > 0 : il_ring_area2(r) < 0)
            il_ring_reverse(r);
    }
    il_slice_put_in_order(a);
    il_slice_put_in_order(b);
    for (size_t i = 0; i < a->n; i++)
        assert_int_equal(a->ring[i].open, b->ring[i].open);
    assert_same_bits(a, b);
}

static void what_was_cut_comes_back(void **state)
{
    (void)state;
    const il_join_options o = { 0 };
    for (uint64_t seed = 1; seed <= 600; seed++) {
        uint64_t random = seed;
        il_slice lines = random_lines(&random, 1 + seed % 9), pieces = IL_SLICE_INIT;
        size_t lap = seed % 3 == 2 ? 5 : 0;
        double largest = 0;
        for (size_t i = 0; i < lines.n; i++) {
            cut_line(&random, &pieces, &lines.ring[i], lap);
            if (seed % 4 == 3 && stack_random(&random) % 2)
                cut_line(&random, &pieces, &lines.ring[i], lap);
        }
        shuffle(&random, &pieces);
        assert_int_equal(il_slice_join(&pieces, &o, NULL, NULL, &largest, NULL), IL_OK);
        assert_same_lines(&pieces, &lines, lap == 0 && seed % 4 != 3);
        il_slice_free(&lines);
        il_slice_free(&pieces);
    }
}

/* Whatever lines there are, the result is the same in any order, and stays. */
static void the_order_of_the_lines_does_not_matter(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        uint64_t random = seed;
        const il_join_options o = { seed % 3 == 0 ? 1.5 : 0 };
        il_slice a = IL_SLICE_INIT, b;
        size_t wide = 2 + seed % 9;
        for (size_t i = 0, n = 1 + stack_random(&random) % 8; i < n; i++) {
            il_ring *r = il_slice_add_ring(&a);
            assert_non_null(r);
            r->open = stack_random(&random) % 4 > 0;
            for (size_t k = 0, m = 1 + stack_random(&random) % 7; k < m; k++)
                assert_true(il_ring_add(r, (double)(stack_random(&random) % wide), (double)(stack_random(&random) % wide), 0));
        }
        assert_int_equal(il_slice_copy(&b, &a, NULL), IL_OK);
        shuffle(&random, &b);
        double largest = 0;
        il_report first = IL_REPORT_INIT, second = IL_REPORT_INIT;
        assert_int_equal(il_slice_join(&a, &o, &first, NULL, &largest, NULL), IL_OK);
        assert_int_equal(il_slice_join(&b, &o, &second, NULL, &largest, NULL), IL_OK);
        assert_same_bits(&a, &b);
        assert_memory_equal(first.repair, second.repair, sizeof first.repair);
        il_slice_free(&b);
        assert_int_equal(il_slice_copy(&b, &a, NULL), IL_OK);
        bool changed = true;
        assert_int_equal(il_slice_join(&b, &o, NULL, &changed, &largest, NULL), IL_OK);
        assert_same_bits(&a, &b);
        assert_false(changed);
        il_slice_free(&a);
        il_slice_free(&b);
    }
}

/* ---- hostile ---- */

static void a_hundred_thousand_lines_that_meet_in_a_point_are_one_knot(void **state)
{
    (void)state;
    enum { N = 100000 };
    const il_join_options o = { 1 };
    il_slice s = IL_SLICE_INIT;
    il_report report = IL_REPORT_INIT;
    double largest = 0;
    for (size_t i = 0; i < N; i++) {
        il_ring *r = il_slice_add_ring(&s);
        assert_non_null(r);
        r->open = true;
        il_ring_add(r, 0, 0, 0);
        il_ring_add(r, 1 + 10.0 * (double)i, 10, 0);
        il_extra_add(&r->extra, "x-a", 3);
    }
    assert_int_equal(il_slice_join(&s, &o, &report, NULL, &largest, NULL), IL_OK);
    assert_int_equal(s.n, N);
    assert_int_equal(report.repair[IL_REPAIR_KNOT], 1);
    il_slice_free(&s);
}

static void crowds_of_ends_take_no_quadratic_time(void **state)
{
    (void)state;
    enum { N = 100000 };
    const il_join_options o = { 1e6 };
    for (int kind = 0; kind < 3; kind++) {
        il_slice s = IL_SLICE_INIT;
        il_report report = IL_REPORT_INIT;
        double largest = 0;
        uint64_t random = 7;
        size_t n = kind < 2 ? N : N / 5;
        for (size_t i = 0; i < n; i++) {
            double small = kind == 0 ? 1 : kind == 1 ? 1e-30 : pow(2, -(double)(i % 900));
            il_ring *r = il_slice_add_ring(&s);
            assert_non_null(r);
            r->open = true;
            for (int k = 0; k < 2; k++)
                il_ring_add(r, stack_uniform(&random) * small, stack_uniform(&random) * small, 0);
        }
        assert_int_equal(il_slice_join(&s, &o, &report, NULL, &largest, NULL), IL_OK);
        size_t n_rings = 0;
        for (size_t i = 0; i < s.n; i++)
            n_rings += !s.ring[i].open;
        assert_int_equal(report.repair[IL_REPAIR_BRIDGED_GAP] + s.n - n_rings, n);
        assert_true(s.n - n_rings <= 1); /* an edge is not joined with itself */
        il_slice_free(&s);
    }
}

static void copies_of_copies_are_dropped_in_linear_time(void **state)
{
    (void)state;
    enum { N = 1000, POINTS = 100 };
    const il_join_options o = { 0 };
    il_slice s = IL_SLICE_INIT;
    il_report report = IL_REPORT_INIT;
    double largest = 0;
    for (size_t i = 0; i < N; i++) {
        il_ring *r = il_slice_add_ring(&s);
        assert_non_null(r);
        r->open = i % 2;
        for (size_t k = 0; k < POINTS; k++)
            il_ring_add(r, (double)((k + (r->open ? 0 : i)) % POINTS), (double)((k + (r->open ? 0 : i)) % POINTS % 3), 0);
    }
    assert_int_equal(il_slice_join(&s, &o, &report, NULL, &largest, NULL), IL_OK);
    assert_int_equal(s.n, 1);
    assert_int_equal(report.repair[IL_REPAIR_DUPLICATE_LINE], N - 1);
    il_slice_free(&s);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    const il_join_options o = { 1 };
    static const char lines[] = "0 0, 1 0, 2 0, 3 0; 2 0, 3 0, 4 0; 4 0, 9 9, 0 0; 7 7; 20 0, 30 0; 30.5 0, 31 0; o 50 50, 60 50, 60 60;"
                                "60 50, 60 60; 60 60, 70 70";
    il_status st = IL_E_NOMEM;
    for (long k = 0; st == IL_E_NOMEM; k++) {
        il_slice s = lines_of(lines);
        double largest = 0;
        il_error err = IL_ERROR_INIT;
        il_alloc_test_fail_after(k);
        st = il_slice_join(&s, &o, NULL, NULL, &largest, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || err.code == IL_E_NOMEM);
        il_slice_free(&s);
    }
    assert_int_equal(st, IL_OK);
}

/* ---- where lines come from ---- */

static void a_joined_line_comes_from_where_its_first_piece_does(void **state)
{
    (void)state;
    static const char *const in[] = { "0 0, 1 0; 2 1, 3 1; 1 0, 2 1", "0 0, 1 0; 2 1, 1 0; 2 1, 3 1", "5 5, 6 5; o 0 0, 0 0, 1 0, 1 1" };
    static const long begins[] = { 1, 1, 2 };
    for (size_t k = 0; k < sizeof in / sizeof *in; k++) {
        const il_join_options o = { 0 };
        double largest = 0;
        il_slice s = lines_of(in[k]);
        for (size_t i = 0; i < s.n; i++) {
            s.ring[i].line = 10 * (long)(i + 1);
            s.ring[i].feature = (long)i + 1;
            s.ring[i].file = 100 + (uint32_t)i;
        }
        assert_int_equal(il_slice_join(&s, &o, NULL, NULL, &largest, NULL), IL_OK);
        assert_int_equal(s.ring[0].feature, begins[k]);
        assert_int_equal(s.ring[0].line, 10 * begins[k]);
        assert_int_equal(s.ring[0].file, 99 + begins[k]);
        il_slice_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_whole_stays),
        cmocka_unit_test(repeated_points_and_lines_of_one_are_dropped),
        cmocka_unit_test(there_and_back_is_no_ring),
        cmocka_unit_test(two_ends_that_meet_are_joined),
        cmocka_unit_test(knots_stay_apart_but_for_loops),
        cmocka_unit_test(copies_are_dropped),
        cmocka_unit_test(stretches_of_two_lines_are_kept_once),
        cmocka_unit_test(what_a_line_has_twice_itself_is_kept_once),
        cmocka_unit_test(dead_ends_are_dropped),
        cmocka_unit_test(marks_of_dead_ends_go_with_them),
        cmocka_unit_test(ends_that_lie_apart_are_joined_by_rising_distance),
        cmocka_unit_test(the_widest_gap_is_told),
        cmocka_unit_test(bridges_are_those_of_the_simple_rule),
        cmocka_unit_test(marks_go_with_their_vertices_and_edges),
        cmocka_unit_test(private_lines_are_kept),
        cmocka_unit_test(what_was_cut_comes_back),
        cmocka_unit_test(the_order_of_the_lines_does_not_matter),
        cmocka_unit_test(a_hundred_thousand_lines_that_meet_in_a_point_are_one_knot),
        cmocka_unit_test(crowds_of_ends_take_no_quadratic_time),
        cmocka_unit_test(copies_of_copies_are_dropped_in_linear_time),
        cmocka_unit_test(a_joined_line_comes_from_where_its_first_piece_does),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
