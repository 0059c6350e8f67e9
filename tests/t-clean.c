#include "config.h"
#include "base/number.h"
#include "contours.h"
#include "base/alloc.h"
#include "model/order.h"
#include "model/arrange.h"
#include "region/boundary.h"
#include "region/clean.h"
#include "region/separate.h"

static const il_clean_options AS_IS = { .round_float = false }, TO_FLOATS = { .round_float = true };

/* ---- each repair alone, and its account ---- */

typedef struct repair_case {
    const char *in, *out, *repairs;
    bool changed;
} repair_case;

static void assert_cleans(const repair_case *c)
{
    char text[CONTOURS_TEXT];
    il_slice s = slice_of(c->in);
    il_report report = IL_REPORT_INIT;
    bool changed = !c->changed;
    assert_int_equal(il_slice_clean(&s, &AS_IS, &report, &changed, NULL), IL_OK);
    assert_string_equal(slice_text(&s, text), c->out);
    assert_string_equal(repairs_text(&report, text), c->repairs);
    assert_int_equal(changed, c->changed);
    il_slice_free(&s);
}

static void assert_all_clean(const repair_case *c, size_t n)
{
    for (size_t i = 0; i < n; i++)
        assert_cleans(&c[i]);
}

#define CLEANS(cases) assert_all_clean(cases, sizeof cases / sizeof *cases)
#define SQUARE "0 0, 4 0, 4 4, 0 4"

static void what_is_clean_stays(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "", "", "", false },
        { SQUARE, SQUARE, "", false },
        { SQUARE "; 1 1, 1 2, 2 2, 2 1", SQUARE "; 1 1, 1 2, 2 2, 2 1", "", false },
        { "0 0, 1 0, 2 0, 4 0, 4 4", "0 0, 1 0, 2 0, 4 0, 4 4", "", false },
    };
    CLEANS(c);
}

static void other_orders_are_put_in_order_without_a_repair(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "4 4, 0 4, 0 0, 4 0", SQUARE, "", true },
        { "5 0, 6 0, 6 1; 0 0, 1 0, 1 1", "0 0, 1 0, 1 1; 5 0, 6 0, 6 1", "", true },
    };
    CLEANS(c);
}

static void repeated_points_are_dropped(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "0 0, 4 0, 4 4, 4 4, 4 4, 0 4", SQUARE, "repeated_points 2", true },
        { "0 0, 4 0, 4 4, 0 4, 0 0", SQUARE, "repeated_points 1", true },
        { "0 0, 0 0, 4 0, 4 4, 0 4, 0 0, 0 0", SQUARE, "repeated_points 3", true },
    };
    CLEANS(c);
}

static void a_ring_that_is_there_already_is_dropped(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { SQUARE "; " SQUARE, SQUARE, "duplicate_rings 1", true },
        { SQUARE "; 4 4, 0 4, 0 0, 4 0", SQUARE, "duplicate_rings 1", true },
        { SQUARE "; 4 4, 4 0, 0 0, 0 4", SQUARE, "duplicate_rings 1", true },
        { SQUARE "; " SQUARE "; " SQUARE, SQUARE, "duplicate_rings 2", true },
        { SQUARE "; 0 0, 0 4, 4 4, 4 0; 9 9, 8 9, 8 8; 8 8, 8 9, 9 9", SQUARE "; 8 8, 9 9, 8 9", "duplicate_rings 2", true },
        { SQUARE "; 0 0, 4 0, 4 4, 0 4, 0 0", SQUARE, "repeated_points 1, duplicate_rings 1", true },
    };
    CLEANS(c);
}

static void a_duplicate_that_comes_to_its_least_vertex_twice_is_known_from_any_start(void **state)
{
    (void)state;
    static const char *const start[] = {
        "0 0, 4 -3, 4 -1, 0 0, 4 1, 4 3", "0 0, 4 1, 4 3, 0 0, 4 -3, 4 -1", "4 1, 4 3, 0 0, 4 -3, 4 -1, 0 0",
        "0 0, 4 3, 4 1, 0 0, 4 -1, 4 -3", "4 -1, 4 -3, 0 0, 4 3, 4 1, 0 0" };
    for (size_t i = 0; i < 5; i++)
        for (size_t j = 0; j < 5; j++) {
            char in[200];
            snprintf(in, sizeof in, "%s; %s", start[i], start[j]);
            repair_case c = { in, "0 0, 4 -3, 4 -1; 0 0, 4 1, 4 3", i < 3 ? "duplicate_rings 1, pinches 1"
                              : "duplicate_rings 1, pinches 1, reversed_rings 1", true };
            assert_cleans(&c);
        }
}

static void rings_without_area_are_dropped(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "1 1; 0 0, 4 0; 0 0, 1 1, 3 3, 2 2; " SQUARE, SQUARE, "degenerate_rings 3", true },
        { "1 1, 1 1, 1 1", "", "repeated_points 2, degenerate_rings 1", true },
        { "0 0, 4 0, 4 4, 4 0", "", "keyhole_edges 4", true }, /* there and back */
    };
    CLEANS(c);
}

static void crossings_become_vertices_and_are_drawn_apart(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "0 0, 4 4, 4 0, 0 4", "0 0, 1.9921875 2, 0 4; 2.0078125 2, 4 0, 4 4", "crossings 1", true },
        { SQUARE "; 2 2, 6 2, 6 6, 2 6",
          "0 0, 4 0, 3.99609375 1.99609375, 2 2, 1.99609375 3.99609375, 0 4; "
          "2 6, 2.00390625 4.00390625, 4 4, 4.00390625 2.00390625, 6 2, 6 6", "crossings 2", true },
        /* three through one point: one place */
        { "0 0, 8 8, 8 6, 0 2, 0 4, 8 4", "0 0, 3.96875 3.96875, 8 4, 4.046875 4.015625, 8 6, 8 8, 3.984375 4, 0 4, 0 2, 3.98 4",
          "crossings 1", true },
    };
    assert_all_clean(c, 2);
    il_slice s = slice_of(c[2].in);
    il_report report = IL_REPORT_INIT;
    assert_int_equal(il_slice_clean(&s, &AS_IS, &report, NULL, NULL), IL_OK);
    assert_int_equal(report.repair[IL_REPAIR_CROSSING], 1);
    assert_int_equal(report.repair[IL_REPAIR_TOUCH], 0);
    il_slice_free(&s);
}

static void a_vertex_on_an_edge_becomes_a_vertex_of_both(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { SQUARE "; 4 2, 6 1, 6 3", "0 0, 4 0, 4 2, 4 4, 0 4; 4 2, 6 1, 6 3", "touches 1, pinches 1", true },
        { SQUARE "; 4 1, 6 1, 6 3, 4 3", "0 0, 4 0, 4 1, 6 1, 6 3, 4 3, 4 4, 0 4", "touches 2, keyhole_edges 2", true },
        { SQUARE "; 0 2, 1 1, 4 2, 1 3", "0 0, 4 0, 4 2, 1 1, 0 2; 0 2, 1 3, 4 2, 4 4, 0 4",
          "touches 2, pinches 2, reversed_rings 1", true },
    };
    CLEANS(c);
}

static void keyholes_are_opened(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "0 0, 2 2, 2 4, 4 4, 4 2, 2 2, 0 0, 6 0, 6 6, 0 6", "0 0, 6 0, 6 6, 0 6; 2 2, 2 4, 4 4, 4 2", "keyhole_edges 2", true },
        /* an island in the hole, hung on its keyhole */
        { "0 0, 9 0, 9 9, 0 9, 0 0, 2 2, 2 7, 7 7, 7 2, 2 2, 3 3, 6 3, 6 6, 3 6, 3 3, 2 2, 0 0",
          "0 0, 9 0, 9 9, 0 9; 2 2, 2 7, 7 7, 7 2; 3 3, 6 3, 6 6, 3 6", "repeated_points 1, keyhole_edges 4", true },
        /* a channel that starts in the middle of an edge */
        { SQUARE "; 2 0, 2 1, 3 1, 3 2, 1 2, 1 1, 2 1, 2 0", "0 0, 2 0, 4 0, 4 4, 0 4; 1 1, 1 2, 3 2, 3 1, 2 1",
          "repeated_points 1, touches 1, keyhole_edges 2, reversed_rings 1", true },
    };
    CLEANS(c);
}

static void shared_borders_vanish_and_keep_their_ends(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "0 0, 2 0, 2 2, 0 2; 2 0, 4 0, 4 2, 2 2", "0 0, 2 0, 4 0, 4 2, 2 2, 0 2", "keyhole_edges 2", true },
        { "0 0, 2 0, 2 2, 0 2; 2 0, 2 2, 4 2, 4 0", "0 0, 2 0, 4 0, 4 2, 2 2, 0 2", "keyhole_edges 2, reversed_rings 1", true },
        { SQUARE "; 4 4, 3 5, 0 4, 4 4", "0 0, 4 0, 4 4, 3 5, 0 4", "repeated_points 1, keyhole_edges 2", true },
    };
    CLEANS(c);
}

static void a_region_that_touches_itself_in_a_vertex_keeps_it(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "0 0, 2 0, 2 2, 0 2; 2 2, 4 2, 4 4, 2 4", "0 0, 2 0, 2 2, 0 2; 2 2, 4 2, 4 4, 2 4", "pinches 1", false },
        /* as one ring: two simple ones */
        { "0 0, 2 0, 2 2, 4 2, 4 4, 2 4, 2 2, 0 2", "0 0, 2 0, 2 2, 0 2; 2 2, 4 2, 4 4, 2 4", "pinches 1", true },
        /* a hole that touches the outline */
        { "0 0, 1 2, 2 1; " SQUARE, "0 0, 1 2, 2 1; " SQUARE, "pinches 1", false },
        { "0 0, 1 2, 2 1, 0 0, 4 0, 4 4, 0 4", "0 0, 1 2, 2 1; " SQUARE, "pinches 1", true },
    };
    CLEANS(c);
}

static void rings_are_turned_so_that_the_region_lies_on_the_left(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "0 0, 0 4, 4 4, 4 0", SQUARE, "reversed_rings 1", true },
        { SQUARE "; 1 1, 2 1, 2 2, 1 2", SQUARE "; 1 1, 1 2, 2 2, 2 1", "reversed_rings 1", true },
        { "0 0, 9 0, 9 9, 0 9; 1 1, 8 1, 8 8, 1 8; 2 2, 7 2, 7 7, 2 7; 3 3, 6 3, 6 6, 3 6",
          "0 0, 9 0, 9 9, 0 9; 1 1, 1 8, 8 8, 8 1; 2 2, 7 2, 7 7, 2 7; 3 3, 3 6, 6 6, 6 3", "reversed_rings 2", true },
        { "0 0, 0 9, 9 9, 9 0; 1 1, 8 1, 8 8, 1 8; 2 2, 2 7, 7 7, 7 2",
          "0 0, 9 0, 9 9, 0 9; 1 1, 1 8, 8 8, 8 1; 2 2, 7 2, 7 7, 2 7", "reversed_rings 3", true },
    };
    CLEANS(c);
}

static void spikes_vanish(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "0 0, 4 0, 4 4, 2 4, 2 6, 2 4, 0 4", "0 0, 4 0, 4 4, 2 4, 0 4", "keyhole_edges 2", true },
        { "0 0, 4 0, 4 4, 2 4, 2 1, 2 4, 0 4", "0 0, 4 0, 4 4, 2 4, 0 4", "keyhole_edges 2", true },
    };
    CLEANS(c);
}

static void an_open_line_is_refused_and_named(void **state)
{
    (void)state;
    il_slice s = slice_of(SQUARE "; 1 1, 1 1, 2 2, 3 1");
    il_error err = IL_ERROR_INIT;
    s.ring[1].open = true;
    s.ring[1].line = 7;
    assert_int_equal(il_slice_clean(&s, &AS_IS, NULL, NULL, &err), IL_E_INPUT);
    assert_int_equal(err.line, 7);
    assert_int_equal(s.ring[1].n, 4); /* the input, untouched */
    il_slice_free(&s);
}

static void negative_zeros_become_zeros(void **state)
{
    (void)state;
    il_slice s = slice_of("-0 -0, 4 -0, 4 4, -0 4; -0 -0, -1e-60 -3, 3 -3"), zero = slice_of("0 0");
    for (int pass = 0; pass < 2; pass++) {
        assert_int_equal(il_slice_clean(&s, pass ? &TO_FLOATS : &AS_IS, NULL, NULL, NULL), IL_OK);
        for (size_t i = 0; i < s.n; i++)
            for (size_t k = 0; k < 2 * s.ring[i].n; k++)
                if (s.ring[i].xy[k] == 0)
                    assert_memory_equal(&s.ring[i].xy[k], zero.ring[0].xy, sizeof(double));
    }
    il_slice_free(&s);
    il_slice_free(&zero);
}

/* ---- crossings drawn apart ---- */

static void a_crossing_with_a_vertex_where_it_would_go_stays(void **state)
{
    (void)state;
    /* the left half's copy would come to (-1, 0) */
    static const repair_case c[] = {
        { "-256 -256, 256 256, 256 -256, -256 256; -1 0, -3 -1, -3 1",
          "-256 -256, 0 0, -256 256; -3 -1, -3 1, -1 0; 0 0, 256 -256, 256 256", "crossings 1, pinches 1", true },
    };
    CLEANS(c);
}

static void a_crossing_with_a_hole_in_the_way_stays(void **state)
{
    (void)state;
    static const repair_case c[] = {
        { "-256 -256, 256 256, 256 -256, -256 256; -0.75 -0.25, -0.75 0.25, -0.5 0",
          "-256 -256, 0 0, -256 256; -0.75 -0.25, -0.75 0.25, -0.5 0; 0 0, 256 -256, 256 256", "crossings 1, pinches 1", true },
    };
    CLEANS(c);
}

static void no_inserted_position_comes_twice_after_separation(void **state)
{
    (void)state;
    il_slice s = slice_of("0 0, 4 4, 4 0, 0 4"), as_is;
    il_arrangement a = IL_ARRANGEMENT_INIT;
    size_t crossings, touches, cancelled, pinches = 0;
    assert_int_equal(il_arrangement_from_slice(&a, &s, il_slice_cell(&s, false), NULL), IL_OK);
    assert_int_equal(il_arrangement_settle(&a, &crossings, &touches, NULL), IL_OK);
    as_is = (il_slice)IL_SLICE_INIT;
    assert_int_equal(il_boundary_extract(&a, &as_is, &cancelled, &pinches, NULL), IL_OK);
    assert_int_equal(pinches, 1);
    assert_int_equal(il_slice_separate(&as_is, false, &pinches, NULL), IL_OK);
    assert_int_equal(pinches, 0);
    assert_int_equal(il_slice_separate(&as_is, false, &pinches, NULL), IL_OK);
    assert_int_equal(pinches, 0);
    il_arrangement_free(&a);
    il_slice_free(&as_is);
    il_slice_free(&s);
}

/* ---- rounding to floats ---- */

static void assert_floats(const il_slice *s)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < 2 * s->ring[i].n; k++) {
            volatile float f = (float)s->ring[i].xy[k];
            assert_true((double)f == s->ring[i].xy[k]);
        }
}

static void rounding_is_counted_with_its_largest_move(void **state)
{
    (void)state;
    il_slice s = slice_of("0 0, 1.1 0, 1.1 1.5, 0 16777217");
    il_report report = IL_REPORT_INIT;
    assert_int_equal(il_slice_clean(&s, &TO_FLOATS, &report, NULL, NULL), IL_OK);
    assert_floats(&s);
    assert_int_equal(report.repair[IL_REPAIR_ROUNDED_POINT], 3);
    assert_true(report.largest_move == 1);
    il_report_free(&report);
    il_slice_free(&s);
}

static void rounded_slices_hold_floats_alone_inserted_points_too(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        uint64_t rng = seed;
        il_slice s = random_tangle(&rng, 9);
        for (size_t i = 0; i < s.n; i++)
            for (size_t k = 0; k < 2 * s.ring[i].n; k++)
                s.ring[i].xy[k] = s.ring[i].xy[k] / 3 + (seed % 3 == 0 ? 1000 : 0);
        il_slice again;
        bool changed = true;
        assert_int_equal(il_slice_clean(&s, &TO_FLOATS, NULL, NULL, NULL), IL_OK);
        assert_floats(&s);
        assert_int_equal(il_slice_copy(&again, &s, NULL), IL_OK);
        assert_int_equal(il_slice_clean(&again, &TO_FLOATS, NULL, &changed, NULL), IL_OK);
        assert_same_bits(&s, &again);
        assert_false(changed);
        il_slice_free(&s);
        il_slice_free(&again);
    }
}

/* ---- tangles against brute force ---- */

static bool is_inserted(const il_ring *r, size_t k)
{
    return r->mark && r->mark[k] & IL_VERTEX_INSERTED;
}

/* No vertex twice in a ring, no two edges that meet. */
static void assert_apart(const il_slice *s, uint64_t seed)
{
    size_t n;
    double *e = edges_of(s, &n);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            if (edges_meet(e + 4 * i, e + 4 * j))
                fail_msg("seed %llu: edges %zu and %zu meet", (unsigned long long)seed, j, i);
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->ring[i].n; k++)
            for (size_t l = 0; l < k; l++)
                assert_false(same_place(s->ring[i].xy + 2 * k, s->ring[i].xy + 2 * l));
    free(e);
}

/* Just left of every edge is inside, just right of it is outside. */
static void assert_region_on_the_left(const il_slice *s)
{
    size_t n;
    double *e = edges_of(s, &n);
    for (size_t i = 0; i < n; i++) {
        const double *a = e + 4 * i;
        double x = (a[0] + a[2]) / 2, y = (a[1] + a[3]) / 2, ux = a[2] - a[0], uy = a[3] - a[1];
        double step = 1e-9 / hypot(ux, uy);
        assert_true(is_inside(e, n, x - step * uy, y + step * ux));
        assert_false(is_inside(e, n, x + step * uy, y - step * ux));
    }
    free(e);
}

/* Every ring from its least vertex on, rings sorted. */
static void assert_canonical(const il_slice *s)
{
    assert_true(il_slice_in_order(s));
    for (size_t i = 0; i < s->n; i++) {
        const double *p = s->ring[i].xy;
        for (size_t k = 1; k < s->ring[i].n; k++)
            assert_true(p[0] < p[2 * k] || (p[0] == p[2 * k] && p[1] < p[2 * k + 1]));
        if (i > 0)
            assert_true(s->ring[i - 1].xy[0] <= p[0]);
    }
}

static bool equal_rings(const il_ring *r, const il_ring *q)
{
    bool equal = false;
    for (size_t start = 0; r->n == q->n && start < r->n; start++)
        for (int way = 0; way < 2; way++) {
            size_t k = 0;
            while (k < r->n && same_place(r->xy + 2 * k, q->xy + 2 * (way ? (start + r->n - k) % r->n : (start + k) % r->n)))
                k++;
            equal = equal || k == r->n;
        }
    return equal;
}

static bool is_line(const il_ring *r)
{
    for (size_t i = 2; i < r->n; i++)
        if (il_orientation(r->xy, r->xy + 2, r->xy + 2 * i) != 0)
            return false;
    return true;
}

/* The input as even-odd sees it: without repeated points, lines, and duplicate rings. */
static il_slice without_duplicates(const il_slice *s)
{
    il_slice out = IL_SLICE_INIT;
    for (size_t i = 0; i < s->n; i++) {
        const il_ring *r = &s->ring[i];
        il_ring *q = il_slice_add_ring(&out);
        for (size_t k = 0; k < r->n; k++)
            if (!same_place(r->xy + 2 * k, r->xy + 2 * ((k + 1) % r->n)))
                assert_true(il_ring_add(q, r->xy[2 * k], r->xy[2 * k + 1], 0));
        bool known = is_line(q);
        for (size_t j = 0; j + 1 < out.n; j++)
            known = known || equal_rings(q, &out.ring[j]);
        if (known) {
            il_ring_free(q);
            out.n--;
        }
    }
    return out;
}

/* Does the region's border pass P, of points on a grid of whole numbers?  Then it
 * is inside in some sectors between the edges at P, and outside in others. */
static bool border_passes(const double *e, size_t n, const double *p)
{
    double angle[200];
    size_t m = 0, inside = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 4; k += 2)
            if (lies_on(p, e + 4 * i, e + 4 * i + 2) && !same_place(p, e + 4 * i + k))
                angle[m++] = atan2(e[4 * i + k + 1] - p[1], e[4 * i + k] - p[0]);
    qsort(angle, m, sizeof *angle, compare_doubles);
    size_t sectors = 0;
    for (size_t i = 0; i < m; i++) {
        double next = i + 1 < m ? angle[i + 1] : angle[0] + 2 * 3.14159265358979323846, middle = (angle[i] + next) / 2;
        if (next - angle[i] < 1e-9)
            continue;
        sectors++;
        inside += is_inside(e, n, p[0] + .01 * cos(middle), p[1] + .01 * sin(middle));
    }
    return inside > 0 && inside < sectors;
}

/* The input's vertices are the result's, but for those that the border does not
 * pass; whatever else the result has is marked as inserted. */
static void assert_input_kept(const il_slice *input, const il_slice *clean, uint64_t seed)
{
    size_t n;
    double *e = edges_of(input, &n);
    for (size_t i = 0; i < n; i++) {
        bool found = false;
        for (size_t j = 0; j < clean->n; j++)
            for (size_t k = 0; k < clean->ring[j].n; k++)
                found = found || (!is_inserted(&clean->ring[j], k) && same_place(e + 4 * i, clean->ring[j].xy + 2 * k));
        if (found != border_passes(e, n, e + 4 * i))
            fail_msg("seed %llu: vertex %g %g is %s", (unsigned long long)seed, e[4 * i], e[4 * i + 1], found ? "kept" : "lost");
    }
    for (size_t j = 0; j < clean->n; j++)
        for (size_t k = 0; k < clean->ring[j].n; k++) {
            bool found = is_inserted(&clean->ring[j], k);
            for (size_t i = 0; i < n && !found; i++)
                found = memcmp(e + 4 * i, clean->ring[j].xy + 2 * k, 2 * sizeof *e) == 0;
            assert_true(found);
        }
    free(e);
}

/* Area before anything is drawn apart. */
static double region_area(const il_slice *s)
{
    il_arrangement a = IL_ARRANGEMENT_INIT;
    il_slice region = IL_SLICE_INIT;
    size_t crossings, touches, cancelled, pinches;
    assert_int_equal(il_arrangement_from_slice(&a, s, il_slice_cell(s, false), NULL), IL_OK);
    assert_int_equal(il_arrangement_settle(&a, &crossings, &touches, NULL), IL_OK);
    assert_int_equal(il_boundary_extract(&a, &region, &cancelled, &pinches, NULL), IL_OK);
    double area = il_slice_area(&region);
    il_slice_free(&region);
    il_arrangement_free(&a);
    return area;
}

static void assert_idempotent(const il_slice *s, const il_report *first, uint64_t seed)
{
    il_slice again;
    il_report report = IL_REPORT_INIT;
    bool changed = true;
    assert_int_equal(il_slice_copy(&again, s, NULL), IL_OK);
    assert_int_equal(il_slice_clean(&again, &AS_IS, &report, &changed, NULL), IL_OK);
    assert_same_bits(s, &again);
    if (changed)
        fail_msg("seed %llu: clean, and yet changed", (unsigned long long)seed);
    for (int i = 0; i < IL_N_REPAIRS; i++)
        assert_int_equal(report.repair[i], i == IL_REPAIR_PINCH ? first->repair[i] : 0);
    il_slice_free(&again);
}

static void tangles_become_the_clean_boundary_of_their_even_odd_region(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        uint64_t rng = seed;
        il_slice s = random_tangle(&rng, seed % 2 ? 9 : 5), input = without_duplicates(&s);
        il_report report = IL_REPORT_INIT;
        size_t n;
        double *e = edges_of(&input, &n), area = even_odd_area(e, n);
        if (fabs(region_area(&input) - area) > 1e-9)
            fail_msg("seed %llu: area %.12g, by strips %.12g", (unsigned long long)seed, region_area(&input), area);
        assert_int_equal(il_slice_clean(&s, &AS_IS, &report, NULL, NULL), IL_OK);
        assert_true(fabs(il_slice_area(&s) - area) <= .05 * area + 1e-9); /* drawn apart */
        assert_apart(&s, seed);
        assert_region_on_the_left(&s);
        assert_canonical(&s);
        assert_input_kept(&input, &s, seed);
        assert_idempotent(&s, &report, seed);
        free(e);
        il_slice_free(&s);
        il_slice_free(&input);
    }
}

/* Coordinates that differ by little more than rounding, or by less. */
static void shake(il_slice *s, uint64_t *rng)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < 2 * s->ring[i].n; k++) {
            static const double scale[] = { 0x1p-52, 0x1p-44, 0x1p-42, 0x1p-40 };
            double by = scale[stack_random(rng) % 4] * (double)(stack_random(rng) % 5);
            s->ring[i].xy[k] += stack_random(rng) % 2 ? by : -by;
        }
}

static void tangles_shaken_by_ulps_become_clean_for_good(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        uint64_t rng = seed;
        il_slice s = random_tangle(&rng, 3 + seed % 4);
        il_report report = IL_REPORT_INIT;
        shake(&s, &rng);
        assert_int_equal(il_slice_clean(&s, &AS_IS, &report, NULL, NULL), IL_OK);
        assert_apart(&s, seed);
        assert_canonical(&s);
        assert_idempotent(&s, &report, seed);
        il_slice_free(&s);
    }
}

static void scaled_tangles_become_scaled_regions_bit_for_bit(void **state)
{
    (void)state;
    static const int exponent[] = { -1000, -700, -300, -100, 20, 40 };
    for (uint64_t seed = 1; seed <= 600; seed++) {
        uint64_t rng = seed;
        il_slice s = random_tangle(&rng, 7), scaled;
        int by = exponent[seed % 6];
        assert_int_equal(il_slice_copy(&scaled, &s, NULL), IL_OK);
        for (size_t i = 0; i < s.n; i++)
            for (size_t k = 0; k < 2 * s.ring[i].n; k++)
                scaled.ring[i].xy[k] = ldexp(s.ring[i].xy[k], by);
        assert_int_equal(il_slice_clean(&s, &AS_IS, NULL, NULL, NULL), IL_OK);
        assert_int_equal(il_slice_clean(&scaled, &AS_IS, NULL, NULL, NULL), IL_OK);
        for (size_t i = 0; i < s.n; i++)
            for (size_t k = 0; k < 2 * s.ring[i].n; k++)
                s.ring[i].xy[k] = ldexp(s.ring[i].xy[k], by);
        assert_same_bits(&s, &scaled);
        il_slice_free(&s);
        il_slice_free(&scaled);
    }
}

/* ---- marks, x- lines, line numbers ---- */

static unsigned mark_at(const il_slice *s, double x, double y)
{
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->ring[i].n; k++)
            if (s->ring[i].xy[2 * k] == x && s->ring[i].xy[2 * k + 1] == y)
                return s->ring[i].mark ? s->ring[i].mark[k] : 0;
    fail_msg("no vertex %g %g", x, y);
    return 0;
}

static void set_mark(il_ring *r, size_t k, unsigned char mark)
{
    if (!r->mark)
        r->mark = il_calloc(r->n, 1);
    r->cap_mark = r->n;
    r->mark[k] = mark;
}

static void marks_stay_with_their_vertices_and_edges(void **state)
{
    (void)state;
    il_slice s = slice_of("4 4, 4 0, 0 0, 0 4, 0 4; 4 1, 6 1, 6 3, 4 3");
    set_mark(&s.ring[0], 0, IL_VERTEX_MAP_EDGE);  /* (4, 4) to (4, 0), which the other ring cuts */
    set_mark(&s.ring[0], 2, IL_VERTEX_INSERTED);
    set_mark(&s.ring[0], 4, IL_VERTEX_MAP_EDGE);  /* (0, 4) to (4, 4), from a repeated point */
    assert_int_equal(il_slice_clean(&s, &AS_IS, NULL, NULL, NULL), IL_OK);
    assert_int_equal(mark_at(&s, 0, 0), IL_VERTEX_INSERTED);
    assert_int_equal(mark_at(&s, 4, 0), IL_VERTEX_MAP_EDGE);  /* turned round, to (4, 1) */
    assert_int_equal(mark_at(&s, 4, 1), 0);
    assert_int_equal(mark_at(&s, 4, 3), IL_VERTEX_MAP_EDGE);
    assert_int_equal(mark_at(&s, 4, 4), IL_VERTEX_MAP_EDGE);
    assert_int_equal(mark_at(&s, 0, 4), 0);
    assert_int_equal(mark_at(&s, 6, 1), 0);
    il_slice_free(&s);
}

static void a_point_is_inserted_only_while_all_that_stand_there_are(void **state)
{
    (void)state;
    il_slice s = slice_of("0 0, 2 0, 2 2, 0 2; 2 2, 4 2, 4 4, 2 4");
    set_mark(&s.ring[0], 2, IL_VERTEX_INSERTED);
    assert_int_equal(il_slice_clean(&s, &AS_IS, NULL, NULL, NULL), IL_OK);
    assert_int_equal(mark_at(&s, 2, 2), 0);
    il_slice_free(&s);
}

static void crossings_are_marked_as_inserted(void **state)
{
    (void)state;
    il_slice s = slice_of("0 0, 4 4, 4 0, 0 4");
    assert_int_equal(il_slice_clean(&s, &AS_IS, NULL, NULL, NULL), IL_OK);
    assert_int_equal(mark_at(&s, 1.9921875, 2), IL_VERTEX_INSERTED);
    assert_int_equal(mark_at(&s, 2.0078125, 2), IL_VERTEX_INSERTED);
    assert_int_equal(mark_at(&s, 0, 0), 0);
    il_slice_free(&s);
}

/* "a b | c | d": the x- lines of each ring, then after = those of the slice. */
static char *extras_text(const il_slice *s, char *to)
{
    *to = '\0';
    for (size_t i = 0; i <= s->n; i++) {
        if (i > 0)
            strcat(to, i < s->n ? "| " : "= ");
        for (const il_extra *x = i < s->n ? s->ring[i].extra : s->extra; x; x = x->next)
            strcat(strcat(to, x->text), " ");
    }
    return to;
}

static void what_belongs_to_a_ring_goes_where_its_edges_go(void **state)
{
    (void)state;
    char text[CONTOURS_TEXT];
    il_slice s = slice_of("9 9, 8 9, 8 8; 1 1; 0 0, 2 0, 2 2, 0 2; 2 0, 4 0, 4 2, 2 2; 8 8, 9 9, 8 9");
    static const char *const x[] = { "x-a", "x-b", "x-c", "x-d", "x-e" };
    for (size_t i = 0; i < s.n; i++) {
        assert_true(il_extra_add(&s.ring[i].extra, x[i], 3));
        s.ring[i].line = 10 + (long)i;
    }
    assert_true(il_extra_add(&s.extra, "x-s", 3));
    s.z = 3, s.line = 5;
    assert_int_equal(il_slice_clean(&s, &AS_IS, NULL, NULL, NULL), IL_OK);
    assert_string_equal(extras_text(&s, text), "x-c x-d | x-a = x-s x-b x-e ");
    assert_int_equal(s.ring[0].line, 12);
    assert_int_equal(s.ring[1].line, 10);
    assert_int_equal(s.line, 5);
    assert_true(s.z == 3);
    il_slice_free(&s);
}

/* ---- the stage ---- */

/* Writes down what comes: "(" a stack, z and rings of a slice, "p", ")" and ".". */
typedef struct recorder { il_sink sink; char text[CONTOURS_TEXT]; } recorder;

static il_status on_stack_begin(il_sink *self, const il_stack_head *h, il_error *err)
{
    (void)h, (void)err;
    strcat(((recorder *)self)->text, "(");
    return IL_OK;
}

static il_status on_slice(il_sink *self, il_slice *s, il_error *err)
{
    (void)err;
    char *to = ((recorder *)self)->text + strlen(((recorder *)self)->text);
    snprintf(to, 100, "[%.10g: %zu]", s->z, s->n);
    return IL_OK;
}

static il_status on_pair(il_sink *self, il_pair *p, il_error *err)
{
    (void)p, (void)err;
    strcat(((recorder *)self)->text, "p");
    return IL_OK;
}

static il_status on_stack_end(il_sink *self, il_error *err)
{
    (void)err;
    strcat(((recorder *)self)->text, ")");
    return IL_OK;
}

static il_status on_end(il_sink *self, il_error *err)
{
    (void)err;
    strcat(((recorder *)self)->text, ".");
    return IL_OK;
}

/* The pair that names ring 0 of both. */
static il_pair pair_naming_rings(void)
{
    il_pair p = IL_PAIR_INIT;
    p.group = il_calloc(1, sizeof *p.group);
    p.n_groups = p.cap_groups = 1;
    p.line = 9;
    return p;
}

static il_status play_slice(il_sink *to, double z, const char *rings, il_error *err)
{
    il_slice s = slice_of(rings);
    s.z = z;
    s.line = 4;
    il_status st = to->slice(to, &s, err);
    il_slice_free(&s);
    return st;
}

/* CALLS: ( ) . as the recorder's; a digit: a slice of that height with the next
 * of RINGS; p: a pair that names no rings, P: one that does. */
static il_status play(const char *calls, const char *const *rings, const il_clean_options *o, recorder *r,
                      il_report *report, il_error *err)
{
    *r = (recorder){ { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, "" };
    il_sink *c = NULL;
    il_stack_head head = IL_STACK_HEAD_INIT;
    il_status st = il_cleaner_new(&c, o, &r->sink, report, err);
    for (; *calls && st == IL_OK; calls++) {
        il_pair pair = IL_PAIR_INIT;
        if (*calls == 'P')
            pair = pair_naming_rings();
        st = *calls == '(' ? c->stack_begin(c, &head, err) : *calls == ')' ? c->stack_end(c, err)
           : *calls == '.' ? c->end(c, err) : *calls == 'p' || *calls == 'P' ? c->pair(c, &pair, err)
           : play_slice(c, *calls - '0', *rings++, err);
        il_pair_free(&pair);
    }
    il_cleaner_free(c);
    return st;
}

#define OTHER "5 0, 6 0, 6 1"
#define DIRTY "0 0, 4 0, 4 4, 0 4, 0 0"

static void slices_pass_and_equal_heights_are_merged(void **state)
{
    (void)state;
    static const char *const rings[] = { SQUARE, OTHER, SQUARE, SQUARE, SQUARE };
    recorder r;
    il_report report = IL_REPORT_INIT;
    assert_int_equal(play("(1123)(1).", rings, &AS_IS, &r, &report, NULL), IL_OK);
    assert_string_equal(r.text, "([1: 2][2: 1][3: 1])([1: 1]).");
    assert_int_equal(report.repair[IL_REPAIR_MERGED_SLICE], 1);
    /* the two that are merged may be one region */
    static const char *const same[] = { SQUARE, SQUARE };
    assert_int_equal(play("(11).", same, &AS_IS, &r, &report, NULL), IL_OK);
    assert_string_equal(r.text, "([1: 1]).");
    assert_int_equal(report.repair[IL_REPAIR_DUPLICATE_RING], 1);
}

static void heights_that_are_one_as_floats_are_merged(void **state)
{
    (void)state;
    recorder r = { { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, "" };
    il_sink *c;
    il_stack_head head = IL_STACK_HEAD_INIT;
    assert_int_equal(il_cleaner_new(&c, &TO_FLOATS, &r.sink, NULL, NULL), IL_OK);
    assert_int_equal(c->stack_begin(c, &head, NULL), IL_OK);
    assert_int_equal(play_slice(c, 1, SQUARE, NULL), IL_OK);
    assert_int_equal(play_slice(c, 1.00000001, OTHER, NULL), IL_OK);
    assert_int_equal(play_slice(c, 1.1, OTHER, NULL), IL_OK);
    assert_int_equal(c->stack_end(c, NULL), IL_OK);
    assert_string_equal(r.text, "([1: 2][1.100000024: 1])");
    il_cleaner_free(c);
}

static void falling_heights_are_refused_pairs_between_or_not(void **state)
{
    (void)state;
    static const char *const rings[] = { SQUARE, SQUARE, SQUARE };
    static const char *const calls[] = { "(21", "(131", "(12p1", "(12p2", "(12P1" };
    for (size_t i = 0; i < 5; i++) {
        recorder r;
        il_error err = IL_ERROR_INIT;
        assert_int_equal(play(calls[i], rings, &AS_IS, &r, NULL, &err), IL_E_INPUT);
        assert_int_equal(err.line, 4);
    }
    recorder r;
    assert_int_equal(play("(2)(1).", rings, &AS_IS, &r, NULL, NULL), IL_OK);
    assert_int_equal(play("(2p)(1p).", rings, &AS_IS, &r, NULL, NULL), IL_OK);
    assert_string_equal(r.text, "([2: 1]p)([1: 1]p).");
}

static void a_pair_that_names_rings_of_a_repaired_slice_is_refused(void **state)
{
    (void)state;
    static const struct { const char *calls, *rings[4]; bool fine; } c[] = {
        { "(12P", { SQUARE, SQUARE }, true },
        { "(12p", { DIRTY, SQUARE }, true },
        { "(12P", { DIRTY, SQUARE }, false },
        { "(12P", { SQUARE, DIRTY }, false },
        { "(123P", { DIRTY, SQUARE, SQUARE }, true },
        { "(12p3P", { DIRTY, SQUARE, SQUARE }, true },
        { "(12p3P", { SQUARE, DIRTY, SQUARE }, false },
        { "(122P", { SQUARE, SQUARE, OTHER }, false }, /* merged: whose ring 0? */
        { "(1)(12P", { DIRTY, SQUARE, SQUARE }, true },
        { "(12P", { SQUARE, "4 4, 0 4, 0 0, 4 0" }, false },
    };
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        recorder r;
        il_error err = IL_ERROR_INIT;
        il_status st = play(c[i].calls, c[i].rings, &AS_IS, &r, NULL, &err);
        if (st != (c[i].fine ? IL_OK : IL_E_INPUT))
            fail_msg("case %zu: %d %s", i, (int)st, err.text);
        if (st != IL_OK)
            assert_int_equal(err.line, 9);
    }
}

static void a_stack_begun_after_a_failure_starts_afresh(void **state)
{
    (void)state;
    static const char *const rings[] = { DIRTY, SQUARE, SQUARE };
    recorder r;
    assert_int_equal(play("(9(12P).", rings, &AS_IS, &r, NULL, NULL), IL_OK);
    assert_string_equal(r.text, "(([1: 1][2: 1]p).");
}

/* ---- memory ---- */

static void without_memory_cleaning_fails_cleanly(void **state)
{
    (void)state;
    static const char tangle[] = "0 0, 4 4, 4 0, 0 4; 1 1; 9 9, 8 9, 8 8; 8 8, 9 9, 8 9; 0 0, 2 2, 2 4, 4 4, 4 2, 2 2, 0 0, 6 0, 6 6, 0 6";
    il_status st = IL_E_NOMEM;
    for (long k = 0; st != IL_OK; k++) {
        il_slice s = slice_of(tangle);
        il_error err = IL_ERROR_INIT;
        il_report report = IL_REPORT_INIT;
        assert_true(il_extra_add(&s.ring[0].extra, "x-a", 3));
        il_alloc_test_fail_after(k);
        st = il_slice_clean(&s, &AS_IS, &report, NULL, &err);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || (st == IL_E_NOMEM && err.code == IL_E_NOMEM));
        assert_true(st == IL_OK || s.n == 0);
        assert_true(k < 2000);
        il_slice_free(&s);
    }
}

static void without_memory_the_stage_fails_cleanly(void **state)
{
    (void)state;
    il_status st = IL_E_NOMEM;
    for (long k = 0; st != IL_OK; k++) {
        recorder r = { { on_stack_begin, on_slice, on_pair, on_stack_end, on_end }, "" };
        il_sink *c = NULL;
        il_stack_head head = IL_STACK_HEAD_INIT;
        il_slice s[3] = { slice_of(SQUARE), slice_of(DIRTY), slice_of(OTHER) };
        s[1].z = s[2].z = 1;
        il_alloc_test_fail_after(k);
        st = il_cleaner_new(&c, &AS_IS, &r.sink, NULL, NULL);
        assert_int_equal(c == NULL, st != IL_OK);
        if (st == IL_OK)
            st = c->stack_begin(c, &head, NULL);
        for (int i = 0; i < 3 && st == IL_OK; i++)
            st = c->slice(c, &s[i], NULL);
        if (st == IL_OK)
            st = c->stack_end(c, NULL);
        il_alloc_test_fail_after(-1);
        assert_true(st == IL_OK || st == IL_E_NOMEM);
        il_cleaner_free(c);
        for (int i = 0; i < 3; i++)
            il_slice_free(&s[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_clean_stays),
        cmocka_unit_test(other_orders_are_put_in_order_without_a_repair),
        cmocka_unit_test(repeated_points_are_dropped),
        cmocka_unit_test(a_ring_that_is_there_already_is_dropped),
        cmocka_unit_test(a_duplicate_that_comes_to_its_least_vertex_twice_is_known_from_any_start),
        cmocka_unit_test(rings_without_area_are_dropped),
        cmocka_unit_test(crossings_become_vertices_and_are_drawn_apart),
        cmocka_unit_test(a_vertex_on_an_edge_becomes_a_vertex_of_both),
        cmocka_unit_test(keyholes_are_opened),
        cmocka_unit_test(shared_borders_vanish_and_keep_their_ends),
        cmocka_unit_test(a_region_that_touches_itself_in_a_vertex_keeps_it),
        cmocka_unit_test(rings_are_turned_so_that_the_region_lies_on_the_left),
        cmocka_unit_test(spikes_vanish),
        cmocka_unit_test(an_open_line_is_refused_and_named),
        cmocka_unit_test(negative_zeros_become_zeros),
        cmocka_unit_test(a_crossing_with_a_vertex_where_it_would_go_stays),
        cmocka_unit_test(a_crossing_with_a_hole_in_the_way_stays),
        cmocka_unit_test(no_inserted_position_comes_twice_after_separation),
        cmocka_unit_test(rounding_is_counted_with_its_largest_move),
        cmocka_unit_test(rounded_slices_hold_floats_alone_inserted_points_too),
        cmocka_unit_test(tangles_become_the_clean_boundary_of_their_even_odd_region),
        cmocka_unit_test(tangles_shaken_by_ulps_become_clean_for_good),
        cmocka_unit_test(scaled_tangles_become_scaled_regions_bit_for_bit),
        cmocka_unit_test(marks_stay_with_their_vertices_and_edges),
        cmocka_unit_test(a_point_is_inserted_only_while_all_that_stand_there_are),
        cmocka_unit_test(crossings_are_marked_as_inserted),
        cmocka_unit_test(what_belongs_to_a_ring_goes_where_its_edges_go),
        cmocka_unit_test(slices_pass_and_equal_heights_are_merged),
        cmocka_unit_test(heights_that_are_one_as_floats_are_merged),
        cmocka_unit_test(falling_heights_are_refused_pairs_between_or_not),
        cmocka_unit_test(a_pair_that_names_rings_of_a_repaired_slice_is_refused),
        cmocka_unit_test(a_stack_begun_after_a_failure_starts_afresh),
        cmocka_unit_test(without_memory_cleaning_fails_cleanly),
        cmocka_unit_test(without_memory_the_stage_fails_cleanly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
